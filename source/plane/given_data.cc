// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/box_cutter.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/given_data.h>
#include <hpvi/plane/load_quadrature.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

namespace
{
DatumValue components(const double a, const double b, const double c = 0., const double d = 0.)
{
  DatumValue result;
  result[0] = a;
  result[1] = b;
  result[2] = c;
  result[3] = d;
  return result;
}

std::function<DatumValue(const Point<2> &)> value_of(const Load<2> &load)
{
  return [&load](const Point<2> &x)
  {
    const Tensor<1, 2> value = load_at<2>(load, x);
    return components(value[0], value[1]);
  };
}

/** C eps_0. */
std::function<DatumValue(const Point<2> &)> initial_stress(const Scene<2> &scene,
                                                           const types::material_id material)
{
  return [&scene, material, law = HookesLaw<2>(scene.materials.at(material))](const Point<2> &x)
  {
    const Tensor<2, 2> strain = scene.initial_strain(material, x);
    const double hoop = scene.is_axisymmetric() ? scene.initial_strains[material].value(x)[3] : 0.;
    const SymmetricTensor<2, 2> stress = law.stress(strain, hoop);
    return components(stress[0][0], stress[1][1], stress[0][1],
                      scene.is_axisymmetric() ? law.hoop_stress(strain, hoop) : 0.);
  };
}
} // namespace

bool GivenData::varies() const
{
  return std::any_of(functions.begin(), functions.end(), coarse_cuts::varies);
}

GivenData given_data(const Scene<2> &scene, const coarse_cuts::Cell &cell, const unsigned int face,
                     const Datum datum)
{
  GivenData result;
  const auto take = [&](const auto &given)
  {
    for (const Expression<2> &function : given)
      if (function)
        result.functions.push_back(function);
  };
  if (face != inside)
  {
    const BoundaryCondition<2> &boundary = scene.boundaries[cell->face(face)->boundary_id()];
    const Spring<2> &spring = boundary.spring;
    if (datum == Datum::load)
    {
      result.name = "Traction on " + boundary.name;
      take(boundary.traction);
      result.value = value_of(boundary.traction);
    }
    else if (datum == Datum::friction_bound && !boundary.pair && boundary.friction.bound)
    {
      result.functions.push_back(boundary.friction.bound);
      result.value = [&boundary](const Point<2> &x)
      { return components(boundary.friction.bound_at(x), 0.); };
    }
    else if (datum == Datum::spring)
    {
      result.name = "Spring on " + boundary.name;
      take(std::array<Expression<2>, 2>{{spring.normal, spring.tangential}});
      result.value = [&spring](const Point<2> &x)
      {
        return components(spring.normal ? spring.normal->value(x) : 0.,
                          spring.tangential ? spring.tangential->value(x) : 0.);
      };
    }
  }
  else if (datum == Datum::load)
  {
    result.name = "Body force";
    take(scene.body_force_in(cell));
    result.value = value_of(scene.body_force_in(cell));
  }
  else if (datum == Datum::initial_strain && scene.has_initial_strain())
  {
    const InitialStrain<2> &initial = scene.initial_strains[cell->material_id()];
    take(initial.components);
    result.name = result.functions.empty() ? "Temperature" : "Initial strain";
    if (initial.expansion != 0.)
      take(std::array<Expression<2>, 1>{{initial.temperature}});
    result.value = initial_stress(scene, cell->material_id());
  }
  return result;
}

