// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_statics_h
#define hpvi_contact_statics_h

#include <hpvi/scene/space_motion.h>
#include <hpvi/solvers/nearest_force.h>
#include <hpvi/space/primal_space.h>

#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/** A point at which contact acts on a rigid body, or between two. */
struct ContactSpot
{
  dealii::Point<3> x;
  dealii::Tensor<1, 3> normal;         ///< outer
  FrictionLimit limit;                 ///< of the friction, here
  double area = 0;                     ///< on which it acts without pressure
  bool presses = false;                ///< with a pressure, at least 0;
  bool pulls = false;                  ///< or of any sign
  TouchingBodies bodies{{0, no_body}}; ///< the one whose normal it is, and what lies opposite
};

/**
 * Statics of bodies in space that contact alone holds: their loads along the motions that supports leave free, and what
 * contact can balance, sums of pressures and of the friction that they allow. That the loads are among these is necessary
 * for an equilibrium, and where friction does not know the pressure sufficient.
 */
class ContactStatics
{
public:
  /** @p f is the load vector of the space. Collective, as all that follows. */
  ContactStatics(const PrimalSpace<3> &space, const DistributedVector &f);

  /** Throws NumericalFailure, with the motion that sets in and both forces, where no pressures at all balance the loads. */
  void require_static_admissibility() const;

  /** What the mesh lacks, whose pressures act inside of its faces: loads may pass between the last point and an edge. */
  struct Missing
  {
    std::vector<PrimalSpace<3>::Cell> cells; ///< of this process, with faces that would resist
    std::size_t n_cells;                     ///< of all processes
    std::string why;                         ///< for the one who gives up
  };
  std::optional<Missing> missing() const;

  /**
   * What loads and contact leave along the free motions, in parts of all forces; @p words of the motion where they leave most,
   * as in "the loads push the body along (1, 0, 0) with 2, contact resists with 1".
   */
  double imbalance(const std::vector<ContactVector<3>> &lambda, std::string &words) const;

private:
  TouchingBodies bodies_at(const ContactDofFace<3> &face) const;
  std::vector<ContactSpot> spots_of(const ContactDofFace<3> &face) const;
  std::vector<ContactSpot> ends_of(const ContactDofFace<3> &face) const;
  BodyMotions sum(const Force &coefficients) const;
  double speed(const SpaceMotion &motion) const;
  unsigned int first_of(const BodyMotions &motion) const;
  std::string names_of(const BodyMotions &motion, unsigned int first) const;
  bool turns(const Force &motion) const;
  std::string in_words(const Force &motion, double load, const std::string &what,
                       double resistance) const;
  std::string why(const std::vector<ContactSpot> &spots, const Separation &separation) const;

  const PrimalSpace<3> &space;
  const std::vector<BodyMotions> motions; ///< independent
  std::vector<DistributedVector> steps;   ///< the same in the unknowns
  Force loads;                            ///< along them; 0 where round-off is all there is
  std::vector<double> sizes;              ///< of the loads along each, without their signs
  std::vector<ContactSpot> on_mesh, ends; ///< of all processes: of contact dofs; corners of faces
};
} // namespace hpvi

#endif
