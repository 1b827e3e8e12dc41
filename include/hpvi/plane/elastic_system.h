// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_elastic_system_h
#define hpvi_elastic_system_h

#include <hpvi/algebra/elimination_hints.h>
#include <hpvi/algebra/symmetric_matrix.h>
#include <hpvi/plane/condensation.h>
#include <hpvi/plane/load_rule.h>
#include <hpvi/plane/unknowns.h>

#include <memory>
#include <vector>

namespace hpvi
{
/**
 * The linear system `A x = f` of a body without contact, the first line of (5.1)-(5.3) without
 * `B' z`: over the unknowns on the boundary of cells, with those inside condensed and prescribed
 * displacements moved to f.
 */
template <int dim>
class ElasticSystem
{
public:
  /** Assemble; @p elements remembers element matrices from step to step. */
  ElasticSystem(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                const Unknowns<dim> &unknowns, const Condensation<dim> &condensation,
                const ShapeTables<dim> &tables, const LoadRules<dim> &rules,
                CondensedElements<dim> &elements);

  SymmetricMatrix A;        ///< over the unknowns; stress length^(dim-2) for displacements
  dealii::Vector<double> f; ///< right-hand side over the unknowns
  EliminationHints hints;   ///< of A

  /** L(v_i) for every displacement unknown, constrained or not. */
  const dealii::Vector<double> &loads() const;

  /** Of these, what initial strains do, as initial_strain_loads() has it; empty where there are none. */
  const dealii::Vector<double> &strain_loads() const;

  double work(const dealii::Vector<double> &u) const; ///< L(u)

private:
  /** What one cell adds to the unknowns that its boundary depends on. */
  struct Contribution
  {
    unsigned int cell;
    std::vector<unsigned int> targets;
    const double *values = nullptr; ///< targets x targets

    unsigned int add_target(unsigned int unknown); ///< its place among the targets
  };

  Contribution reduce(unsigned int cell, const std::shared_ptr<const CondensedElement> &element,
                      dealii::ArrayView<const dealii::types::global_dof_index> dofs,
                      const Unknowns<dim> &unknowns, CondensedElements<dim> &elements);
  void set_hints(const dealii::Triangulation<dim> &triangulation,
                 const std::vector<Contribution> &contributions);
  void sum_up(const std::vector<Contribution> &contributions);

  dealii::Vector<double> of_strains, load; ///< for every displacement unknown
  std::vector<std::shared_ptr<const dealii::FullMatrix<double>>>
      constrained; ///< kept for the next step
};

/** L(v_i) of all that acts in @p scene, for every displacement unknown, constrained or not: the sum of what follows. */
template <int dim>
dealii::Vector<double> load_vector(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                                   const ShapeTables<dim> &tables, const LoadRules<dim> &rules);

/** Tractions and body forces. */
template <int dim>
dealii::Vector<double> applied_loads(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                                     const ShapeTables<dim> &tables, const LoadRules<dim> &rules);

/** The same and what initial strains do, by @p rules of the scene on any space with its coarse cells. */
template <int dim>
dealii::Vector<double> body_loads(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                                  const ShapeTables<dim> &tables, const LoadRules<dim> &rules);

/** Forces and moments on rigid plates; with initial_strain_loads() all. */
template <int dim>
dealii::Vector<double> plate_loads(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                                   const ShapeTables<dim> &tables);
} // namespace hpvi

#endif
