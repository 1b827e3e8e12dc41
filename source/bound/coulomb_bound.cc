// SPDX-License-Identifier: LGPL-2.1-or-later

// Under Coulomb's law no energy is least, but a stress in equilibrium whose own tractions obey the law, $\tau = \mu_f\chi\pi$ with
// $|\chi| \le 1$, bounds the error of every solution, enlarged by what one number says: how strongly friction couples
// back into pressure. doc/coulomb.md has the theorem and its proof.
#include <hpvi/base/formatting.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/bound/coulomb_bound.h>
#include <hpvi/bound/coulomb_coupling.h>
#include <hpvi/bound/pressed_face.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace hpvi
{
using namespace dealii;

double coulomb_bound(const double coupling, const CoulombTerms &terms)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto &[A, gap, b, lift] = terms;
  if (!(coupling < 2.) || !std::isfinite(lift))
    return infinity;
  const double k = coupling / 2, of_P = k + std::sqrt(1 + k * k);
  const auto root = [&, A = A, gap = gap, b = b, lift = lift](const double lambda)
  {
    const double nu = lambda * k + std::hypot(lambda * k, 1 - lambda), rest = 1 - nu * nu;
    if (!(rest > 0.))
      return infinity;
    const double c = lambda * (of_P * b + lift), half = nu * c;
    return (half + std::sqrt(half * half + rest * (A * A + 2 * lambda * gap + c * c))) / rest;
  };
  // Where b = gap = x_M = 0 the first is best; the last is Prager and Synge's for coupling 0.
  const double middle = (1 - k * k) / (1 + k * k);
  double result = std::min(root(middle), root(1.));
  result = std::min(result, boost::math::tools::brent_find_minima(root, 1e-3, 1., 24).second);
  if (middle > 1e-3)
    result = std::min(result, boost::math::tools::brent_find_minima(root, 1e-3, middle, 24).second);
  return result;
}

std::optional<Solution<2>> under_admissible_limit(const Solution<2> &solution,
                                                  const AdmissiblePressure<2> &pressure)
{
  const std::vector<ContactFace<2>> &faces = solution.contact_space.faces();
  std::vector<std::function<double(double)>> limits(faces.size());
  bool knows_pressure = false;
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (faces[k].condition->friction.knows_pressure())
    {
      knows_pressure = true;
      // The spaces, which outlive this, have the face.
      limits[k] =
          [&face = solution.spaces->contact_space.faces()[k],
           pi = faces[k].condition->is_unilateral()
                    ? pressure.value(k)
                    : discrete_traction(faces[k], solution, /*is_pressure=*/true)](const double s)
      { return face.condition->friction.limit(face.point(s), pi(s)); };
    }
  if (!knows_pressure)
    return std::nullopt;
  return Solution<2>(solution, std::make_shared<const ContactSpace<2>>(solution.contact_space.under(
                                   limits, solution.z, solution.tables)));
}

namespace
{
// @sect3{What friction against chi costs}
//
// Where U slips against $\chi$, or the body sticks with some slip left, a part M of the slip meets the unknown pressure. A bubble M' above it
// is a part of the gap, and the normal trace of an explicit displacement X' that carries it.
/** Of what the samples of a face miss between them. */
constexpr double reserve = 1.1;

class Excess
{
public:
  Excess(const Solution<2> &solution, const AdmissibleContact &contact, const SlipDirection &chi);

  double operator()(unsigned int face,
                    double s) const; ///< (mu_f (|U_t| - chi U_t) - (u_0 - U_n))_+

  const std::vector<Bump> &bumps() const
  {
    return all;
  }

private:
  void set_inside(unsigned int face);
  const std::vector<double> &samples(unsigned int n);

  const std::vector<ContactFace<2>> &faces;
  const AdmissibleContact &contact;
  const SlipDirection &chi;
  double round_off; ///< [length]
  std::vector<Bump> all;
  std::map<unsigned int, std::vector<double>> known_samples;
};

double Excess::operator()(const unsigned int face, const double s) const
{
  if (!chi[face])
    return 0.;
  const double u_t = contact.slip(face, s),
               against = std::abs(u_t) * (1. - (u_t < 0. ? -1. : 1.) * chi[face](s));
  if (against <= 0.)
    return 0.;
  const double room = std::max(0., contact.room(face, s)),
               value = against * faces[face].friction_coefficient(faces[face].point(s)) - room;
  return value > round_off ? value : 0.;
}

Excess::Excess(const Solution<2> &solution, const AdmissibleContact &contact,
               const SlipDirection &chi)
    : faces(solution.contact_space.faces()), contact(contact), chi(chi),
      round_off(1e-12 * solution.u.linfty_norm()), all(faces.size())
{
  std::map<std::pair<unsigned int, const BoundaryCondition<2> *>, double> at_vertices;
  const auto height = [&](const unsigned int k, const unsigned int end) -> double &
  {
    return at_vertices[{faces[k].cell->face(faces[k].face_no)->vertex_index(end),
                        faces[k].condition}];
  };
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int end = 0; end < 2; ++end)
      height(k, end) = std::max(height(k, end), reserve * (*this)(k, end));
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    all[k].ends = {{height(k, 0), height(k, 1)}};
    set_inside(k);
  }
}

/** In (0,1), dense at both ends. */
const std::vector<double> &Excess::samples(const unsigned int n)
{
  std::vector<double> &result = known_samples[n];
  for (unsigned int i = 0; result.size() < n; ++i)
    result.push_back(0.5 * (1. - std::cos((i + 0.5) * numbers::PI / n)));
  return result;
}

