// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/body/cell_map.h>
#include <hpvi/discretisation/initial_stress.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Initial strain and its stress around the axis of an axisymmetric body, and one over the radius. */
struct Hoop
{
  double strain, stress, curvature;
};

/** C eps_0 at all points of @p table; @p strains: eps_0. */
std::vector<Tensor<2, 2>> stresses_of(const std::vector<Tensor<2, 2>> &strains,
                                      const Material &material, const ShapeTable<2> &table,
                                      const unsigned int degree, const Volume volume)
{
  const HookesLaw<2> law(material);
  std::vector<Tensor<2, 2>> result;
  for (const Tensor<2, 2> &strain : strains)
    result.emplace_back(law.stress(strain));
  if (volume == Volume::full || !material.is_nearly_incompressible(2))
    return result;
  const FullMatrix<double> modes = oscillating_modes(table, degree);
  Vector<double> weighted(strains.size()), oscillating(strains.size()), amplitudes(modes.m());
  for (unsigned int q = 0; q < strains.size(); ++q)
    weighted[q] = table.weights[q] * trace(strains[q]);
  modes.vmult(amplitudes, weighted);
  modes.Tvmult(oscillating, amplitudes);
  for (unsigned int q = 0; q < strains.size(); ++q)
    for (unsigned int d = 0; d < 2; ++d)
      result[q][d][d] -= law.volume_modulus() * oscillating[q];
  return result;
}

/**
 * Calls f(cell, map, table, q, eps_0, C eps_0, hoop, weight), hoop what these are around an axis, for all points at which
 * there is an initial strain.
 */
template <class F>
void for_each_point(const Scene<2> &scene, const DisplacementSpace<2> &space,
                    const ShapeTables<2> &tables, const Volume volume, const F &f)
{
  for (const auto &cell : space.dof_handler().active_cell_iterators())
  {
    if (!scene.has_initial_strain() || !scene.initial_strains[cell->material_id()])
      continue;
    const unsigned int p = space.degrees()[cell->active_cell_index()];
    const CellMap<2> map = map_of<2>(cell);
    const ShapeTable<2> &table =
        tables.gradients(p, space.strain_points(cell->active_cell_index()));
    std::vector<Tensor<2, 2>> strains;
    for (const Point<2> &point : table.points)
      strains.push_back(scene.initial_strain_in(cell, map.point(point)));
    std::vector<Tensor<2, 2>> stresses =
        stresses_of(strains, scene.material_of(cell), table, p, volume);
    for (unsigned int q = 0; q < strains.size(); ++q)
    {
      const Point<2> x = map.point(table.points[q]);
      const double weight =
          table.weights[q] * std::abs(determinant(map.jacobian(table.points[q]))) * scene.turn(x);
      Hoop hoop{0., 0., 0.};
      if (scene.is_axisymmetric())
      {
        hoop.curvature = 1 / x[0];
        const HookesLaw<2> law(scene.material_of(cell));
        hoop.strain = initial_strain_across<2>(scene, cell, x);
        hoop.stress = law.hoop_stress(strains[q], hoop.strain);
        stresses[q] = Tensor<2, 2>(law.stress(strains[q], hoop.strain));
      }
      f(cell, map, table, q, strains[q], stresses[q], hoop, weight);
    }
  }
}
} // namespace

