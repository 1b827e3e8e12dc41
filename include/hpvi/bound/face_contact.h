// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_face_contact_h
#define hpvi_face_contact_h

#include <hpvi/bound/admissible_pressure.h>
#include <hpvi/bound/contact_trace.h>
#include <hpvi/bound/legendre.h>

#include <functional>
#include <optional>
#include <vector>

namespace hpvi
{
/** What happens along a contact face as a whole, as the multiplier says. */
struct Slip
{
  enum Mode
  {
    everywhere,
    partly,
    nowhere
  } mode = everywhere;
  double direction = 0.; ///< 1 or -1; 0: none, or both

  bool is_directed_everywhere() const
  {
    return mode == everywhere && direction != 0.;
  }
};

/** By face. One without friction slips, in no direction. */
std::vector<Slip> slips_of(const Solution<2> &solution);

/** Those that follow a face on either side along its side of the body, up to @p reach: around a corner they are others' business. */
std::vector<unsigned int> faces_beside(unsigned int face, unsigned int reach,
                                       const std::vector<ContactFace<2>> &faces);

/**
 * The end of slip may be on the first face that sticks as well as on the last that slips, with one Gauss point
 * on each always. That the former slips in part, with the direction of the latter, excludes neither; between two
 * that slip towards each other it has none.
 */
void free_neighbours(std::vector<Slip> &slips, const std::vector<ContactFace<2>> &faces);

/** What happens along the normal on a face with unilateral contact. */
struct Opening
{
  enum Mode
  {
    closed,
    partly,
    open
  } mode;
  Trace penetration; ///< u_Nn - u_0
  EdgePolynomial pressure;

  double gap(const EdgePolynomial &rest) const; ///< `int pi (u_0 - u_Nn + w_n)` over [0,1]
};

Opening opening_of(unsigned int face, const Solution<2> &solution, const Unknowns<2> &unknowns,
                   const AdmissiblePressure<2> &pressure, const LegendreTables &tables);

/** The end of contact likewise may be on the first face that presses. */
void free_neighbours(std::vector<std::optional<Opening>> &openings,
                     const std::vector<ContactFace<2>> &faces);

/** `int g (|v| - l v)` over one face, cut where g jumps or v changes sign [stress length^2]; without @p l: `int g |v|`. */
double friction_gap(const ContactFace<2> &face, const EdgePolynomial &v,
                    const ShapeTables<2> &tables, const std::function<double(double)> &l = {});
} // namespace hpvi

#endif
