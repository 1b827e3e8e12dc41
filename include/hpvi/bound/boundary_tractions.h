// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_boundary_tractions_h
#define hpvi_boundary_tractions_h

#include <hpvi/bound/vertex_patches.h>

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace hpvi
{
/** What loads and contact prescribe of an equilibrated stress on edges of the boundary, in the direction of the edge's traction. */
class BoundaryTractions
{
public:
  /** Legendre coefficients of a polynomial on a contact face, that of one of its ends. */
  using Parts = std::function<std::vector<double>(unsigned int face, unsigned int end)>;

  /** By end of an edge and component: Legendre coefficients. */
  using Halves = std::array<std::array<std::vector<double>, 2>, 2>;

  /** As EquilibratedStress has them; @p solution, @p patches and @p joints must outlive this object. */
  BoundaryTractions(const Solution<2> &solution, const VertexPatches &patches,
                    const Parts &friction, const Parts &pressure, const JointTractions *joints);

  /** The traction at s in [0,1] of an edge; on a body of revolution all the way around the axis, as all here. */
  dealii::Tensor<1, 2> value(unsigned int edge, double s) const;

  /** The part of it that loads and springs exert. */
  dealii::Tensor<1, 2> load(unsigned int edge, double s) const;

  /** int (what loads exert) . v over an edge, by the points of the discrete equations; v of s [stress length^dim]. */
  double work_of_loads(unsigned int edge,
                       const std::function<dealii::Tensor<1, 2>(double)> &v) const;

  double stretch(const StressEdge &edge, double s) const; ///< |x'(s)|/length

  /** Points and weights on [0,1] for integrals with it. */
  std::vector<std::pair<double, double>> points(unsigned int edge) const;

  /** psi times it, as far as it is known, with the hat functions of both ends. */
  const Halves &of_hats(unsigned int edge) const;

  /**
   * Corners of cells, by bits, where the edges of the boundary that meet prescribe different shears. The cells
   * of both share the difference, that of one cell takes it. So they do where other boundaries meet and the shear of one leans on an unknown traction that is not along it:
   * that alone could pay for the difference, but by the more the less it leans. Equal shears differ by round-off of the largest
   * one, more so where vertices far from the origin are rounded.
   */
  std::vector<unsigned int> marked_corners() const;

private:
  /** What the contact prescribes, by end of a face; without pressure: none. */
  struct ContactParts
  {
    std::array<std::vector<double>, 2> friction, pressure;
  };

  /** S_xy of a cell at one end of a boundary edge. */
  struct EndShear
  {
    double known = 0, scale = 0; ///< what is prescribed of it, and of tractions
    bool is_free = false;        ///< the tangential traction is unknown
    bool leans = false;          ///< an unknown component has a weight in it
  };

  LoadRule<1> rule(const StressEdge &edge, Datum datum) const;
  dealii::Point<2> point(const StressEdge &edge, double s) const;
  dealii::Tensor<1, 2> load_on(const StressEdge &edge, double s) const;
  dealii::Tensor<1, 2> spring_on(const StressEdge &edge, double s) const;
  dealii::Tensor<1, 2> friction_on(const StressEdge &edge, unsigned int end, double s,
                                   double bound) const;
  void set(unsigned int edge);
  void vanish_on_axis(unsigned int edge);
  void add_contact(unsigned int edge);
  void add_joint(unsigned int edge);
  void add_load(unsigned int edge, double s, double weight,
                const std::array<dealii::Tensor<1, 2>, 2> &tractions);
  void meet_ends(const StressEdge &edge, unsigned int end, const dealii::Tensor<1, 2> &at_end);
  EndShear end_shear(unsigned int edge, unsigned int end) const;

  const Solution<2> &solution;
  const VertexPatches &patches;
  const JointTractions *const joints;      ///< null: contact_parts are given
  std::vector<ContactParts> contact_parts; ///< by contact face
  std::vector<Halves> halves;              ///< by edge
};
} // namespace hpvi

#endif
