// SPDX-License-Identifier: LGPL-2.1-or-later

// The guaranteed bound puts together what other files of this folder make. It rests on the theorem
// of Prager and Synge, extended to friction: with a stress $s$ in equilibrium with the loads and
// with an admissible friction $-g\lambda^*$, $|\lambda^*| \le 1$ everywhere, and a pressure
// $\pi \ge 0$ where contact is unilateral,
//
// $$\begin{aligned}
//   |u - u_N|_a^2 &\le |s - \sigma(u_N)|^2 + 2\,\mathrm{gap}(u_N - w) + |w|_a^2,
//   \\ \mathrm{gap}(v) &= \int_{\Gamma_C} g\,(|v_t| - \lambda^* v_t) + \pi\,(u_0 - v_n)\,ds,
// \end{aligned}$$
//
// for any displacement $w$ that vanishes where $u$ is prescribed and for which $u_N - w$ does not
// penetrate. The first term is the distance of two stresses, the second what the discrete friction misses of the law, and the third pays for
// $w$, which takes the oscillation of $u_N$ around zero away where the body sticks. The proof, and
// the terms that come from loads and supports which are no polynomials, are in doc/bound.md.
#include <hpvi/admissibility/admissible_friction.h>
#include <hpvi/admissibility/contact_correction.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/equilibration/data_error.h>
#include <hpvi/equilibration/error_bound.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Relative imbalance that is taken for round-off. */
constexpr double tolerable = 1e-9;

double sum(const std::vector<double> &values)
{
  return std::accumulate(values.begin(), values.end(), 0.);
}

/** |w|_a */
double norm(const ContactCorrection<2> &correction)
{
  return std::sqrt(std::max(0., sum(correction.energy()))); // round-off
}

/** No less than |d - w|_a: w is along the contact boundary, d elsewhere, so that the cells of both are few. */
double distance_from_admissible(const ContactCorrection<2> &correction, const DataError &data)
{
  double square = 0;
  for (unsigned int cell = 0; cell < data.lifts.size(); ++cell)
    square += std::pow(std::sqrt(std::max(0., correction.energy()[cell])) + data.lifts[cell], 2);
  return std::sqrt(square);
}

// @sect3{By cell}
//
// A bound is one number, but its square is a sum over cells: a second indicator to mark by, without
// unknown constants, and as fine at high degrees as at low ones.
void set_squares(ErrorBound &result, const Solution<2> &solution, const EquilibratedStress &stress,
                 const ContactCorrection<2> &correction, const DataError &data)
{
  for (unsigned int cell = 0; cell < stress.squares.size(); ++cell)
    result.squares.push_back(std::pow(std::sqrt(stress.squares[cell]) + data.oscillation[cell], 2) +
                             std::max(0., correction.energy()[cell]));
  const auto &faces = solution.contact_space.faces();
  for (unsigned int face = 0; face < faces.size(); ++face)
    result.squares[faces[face].cell->active_cell_index()] +=
        2 * std::max(0., correction.gap()[face]);
}

// @sect3{In the energy norm}
//
// The general form, with $O$ for the oscillation of loads and $d$ for displacements outside the
// space: $O + (\eta^2 + 2\,\mathrm{gap} + (b + O)^2)^{1/2}$ with $b \ge |d - w|_a$.
void set_norms(ErrorBound &result, const EquilibratedStress &stress,
               const ContactCorrection<2> &correction, const DataError &data)
{
  const double eta_square = sum(stress.squares), w = norm(correction),
               gap = std::max(0., sum(correction.gap())); // round-off
  result.stress = std::sqrt(eta_square);
  result.slip = std::sqrt(2 * gap + w * w);
  result.oscillation = std::sqrt(std::inner_product(
      data.oscillation.begin(), data.oscillation.end(), data.oscillation.begin(), 0.));
  result.data = data.lift;
  const double b = distance_from_admissible(correction, data);
  result.total =
      result.oscillation + std::sqrt(eta_square + 2 * gap + std::pow(b + result.oscillation, 2));
}

/** Of U = u_N - w + d; w, in V_N, is none but where u_N may penetrate. */
void set_energy(ErrorBound &result, const Solution<2> &solution,
                const Discretisation<2> &discretisation, const ContactCorrection<2> &correction,
                const DataError &data)
{
  const bool is_moved = solution.scene.has_unilateral_contact();
  const double w = is_moved ? norm(correction) : 0.,
               b = is_moved ? distance_from_admissible(correction, data) : data.lift,
               gap = sum(is_moved ? correction.gap() : correction.uncorrected_gap());
  double change = 0;
  if (is_moved)
  {
    Vector<double> v(correction.unknowns());
    v *= -1.;
    change = energy_change(solution, discretisation, v);
  }
  result.energy = std::pow(result.stress + b + result.oscillation, 2) / 2 + gap;
  // J(u_N - w + d) = J(u_N - w) + (sigma(u_N - w) - s, eps(d)) + int s n . d - R(d) + |d|^2/2
  const double centre = change + data.lift_work + data.lift * data.lift / 2,
               unknown = (result.stress + w + result.oscillation) * data.lift;
  const bool is_admissible = !is_moved && data.lift == 0.; // u_N itself
  result.energy_above = is_admissible ? 0. : centre + unknown;
  result.energy_below = result.energy + unknown - centre;
}

