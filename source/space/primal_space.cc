// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/input_error.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/face_axes.h>
#include <hpvi/scene/slave_side.h>
#include <hpvi/scene/space_motion.h>
#include <hpvi/space/consistent_constraints.h>
#include <hpvi/space/primal_space.h>
#include <hpvi/space/support_constraints.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Supports are functions, which may fail on one process. */
template <int dim>
bool agreed_rests_on_contact(const Scene<dim> &scene, MPI_Comm communicator)
{
  bool result = false;
  collectively(communicator, [&]() { result = rests_on_contact(scene); });
  return result;
}
} // namespace

template <int dim>
PrimalSpace<dim>::PrimalSpace(const Scene<dim> &scene, const Mesh &mesh,
                              const DegreeTables<dim> &tables)
    : scene(scene), tables(tables),
      rests_on_contact(agreed_rests_on_contact(scene, mesh.get_communicator())), dof_handler(mesh)
{
  if constexpr (dim == 3)
    if (scene.has_pairs())
      collectively(communicator(),
                   [&]()
                   {
                     masters = masters_of(scene);
                     opposite_to_any = opposite_boundaries(scene);
                     curved = curved_pairs(scene);
                   });
  number();
  collectively(communicator(),
               [&]() { constrain_supports(scene, dof_handler, tables, relevant, constraints); });
  plates = constrain_plates(scene, dof_handler, tables, relevant, constraints);
  make_consistent(constraints, owned, relevant, communicator());
  collectively(communicator(), [this]() { find_contact(); });
  find_opposite_faces();
  types::global_dof_index constrained = 0;
  for (const auto i : owned)
    constrained += constraints.is_constrained(i);
  n_free = dof_handler.n_dofs() - Utilities::MPI::sum(constrained, communicator());
  types::global_dof_index own_discs = 0, own_pressures = 0;
  for (const ContactDofFace<dim> &face : faces)
  {
    const BoundaryCondition<dim> &boundary = condition(face.cell, face.face);
    const unsigned int n = tables.of(face.cell).n_contact_dofs();
    own_discs += boundary.friction || boundary.is_tied() ? n : 0;
    own_pressures += face.has_pressure() ? n : 0;
  }
  n_discs = Utilities::MPI::sum(own_discs, communicator());
  n_pressures = Utilities::MPI::sum(own_pressures, communicator());
}

/** The components of a node one after the other, as multigrid wants them. */
template <int dim>
void PrimalSpace<dim>::number()
{
  tables.distribute_dofs(dof_handler);
  owned = dof_handler.locally_owned_dofs();
  std::vector<types::global_dof_index> dofs,
      renumbered(owned.n_elements(), numbers::invalid_dof_index);
  types::global_dof_index next = owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0;
  for (const Cell &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      for (const auto &components : tables.take_dofs(cell, dofs).numbers)
        for (unsigned int c = 0; c < dim; ++c)
          if (const auto index = dofs[components[c]]; owned.is_element(index))
            if (auto &number = renumbered[owned.index_within_set(index)];
                number == numbers::invalid_dof_index)
              number = next++;
    }
  dof_handler.renumber_dofs(renumbered);
  owned = dof_handler.locally_owned_dofs();
  DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
}

template <int dim>
void PrimalSpace<dim>::find_contact()
{
  std::vector<types::global_dof_index> dofs;
  for (const Cell &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && cell->at_boundary())
    {
      tables.take_dofs(cell, dofs);
      for (const unsigned int number : cell->face_indices())
      {
        if (!cell->at_boundary(number))
          continue;
        const BoundaryCondition<dim> &boundary = condition(cell, number);
        if (!has_normal_contact_dofs(boundary) && !has_tangential_contact_dofs(boundary))
          continue;
        ContactDofFace<dim> face = face_of(cell, number);
        if (has_tangential_contact_dofs(boundary))
        {
          face.friction = contact.size();
          add_contact_dofs(face,
                           boundary.is_tied() ? ContactDof<dim>::Kind::glue
                                              : ContactDof<dim>::Kind::friction,
                           dofs);
        }
        if (has_normal_contact_dofs(boundary))
        {
          face.pressure = contact.size();
          add_contact_dofs(face,
                           boundary.is_unilateral() ? ContactDof<dim>::Kind::pressure
                                                    : ContactDof<dim>::Kind::reaction,
                           dofs);
        }
        face_numbers[{cell->active_cell_index(), number}] = faces.size();
        faces.push_back(face);
      }
    }
}

