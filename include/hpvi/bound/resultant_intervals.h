// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_resultant_intervals_h
#define hpvi_resultant_intervals_h

#include <hpvi/bound/error_bound.h>
#include <hpvi/bound/open_contact.h>
#include <hpvi/bound/stress_work.h>
#include <hpvi/bound/test_space.h>
#include <hpvi/results/resultant.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * Intervals of the forces that boundaries exert, guaranteed as the bound is. With w of TestMotion the exact solution has F = a(u, w) - L(w) but
 * for the work of friction where w falls, so that with `F_w = a(u_N, w) - L(w)`, `F_s = int (s n - G) . w` over the edges
 * of the boundary and any theta
 *
 *     |F - (1 - theta) F_w - theta F_s| <= (R + theta O_c) |w|_a + sum int g |fall| (1 - s/l) ds,
 *
 * R + theta O_c = ErrorBound::radius for its theta, and ErrorBound::total for theta = 0. The interval stands about F_w, which is nearer to
 * F by an order, with theta |F_s - F_w| in its half-width.
 *
 * Where friction knows the pressure p, theta is 0, and with X of TestMotion::pressing() its work on a fall is at most
 *
 *     int mu_f p |fall| (1 - s/l) ds <= int pi X_n + (B + eta + O) |X|_a,
 *
 * pi the pressure of s.
 *
 * doc/bound.md has the proof. The test displacements of one step serve the next; where w falls its mesh gets finer as B
 * gets smaller, so that the second term stays below a tenth of the first.
 */
class ResultantIntervals
{
public:
  /** The scene must outlive this. */
  explicit ResultantIntervals(const Scene<2> &scene);

  /** Sets those of @p forces that have one; returns why others have none, in words. */
  std::string set(const Solution<2> &solution, const ErrorBound &bound,
                  std::vector<Resultant<2>> &forces);

  /** How often the mesh of the test displacements is bisected at each end of a fall: all that one step leaves to the next. */
  std::vector<unsigned int> levels() const;

  /** To be called before the first set(), with the levels() of a step before. */
  void begin_with(const std::vector<unsigned int> &levels);

private:
  /** X of TestMotion::pressing(). */
  struct Lift
  {
    TestMotion test;
    double norm; ///< |X|_a
  };

  /** A resultant of one boundary with its w. */
  struct Goal
  {
    BoundaryMotion motion;
    TestMotion test;
    dealii::Vector<double> w;
    double norm = 0;                ///< |w|_a
    double friction = 0;            ///< what a bound of friction may do where w falls
    std::vector<Lift> lifts{};      ///< of falls along friction that knows the pressure
    double pressed = 0, lifted = 0; ///< what that may do there, in this step: under pi, and else
    double pressure = 0;            ///< likewise what a pressure may
    bool is_pressed = false;        ///< or that is not known
    double centre = 0;              ///< F_w
    double rounding = 0;            ///< what arithmetic and quadrature may add
    double of_stress = 0;           ///< F_s
    double defect = 0;              ///< what s, out of balance by round-off, may add to it
  };

  struct OfBoundary
  {
    unsigned int boundary;
    std::vector<Goal> goals;

    const Goal *find(BoundaryMotion motion) const;
  };

  static std::string flaw_of(const Goal &goal);
  std::string flaws() const;
  void find_goals(const std::vector<Resultant<2>> &forces);
  bool is_solved(const Goal &goal) const;
  void solve(const Solution<2> &solution);
  bool grade(const Solution<2> &solution, const ErrorBound &bound);
  double missing_levels(const Goal &goal, unsigned int fall, double length,
                        const Solution<2> &solution, const ErrorBound &bound) const;
  void measure(const Solution<2> &solution, const ErrorBound &bound);
  TractionWork work_of(const TestMotion &motion, const Solution<2> &solution,
                       const ErrorBound &bound) const;
  void measure_lifts(Goal &goal, const Solution<2> &solution, const ErrorBound &bound) const;
  void measure_pressure(Goal &goal, const Solution<2> &solution, const ErrorBound &bound) const;
  std::optional<Interval> interval(const OfBoundary &boundary,
                                   const std::vector<std::pair<BoundaryMotion, double>> &sum,
                                   const ErrorBound &bound) const;
  void set(const OfBoundary &boundary, const ErrorBound &bound, Resultant<2> &row) const;

  const Scene<2> &scene;
  std::vector<Side<2>> sides; ///< once they are asked for
  std::vector<OfBoundary> boundaries;
  bool has_goals = false;
  std::vector<std::string> why_not;
  std::vector<GradedPoint> graded;    ///< the ends of all falls
  std::vector<unsigned int> at_first; ///< begin_with()
  const std::shared_ptr<PartTables> tables = std::make_shared<PartTables>();
  std::unique_ptr<TestSpace> space;
};
} // namespace hpvi

#endif
