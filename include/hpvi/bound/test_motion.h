// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_test_motion_h
#define hpvi_test_motion_h

#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/scene.h>

#include <array>
#include <string>
#include <vector>

namespace hpvi
{
/** The motion R of a boundary on which its traction does the work that is a resultant. */
enum class BoundaryMotion
{
  x,          ///< R = (1, 0): int T_x
  y,          ///< R = (0, 1)
  moment,     ///< R = (-(y - y_c), x - x_c), c the centre of the body
  normal,     ///< R = n: int T_n
  tangential, ///< R = t: int T_t
  none        ///< R = 0
};

/** What is known beforehand of the traction along a direction, beside the loads. */
enum class TractionKind
{
  given,    ///< zero
  friction, ///< |T| <= g
  pressure, ///< T <= 0
  reaction  ///< nothing
};

/**
 * Boundary values of a displacement w with which the weak equation of the exact solution says a resultant of one boundary,
 *
 *     a(u, w) - L(w) = int (sigma(u) n - G) . w = F + what falls,
 *
 * for w = R on that boundary, as far as its traction is not given, and w = 0 where tractions of others are not. Where two boundaries meet, w is one
 * vector, and what only friction asks of it may be missed: there w falls from that vector to what the boundary wants along
 * a part of length l, and the work of friction on what is missed is at most `int g |fall| (1 - s/l) ds`. What a pressure does there is
 * known where contact is open (open_contact.h), and that of friction by pressure by pressing(). Reactions bear no fall.
 *
 * In the plane. On a side of several normals that contact, symmetry or springs hold w is R along x and y, or 0, and bears no fall.
 */
class TestMotion
{
public:
  /** @p sides: sides_of(scene); both must outlive this. */
  TestMotion(const Scene<2> &scene, const std::vector<Side<2>> &sides, unsigned int boundary,
             BoundaryMotion resultant);

  /** Why there is no such w, in words; else empty. */
  const std::string &flaw() const;

  bool is_zero() const; ///< has the boundary no traction along R?

  /** How w falls along one boundary from a point where others meet it. */
  struct Fall
  {
    unsigned int boundary;
    dealii::Point<2> from;
    dealii::Tensor<1, 2> offset;  ///< of w there from what the boundary wants
    dealii::Tensor<1, 2> towards; ///< unit vector along the boundary
    TractionKind kind;            ///< friction or pressure, whose work there is not counted

    /** Of friction, `int g |offset| (1 - s/l) ds` over the length @p l. */
    double work(const Scene<2> &scene, double l) const;
  };
  const std::vector<Fall> &falls() const;

  /**
   * Of a fall along friction that knows the pressure, of length @p l: X with `X_n = mu |fall| (1 - s/l)`, mu the largest coefficient
   * there, and X_t = 0 along contact, so that `int mu_f p |fall| (1 - s/l) ds <= int p X_n`. Has a flaw where what meets there is in the way.
   */
  TestMotion pressing(const Fall &fall, double l) const;

  /**
   * What @p boundary asks of w at @p x; the falls have the lengths @p l.
   */
  std::vector<PointCondition<2>> conditions(unsigned int boundary, const dealii::Point<2> &x,
                                            const std::vector<double> &l) const;

  /** Where on the straight edge from @p begin to @p end of @p boundary w is not smooth: 0, ends of falls, 1; none: w does no work there. */
  std::vector<double> kinks(unsigned int boundary, const dealii::Point<2> &begin,
                            const dealii::Point<2> &end, const std::vector<double> &l) const;

  unsigned int body_number() const; ///< of the body that has the boundary: on others w = 0

  double largest() const; ///< |R| on the boundary is no more

  /** Is R on the goal a rotation along a curve? Edges of it are no chords. */
  bool turns_along_curve() const;

private:
  struct Meeting;
  struct Row;

  TestMotion(const TestMotion &other, const Fall &fall); ///< R = 0 but for this fall

  dealii::Tensor<1, 2> motion(unsigned int boundary, const dealii::Point<2> &x) const;
  std::vector<Row> rows(unsigned int boundary, const dealii::Point<2> &x) const;
  std::vector<Meeting> meetings() const;
  void meet(const Meeting &meeting);

  const Scene<2> &original;
  const std::vector<Side<2>> &sides;
  std::vector<bool> turns; ///< by boundary: has it several normals?
  const unsigned int goal, body;
  const BoundaryMotion resultant;
  std::string why_not;
  std::vector<Fall> all_falls;
};

/** Has it one normal? */
bool is_straight(const Side<2> &side);

/** Along two orthonormal directions of a boundary at a point with @p normal. */
struct TractionAlong
{
  dealii::Tensor<1, 2> direction;
  TractionKind kind;
};
std::array<TractionAlong, 2> tractions_of(const BoundaryCondition<2> &boundary,
                                          const dealii::Tensor<1, 2> &normal);
} // namespace hpvi

#endif
