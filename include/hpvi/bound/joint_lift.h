// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_joint_lift_h
#define hpvi_joint_lift_h

#include <hpvi/bound/admissible_contact.h>
#include <hpvi/bound/face_contact.h>
#include <hpvi/bound/joint_tractions.h>
#include <hpvi/bound/node_freedom.h>
#include <hpvi/plane/discretisation.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * A displacement d that makes U = u_N + d admissible at every point of contacts whose meshes do not match: the jump [U] vanishes where
 * bodies must not part, `[U]_n <= u_0` where contact is unilateral. Along the edges of one body, the softer one of each contact, d is a polynomial
 * on each piece between vertices of either body: the jump is taken away in full where all points of the multiplier press,
 * or stick; elsewhere d is linear, and as large as it takes. w, in V_N, has its values at the nodes of the edges and the least energy in
 * the cells beside them; the rest goes into the cell of each edge by lift_energy().
 */
class JointLift : public AdmissibleContact
{
public:
  JointLift(const Solution<2> &solution, const Discretisation<2> &discretisation,
            const JointTractions &tractions);

  std::vector<double> energies; ///< |w|_a^2 with springs by active cell index
  double change = 0;            ///< a(u_N, w) - L(w) + |w|_a^2/2
  dealii::Vector<double> moved; ///< u_N + w
  std::vector<double> cells;    ///< |d - w|_{a,K} with the springs of its edges, likewise
  std::vector<double> gaps; ///< of u_N + d by contact face: gap() of ErrorBound [stress length^dim]
  double work =
      0; ///< -int tau . [d - w] + int g (|U_t| - |u_Nt|), of J(U) - J(u_N + w) what is known
  std::string flaw; ///< why U is not admissible, in words; or empty

  double slip(unsigned int face, double s) const override;
  double room(unsigned int face, double s) const override; ///< infinite where nothing is opposite
  double largest_slip(unsigned int face) const override;
  double pressure(unsigned int face, double s) const override;
  double direction(unsigned int face, double s) const override;
  std::vector<double> kinks(unsigned int face) const override;
  std::vector<std::pair<double, double>> points(unsigned int face) const override;
  double lift(const std::vector<Bump> &bumps) const override;

private:
  /** Components along normal and tangent of the slave's face. */
  enum Mode
  {
    any,   ///< linear between its ends
    below, ///< likewise, and more where `[U] <= u_0` asks for it
    exact  ///< [U] = 0; or u_0, less what is linear between the ends if these ask for more
  };
  struct Piece
  {
    Piece(const JointPiece &place, const bool is_joint) : place(place), is_joint(is_joint)
    {
    }

    JointPiece place;
    bool is_joint; ///< else no body lies opposite to this part of a master
    bool is_unilateral = false;
    std::array<Mode, 2> modes{{any, any}};
    std::array<EdgePolynomial, 2> jump;   ///< [u_N] by normal and tangent along the piece, less u_0
    std::array<EdgePolynomial, 2> change; ///< [d] likewise

    EdgePolynomial left(unsigned int c) const ///< [U]
    {
      return c == 1 && modes[1] == exact ? EdgePolynomial::constant(0.) : jump[c] + change[c];
    }
    std::array<EdgePolynomial, 2> d;             ///< by its components
    std::array<dealii::Tensor<1, 2>, 2> at_ends; ///< d
  };
  struct Mover
  {
    const JointEdge *edge;
    double sign; ///< of d in [d]
    std::array<unsigned int, 2> vertices;
    std::array<EdgePolynomial, 2> w; ///< its components along the edge
    std::vector<Piece> pieces;       ///< they fill the edge
  };
  /** `direction . d = value` at a vertex. */
  struct Wish
  {
    dealii::Tensor<1, 2> direction;
    double value;
    bool is_most; ///< less will do
  };

  /** On a face of the slave. */
  struct OnFace
  {
    double begin, end;
    JointPiece place;
    std::array<EdgePolynomial, 2> left; ///< [U] by normal and tangent, less u_0
  };

  /** That X of lift(): of the movers near to bumps, with these in the place of what U asks for. */
  JointLift(const JointLift &of_U, const std::vector<Bump> &bumps);
  const OnFace *on_face(unsigned int face, double s) const;
  void move();
  void choose_movers();
  Mover mover(const JointEdge &edge) const;
  Piece piece(const JointPiece &place, const JointEdge &edge, double sign) const;
  std::array<dealii::Tensor<1, 2>, 2> frame(const Piece &piece, double t) const;
  unsigned int points_along(const Piece &piece, unsigned int degree) const;
  void set_vertices(const NodeFreedom &freedom);
  void set_ends(Mover &mover) const;
  static double at_cut(const std::array<const Piece *, 2> &pieces, unsigned int c);
  void set_changes(Mover &mover);
  void set_change(Piece &piece, double sign, unsigned int c);
  void add_rest(const Mover &mover);
  void set_w();
  void set_nodes(Mover &mover, dealii::Vector<double> &u) const;
  dealii::Tensor<1, 2> rest(const Mover &mover, const Piece &piece, double t) const;
  void add_gaps(const Mover &mover, const Piece &piece);
  void set_flaw(const Piece &piece, double by);
  void require_own_corners(const std::vector<Mover> &that_move, double least);

  const Solution<2> &solution;
  const Discretisation<2> &discretisation;
  const JointTractions &tractions;
  const std::vector<Slip> slips;
  std::vector<Mover> movers;
  std::map<unsigned int, dealii::Tensor<1, 2>> at_vertices; ///< d
  std::vector<std::vector<OnFace>> by_face;                 ///< in the order of s
  double size = 0;                                          ///< of displacements
};
} // namespace hpvi

#endif
