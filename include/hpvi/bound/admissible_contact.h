// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_admissible_contact_h
#define hpvi_admissible_contact_h

#include <hpvi/bound/contact_correction.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace hpvi
{
/** A displacement along the normal on a face: linear between both ends, and a part of s (1 - s). */
struct Bump
{
  std::array<double, 2> ends{};
  double inside = 0;

  double operator()(const double s) const
  {
    return (1. - s) * ends[0] + s * ends[1] + s * (1. - s) * inside;
  }

  bool is_zero() const
  {
    return ends[0] == 0. && ends[1] == 0. && inside == 0.;
  }

  double largest() const
  {
    return std::max({ends[0], ends[1], inside});
  }
};

/**
 * What theorem (C) asks of a step along contact: a displacement U in K, and tractions pi >= 0 along the normal and l* times the
 * limit of friction along the tangent, at s in [0,1] of a face.
 */
class AdmissibleContact
{
public:
  virtual ~AdmissibleContact() = default;

  virtual double slip(unsigned int face, double s) const = 0; ///< U_t [length]
  virtual double room(unsigned int face, double s) const = 0; ///< u_0 - U_n, but for round-off >= 0
  virtual double largest_slip(unsigned int face) const = 0;
  virtual double pressure(unsigned int face, double s) const = 0;  ///< pi
  virtual double direction(unsigned int face, double s) const = 0; ///< l*

  /** 0, 1 and places between them where the two displacements are not smooth. */
  virtual std::vector<double> kinks(unsigned int face) const = 0;

  /** Points of the face and weights ds for products of displacements and tractions; slip changes its sign between pieces alone. */
  virtual std::vector<std::pair<double, double>> points(unsigned int face) const = 0;

  /** |X|_a of an X in V with X_n = @p bumps, by face, and X_t = 0 along contact; infinite where supports are in the way. */
  virtual double lift(const std::vector<Bump> &bumps) const = 0;
};

/** Of straight sides that match, where U = u_N - w. */
class MatchingContact : public AdmissibleContact
{
public:
  /** All must outlive this object. */
  MatchingContact(const Solution<2> &solution, const Discretisation<2> &discretisation,
                  const AdmissibleFriction<2> &friction, const AdmissiblePressure<2> &pressure,
                  const ContactCorrection<2> &correction);

  double slip(unsigned int face, double s) const override;
  double room(unsigned int face, double s) const override;
  double largest_slip(unsigned int face) const override;
  double pressure(unsigned int face, double s) const override;
  double direction(unsigned int face, double s) const override;
  std::vector<double> kinks(unsigned int face) const override;
  std::vector<std::pair<double, double>> points(unsigned int face) const override;
  double lift(const std::vector<Bump> &bumps) const override;

private:
  const Solution<2> &solution;
  const Discretisation<2> &discretisation;
  const AdmissibleFriction<2> &friction;
  const AdmissiblePressure<2> &pressures;
  const ContactCorrection<2> &correction;
};
} // namespace hpvi

#endif