double initial_stress_error(const Scene<2> &scene, const Triangulation<2>::cell_iterator &cell,
                            const unsigned int n, const ShapeTables<2> &tables)
{
  if (!scene.initial_strains[cell->material_id()])
    return 0.;
  const CellMap<2> map = map_of<2>(cell);
  const HookesLaw<2> law(scene.material_of(cell));
  const QGauss<1> &own = tables.gauss(n), &finer = tables.gauss(n + 3);
  FullMatrix<double> basis(n + 3, n); // through the points of the one at those of the other
  for (unsigned int q = 0; q < n + 3; ++q)
    for (unsigned int i = 0; i < n; ++i)
      basis(q, i) = tables.gauss_lagrange(n)[i].value(finer.point(q)[0]);
  const auto strains_at = [&](const QGauss<1> &gauss)
  {
    std::array<FullMatrix<double>, 3> values;
    values.fill(FullMatrix<double>(gauss.size(), gauss.size()));
    for (unsigned int a = 0; a < gauss.size(); ++a)
      for (unsigned int b = 0; b < gauss.size(); ++b)
      {
        const Tensor<2, 2> strain = scene.initial_strain_in(
            cell, map.point(Point<2>(gauss.point(a)[0], gauss.point(b)[0])));
        for (unsigned int k = 0; k < 3; ++k)
          values[k](a, b) = strain[k == 1][k != 0];
      }
    return values;
  };
  std::array<FullMatrix<double>, 3> missed = strains_at(finer);
  const std::array<FullMatrix<double>, 3> known = strains_at(own);
  FullMatrix<double> half(n + 3, n), whole(n + 3, n + 3);
  for (unsigned int k = 0; k < 3; ++k)
  {
    basis.mmult(half, known[k]);
    half.mTmult(whole, basis);
    missed[k].add(-1., whole);
  }
  double sum = 0;
  for (unsigned int a = 0; a < n + 3; ++a)
    for (unsigned int b = 0; b < n + 3; ++b)
    {
      Tensor<2, 2> strain;
      strain[0][0] = missed[0](a, b);
      strain[1][1] = missed[1](a, b);
      strain[0][1] = strain[1][0] = missed[2](a, b);
      sum += finer.weight(a) * finer.weight(b) *
             std::abs(determinant(map.jacobian(Point<2>(finer.point(a)[0], finer.point(b)[0])))) *
             law.energy_product(strain);
    }
  return sum;
}

Vector<double> initial_strain_loads(const Scene<2> &scene, const DisplacementSpace<2> &space,
                                    const ShapeTables<2> &tables, const Volume volume)
{
  Vector<double> load(space.n_dofs());
  for_each_point(
      scene, space, tables, volume,
      [&](const auto &cell, const CellMap<2> &map, const ShapeTable<2> &table, const unsigned int q,
          const Tensor<2, 2> &, const Tensor<2, 2> &stress, const Hoop &hoop, const double weight)
      {
        // C eps_0 : grad v = (C eps_0 J^-T) : reference gradient of v
        const Tensor<2, 2> pulled =
            weight * stress * transpose(invert(map.jacobian(table.points[q])));
        const unsigned int index = cell->active_cell_index();
        const LocalNumbering &numbering = tables.numbering(space.degrees()[index]);
        const auto dofs = space.cell_dofs(index);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          for (unsigned int r = 0; r < 2; ++r)
            load[dofs[i]] += pulled[numbering.component[i]][r] *
                             table.derivatives(q * table.rows_per_point + r, numbering.shape[i]);
          if (hoop.stress != 0 && numbering.component[i] == 0)
            load[dofs[i]] +=
                weight * hoop.stress * hoop.curvature * table.values(q, numbering.shape[i]);
        }
      });
  return load;
}

double initial_energy(const Scene<2> &scene, const DisplacementSpace<2> &space,
                      const ShapeTables<2> &tables, const Vector<double> &u)
{
  double sum = 0;
  unsigned int known = numbers::invalid_unsigned_int;
  std::vector<double> derivatives, values;
  for_each_point(scene, space, tables, Volume::full,
                 [&](const auto &cell, const CellMap<2> &map, const ShapeTable<2> &table,
                     const unsigned int q, const Tensor<2, 2> &strain, const Tensor<2, 2> &stress,
                     const Hoop &hoop, const double weight)
                 {
                   const unsigned int index = cell->active_cell_index();
                   if (index != known)
                   {
                     const LocalNumbering &numbering = tables.numbering(space.degrees()[index]);
                     const auto dofs = space.cell_dofs(index);
                     std::vector<double> local(dofs.size());
                     for (unsigned int i = 0; i < dofs.size(); ++i)
                       local[numbering.component[i] * dofs.size() / 2 + numbering.shape[i]] =
                           u[dofs[i]];
                     derivatives = evaluate(table.derivatives, local);
                     values = evaluate(table.values, local);
                     known = index;
                   }
                   const Tensor<2, 2> gradient = physical_gradient<2>(
                       derivatives, q * table.rows_per_point, table.derivatives.m(),
                       invert(map.jacobian(table.points[q])));
                   sum += weight * scalar_product(stress, 0.5 * strain - gradient);
                   if (hoop.stress != 0)
                     sum += weight * hoop.stress * (0.5 * hoop.strain - values[q] * hoop.curvature);
                 });
  return sum;
}
} // namespace hpvi
