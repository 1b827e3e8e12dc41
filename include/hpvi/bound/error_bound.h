// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_error_bound_h
#define hpvi_error_bound_h

#include <hpvi/bound/edge_bubbles.h>
#include <hpvi/bound/edge_traction.h>
#include <hpvi/bound/mixed_problem.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace hpvi
{
/** What is bounded, and on which terms. */
enum class BoundKind
{
  energy,   ///< the error, guaranteed
  coupling, ///< that of every solution of Coulomb's law, if the coupling is no more than it says
  zones,    ///< the same of a solution that sticks and slips where it says
  history, ///< that of every solution whose slip counts from the computed past, with a coupling under Coulomb's law
  estimate ///< nothing: Tresca's bound for the same stress
};

/** As in `bound_kind`: "energy", "coupling", "zones", "history", "estimate". */
std::string text(BoundKind kind);

class CoulombBounds;

/**
 * A guaranteed bound of the error of u_N against the solution u of the variational inequality. With a
 * stress s in equilibrium, friction -g lam*, |lam*| <= 1, along the contact, and a pressure pi >= 0 where that
 * is unilateral,
 *
 *     |u - u_N|_a <= min over lambda in (0, 1] of the root E of E^2 = A^2 + 2 lambda gap + ((1 - lambda) E + lambda b)^2,
 *     gap = gap(u_N - w),   b^2 = sum_K (|w|_K + |d|_K)^2,   A^2 = sum_K (eta_K + O_K)^2,
 *     eta = |s - sigma(u_N)| in energy,   gap(v) = int g (|v_t| - lam* v_t) + int pi (u_0 - v_n),
 *
 * w from ContactCorrection, O and d from DataError; with lambda = 1 `A^2 + 2 gap + b^2`. The energy
 * of an admissible displacement, U = u_N + d, or u_N - w + d where contact is unilateral, is above the least
 * one by at most
 *
 *     J(U) - J(u) <= (A + |d|_a)^2/2 + gap(u_N),   or   (A + b)^2/2 + gap(u_N - w).
 *
 * Where the friction bound varies so much that no admissible friction is in balance with u_N, s is near the stress of
 * u_N + x, x the displacement by what is missing, and near incompressibility that of MixedProblem, or of u_N once
 * it does not lock; eta tells its distance from sigma(u_N) all the same. doc/bound.md proves both.
 */
struct ErrorBound
{
  BoundKind kind = BoundKind::energy;
  double coupling = std::numeric_limits<double>::quiet_NaN(); ///< theta under Coulomb's law [-]
  std::string coupling_known; ///< how: "estimated", "finite part computed"
  std::string zones;          ///< of BoundKind::zones: what is assumed of the solution, in words
  std::string why;            ///< of BoundKind::estimate: why there is no bound

  /** Without the factor that the coupling makes; total where the law has no coupling, and where there is no bound. */
  double estimate = 0;

  double total = 0;       ///< of |u - u_N|_a, (stress length^dim)^{1/2}
  double stress = 0;      ///< eta
  double slip = 0;        ///< (2 gap(u_N - w) + |w|_a^2)^{1/2}
  double oscillation = 0; ///< O
  double data = 0;        ///< |d|_a
  double energy = 0;      ///< of J(U) - J(u) [stress length^dim]

  /** `J(u_N) - energy_below <= J(u) <= J(u_N) + energy_above`; u_N admissible on parallelograms: energy and 0. */
  double energy_below = 0, energy_above = 0;

  /** By active cell: eta_K^2 and what oscillation and slip add; to mark by. */
  std::vector<double> squares;

  std::vector<double> indicators() const; ///< roots of squares

  /** By active cell: |w|_K^2 and |d|_K, of what makes U of u_N; |w|_K^2 of the w that the bound of the energy has, if it is another. */
  std::vector<double> moved, lifted, moved_by_energy;

  /**
   * Between sigma(u_N) and s lies m = sigma(u_N) + theta (s - sigma(u_N)), which for some theta in [0, 1/2) is nearer to
   * sigma(u) than either: |sigma(u) - m| <= R,
   *
   *     R^2 = (1 - theta) [(1 - theta) A^2 + 2 gap + (1 - theta)/(1 - 2 theta) b^2].
   *
   * Where R + theta O_c is least, O_c = DataError::beside. Under Coulomb's law 0 and total.
   */
  double theta = 0, radius = 0; ///< radius: R + theta O_c

  /** s n on all edges of the boundary. */
  std::vector<EdgeTraction> tractions;

  /** Largest imbalance of a patch, relative to its tractions: what round-off leaves of equilibrium. */
  double imbalance = 0;

  /** Where u_N may lock: eta of the stress made of u_N, if that is as near as another; else 0. For the next step. */
  double hysteresis = 0;

  std::string flaw; ///< why nothing of this is guaranteed, or empty
};

/**
 * Friction that counts slip from a computed past makes what is known of the error a statement about this past, without an interval of the
 * energy; where zones are assumed, too, an estimate.
 */
void count_from_past(ErrorBound &bound);

/** None: a problem that it needs is not solved, for the reason @p what. */
ErrorBound no_solution_for_bound(const std::string &what);

/** The least root E over lambda of what bounds the error, for the A, gap and b of ErrorBound. */
double least_root(double A, double gap, double b);

/** Computes the bounds of one scene step by step, with what it keeps between steps. */
class ErrorBounds
{
public:
  ErrorBounds();
  ~ErrorBounds();

  /**
   * no_error_bound() must be empty. @p factor: that of the discretisation, if it is at hand; @p hysteresis:
   * ErrorBound::hysteresis of the step before.
   */
  ErrorBound compute(const Solution<2> &solution, const Discretisation<2> &discretisation,
                     std::unique_ptr<LinearSolver> factor = nullptr, double hysteresis = 0);

private:
  struct AdmissibleStress;
  struct Contact;

  Contact contact_of(const Solution<2> &solution, const Discretisation<2> &discretisation,
                     const AdmissibleStress &made);

  std::unique_ptr<const AdmissibleStress>
  stress_of_mixed_problem(const Solution<2> &solution, std::unique_ptr<LinearSolver> factor);

  std::unique_ptr<const AdmissibleStress> nearest_stress(const Solution<2> &solution,
                                                         const Discretisation<2> &discretisation,
                                                         std::unique_ptr<LinearSolver> factor,
                                                         double &hysteresis);

  EquilibrationCache cache;
  EdgeBubbles bubbles;
  std::unique_ptr<CoulombBounds> coulomb;
  std::unique_ptr<MixedProblem> mixed; ///< where a material is nearly incompressible
};
} // namespace hpvi

#endif
