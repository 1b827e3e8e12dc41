// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_h
#define hpvi_scene_h

#include <hpvi/base/input_error.h>
#include <hpvi/scene/boundary_condition.h>
#include <hpvi/scene/contact_pair.h>
#include <hpvi/scene/data_scale.h>
#include <hpvi/scene/exact_solution.h>
#include <hpvi/scene/friction_law.h>
#include <hpvi/scene/geometry.h>
#include <hpvi/scene/initial_strain.h>
#include <hpvi/scene/material.h>
#include <hpvi/scene/pretension.h>
#include <hpvi/scene/probe.h>
#include <hpvi/scene/rigid_plate.h>

#include <deal.II/base/exceptions.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
class Parameters;

/** How `u_n <= u_0` is discretised; doc/contact.md compares the two. */
enum class NormalContact
{
  multiplier, ///< in the moments of a multiplier lambda_n >= 0 of degree p + offset
  nodes,      ///< at the Gauss-Lobatto points of each edge, the thesis's set (3.67)
  automatic   ///< nodes where they are offered, see Scene::normal_contact()
};

/** The methods of Chapter 5, and one that needs fewer unknowns and less time. */
enum class Method
{
  hup2,
  hup3,
  hup4,
  hap2,
  hap3,
  hap4,
  pu,
  hpa1,
  hpa2,
  hpa3, ///< not in the thesis: fewer unknowns, doc/accuracy.md
  hpa4  ///< hpa3 in strides, doc/accuracy.md
};

/** How the decay rate of (4.81) is read from the coefficients; doc/chapter5.md compares the two. */
enum class SmoothnessReading
{
  plain, ///< one fit of ln|c_ij| per component, b the smaller slope
  joint  ///< one fit of ln(sqrt((2i+1)(2j+1)) |(c^1_ij, c^2_ij)|)
};

/** What minimises over the multipliers; doc/stability.md compares the two. */
enum class QpSolver
{
  mprgp,     ///< Mprgp, the thesis's
  active_set ///< ActiveSet
};

/** `2 pi x`, the way around the axis [length]. */
template <int dim>
double full_turn(const dealii::Point<dim> &x)
{
  return 2 * dealii::numbers::PI * x[0];
}

/** What is known of the error, cell by cell and in all. */
enum class Indicator
{
  residual, ///< of (4.44)-(4.51)
  bound     ///< ErrorBound
};

/** An error that `Tolerance on` may name beside those of Indicator: ErrorBound::estimate. */
constexpr const char *equilibrated_estimate = "error_estimate_equilibrated";

/** The degree of the coarse mesh with which the thesis starts @p method. */
unsigned int own_start_degree(Method method);

/** The rule of Section 4.3 and Chapter 5 with its numbers. */
struct Adaptivity
{
  Method method = Method::hpa3;
  SmoothnessReading reading = SmoothnessReading::joint;
  Indicator indicator = Indicator::bound; ///< what marks; the residual where there is no bound
  unsigned int start_degree = 3; ///< p >= -offset of the multiplier at the contact boundary
  std::vector<unsigned int> degrees_of_bodies; ///< in its place in space, by body; 0: itself
  unsigned int maximum_degree = 12; ///< cells of this degree are bisected where p would rise
  double hap_threshold = 0.5;       ///< hap: bisect where eta_K > threshold * mean(eta_K)
  double hpa1_bisected = 0.1;       ///< hpa1: fraction of elements bisected
  double hpa1_raised = 0.1;    ///< hpa1: fraction of elements, next in order, whose p is raised
  double hpa2_marked = 0.2;    ///< hpa2: fraction of elements refined
  double hpa2_decay = 1;       ///< hpa2: raise p where b > this, else bisect
  double hpa3_threshold = 0.2; ///< hpa3: refine where eta_K > threshold * max(eta_K)
  double hpa3_decay = 0.8;     ///< hpa3: raise p where b > this, else bisect
  unsigned int maximum_steps = 16;
  unsigned int maximum_unknowns = 1000000; ///< no step is started after one with more dofs_free
  double maximum_seconds = 0;              ///< no step is started after this time; 0: no limit
  double tolerance = 0;                    ///< stop where the relative error falls below; 0: never
  bool is_default_tolerance = false; ///< the file named no limit: its reader chose the tolerance
  Indicator tolerance_on =
      Indicator::bound; ///< as this knows it; the residual where none is guaranteed
  /** In its place what the tolerance is on: a column with a half-width, or a probe; empty: the error. */
  std::string tolerance_column;
};

/** What finds Coulomb friction. */
enum class CoulombMethod
{
  newton,     ///< semismooth Newton on pressures and frictions at once
  fixed_point ///< Tresca problems with the bounds of the last one, accelerated
};

/** Which discrete problem is solved; doc/space.md sets them beside each other. */
enum class SolutionPath
{
  automatic, ///< primal in space, on several processes and where read_scene() finds it faster; else reduced
  reduced, ///< a quadratic program for the multipliers, its matrix dense
  primal   ///< a convex minimum in displacements and moments, its matrices sparse
};

