// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mean_intervals_h
#define hpvi_mean_intervals_h

#include <hpvi/bound/part_tables.h>
#include <hpvi/driver/step_report.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace hpvi
{
/**
 * Guaranteed intervals of the mean displacements of probes. With d of ErrorBound u - u_N - d is a displacement of V, so that for a mean q
 * and any theta
 *
 *     |q(u) - q(u_N) - theta (s - sigma(u_N), eps(z_N))| <= (R + theta O_c) |z|_a + theta A |z - z_N|_a + |d|_a |z|_a + |q(d)|,
 *
 * z the solution of a(z, v) = q(v) in V, |z|_a the norm of q. It does not depend on u_N: one run of a few steps finds z_N with its own guaranteed
 * bound, and `|z|_a^2 <= |z_N|_a^2 + bound^2`. A <= eta + O, R + theta O_c = ErrorBound::radius for its theta, ErrorBound::total for theta = 0.
 * The interval stands about q(u_N), with theta times the work in its half-width.
 * Probes at whose place d does not vanish have none.
 *
 * Where edges are curved each step has a body of its own. z_N is then that of its mesh, the mean that along its edges, and theta 0.
 */
template <int dim>
class MeanIntervals
{
public:
  /** Solves a scene, from the mesh of a solution on if there is one, and hears of its steps. */
  using Solve = std::function<void(const Scene<2> &, const Solution<2> *,
                                   const std::function<void(const StepReport<2> &)> &)>;

  /** The scene must outlive this; @p solve finds z_N. */
  MeanIntervals(const Scene<dim> &scene, Solve solve);

  /** Sets the intervals of those of @p step that have one, and adds why others have none to StepReport::no_intervals. */
  void set(StepReport<dim> &step);

private:
  /** A mean as a load, or why its norm is not known. */
  struct Dual
  {
    std::shared_ptr<const Scene<2>> scene; ///< of z; must outlive it
    std::shared_ptr<const Solution<2>> z;  ///< z_N
    double norm = 0;      ///< no less than |z|_a [(stress length^dim)^{-1/2} length]
    double error = 0;     ///< no less than |z - z_N|_a
    double remainder = 0; ///< of the mean beside the load of z, in the same norm
    std::string why;      ///< empty: it is known
  };

  const Dual &dual(unsigned int probe, unsigned int component, const StepReport<dim> &step);
  Interval interval(const Measured &mean, const Dual &dual, const StepReport<dim> &step);

  const Scene<dim> &scene;
  const Solve solve;
  std::map<std::array<unsigned int, 2>, Dual> duals;
  PartTables tables;
};
} // namespace hpvi

#endif
