// SPDX-License-Identifier: LGPL-2.1-or-later

// Several steps of an hp method in one. What a step of hpa3 finds out about cells that it has made is known well enough beforehand:
// around a singular point the indicator falls by a constant factor from layer to layer, and away from it by another one from degree
// to degree. So cells are bisected, and their degrees raised, by what is expected of them, again and again without a solution between,
// until the expected indicator is below its target. What was expected wrongly shows in the indicator of the next step.
#include <hpvi/driver/strides.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
// Measured on eight scenes of prm/, cell by cell over all steps of hpa3 (doc/accuracy.md).
constexpr double smooth = 0.8;    ///< raise p where b is more
constexpr double of_degree = 0.8; ///< one degree more: eta * exp(-of_degree * b)
constexpr double exponent_of_vertex = 0.75,
                 exponent_of_end = 1.5;    ///< at a point: eta * 2^-a of a quarter,
constexpr double exponent_of_degree = 1.5; ///< and with a degree less eta * (p/(p-1))^a
constexpr double of_other_quarters = 0.04, decay_of_others = 1.2; ///< beside it
constexpr double of_smooth_quarter = 0.08;
constexpr double of_unknown_quarter = 0.3; ///< where nothing says what makes a cell rough
constexpr double places_of_end = 8;        ///< to how much of its edge an end is known
constexpr double outstanding = 2;          ///< a vertex, beside the others of its cell
constexpr double spread = 1.8;             ///< of the indicator, about its mean, in the end
constexpr double largest_growth = 4;       ///< of unknowns in a stride
constexpr unsigned int n_rounds = 16, n_levels_of_data = 2; ///< that unresolved data ask for

using Cell = Triangulation<2>::cell_iterator;

/** Where the solution is singular, or may be. */
struct SingularPoint
{
  Point<2> x;
  double exponent;
  types::boundary_id side =
      numbers::invalid_boundary_id; ///< inside of edges of this; none: a vertex
  double reach = 0;                 ///< edges as near as this have it
  double smallest = 0;              ///< no edge as short as this is bisected for it
};

double distance_to_edge(const Point<2> &x, const Cell &cell, const unsigned int f)
{
  const Point<2> a = cell->face(f)->vertex(0), b = cell->face(f)->vertex(1);
  const double s = std::clamp((x - a) * (b - a) / (b - a).norm_square(), 0., 1.);
  return x.distance(a + s * (b - a));
}

double edge_length(const Cell &cell, const unsigned int f)
{
  return cell->face(f)->vertex(0).distance(cell->face(f)->vertex(1));
}

bool has(const Cell &cell, const SingularPoint &point)
{
  if (point.side == numbers::invalid_boundary_id)
  {
    for (const unsigned int v : cell->vertex_indices())
      if (cell->vertex(v).distance(point.x) <= 1e-9 * cell->diameter())
        return true;
    return false;
  }
  for (const unsigned int f : cell->face_indices())
    if (cell->at_boundary(f) && cell->face(f)->boundary_id() == point.side &&
        edge_length(cell, f) > point.smallest && distance_to_edge(point.x, cell, f) <= point.reach)
      return true;
  return false;
}

// @sect3{Singular points}
//
// Known from the scene: vertices where sides or materials meet, and corners. Known from the solution: ends of zones.

/** What meets in a vertex of the coarse mesh. */
struct Meeting
{
  double angle = 0;
  std::set<types::boundary_id> sides;
  std::set<types::material_id> materials;

  bool is_singular() const
  {
    return materials.size() > 1 ||
           (!sides.empty() && (sides.size() > 1 || std::abs(angle - numbers::PI) > 0.05));
  }
};