/** Where bodies touch each other. */
template <int dim>
void PrimalSpace<dim>::find_opposite_faces()
{
  if constexpr (dim == 3)
    if (!masters.empty())
      opposite = std::make_unique<const OppositeFaces>(scene, dof_handler, tables, constraints,
                                                       faces, opposite_to_any);
  if (opposite)
    for (unsigned int number = 0; number < faces.size(); ++number)
      if (is_in_curved_pair(condition(faces[number].cell, faces[number].face)))
        take_moments_of_parts(number);
}

/** Of a face in a curved pair, whose contact dofs are integrated where something lies opposite. */
template <int dim>
void PrimalSpace<dim>::take_moments_of_parts(const unsigned int number)
{
  ContactDofFace<dim> &face = faces[number];
  if constexpr (dim == 3)
  {
    const OppositeFaces::OwnMoments &own = (*opposite)[number].own;
    face.own = own.contact_dofs;
    for (const unsigned int first : {face.friction, face.pressure})
      for (unsigned int k = 0; first != numbers::invalid_unsigned_int && k < own.centroids.size();
           ++k)
      {
        ContactDof<3> &contact_dof = contact[first + k];
        contact_dof.centroid = own.centroids[k];
        contact_dof.area = own.contact_dofs->areas[k];
        contact_dof.weight = contact_dof.bound * contact_dof.area;
      }
  }
}

/** Faces of a mesh from a file have directions of their own, as `Contact direction` has, and measures. */
template <int dim>
ContactDofFace<dim> PrimalSpace<dim>::face_of(const Cell &cell, const unsigned int number) const
{
  ContactDofFace<dim> face;
  face.cell = cell;
  face.face = number;
  const BoundaryCondition<dim> &boundary = condition(cell, number);
  if (!scene.geometry.has_mesh())
  {
    Tensor<1, dim> normal;
    normal[number / 2] = number % 2 == 0 ? -1. : 1.;
    face.axes = contact_axes(boundary.held_direction(normal));
    return face;
  }
  const CellMap<dim> map = map_of<dim>(cell);
  const BoxTables<dim> &own = tables.of(cell);
  if (map.is_curved() || is_in_curved_pair(boundary))
  {
    const auto axes = [&](const Point<dim> &x) { return axes_of_face(map, number, x, boundary); };
    face.own = std::make_shared<const FaceContactDofs>(own.curved_moments_of(map, number, axes));
    for (const Point<dim> &x : own.moment_points[number].points)
      face.turning.push_back(axes(x));
    face.axes = face.turning[face.turning.size() / 2];
    face.axes.axis = ContactAxes<dim>::none; // all components are contact dofs
    return face;
  }
  const auto corner = [&](const unsigned int v)
  {
    return GeometryInfo<dim>::unit_cell_vertex(GeometryInfo<dim>::face_to_cell_vertices(number, v));
  };
  face.axes = contact_axes(boundary.held_direction(map.normal(number, corner(0))));
  const double area = map.face_area(number);
  for (unsigned int v = 0; v < GeometryInfo<dim>::vertices_per_face && !face.own; ++v)
    if (std::abs(map.face_measure(number, corner(v)) - area) > same_box * area)
      face.own = std::make_shared<const FaceContactDofs>(own.moments_of(map, number));
  return face;
}

