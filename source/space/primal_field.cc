// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/friction_rule.h>
#include <hpvi/space/primal_field.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <tuple>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** In the plane one boundary after the other, along the tangent; in space by boundary. */
template <int dim>
std::vector<std::pair<typename Field<dim>::Cell, unsigned int>>
contact_faces(const PrimalSpace<dim> &space)
{
  struct Place
  {
    typename Field<dim>::Cell cell;
    unsigned int face;
    types::boundary_id boundary;
    double along;
  };
  std::vector<Place> places;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && cell->at_boundary())
      for (const unsigned int face : cell->face_indices())
        if (cell->at_boundary(face) && space.condition(cell, face).has_contact() &&
            !space.is_master(space.condition(cell, face).id))
        {
          // t = (-n_y, n_x): up on the right, to the left on the top
          const double sign = (face == 0 || face == 3) ? -1. : 1.;
          places.push_back({cell, face, space.condition(cell, face).id,
                            dim == 2 ? sign * cell->face(face)->center()[1 - face / 2] : 0.});
        }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place &a, const Place &b)
                   { return std::tie(a.boundary, a.along) < std::tie(b.boundary, b.along); });
  std::vector<std::pair<typename Field<dim>::Cell, unsigned int>> result;
  for (const Place &place : places)
    result.emplace_back(place.cell, place.face);
  return result;
}
} // namespace

template <int dim>
PrimalField<dim>::PrimalField(const PrimalSpace<dim> &space, const ShapeTables<dim> &tables,
                              const DistributedVector &u,
                              const std::vector<ContactVector<dim>> &lambda)
    : PrimalField(space.scene, space, tables, {std::shared_ptr<void>(), &u},
                  {std::shared_ptr<void>(), &lambda})
{
}

template <int dim>
PrimalField<dim>::PrimalField(const Scene<dim> &scene, const PrimalSpace<dim> &space,
                              const ShapeTables<dim> &tables,
                              std::shared_ptr<const DistributedVector> u,
                              std::shared_ptr<const std::vector<ContactVector<dim>>> lambda)
    : Field<dim>(scene, tables, space.dof_handler), space(space), u(std::move(u)),
      lambda(std::move(lambda))
{
  for (const auto &[cell, face] : contact_faces(space))
  {
    this->add_face(cell, face);
    contact_dof_faces.push_back(space.moment_face(cell, face));
  }
  for (const BoxTables<dim> &own : space.tables.all)
  {
    moment_tables.emplace_back();
    for (const BoxTable<dim> &table : own.moment_points)
      moment_tables.back().push_back(tabulate<dim>(own.degree, table.points, table.weights, false));
  }
  if (!space.opposite)
    return;
  far = far_change = space.values_opposite(*this->u);
  if (space.past)
  {
    past_far = space.values_opposite(*space.past);
    std::transform(far.begin(), far.end(), past_far.begin(), far_change.begin(), std::minus<>());
  }
  find_exerted();
}

namespace
{
/** What a process that has a slave tells one that has its master. */
struct FarTraction
{
  unsigned int cell = 0, face = 0;
  Tensor<1, 3> normal;
  std::vector<Point<3>> references;
  std::vector<double> weights;
  std::vector<Tensor<1, 3>> tractions;

  template <class Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive &cell &face &normal &references &weights &tractions;
  }
};
} // namespace

/** Points at which residuals of the master are seen, at as many as of the slave. */
template <int dim>
void PrimalField<dim>::find_exerted()
{
  if constexpr (dim == 3)
  {
    const OppositeFaces &opposite = *space.opposite;
    std::map<unsigned int, std::vector<FarTraction>> messages;
    for (const FieldFace<dim> &face : this->faces())
      if (face.condition->pair && contact_dof_faces[face.number])
      {
        const ContactDofFace<3> &slave = *contact_dof_faces[face.number];
        for (const OppositeFaces::Part &part : opposite[number_of(face)].parts)
        {
          const MasterFace &master = opposite.masters[part.master];
          const unsigned int n_points =
              1 + std::max(face.degree(), space.tables.all[master.tables].degree);
          FarTraction message{master.cell, master.face, slave.axes.normal, {}, {}, {}};
          Tensor<1, 3> mean_normal;
          for (const auto &point : opposite.points_of(part, slave, n_points))
          {
            const ContactTraction<3> traction = this->traction(face, point.own);
            const FaceFrame<3> frame = face.frame(point.own);
            Tensor<1, 3> force = traction.pressure * frame.normal;
            for (unsigned int s = 0; s < 2; ++s)
              force += traction.friction[s] * frame.tangents[s];
            message.references.push_back(point.reference);
            message.weights.push_back(point.weight);
            message.tractions.push_back(force);
            mean_normal += point.weight * frame.normal;
          }
          if (slave.is_curved() && mean_normal.norm() > 0)
            message.normal = mean_normal / mean_normal.norm();
          messages[master.process].push_back(message);
        }
      }
    std::vector<Cell> cells; // by active_cell_index()
    for (const Cell &cell : this->dof_handler.active_cell_iterators())
      cells.push_back(cell);
    for (const auto &[process, received] :
         Utilities::MPI::some_to_some(space.communicator(), messages))
      for (const FarTraction &one : received)
        on_masters.push_back(
            {cells[one.cell], one.face, one.normal, one.references, one.weights, one.tractions});
  }
}