/** Adds @p x inside edges of @p side, as far as it is known: to @p places of the edge next to it. */
void add_inside(const Triangulation<2> &mesh, const Point<2> &x, const types::boundary_id side,
                const double exponent, const double places, std::vector<SingularPoint> &points)
{
  double nearest = std::numeric_limits<double>::infinity(), length = 0;
  for (const auto &cell : mesh.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->at_boundary(f) && cell->face(f)->boundary_id() == side)
        if (const double distance = distance_to_edge(x, cell, f); distance < nearest)
        {
          nearest = distance;
          length = edge_length(cell, f);
        }
  if (nearest > length)
    return;
  const double within = places > 0 ? length / places : 1e-9 * length;
  points.push_back({x, exponent, side, nearest + within, places > 0 ? 1.01 * within : 0.});
}

std::vector<types::boundary_id> sides_of_contact(const Scene<2> &scene, const types::boundary_id id)
{
  std::vector<types::boundary_id> result{id};
  for (const BoundaryCondition<2> &other : scene.boundaries)
    if (other.id != id && other.pair && other.pair == scene.boundaries[id].pair)
      result.push_back(other.id);
  return result;
}

std::vector<SingularPoint> singular_points(const StrideStart &start)
{
  std::map<unsigned int, Meeting> meetings;
  std::map<unsigned int, Point<2>> places;
  for (const Cell &cell : start.mesh.cell_iterators_on_level(0))
    for (const unsigned int v : cell->vertex_indices())
    {
      Meeting &meeting = meetings[cell->vertex_index(v)];
      places[cell->vertex_index(v)] = cell->vertex(v);
      meeting.materials.insert(cell->material_id());
      const Tensor<1, 2> a = cell->vertex(v ^ 1) - cell->vertex(v),
                         b = cell->vertex(v ^ 2) - cell->vertex(v);
      meeting.angle += std::acos(std::clamp(a * b / (a.norm() * b.norm()), -1., 1.));
      for (const unsigned int f : {v % 2, 2 + v / 2})
        if (cell->at_boundary(f))
          meeting.sides.insert(cell->face(f)->boundary_id());
    }
  std::vector<SingularPoint> result;
  for (const auto &[vertex, meeting] : meetings)
    if (meeting.is_singular())
    {
      result.push_back({places[vertex], exponent_of_vertex});
      for (const types::boundary_id side : meeting.sides)
        for (const types::boundary_id other : sides_of_contact(start.scene, side))
          if (other != side) // a corner in the middle of the other body
            add_inside(start.mesh, places[vertex], other, exponent_of_vertex, 0, result);
    }
  for (const ContactState<2> &state : start.contact)
    for (const types::boundary_id side : sides_of_contact(start.scene, state.boundary))
      for (const Point<2> &end : state.transitions)
        add_inside(start.mesh, end, side, exponent_of_end, places_of_end, result);
  return result;
}

// @sect3{What is expected}
//
/** Of a cell. */
struct Outlook
{
  double eta = 0;
  double decay = 0;          ///< NaN: nobody has asked for it yet
  bool is_unknown = false;   ///< bisected, without a reason why it should be smooth now
  bool is_layer = false;     ///< a new quarter at or beside a singular point
  unsigned int n_levels = 0; ///< by which it is bisected, whatever is expected
  unsigned int solved = 0;   ///< of a cell of the solution: its index there
};

/** A mesh of which nothing is solved. */
class ExpectedMesh
{
public:
  explicit ExpectedMesh(const StrideStart &start, const Refinement &unresolved)
      : start(start), degrees_now(start.degrees), points(singular_points(start))
  {
    mesh_now.copy_triangulation(start.mesh);
    for (unsigned int cell = 0; cell < degrees_now.size(); ++cell)
      outlooks.push_back({start.eta[cell], std::numeric_limits<double>::quiet_NaN(), false, false,
                          unresolved.bisect[cell] ? n_levels_of_data : 0, cell});
    add_rough_vertices();
  }

  const Triangulation<2> &mesh() const
  {
    return mesh_now;
  }

  const Degrees &degrees() const
  {
    return degrees_now;
  }

  double eta() const
  {
    double sum = 0;
    for (const Outlook &outlook : outlooks)
      sum += outlook.eta * outlook.eta;
    return std::sqrt(sum);
  }

  /** Of displacements, about. */
  double n_unknowns() const
  {
    double sum = 0;
    for (const unsigned int p : degrees_now)
      sum += 2. * p * p;
    return sum;
  }

