// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/results/shared_points.h>
#include <hpvi/scene/scene.h>

#include <deal.II/base/exceptions.h>

#include <numeric>

namespace hpvi
{
using namespace dealii;

template <int dim>
FacePoints<dim> face_points(const CellMap<dim> &map, const unsigned int face,
                            const ShapeTable<dim> &table, const bool is_axisymmetric)
{
  FacePoints<dim> result;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const bool is_known = q > 0 && map.is_affine();
    const double measure =
        is_known ? result.weights[0] / table.weights[0] : map.face_measure(face, table.points[q]);
    result.normals.push_back(is_known ? result.normals[0] : map.normal(face, table.points[q]));
    result.weights.push_back(table.weights[q] * measure);
  }
  for (unsigned int q = 0; q < result.weights.size() && is_axisymmetric; ++q)
    result.weights[q] *= full_turn(map.point(table.points[q]));
  return result;
}

template <int dim>
std::vector<unsigned int> shared_points(const CellMap<dim> &map, const ShapeTable<dim> &table,
                                        const CellMap<dim> &other_map, const ShapeTable<dim> &other)
{
  const unsigned int n = table.points.size();
  std::vector<unsigned int> result(n);
  std::iota(result.begin(), result.end(), 0);
  const auto own = [&](const unsigned int q) { return map.point(table.points[q]); };
  const auto place = [&](const unsigned int q) { return other_map.point(other.points[q]); };
  const double hair = 1e-6 * own(0).distance(own(n - 1));
  if (dim == 2 || (own(0).distance(place(0)) <= hair && own(1).distance(place(1)) <= hair))
    return result;
  for (unsigned int q = 0; q < n; ++q)
  {
    result[q] = n;
    for (unsigned int r = 0; r < n; ++r)
      if (own(q).distance(place(r)) <= hair)
        result[q] = r;
    AssertThrow(result[q] < n, ExcMessage("Two cells see other points on the face between them."));
  }
  return result;
}

template <int dim>
unsigned int shared_subface(const CellMap<dim> &map, const unsigned int face,
                            const CellMap<dim> &other_map, const unsigned int other_face,
                            const unsigned int known)
{
  if (dim == 2)
    return known;
  const auto corner = [](const CellMap<dim> &of_cell, const unsigned int f, const unsigned int v)
  { return of_cell.vertices()[GeometryInfo<dim>::face_to_cell_vertices(f, v)]; };
  for (unsigned int part = 0; part < GeometryInfo<dim>::max_children_per_face; ++part)
    for (unsigned int v = 0; v < GeometryInfo<dim>::vertices_per_face; ++v)
      if (corner(map, face, v).distance(corner(other_map, other_face, part)) <=
          1e-6 * map.shortest_edge()) // each part has one corner of the whole
        return part;
  return known;
}

template FacePoints<2> face_points(const CellMap<2> &, unsigned int, const ShapeTable<2> &, bool);
template FacePoints<3> face_points(const CellMap<3> &, unsigned int, const ShapeTable<3> &, bool);
template unsigned int shared_subface(const CellMap<2> &, unsigned int, const CellMap<2> &,
                                     unsigned int, unsigned int);
template unsigned int shared_subface(const CellMap<3> &, unsigned int, const CellMap<3> &,
                                     unsigned int, unsigned int);
template std::vector<unsigned int> shared_points(const CellMap<2> &, const ShapeTable<2> &,
                                                 const CellMap<2> &, const ShapeTable<2> &);
template std::vector<unsigned int> shared_points(const CellMap<3> &, const ShapeTable<3> &,
                                                 const CellMap<3> &, const ShapeTable<3> &);
} // namespace hpvi
