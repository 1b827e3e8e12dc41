// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/box_cutter.h>
#include <hpvi/body/load_rule.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int inside = numbers::invalid_unsigned_int;

/** Gauss points of a piece when coarse edges and cells are cut, and most of them on each piece afterwards. */
constexpr unsigned int along = 16, across = 8, most_on_pieces = 16, most = 64;

// ---------------------------------------------------------------- as many Gauss points as it takes

/** Moments with 1, s, s^2 in each of d directions, largest value and smallest. */
struct Sample
{
  std::array<double, 9> moments{}; ///< three in one dimension
  double largest = -1e300, smallest = 1e300;

  template <int d, class Load>
  static Sample take(const QGauss<1> &gauss, const Load &load)
  {
    Sample result;
    const unsigned int n = gauss.size();
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < (d == 1 ? 1 : n); ++b)
      {
        Point<d> s;
        s[0] = gauss.point(a)[0];
        if (d == 2)
          s[d - 1] = gauss.point(b)[0];
        const double value = load(s);
        result.largest = std::max(result.largest, value);
        result.smallest = std::min(result.smallest, value);
        double across = gauss.weight(a) * (d == 1 ? 1. : gauss.weight(b)) * value;
        for (unsigned int j = 0; j < (d == 1 ? 1 : 3); ++j, across *= s[d - 1])
        {
          double moment = across;
          for (unsigned int i = 0; i < 3; ++i, moment *= s[0])
            result.moments[3 * j + i] += moment;
        }
      }
    return result;
  }
};

template <int d, class Load>
unsigned int points_for(unsigned int n, const unsigned int most, const Load &load,
                        const ShapeTables<2> &tables)
{
  for (Sample here = Sample::take<d>(tables.gauss(n), load);
       here.largest != here.smallest && n < most;)
  {
    const unsigned int more = std::min(n + 4, most);
    const Sample there = Sample::take<d>(tables.gauss(more), load);
    const double scale = std::max(std::abs(there.largest), std::abs(there.smallest));
    bool same = true;
    for (unsigned int k = 0; k < here.moments.size(); ++k)
      same = same && std::abs(here.moments[k] - there.moments[k]) <= 1e-15 * scale;
    if (same)
      break;
    n = more;
    here = there;
  }
  return n;
}

template <int d>
Point<d> point_in(const BoundingBox<d> &box, const Point<d> &unit)
{
  Point<d> result;
  for (unsigned int c = 0; c < d; ++c)
    result[c] = box.lower_bound(c) + box.side_length(c) * unit[c];
  return result;
}

/** A Gauss rule on each of some boxes, for the components of a load at points of [0,1]^d. */
template <int d, class Load>
LoadRule<d> rule_on(const std::vector<BoundingBox<d>> &boxes, const unsigned int degree,
                    const std::array<Expression<2>, 2> &components, const Load &value,
                    const ShapeTables<2> &tables)
{
  LoadRule<d> result{0, 0, Quadrature<d>(), {}};
  std::vector<Point<d>> points;
  std::vector<double> weights;
  for (const BoundingBox<d> &box : boxes)
  {
    unsigned int n = degree + 2;
    for (const auto &component : components)
      if (component)
        n = points_for<d>(
            n, boxes.size() == 1 ? most : most_on_pieces,
            [&](const Point<d> &unit) { return value(*component, point_in(box, unit)); }, tables);
    const Quadrature<d> gauss(tables.gauss(n));
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      points.push_back(point_in(box, gauss.point(q)));
      weights.push_back(box.volume() * gauss.weight(q));
    }
    result.n_gauss = boxes.size() == 1 ? n : 0;
    result.most_points = std::max(result.most_points, n);
  }
  result.quadrature = Quadrature<d>(points, weights);
  return result;
}

// ---------------------------------------------------------------- edges and cells of a mesh

bool varies(const Expression<2> &component)
{
  return component && !dynamic_cast<const Functions::ConstantFunction<2> *>(component.get());
}

