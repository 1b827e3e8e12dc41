// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/memo_table.h>
#include <hpvi/plane/load_rule.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;
using namespace coarse_cuts;

// deal.II's CellId holds 30 levels. Here are 48, of which the last is round-off of the coarse cell.
CellKey cell_key(const Triangulation<2>::cell_iterator &cell, const unsigned int number)
{
  const unsigned int level = cell->level();
  AssertThrow(level <= 48, ExcMessage("A cell is more than 48 levels below its coarse cell."));
  CellKey key{{coarse_index(cell), level << 16 | number}};
  for (Triangulation<2>::cell_iterator part = cell; part->level() > 0; part = part->parent())
  {
    unsigned int child = 0;
    while (part->parent()->child_index(child) != part->index())
      ++child;
    const unsigned int above = part->level() - 1;
    key[2 + above / 16] |= child << 2 * (above % 16);
  }
  return key;
}

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
    look_at(cell, inside, Datum::load);
    look_at(cell, inside, Datum::initial_strain);
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face))
      {
        look_at(cell, face, Datum::load);
        look_at(cell, face, Datum::spring);
        look_at(cell, face, Datum::friction_bound);
      }
  }
  // Around an axis what is radial balances itself, and turns nothing.
  if (scene.is_axisymmetric())
    total.force[0] = total.moment = std::numeric_limits<double>::quiet_NaN();
  Total &loads = totals[static_cast<unsigned int>(Datum::load)];
  for (unsigned int c = 0; c < dim; ++c)
    loads.sum[c] = total.force[c];
  loads.absolute = total.absolute;
}

/** A coarse edge or cell: where its datum is cut, and what it adds to the sum. */
template <int dim>
void LoadRules<dim>::look_at(const Cell &cell, const unsigned int face, const Datum datum)
{
  const GivenData given = given_data(scene, cell, face, datum);
  if (given.functions.empty())
    return;
  if (given.varies())
    coarse[{cell->index(), face, datum}] = cut_data(scene, cell, face, datum, *tables, finer);
  add(cell, face, datum);
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

template <int dim>
void LoadRules<dim>::add(const Cell &cell, const unsigned int face, const Datum datum)
{
  const unsigned int degree = scene.adaptivity.start_degree;
  if (face != inside && datum == Datum::load)
  {
    add_traction(total, cell, face, degree);
    return;
  }
  const CellMap<dim> map = map_of<dim>(cell);
  const GivenData given = given_data(scene, cell, face, datum);
  const auto take = [&](const Point<dim> &s, const double weight)
  {
    const Point<dim> x = map.point(s);
    const DatumValue value = weight * scene.circumference(x) * given.value(x);
    if (datum == Datum::load)
    {
      Tensor<1, dim> force;
      for (unsigned int c = 0; c < dim; ++c)
        force[c] = value[c];
      return add(total, force, x);
    }
    Total &sum = totals[static_cast<unsigned int>(datum)];
    sum.sum += value;
    for (unsigned int c = 0; c < 4; ++c)
      sum.absolute += std::abs(value[c]);
  };
  if (face != inside)
  {
    const Quadrature<1> rule = on_face(cell, face, datum, degree, {}).quadrature;
    for (unsigned int q = 0; q < rule.size(); ++q)
    {
      const Point<dim> s = point_on_face<dim>(face, rule.point(q));
      take(s, rule.weight(q) * map.face_measure(face, s));
    }
    return;
  }
  const Quadrature<dim> rule = in_cell(cell, datum, degree).quadrature;
  for (unsigned int q = 0; q < rule.size(); ++q)
    take(rule.point(q), rule.weight(q) * std::abs(determinant(map.jacobian(rule.point(q)))));
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
    add(sum, weight * scene.circumference(x) * load_at<dim>(load, x), x);
  }
}

// @sect3{Pieces}
//
template <int dim>
bool LoadRules<dim>::is_unresolved(const DataPieces &pieces, const Datum datum) const
{
  return pieces.deviation > 1e-9 * total_of(datum).absolute;
}

template <int dim>
bool LoadRules<dim>::is_any_unresolved(const Datum datum) const
{
  return std::any_of(coarse.begin(), coarse.end(),
                     [&](const auto &known) {
                       return std::get<2>(known.first) == datum &&
                              is_unresolved(known.second, datum);
                     });
}

