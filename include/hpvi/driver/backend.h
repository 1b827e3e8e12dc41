// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_backend_h
#define hpvi_backend_h

#include <hpvi/base/progress.h>
#include <hpvi/base/stage_times.h>
#include <hpvi/bound/error_bound.h>
#include <hpvi/plane/iterative_refinement.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/results/contact_state.h>
#include <hpvi/results/energies.h>
#include <hpvi/results/equilibrium.h>
#include <hpvi/results/field.h>
#include <hpvi/results/residual_estimator.h>
#include <hpvi/results/resultant.h>
#include <hpvi/results/true_error.h>
#include <hpvi/results/warnings/warnings.h>
#include <hpvi/solvers/coulomb_solver.h>
#include <hpvi/space/semismooth_newton.h>

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/** How large a discrete problem is, of all processes. */
struct ProblemSize
{
  dealii::types::global_dof_index n_cells = 0;
  dealii::types::global_dof_index n_dofs = 0; ///< displacements, before constraints
  dealii::types::global_dof_index n_free = 0; ///< displacements after them
  dealii::types::global_dof_index n_multipliers = 0;
  std::vector<dealii::types::global_dof_index> cells_of_degree; ///< by p; nothing at 0

  void count(const Degrees &degrees); ///< cells_of_degree
  unsigned int p_min() const;
  unsigned int p_max() const;
};

/** What the reduced backend alone knows of a step. */
template <int dim>
struct ReducedPart
{
  const Solution<dim> &solution;
  const ElasticSystem<dim> &system; ///< of the discrete problem
  AlgebraicError algebraic;         ///< what round-off leaves in u_N
  QpReport qp;                      ///< all zero without multipliers
  CoulombReport coulomb;            ///< likewise without Coulomb friction
  double condition_raw = 0;         ///< cond(S), 0 unless the scene asks for it
  double condition_scaled = 0;      ///< cond(D^-1/2 S D^-1/2), likewise
};

/** What the primal backend alone knows of a step. */
template <int dim>
struct PrimalPart
{
  const PrimalSpace<dim> &space;
  const DistributedVector &u; ///< nodal values, with those of neighbours
  NewtonReport newton;
  /** What the body has done since the load step before, or since it was at rest. Collective. */
  std::function<Work()> work_done;
};

/** The guaranteed bound of a step, or why there is none. */
struct BoundOfStep
{
  std::optional<ErrorBound> bound; ///< none: not asked for, or not on offer
  std::string missing;             ///< why there is none
  /** ErrorBound::imbalance, also where that is why; NaN: not computed. */
  double imbalance = std::numeric_limits<double>::quiet_NaN();
  std::optional<ErrorBound> estimate =
      std::nullopt; ///< of BoundKind::estimate, where there is no bound

  void
  take(const ErrorBound &computed); ///< sorts it into what it is: a bound, an estimate, or none
};

/** u_N and the multiplier as numbers that do not depend on how many processes found them. */
struct SolutionValues
{
  dealii::Vector<double> u;           ///< displacement unknowns [length]
  dealii::Vector<double> z;           ///< multipliers
  dealii::Vector<double> motion;      ///< amounts of Scene::free_motions() by which the body moves
  dealii::Vector<double> shortenings; ///< of Scene::pretensions, then what their search has learnt
  std::vector<unsigned int> kept;     ///< what the backend alone remembers of steps before
};

/**
 * A way to solve: a discrete problem and its solution on one mesh after the other, each refined from the
 * one before, with what it keeps from step to step. The loop is AdaptiveSolver's, and what is known of a
 * solution comes from its Field, whichever way found it. Functions are collective; those that are asked
 * about a step are asked between solve() and refine().
 */
template <int dim>
class Backend
{
public:
  Backend(const Scene<dim> &scene, MPI_Comm communicator);
  virtual ~Backend() = default;

  /** Numbers and assembles the problem of the current mesh, which may be bisected first where contact has to press. */
  virtual void discretise() = 0;

  /** Throws NumericalFailure. */
  virtual void solve() = 0;