bool varies(const std::array<Expression<2>, 2> &load)
{
  return varies(load[0]) || varies(load[1]);
}

/** The index of the coarse cell of @p cell. (deal.II's CellId holds 30 levels, and meshes may have more.) */
template <class Cell>
unsigned int coarse_index(Cell cell)
{
  while (cell->level() > 0)
    cell = cell->parent();
  return cell->index();
}

/** The part of its coarse cell that @p cell is, in reference coordinates. */
template <class Cell>
BoundingBox<2> part_of_coarse(Cell cell)
{
  Point<2> lower;
  double width = 1;
  for (; cell->level() > 0; cell = cell->parent())
  {
    unsigned int child = 0;
    while (cell->parent()->child(child) != cell)
      ++child;
    for (unsigned int d = 0; d < 2; ++d)
      lower[d] = (lower[d] + (child >> d & 1)) / 2;
    width /= 2;
  }
  return BoundingBox<2>({lower, lower + Point<2>(width, width)});
}

/** @p box in the coordinates in which @p part is [0,1]^2; nothing where round-off alone is common to both. */
std::optional<BoundingBox<2>> seen_from(const BoundingBox<2> &part, const BoundingBox<2> &box)
{
  Point<2> lower, upper;
  for (unsigned int d = 0; d < 2; ++d)
  {
    const auto in_part = [&](const double x)
    {
      const double s = (x - part.lower_bound(d)) / part.side_length(d);
      return std::min(std::max(s, 0.), 1.);
    };
    lower[d] = in_part(box.lower_bound(d));
    upper[d] = in_part(box.upper_bound(d));
    if (upper[d] - lower[d] < 1e-12)
      return {};
  }
  return BoundingBox<2>({lower, upper});
}

std::vector<double> seen_from(const double lower, const double width,
                              const std::vector<double> &cuts)
{
  std::vector<double> result{0.};
  for (const double cut : cuts)
    if (const double s = (cut - lower) / width; s > result.back() + 1e-12 && s < 1 - 1e-12)
      result.push_back(s);
  result.push_back(1.);
  return result;
}
} // namespace

template <int dim>
LoadRules<dim>::LoadRules(const Scene<dim> &scene, const Triangulation<dim> &mesh,
                          std::shared_ptr<const ShapeTables<dim>> shape_tables)
    : scene(scene), tables(std::move(shape_tables))
{
  static_assert(dim == 2, "edges and cells of a plane body");
  total.centre = centre_of(scene.geometry);
  for (const auto &cell : mesh.cell_iterators_on_level(0))
  {
    const unsigned int id = cell->index();
    if (varies(scene.body_force))
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
        cut_displacements(cell, face);
      }
  }
}

/** The load on a coarse edge or cell, to the sum. */
template <int dim>
void LoadRules<dim>::add(const Cell &cell, const unsigned int face)
{
  const unsigned int degree = scene.adaptivity.start_degree;
  const CellMap<dim> map = map_of<dim>(cell);
  const auto add_point =
      [&](const std::array<Expression<dim>, dim> &load, const Point<dim> &x, const double weight)
  {
    Tensor<1, dim> force;
    for (unsigned int c = 0; c < dim; ++c)
      force[c] = load[c] ? weight * load[c]->value(x) : 0.;
    const Tensor<1, dim> arm = x - total.centre;
    total.force += force;
    total.moment += arm[0] * force[1] - arm[1] * force[0];
    total.absolute += std::abs(force[0]) + std::abs(force[1]);
  };
  if (face == inside)
  {
    const LoadRule<dim> rule = body_force(cell, degree);
    for (unsigned int q = 0; q < rule.quadrature.size(); ++q)
    {
      const Point<dim> &s = rule.quadrature.point(q);
      add_point(scene.body_force, map.point(s),
                rule.quadrature.weight(q) * std::abs(determinant(map.jacobian(s))));
    }
    return;
  }
  const LoadRule<1> rule = traction(cell, face, degree);
  for (unsigned int q = 0; q < rule.quadrature.size(); ++q)
  {
    const Point<dim> s = point_on_face<dim>(face, rule.quadrature.point(q));
    add_point(scene.boundaries[cell->face(face)->boundary_id()].traction, map.point(s),
              rule.quadrature.weight(q) * map.face_measure(face, s));
  }
}

