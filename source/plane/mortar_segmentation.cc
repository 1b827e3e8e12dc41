// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/mortar_segmentation.h>
#include <hpvi/scene/edge_projection.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
double chord(const ExactFace &face)
{
  return face.path.ends[0].distance(face.path.ends[1]);
}

/** What lies behind another edge is not opposite; by the distances of the edges. */
template <int dim>
void drop_what_is_behind(std::vector<ContactSegment<dim>> &segments, std::vector<double> distances)
{
  for (unsigned int a = segments.size(); a-- > 0;)
    for (unsigned int b = 0; b < segments.size(); ++b)
      if (a != b && distances[b] < distances[a] &&
          std::min(segments[a].end, segments[b].end) -
                  std::max(segments[a].begin, segments[b].begin) >
              same_on_edge)
      {
        segments.erase(segments.begin() + a);
        distances.erase(distances.begin() + a);
        break;
      }
}
} // namespace

double ExactFace::on_path(const double s) const
{
  return is_reversed ? 1 - s : s;
}

double FacingFaces::opposite(const double s, const double near) const
{
  const double here = slave.on_path(s);
  const Point<2> x = slave.path.point(here);
  const auto place = place_opposite(master.path, x, slave.path.normal(here), master.on_path(near));
  return master.on_path(place ? place->s : master.path.nearest(x)); // round-off at an end
}

/** The vertices of a boundary face are points of its curve. */
template <int dim>
ExactFace MortarSegmentation<dim>::drawn(const Cell &cell, const unsigned int face_no)
{
  const auto end = [&](const unsigned int k)
  { return cell->vertex(GeometryInfo<dim>::face_to_cell_vertices(face_no, k)); };
  ExactFace result{{{{end(0), end(1)}}}, face_no == 0 || face_no == 3};
  if (const CellMap<dim> map = map_of<dim>(cell); map.is_curved() && map.blends()[face_no])
    result.path.curve = map.blends()[face_no].curve();
  if (result.is_reversed)
    result.path = result.path.reversed();
  return result;
}

