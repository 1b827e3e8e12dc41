// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/primal/contact_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

namespace
{
/** All but the multiplier at Gauss point @p k of a face. */
template <int dim>
MomentPoint<dim> point_on(const MomentSpace<dim> &space,
                          const typename MomentSpace<dim>::Cell &cell, const unsigned int face,
                          const unsigned int k, const CellField<dim> &field)
{
  const BoxTable<dim> &table = space.tables.moment_points[face];
  const BoundaryCondition<dim> &condition = space.condition(cell, face);
  MomentPoint<dim> point;
  point.x = MomentSpace<dim>::point_of(cell, table.points[k]);
  point.boundary = condition.id;
  point.area = table.weights[k] * cell->face(face)->measure();
  point.displacement = value(table, k, field);
  point.gap = condition.gap_at(point.x) - point.normal_sign() * point.displacement[point.axis()];
  const SymmetricTensor<2, dim> sigma =
      HookesLaw<dim>(space.scene.material_of(cell))
          .stress(gradient(table, k, field, MomentSpace<dim>::extent(cell)));
  const auto &load = condition.traction[point.axis()];
  point.normal_traction =
      sigma[point.axis()][point.axis()] - (load ? point.normal_sign() * load->value(point.x) : 0.);
  return point;
}

template <int dim>
bool before(const MomentPoint<dim> &a, const MomentPoint<dim> &b)
{
  if (a.boundary != b.boundary)
    return a.boundary < b.boundary;
  return std::lexicographical_compare(a.x.begin_raw(), a.x.end_raw(), b.x.begin_raw(),
                                      b.x.end_raw());
}

/** What the multipliers say at Gauss point @p k of a face; a pressure that is round-off beside the largest is none. */
template <int dim>
void add_multipliers(const MomentSpace<dim> &space, const MomentFace<dim> &face,
                     const unsigned int k, const std::vector<ContactVector<dim>> &lambda,
                     const double negligible, MomentPoint<dim> &point)
{
  if (face.has_friction())
  {
    const ContactVector<dim> &own = lambda[face.friction + k];
    point.bound = space.contact[face.friction + k].bound;
    for (unsigned int s = 0; s < dim - 1; ++s)
      point.lambda[tangents<dim>(face.face)[s]] = own[s];
    point.slips = point.bound == 0 || own.norm() >= 1 - slip_tolerance;
  }
  if (face.has_pressure())
  {
    const double pressure = lambda[face.pressure + k][0];
    point.normal_traction = 0. - pressure; // never -0
    point.is_open = pressure <= negligible;
  }
}

/** As in the plane. */
template <int dim>
double negligible_pressure(const MomentSpace<dim> &space,
                           const std::vector<ContactVector<dim>> &lambda)
{
  double largest = 0;
  for (unsigned int k = 0; k < lambda.size(); ++k)
    if (!space.contact[k].is_friction())
      largest = std::max(largest, lambda[k][0]);
  return 1e-10 * Utilities::MPI::max(largest, space.communicator());
}

template <int dim>
std::vector<MomentPoint<dim>> own_points(const MomentSpace<dim> &space, const DistributedVector &u,
                                         const std::vector<ContactVector<dim>> &lambda,
                                         const double negligible)
{
  std::vector<MomentPoint<dim>> points;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned() || !cell->at_boundary())
      continue;
    for (const unsigned int number : cell->face_indices())
    {
      if (!cell->at_boundary(number) || !space.condition(cell, number).has_contact())
        continue;
      const CellField<dim> field = space.field(cell, u);
      const MomentFace<dim> *const face = space.moment_face(cell, number);
      for (unsigned int k = 0; k < space.tables.n_moments(); ++k)
      {
        points.push_back(point_on(space, cell, number, k, field));
        if (face)
          add_multipliers(space, *face, k, lambda, negligible, points.back());
      }
    }
  }
  return points;
}

