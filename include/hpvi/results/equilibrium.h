// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_equilibrium_h
#define hpvi_equilibrium_h

#include <hpvi/plane/elastic_system.h>
#include <hpvi/plane/solution.h>

#include <mpi.h>

#include <string>
#include <type_traits>
#include <vector>

namespace hpvi
{
/** Of a force about a point [stress length^dim]: a number in the plane. */
template <int dim>
using Moment = std::conditional_t<dim == 2, double, dealii::Tensor<1, dim>>;

/** Of @p force with this arm. */
inline double moment_of(const dealii::Tensor<1, 2> &arm, const dealii::Tensor<1, 2> &force)
{
  return arm[0] * force[1] - arm[1] * force[0];
}

inline dealii::Tensor<1, 3> moment_of(const dealii::Tensor<1, 3> &arm,
                                      const dealii::Tensor<1, 3> &force)
{
  return dealii::cross_product_3d(arm, force);
}

/** What one boundary exerts on the body through its supports and its contact, without loads. */
template <int dim>
struct BoundaryForce
{
  std::string boundary; ///< its name
  dealii::Tensor<1, dim>
      force;            ///< [stress length^(dim-1)]; of an axisymmetric body x and moment are NaN
  Moment<dim> moment{}; ///< about Equilibrium::centre
  dealii::types::boundary_id id =
      dealii::numbers::invalid_boundary_id; ///< of the boundary, where it is one
};

/** What became of a rigid plate. */
template <int dim>
struct PlateState
{
  dealii::types::boundary_id boundary;
  dealii::Point<dim> centre;           ///< c, the mean point of the boundary
  dealii::Tensor<1, dim> displacement; ///< U, that of c [length]
  Moment<dim> rotation;                ///< phi, in the plane counterclockwise [rad]
  Moment<dim> moment{};                ///< that it exerts about c [stress length^dim]
};

/** How well the forces on one of several bodies balance, as in Equilibrium. */
struct BodyBalance
{
  std::string body;
  double force_imbalance = 0, moment_imbalance = 0;
};

/**
 * The forces on the body as the discrete solution has them: nodal reactions `a(u_N, v_i) - L(v_i)`.
 * They are the exact resultants of the discrete problem, where an integral of sigma(u_N) n over a
 * boundary has the error of the stress. A node in a corner divides its reaction among the boundaries
 * whose conditions meet there.
 */
template <int dim>
struct Equilibrium
{
  dealii::Point<dim> centre;                 ///< of the body, for moments
  std::vector<BoundaryForce<dim>> reactions; ///< of boundaries with supports or contact, by id
  std::vector<PlateState<dim>> plates;       ///< by id; their forces are among the reactions
  BoundaryForce<dim> loads;                  ///< of all tractions and the body force together
  std::vector<BoundaryForce<dim>>
      parts_of_loads;                   ///< by boundary, and the body force, where there are any
  double force_imbalance = 0;           ///< |sum of forces| over the sum of absolute nodal forces
  double moment_imbalance = 0;          ///< the same of moments
  std::vector<BodyBalance> bodies = {}; ///< of each, where there are several
};

/** Nodal forces on the nodes of this process, whichever backend has them. */
template <int dim>
struct NodalForces
{
  struct Load
  {
    unsigned int component;
    double value;
    dealii::Point<dim> x;
    unsigned int body = 0; ///< its number
  };

  struct Reaction
  {
    dealii::types::boundary_id boundary; ///< whose support or contact exerts it
    dealii::Tensor<1, dim> force;
    dealii::Point<dim> x;
    unsigned int body = 0;
    bool is_of_springs = false; ///< they do no work on what supports prescribe
  };

  /** A force by itself, not one of nodes. */
  struct Traction
  {
    dealii::types::boundary_id boundary; ///< on which it acts
    dealii::Tensor<1, dim> force;
    Moment<dim> moment; ///< about the centre of the body
  };

  std::vector<Load> loads;
  std::vector<Traction> tractions; ///< of loads what acts on each boundary, of this process
  std::vector<Reaction> reactions;
  std::vector<PlateState<dim>> plates; ///< without their moments
};

/** Adds up @p forces by boundary, over all processes. Collective. */
template <int dim>
Equilibrium<dim> equilibrium(const Scene<dim> &scene, const NodalForces<dim> &forces,
                             MPI_Comm communicator = MPI_COMM_SELF);

/** Of @p solution, whose loads and friction @p system holds. */
template <int dim>
NodalForces<dim> nodal_forces(const Solution<dim> &solution, const ElasticSystem<dim> &system);

/** What nodal reactions do on a displacement [stress length^dim]. */
struct ReactionWork
{
  double supports = 0;  ///< those of prescribed displacements
  double elsewhere = 0; ///< all others, which are round-off where the body is in equilibrium
};

/** Of the reactions of @p solution under @p loads, L(v_i), on @p v. */
template <int dim>
ReactionWork reaction_work(const Solution<dim> &solution, const dealii::Vector<double> &loads,
                           const dealii::Vector<double> &v);
} // namespace hpvi

#endif
