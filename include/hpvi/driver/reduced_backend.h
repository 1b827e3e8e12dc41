// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_reduced_backend_h
#define hpvi_reduced_backend_h

#include <hpvi/algebra/linear_solver.h>
#include <hpvi/base/dense_work.h>
#include <hpvi/base/thread_pool.h>
#include <hpvi/bound/resultant_intervals.h>
#include <hpvi/driver/backend.h>
#include <hpvi/driver/pretension_search.h>
#include <hpvi/plane/multiplier_trace.h>
#include <hpvi/results/legendre_smoothness.h>
#include <hpvi/results/unseen_contact.h>

#include <array>

namespace hpvi
{
class FactoredSystem;

/**
 * The body reduced to its contact boundary by a sparse factorisation, equations (5.6) and (5.7) of the
 * thesis, and a dense quadratic program, or Coulomb's cones, for the multipliers: meshes of any degrees in the
 * plane, on one process.
 */
template <int dim>
class ReducedBackend : public Backend<dim>
{
public:
  explicit ReducedBackend(const Scene<dim> &scene);

  /** On the mesh of @p other, of a scene with the same geometry, with its degrees and tables. */
  ReducedBackend(const Scene<dim> &scene, const Solution<dim> &other);

  /** Of the next load step of a history: it takes over mesh, tables, factor and multiplier of @p last. */
  ReducedBackend(const Scene<dim> &scene, ReducedBackend &last, const PastSlip<dim> &past);

  void discretise() override;
  void solve() override;
  const Field<dim> &field() const override
  {
    return *values_at_points;
  }

  ProblemSize size() const override;
  ErrorEstimate estimate() override;
  Energies energies() override
  {
    return hpvi::energies(field(), algebraic.energy_product,
                          discretisation->system.work(solution->u));
  }

  NodalForces<dim> nodal_forces() override
  {
    if (!known_forces)
      known_forces = hpvi::nodal_forces(*solution, discretisation->system);
    return *known_forces;
  }

  std::optional<ReducedPart<dim>> reduced() const override
  {
    return ReducedPart<dim>{*solution,
                            discretisation->system,
                            algebraic,
                            program.qp,
                            program.coulomb,
                            program.condition_raw,
                            program.condition_scaled};
  }

  BoundOfStep bound(double hysteresis) override;
  std::string bound_forces(const ErrorBound &bound, std::vector<Resultant<dim>> &forces) override
  {
    this->begin("bounding forces");
    bound_pretensions(bound, forces);
    return kept->resultant_intervals.set(*solution, bound, forces);
  }
  double decay_rate(const unsigned int cell) const override
  {
    return smoothness.decay_rate(*solution, cell);
  }

  void mark_unresolved(Refinement &refinement) const override;
  void keep_bound(const dealii::Triangulation<dim> &of, const Degrees &degrees,
                  Refinement &refinement) const override;
  bool resolves_data() override
  {
    return missing.empty() && unresolved.empty() && missed_displacements.empty() &&
           solution->contact_space.unresolved_jumps(solution->z).empty() &&
           solution->contact_space.unresolved_bounds(solution->z).empty() &&
           unseen_gaps(*solution).empty();
  }
  double missed(const std::optional<ErrorBound> &bound) const override
  {
    return bound ? bound->oscillation : 0.;
  }

  Warnings warnings(const std::vector<ContactState<dim>> &contact,
                    const Equilibrium<dim> &balance) const override;
  void refine(const Refinement &refinement) override;
  std::unique_ptr<Backend<dim>> ahead(const Refinement &refinement) override
  {
    return std::unique_ptr<Backend<dim>>(new ReducedBackend(*this, refinement));
  }

  Degrees degrees() const override
  {
    return cell_degrees;
  }

  SolutionValues values() const override
  {
    SolutionValues result{solution->u, solution->z, motion, shortenings(),
                          kept->resultant_intervals.levels()};
    result.kept.push_back(finer_loads);
    return result;
  }

  bool restore(const SolutionValues &values) override;
  std::unique_ptr<Backend<dim>> next_load_step(const Scene<dim> &scene,
                                               const PastSlip<dim> &past) override
  {
    return std::make_unique<ReducedBackend>(scene, *this, past);
  }

private:
  using Backend<dim>::scene;
  using Backend<dim>::times;
  using Backend<dim>::begin;

