// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_h
#define hpvi_scene_h

#include <hpvi/base/input_error.h>
#include <hpvi/scene/exact_solution.h>
#include <hpvi/scene/geometry.h>
#include <hpvi/scene/material.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/function.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** Everything that a scene says about one named part of the boundary. */
template <int dim>
struct BoundaryCondition
{
  using Expression = std::shared_ptr<const dealii::Function<dim>>;

  std::string name;                         ///< left, right, bottom, top, front, back
  dealii::types::boundary_id id;            ///< deal.II's number: the index into Scene::boundaries
  std::array<Expression, dim> displacement; ///< prescribed components u_D [length]; null: free
  std::array<Expression, dim> traction;     ///< components of G [stress]; null: zero
  bool bilateral_contact;                   ///< u_n = 0
  Expression friction_bound;                ///< Tresca's g(x) >= 0 [stress]; null: no friction

  bool has_displacement() const; ///< is any component prescribed?
  bool has_traction() const;     ///< is any component given?
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
  hpa3 ///< not in the thesis: the winner of doc/accuracy.md
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

/** The rule of Section 4.3 and Chapter 5 with its numbers. */
struct Adaptivity
{
  Method method;
  SmoothnessReading reading;
  unsigned int start_degree;   ///< p >= -offset of the multiplier at the contact boundary
  unsigned int maximum_degree; ///< cells of this degree are bisected where p would rise
  double hap_threshold;        ///< hap: bisect where eta_K > threshold * mean(eta_K)
  double hpa1_bisected;        ///< hpa1: fraction of elements bisected
  double hpa1_raised;          ///< hpa1: fraction of elements, next in order, whose p is raised
  double hpa2_marked;          ///< hpa2: fraction of elements refined
  double hpa2_decay;           ///< hpa2: raise p where b > this, else bisect
  double hpa3_threshold;       ///< hpa3: refine where eta_K > threshold * max(eta_K)
  double hpa3_decay;           ///< hpa3: raise p where b > this, else bisect
  unsigned int maximum_steps;
  unsigned int maximum_unknowns; ///< no step is started after one with more dofs_free
  double maximum_seconds;        ///< no step is started after this time; 0: no limit
  double tolerance;              ///< stop where the relative indicator falls below; 0: never
};

/** How the quadratic program is solved. */
struct SolverSettings
{
  QpSolver qp_solver;
  bool qp_warm_start;                      ///< from the multiplier of the previous step
  double qp_tolerance;                     ///< |g^P| <= tolerance * max(|d|, |S z_0|)
  unsigned int qp_maximum_multiplications; ///< more products with S than this: exit status 2
  bool diagonal_scaling;
  int multiplier_offset; ///< the multiplier has degree p_K + offset on a contact edge
  bool condition_number; ///< report cond(S), raw and scaled: costs an eigenvalue computation
};

/** Which files are written besides the tables. */
struct OutputSettings
{
  bool vtu;
  bool mesh_picture;
  bool contact;
  bool reference; ///< reference.dat after the last step
};

/** What a scene is read for. */
enum class SceneUse
{
  solve,  ///< a run: what no run can solve is refused
  measure ///< the inf-sup constant: multipliers that are too many are what it shall find
};

/**
 * A checked, immutable description of one problem, read from a parameter file. Later stages take
 * it by const reference and never see the parameter file itself.
 */
template <int dim>
struct Scene
{
  using Expression = typename BoundaryCondition<dim>::Expression;

  std::string file;  ///< as the user named it, for messages
  std::string name;  ///< file name without directory and suffix
  std::string title; ///< one line for humans
  std::string length_unit;
  std::string stress_unit;

  Geometry<dim> geometry;
  std::vector<Material> materials;                ///< indexed by the material_id of a cell
  std::vector<BoundaryCondition<dim>> boundaries; ///< indexed by boundary_id
  std::array<Expression, dim> body_force;         ///< components of F [stress/length]; null: zero
  /** The unit vector of a translation that friction alone resists; most scenes have none. */
  std::optional<dealii::Tensor<1, dim>> free_translation;
  std::shared_ptr<const ExactSolution<dim>> exact_solution; ///< null: none is known
  std::string reference_solution; ///< file of a StoredSolution to measure errors against, or empty
  Adaptivity adaptivity;
  SolverSettings solver;
  OutputSettings output;

  std::string effective_parameters; ///< the text of scene.prm: every entry with its value

  /** The material of @p cell, which its children inherit. */
  template <class Cell>
  const Material &material_of(const Cell &cell) const
  {
    AssertThrow(cell->material_id() < materials.size(),
                dealii::ExcMessage("The scene has no material of the number that a cell carries."));
    return materials[cell->material_id()];
  }

  /** `c |eps(v)|^2 <= a(v,v)` for every v: the least coercivity of all materials [stress]. */
  double coercivity() const;

  double largest_mu() const; ///< of the stiffest material [stress], for bounds of round-off

  bool has_body_force() const;
  bool has_contact() const;
  bool has_known_solution() const; ///< exact or reference: can the true error be measured?
  bool has_friction() const;       ///< does any contact boundary name a friction bound?

  /**
   * Read and check @p file; @p overrides are pairs "Section/Entry", "value" from the command line.
   * Throws InputError with one line (file, entry, value, remedy).
   */
  static Scene read(const std::string &file,
                    const std::vector<std::pair<std::string, std::string>> &overrides = {},
                    SceneUse use = SceneUse::solve);

  /** All entries with defaults and documentation, as a parameter file. */
  static std::string default_parameters();
};
} // namespace hpvi

#endif
