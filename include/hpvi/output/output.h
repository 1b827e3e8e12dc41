// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_output_h
#define hpvi_output_h

#include <hpvi/driver/load_history.h>
#include <hpvi/driver/step_report.h>
#include <hpvi/output/result_directory.h>
#include <hpvi/output/summary.h>
#include <hpvi/output/tables.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace hpvi
{
/**
 * Results of a run that has begun cannot be written: what() is one line with directory, file and
 * reason, and says which steps are safe. Exit status 2.
 */
class OutputFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/**
 * Says which files a run leaves behind, and with ResultDirectory is the only one that writes files. Each file is
 * renamed into place whole; the tables and `summary.json` are brought up to date after every step,
 * so that a run which ends early keeps its finished steps. Tables and collections grow by one write of what is
 * new, so that the ten thousandth step costs no more than the first. `summary.json` names a file before it is
 * written, so that a run which is killed leaves nothing that a later one would not know.
 *
 * With OutputSteps::last the files of a step go when those of the next one are whole: however a run ends,
 * those of its last finished step are there.
 *
 * | file | content |
 * |---|---|
 * | `scene.prm` | every parameter with its value |
 * | `convergence.csv` | a row per step: `estimate*` in stress length^(dim/2), energies in stress length^dim, times in seconds; empty where nothing was computed |
 * | `degrees.csv` | number of elements of each degree, a row per step |
 * | `forces.csv` | a row per step and boundary: its force on the body |
 * | `loading.csv` | a row per load step, where the scene has a history |
 * | `contact-history.csv` | contact_history_rows(), likewise |
 * | `cycles.csv` | a row per cycle of Loading::until_steady |
 * | `contact-NN.csv` | traces at the Gauss points of the contact faces, sorted along the tangent |
 * | `probe-NAME-NN.csv` | displacement and stress along a line |
 * | `solution-NN.vtu`, `solution.pvd` | displacement, stress, degree and eta_K on cells of the degree of u_N |
 * | `contact-NN.vtu`, `contact.pvd` | what `contact-NN.csv` has, as lines along the contact |
 * | `solution-NN.pvtu`, `solution-NN.RANK.vtu` | the same in the place of `solution-NN.vtu`, by the cells of each of several processes |
 * | `state.dat` | all that it takes to go on after the last finished step, of a history the last finished load step: RunState |
 * | `reference.dat` | the last displacement, to measure other runs against |
 * | `summary.json` | how the run ended and what stopped it, its last row, seconds per stage, warnings, all files |
 *
 * Numbers are written with as many digits as it takes to read the same number back. The units are
 * those of the scene. What the scene switches off is neither built nor written. Tractions of the
 * contact tables are those of the contact alone, without a load that acts on the same edge:
 * `n.(sigma n) - n.G` and `-g lambda`.
 *
 * On several processes all functions but give_up() are collective: each writes its own piece of `solution-NN.pvtu`, the first
 * one all else.
 */
template <int dim>
class Output
{
public:
  /**
   * Create @p path with its parents and prove that it can be written, by writing `scene.prm`;
   * remove the files that an earlier run left there. Throws InputError naming the directory (see
   * ResultDirectory).
   */
  Output(const Scene<dim> &scene, const std::string &path, MPI_Comm communicator = MPI_COMM_SELF)
      : Output(scene, path, 0, communicator)
  {
  }

  /**
   * The same for a run that goes on after @p n_steps steps there: their files stay as they are, and those of later ones
   * are removed.
   */
  Output(const Scene<dim> &scene, const std::string &path, unsigned int n_steps,
         MPI_Comm communicator);

  /**
   * Write the files of one finished step, of no large mesh also the state of @p solver as `state.dat`, and bring the tables up to
   * date. Throws OutputFailure.
   */
  void write_step(const StepReport<dim> &step, const LoadHistory<dim> *solver = nullptr);

  /** Write that the run is done. Throws OutputFailure. */
  void finish();

  /**
   * Write how a run ended that did not get through, if that can be written: @p status is failed
   * or interrupted, @p message the line that says why.
   */
  void give_up(RunStatus status, const std::string &message);

  /** As in "steps 1 to 3 are safe": what a run leaves that ends here. */
  std::string safe_steps() const;

  /** ResultDirectory::other_scene(), whose results are replaced; of the first process. */
  std::string replaced_scene() const;

private:
  void open(const std::string &path, unsigned int n_steps);
  void take_up(unsigned int n_steps);
  void take_up_pictures(unsigned int n_steps);
  void announce(const std::vector<std::string> &names);
  void write(const std::string &name, const std::string &content) const;
  void update(const std::string &name, const GrowingText &content);
  void check(const std::string &name, const std::error_code &error) const;
  void by_first(const std::function<void()> &work) const;
  void update_tables();
  void write_summary() const;
  void write_state();
  void write_pieces(const StepReport<dim> &step);
  void write_pictures(const StepReport<dim> &step);
  void add_to_collections(const StepReport<dim> &step);
  void write_reference(const StepReport<dim> &step);
  void write_history(const StepReport<dim> &step);
  void write_tables(const StepReport<dim> &step, const std::optional<RunState<dim>> &state);

  const Scene<dim> &scene;
  const std::string path;
  const MPI_Comm communicator;
  const bool is_first;
  const unsigned int n_processes;
  std::unique_ptr<ResultDirectory> directory; ///< of the first process
  bool is_usable = false;                     ///< proved by writing `scene.prm`
  Tables<dim> tables;
  Summary summary;
  std::map<std::string, GrowingText> collections; ///< by name
  std::string last_state;              ///< of the last step of all, until the run is done
  std::vector<std::string> pictures;   ///< the files with the number of the step
  std::vector<std::string> superseded; ///< by those of the next step
};
} // namespace hpvi

#endif