template <int dim>
void PrimalSpace<dim>::add_contact_dofs(const ContactDofFace<dim> &face,
                                        const typename ContactDof<dim>::Kind kind,
                                        const std::vector<types::global_dof_index> &dofs)
{
  const BoxTables<dim> &tables = this->tables.of(face.cell);
  const BoxTable<dim> &table = tables.moment_points[face.face];
  const CellMap<dim> map = map_of<dim>(face.cell);
  for (unsigned int k = 0; k < tables.n_contact_dofs(); ++k)
  {
    const auto unknown = [&](const unsigned int component)
    { return owned.index_within_set(dofs[tables.numbers[tables.inner[face.face][k]][component]]); };
    ContactDof<dim> contact_dof;
    contact_dof.kind = kind;
    contact_dof.x = contact_dof.centroid = map.point(table.points[k]);
    if (face.own) // which of a parallelogram is the Gauss point
      contact_dof.centroid = Point<dim>(
          mean<Tensor<1, dim>>(face, k, [](const Point<dim> &x) -> Tensor<1, dim> { return x; }));
    contact_dof.area = face.own ? face.own->areas[k] : table.weights[k] * map.face_area(face.face);
    for (unsigned int s = 0; contact_dof.is_tangential() && s < dim - 1; ++s)
      contact_dof.unknowns[s] = unknown(face.tangential(s));
    if (contact_dof.is_friction())
    {
      const FrictionLaw<dim> &law = condition(face.cell, face.face).friction;
      contact_dof.limit = law.at(contact_dof.x);
      contact_dof.bound = contact_dof.limit.limit(0.);
      if (law.knows_pressure()) // pressures follow all frictions of a face
        contact_dof.partner = contact.size() + tables.n_contact_dofs();
    }
    else if (!contact_dof.is_tangential())
    {
      if (condition(face.cell, face.face).gap)
        contact_dof.gap[0] =
            mean<double>(face, k, [&](const Point<dim> &x) { return gap_at(face, x); });
      contact_dof.sign = face.sign();
      contact_dof.unknowns.fill(unknown(face.normal()));
    }
    contact_dof.weight = contact_dof.bound * contact_dof.area;
    contact.push_back(contact_dof);
  }
}

/** `int psi_k f / int psi_k` by p+2 points a direction, as in the plane. */
template <int dim>
template <typename Value>
Value PrimalSpace<dim>::mean(const ContactDofFace<dim> &face, const unsigned int k,
                             const std::function<Value(const Point<dim> &)> &f) const
{
  const BoxTables<dim> &tables = this->tables.of(face.cell);
  const QGauss<dim - 1> rule(tables.degree + 2);
  const CellMap<dim> map = map_of<dim>(face.cell);
  const double area = face.own ? face.own->areas[k] : tables.moment_points[face.face].weights[k];
  Value result{};
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const Point<dim> unit = point_on_face<dim>(face.face, rule.point(q));
    const double ds = face.own ? map.face_measure(face.face, unit) : 1.;
    result += rule.weight(q) * ds * tables.psi(k, face.face, unit) / area * f(map.point(unit));
  }
  return result;
}

template <int dim>
double PrimalSpace<dim>::gap_at(const ContactDofFace<dim> &face, const Point<dim> &x) const
{
  const BoundaryCondition<dim> &boundary = condition(face.cell, face.face);
  const double gap = boundary.gap->value(x);
  if (!std::isfinite(gap))
  {
    std::ostringstream line;
    line << "Boundary " << boundary.name << "/Gap: is " << gap << " at (" << x
         << "); give a gap that is finite everywhere";
    throw InputError(line.str());
  }
  return gap;
}

template <int dim>
MPI_Comm PrimalSpace<dim>::communicator() const
{
  return dof_handler.get_communicator();
}

template <int dim>
DistributedVector PrimalSpace<dim>::owned_vector() const
{
  return DistributedVector(owned, communicator());
}

template <int dim>
DistributedVector PrimalSpace<dim>::ghosted_vector() const
{
  return DistributedVector(owned, relevant, communicator());
}

/** All components at nodes of a face, one component after the other. */
template <int dim>
Vector<double> PrimalSpace<dim>::components_at(const BoxTables<dim> &tables,
                                               const std::vector<types::global_dof_index> &dofs,
                                               const std::vector<unsigned int> &shapes,
                                               const DistributedVector &u) const
{
  Vector<double> result(dim * shapes.size());
  for (unsigned int i = 0; i < result.size(); ++i)
    result[i] = u(dofs[tables.numbers[shapes[i % shapes.size()]][i / shapes.size()]]);
  return result;
}