  /** Where more than @p share is expected. */
  Refinement marks(const double share)
  {
    const unsigned int maximum = start.scene.adaptivity.maximum_degree;
    Refinement result{std::vector<bool>(degrees_now.size()), degrees_now};
    for (unsigned int k = 0; k < degrees_now.size(); ++k)
    {
      Outlook &outlook = outlooks[k];
      if (outlook.n_levels > 0)
        result.bisect[k] = true;
      else if (outlook.eta > share && !outlook.is_unknown)
      {
        if (decay(outlook) > smooth && degrees_now[k] < maximum)
          result.degrees[k] = std::min(maximum, degrees_now[k] + degrees_more(outlook, share));
        else
          result.bisect[k] = true;
      }
    }
    return result;
  }

  /** Degrees fall towards singular points by one from layer to layer, for quarters begin with that of the whole. */
  Refinement lowered() const
  {
    Refinement result{std::vector<bool>(degrees_now.size()), degrees_now};
    for (unsigned int k = 0; k < degrees_now.size(); ++k)
      if (outlooks[k].is_layer && degrees_now[k] > start.scene.adaptivity.start_degree)
        --result.degrees[k];
    return result;
  }

  void refine(const Refinement &refinement)
  {
    std::map<std::pair<int, int>, unsigned int> before;
    for (const auto &cell : mesh_now.active_cell_iterators())
      before[{cell->level(), cell->index()}] = cell->active_cell_index();
    std::vector<Outlook> old = std::exchange(outlooks, {});
    const Degrees old_degrees =
        std::exchange(degrees_now, refine_mesh(mesh_now, degrees_now, refinement));
    outlooks.resize(degrees_now.size());
    for (const auto &cell : mesh_now.active_cell_iterators())
    {
      const unsigned int k = cell->active_cell_index();
      if (const auto same = before.find({cell->level(), cell->index()}); same != before.end())
        outlooks[k] = with_degree(old[same->second], old_degrees[same->second], degrees_now[k]);
      else
        outlooks[k] =
            of_quarter(cell, old[before.at({cell->parent()->level(), cell->parent()->index()})]);
    }
  }

private:
  double decay(Outlook &outlook) const
  {
    if (std::isnan(outlook.decay))
      outlook.decay = start.decay_rate(outlook.solved);
    return outlook.decay;
  }

  /** To come to @p share or half a degree from there, but at least one. */
  static unsigned int degrees_more(const Outlook &outlook, const double share)
  {
    return std::max(1., std::round(std::log(outlook.eta / share) / (of_degree * outlook.decay)));
  }

  Outlook with_degree(Outlook outlook, const unsigned int before, const unsigned int now) const
  {
    outlook.is_layer = false;
    if (before == now)
      return outlook;
    if (decay(outlook) > smooth)
      outlook.eta *= std::exp(of_degree * outlook.decay * (double(before) - now));
    else
      outlook.eta *= std::pow(double(before) / now, exponent_of_degree);
    return outlook;
  }

  Outlook of_quarter(const Cell &quarter, Outlook &whole) const
  {
    Outlook result;
    if (whole.n_levels > 1 && quarter->at_boundary())
      result.n_levels = whole.n_levels - 1;
    if (decay(whole) > smooth)
    {
      result.eta = of_smooth_quarter * whole.eta;
      result.decay = std::log(1 + 2 * (std::exp(whole.decay) - 1));
      return result;
    }
    bool is_beside = false;
    double at_point = 0;
    for (const SingularPoint &point : points)
      if (has(quarter, point))
        at_point = std::max(at_point, std::pow(2., -point.exponent));
      else
        is_beside = is_beside || has(quarter->parent(), point);
    result.is_layer = at_point > 0 || is_beside;
    result.is_unknown = at_point > 0 ? whole.is_unknown : !is_beside;
    result.decay = at_point == 0 && is_beside ? decay_of_others : 0.;
    result.eta = whole.eta * (at_point > 0 ? at_point
                              : is_beside  ? of_other_quarters
                                           : of_unknown_quarter);
    return result;
  }

