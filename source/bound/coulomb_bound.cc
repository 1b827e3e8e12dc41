// SPDX-License-Identifier: LGPL-2.1-or-later

// Under Coulomb's law no energy is least, but a stress in equilibrium whose own tractions obey the law, $\tau = \mu_f\chi\pi$ with
// $|\chi| \le 1$, bounds the error of every solution, enlarged by what one number says: how strongly friction couples
// back into pressure. doc/coulomb.md has the theorem and its proof.
#include <hpvi/algebra/restricted_energy.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/bound/coulomb_bound.h>
#include <hpvi/bound/coulomb_coupling.h>
#include <hpvi/bound/nodal_displacement.h>
#include <hpvi/bound/pressed_face.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

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
/** M' on a face: linear between both ends, and a part of s (1 - s). */
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
};

/** Of what the samples of a face miss between them. */
constexpr double reserve = 1.1;

class Excess
{
public:
  Excess(const Solution<2> &solution, const ContactCorrection<2> &correction,
         const SlipDirection &chi);

  double operator()(unsigned int face,
                    double s) const; ///< (mu_f (|U_t| - chi U_t) - (u_0 - U_n))_+

  const std::vector<Bump> &bumps() const
  {
    return all;
  }

  /** |X'|_a; infinite where supports are in the way. */
  double lift(const Solution<2> &solution, const Discretisation<2> &discretisation) const;

private:
  std::vector<bool> near_bumps() const; ///< faces that touch one with a bump, or have one

  const std::vector<ContactFace<2>> &faces;
  const ContactCorrection<2> &correction;
  const SlipDirection &chi;
  double round_off; ///< [length]
  std::vector<Bump> all;
};

double Excess::operator()(const unsigned int face, const double s) const
{
  if (!chi[face])
    return 0.;
  const double u_t = correction.slip(face)(s),
               against = std::abs(u_t) * (1. - (u_t < 0. ? -1. : 1.) * chi[face](s)),
               mu = faces[face].friction_coefficient(faces[face].point(s)),
               room = std::max(0., -correction.penetration_along(face)(s)),
               value = mu * against - room;
  return value > round_off ? value : 0.;
}

Excess::Excess(const Solution<2> &solution, const ContactCorrection<2> &correction,
               const SlipDirection &chi)
    : faces(solution.contact_space.faces()), correction(correction), chi(chi),
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
    const unsigned int m = 4 * (faces[k].degree + 9);
    double inside = 0;
    for (unsigned int i = 0; i < m; ++i)
    {
      const double s = 0.5 * (1. - std::cos((i + 0.5) * numbers::PI / m)), M = (*this)(k, s);
      if (M > 0.)
        inside = std::max(inside, (reserve * M - all[k](s)) / (s * (1. - s)));
    }
    all[k].inside = inside;
  }
}

// X' moves nodes of these faces alone, and vanishes along those farther away: they need no wishes. Where bodies touch all have some.
std::vector<bool> Excess::near_bumps() const
{
  std::set<unsigned int> vertices;
  const auto ends = [&](const unsigned int k)
  {
    const auto face = faces[k].cell->face(faces[k].face_no);
    return std::array<unsigned int, 2>{{face->vertex_index(0), face->vertex_index(1)}};
  };
  bool has_pairs = false;
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    has_pairs = has_pairs || !faces[k].segments.empty();
    if (!all[k].is_zero())
      for (const unsigned int vertex : ends(k))
        vertices.insert(vertex);
  }
  std::vector<bool> result(faces.size());
  for (unsigned int k = 0; k < faces.size(); ++k)
    result[k] = has_pairs || vertices.count(ends(k)[0]) > 0 || vertices.count(ends(k)[1]) > 0;
  return result;
}

double Excess::lift(const Solution<2> &solution, const Discretisation<2> &discretisation) const
{
  if (std::all_of(all.begin(), all.end(), [](const Bump &bump) { return bump.is_zero(); }))
    return 0.;
  const NodeFreedom freedom(solution, discretisation.unknowns);
  NodalDisplacement<2> X(solution, freedom);
  const std::vector<bool> near = near_bumps();
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (near[k] && (faces[k].condition->friction || faces[k].condition->is_tied()))
      X.wish(faces[k], faces[k].frame(0.5).tangent, [](const double) { return 0.; });
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (near[k])
      X.wish(faces[k], faces[k].frame(0.5).normal, all[k]);
  X.move();
  double largest = 0;
  for (const Bump &bump : all)
    largest = std::max({largest, bump.ends[0], bump.ends[1], bump.inside});
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    const auto along = [&](const Tensor<1, 2> &direction)
    { return edge_trace(faces[k], direction, solution.displacement_space, solution.tables, X.u); };
    const EdgePolynomial normal = along(faces[k].frame(0.5).normal),
                         tangent = along(faces[k].frame(0.5).tangent);
    if (faces[k].condition->friction && tangent.largest() > 1e-9 * largest)
      return std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i <= 8; ++i)
      if (std::abs(normal(i / 8.) - all[k](i / 8.)) > 1e-9 * largest)
        return std::numeric_limits<double>::infinity();
  }
  const Vector<double> x = discretisation.unknowns.coordinates(X.u);
  return std::sqrt(std::max(0., BorderedMatrix{discretisation.system.A, {}}.energy(x)));
}