template <int dim>
DistributedVector PrimalSpace<dim>::displacement(const DistributedVector &v) const
{
  DistributedVector complete = v;
  constraints.distribute(complete);
  DistributedVector u = ghosted_vector();
  u.copy_locally_owned_data_from(complete);
  u.update_ghost_values();
  std::vector<types::global_dof_index> dofs;
  const std::vector<double> far = values_opposite(complete);
  for (unsigned int number = 0; number < faces.size(); ++number)
  {
    const ContactDofFace<dim> &face = faces[number];
    const BoxTables<dim> &tables = this->tables.take_dofs(face.cell, dofs);
    const auto dof = [&](const unsigned int shape, const unsigned int component)
    { return dofs[tables.numbers[shape][component]]; };
    const unsigned int n = tables.n_contact_dofs();
    const FaceContactDofs &contact_dofs = contact_dofs_on(face);
    const auto &inner_shapes = tables.inner[face.face], &rim_shapes = tables.rim[face.face];
    if (face.is_curved())
    {
      Vector<double> of_inner = components_at(tables, dofs, inner_shapes, u), all(of_inner.size());
      contact_dofs.W.vmult(all, components_at(tables, dofs, rim_shapes, u));
      of_inner -= all;
      of_inner += moments_opposite(number, far);
      contact_dofs.M_inverse.vmult(all, of_inner);
      for (unsigned int i = 0; i < all.size(); ++i)
        complete(dof(inner_shapes[i % n], i / n)) = all[i];
      continue;
    }
    Vector<double> rest(n), inner(n);
    for (const unsigned int c : face.components())
    {
      for (unsigned int k = 0; k < n; ++k)
      {
        rest[k] = face.axes.is_rotated() ? 0. : u(dof(inner_shapes[k], c));
        for (unsigned int own = 0; face.axes.is_rotated() && own < dim; ++own)
          rest[k] += face.direction(own)[c] * u(dof(inner_shapes[k], own));
        for (unsigned int j = 0; j < rim_shapes.size(); ++j)
          rest[k] -= contact_dofs.W(k, j) * u(dof(rim_shapes[j], c));
        rest[k] += moment_opposite(number, k, far)[c];
      }
      contact_dofs.M_inverse.vmult(inner, rest);
      for (unsigned int k = 0; k < n; ++k)
        complete(dof(inner_shapes[k], c)) = inner[k];
    }
  }
  u.zero_out_ghost_values();
  u.copy_locally_owned_data_from(complete);
  u.update_ghost_values();
  return u;
}

template <int dim>
std::vector<double> PrimalSpace<dim>::values_opposite(const DistributedVector &u) const
{
  std::vector<double> result;
  if (opposite)
    opposite->nodal().take(u.begin(), result);
  return result;
}

template <int dim>
Tensor<1, dim> PrimalSpace<dim>::moment_opposite(const unsigned int face, const unsigned int k,
                                                 const std::vector<double> &far) const
{
  Tensor<1, dim> result;
  if (opposite)
    for (const OppositeFaces::Row &row : (*opposite)[face].rows)
      for (unsigned int c = 0; c < dim; ++c)
        result[c] += row.moments[k] * far[opposite->nodal_place(row.node, c)];
  return result;
}

