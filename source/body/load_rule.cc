// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/box_cutter.h>
#include <hpvi/base/common_table.h>
#include <hpvi/body/load_rule.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;
using namespace coarse_cuts;

namespace
{
constexpr unsigned int inside = numbers::invalid_unsigned_int;

constexpr unsigned int along = 16,
                       across = 8; ///< Gauss points of a piece when coarse edges and cells are cut

bool varies(const Load<2> &load)
{
  return coarse_cuts::varies(load[0]) || coarse_cuts::varies(load[1]);
}

/** What varies of a body force, per reference area. */
BoxCutter::Function force_in_cell(const Load<2> &load, const CellMap<2> &map)
{
  return [&load, map](const Point<2> &s)
  {
    Tensor<1, 2> force;
    for (unsigned int c = 0; c < 2; ++c)
      if (coarse_cuts::varies(load[c]))
        force[c] = load[c]->value(map.point(s));
    return std::abs(determinant(map.jacobian(s))) * force;
  };
}
} // namespace

template <int dim>
LoadRules<dim>::LoadRules(const Scene<dim> &scene, const Triangulation<dim> &mesh,
                          std::shared_ptr<const ShapeTables<dim>> shape_tables,
                          const unsigned int finer)
    : DisplacementCuts<dim>(scene, mesh, shape_tables), scene(scene), tables(shape_tables),
      finer(finer)
{
  static_assert(dim == 2, "edges and cells of a plane body");
  total.centre = scene.geometry.centre();
  for (const auto &cell : mesh.cell_iterators_on_level(0))
  {
    const unsigned int id = cell->index();
    if (varies(scene.body_force_in(cell)))
      coarse[{id, inside}] = cut(cell, inside);
    if (scene.has_body_force())
      add(cell, inside);
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face))
      {
        const BoundaryCondition<dim> &condition = scene.boundaries[cell->face(face)->boundary_id()];
        if (varies(condition.traction))
          coarse[{id, face}] = cut(cell, face);
        if (condition.has_traction())
          add(cell, face);
      }
  }
  // Around an axis what is radial balances itself, and turns nothing.
  if (scene.is_axisymmetric())
    total.force[0] = total.moment = std::numeric_limits<double>::quiet_NaN();
}

template <int dim>
void LoadRules<dim>::add(LoadSum &sum, const Tensor<1, dim> &force, const Point<dim> &x) const
{
  sum.centre = scene.geometry.centre();
  const Tensor<1, dim> arm = x - sum.centre;
  sum.force += force;
  sum.moment += arm[0] * force[1] - arm[1] * force[0];
  sum.absolute += std::abs(force[0]) + std::abs(force[1]);
}

/** The load on a coarse edge or cell, to the sum. */
template <int dim>
void LoadRules<dim>::add(const Cell &cell, const unsigned int face)
{
  const unsigned int degree = scene.adaptivity.start_degree;
  if (face != inside)
  {
    add_traction(total, cell, face, degree);
    return;
  }
  const CellMap<dim> map = map_of<dim>(cell);
  const LoadRule<dim> rule = body_force(cell, degree);
  for (unsigned int q = 0; q < rule.quadrature.size(); ++q)
  {
    const Point<dim> &s = rule.quadrature.point(q);
    const Point<dim> x = map.point(s);
    const double weight = rule.quadrature.weight(q) * std::abs(determinant(map.jacobian(s)));
    add(total, weight * scene.turn(x) * load_at<dim>(scene.body_force_in(cell), x), x);
  }
}

template <int dim>
void LoadRules<dim>::add_traction(LoadSum &sum, const Cell &cell, const unsigned int face,
                                  const unsigned int degree) const
{
  const CellMap<dim> map = map_of<dim>(cell);
  const Load<dim> &load = scene.boundaries[cell->face(face)->boundary_id()].traction;
  const LoadRule<1> rule = traction(cell, face, degree);
  for (unsigned int q = 0; q < rule.quadrature.size(); ++q)
  {
    const Point<dim> s = point_on_face<dim>(face, rule.quadrature.point(q));
    const Point<dim> x = map.point(s);
    const double weight = rule.quadrature.weight(q) * map.face_measure(face, s);
    add(sum, weight * scene.turn(x) * load_at<dim>(load, x), x);
  }
}

