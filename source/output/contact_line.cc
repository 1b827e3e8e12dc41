// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/contact_line.h>
#include <hpvi/output/contact_table.h>
#include <hpvi/output/vtk_file.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/side_normals.h>

#include <algorithm>
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
      : slave(scene.boundaries[state.slave]), normal(sides[state.slave]),
        sign(state.slave == state.boundary ? 1. : -1.)
  {
  }

  /** Of its components. */
  Tensor<1, dim> vector(const ContactPoint<dim> &point, const double normal_part,
                        const Tangential<dim> &tangential_part) const
  {
    const Tensor<1, dim> n = sign * slave.held_direction(normal(point.x));
    if constexpr (dim == 2)
      return normal_part * n - tangential_part * cross_product_2d(n);
    else
      return normal_part * n + tangential_part;
  }

private:
  const BoundaryCondition<dim> &slave;
  const SideNormals<dim> normal;
  const double sign;
};

/** Components along the axes of space; what is one number in the plane stays one. */
std::vector<double> tuple(const double number)
{
  return {number};
}

template <int dim>
std::vector<double> tuple(const Tensor<1, dim> &vector)
{
  std::vector<double> components(3);
  for (unsigned int d = 0; d < dim; ++d)
    components[d] = vector[d];
  return components;
}

/** Appends to the array of this name, which is made at the first point. */
template <class Number>
void add(std::vector<VtkArray> &arrays, const std::string &name, const std::vector<Number> &numbers,
         const std::string &unit = "")
{
  auto array = std::find_if(arrays.begin(), arrays.end(),
                            [&](const VtkArray &one) { return one.name == name; });
  if (array == arrays.end())
    array = arrays.insert(array, vtk_array(name, std::vector<Number>(), numbers.size(), unit));
  array->bytes += vtk_array(name, numbers).bytes;
}

template <int dim>
void add_point(const ContactPoint<dim> &point, const ContactState<dim> &state,
               const Scene<dim> &scene, const Frames<dim> &frames, std::vector<VtkArray> &arrays)
{
  const std::string &length = scene.length_unit, &stress = scene.stress_unit;
  const bool has_gap = scene.boundaries[state.boundary].contact != Contact::tangential;
  const auto vector = [&](const double normal_part, const Tangential<dim> &tangential_part)
  { return tuple(frames.vector(point, normal_part, tangential_part)); };
  add(arrays, "displacement", vector(point.normal_displacement, point.tangential_displacement),
      length);
  add(arrays, "traction", vector(point.normal_traction, point.tangential_traction), stress);
  add(arrays, "gap", tuple(has_gap ? point.gap : std::numeric_limits<double>::quiet_NaN()), length);
  add(arrays, "normal_traction", tuple(point.normal_traction), stress);
  add(arrays, "tangential_traction", tuple(point.tangential_traction), stress);
  add(arrays, "multiplier", tuple(point.lambda));
  add(arrays, "state", std::vector<int>{int(point.mode())});
  add(arrays, "boundary", std::vector<int>{int(state.boundary)});
  add(arrays, "weight", tuple(point.area));
  if (scene.has_load_history())
    add(arrays, "slip", tuple(point.slip), length);
  if (scene.has_pairs())
    add(arrays, "jump", vector(point.normal_jump, point.tangential_jump), length);
}

/** A column of contact-history.csv each; the wear where something wears. */
template <int dim>
void add_history(const ContactState<dim> &state, const Scene<dim> &scene,
                 const std::vector<ContactHistory> &history, std::vector<VtkArray> &arrays)
{
  const bool has_wear = std::any_of(scene.boundaries.begin(), scene.boundaries.end(),
                                    [](const auto &boundary) { return boundary.wear > 0; });
  for (const ContactHistory &own : history)
    if (own.boundary == state.boundary && own.points.size() == state.points.size())
      for (const PointHistory &point : own.points)
        for (const auto &[name, value] : history_record(point, scene.boundaries[own.boundary].wear))
          if (has_wear || name != "wear_depth")
            add(arrays, name,
                tuple(number(value).value_or(std::numeric_limits<double>::quiet_NaN())));
}
} // namespace

template <int dim>
std::string contact_line(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                         const unsigned int step, const std::vector<ContactHistory> &history)
{
  VtkGrid grid(step);
  const std::vector<Side<dim>> sides = sides_of(scene);
  for (const ContactState<dim> &state : contact)
  {
    const int first = int(grid.points.size() / 3);
    const Frames<dim> frames(scene, state, sides);
    const std::vector<double> lengths = arc_lengths(state);
    for (unsigned int k = 0; k < state.points.size(); ++k)
    {
      const std::vector<double> x = tuple(state.points[k].x);
      grid.points.insert(grid.points.end(), x.begin(), x.end());
      add_point(state.points[k], state, scene, frames, grid.point_data);
      if (dim == 2)
        add(grid.point_data, "arc_length", tuple(lengths[k]), scene.length_unit);
      else
        grid.add_cell(VtkCell::vertex, {first + int(k)});
    }
    add_history(state, scene, history, grid.point_data);
    for (const Piece &piece : pieces_of(state))
    {
      std::vector<int> nodes(piece.last - piece.first);
      std::iota(nodes.begin(), nodes.end(), first + int(piece.first));
      grid.add_cell(nodes.size() == 1 ? VtkCell::vertex : VtkCell::poly_line, nodes);
    }
  }
  return grid.vtu();
}

template std::string contact_line(const Scene<2> &, const std::vector<ContactState<2>> &,
                                  unsigned int, const std::vector<ContactHistory> &);
template std::string contact_line(const Scene<3> &, const std::vector<ContactState<3>> &,
                                  unsigned int, const std::vector<ContactHistory> &);
} // namespace hpvi
