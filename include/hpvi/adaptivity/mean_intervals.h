// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mean_intervals_h
#define hpvi_mean_intervals_h

#include <hpvi/adaptivity/step_report.h>

#include <array>
#include <map>
#include <optional>
#include <string>

namespace hpvi
{
/**
 * Guaranteed intervals of the mean displacements of probes. With d of ErrorBound u - u_N - d is a displacement of V, so that for a mean q
 *
 *     |q(u) - q(u_N)| <= (B + |d|_a) |q|_* + |q(d)|,    B = ErrorBound::total,
 *
 * |q|_* the norm of q on V. That does not depend on u_N: it is the energy norm of the solution z of one linear problem, and
 * `|z|_a^2 <= |z_N|_a^2 + (its own guaranteed bound)^2`, found once by a run of a few steps. Probes at whose place d does not vanish have none.
 */
template <int dim>
class MeanIntervals
{
public:
  /** The scene must outlive this. */
  explicit MeanIntervals(const Scene<dim> &scene);

  /** Sets the intervals of those of @p step that have one, and adds why others have none to StepReport::no_intervals. */
  void set(StepReport<dim> &step);

private:
  /** |q|_*, or why it is not known. */
  struct Norm
  {
    std::optional<double> value; ///< [(stress length^dim)^{-1/2} length]
    std::string why;
  };

  const Norm &norm(unsigned int probe, unsigned int component);

  const Scene<dim> &scene;
  std::map<std::array<unsigned int, 2>, Norm> norms;
};
} // namespace hpvi

#endif