template <int dim>
DataPieces LoadRules<dim>::pieces(const Cell &cell, const unsigned int face,
                                  const Datum datum) const
{
  const auto known = coarse.find({coarse_index(cell), face, datum});
  if (known == coarse.end()) // constant
    return {{0., 1.}, {BoundingBox<dim>({Point<dim>(), Point<dim>(1., 1.)})}, {}, {}, 0., {}};
  if (cell->level() == 0)
    return known->second;
  if (is_unresolved(known->second, datum))
    return cut_data(scene, cell, face, datum, *tables, finer);
  const BoundingBox<dim> part = part_of_coarse(cell);
  DataPieces result;
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

// @sect3{Rules}
//
/** For what is given times each of @p factors; none: alone. */
template <int dim>
LoadRule<1> LoadRules<dim>::on_face(const Cell &cell, const unsigned int face, const Datum datum,
                                    const unsigned int degree,
                                    const std::vector<std::function<double(double)>> &factors) const
{
  const CellMap<dim> map = map_of<dim>(cell);
  const GivenData given = given_data(scene, cell, face, datum);
  const std::vector<double> cuts = seen_from(0., 1., pieces(cell, face, datum).cuts);
  std::vector<BoundingBox<1>> boxes;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
    boxes.push_back(BoundingBox<1>({Point<1>(cuts[k]), Point<1>(cuts[k + 1])}));
  std::vector<std::function<double(const Point<1> &)>> functions;
  for (const Expression<dim> &function : given.functions)
  {
    const auto value = [&map, face, function](const Point<1> &s)
    { return function->value(map.point(point_on_face<dim>(face, s))); };
    functions.emplace_back(value);
    for (const auto &factor : factors)
      functions.emplace_back([value, factor](const Point<1> &s)
                             { return factor(s[0]) * value(s); });
  }
  if (!given.functions.empty() && dim == 2 && map.is_curved() && map.blends()[face])
    functions.emplace_back([&map, face](const Point<1> &s) // a constant load is none there
                           { return map.face_measure(face, point_on_face<dim>(face, s)); });
  LoadRule<1> result = rule_on<1>(rule_parts<1>(boxes, degree, functions, *tables), *tables);
  result.cuts = cuts;
  return result;
}

template <int dim>
LoadRule<1> LoadRules<dim>::traction(const Cell &cell, const unsigned int face,
                                     const unsigned int degree) const
{
  return on_face(cell, face, Datum::load, degree, {});
}

// Constant springs meet polynomials of degree 2p: p + 1 points are exact. Others have five more at least, and as many as give
// their moments with the highest even and odd ones.
template <int dim>
LoadRule<1> LoadRules<dim>::spring(const Cell &cell, const unsigned int face,
                                   const unsigned int degree) const
{
  if (!given_data(scene, cell, face, Datum::spring).varies())
    return on_face(cell, face, Datum::spring, degree - 1, {});
  std::vector<std::function<double(double)>> factors;
  for (const unsigned int n : {2 * degree - 1, 2 * degree})
    factors.emplace_back([n](const double s) { return std::legendre(n, 2 * s - 1); });
  return on_face(cell, face, Datum::spring, degree + 4, factors);
}

template <int dim>
LoadRule<dim> LoadRules<dim>::in_cell(const Cell &cell, const Datum datum,
                                      const unsigned int degree) const
{
  const auto make = [&]()
  {
    const CellMap<dim> map = map_of<dim>(cell);
    std::vector<std::function<double(const Point<dim> &)>> functions;
    for (const Expression<dim> &function : given_data(scene, cell, inside, datum).functions)
      functions.emplace_back([&map, function](const Point<dim> &s)
                             { return function->value(map.point(s)); });
    return rule_parts<dim>(pieces(cell, inside, datum).boxes, degree, functions, *tables);
  };
  return rule_on<dim>(
      memoised(known_parts[static_cast<unsigned int>(datum)], cell_key(cell, degree), make),
      *tables);
}

template <int dim>
LoadRule<dim> LoadRules<dim>::body_force(const Cell &cell, const unsigned int degree) const
{
  return in_cell(cell, Datum::load, degree);
}

template <int dim>
LoadRule<dim> LoadRules<dim>::initial_strain(const Cell &cell, const unsigned int degree) const
{
  return in_cell(cell, Datum::initial_strain, degree + 1);
}

// @sect3{What is not resolved}
//
template <int dim>
std::vector<UnresolvedLoad<dim>> LoadRules<dim>::unresolved(const Triangulation<dim> &mesh) const
{
  std::vector<UnresolvedLoad<dim>> result;
  for (const Datum datum : {Datum::load, Datum::initial_strain, Datum::spring})
  {
    if (!is_any_unresolved(datum))
      continue;
    const auto look = [&](const auto &cell, const unsigned int face)
    {
      const auto known = coarse.find({coarse_index(cell), face, datum});
      if (known == coarse.end() || !is_unresolved(known->second, datum))
        return;
      const DataPieces here = pieces(cell, face, datum);
      if (here.deviation > 1e-9 * total_of(datum).absolute)
        result.push_back({datum, given_data(scene, cell, face, datum).name,
                          cell->active_cell_index(), map_of<dim>(cell).point(here.worst),
                          here.integral, here.finer, here.deviation / total_of(datum).absolute});
    };
    for (const auto &cell : mesh.active_cell_iterators())
    {
      look(cell, inside);
      for (const unsigned int face : cell->face_indices())
        if (cell->at_boundary(face))
          look(cell, face);
    }
  }
  return result;
}

template <int dim>
const LoadSum &LoadRules<dim>::sum() const
{
  return total;
}

template <int dim>
const typename LoadRules<dim>::Total &LoadRules<dim>::total_of(const Datum datum) const
{
  return totals[static_cast<unsigned int>(datum)];
}

template <int dim>
bool LoadRules<dim>::are_missing_something(const Datum datum, const DatumValue &sum) const
{
  if (coarse.empty() || scene.geometry.has_curves() || is_any_unresolved(datum))
    return false;
  // Places of a body that lies far from the origin are rounded, and a limit of friction with them.
  const double tolerance = datum == Datum::friction_bound ? 1e-6 : 1e-9;
  for (unsigned int c = 0; c < 4; ++c) // where what is radial balances itself, there is no number
    if (std::abs(sum[c] - total_of(datum).sum[c]) > tolerance * total_of(datum).absolute)
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
double LoadRules<dim>::difference(const Datum datum) const
{
  double sum = 0;
  for (const auto &[place, pieces] : coarse)
    if (std::get<2>(place) == datum && !is_unresolved(pieces, datum))
      sum += pieces.deviation;
  return sum == 0. ? 0. : sum / total_of(datum).absolute;
}

template class LoadRules<2>;
} // namespace hpvi
