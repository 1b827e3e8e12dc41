// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_pressure_iteration_h
#define hpvi_pressure_iteration_h

#include <hpvi/solvers/cone_iterate.h>
#include <hpvi/solvers/quadratic_program.h>

#include <optional>

namespace hpvi
{
/**
 * The fixed point for a ConeProgram: problems of Tresca, each with the pressures of the one before, with
 * Anderson's acceleration. Moves an iterate, to which it refers.
 */
class PressureIteration
{
public:
  explicit PressureIteration(ConeIterate &iterate);

  /** With free motions there may be no balance without friction: then nothing slips. */
  void minimise_without_friction();

  /** At most @p maximum_steps of it. Does the iterate solve the program then? */
  bool run(unsigned int maximum_steps);

  unsigned int steps = 0; ///< each one problem of Tresca
  double contraction = 0; ///< as far as seen

private:
  dealii::Vector<double> pressures() const;
  bool minimise(const FeasibleSet &feasible_set);
  void put_on_cones(const FeasibleSet &tresca);

  ConeIterate &iterate;
  ConeIterate::Point &point; ///< of the iterate
  std::optional<QuadraticProgram> tresca;
};
} // namespace hpvi

#endif