template <int dim>
typename LoadRules<dim>::Pieces LoadRules<dim>::cut_cell(const Cell &cell) const
{
  const Geometry<dim> &body = scene.geometry;
  BoxCutter cutter(force_in_cell(scene.body_force_in(cell), map_of<dim>(cell)),
                   tables->gauss(across),
                   {{n_parts(cell, 12 * finer, body.n_cells(0), 2),
                     n_parts(cell, 12 * finer, body.n_cells(1), 2)}});
  Pieces result;
  double worst = 0;
  for (const BoxCutter::Piece &piece : cutter.cut())
  {
    result.boxes.push_back(piece.box);
    result.comparison.force += piece.integral;
    result.comparison.finer += piece.finer;
    result.comparison.deviation += piece.deviation;
    if (piece.deviation > worst)
    {
      worst = piece.deviation;
      result.comparison.worst = piece.box.center();
    }
  }
  return result;
}

/** Of an edge or cell anew, whatever it is a part of. */
template <int dim>
typename LoadRules<dim>::Pieces LoadRules<dim>::cut(const Cell &cell, const unsigned int face) const
{
  if (face == inside)
    return cut_cell(cell);
  const CellMap<dim> map = map_of<dim>(cell);
  const auto &load = scene.boundaries[cell->face(face)->boundary_id()].traction;
  const double length = map.face_measure(face, point_on_face<dim>(face, Point<dim - 1>(0.5)));
  Pieces result;
  for (unsigned int c = 0; c < dim; ++c)
    if (varies(load[c]))
    {
      const CutRule rule = cut_edge(*load[c], cell, face, scene, tables->gauss(along), finer);
      result.cuts.insert(result.cuts.end(), rule.cuts.begin(), rule.cuts.end());
      result.comparison.force[c] = length * rule.integral();
      result.comparison.finer[c] = length * rule.finer_integral;
      if (length * rule.deviation >= result.comparison.deviation)
        result.comparison.worst = point_on_face<dim>(face, Point<dim - 1>(rule.worst));
      result.comparison.deviation += length * rule.deviation;
    }
  std::sort(result.cuts.begin(), result.cuts.end());
  return result;
}

template <int dim>
bool LoadRules<dim>::is_unresolved(const Pieces &pieces) const
{
  return pieces.comparison.deviation > 1e-9 * total.absolute;
}

template <int dim>
typename LoadRules<dim>::Pieces LoadRules<dim>::pieces(const Cell &cell,
                                                       const unsigned int face) const
{
  const auto known = coarse.find({coarse_index(cell), face});
  if (known == coarse.end()) // constant
    return {{0., 1.}, {BoundingBox<dim>({Point<dim>(), Point<dim>(1., 1.)})}, {}};
  if (cell->level() == 0)
    return known->second;
  if (is_unresolved(known->second))
    return cut(cell, face);
  const BoundingBox<dim> part = part_of_coarse(cell);
  Pieces result;
  if (face == inside)
    for (const BoundingBox<dim> &box : known->second.boxes)
    {
      if (const auto seen = seen_from(part, box))
        result.boxes.push_back(*seen);
    }
  else
  {
    const unsigned int d = 1 - face / 2;
    result.cuts = seen_from(part.lower_bound(d), part.side_length(d), known->second.cuts);
  }
  return result;
}