  virtual const Field<dim> &field() const = 0;
  virtual ProblemSize size() const = 0;
  virtual ErrorEstimate estimate() = 0;
  virtual Energies energies() = 0;
  virtual NodalForces<dim> nodal_forces() = 0;             ///< of supports, contact and loads
  virtual std::optional<ReducedPart<dim>> reduced() const; ///< none on another path
  virtual std::optional<PrimalPart<dim>> primal() const;   ///< likewise

  /** An upper end of the least J(u) that needs no bound of the error; NaN: none. Collective. */
  virtual double energy_high();

  /** @p hysteresis: ErrorBound::hysteresis of the step before. */
  virtual BoundOfStep bound(double hysteresis) = 0;

  /**
   * Sets the guaranteed intervals of @p forces, where there are any; returns why some have none. With the @p bound of
   * the step.
   */
  virtual std::string bound_forces(const ErrorBound &bound, std::vector<Resultant<dim>> &forces);

  /** The decay rate of Legendre coefficients in a cell of Refinement; asked for marked cells alone. */
  virtual double decay_rate(unsigned int cell) const = 0;

  /** What the indicator may be and the solution exact: that of its last bits. */
  virtual double round_off_estimate() const;

  /** Bisects what no indicator can see. */
  virtual void mark_unresolved(Refinement &refinement) const = 0;

  /** Adds to @p refinement of a mesh with these degrees what the bound of the next step needs of it. */
  virtual void keep_bound(const dealii::Triangulation<dim> &, const Degrees &, Refinement &) const
  {
  }

  /** Does the discrete problem see all that it is known to be given: loads, strains, springs, gaps, displacements, friction? Collective. */
  virtual bool resolves_data() = 0;

  /** What u_N misses of the data, in the energy norm; @p bound of the step tells more of it. */
  virtual double missed(const std::optional<ErrorBound> &bound) const = 0;

  /** What it alone can say of the step, beside warnings(). */
  virtual Warnings warnings(const std::vector<ContactState<dim>> &contact,
                            const Equilibrium<dim> &balance) const = 0;

  /** Cells of a Refinement, and of degrees(), are those of all processes, by global_cell_indices(). Collective, as size(). */
  virtual void refine(const Refinement &refinement) = 0;
  virtual Degrees degrees() const = 0;

  /**
   * In the place of refine(): one for the next step, which may be solved by one thread while another asks this one about its
   * own. What steps share goes on to it, so that this one is not to solve() any more. Null where there is none.
   */
  virtual std::unique_ptr<Backend> ahead(const Refinement &refinement);

  /** All refinements since the coarse mesh, those of discretise() among them. */
  const std::vector<MeshMarks> &refinement_history() const
  {
    return refined;
  }

  virtual SolutionValues values() const = 0;

  /** In the place of solve(); false where they are those of another mesh. */
  virtual bool restore(const SolutionValues &values) = 0;

  /**
   * The end of a load step, in the place of all that led to it: @p marks are the refinement_history() that it had, @p values its
   * values(); false where they are those of another mesh.
   */
  virtual bool restore_end(const std::vector<MeshMarks> &marks, const SolutionValues &values);

  /** For the next load step of a history, @p scene, on the mesh at hand, with slip from @p past on; takes over what this one keeps. */
  virtual std::unique_ptr<Backend> next_load_step(const Scene<dim> &scene,
                                                  const PastSlip<dim> &past) = 0;

  /** Hears of each stage before it begins, with a note on it; may throw to give up. */
  std::function<void(const std::string &stage, const std::string &note)> on_stage;

  const Scene<dim> &scene;
  const MPI_Comm communicator;
  StageTimes times; ///< of the current step

  /** Says so. */
  void begin(const std::string &stage, const std::string &note = {}) const;

protected:
  /** Refines by each of @p marks in turn; false where they are those of another mesh. */
  bool follow(const std::vector<MeshMarks> &marks);

  std::vector<MeshMarks> refined; ///< refinement_history()
};

/** Is it the primal path that solves @p scene, whose path is settled, on @p n processes? Throws InputError where none does. */
template <int dim>
bool takes_primal_path(const Scene<dim> &scene, unsigned int n);

/** The backend that SolverSettings::path asks for. Collective. Throws InputError where it does not offer what the scene needs. */
template <int dim>
std::unique_ptr<Backend<dim>> make_backend(const Scene<dim> &scene, MPI_Comm communicator);
} // namespace hpvi

#endif
