// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_discretisation_h
#define hpvi_discretisation_h

#include <hpvi/plane/rigid_motion.h>

#include <memory>
#include <optional>

namespace hpvi
{
/** The spaces of one mesh, and the mesh: what a solution lives in. */
template <int dim>
class Spaces
{
public:
  const std::shared_ptr<const dealii::Triangulation<dim>> mesh;
  const std::shared_ptr<const ShapeTables<dim>> tables;
  const std::shared_ptr<const LoadRules<dim>> loads;
  const PastSlip<dim> past; ///< empty before the second load step of a history
  const DisplacementSpace<dim> displacement_space;
  const ContactSpace<dim> contact_space;
  const ContactOperator<dim> contact_operator;

  /**
   * @p degrees by active cell index. The scene must outlive the spaces. @p loads: those of the scene, if they are at
   * hand. @p past: where slip begins.
   */
  Spaces(const Scene<dim> &scene, std::shared_ptr<const dealii::Triangulation<dim>> mesh,
         const Degrees &degrees, std::shared_ptr<const ShapeTables<dim>> tables,
         std::shared_ptr<const LoadRules<dim>> loads = nullptr, PastSlip<dim> past = {});

  /** Why no ErrorBound is guaranteed: hpvi::no_error_bound(), slip that is counted from a past where tractions are given or bodies touch. */
  std::string no_error_bound(const Scene<dim> &scene) const;

  /** The bound asks for meshes that match where bodies touch: adds what it takes for those that do to go on so. */
  void keep_bound(const Scene<dim> &scene, Refinement &refinement) const;

  Spaces(const Spaces &) = delete; // members refer to one another
};

/**
 * One discrete problem, `A x + B' z = f` and the conditions on z: each member is built from the ones
 * above it.
 */
template <int dim>
class Discretisation
{
public:
  const Scene<dim> &scene;
  const std::shared_ptr<const Spaces<dim>> spaces;
  const Unknowns<dim> unknowns;
  const ConditionRows contact_rows; ///< B
  const Condensation<dim> condensation;
  const ElasticSystem<dim> system;                     ///< A, f
  const std::optional<RigidMotions<dim>> free_motions; ///< where contact alone holds the body

  /** @p elements remembers element matrices from step to step. Throws what RigidMotions throws. */
  Discretisation(const Scene<dim> &scene, std::shared_ptr<const Spaces<dim>> spaces,
                 CondensedElements<dim> &elements);

  Discretisation(const Discretisation &) = delete; // members refer to one another

  /** All displacements from values of the unknowns of A. */
  dealii::Vector<double> displacement(const dealii::Vector<double> &x) const;

  std::vector<Stabilisation> stabilisation() const; ///< of A, where a motion is free

  /** A factored with the unknowns of contact_rows last, and stabilised where a motion is free. */
  LinearSolver factor() const;

  /** The same in the place of @p other, of another discretisation on the same spaces, whose analysis it takes over. */
  void factor(LinearSolver &other) const;
};
} // namespace hpvi

#endif
