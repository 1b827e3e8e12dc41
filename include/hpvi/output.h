// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_output_h
#define hpvi_output_h

#include <hpvi/adaptive_solver.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * Writes everything that a run leaves behind, and is the only one that writes files. Each file is
 * renamed into place whole; the tables and `summary.json` are brought up to date after every step,
 * so that a run which ends early keeps its finished steps.
 *
 * | file | content |
 * |---|---|
 * | `scene.prm` | every parameter with its value |
 * | `convergence.csv` | a row per step: `estimate*` in stress length^(dim/2), energies in stress length^dim, times in seconds; empty where nothing was computed |
 * | `degrees.csv` | number of elements of each degree, a row per step |
 * | `contact-NN.csv` | traces at the Gauss points of the contact faces, sorted along the tangent |
 * | `solution-NN.vtu`, `solution.pvd` | displacement, stress, degree and eta_K on subdivided cells |
 * | `mesh-NN.svg` | the mesh with degrees in colour and as digits (two dimensions) |
 * | `reference.dat` | the last displacement, to measure other runs against |
 * | `summary.json` | how the run ended and what stopped it, its last row, seconds per stage, warnings |
 *
 * Numbers are written with as many digits as it takes to read the same number back. The units are
 * those of the scene. What the scene switches off is neither built nor written. Tractions of the
 * contact tables are those of the contact alone, without a load that acts on the same edge:
 * `n.(sigma n) - n.G` and `-g lambda`.
 */
template <int dim>
class Output
{
public:
  /**
   * Create @p directory with its parents and prove that it can be written, by writing `scene.prm`;
   * remove the files that an earlier run left there. Throws InputError naming the directory.
   */
  Output(const Scene<dim> &scene, const std::string &directory);

  /** Write the files of one finished step and bring the tables up to date. Throws InputError. */
  void write_step(const Step<dim> &step);

  /**
   * Write how the run ended: @p status is "done" or one line that says why it gave up. Throws
   * InputError, but not after a failure, which says more than a summary that cannot be written.
   */
  void finish(const std::string &status);

private:
  /** Column names and values of one row; an empty value is an empty field. */
  using Record = std::vector<std::pair<std::string, std::string>>;

  void prepare_directory() const;
  void write(const std::string &name, const std::string &content) const;
  void add_rows(const Step<dim> &step);
  void write_tables() const;
  void write_summary(const std::string &status, const std::string &message) const;
  void write_vtu(const Step<dim> &step, const std::string &name) const;

  const Scene<dim> &scene;
  const std::filesystem::path directory;
  const ShapeTables<dim> tables;
  std::vector<Record> convergence;                ///< a record per step
  std::vector<std::vector<unsigned int>> degrees; ///< elements by step and degree
  StageTimes times;                               ///< sums over the steps
  std::string stopped_by;                         ///< the limit that ended the run
  std::vector<std::string> warnings;
  std::vector<std::pair<double, std::string>> vtu_files; ///< step and file name
};
} // namespace hpvi

#endif