namespace
{
/** Of an edge or cell its share of those of a side of the body: refined ones are looked at no less closely than coarse ones. */
template <class Cell>
unsigned int n_parts(const Cell &cell, const unsigned int of_side, const unsigned int n_cells,
                     const unsigned int least)
{
  const unsigned int per_cell = 1U << std::min(cell->level(), 30); // of a coarse one
  return std::max(least, (of_side - 1) / n_cells / per_cell + 1);
}

CutRule cut_edge(const Function<2> &f, const CellMap<2> &map, const unsigned int face,
                 const QGauss<1> &gauss, const unsigned int n_parts)
{
  return make_cut_rule([&](const double s)
                       { return f.value(map.point(point_on_face<2>(face, Point<1>(s)))); },
                       gauss, {0, 1, 2}, n_parts);
}

/** What varies of a body force, per reference area. */
BoxCutter::Function force_in_cell(const Scene<2> &scene, const CellMap<2> &map)
{
  return [&scene, map](const Point<2> &s)
  {
    Tensor<1, 2> force;
    for (unsigned int c = 0; c < 2; ++c)
      if (varies(scene.body_force[c]))
        force[c] = scene.body_force[c]->value(map.point(s));
    return std::abs(determinant(map.jacobian(s))) * force;
  };
}
} // namespace