  /** What steps share. */
  struct Kept
  {
    Kept(const Scene<dim> &scene, std::shared_ptr<const ShapeTables<dim>> tables)
        : tables(std::move(tables)), elements(scene, *this->tables), resultant_intervals(scene)
    {
    }

    const std::shared_ptr<const ShapeTables<dim>> tables;
    CondensedElements<dim> elements; ///< of the step that is solved
    // Of the step whose error is bounded, which may be the one before:
    ErrorBounds error_bounds;
    ResultantIntervals resultant_intervals;
  };

  /** @p own: what this step knows of @p given, where that is not all; else null. */
  ReducedBackend(const Scene<dim> &given, std::shared_ptr<Scene<dim>> own,
                 std::shared_ptr<Kept> kept);
  ReducedBackend(ReducedBackend &here, const Refinement &refinement); ///< ahead()

  void transfer_from(const ReducedBackend &last);
  void look_at_loads(unsigned int finer);
  void assemble();
  void build();
  void factor();
  void solve_program();
  void tighten();
  void bound_pretensions(const ErrorBound &bound, std::vector<Resultant<dim>> &forces) const;
  void shorten(const std::vector<double> &shortenings);
  dealii::Vector<double> shortenings() const;
  void keep_warm_start(const dealii::Vector<double> &z, const dealii::Vector<double> &moved);
  void take(dealii::Vector<double> u, const dealii::Vector<double> &z);
  /** Much of the bound is for one thread: another one has the forces ready that will be asked for. */
  ErrorBound bound_beside_forces(const double hysteresis)
  {
    ErrorBound result;
    ErrorBounds anew; // which steps had one before must not decide about the last bits
    ErrorBounds &bounds = scene.error_bound_last ? anew : kept->error_bounds;
    std::array<double, 2> seconds{};
    const auto part = [&](const unsigned int k)
    {
      StageTimer timer(seconds[k]);
      if (k == 1)
        nodal_forces();
      else
        result = bounds.compute(*solution, *discretisation, std::move(kept_factor), hysteresis);
    };
    double both = 0; // less than their sum where there are two threads
    {
      StageTimer timer(both);
      parallel_for_each(2, 1, part);
    }
    times.bound += both * seconds[0] / (seconds[0] + seconds[1]);
    times.recover += both * seconds[1] / (seconds[0] + seconds[1]);
    return result;
  }
  /** Of the step whose system is assembled. */
  std::string dense_note() const
  {
    const auto &rows = discretisation->contact_rows;
    return DenseWork{rows.interface.size(), rows.n_rows()}.note();
  }
  bool needs_factor_again() const;

  const Scene<dim> &given;                ///< before anything is tightened
  std::shared_ptr<Scene<dim>> own_scene;  ///< with shortenings of this step; null: there are none
  std::optional<PretensionSearch> search; ///< while they are not fixed
  std::shared_ptr<const dealii::Triangulation<dim>> mesh;
  Degrees cell_degrees;
  const std::shared_ptr<Kept> kept;
  std::shared_ptr<const LoadRules<dim>> loads;
  unsigned int finer_loads = 1;   ///< how close it looks
  std::string missing, late_load; ///< missed_loads() of this mesh, of an earlier one
  const LegendreSmoothness<dim> smoothness;
  std::vector<UnresolvedLoad<dim>> unresolved; ///< of the current step, as all that follows
  std::vector<MissedDisplacement<dim>> missed_displacements;
  std::unique_ptr<const Discretisation<dim>> discretisation;
  std::shared_ptr<FactoredSystem> factored;  ///< of it, or of the last load step
  std::unique_ptr<LinearSolver> kept_factor; ///< for a bound that needs it once more
  PastSlip<dim> past_slip;                   ///< of the load step before
  bool is_load_step = false;                 ///< then the factor stays for the next one
  MultiplierTrace<dim> previous; ///< multiplier of the previous step, zero unless it is wanted
  dealii::Vector<double> motion; ///< likewise, of the free motions of the scene
  ReducedSolution program;       ///< what solved it
  AlgebraicError algebraic;
  std::unique_ptr<const Solution<dim>> solution;
  std::unique_ptr<const Field<dim>> values_at_points; ///< of the solution
  std::optional<NodalForces<dim>> known_forces;       ///< likewise
};
} // namespace hpvi

#endif