/** int pi (u_0 - U_n + M') over contact, and int g (|U_t| - l* U_t) of what friction has without pressure. */
double gap_of(const Solution<2> &solution, const AdmissibleFriction<2> &friction,
              const AdmissiblePressure<2> &pressure, const ContactCorrection<2> &correction,
              const std::vector<Bump> &bumps)
{
  const std::vector<ContactFace<2>> &faces = solution.contact_space.faces();
  double result = 0;
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    double of_face = 0;
    if (faces[k].condition->is_unilateral())
    {
      const EdgePolynomial pi = pressure.value(k), &depth = correction.penetration_along(k);
      const QGauss<1> &gauss = solution.tables.gauss(
          std::max(pi.coefficients().size(), depth.coefficients().size()) + 2);
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double s = gauss.point(q)[0];
        of_face += faces[k].length * gauss.weight(q) * pi(s) * (bumps[k](s) - depth(s));
      }
    }
    if (faces[k].condition->friction.bound && faces[k].n_multipliers > 0)
    {
      const EdgePolynomial &v = correction.slip(k);
      std::vector<double> cuts = v.zeros();
      cuts.insert(cuts.end(), faces[k].friction.cuts.begin(), faces[k].friction.cuts.end());
      std::sort(cuts.begin(), cuts.end());
      const QGauss<1> &gauss = solution.tables.gauss(faces[k].degree + 8);
      for (unsigned int i = 0; i + 1 < cuts.size(); ++i)
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const double s = cuts[i] + (cuts[i + 1] - cuts[i]) * gauss.point(q)[0], value = v(s);
          of_face += faces[k].length * (cuts[i + 1] - cuts[i]) * gauss.weight(q) *
                     faces[k].friction_bound(faces[k].point(s)) *
                     (std::abs(value) - friction.value(k, s) * value);
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
                        const Discretisation<2> &discretisation,
                        const AdmissibleFriction<2> &friction,
                        const AdmissiblePressure<2> &pressure,
                        const ContactCorrection<2> &correction, const double A, const double b)
{
  result.kind = BoundKind::estimate;
  for (const ContactFace<2> &face : solution.contact_space.faces())
    if (face.condition->friction && !face.condition->friction.is_proportional())
    {
      result.why = face.condition->friction.name() +
                   " has no bound of the error, whatever the coupling: its limit follows the "
                   "pressure " +
                   (face.condition->friction.by_pressure ? "by a curve" : "up to a bound alone");
      return;
    }
  const CoulombCoupling couple(solution, spaces);
  const auto bound = [&](const SlipDirection &chi)
  {
    const Excess excess(solution, correction, chi);
    return coulomb_bound(result.coupling,
                         {A, gap_of(solution, friction, pressure, correction, excess.bumps()), b,
                          excess.lift(solution, discretisation)});
  };
  const SlipDirection chi = slip_direction(solution, friction, correction);
  result.why = couple.unbounded_at(chi);
  if (result.why.empty())
  {
    result.coupling = couple(chi);
    const double total =
        result.coupling <= largest_coupling ? bound(chi) : std::numeric_limits<double>::infinity();
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
  const SlipZones zones = slip_zones(solution, correction);
  if (zones.contradicts || !couple.unbounded_at(zones.direction, zones.sticks).empty())
    return;
  const double known = std::exchange(result.coupling, couple(zones.direction, zones.sticks));
  const double total = result.coupling <= largest_coupling
                           ? bound(zones.direction)
                           : std::numeric_limits<double>::infinity();
  if (!std::isfinite(total))
  {
    result.coupling = known;
    return;
  }
  result.total = result.radius = total;
  result.theta = 0;
  result.kind = BoundKind::zones;
  result.zones = zones.words;
  result.why.clear();
}
} // namespace hpvi