template <int dim>
typename LoadRules<dim>::Pieces LoadRules<dim>::cut_cell(const Cell &cell) const
{
  const auto &n_cells = scene.geometry.subdivisions;
  BoxCutter cutter(force_in_cell(scene, map_of<dim>(cell)), tables->gauss(across),
                   {{n_parts(cell, 12, n_cells[0], 2), n_parts(cell, 12, n_cells[1], 2)}});
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
      const CutRule rule =
          cut_edge(*load[c], map, face, tables->gauss(along),
                   n_parts(cell, 32, scene.geometry.subdivisions[1 - face / 2], 4));
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
LoadRule<dim> LoadRules<dim>::body_force(const Cell &cell, const unsigned int degree) const
{
  const CellMap<dim> map = map_of<dim>(cell);
  return rule_on<dim>(
      pieces(cell, inside).boxes, degree, scene.body_force,
      [&](const Function<dim> &component, const Point<dim> &s)
      { return component.value(map.point(s)); },
      *tables);
}

template <int dim>
std::vector<UnresolvedLoad<dim>> LoadRules<dim>::unresolved(const Triangulation<dim> &mesh) const
{
  std::vector<UnresolvedLoad<dim>> result;
  const auto look = [&](const auto &cell, const unsigned int face, const std::string &name)
  {
    const auto known = coarse.find({coarse_index<Cell>(cell), face});
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

namespace
{
/** What an edge prescribes, by name. */
std::vector<std::pair<std::string, const Function<2> *>>
prescribed(const BoundaryCondition<2> &condition)
{
  std::vector<std::pair<std::string, const Function<2> *>> result;
  for (const auto &component : condition.displacement)
    if (varies(component))
      result.emplace_back("Displacement on " + condition.name, component.get());
  if (condition.is_unilateral() && varies(condition.gap))
    result.emplace_back("Gap on " + condition.name, condition.gap.get());
  return result;
}

/** The polynomial through @p values at @p nodes, at s. */
double interpolated(const std::vector<Point<1>> &nodes, const std::vector<double> &values,
                    const double s)
{
  double sum = 0;
  for (unsigned int i = 0; i < nodes.size(); ++i)
  {
    double basis = values[i];
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (k != i)
        basis *= (s - nodes[k][0]) / (nodes[i][0] - nodes[k][0]);
    sum += basis;
  }
  return sum;
}
} // namespace

template <int dim>
void LoadRules<dim>::cut_displacements(const Cell &cell, const unsigned int face)
{
  const CellMap<dim> map = map_of<dim>(cell);
  std::vector<double> cuts;
  for (const auto &[name, component] :
       prescribed(scene.boundaries[cell->face(face)->boundary_id()]))
  {
    const CutRule rule = cut_edge(*component, map, face, tables->gauss(along),
                                  n_parts(cell, 32, scene.geometry.subdivisions[1 - face / 2], 4));
    if (rule.cuts.size() > 2)
      cuts.insert(cuts.end(), rule.cuts.begin(), rule.cuts.end());
  }
  std::sort(cuts.begin(), cuts.end());
  if (!cuts.empty())
    displacement_cuts[{coarse_index(cell), face}] = cuts;
}

template <int dim>
std::vector<double> LoadRules<dim>::displacement_points(const Cell &cell,
                                                        const unsigned int face) const
{
  const auto known = displacement_cuts.find({coarse_index(cell), face});
  if (known == displacement_cuts.end())
    return {};
  const BoundingBox<dim> part = part_of_coarse(cell);
  const unsigned int d = 1 - face / 2;
  const std::vector<double> cuts =
      seen_from(part.lower_bound(d), part.side_length(d), known->second);
  std::vector<double> result;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
    for (const Point<1> &s : tables->gauss(along).get_points())
      result.push_back(cuts[k] + (cuts[k + 1] - cuts[k]) * s[0]);
  return result;
}

namespace
{
struct Range
{
  double least = 1e300, largest = -1e300;

  void take(const double value)
  {
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
};

/** The point where a component differs most from its interpolant; its values, too, join @p range. */
MissedDisplacement<2> worst_point(const Function<2> &component, const CellMap<2> &map,
                                  const unsigned int face, const std::vector<Point<1>> &nodes,
                                  const std::vector<double> &points, Range &range)
{
  const auto x = [&](const double s) { return map.point(point_on_face<2>(face, Point<1>(s))); };
  std::vector<double> at_nodes;
  for (const Point<1> &s : nodes)
    range.take(at_nodes.emplace_back(component.value(x(s[0]))));
  MissedDisplacement<2> result{{}, false, 0, x(0.5), 0., 0.};
  for (const double s : points)
  {
    const double value = component.value(x(s)), seen = interpolated(nodes, at_nodes, s);
    range.take(value);
    if (std::abs(value - seen) > std::abs(result.value - result.interpolated))
    {
      result.where = x(s);
      result.value = value;
      result.interpolated = seen;
    }
  }
  return result;
}
} // namespace

template <int dim>
std::vector<MissedDisplacement<dim>>
LoadRules<dim>::missed_displacements(const Triangulation<dim> &mesh, const Degrees &degrees) const
{
  std::vector<std::pair<MissedDisplacement<dim>, const Function<dim> *>> edges;
  std::map<const Function<dim> *, Range> ranges;
  if (displacement_cuts.empty())
    return {};
  for (const auto &cell : mesh.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face))
        for (const auto &[name, component] :
             prescribed(scene.boundaries[cell->face(face)->boundary_id()]))
        {
          const unsigned int index = cell->active_cell_index();
          edges.emplace_back(worst_point(*component, map_of<dim>(cell), face,
                                         tables->gauss_lobatto(degrees[index] + 1).get_points(),
                                         displacement_points(cell, face), ranges[component]),
                             component);
          edges.back().first.name = name;
          edges.back().first.is_gap = name[0] == 'G';
          edges.back().first.cell = index;
        }
  std::vector<MissedDisplacement<dim>> result;
  for (const auto &[worst, component] : edges)
  {
    const Range &range = ranges.at(component);
    // What does not vary along the side does so by round-off.
    const double round_off = 1e-10 * std::max(std::abs(range.largest), std::abs(range.least));
    if (std::abs(worst.value - worst.interpolated) >
        0.05 * (range.largest - range.least) + round_off)
      result.push_back(worst);
  }
  return result;
}

template <int dim>
const LoadSum &LoadRules<dim>::sum() const
{
  return total;
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