void Excess::set_inside(const unsigned int k)
{
  const std::vector<double> kinks = contact.kinks(k);
  double inside = 0;
  for (unsigned int piece = 0; piece + 1 < kinks.size(); ++piece)
    for (const double place : samples(4 * (faces[k].degree + 9)))
    {
      const double s = kinks[piece] + (kinks[piece + 1] - kinks[piece]) * place, M = (*this)(k, s);
      if (M > 0.)
        inside = std::max(inside, (reserve * M - all[k](s)) / (s * (1. - s)));
    }
  all[k].inside = inside;
}

/**
 * int pi (u_0 - U_n + M') over contact, and int g (|U_t| - l* U_t) of what friction has without pressure. Where @p assumed, chi', takes the
 * place of the chi of the stress, also int mu_f (chi' - chi) pi U_t.
 */
double gap_of(const Solution<2> &solution, const AdmissibleContact &contact,
              const std::vector<Bump> &bumps, const SlipDirection &chi,
              const SlipDirection *assumed)
{
  const std::vector<ContactFace<2>> &faces = solution.contact_space.faces();
  double result = 0;
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    const bool is_unilateral = faces[k].condition->is_unilateral(),
               has_bound = faces[k].condition->friction.bound && faces[k].n_multipliers > 0;
    if (!is_unilateral && !has_bound)
      continue;
    double of_face = 0;
    for (const auto &[s, ds] : contact.points(k))
    {
      if (is_unilateral)
        of_face += ds * contact.pressure(k, s) * (bumps[k](s) + contact.room(k, s));
      if (is_unilateral && assumed && chi[k])
        of_face += ds * faces[k].friction_coefficient(faces[k].point(s)) *
                   ((*assumed)[k](s) - chi[k](s)) * contact.pressure(k, s) * contact.slip(k, s);
      if (has_bound)
      {
        const double value = contact.slip(k, s);
        of_face += ds * faces[k].friction_bound(faces[k].point(s)) *
                   (std::abs(value) - contact.direction(k, s) * value);
      }
    }
    result += std::max(0., of_face);
  }
  return result;
}
} // namespace

// @sect3{Three tiers}
//
// The coupling of chi may allow a bound for every solution. If not, that of a solution which sticks and slips where u_N does may. Else
// Tresca's bound for the same stress is an estimate.
void CoulombBounds::set(ErrorBound &result, const Solution<2> &solution,
                        const AdmissibleContact &contact, const double A, const double b)
try
{
  result.kind = BoundKind::estimate;
  for (const ContactFace<2> &face : solution.contact_space.faces())
    if (!face.condition->is_unilateral() && face.condition->friction.knows_pressure())
    {
      result.why = "the coupling of friction and pressure is not known where contact is bilateral";
      return;
    }
    else if (face.condition->friction && !face.condition->friction.is_proportional())
    {
      result.why = face.condition->friction.name() +
                   " has no bound of the error, whatever the coupling: its limit follows the "
                   "pressure " +
                   (face.condition->friction.by_pressure ? "by a curve" : "up to a bound alone");
      return;
    }
  const CoulombCoupling couple(solution, spaces);
  const SlipDirection chi = slip_direction(solution, contact);
  const auto bound = [&](const SlipDirection *const assumed)
  {
    const std::vector<Bump> bumps = Excess(solution, contact, assumed ? *assumed : chi).bumps();
    const bool is_zero =
        std::all_of(bumps.begin(), bumps.end(), [](const Bump &bump) { return bump.is_zero(); });
    return coulomb_bound(result.coupling, {A, gap_of(solution, contact, bumps, chi, assumed), b,
                                           is_zero ? 0. : contact.lift(bumps)});
  };
  result.why = couple.unbounded_at(chi);
  if (result.why.empty())
  {
    set_coupling(result, couple, solution.scene, chi, {});
    const double total = result.coupling <= largest_coupling
                             ? bound(nullptr)
                             : std::numeric_limits<double>::infinity();
    if (std::isfinite(total))
    {
      result.total = result.radius = total;
      result.theta = 0;
      result.kind = BoundKind::coupling;
      return;
    }
    result.why = "the coupling of friction, " + text(result.coupling, 3) +
                 ", is too strong for a bound of the error";
  }
  const SlipZones zones = slip_zones(solution, contact);
  if (zones.contradicts || !couple.unbounded_at(zones.direction, zones.sticks).empty())
    return;
  const std::pair<double, std::string> known(result.coupling, result.coupling_known);
  set_coupling(result, couple, solution.scene, zones.direction, zones.sticks);
  const double total = result.coupling <= largest_coupling
                           ? bound(&zones.direction)
                           : std::numeric_limits<double>::infinity();
  if (!std::isfinite(total))
  {
    std::tie(result.coupling, result.coupling_known) = known;
    return;
  }
  result.total = result.radius = total;
  result.theta = 0;
  result.kind = BoundKind::zones;
  result.zones = zones.words;
  result.why.clear();
}
catch (const NumericalFailure &failure) // what is left needs no coupling
{
  result.why = std::string("the coupling of friction is not known: ") + failure.what();
}

void CoulombBounds::set_coupling(ErrorBound &result, const CoulombCoupling &couple,
                                 const Scene<2> &scene, const SlipDirection &chi,
                                 const std::vector<bool> &sticks)
{
  if (scene.localised_coupling && !strip)
    strip.emplace(scene);
  const bool is_localised = strip && strip->why_none.empty();
  result.coupling =
      is_localised ? couple.localised(*strip, chi, sticks).above : couple(chi, sticks);
  // What is too large for a bound may be the estimate alone.
  result.coupling_known =
      is_localised && result.coupling <= largest_coupling ? "finite part computed" : "estimated";
  if (strip && !is_localised)
    result.coupling_known += ", since " + strip->why_none;
}
} // namespace hpvi
