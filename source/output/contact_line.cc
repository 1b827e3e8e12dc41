// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/contact_line.h>
#include <hpvi/output/contact_table.h>
#include <hpvi/output/vtk_file.h>
#include <hpvi/scene/boundary_parts.h>

#include <functional>
#include <limits>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Points that follow each other without a gap. */
struct Piece
{
  unsigned int first, last; ///< of ContactState::points; the last one is not its own
};

/** Chains are known where one process has all of them; on several, whose boundaries are straight, a gap shows by its width. */
template <int dim>
std::vector<Piece> pieces_of(const ContactState<dim> &state)
{
  const unsigned int n = state.points.size();
  std::vector<Piece> pieces;
  if (dim == 3)
    return pieces;
  if (!state.chains.empty() && state.chains.back().last_point == n)
  {
    for (const ContactChain<dim> &chain : state.chains)
      pieces.push_back({chain.first_point, chain.last_point});
    return pieces;
  }
  for (unsigned int k = 0; k < n; ++k)
  {
    const bool goes_on =
        k > 0 && state.points[k].x.distance(state.points[k - 1].x) <=
                     0.5001 * (state.points[k - 1].face_length + state.points[k].face_length);
    if (!goes_on)
      pieces.push_back({k, k});
    pieces.back().last = k + 1;
  }
  return pieces;
}

/** From the beginning of the boundary to each point. */
template <int dim>
std::vector<double> arc_lengths(const ContactState<dim> &state)
{
  std::vector<double> result;
  Point<dim> before = state.begin;
  double length = 0;
  for (const ContactPoint<dim> &point : state.points)
  {
    length += before.distance(point.x);
    before = point.x;
    result.push_back(length);
  }
  return result;
}

/** n or `Contact direction` d, and t, at points of a contact boundary: those of the first side of a pair. */
template <int dim>
class Frames
{
public:
  Frames(const Scene<dim> &scene, const ContactState<dim> &state,
         const std::vector<Side<dim>> &sides)
      : slave(scene.boundaries[state.slave]), side(sides[state.slave]),
        sign(state.slave == state.boundary ? 1. : -1.)
  {
  }

  /** Of its components. */
  Tensor<1, dim> vector(const ContactPoint<dim> &point, const double normal_part,
                        const Tangential<dim> &tangential_part) const
  {
    const Tensor<1, dim> n = sign * slave.held_direction(side.normal(point.x));
    if constexpr (dim == 2)
      return normal_part * n - tangential_part * cross_product_2d(n);
    else
      return normal_part * n + tangential_part;
  }

private:
  const BoundaryCondition<dim> &slave;
  const Side<dim> &side;
  const double sign;
};

/** Arrays by point, filled point by point. */
template <int dim>
class Columns
{
public:
  explicit Columns(const Scene<dim> &scene) : scene(scene)
  {
  }

  void add(const ContactPoint<dim> &point, const ContactState<dim> &state,
           const Frames<dim> &frames)
  {
    const bool has_gap = scene.boundaries[state.boundary].contact != Contact::tangential;
    add(displacement,
        frames.vector(point, point.normal_displacement, point.tangential_displacement));
    add(traction, frames.vector(point, point.normal_traction, point.tangential_traction));
    add(jump, frames.vector(point, point.normal_jump, point.tangential_jump));
    gap.push_back(has_gap ? point.gap : std::numeric_limits<double>::quiet_NaN());
    normal_traction.push_back(point.normal_traction);
    modes.push_back(int(point.mode()));
    boundaries.push_back(int(state.boundary));
    weight.push_back(point.area);
    add(tangential_traction, point.tangential_traction);
    add(slip, point.slip);
    add(multiplier, point.lambda);
  }

