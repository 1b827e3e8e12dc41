// SPDX-License-Identifier: LGPL-2.1-or-later
// Lifts of prescribed displacements beside the least energy that a cell can have, from its stiffness matrix.
#include "discretisation.h"

#include <hpvi/bound/displacement_lift.h>
#include <hpvi/bound/legendre.h>

#include <cmath>

namespace
{
using namespace verification;

/** A displacement of degree at most 6 along a face of one cell. */
using Displacement = std::function<Tensor<1, 2>(double)>;

/** No less than the least, and at most so many times it. */
void expect_near_least(const CellMap<2> &map, const Material &material, const Displacement &delta,
                       const double factor)
{
  constexpr unsigned int q = 12, n = q + 1;
  Scene<2> scene = shipped_scene("han-6-12");
  scene.materials[0] = material;
  const ShapeTables<2> tables;
  CondensedElements<2> elements(scene, tables);
  const LegendreTables legendre;
  const auto element = elements.get(map, q, 0);
  for (unsigned int face = 0; face < 4; ++face)
  {
    SCOPED_TRACE("nu = " + std::to_string(material.poisson) + ", face " + std::to_string(face));
    std::array<Vector<double>, 2> coefficients{{Vector<double>(n), Vector<double>(n)}};
    Vector<double> boundary(element->condensed.m()), nodal(n);
    for (unsigned int c = 0; c < 2; ++c)
    {
      for (unsigned int k = 0; k < n; ++k)
      {
        nodal[k] = delta(tables.gauss_lobatto(n).point(k)[0])[c];
        boundary[tables.numbering(q).edge[face][c * n + k]] = nodal[k];
      }
      legendre.from_nodes(q).vmult(coefficients[c], nodal);
    }
    const double least = element->condensed.matrix_norm_square(boundary),
                 lift = lift_energy(map, face, coefficients, material, tables);
    EXPECT_GE(lift, least * (1 - 1e-9));
    EXPECT_LE(lift, factor * least);
  }
}

/** Beside an axis most of the energy is that of the strain around it. */
TEST(DisplacementLift, StrainsAroundAnAxis)
{
  const CellMap<2> tube({{{0.1, 0}, {1.1, 0}, {0.1, 1}, {1.1, 1}}});
  expect_near_least(
      tube, {1., 0.3, PlaneModel::axisymmetric},
      [](const double s) {
        return Tensor<1, 2>({s * (1 - s), 0.});
      },
      2.);
}

TEST(DisplacementLift, IsNearTheLeastEnergyWhateverTheVolumeCosts)
{
  const CellMap<2> rectangle({{{0, 0}, {2, 0}, {0, 1}, {2, 1}}}),
      parallelogram({{{0, 0}, {1, 0.2}, {0.4, 1}, {1.4, 1.2}}});
  const auto bump = [](const double s) { return s * (1 - s); };
  const Displacement across =
                         [&](const double s)
  {
    return Tensor<1, 2>({0.1 * bump(s) * (2 * s - 1), bump(s) * (2 * s - 1)});
  },
                     along =
                         [&](const double s)
  {
    return Tensor<1, 2>({bump(s) * (s - 0.3), 0.2 * bump(s) * (5 * s * s - 5 * s + 1)});
  },
                     with_volume = [&](const double s) {
                       return Tensor<1, 2>({bump(s) * bump(s), bump(s)});
                     };
  for (const auto &[nu, factor] : std::vector<std::pair<double, double>>{
           {0.1, 1.5}, {0.3, 1.5}, {0.49, 6.}, {0.4999, 40.}, {0.499999, 45.}})
    for (const CellMap<2> &map : {rectangle, parallelogram})
    {
      const Material material{1., nu, PlaneModel::strain};
      expect_near_least(map, material, across, factor);
      expect_near_least(map, material, along, factor);
      expect_near_least(map, material, with_volume, factor);
    }
}
} // namespace