template <int dim>
unsigned int PrimalField<dim>::number_of(const FieldFace<dim> &face) const
{
  return contact_dof_faces[face.number] - space.faces.data();
}

template <int dim>
Tensor<1, dim> PrimalField<dim>::displacement_opposite(const FieldFace<dim> &face,
                                                       const Point<dim> &reference,
                                                       const Point<dim> &x,
                                                       const std::vector<double> &values) const
{
  if constexpr (dim == 3)
    if (const ContactDofFace<3> *const slave = contact_dof_faces[face.number];
        face.condition->pair && slave)
      return space.opposite->displacement(
          slave->is_curved()
              ? space.opposite->place_on_curve(number_of(face), face.map, face.face_no, reference)
              : space.opposite->place(number_of(face), x, slave->axes.normal),
          values);
  return {};
}

template <int dim>
Tensor<1, dim> PrimalField<dim>::opposite(const FieldFace<dim> &face,
                                          const Point<dim> &reference) const
{
  return displacement_opposite(face, reference, face.map.point(reference), far);
}

template <int dim>
Tensor<1, dim> PrimalField<dim>::change_opposite(const FieldFace<dim> &face,
                                                 const Point<dim> &reference) const
{
  return displacement_opposite(face, reference, face.map.point(reference), far_change);
}

template <int dim>
std::vector<types::material_id>
PrimalField<dim>::materials_opposite(const FieldFace<dim> &face) const
{
  std::vector<types::material_id> result;
  if (space.opposite && face.condition->pair && contact_dof_faces[face.number])
    for (const OppositeFaces::Part &part : (*space.opposite)[number_of(face)].parts)
      result.push_back(space.opposite->masters[part.master].material);
  return result;
}

template <int dim>
const std::vector<ExertedTraction<dim>> &PrimalField<dim>::exerted() const
{
  return on_masters;
}

template <int dim>
std::vector<double> PrimalField<dim>::coefficients(const Cell &cell) const
{
  const LocalNumbering &numbering = this->tables.numbering(this->degree(cell));
  std::vector<types::global_dof_index> dofs(numbering.shape.size());
  cell->get_dof_indices(dofs);
  std::vector<double> result(dofs.size());
  for (unsigned int i = 0; i < dofs.size(); ++i)
    result[numbering.component[i] * space.tables.of(cell).n_shapes + numbering.shape[i]] =
        (*u)(dofs[i]);
  return result;
}

template <int dim>
double PrimalField<dim>::largest_displacement() const
{
  return u->linfty_norm();
}

/** At Gauss point @p k. Contact dofs have the axes of the body, to which the tangent in the plane is parallel. */
template <int dim>
ContactTraction<dim> PrimalField<dim>::multiplier(const FieldFace<dim> &face,
                                                  const unsigned int k) const
{
  ContactTraction<dim> result;
  const ContactDofFace<dim> *const own = contact_dof_faces[face.number];
  if (own && own->has_friction())
  {
    const double sign = dim == 2 && (face.face_no == 0 || face.face_no == 3) ? -1. : 1.;
    result.friction =
        sign * space.contact[own->friction + k].bound_by(*lambda) * (*lambda)[own->friction + k];
  }
  if (own && own->has_pressure())
    result.pressure = (*lambda)[own->pressure + k][0];
  return result;
}

template <int dim>
ContactTraction<dim> PrimalField<dim>::traction(const FieldFace<dim> &face,
                                                const Point<dim> &reference) const
{
  ContactTraction<dim> result;
  const BoxTables<dim> &own_tables = tables_of(face);
  for (unsigned int k = 0; contact_dof_faces[face.number] && k < own_tables.n_contact_dofs(); ++k)
  {
    const double psi = own_tables.psi(k, face.face_no, reference);
    const ContactTraction<dim> own = multiplier(face, k);
    result.friction += psi * own.friction;
    result.pressure += psi * own.pressure;
  }
  return result;
}

template <int dim>
double PrimalField<dim>::bound(const FieldFace<dim> &face, const Point<dim> &reference) const
{
  const FrictionLaw<dim> &law = face.condition->friction;
  const ContactDofFace<dim> *const own = contact_dof_faces[face.number];
  double pressure = 0;
  for (unsigned int k = 0;
       law.knows_pressure() && own && own->has_pressure() && k < tables_of(face).n_contact_dofs();
       ++k)
    pressure += tables_of(face).psi(k, face.face_no, reference) * (*lambda)[own->pressure + k][0];
  const auto varies = [](const Expression<dim> &function)
  { return function && !is_constant<dim>(function); };
  const bool is_same = !varies(law.bound) && !varies(law.coefficient) && !law.by_pressure;
  return law.limit(is_same ? Point<dim>() : face.map.point(reference), pressure);
}