template <int dim>
MortarSegmentation<dim>::MortarSegmentation(const Scene<dim> &scene,
                                            const DisplacementSpace<dim> &space)
{
  static_assert(dim == 2, "bodies that touch along a line");
  if (!scene.has_pairs())
    return;
  std::vector<std::vector<Face>> faces(scene.boundaries.size());
  for (const Cell &cell : space.dof_handler().active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary() && scene.boundaries[cell->face(f)->boundary_id()].pair)
        faces[cell->face(f)->boundary_id()].push_back(
            {cell, f, space.degrees()[cell->active_cell_index()], drawn(cell, f)});
  const auto n_multipliers = [&](const types::boundary_id id)
  {
    unsigned int sum = 0;
    for (const Face &face : faces[id])
      sum += std::max(0, static_cast<int>(face.degree) + scene.solver.multiplier_offset + 1);
    return sum;
  };
  /** Of the first side and, turned round, the other one; null where edges have several. */
  const auto direction = [&](const ContactPair &pair)
  {
    Tensor<1, dim> result;
    for (const unsigned int k : {0, 1})
      for (const Face &face : faces[pair.parts[k]])
      {
        const Tensor<1, dim> own =
            (k == 0 ? -1. : 1.) * cross_product_2d(face.drawn.path.normal(0.5));
        if (face.drawn.path.curve || (result.norm() > 0 && (own - result).norm() > same_normal))
          return Tensor<1, dim>();
        result = result.norm() > 0 ? result : own;
      }
    return result;
  };
  for (const ContactPair &pair : scene.pairs)
  {
    const bool second_is_slave =
        pair.slave ? *pair.slave == 1 : n_multipliers(pair.parts[1]) > n_multipliers(pair.parts[0]);
    ContactInterface masters{pair.parts[second_is_slave ? 1 : 0],
                             pair.parts[second_is_slave ? 0 : 1],
                             direction(pair),
                             {}};
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
bool MortarSegmentation<dim>::is_master(const types::boundary_id boundary) const
{
  return std::any_of(pairs.begin(), pairs.end(),
                     [&](const ContactInterface &pair) { return pair.master == boundary; });
}

/**
 * Neighbours take what is left out between them, and the ends of the side: where drawings end beside each other, all of a cell that is small enough
 * has the end of the other side opposite to it. A segment that is short is no reason to end another one: vertices of
 * two drawings of a curve lie beside each other by whatever their digits leave.
 */
template <int dim>
std::vector<ContactSegment<dim>> MortarSegmentation<dim>::segments(const Cell &cell,
                                                                   const unsigned int face_no) const
{
  const auto pair = std::find_if(pairs.begin(), pairs.end(),
                                 [&](const ContactInterface &one)
                                 { return one.slave == cell->face(face_no)->boundary_id(); });
  if (pair == pairs.end())
    return {};
  const ExactFace slave = drawn(cell, face_no);
  std::vector<ContactSegment<dim>> result =
      pair->along.norm() > 0 ? on_line(*pair, cell, face_no) : on_curve(*pair, slave);
  double covered = 0, length = 0;
  for (const ContactSegment<dim> &segment : result)
    covered += segment.end - segment.begin;
  for (const Face &face : pair->faces)
    length += chord(face.drawn);
  if (result.empty() && chord(slave) <= same_end * length) // all of a small cell hangs over
  {
    const Point<dim> x = slave.path.point(0.5);
    const auto beside = [&](const Face &face)
    { return face.drawn.path.point(face.drawn.path.nearest(x)).distance(x); };
    const Face &face =
        *std::min_element(pair->faces.begin(), pair->faces.end(),
                          [&](const Face &a, const Face &b) { return beside(a) < beside(b); });
    const double end = face.drawn.on_path(face.drawn.path.nearest(x));
    return {{0, 1, face.cell, face.face_no, face.degree, end, end,
             pair->along.norm() > 0
                 ? nullptr
                 : std::make_shared<const FacingFaces>(FacingFaces{slave, face.drawn})}};
  }
  if (result.empty() || (1 - covered) * chord(slave) > same_end * length)
    throw NumericalFailure("an edge of a body at " + to_string(slave.path.point(0.5)) +
                           " lies opposite to no edge of the other one along a part of its length; "
                           "give both bodies more edges there");
  std::sort(result.begin(), result.end(),
            [](const auto &a, const auto &b) { return a.begin < b.begin; });
  for (unsigned int k = 0; k + 1 < result.size(); ++k)
    result[k].end = result[k + 1].begin;
  result.front().begin = 0;
  result.back().end = 1;
  return result;
}

template <int dim>
std::vector<ContactSegment<dim>> MortarSegmentation<dim>::on_line(const ContactInterface &pair,
                                                                  const Cell &cell,
                                                                  const unsigned int face_no)
{
  std::vector<ContactSegment<dim>> result;
  std::vector<double> distances;
  std::array<double, 2> ends;
  for (const unsigned int end : {0, 1})
    ends[end] = pair.along * cell->vertex(GeometryInfo<dim>::face_to_cell_vertices(face_no, end));
  const auto on_slave = [&](const double place)
  { return std::clamp((place - ends[0]) / (ends[1] - ends[0]), 0., 1.); };
  for (const Face &face : pair.faces)
  {
    const double one = on_slave(face.begin), two = on_slave(face.end), begin = std::min(one, two),
                 end = std::max(one, two);
    if (end - begin < same_on_edge)
      continue;
    const auto on_master = [&](const double s)
    {
      const double place = ends[0] + s * (ends[1] - ends[0]);
      return std::clamp((place - face.begin) / (face.end - face.begin), 0., 1.);
    };
    result.push_back(
        {begin, end, face.cell, face.face_no, face.degree, on_master(begin), on_master(end)});
    distances.push_back(std::abs(cross_product_2d(pair.along) *
                                 (face.drawn.path.ends[0] - cell->face(face_no)->vertex(0))));
  }
  drop_what_is_behind(result, distances);
  return result;
}

/**
 * X goes along the normal of the slave, so that a vertex of the master lies opposite to the point of the slave that is nearest to it. An
 * edge on the far side of a ring seems to lie between two such places as well: the normal in their middle tells.
 */
template <int dim>
std::vector<ContactSegment<dim>> MortarSegmentation<dim>::on_curve(const ContactInterface &pair,
                                                                   const ExactFace &slave)
{
  std::vector<ContactSegment<dim>> result;
  std::vector<double> distances;
  for (const Face &face : pair.faces)
  {
    const auto on_slave = [&](const unsigned int end)
    { return slave.on_path(slave.path.nearest(face.drawn.path.ends[end])); };
    const double one = on_slave(0), two = on_slave(1), begin = std::min(one, two),
                 end = std::max(one, two);
    if (end - begin < same_on_edge)
      continue;
    const double middle = slave.on_path((begin + end) / 2);
    const auto place =
        place_opposite(face.drawn.path, slave.path.point(middle), slave.path.normal(middle));
    if (!place)
      continue;
    const auto both = std::make_shared<const FacingFaces>(FacingFaces{slave, face.drawn});
    const double near = face.drawn.on_path(place->s);
    result.push_back({begin, end, face.cell, face.face_no, face.degree, both->opposite(begin, near),
                      both->opposite(end, near), both});
    distances.push_back(std::abs(place->distance));
  }
  drop_what_is_behind(result, distances);
  return result;
}

template class MortarSegmentation<2>;
} // namespace hpvi
