// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_correction_search_h
#define hpvi_correction_search_h

#include <hpvi/algebra/restricted_energy.h>
#include <hpvi/bound/admissible_friction.h>
#include <hpvi/bound/edge_bubbles.h>
#include <hpvi/bound/face_contact.h>
#include <hpvi/bound/node_freedom.h>
#include <hpvi/plane/discretisation.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace hpvi
{
/** The largest value over [0,1]; zero if none is above that, or all are round-off. */
double largest_value(const EdgePolynomial &polynomial, double round_off);

/**
 * An h with `h phi(s) >= polynomial(s)` over [0,1], phi the product of s and 1 - s where the end 0 and 1 is @p held: of the order of what
 * stands out above zero, and zero if none does. At a held end the polynomial must not be positive.
 */
double height_over(const EdgePolynomial &polynomial, const std::array<bool, 2> &held,
                   double round_off, const ShapeTables<2> &tables);

/** |w|_a^2 of a w in V_N by its unknowns, by active cell, each with the springs on its edges. */
template <int dim>
std::vector<double> energies_by_cell(const Solution<dim> &solution,
                                     const Discretisation<dim> &discretisation,
                                     const dealii::Vector<double> &w);

/** Finds w of ContactCorrection, which says what is asked of it. */
template <int dim>
class CorrectionSearch
{
public:
  /** One w and what it is worth. */
  struct Candidate
  {
    dealii::Vector<double> w;
    std::vector<double> gaps; ///< by face
    double total = 0;         ///< `2 gap(u_N - w) + |w|_a^2`; infinite where u_N - w is not in K:
    double penetration = 0;   ///< by so much it penetrates [length],
    double opening = 0;       ///< and by so much joints that must not open do
  };

  CorrectionSearch(const Solution<dim> &solution, const Discretisation<dim> &discretisation,
                   const AdmissibleFriction<dim> &friction, const AdmissiblePressure<dim> &pressure,
                   EdgeBubbles *bubbles);

  /** No correction. */
  Candidate nothing() const;

  /** Of w, with as much more as it takes for u_N - w not to penetrate. */
  Candidate of(const dealii::Vector<double> &w) const;

  /** The best one, from one that is known. */
  Candidate best(Candidate result) const;

  /** Along a face u_Nt - w_t, and u_Nn - w_n - u_0 where contact is unilateral; else zero. */
  EdgePolynomial slip(unsigned int face, const dealii::Vector<double> &w) const;
  EdgePolynomial penetration_along(unsigned int face, const dealii::Vector<double> &w) const;

  /** |w|_a^2 by cell, each with the springs on its edges. */
  std::vector<double> energies(const dealii::Vector<double> &w) const;

private:
  /** A face of two bodies whose jump along @p direction is to vanish. */
  struct Joint
  {
    unsigned int face;
    dealii::Tensor<1, dim> direction;
    Trace trace;
  };

  enum class Role
  {
    outside, ///< w is zero there
    fixed,   ///< by u_Nt where the body sticks, by u_Nn - u_0 where it presses
    free
  };

  /** `sign (rest - w) <= 0` along a face, w that of the unknowns kept. */
  struct Condition
  {
    const Trace *trace;
    EdgePolynomial rest;
    double sign;
    bool is_of_pressure; ///< else of friction, whose direction has either sign, as the frame has it
  };

  std::vector<Role> roles(const std::vector<bool> &nearby) const;
  void add_normal_roles(std::vector<Role> &roles) const;
  void join_roles(std::vector<Role> &roles) const;
  std::vector<std::set<unsigned int>> slanted_corners() const;
  void free_coupled_edges(std::vector<Role> &roles) const;
  std::vector<bool> contact_dofs() const;
  dealii::Vector<double> fixed_displacement() const;
  double open_joints(const dealii::Vector<double> &w) const;
  bool find_near_pressure(unsigned int face) const;
  /** How far a w_n is to go that is linear along each face: at vertices; and inside faces that are held at both ends. */
  struct Heights
  {
    struct AtVertex
    {
      dealii::types::boundary_id side;
      dealii::Tensor<1, dim> normal;
      double height;
    };
    std::map<dealii::types::global_dof_index, std::vector<AtVertex>> at_vertices; ///< by place
    std::map<unsigned int, double> on_faces;

    double &at(dealii::types::global_dof_index place, const ContactFace<dim> &face);
  };

  std::vector<std::array<dealii::types::global_dof_index, 2>> meeting_places() const;

  std::vector<std::array<bool, 2>> held_ends() const;
  double penetration(const dealii::Vector<double> &w, Heights &heights) const;
  double lift(dealii::Vector<double> &w) const;
  void add_friction(const RestrictedEnergy &strip, const std::vector<bool> &nearby,
                    const dealii::Vector<double> &fixed, dealii::Vector<double> &h,
                    std::vector<Condition> &conditions) const;
  void add_pressure(const RestrictedEnergy &strip, const dealii::Vector<double> &fixed,
                    dealii::Vector<double> &h, std::vector<Condition> &conditions) const;
  std::vector<bool> nearby_faces(const std::vector<double> &gaps) const;
  std::vector<unsigned int> kept_unknowns(const std::vector<bool> &nearby,
                                          const std::vector<Role> &roles) const;
  dealii::Vector<double> in_one_direction(const RestrictedEnergy &strip,
                                          const std::vector<bool> &nearby,
                                          const dealii::Vector<double> &fixed) const;
  void take_better(Candidate &best, const dealii::Vector<double> &w) const;

  using Directions = std::vector<std::pair<dealii::Tensor<1, dim>, Trace *>>;
  using BubbleFace = std::pair<const ContactFace<dim> *, Directions>;
  void add_bubbles(unsigned int cell, const std::vector<BubbleFace> &own_faces,
                   EdgeBubbles &bubbles);
  dealii::FullMatrix<double> bubbles_at_nodes(const dealii::FullMatrix<double> &coefficients,
                                              const Directions &directions) const;
  void add_columns(unsigned int cell, const EdgeBubbles::Energies &energies);

  const Solution<dim> &solution;
  const Discretisation<dim> &discretisation;
  const AdmissibleFriction<dim> &friction;
  const NodeFreedom freedom;
  const std::vector<ContactFace<dim>> &faces;
  std::vector<Slip> slips;
  std::vector<Trace> traces; ///< of u_t
  std::vector<std::optional<Opening>> openings;
  std::vector<Joint> joints;
  std::vector<bool> is_near_pressure; ///< by face
  std::vector<std::array<dealii::types::global_dof_index, 2>>
      places;                                ///< of the ends of faces, where any may open
  std::vector<std::array<bool, 2>> are_held; ///< likewise: the ends of faces, along the normal
  BorderedMatrix A;                          ///< bordered by edge bubbles
  std::vector<unsigned int> cell_of_bubble;  ///< by column of the border
  double tolerance = 0;                      ///< of penetrations: round-off
};
} // namespace hpvi

#endif