  /** Of a vertex about which all cells are rough the least that one of them has of the indicator; else 0. */
  double least_about(const std::vector<unsigned int> &cells)
  {
    double result = std::numeric_limits<double>::infinity();
    for (const unsigned int cell : cells)
      result = decay(outlooks[cell]) > smooth ? 0. : std::min(result, start.eta[cell]);
    return result;
  }

  bool is_explained(const Cell &cell) const
  {
    return std::any_of(points.begin(), points.end(),
                       [&](const SingularPoint &point)
                       {
                         double distance = std::numeric_limits<double>::infinity();
                         for (const unsigned int f : cell->face_indices())
                           distance = std::min(distance, distance_to_edge(point.x, cell, f));
                         return point.smallest == 0 && distance < cell->diameter();
                       });
  }

  /**
   * What the scene does not tell: where all cells about a vertex are rough and large, and no other vertex of theirs is like it.
   * Cells near a point that is known are rough because of it. So the largest come first.
   */
  void add_rough_vertices()
  {
    const double large = 0.1 * *std::max_element(start.eta.begin(), start.eta.end());
    std::map<unsigned int, std::vector<unsigned int>> cells_at;
    std::vector<Cell> falling;
    for (const auto &cell : mesh_now.active_cell_iterators())
    {
      falling.push_back(cell);
      for (const unsigned int v : cell->vertex_indices())
        cells_at[cell->vertex_index(v)].push_back(cell->active_cell_index());
    }
    const auto eta_of = [&](const Cell &cell) { return start.eta[cell->active_cell_index()]; };
    std::stable_sort(falling.begin(), falling.end(),
                     [&](const Cell &a, const Cell &b) { return eta_of(a) > eta_of(b); });
    for (const Cell &cell : falling)
    {
      if (eta_of(cell) <= large)
        break;
      if (decay(outlooks[cell->active_cell_index()]) > smooth || is_explained(cell))
        continue;
      std::vector<std::pair<double, unsigned int>> vertices;
      for (const unsigned int v : cell->vertex_indices())
        vertices.emplace_back(least_about(cells_at[cell->vertex_index(v)]), v);
      std::sort(vertices.rbegin(), vertices.rend());
      if (vertices[0].first > outstanding * vertices[1].first)
        points.push_back({cell->vertex(vertices[0].second), exponent_of_vertex});
    }
  }

  const StrideStart &start;
  Triangulation<2> mesh_now;
  Degrees degrees_now;
  std::vector<Outlook> outlooks; ///< by active cell, like degrees
  std::vector<SingularPoint> points;
};
} // namespace

Refinement
stride(const StrideStart &start, const double part, const Refinement &unresolved,
       const std::function<void(const Triangulation<2> &, const Degrees &, Refinement &)> &complete)
{
  ExpectedMesh expected(start, unresolved);
  const double target = part * expected.eta(), most = largest_growth * expected.n_unknowns();
  std::optional<Refinement> result;
  const auto take = [&](Refinement marks)
  {
    complete(expected.mesh(), expected.degrees(), marks);
    if (!result)
      result = marks;
    else if (!marks.is_empty(expected.degrees()))
      result->then.emplace_back(marks, expected.degrees());
    const bool is_empty = marks.is_empty(expected.degrees());
    if (!is_empty)
      expected.refine(marks);
    return !is_empty;
  };
  for (unsigned int round = 0; round < n_rounds; ++round)
  {
    if (!take(expected.marks(spread * target / std::sqrt(double(expected.degrees().size())))))
      break;
    take(expected.lowered());
    if (expected.eta() <= target || expected.n_unknowns() > most)
      break;
  }
  return *result;
}

double part_of_stride(const double needed)
{
  constexpr double most = 0.1, margin = 0.75;
  if (needed <= 0)
    return most;
  const double n = std::max(1., std::ceil(std::log(needed) / std::log(most) - 0.3));
  return n == 1 ? margin * std::min(needed, 1.) : std::pow(needed, 1 / n);
}
} // namespace hpvi
