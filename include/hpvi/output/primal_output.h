// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_primal_output_h
#define hpvi_primal_output_h

#include <hpvi/output/record.h>
#include <hpvi/output/result_directory.h>
#include <hpvi/output/summary.h>
#include <hpvi/primal/primal_solver.h>

#include <memory>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * What Output is for the reduced path: the files of a run of the primal path, with the same names, columns and
 * promises. The first process writes them all but `solution-NN.RANK.vtu`, of which each process
 * writes its own. In space tangential columns of the contact tables have the suffixes _x, _y, _z.
 * All functions are collective.
 */
template <int dim>
class PrimalOutput
{
public:
  /** As Output::Output(). Throws InputError. */
  PrimalOutput(const Scene<dim> &scene, const std::string &path, MPI_Comm communicator);

  /** Throws OutputFailure. */
  void write_step(const PrimalReport<dim> &step);

  /** Write that the run is done. Throws likewise. */
  void finish();

  /** As Output::give_up(); not collective, and of no effect but on the first process. */
  void give_up(const std::string &status, const std::string &message);

  /** As in "steps 1 to 3 are safe". */
  std::string safe_steps() const;

  /** As Output::replaced_scene(); of the first process. */
  std::string replaced_scene() const;

private:
  void announce(const std::vector<std::string> &names);
  void write(const std::string &name, const std::string &content) const;
  void update(const std::string &name, const GrowingText &content);
  void check(const std::string &name, const std::error_code &error) const;
  void write_solution(const PrimalReport<dim> &step);
  void write_tables(const PrimalReport<dim> &step);
  void count(const PrimalReport<dim> &step, const Record &row);
  void write_summary() const;

  const Scene<dim> &scene;
  const std::string path;
  const MPI_Comm communicator;
  const bool is_first;
  std::unique_ptr<ResultDirectory> directory; ///< of the first process
  bool is_usable = false;                     ///< proved by the first files
  GrowingText convergence, degrees, pvd;
  std::vector<std::string> pictures;   ///< the files with the number of the step
  std::vector<std::string> superseded; ///< by those of the next step
  Summary summary;
};
} // namespace hpvi

#endif