/** What solves the linear systems of the primal path. */
enum class LinearMethod
{
  automatic, ///< the fastest that the mesh allows, see NewtonMatrix
  multigrid, ///< conjugate gradients without a matrix, preconditioned by geometric multigrid: in space
  amg,       ///< conjugate gradients, preconditioned by algebraic multigrid
  direct     ///< sparse factorisation
};

/** How the discrete problem is solved. */
struct SolverSettings
{
  SolutionPath path = SolutionPath::automatic;
  LinearMethod linear = LinearMethod::automatic;
  double primal_tolerance = 0; ///< of Newton's residual, relative to the load vector; 0: see entry
  QpSolver qp_solver = QpSolver::active_set;
  bool qp_warm_start = true;                        ///< from the multiplier of the previous step
  double qp_tolerance = 1e-12;                      ///< |g^P| <= tolerance * max(|d|, |S z_0|)
  unsigned int qp_maximum_multiplications = 100000; ///< more products with S: exit status 2
  bool diagonal_scaling = true;
  NormalContact normal_contact = NormalContact::automatic;
  CoulombMethod coulomb_method = CoulombMethod::newton;
  bool check_uniqueness = false; ///< of Coulomb friction: solve from another start, too
  int multiplier_offset = -2;    ///< the multiplier has degree p_K + offset on a contact edge
  bool condition_number =
      false; ///< report cond(S), raw and scaled: costs an eigenvalue computation
  unsigned int threads =
      1; ///< of a step in the plane on one process; 0: all that the process may use
};

/** Of which steps the files with their number in the name are written. */
enum class OutputSteps
{
  all,
  last ///< the one that ends the run; of a load history that of each load step
};

/** Which files are written besides the tables. */
struct OutputSettings
{
  OutputSteps steps = OutputSteps::all;
  bool vtu = true;
  bool contact = true;
  bool reference = false; ///< reference.dat after the last step
};

/** Which steps of a load history refine their mesh. */
enum class LoadAdaptivity
{
  first_step, ///< the later ones solve once, on the mesh of the first
  every_step  ///< each begins with the mesh of the one before
};

/**
 * A history of loads, t = 1/steps, 2/steps, ..., 1: quasi-static evolution, in which friction acts on
 * the increment of the tangential displacement (LoadHistory).
 */
template <int dim>
struct Loading
{
  unsigned int steps = 0; ///< from t = 0 to 1; 0: one problem, without time
  LoadAdaptivity adapt = LoadAdaptivity::every_step;
  /** The scene at the time t, itself without history: same body, same kinds of conditions. */
  std::function<Scene<dim>(double t)> at;
  /**
   * The steps are a cycle that is repeated until the energy that friction dissipates in one differs from that in the one before by
   * less than this share; 0: they are gone through once.
   */
  double until_steady = 0;
  unsigned int maximum_cycles = 20; ///< of these

  double time(unsigned int step) const;        ///< of a load step, counted from 1, in its cycle
  unsigned int cycle(unsigned int step) const; ///< likewise from 1; 0: there are none
};

/** What a scene is there for. */
enum class SceneUse
{
  solve,  ///< a run: what no run can solve is refused
  measure ///< the inf-sup constant: multipliers that are too many are what it shall find
};

/**
 * One problem and how to solve it: plain data, built by code or by read_scene(). Later stages take
 * it by const reference.
 */
template <int dim>
struct Scene
{
  using Expression = hpvi::Expression<dim>;

  Scene(); ///< the unit box, with free boundaries of the usual names and the defaults of a file

  std::string name = "scene"; ///< of the directory for results: the file's without suffix
  std::string title;          ///< one line for humans
  std::string length_unit;
  std::string stress_unit;

  Geometry<dim> geometry;
  std::vector<Material> materials; ///< indexed by the material_id of a cell; at first one
  /** The index of the material at the centre of a coarse cell; null: 0 everywhere. */
  std::function<dealii::types::material_id(const dealii::Point<dim> &)> material_at;
  /** Of a mesh, by CoarseMesh::Cell::surface; nothing: material_at says. */
  std::vector<std::optional<dealii::types::material_id>> material_of_surface;
  std::vector<BoundaryCondition<dim>> boundaries; ///< indexed by boundary_id
  std::vector<ContactPair> pairs;                 ///< of bodies that touch
  std::vector<Pretension<dim>> pretensions;       ///< bolts that are tightened
  std::vector<Probe<dim>> probes;                 ///< what results tell of single places
  Load<dim> body_force;                           ///< components of F [stress/length]; null: zero
  /** In its place, by material id, where materials differ in what they weigh. */
  std::vector<Load<dim>> body_force_of_material;
  /** By material id; empty: there is none anywhere. */
  std::vector<InitialStrain<dim>> initial_strains;
  double thickness = 1;                                     ///< of a plane body [length]
  std::shared_ptr<const ExactSolution<dim>> exact_solution; ///< null: none is known
  std::string reference_solution; ///< file of a StoredSolution to measure errors against, or empty
  Adaptivity adaptivity;
  bool error_bound = dim == 2;     ///< compute ErrorBound where there is one
  bool error_bound_last = false;   ///< of the last step alone, and where the tolerance is near
  bool localised_coupling = false; ///< of Coulomb's law from above, where CoulombCoupling can
  bool intervals = true;           ///< of forces and means, where there is an ErrorBound
  SolverSettings solver;
  OutputSettings output;
  Loading<dim> loading;
  DataScale past_data; ///< of the load steps before this one; zero without a history