template <int dim>
Vector<double> PrimalSpace<dim>::moments_opposite(const unsigned int face,
                                                  const std::vector<double> &far) const
{
  Vector<double> result(dim * tables.of(faces[face].cell).n_contact_dofs());
  if constexpr (dim == 3)
    if (opposite)
      for (const OppositeFaces::Row &row : (*opposite)[face].rows)
        for (unsigned int i = 0; i < row.turned.size(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            result[i] += row.turned[i][c] * far[opposite->nodal_place(row.node, c)];
  return result;
}

template <int dim>
DistributedVector PrimalSpace<dim>::in_contact_dofs(const DistributedVector &u) const
{
  DistributedVector v = owned_vector();
  v.copy_locally_owned_data_from(u);
  std::vector<types::global_dof_index> dofs;
  const std::vector<double> far = values_opposite(u);
  for (unsigned int number = 0; number < faces.size(); ++number)
  {
    const ContactDofFace<dim> &face = faces[number];
    const CellField<dim> field = this->field(face.cell, u);
    const FaceContactDofs &contact_dofs = contact_dofs_on(face);
    const BoxTables<dim> &tables = this->tables.take_dofs(face.cell, dofs);
    const auto dof = [&](const unsigned int shape, const unsigned int component)
    { return dofs[tables.numbers[shape][component]]; };
    if (face.is_curved())
    {
      const auto &inner_shapes = tables.inner[face.face];
      Vector<double> m(dim * inner_shapes.size());
      contact_dofs.M.vmult(m, components_at(tables, dofs, inner_shapes, u));
      contact_dofs.W.vmult_add(m, components_at(tables, dofs, tables.rim[face.face], u));
      m -= moments_opposite(number, far);
      for (unsigned int i = 0; i < m.size(); ++i)
        v(dof(inner_shapes[i % inner_shapes.size()], i / inner_shapes.size())) = m[i];
      continue;
    }
    for (unsigned int k = 0; k < tables.n_contact_dofs(); ++k)
    {
      Tensor<1, dim> m = -moment_opposite(number, k, far);
      for (unsigned int j = 0; j < tables.n_contact_dofs(); ++j)
        m += contact_dofs.M(k, j) * field[tables.inner[face.face][j]];
      for (unsigned int j = 0; j < contact_dofs.W.n(); ++j)
        m += contact_dofs.W(k, j) * field[tables.rim[face.face][j]];
      for (const unsigned int c : face.components())
        v(dof(tables.inner[face.face][k], c)) = m * face.direction(c);
    }
  }
  constraints.set_zero(v);
  return v;
}

template <int dim>
ContactVector<dim> PrimalSpace<dim>::contact_value(const DistributedVector &v,
                                                   const unsigned int k) const
{
  ContactVector<dim> result;
  for (unsigned int s = 0; s < contact[k].n_unknowns(); ++s)
    result[s] = contact[k].sign * v.local_element(contact[k].unknowns[s]);
  return result;
}

template <int dim>
void PrimalSpace<dim>::add_contact_value(DistributedVector &v, const unsigned int k,
                                         const ContactVector<dim> &value) const
{
  for (unsigned int s = 0; s < contact[k].n_unknowns(); ++s)
    v.local_element(contact[k].unknowns[s]) += contact[k].sign * value[s];
}

template <int dim>
void PrimalSpace<dim>::set_contact_value(DistributedVector &v, const unsigned int k,
                                         const ContactVector<dim> &value) const
{
  for (unsigned int s = 0; s < contact[k].n_unknowns(); ++s)
    v.local_element(contact[k].unknowns[s]) = contact[k].sign * value[s];
}

template <int dim>
void PrimalSpace<dim>::count_slip_from(const DistributedVector &u)
{
  past = u;
  past->update_ghost_values();
  const DistributedVector v = in_contact_dofs(u);
  for (unsigned int k = 0; k < contact.size(); ++k)
    if (contact[k].is_friction())
      contact[k].gap = contact_value(v, k);
}

template <int dim>
CellField<dim> PrimalSpace<dim>::field(const Cell &cell, const DistributedVector &u) const
{
  std::vector<types::global_dof_index> dofs;
  const BoxTables<dim> &own = tables.take_dofs(cell, dofs);
  CellField<dim> result(own.n_shapes);
  for (unsigned int i = 0; i < own.n_shapes; ++i)
    for (unsigned int c = 0; c < dim; ++c)
      result[i][c] = u(dofs[own.numbers[i][c]]);
  return result;
}

template <int dim>
Tensor<1, dim> PrimalSpace<dim>::extent(const typename Triangulation<dim>::cell_iterator &cell)
{
  return cell->vertex(GeometryInfo<dim>::vertices_per_cell - 1) - cell->vertex(0);
}

template <int dim>
const BoundaryCondition<dim> &PrimalSpace<dim>::condition(const Cell &cell,
                                                          const unsigned int face) const
{
  return scene.boundaries[cell->face(face)->boundary_id()];
}

template <int dim>
std::vector<bool>
PrimalSpace<dim>::moment_components(const typename Triangulation<dim>::cell_iterator &cell) const
{
  std::vector<bool> result(dim * GeometryInfo<dim>::faces_per_cell, false);
  for (const unsigned int face : cell->face_indices())
  {
    if (!cell->at_boundary(face))
      continue;
    const BoundaryCondition<dim> &boundary = scene.boundaries[cell->face(face)->boundary_id()];
    for (unsigned int c = 0; c < dim; ++c)
      result[dim * face + c] =
          c == face / 2 ? has_normal_contact_dofs(boundary) : has_tangential_contact_dofs(boundary);
  }
  return result;
}

template <int dim>
const ContactDofFace<dim> *PrimalSpace<dim>::moment_face(const Cell &cell,
                                                         const unsigned int face) const
{
  const auto found = face_numbers.find({cell->active_cell_index(), face});
  return found == face_numbers.end() ? nullptr : &faces[found->second];
}

template class PrimalSpace<2>;
template class PrimalSpace<3>;
} // namespace hpvi