template <int dim>
LoadRule<1> LoadRules<dim>::traction(const Cell &cell, const unsigned int face,
                                     const unsigned int degree) const
{
  const CellMap<dim> map = map_of<dim>(cell);
  const std::vector<double> cuts = seen_from(0., 1., pieces(cell, face).cuts);
  std::vector<BoundingBox<1>> parts;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
    parts.push_back(BoundingBox<1>({Point<1>(cuts[k]), Point<1>(cuts[k + 1])}));
  LoadRule<1> result = rule_on<1>(
      parts, degree, scene.boundaries[cell->face(face)->boundary_id()].traction,
      [&](const Function<dim> &component, const Point<1> &s)
      { return component.value(map.point(point_on_face<dim>(face, s))); },
      *tables);
  result.cuts = cuts;
  return result;
}

template <int dim>
unsigned int LoadRules<dim>::strain_points(const Cell &cell, const unsigned int degree) const
{
  return common_value(known_strain_points, cell_key(cell, degree),
                      [&]() { return hpvi::strain_points(scene, cell, degree, *tables); });
}

template <int dim>
LoadRule<dim> LoadRules<dim>::body_force(const Cell &cell, const unsigned int degree) const
{
  const auto make = [&]()
  {
    const CellMap<dim> map = map_of<dim>(cell);
    return rule_on<dim>(
        pieces(cell, inside).boxes, degree, scene.body_force_in(cell),
        [&](const Function<dim> &component, const Point<dim> &s)
        { return component.value(map.point(s)); },
        *tables);
  };
  const unsigned int n =
      common_value(known_force_points, cell_key(cell, degree), [&]() { return make().n_gauss; });
  return n > 0 ? LoadRule<dim>{n, n, Quadrature<dim>(tables->gauss(n)), {}} : make();
}

template <int dim>
std::vector<UnresolvedLoad<dim>> LoadRules<dim>::unresolved(const Triangulation<dim> &mesh) const
{
  std::vector<UnresolvedLoad<dim>> result;
  const auto look = [&](const auto &cell, const unsigned int face, const std::string &name)
  {
    const auto known = coarse.find({coarse_index(cell), face});
    if (known == coarse.end() || !is_unresolved(known->second))
      return;
    const Pieces here = pieces(cell, face);
    if (is_unresolved(here))
      result.push_back({name, cell->active_cell_index(),
                        map_of<dim>(cell).point(here.comparison.worst), here.comparison.force,
                        here.comparison.finer, here.comparison.deviation});
  };
  if (std::none_of(coarse.begin(), coarse.end(),
                   [&](const auto &known) { return is_unresolved(known.second); }))
    return result;
  for (const auto &cell : mesh.active_cell_iterators())
  {
    look(cell, inside, "Body force");
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face))
        look(cell, face, "Traction on " + scene.boundaries[cell->face(face)->boundary_id()].name);
  }
  return result;
}

template <int dim>
const LoadSum &LoadRules<dim>::sum() const
{
  return total;
}

template <int dim>
bool LoadRules<dim>::are_missing_something(const Tensor<1, dim> &force) const
{
  if (coarse.empty() || scene.geometry.has_curves() ||
      std::any_of(coarse.begin(), coarse.end(),
                  [&](const auto &known) { return is_unresolved(known.second); }))
    return false;
  for (unsigned int c = scene.is_axisymmetric() ? 1 : 0; c < dim; ++c)
    if (std::abs(force[c] - total.force[c]) > 1e-9 * total.absolute)
      return true;
  return false;
}

template <int dim>
std::map<types::boundary_id, LoadSum>
LoadRules<dim>::sums_by_boundary(const DoFHandler<dim> &numbering) const
{
  std::map<types::boundary_id, LoadSum> result;
  for (const auto &cell : numbering.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face))
      {
        const types::boundary_id boundary = cell->face(face)->boundary_id();
        if (scene.boundaries[boundary].has_traction())
          add_traction(result[boundary], cell, face, cell->get_fe().degree);
      }
  return result;
}

template <int dim>
double LoadRules<dim>::difference() const
{
  double sum = 0;
  for (const auto &[place, pieces] : coarse)
    if (!is_unresolved(pieces))
      sum += pieces.comparison.deviation;
  return sum == 0. ? 0. : sum / total.absolute;
}

template class LoadRules<2>;
} // namespace hpvi