  std::vector<VtkArray> arrays() const
  {
    const std::string &length = scene.length_unit, &stress = scene.stress_unit;
    const unsigned int n = dim == 2 ? 1 : 3; // components of what is tangential
    std::vector<VtkArray> result{vtk_array("displacement", displacement, 3, length),
                                 vtk_array("traction", traction, 3, stress),
                                 vtk_array("gap", gap, 1, length),
                                 vtk_array("normal_traction", normal_traction, 1, stress),
                                 vtk_array("tangential_traction", tangential_traction, n, stress),
                                 vtk_array("multiplier", multiplier, n),
                                 vtk_array("state", modes),
                                 vtk_array("boundary", boundaries),
                                 vtk_array("weight", weight)};
    if (scene.has_load_history())
      result.push_back(vtk_array("slip", slip, n, length));
    if (scene.has_pairs())
      result.push_back(vtk_array("jump", jump, 3, length));
    return result;
  }

private:
  static void add(std::vector<double> &column, const double number)
  {
    column.push_back(number);
  }

  static void add(std::vector<double> &column, const Tensor<1, dim> &vector)
  {
    for (unsigned int d = 0; d < 3; ++d)
      column.push_back(d < dim ? vector[d] : 0.);
  }

  const Scene<dim> &scene;
  std::vector<double> displacement, traction, jump, gap, normal_traction, tangential_traction, slip,
      multiplier, weight;
  std::vector<int> modes, boundaries;
};

/** A column of contact-history.csv each; what stays empty is left out. */
template <int dim>
std::vector<VtkArray> history_arrays(const Scene<dim> &scene,
                                     const std::vector<ContactState<dim>> &contact,
                                     const std::vector<ContactHistory> &history)
{
  std::vector<std::pair<std::string, std::vector<double>>> columns;
  bool has_wear = false;
  for (const ContactState<dim> &state : contact)
    for (const ContactHistory &own : history)
    {
      if (own.boundary != state.boundary || own.points.size() != state.points.size())
        continue;
      const double wear = scene.boundaries[state.boundary].wear;
      has_wear = has_wear || wear > 0;
      for (const PointHistory &point : own.points)
      {
        const Record record = history_record(point, wear);
        columns.resize(record.size());
        for (std::size_t k = 0; k < record.size(); ++k)
        {
          columns[k].first = record[k].first;
          columns[k].second.push_back(
              number(record[k].second).value_or(std::numeric_limits<double>::quiet_NaN()));
        }
      }
    }
  std::vector<VtkArray> arrays;
  for (const auto &[name, values] : columns)
    if (has_wear || name != "wear_depth")
      arrays.push_back(vtk_array(name, values));
  return arrays;
}
} // namespace

template <int dim>
std::string contact_line(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                         const unsigned int step, const std::vector<ContactHistory> &history)
{
  VtkGrid grid(step);
  Columns<dim> columns(scene);
  std::vector<double> lengths;
  const std::vector<Side<dim>> sides = sides_of(scene);
  for (const ContactState<dim> &state : contact)
  {
    const int first = int(grid.points.size() / 3);
    const Frames<dim> frames(scene, state, sides);
    for (const ContactPoint<dim> &point : state.points)
    {
      for (unsigned int d = 0; d < 3; ++d)
        grid.points.push_back(d < dim ? point.x[d] : 0.);
      columns.add(point, state, frames);
    }
    const std::vector<double> of_state = arc_lengths(state);
    lengths.insert(lengths.end(), of_state.begin(), of_state.end());
    if (dim == 3)
      for (unsigned int k = 0; k < state.points.size(); ++k)
        grid.add_cell(VtkCell::vertex, {first + int(k)});
    for (const Piece &piece : pieces_of(state))
    {
      std::vector<int> nodes(piece.last - piece.first);
      std::iota(nodes.begin(), nodes.end(), first + int(piece.first));
      grid.add_cell(nodes.size() == 1 ? VtkCell::vertex : VtkCell::poly_line, nodes);
    }
  }
  grid.point_data = columns.arrays();
  if (dim == 2)
    grid.point_data.push_back(vtk_array("arc_length", lengths, 1, scene.length_unit));
  for (const VtkArray &array : history_arrays(scene, contact, history))
    grid.point_data.push_back(array);
  return grid.vtu();
}

template std::string contact_line(const Scene<2> &, const std::vector<ContactState<2>> &,
                                  unsigned int, const std::vector<ContactHistory> &);
template std::string contact_line(const Scene<3> &, const std::vector<ContactState<3>> &,
                                  unsigned int, const std::vector<ContactHistory> &);
} // namespace hpvi