  std::vector<std::string> remarks; ///< what its reader has changed: lines for users

  std::string file; ///< as the user named it, for messages; empty: the scene was built by code
  std::shared_ptr<const Parameters> parameters; ///< what it says, for its reader; likewise null

  /** That of a coarse cell with this centre and, of a mesh, this number. */
  dealii::types::material_id material_of_coarse_cell(const dealii::Point<dim> &centre,
                                                     unsigned int cell) const;

  bool has_material_places() const; ///< is it said where materials are?

  /** The degree of the body of this number on the coarse mesh: its own, or Adaptivity/Start degree. */
  unsigned int start_degree_of(unsigned int body) const;

  /** Makes boundaries of the names and numbers that those of the geometry have, all free. */
  void name_boundaries();

  /** Throws InputError where there is none of this name. */
  BoundaryCondition<dim> &boundary(const std::string &name);

  std::string
  origin() const; ///< the file as the user named it, or the name: messages begin with it

  /** The material of @p cell, which its children inherit. */
  template <class Cell>
  const Material &material_of(const Cell &cell) const
  {
    AssertThrow(cell->material_id() < materials.size(),
                dealii::ExcMessage("The scene has no material of the number that a cell carries."));
    return materials[cell->material_id()];
  }

  /** That of the first material [stress], by which the error indicator is scaled. */
  double reference_coercivity() const;

  double largest_weight() const; ///< of the stiffest material [stress], for bounds of round-off

  bool has_body_force() const;
  std::vector<Load<dim>> body_forces() const; ///< of all materials, which may have one

  /** F in @p cell. */
  template <class Cell>
  const Load<dim> &body_force_in(const Cell &cell) const
  {
    return body_force_of_material.empty() ? body_force
                                          : body_force_of_material.at(cell->material_id());
  }

  bool has_initial_strain() const;

  /** That of @p cell at @p x, in the plane (Material::in_plane()): what HookesLaw wants to be subtracted from gradients. */
  template <class Cell>
  dealii::Tensor<2, dim> initial_strain_in(const Cell &cell, const dealii::Point<dim> &x) const
  {
    return initial_strains.empty() ? dealii::Tensor<2, dim>()
                                   : initial_strain(cell->material_id(), x);
  }
  dealii::Tensor<2, dim> initial_strain(dealii::types::material_id material,
                                        const dealii::Point<dim> &x) const;

  /** Is it a body of revolution, x the radius and y the axis? Materials agree on that. */
  bool is_axisymmetric() const
  {
    return dim == 2 && materials.front().plane == PlaneModel::axisymmetric;
  }

  /** What a measure in the plane becomes at @p x: `2 pi x` of an axisymmetric body [length], else 1. */
  double circumference(const dealii::Point<dim> &x) const
  {
    return is_axisymmetric() ? full_turn(x) : 1.;
  }

  /**
   * The elastic strain around the axis of an axisymmetric body at @p x: `u_x/x`, on the axis its limit `d_x u_x`, without the
   * initial strain e33; else 0.
   */
  double hoop_strain(dealii::types::material_id material, const dealii::Tensor<1, dim> &u,
                     const dealii::Tensor<2, dim> &gradient, const dealii::Point<dim> &x) const;

  bool has_parts() const; ///< is any boundary a part of a side?
  bool has_springs() const;
  bool has_plates() const;

  /** Is any of the materials? */
  bool is_nearly_incompressible() const;
  bool has_load_history() const;
  bool has_contact() const;
  bool has_pairs() const;            ///< do bodies touch each other?
  bool has_known_solution() const;   ///< exact or reference: can the true error be measured?
  bool has_friction() const;         ///< has any contact boundary a law?
  bool has_coulomb_friction() const; ///< one that knows the pressure?
  bool has_unilateral_contact() const;
  /** What SolverSettings::normal_contact asks for; automatic: nodes, but multiplier for Coulomb's law and on the primal path. */
  NormalContact normal_contact() const;
  bool has_pressure() const; ///< has T_n of any contact boundary a multiplier of its own?

  /**
   * A basis of the motions that prescribed displacements and bilateral contact leave free, so that
   * friction and unilateral contact alone can hold the body (a semicoercive problem); most scenes have
   * none. Throws InputError where no contact can resist at all.
   */
  std::vector<RigidBodyMotion<dim>> free_motions() const;
};
} // namespace hpvi

#endif