template <int dim>
Tangential<dim> PrimalField<dim>::past_slip(const FieldFace<dim> &face, const Point<dim> &x) const
{
  if (!space.past)
    return {};
  const CellField<dim> field = space.field(face.cell, *space.past);
  const std::optional<Point<dim>> found =
      face.map.is_affine()
          ? Point<dim>(invert(face.map.jacobian({})) * (x - face.map.vertices()[0]))
          : reference_of<dim>(face.cell, x);
  AssertThrow(found, ExcMessage("A point of a contact face lies outside of its cell."));
  const Point<dim> &reference = *found;
  Tensor<1, dim> u = -displacement_opposite(face, reference, x, past_far);
  for (unsigned int i = 0; i < field.size(); ++i) // the first component of shape i has its value
    u += tables_of(face).fe.shape_value(tables_of(face).numbers[i][0], reference) * field[i];
  return face.frame(reference).tangential(u);
}

template <int dim>
std::vector<double> PrimalField<dim>::friction_cuts(const FieldFace<dim> &face) const
{
  const unsigned int p = face.degree();
  if (!contact_dof_faces[face.number] || !contact_dof_faces[face.number]->has_friction())
    return {};
  if constexpr (dim == 2)
    return make_friction_rule(
               [&](const double s)
               {
                 return face.condition->friction.bound_at(
                     face.map.point(point_on_face<2>(face.face_no, Point<1>(s))));
               },
               this->tables.gauss(p + 1), 2 * p - 2)
        .cuts;
  else
    return {0., 1.};
}

template <int dim>
std::vector<MultiplierPoint<dim>> PrimalField<dim>::multiplier_points(const FieldFace<dim> &face,
                                                                      const double negligible) const
{
  const ShapeTable<dim> &table = multiplier_table(face);
  const ContactDofFace<dim> *const own = contact_dof_faces[face.number];
  const double area = face.area();
  std::vector<MultiplierPoint<dim>> result;
  for (unsigned int k = 0; k < table.points.size(); ++k)
  {
    const ContactTraction<dim> traction = multiplier(face, k);
    result.push_back(
        {table.points[k], own && own->own ? own->own->areas[k] : table.weights[k] * area,
         own && own->has_friction() && !face.condition->is_tied()
             ? space.contact[own->friction + k].bound_by(*lambda)
             : 0.,
         traction, face.condition->is_unilateral() && traction.pressure <= negligible});
  }
  return result;
}

template <int dim>
const ShapeTable<dim> &PrimalField<dim>::multiplier_table(const FieldFace<dim> &face) const
{
  return moment_tables[space.tables.number_of(face.cell)][face.face_no];
}

template <int dim>
std::vector<PressureValue<dim>> PrimalField<dim>::pressures(const FieldFace<dim> &face) const
{
  std::vector<PressureValue<dim>> result;
  const ContactDofFace<dim> *const own = contact_dof_faces[face.number];
  for (unsigned int k = 0; own && own->has_pressure() && k < tables_of(face).n_contact_dofs(); ++k)
    result.push_back({space.contact[own->pressure + k].x, (*lambda)[own->pressure + k][0]});
  return result;
}

template <int dim>
double PrimalField<dim>::contact_work() const
{
  const DistributedVector v = space.in_contact_dofs(*u);
  double sum = 0;
  for (unsigned int k = 0; k < space.contact.size(); ++k)
    sum += space.contact[k].area * space.contact[k].bound_by(*lambda) * (*lambda)[k] *
           (space.contact_value(v, k) - space.contact[k].gap);
  return Utilities::MPI::sum(sum, this->communicator());
}

template <int dim>
std::unique_ptr<const Field<dim>>
PrimalField<dim>::round_off_probe(const Scene<dim> &unloaded) const
{
  std::mt19937 random;
  std::uniform_real_distribution<double> uniform(-1., 1.);
  const auto bits = std::make_shared<DistributedVector>(space.ghosted_vector());
  std::vector<types::global_dof_index> dofs;
  for (const Cell &cell : this->dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      space.tables.take_dofs(cell, dofs);
      double largest = 0;
      for (const auto dof : dofs)
        largest = std::max(largest, std::abs((*u)(dof)));
      for (const auto dof : dofs)
        if (space.owned.is_element(dof))
          (*bits)(dof) = std::numeric_limits<double>::epsilon() * largest * uniform(random);
    }
  bits->update_ghost_values();
  return std::unique_ptr<const Field<dim>>(
      new PrimalField(unloaded, space, this->tables, bits,
                      std::make_shared<const std::vector<ContactVector<dim>>>(lambda->size())));
}

template class PrimalField<2>;
template class PrimalField<3>;
} // namespace hpvi
