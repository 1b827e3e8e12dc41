// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/inverse_map.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/face_axes.h>
#include <hpvi/results/field.h>
#include <hpvi/results/values_at.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/mapping_q1.h>

#include <limits>
#include <utility>

namespace hpvi
{
using namespace dealii;

template <int dim>
Tangential<dim> FaceFrame<dim>::tangential(const Tensor<1, dim - 1> &components) const
{
  if constexpr (dim == 2)
    return components[0];
  else
  {
    Tensor<1, dim> result;
    for (unsigned int s = 0; s < dim - 1; ++s)
      result += components[s] * tangents[s];
    return result;
  }
}

template <int dim>
Tangential<dim> FaceFrame<dim>::tangential(const Tensor<1, dim> &u) const
{
  if constexpr (dim == 2)
    return tangents[0] * u;
  else
    return u - (normal * u) * normal;
}

template <int dim>
unsigned int FieldFace<dim>::degree() const
{
  return cell->get_fe().degree;
}

template <int dim>
double FieldFace<dim>::area() const
{
  return map.face_area(face_no);
}

template <int dim>
FaceFrame<dim> FieldFace<dim>::frame(const Point<dim> &reference) const
{
  FaceFrame<dim> result;
  result.x = map.point(reference);
  result.measure =
      map.face_measure(face_no, reference) * (is_axisymmetric ? full_turn(result.x) : 1.);
  if constexpr (dim == 2)
  {
    result.normal = condition->held_direction(map.normal(face_no, reference));
    result.tangents = {{-cross_product_2d(result.normal)}};
  }
  else
  {
    const ContactAxes<dim> axes = axes_of_face(map, face_no, reference, *condition);
    result.normal = axes.normal;
    result.tangents = axes.tangents;
  }
  return result;
}

template <int dim>
Field<dim>::Field(const Scene<dim> &scene, const ShapeTables<dim> &tables,
                  const DoFHandler<dim> &dof_handler)
    : scene(scene), tables(tables), dof_handler(dof_handler)
{
}

template <int dim>
MPI_Comm Field<dim>::communicator() const
{
  return dof_handler.get_communicator();
}

template <int dim>
unsigned int Field<dim>::degree(const Cell &cell) const
{
  return cell->get_fe().degree;
}

template <int dim>
void Field<dim>::add_face(const Cell &cell, const unsigned int face_no)
{
  const unsigned int number = contact_faces.size();
  contact_faces.push_back({cell, face_no, &scene.boundaries[cell->face(face_no)->boundary_id()],
                           map_of<dim>(cell), number, scene.is_axisymmetric()});
}

template <int dim>
std::vector<ContactSegment<dim>> Field<dim>::segments(const FieldFace<dim> &) const
{
  return {};
}

template <int dim>
Tensor<1, dim> Field<dim>::change_opposite(const FieldFace<dim> &, const Point<dim> &) const
{
  return {};
}

template <int dim>
std::vector<types::material_id> Field<dim>::materials_opposite(const FieldFace<dim> &face) const
{
  std::vector<types::material_id> result;
  for (const ContactSegment<dim> &segment : segments(face))
    result.push_back(segment.cell->material_id());
  return result;
}

template <int dim>
const std::vector<ExertedTraction<dim>> &Field<dim>::exerted() const
{
  return nothing_exerted;
}

template <int dim>
Tensor<1, dim> Field<dim>::opposite(const FieldFace<dim> &, const Point<dim> &) const
{
  return {};
}

template <int dim>
const std::vector<FieldFace<dim>> &Field<dim>::faces() const
{
  return contact_faces;
}

template <int dim>
std::optional<Point<dim>> reference_of(const typename DoFHandler<dim>::active_cell_iterator &cell,
                                       const Point<dim> &x)
{
  if (const CellMap<dim> map = map_of<dim>(cell); map.is_curved())
    return inverse_of(map, x, same_on_edge);
  if (!cell->bounding_box().point_inside(x, same_on_edge))
    return std::nullopt;
  try
  {
    const Point<dim> reference = StaticMappingQ1<dim>::mapping.transform_real_to_unit_cell(cell, x);
    if (GeometryInfo<dim>::is_inside_unit_cell(reference, same_on_edge))
      return GeometryInfo<dim>::project_to_unit_cell(reference);
  }
  catch (const typename Mapping<dim>::ExcTransformationFailed &) // far outside a distorted cell
  {
  }
  return std::nullopt;
}

template <int dim>
std::vector<PointValue<dim>> Field<dim>::values(const Cell &cell,
                                                const std::vector<Point<dim>> &references) const
{
  return values_at(
      *this, cell,
      tabulate<dim>(degree(cell), references, std::vector<double>(references.size(), 1.), false));
}

/** Where cells meet and stresses differ the first cell of the first process has a say. */
template <int dim>
std::optional<PointValue<dim>> Field<dim>::at(const Point<dim> &x) const
{
  std::optional<PointValue<dim>> own;
  for (const Cell &cell : dof_handler.active_cell_iterators())
    if (!own && cell->is_locally_owned())
      if (const auto reference = reference_of<dim>(cell, x))
        own = values(cell, {*reference}).front();
  const unsigned int n = n_processes(communicator()), rank = rank_of(communicator()),
                     first = Utilities::MPI::min(own ? rank : n, communicator());
  if (first == n)
    return std::nullopt;
  if (n == 1)
    return own;
  std::pair<Tensor<1, dim>, std::pair<SymmetricTensor<2, dim>, double>> parts;
  if (own)
    parts = {own->displacement, {own->stress, own->across}};
  parts = Utilities::MPI::broadcast(communicator(), parts, first);
  return PointValue<dim>{parts.first, parts.second.first, parts.second.second};
}

template struct FaceFrame<2>;
template struct FaceFrame<3>;
template struct FieldFace<2>;
template struct FieldFace<3>;
template std::optional<Point<2>> reference_of(const DoFHandler<2>::active_cell_iterator &,
                                              const Point<2> &);
template std::optional<Point<3>> reference_of(const DoFHandler<3>::active_cell_iterator &,
                                              const Point<3> &);
template class Field<2>;
template class Field<3>;
} // namespace hpvi