// @sect3{Cuts}
//
namespace
{
constexpr unsigned int along = 16; ///< Gauss points of a piece when edges are cut, and along lines

/** Where a line in direction d through the unit cell, at @p level across it, is cut. */
std::vector<double> cuts_along(const unsigned int d, const double level,
                               const BoxCutter::Function &f, const QGauss<1> &gauss,
                               const unsigned int n_parts)
{
  const auto along_line = [&](const double s)
  {
    const DatumValue value = f(d == 0 ? Point<2>(s, level) : Point<2>(level, s));
    return value[0] + 0.7548777 * value[1] + 0.5698403 * value[2] + 0.4301597 * value[3];
  };
  return make_cut_rule(along_line, gauss, {0, 1, 2}, n_parts).cuts;
}

/** Those that two lines have in common: at a strip across the cell, which a grid of samples may miss. */
std::vector<double> common_cuts(const unsigned int d, const BoxCutter::Function &f,
                                const QGauss<1> &gauss, const unsigned int n_parts)
{
  std::vector<double> result;
  const auto one = cuts_along(d, 0.2763932, f, gauss, n_parts),
             other = cuts_along(d, 0.6180340, f, gauss, n_parts);
  for (const double cut : one)
    if (std::any_of(other.begin(), other.end(),
                    [cut](const double s) { return std::abs(s - cut) < same_cut; }))
      result.push_back(cut);
  return result;
}

DataPieces cut_cell(const Scene<2> &scene, const coarse_cuts::Cell &cell, const Datum datum,
                    const ShapeTables<2> &tables, const unsigned int finer)
{
  const Geometry<2> &body = scene.geometry;
  const CellMap<2> map = map_of<2>(cell);
  const GivenData given = given_data(scene, cell, inside, datum);
  const BoxCutter::Function per_area = [&](const Point<2> &s)
  { return std::abs(determinant(map.jacobian(s))) * given.value(map.point(s)); };
  std::array<std::vector<double>, 2> lines;
  for (unsigned int d = 0; d < 2; ++d)
    lines[d] = common_cuts(d, per_area, tables.gauss(along),
                           coarse_cuts::n_parts(cell, 32 * finer, body.n_cells(d), 4));
  // Polynomials through the values of a strain count, not moments alone: a smooth one shall keep one piece.
  const unsigned int across = datum == Datum::initial_strain ? 16 : 8, parts = 96 / across * finer;
  BoxCutter cutter(per_area, tables.gauss(across),
                   {{coarse_cuts::n_parts(cell, parts, body.n_cells(0), 2),
                     coarse_cuts::n_parts(cell, parts, body.n_cells(1), 2)}},
                   lines);
  DataPieces result;
  double worst = 0;
  for (const BoxCutter::Piece &piece : cutter.cut())
  {
    result.boxes.push_back(piece.box);
    result.integral += piece.integral;
    result.finer += piece.finer;
    result.deviation += piece.deviation;
    if (piece.deviation > worst)
    {
      worst = piece.deviation;
      result.worst = piece.box.center();
    }
  }
  return result;
}

} // namespace

DataPieces cut_data(const Scene<2> &scene, const coarse_cuts::Cell &cell, const unsigned int face,
                    const Datum datum, const ShapeTables<2> &tables, const unsigned int finer)
{
  if (face == inside)
    return cut_cell(scene, cell, datum, tables, finer);
  const CellMap<2> map = map_of<2>(cell);
  const BoundaryCondition<2> &boundary = scene.boundaries[cell->face(face)->boundary_id()];
  const std::array<Expression<2>, 2> components =
      datum == Datum::load     ? boundary.traction
      : datum == Datum::spring ? Load<2>{{boundary.spring.normal, boundary.spring.tangential}}
                               : Load<2>{{boundary.friction.bound, nullptr}};
  const double length = map.face_measure(face, point_on_face<2>(face, Point<1>(0.5)));
  DataPieces result;
  for (unsigned int c = 0; c < 2; ++c)
    if (coarse_cuts::varies(components[c]))
    {
      const CutRule rule =
          coarse_cuts::cut_edge(*components[c], cell, face, scene, tables.gauss(along), finer);
      result.cuts.insert(result.cuts.end(), rule.cuts.begin(), rule.cuts.end());
      result.integral[c] = length * rule.integral();
      result.finer[c] = length * rule.finer_integral;
      if (length * rule.deviation >= result.deviation)
        result.worst = point_on_face<2>(face, Point<1>(rule.worst));
      result.deviation += length * rule.deviation;
    }
  std::sort(result.cuts.begin(), result.cuts.end());
  return result;
}
} // namespace hpvi
