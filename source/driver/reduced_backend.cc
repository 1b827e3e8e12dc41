// SPDX-License-Identifier: LGPL-2.1-or-later

// Reduced to the contact: the way to solve that the thesis takes. A sparse factorisation eliminates the
// body, a dense program for friction and pressure remains. What steps share is little: tables of
// shape functions, element matrices that come again, and the multiplier of the step before, as a
// function on the contact boundary, from which the next one starts.
#include <hpvi/algebra/schur_complement.h>
#include <hpvi/base/finite.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/memory.h>
#include <hpvi/bound/edge_polynomial.h>
#include <hpvi/driver/reduced_backend.h>
#include <hpvi/plane/curved_edges.h>
#include <hpvi/plane/folded_cell.h>
#include <hpvi/plane/matching.h>
#include <hpvi/plane/missed_loads.h>
#include <hpvi/plane/negligible_solution.h>
#include <hpvi/plane/pretension_force.h>
#include <hpvi/plane/static_admissibility.h>
#include <hpvi/results/solution_field.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace hpvi
{
using namespace dealii;

/**
 * A factored and reduced to the contact, for one right-hand side after the other. Load steps on one mesh
 * have the same A, B and S as long as the same unknowns are prescribed and the same edges have friction:
 * the factorisation is most of their time.
 */
class FactoredSystem
{
public:
  /** @p factored holds the factor of A, @p f and @p rows are as in SchurComplement. */
  FactoredSystem(LinearSolver factored, const Vector<double> &f, const ConditionRows &rows)
      : solver(std::move(factored)), reduction(solver, f, rows)
  {
  }

  FactoredSystem(const FactoredSystem &) = delete; // members refer to one another

  LinearSolver solver;
  SchurComplement reduction;

  /** What has been factored, for is_of(). */
  void remember(const SymmetricMatrix &A, const std::vector<Stabilisation> &stabilisation,
                const ConditionRows &rows)
  {
    known_A = A;
    known_stabilisation = stabilisation;
    known_rows = rows;
  }

  /** Is this to the last bit what is remembered? */
  bool is_of(const SymmetricMatrix &A, const std::vector<Stabilisation> &stabilisation,
             const ConditionRows &rows) const
  {
    const auto same = [](const Stabilisation &a, const Stabilisation &b)
    { return a.P == b.P && a.stiffness == b.stiffness; };
    return known_A.column_start == A.column_start && known_A.row == A.row &&
           known_A.value == A.value && known_rows.interface == rows.interface &&
           known_rows.B == rows.B &&
           std::equal(known_stabilisation.begin(), known_stabilisation.end(), stabilisation.begin(),
                      stabilisation.end(), same);
  }

private:
  SymmetricMatrix known_A; ///< without unknowns: nothing is remembered
  std::vector<Stabilisation> known_stabilisation;
  ConditionRows known_rows;
};

namespace
{
/**
 * The free motions of a scene that contact alone holds and the loads along them: those that contact sees first; of the
 * others a load that nothing resists is more than round-off.
 */
template <int dim>
LoadedMotions<dim> loaded_motions(const Discretisation<dim> &discretisation)
{
  const RigidMotions<dim> &free = *discretisation.free_motions;
  const Vector<double> &f = discretisation.system.f;
  const unsigned int n = discretisation.scene.free_motions().size();
  LoadedMotions<dim> result{{}, Vector<double>(n), free.n_seen(), discretisation.scene.thickness};
  for (unsigned int m = 0; m < n; ++m)
  {
    Vector<double> one(n);
    one[m] = 1;
    result.motions.push_back(free.motion(one));
    if (m < free.n_seen())
    {
      result.loads[m] = free.balance().e[m];
      continue;
    }
    const Vector<double> R = free.at_unknowns(one);
    double load = 0, absolute = 0;
    for (unsigned int k = 0; k < R.size(); ++k)
    {
      load += f[k] * R[k];
      absolute += std::abs(f[k] * R[k]);
    }
    if (std::abs(load) > 1e-10 * absolute)
      result.loads[m] = load;
  }
  return result;
}
} // namespace

namespace
{
/** For a step of its own, where bolts are tightened: their shortenings are a result. */
template <int dim>
std::shared_ptr<Scene<dim>> own_copy(const Scene<dim> &scene)
{
  return scene.pretensions.empty() ? nullptr : std::make_shared<Scene<dim>>(scene);
}

/** The same for the load step after that of @p last, whose bolts stay as they are. */
template <int dim>
std::shared_ptr<Scene<dim>> own_copy(const Scene<dim> &scene, const Scene<dim> &last)
{
  const auto result = own_copy(scene);
  if constexpr (dim == 2)
    for (unsigned int k = 0; result && k < result->pretensions.size(); ++k)
    {
      set_shortening(*result, k, last.pretensions[k].shortening);
      result->pretensions[k].is_fixed = true;
    }
  return result;
}
} // namespace

// @sect3{What steps share}
//
// The mesh is a shared pointer to a constant: a solution that a user keeps also keeps the mesh it lives on.
template <int dim>
ReducedBackend<dim>::ReducedBackend(const Scene<dim> &given_scene, std::shared_ptr<Scene<dim>> own,
                                    std::shared_ptr<Kept> all_kept)
    : Backend<dim>(own ? *own : given_scene, MPI_COMM_SELF), given(given_scene),
      own_scene(std::move(own)), kept(std::move(all_kept)), smoothness(scene.adaptivity.reading)
{
  prepare_blas();
  if (own_scene && !own_scene->pretensions.front().is_fixed)
    search.emplace(scene);
}

template <int dim>
ReducedBackend<dim>::ReducedBackend(const Scene<dim> &scene)
    : ReducedBackend(scene, own_copy(scene),
                     std::make_shared<Kept>(scene, std::make_shared<const ShapeTables<dim>>()))
{
  if (search)
    shorten(search->first());
  const auto coarse = std::make_shared<Triangulation<dim>>();
  make_mesh(scene, *coarse);
  cell_degrees.assign(coarse->n_active_cells(), scene.adaptivity.start_degree);
  set_edge_degrees(*coarse, cell_degrees);
  match_nested(scene, *kept->tables, *coarse, cell_degrees);
  mesh = coarse;
  look_at_loads(1);
}

template <int dim>
ReducedBackend<dim>::ReducedBackend(const Scene<dim> &scene, const Solution<dim> &other)
    : ReducedBackend(scene, own_copy(scene), std::make_shared<Kept>(scene, other.spaces->tables))
{
  mesh = {other.spaces, &other.displacement_space.triangulation()};
  cell_degrees = other.displacement_space.degrees();
  look_at_loads(1);
}

template <int dim>
ReducedBackend<dim>::ReducedBackend(const Scene<dim> &scene, ReducedBackend &last,
                                    const PastSlip<dim> &past)
    : ReducedBackend(scene, own_copy(scene, last.scene),
                     std::make_shared<Kept>(scene, last.kept->tables))
{
  transfer_from(last);
  look_at_loads(1);
  past_slip = past;
  is_load_step = true;
  if (last.factored)
    last.factored->remember(last.discretisation->system.A, last.discretisation->stabilisation(),
                            last.discretisation->contact_rows);
  factored = std::move(last.factored);
}

// The bound of one step and the solution of the next touch nothing in common but what steps share.
template <int dim>
ReducedBackend<dim>::ReducedBackend(ReducedBackend &here, const Refinement &refinement)
    : ReducedBackend(here.given, own_copy(here.scene), here.kept)
{
  search = here.search;
  transfer_from(here);
  loads = here.loads;
  finer_loads = here.finer_loads;
  late_load = here.late_load;
  past_slip = here.past_slip;
  is_load_step = here.is_load_step;
  here.factored.reset(); // there may not be room for two
  refine(refinement);
}

/** Mesh and start. */
template <int dim>
void ReducedBackend<dim>::transfer_from(const ReducedBackend &last)
{
  mesh = last.mesh;
  cell_degrees = last.cell_degrees;
  this->refined = last.refined;
  previous = last.previous;
  motion = last.motion;
}

/** The same on all meshes with these coarse cells. */
template <int dim>
void ReducedBackend<dim>::look_at_loads(const unsigned int finer)
{
  loads = std::make_shared<const LoadRules<dim>>(given, *mesh, kept->tables, finer);
  finer_loads = finer;
}

// @sect3{Discretise}
//
// Two objects make a step: the spaces, without any integral, and the discretisation, which has
// assembled $A$ and $f$. The old discretisation dies only when the new one stands, for they share
// element matrices: away from the refined cells most cells are congruent to cells that were there
// before.
template <int dim>
void ReducedBackend<dim>::assemble()
{
  if (discretisation && &discretisation->spaces->displacement_space.triangulation() == mesh.get())
    return; // prepare() has been here
  build();
  missing = missed_loads(*discretisation, *loads);
  if (missing.empty())
    return;
  late_load = missing;
  look_at_loads(4); // a closer look
  build();
  missing = missed_loads(*discretisation, *loads);
}

template <int dim>
void ReducedBackend<dim>::build()
{
  begin("numbering the unknowns of " + std::to_string(cell_degrees.size()) + " elements");
  std::shared_ptr<const Spaces<dim>> spaces;
  {
    StageTimer timer(times.setup);
    spaces = std::make_shared<const Spaces<dim>>(scene, mesh, cell_degrees, kept->tables, loads,
                                                 past_slip);
  }
  begin("assembling " + std::to_string(cell_degrees.size()) + " elements");
  if (scene.geometry.has_curves())
    require_no_folds(*mesh);
  StageTimer timer(times.assemble);
  unresolved = loads->unresolved(*mesh);
  missed_displacements = loads->missed_displacements(*mesh, cell_degrees);
  // The previous one goes last: it keeps the element matrices that the new one shares.
  discretisation = std::make_unique<const Discretisation<dim>>(scene, spaces, kept->elements);
}

// Where contact alone holds the body, statics has a say before anything is factored. Loads whose
// resultant lies outside the foundation end the run. A resultant inside may still pass between the
// last point of the multiplier and the end of the contact, where this mesh cannot press: cells are
// bisected there until it can, on the same mesh in the same way: a run state need not keep it.
template <int dim>
void ReducedBackend<dim>::discretise()
{
  assemble();
  if (!discretisation->free_motions)
    return;
  require_static_admissibility(discretisation->spaces->contact_space,
                               loaded_motions(*discretisation));
  for (unsigned int levels_left = 8;; --levels_left)
  {
    const std::optional<InadmissibleContact> missing = inadmissible_contact(
        discretisation->spaces->contact_space, loaded_motions(*discretisation));
    if (!missing)
      return;
    if (levels_left == 0 || missing->cells.empty())
      throw NumericalFailure(missing->why);
    Refinement refinement{std::vector<bool>(cell_degrees.size()), cell_degrees};
    for (const unsigned int cell : missing->cells)
      refinement.bisect[cell] = true;
    discretisation->spaces->keep_bound(scene, refinement);
    refine(refinement);
    assemble();
  }
}

// @sect3{Solve}
//
// The sparse factorisation reduces the elastic body to its contact boundary, equations (5.6) and
// (5.7). What remains is a quadratic program for friction and pressure, or Coulomb's cones, whose
// solution gives the displacement back. The starting value is the multiplier of the step before:
// stick and slip change little from mesh to mesh, and most programs then end after a few
// factorisations. <code>IterativeRefinement</code> wraps the whole, because on deep meshes the
// round-off of one solution is larger than the discretisation error of a well-resolved field.
//
// The load steps of a history that share a mesh share <code>factored</code>: prescribed values and loads
// are in the right-hand side alone.
template <int dim>
void ReducedBackend<dim>::factor()
{
  const ElasticSystem<dim> &system = discretisation->system;
  const ConditionRows &rows = discretisation->contact_rows;
  if (factored && factored->is_of(system.A, discretisation->stabilisation(), rows))
  {
    factored->reduction.set_load(system.f, rows.prescribed);
    return;
  }
  begin("factorising " + std::to_string(system.A.n()) + " unknowns", dense_note());
  kept_factor.reset(); // of a bound that nobody asked for
  factored.reset();    // there may not be room for two
  factored = std::make_shared<FactoredSystem>(discretisation->factor(), system.f, rows);
}

template <int dim>
void ReducedBackend<dim>::solve()
{
  const ElasticSystem<dim> &system = discretisation->system;
  check_finite("the load vector", std::accumulate(system.f.begin(), system.f.end(), 0.),
               system.f.linfty_norm());
  {
    StageTimer timer(times.factor);
    factor();
  }
  solve_program();
  if (search)
    tighten();
  if (needs_factor_again())
    kept_factor = std::make_unique<LinearSolver>(std::move(factored->solver));
  if (kept_factor || !is_load_step)
    factored.reset();
}

/** With the factor and the loads at hand. */
template <int dim>
void ReducedBackend<dim>::solve_program()
{
  const ElasticSystem<dim> &system = discretisation->system;
  const ContactSpace<dim> &contact_space = discretisation->spaces->contact_space;
  begin(contact_space.n_multipliers() > 0
            ? "finding stick and slip for " + std::to_string(contact_space.n_multipliers()) +
                  " multipliers"
            : "finding the displacement");
  program = {};
  program.z = previous.values(contact_space, *kept->tables);
  if (system.f.all_zero()) // the start would set the tolerance of a solution that may be zero
    program.z = 0.;
  const auto &motions = discretisation->free_motions;
  if (motions)
    program.motion = motions->from_basis(motion);
  const Timer timer;
  Vector<double> u = IterativeRefinement<dim>(*discretisation, kept->elements, factored->solver,
                                              factored->reduction)
                         .solve(program, algebraic);
  times.qp += program.seconds;
  times.recover += timer.wall_time() - program.seconds;
  if (drop_round_off(*discretisation, algebraic.energy_product, program.z, u))
    algebraic = {};
  keep_warm_start(program.z, motions ? motions->in_basis(program.motion) : Vector<double>());
  take(std::move(u), program.z);
}

// @sect3{Bolts}
//
// How much a bolt is shortened is found from outside: each try is a problem with another initial strain, of which the factor
// stays as it is, and contact begins where it was. Of one bolt two tries are exact where nothing opens or slips.
template <int dim>
void ReducedBackend<dim>::tighten()
{
  search->begin();
  for (;;)
  {
    const std::vector<double> next = search->next(scene, pretension_forces(*solution));
    if (next.empty())
      return;
    begin("tightening bolts");
    shorten(next);
    solve_program();
  }
}

template <int dim>
void ReducedBackend<dim>::shorten(const std::vector<double> &shortenings)
{
  for (unsigned int k = 0; k < shortenings.size(); ++k)
    set_shortening(*own_scene, k, shortenings[k]);
  if (!discretisation)
    return;
  {
    StageTimer timer(times.assemble);
    discretisation =
        std::make_unique<const Discretisation<dim>>(scene, discretisation->spaces, kept->elements);
  }
  StageTimer timer(times.factor);
  if (factored)
    factored->reduction.set_load(discretisation->system.f, discretisation->contact_rows.prescribed);
}

/** `|int (sigma(u) - sigma(u_N)) : E| <= |u - u_N|_a |E|`, u at the shortening of the step. */
template <int dim>
void ReducedBackend<dim>::bound_pretensions(const ErrorBound &bound,
                                            std::vector<Resultant<dim>> &forces) const
{
  for (const Pretension<dim> &cut : scene.pretensions)
    for (Resultant<dim> &row : forces)
      if (row.kind == ForceKind::pretension && row.name == cut.name)
        row.normal.interval =
            Interval{row.normal.value, bound.total * std::sqrt(layer_stiffness(scene, cut)) +
                                           1e-13 * layer_stiffness(scene, cut) * cut.shortening};
}

/** And what the search has learnt: a run that goes on finds the same last bits. */
template <int dim>
Vector<double> ReducedBackend<dim>::shortenings() const
{
  std::vector<double> result;
  for (const Pretension<dim> &cut : scene.pretensions)
    result.push_back(cut.shortening);
  if (search)
    for (const double slope : search->learnt())
      result.push_back(slope);
  return Vector<double>(result.begin(), result.end());
}

/** Will the bound solve with it once more? */
template <int dim>
bool ReducedBackend<dim>::needs_factor_again() const
{
  const auto &faces = discretisation->spaces->contact_space.faces();
  return scene.error_bound && discretisation->spaces->no_error_bound(scene).empty() &&
         (scene.is_nearly_incompressible() ||
          has_given_tractions(discretisation->spaces->contact_space) ||
          std::any_of(faces.begin(), faces.end(),
                      [](const auto &face) { return varies(face.friction); }));
}

template <int dim>
void ReducedBackend<dim>::take(Vector<double> u, const Vector<double> &z)
{
  auto taken = std::make_unique<Solution<dim>>(scene, discretisation->spaces, std::move(u), z);
  taken->own_scene = own_scene;
  solution = std::move(taken);
  missed_displacements = within_reach(missed_displacements, *solution);
  values_at_points = std::make_unique<const SolutionField<dim>>(*solution);
  known_forces.reset();
}

/** The next step begins where this one ends. */
template <int dim>
void ReducedBackend<dim>::keep_warm_start(const Vector<double> &z, const Vector<double> &moved)
{
  const ContactSpace<dim> &contact_space = discretisation->spaces->contact_space;
  if (contact_space.n_multipliers() == 0 || !scene.solver.qp_warm_start)
    return;
  previous = MultiplierTrace<dim>(contact_space, z);
  motion = moved;
}

// @sect3{The bound}
//
// The guaranteed bound needs the whole discrete problem, not only its solution. Where there is none its
// reason is kept, since "none" without a reason is no answer.
template <int dim>
BoundOfStep ReducedBackend<dim>::bound(const double hysteresis)
{
  BoundOfStep result;
  result.missing = scene.error_bound ? solution->spaces->no_error_bound(scene)
                                     : std::string("Error/Bound = false");
  if (result.missing.empty())
    result.missing = missing.empty() ? unresolved_loads(unresolved) : missing;
  if (!result.missing.empty())
    return result;
  begin("bounding the error of " + std::to_string(cell_degrees.size()) + " elements");
  result.take(bound_beside_forces(hysteresis));
  return result;
}

// @sect3{What no indicator can see}
//
// A jump of the friction bound or the coefficient inside an edge, contact that the points of the
// multiplier have missed, a gap, a bound or a coefficient that varies between these points, loads
// that no quadrature resolves and displacements that nodes miss: their cells are bisected until it
// is resolved.
template <int dim>
void ReducedBackend<dim>::mark_unresolved(Refinement &refinement) const
{
  const auto bisect = [&](const auto &places)
  {
    for (const auto &place : places)
      refinement.bisect[place.face->cell->active_cell_index()] = true;
  };
  bisect(solution->contact_space.unresolved_jumps(solution->z));
  bisect(unseen_contacts(*solution));
  bisect(unseen_gaps(*solution));
  bisect(solution->contact_space.unresolved_bounds(solution->z));
  for (const UnresolvedLoad<dim> &load : unresolved)
    refinement.bisect[load.cell] = true;
  for (const MissedDisplacement<dim> &displacement : missed_displacements)
    refinement.bisect[displacement.cell] = true;
  discretisation->spaces->keep_bound(scene, refinement);
}

/** Where it asks for more than the mesh at hand tells: spaces of one that nobody solves on. */
template <int dim>
void ReducedBackend<dim>::keep_bound(const Triangulation<dim> &of, const Degrees &degrees,
                                     Refinement &refinement) const
{
  if (scene.has_pairs() && scene.error_bound)
    Spaces<dim>(scene, borrowed(of), degrees, kept->tables, loads, past_slip)
        .keep_bound(scene, refinement);
}

// @sect3{Refine}
//
// A copy of the mesh, for less than a hundredth of a step, so that every solution keeps its own.
template <int dim>
void ReducedBackend<dim>::refine(const Refinement &refinement)
{
  begin("refining");
  StageTimer timer(times.refine);
  this->refined.emplace_back(refinement, cell_degrees);
  const auto next = std::make_shared<Triangulation<dim>>();
  next->copy_triangulation(*mesh);
  cell_degrees = refine_mesh(*next, cell_degrees, refinement);
  mesh = next;
}

// @sect3{What it tells of a step}
//
template <int dim>
ErrorEstimate ReducedBackend<dim>::estimate()
{
  begin("estimating the error of " + std::to_string(cell_degrees.size()) + " elements");
  StageTimer timer(times.estimate);
  return estimate_error(field());
}

template <int dim>
Warnings ReducedBackend<dim>::warnings(const std::vector<ContactState<dim>> &contact,
                                       const Equilibrium<dim> &) const
{
  Warnings result = joined(multiplier_warnings(*solution, contact, algebraic, program.coulomb),
                           unseen_warnings(*solution));
  if (!late_load.empty())
    result.push_back({WarningKind::load, 0.,
                      late_load + "; steps before knew nothing of it: put vertices there"});
  if (const std::string note = dense_note(); !note.empty())
    result.push_back({WarningKind::dense_work, 0., note});
  return result;
}

template <int dim>
ProblemSize ReducedBackend<dim>::size() const
{
  const DisplacementSpace<dim> &space = discretisation->spaces->displacement_space;
  ProblemSize result{types::global_dof_index(cell_degrees.size()),
                     space.n_dofs(),
                     space.n_free_dofs(),
                     discretisation->spaces->contact_space.n_multipliers(),
                     {}};
  result.count(cell_degrees);
  return result;
}

template <int dim>
bool ReducedBackend<dim>::restore(const SolutionValues &values)
{
  const Spaces<dim> &spaces = *discretisation->spaces;
  if (values.u.size() != spaces.displacement_space.n_dofs() ||
      values.z.size() != spaces.contact_space.n_multipliers() ||
      !(values.motion.size() == 0 || values.motion.size() == scene.free_motions().size()) ||
      values.kept.empty() || values.kept.back() == 0)
    return false;
  std::vector<unsigned int> levels = values.kept;
  if (levels.back() != finer_loads) // it did on another mesh of the load step
  {
    look_at_loads(levels.back());
    build();
  }
  levels.pop_back();
  if (own_scene)
  {
    const unsigned int n = scene.pretensions.size();
    if (values.shortenings.size() < n)
      return false;
    shorten({values.shortenings.begin(), values.shortenings.begin() + n});
    Vector<double> slopes(values.shortenings.begin() + n, values.shortenings.end());
    if (search)
      search.emplace(scene, slopes);
  }
  keep_warm_start(values.z, values.motion);
  kept->resultant_intervals.begin_with(levels);
  take(values.u, values.z);
  return true;
}

template class ReducedBackend<2>;
} // namespace hpvi
