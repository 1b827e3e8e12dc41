// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/body/cell_map.h>
#include <hpvi/contact/pairing.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double hair = 1e-9; ///< of an edge: round-off of ends that lie opposite to each other
} // namespace

template <int dim>
Pairing<dim>::Pairing(const Scene<dim> &scene, const DisplacementSpace<dim> &space)
{
  static_assert(dim == 2, "bodies that touch along a line");
  if (!scene.has_pairs())
    return;
  std::vector<std::vector<Face>> faces(scene.boundaries.size());
  std::vector<Tensor<1, dim>> tangents(scene.boundaries.size());
  for (const Cell &cell : space.dof_handler().active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary() && scene.boundaries[cell->face(f)->boundary_id()].pair)
      {
        const types::boundary_id id = cell->face(f)->boundary_id();
        faces[id].push_back({cell, f, space.degrees()[cell->active_cell_index()], 0., 0.});
        Point<dim> middle;
        middle = point_on_face<dim>(f, Point<dim - 1>(0.5));
        tangents[id] = -cross_product_2d(map_of<dim>(cell).normal(f, middle));
      }
  const auto n_multipliers = [&](const types::boundary_id id)
  {
    unsigned int sum = 0;
    for (const Face &face : faces[id])
      sum += std::max(0, static_cast<int>(face.degree) + scene.solver.multiplier_offset + 1);
    return sum;
  };
  for (const ContactPair &pair : scene.pairs)
  {
    const bool second_is_slave =
        pair.slave ? *pair.slave == 1 : n_multipliers(pair.parts[1]) > n_multipliers(pair.parts[0]);
    Masters masters{
        pair.parts[second_is_slave ? 1 : 0], pair.parts[second_is_slave ? 0 : 1], {}, {}};
    masters.along = tangents[pair.parts[0]];
    masters.faces = std::move(faces[masters.master]);
    for (Face &face : masters.faces)
    {
      face.begin = masters.along *
                   face.cell->vertex(GeometryInfo<dim>::face_to_cell_vertices(face.face_no, 0));
      face.end = masters.along *
                 face.cell->vertex(GeometryInfo<dim>::face_to_cell_vertices(face.face_no, 1));
    }
    pairs.push_back(std::move(masters));
  }
}

template <int dim>
bool Pairing<dim>::is_master(const types::boundary_id boundary) const
{
  return std::any_of(pairs.begin(), pairs.end(),
                     [&](const Masters &pair) { return pair.master == boundary; });
}

template <int dim>
std::vector<ContactSegment<dim>> Pairing<dim>::segments(const Cell &cell,
                                                        const unsigned int face_no) const
{
  std::vector<ContactSegment<dim>> result;
  const auto pair = std::find_if(pairs.begin(), pairs.end(),
                                 [&](const Masters &one)
                                 { return one.slave == cell->face(face_no)->boundary_id(); });
  if (pair == pairs.end())
    return result;
  std::array<double, 2> ends;
  for (const unsigned int end : {0, 1})
    ends[end] = pair->along * cell->vertex(GeometryInfo<dim>::face_to_cell_vertices(face_no, end));
  const auto on_slave = [&](const double place)
  { return std::clamp((place - ends[0]) / (ends[1] - ends[0]), 0., 1.); };
  for (const Face &face : pair->faces)
  {
    const double one = on_slave(face.begin), two = on_slave(face.end), begin = std::min(one, two),
                 end = std::max(one, two);
    if (end - begin < hair)
      continue;
    const auto on_master = [&](const double s)
    {
      const double place = ends[0] + s * (ends[1] - ends[0]);
      return std::clamp((place - face.begin) / (face.end - face.begin), 0., 1.);
    };
    result.push_back(
        {begin, end, face.cell, face.face_no, face.degree, on_master(begin), on_master(end)});
  }
  std::sort(result.begin(), result.end(),
            [](const auto &a, const auto &b) { return a.begin < b.begin; });
  for (unsigned int k = 0; k + 1 < result.size(); ++k) // round-off leaves no hole
    result[k].end = result[k + 1].begin;
  return result;
}

template class Pairing<2>;
} // namespace hpvi
