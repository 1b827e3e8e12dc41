// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_friction_iteration_h
#define hpvi_friction_iteration_h

#include <hpvi/solvers/anderson.h>
#include <hpvi/space/semismooth_newton.h>

#include <functional>
#include <vector>

namespace hpvi
{
/**
 * Finds friction that follows the pressure, `|T_t,k| <= limit(p_k)` at each Gauss point, as the fixed point of problems
 * of Tresca: each has the limits of the pressures of the one before, with Anderson's acceleration, and is solved by
 * SemismoothNewton to a tenth of what its limits are wrong by. The first one of all has no pressures and hence, but for
 * cohesion, no friction. It contracts where the coefficient times the coupling of pressure and friction is small; there
 * the solution is unique. Where no law knows the pressure one problem is all.
 */
template <int dim>
class FrictionIteration
{
public:
  /** Both live as long as this. */
  FrictionIteration(const PrimalSpace<dim> &space, SemismoothNewton<dim> &newton);

  /**
   * As SemismoothNewton::solve(), whose settings ask for the residual and the error under the limits of the pressures found:
   * @p lambda obeys the law to round-off. Collective. Throws NumericalFailure where the fixed point does not converge.
   */
  NewtonReport solve(
      DistributedVector &v, std::vector<ContactVector<dim>> &lambda, const NewtonSettings &settings,
      const std::function<void(const NewtonReport &)> &heard = [](const NewtonReport &) {});

private:
  dealii::Vector<double> pressures(const std::vector<ContactVector<dim>> &lambda) const;
  double weight(unsigned int i, const dealii::Vector<double> &x) const;
  void take_limits(const dealii::Vector<double> &x, const DistributedVector &v,
                   std::vector<ContactVector<dim>> &lambda);

  const PrimalSpace<dim> &space;
  SemismoothNewton<dim> &newton;
  std::vector<unsigned int> frictions; ///< of this process that follow a pressure
  unsigned int first = 0;              ///< of them among those of all processes
  std::vector<double> weights;         ///< that SemismoothNewton has
  Anderson acceleration;
};
} // namespace hpvi

#endif