/** `sum w g |u_t|` over the faces of this process. */
template <int dim>
double own_friction_work(const MomentSpace<dim> &space, const DistributedVector &u)
{
  double sum = 0;
  for (const MomentFace<dim> &face : space.faces)
  {
    if (!face.has_friction())
      continue;
    const BoxTable<dim> &table = space.tables.faces[face.face];
    const Expression<dim> &g = space.condition(face.cell, face.face).friction.bound;
    const CellField<dim> field = space.field(face.cell, u);
    for (unsigned int q = 0; q < table.points.size(); ++q)
    {
      Tensor<1, dim> slip = value(table, q, field);
      slip[face.face / 2] = 0;
      sum += table.weights[q] * face.cell->face(face.face)->measure() *
             g->value(MomentSpace<dim>::point_of(face.cell, table.points[q])) * slip.norm();
    }
  }
  return sum;
}

/** The deepest of this process, by boundary. */
template <int dim>
std::vector<Penetration<dim>> own_penetrations(const MomentSpace<dim> &space,
                                               const DistributedVector &u)
{
  std::vector<Penetration<dim>> own(space.scene.boundaries.size());
  for (const MomentFace<dim> &face : space.faces)
  {
    if (!face.has_pressure())
      continue;
    const BoundaryCondition<dim> &condition = space.condition(face.cell, face.face);
    const BoxTable<dim> &table = space.tables.faces[face.face];
    const CellField<dim> field = space.field(face.cell, u);
    for (unsigned int q = 0; q < table.points.size(); ++q)
    {
      const Point<dim> x = MomentSpace<dim>::point_of(face.cell, table.points[q]);
      const double depth =
          space.contact[face.pressure].sign * value(table, q, field)[face.face / 2] -
          condition.gap_at(x);
      if (depth > own[condition.id].depth)
        own[condition.id] = {depth, x};
    }
  }
  return own;
}
} // namespace

template <int dim>
std::vector<MomentPoint<dim>> contact_points(const MomentSpace<dim> &space,
                                             const DistributedVector &u,
                                             const std::vector<ContactVector<dim>> &lambda)
{
  const double negligible = negligible_pressure(space, lambda);
  std::vector<MomentPoint<dim>> own, points;
  together(space.communicator(), [&]() { own = own_points(space, u, lambda, negligible); });
  for (const auto &part : Utilities::MPI::gather(space.communicator(), own))
    points.insert(points.end(), part.begin(), part.end());
  std::sort(points.begin(), points.end(), before<dim>);
  return points;
}

template <int dim>
double friction_work(const MomentSpace<dim> &space, const DistributedVector &u)
{
  return sum_together(space.communicator(), [&]() { return own_friction_work(space, u); });
}

template <int dim>
std::vector<Penetration<dim>> penetrations(const MomentSpace<dim> &space,
                                           const DistributedVector &u)
{
  std::vector<Penetration<dim>> own;
  together(space.communicator(), [&]() { own = own_penetrations(space, u); });
  std::vector<Penetration<dim>> result(own.size());
  for (const auto &part : Utilities::MPI::all_gather(space.communicator(), own))
    for (unsigned int b = 0; b < result.size(); ++b)
      if (part[b].depth > result[b].depth)
        result[b] = part[b];
  return result;
}

template std::vector<Penetration<2>> penetrations(const MomentSpace<2> &,
                                                  const DistributedVector &);
template std::vector<Penetration<3>> penetrations(const MomentSpace<3> &,
                                                  const DistributedVector &);
template std::vector<MomentPoint<2>> contact_points(const MomentSpace<2> &,
                                                    const DistributedVector &,
                                                    const std::vector<ContactVector<2>> &);
template std::vector<MomentPoint<3>> contact_points(const MomentSpace<3> &,
                                                    const DistributedVector &,
                                                    const std::vector<ContactVector<3>> &);
template double friction_work(const MomentSpace<2> &, const DistributedVector &);
template double friction_work(const MomentSpace<3> &, const DistributedVector &);
} // namespace hpvi