// @sect3{When there is none}
//
// Each assumption of the theorem is checked on the way. If one fails there is no bound, and a
// sentence that says why: a number that is nearly guaranteed is not guaranteed.
std::string flaw(const Solution<2> &solution, const AdmissiblePressure<2> &pressure,
                 const EquilibratedStress &stress, const ContactCorrection<2> &correction,
                 const DataError &data)
{
  if (pressure.fails())
    return "pressure is negative between the nodes of contact, and cannot be made admissible";
  if (correction.fails())
    return "the displacement penetrates the foundation between nodes, and supports keep it there";
  if (!(data.unread <= 1e-8 * solution.u.linfty_norm()))
    return "prescribed displacement or gap is not smooth along an edge";
  if (!(stress.defect <= tolerable))
    return "loads and contact are not in balance on some patch of cells";
  return {};
}

// @sect3{A friction bound that varies}
//
// Where $g$ varies between the points of the multiplier, friction within its bound may not do the
// work of $z_N$, and no stress near $\sigma(u_N)$ is in balance with it. Forces that make up for the
// difference move $u_N$; near the stress of what they make of it there is one.
std::optional<Solution<2>> moved(const Solution<2> &solution,
                                 const Discretisation<2> &discretisation,
                                 const AdmissibleFriction<2> &friction,
                                 const LinearSolver *const factor)
{
  if (friction.imbalance() <= tolerable)
    return std::nullopt;
  const Vector<double> forces = discretisation.unknowns.collect(friction.missing_forces(solution));
  Vector<double> u = discretisation.unknowns.expand(factor ? factor->solve(forces)
                                                           : discretisation.factor().solve(forces));
  discretisation.condensation.extend(u);
  u += solution.u;
  return Solution<2>(solution.scene, solution.spaces, u, solution.z);
}

// @sect3{Friction, pressure and stress}
//
// Tractions along the contact that keep their bounds everywhere, and a stress in equilibrium with them
// and with the loads. They are made of a discrete solution, not always that whose error is bounded.
struct AdmissibleStress
{
  AdmissibleStress(const Solution<2> &start, const Discretisation<2> &discretisation,
                   const LinearSolver *const factor, const Solution<2> &measured,
                   const Volume volume, EquilibrationCache &cache)
      : friction(start), pressure(start), balanced(moved(start, discretisation, friction, factor)),
        stress(
            balanced ? *balanced : start,
            [&](const unsigned int face, const unsigned int end)
            { return friction.part(face, end).coefficients(); },
            [&](const unsigned int face, const unsigned int end)
            { return pressure.part(face, end).coefficients(); },
            cache, balanced || &start != &measured ? &measured : nullptr, volume)
  {
  }

  const AdmissibleFriction<2> friction;
  const AdmissiblePressure<2> pressure;
  const std::optional<Solution<2>> balanced;
  const EquilibratedStress stress;
};
} // namespace

std::vector<double> ErrorBound::indicators() const
{
  std::vector<double> result;
  for (const double square : squares)
    result.push_back(std::sqrt(square));
  return result;
}

// @sect3{The order of things}
//
// A stress; a correction $w$ for what $u_N$ does where it should stick; and what data leave. Near
// incompressibility the pressure of $u_N$ oscillates, and a stress in equilibrium with it is far from that of the
// solution; the stress and tractions are those of a mixed method then, which is corrected for round-off if the
// patches show it. The energy of $u_N - w$ is known for a $w$ in $V_N$ alone.
ErrorBound ErrorBounds::compute(const Solution<2> &solution,
                                const Discretisation<2> &discretisation,
                                std::unique_ptr<LinearSolver> factor)
try
{
  std::optional<Solution<2>> stable;
  std::unique_ptr<const AdmissibleStress> made;
  const auto make = [&](const Solution<2> &start, const Discretisation<2> &of, const Volume volume)
  {
    made =
        std::make_unique<const AdmissibleStress>(start, of, factor.get(), solution, volume, cache);
  };
  if (!solution.scene.is_nearly_incompressible() || has_distorted_cells(solution))
    make(solution, discretisation, Volume::full);
  else
  {
    if (!mixed)
      mixed = std::make_unique<MixedProblem<2>>(solution.scene);
    stable.emplace(mixed->solve(solution, factor));
    make(*stable, mixed->discretisation(), Volume::projected);
    if (!(made->stress.defect <= tolerable))
    {
      stable.emplace(mixed->correct(*stable, *factor));
      make(*stable, mixed->discretisation(), Volume::projected);
    }
  }
  const auto &[friction, pressure, balanced, stress] = *made;
  const ContactCorrection<2> correction(solution, discretisation, friction, pressure, &bubbles);
  const DataError data(solution, stress);
  ErrorBound result;
  set_squares(result, solution, stress, correction, data);
  set_norms(result, stress, correction, data);
  if (solution.scene.has_unilateral_contact())
    set_energy(result, solution, discretisation,
               ContactCorrection<2>(solution, discretisation, friction, pressure, nullptr), data);
  else
    set_energy(result, solution, discretisation, correction, data);
  result.imbalance = stress.defect;
  result.flaw = flaw(solution, pressure, stress, correction, data);
  return result;
}
catch (const NumericalFailure &failure)
{
  ErrorBound result;
  result.flaw = std::string("a problem that the bound needs is not solved: ") + failure.what();
  return result;
}
} // namespace hpvi
