// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_points_h
#define hpvi_contact_points_h

#include <hpvi/evaluation/contact_state.h>
#include <hpvi/moments/moment_space.h>

#include <vector>

namespace hpvi
{
/** What u_N and lambda do at one Gauss point of the contact boundary. Vectors have the axes of the body. */
template <int dim>
struct MomentPoint
{
  dealii::Point<dim> x;
  dealii::types::boundary_id boundary = 0;
  double area = 0;                     ///< int psi_k [length^(dim-1)]
  double bound = 0;                    ///< g [stress], 0 without friction
  dealii::Tensor<1, dim> lambda;       ///< along the contact, dimensionless; 0 where g is
  dealii::Tensor<1, dim> displacement; ///< u
  double normal_traction =
      0;                ///< T_n [stress], positive where it pulls: -p, or n.(sigma n - G) without p
  double gap = 0;       ///< u_0 - u_n of unilateral contact [length], else -u_n
  bool slips = true;    ///< |lambda| = 1 or g = 0
  bool is_open = false; ///< unilateral contact without pressure

  unsigned int axis() const ///< of the normal
  {
    return boundary / 2;
  }

  double normal_sign() const
  {
    return boundary % 2 == 0 ? -1. : 1.;
  }

  template <class Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive &x &boundary &area &bound &lambda &displacement &normal_traction &gap &slips &is_open;
  }

  ContactMode mode() const
  {
    return is_open ? ContactMode::open : slips ? ContactMode::slip : ContactMode::stick;
  }
};

/** How far u_N passes through the foundation of a boundary between the points that its moments see. */
template <int dim>
struct Penetration
{
  double depth = 0; ///< max(u_n - u_0, 0) [length]
  dealii::Point<dim> x;

  template <class Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive &depth &x;
  }
};

/** By boundary, at p+1 points in each direction of a face. Collective. */
template <int dim>
std::vector<Penetration<dim>> penetrations(const MomentSpace<dim> &space,
                                           const DistributedVector &u);

/** Of all processes on the first one, by boundary and place; empty on the others. Collective. */
template <int dim>
std::vector<MomentPoint<dim>> contact_points(const MomentSpace<dim> &space,
                                             const DistributedVector &u,
                                             const std::vector<ContactVector<dim>> &lambda);

/** `int g |u_t|` by the rule with p+1 points in each direction. Collective. */
template <int dim>
double friction_work(const MomentSpace<dim> &space, const DistributedVector &u);
} // namespace hpvi

#endif
