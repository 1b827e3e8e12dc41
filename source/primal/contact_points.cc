// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/evaluation/contact_state.h>
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

template <int dim>
std::vector<MomentPoint<dim>> own_points(const MomentSpace<dim> &space, const DistributedVector &u,
                                         const std::vector<Tangential<dim>> &lambda)
{
  std::vector<MomentPoint<dim>> points;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned() || !cell->at_boundary())
      continue;
    const std::vector<bool> friction_faces = space.friction_faces(cell);
    for (const unsigned int face : cell->face_indices())
    {
      if (!cell->at_boundary(face) || !space.condition(cell, face).has_contact())
        continue;
      const CellField<dim> field = space.field(cell, u);
      for (unsigned int k = 0; k < space.tables.n_moments(); ++k)
      {
        points.push_back(point_on(space, cell, face, k, field));
        if (!friction_faces[face])
          continue;
        const unsigned int disc = space.first_disc(cell, face) + k;
        points.back().bound = space.discs[disc].bound;
        for (unsigned int s = 0; s < dim - 1; ++s)
          points.back().lambda[tangents<dim>(face)[s]] = lambda[disc][s];
        points.back().slips = points.back().bound == 0 || lambda[disc].norm() >= 1 - slip_tolerance;
      }
    }
  }
  return points;
}
} // namespace

template <int dim>
std::vector<MomentPoint<dim>> contact_points(const MomentSpace<dim> &space,
                                             const DistributedVector &u,
                                             const std::vector<Tangential<dim>> &lambda)
{
  std::vector<MomentPoint<dim>> points;
  for (const auto &part :
       Utilities::MPI::gather(space.communicator(), own_points(space, u, lambda)))
    points.insert(points.end(), part.begin(), part.end());
  std::sort(points.begin(), points.end(), before<dim>);
  return points;
}

template <int dim>
double friction_work(const MomentSpace<dim> &space, const DistributedVector &u)
{
  double sum = 0;
  for (const FrictionFace<dim> &face : space.faces)
  {
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
  return Utilities::MPI::sum(sum, space.communicator());
}

template std::vector<MomentPoint<2>> contact_points(const MomentSpace<2> &,
                                                    const DistributedVector &,
                                                    const std::vector<Tangential<2>> &);
template std::vector<MomentPoint<3>> contact_points(const MomentSpace<3> &,
                                                    const DistributedVector &,
                                                    const std::vector<Tangential<3>> &);
template double friction_work(const MomentSpace<2> &, const DistributedVector &);
template double friction_work(const MomentSpace<3> &, const DistributedVector &);
} // namespace hpvi
