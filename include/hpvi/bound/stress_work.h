// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stress_work_h
#define hpvi_stress_work_h

#include <hpvi/bound/energy_rule.h>
#include <hpvi/bound/error_bound.h>
#include <hpvi/bound/part_tables.h>
#include <hpvi/plane/solution.h>

#include <functional>
#include <vector>

namespace hpvi
{
/** Sums with those of their absolute terms, of which arithmetic loses the last digits. */
struct WorkOnShapes
{
  std::vector<double> sum, absolute;
  double rule = 0; ///< EnergyRule::missed() of the cell
};

/**
 * A part of the body that lies in the cell a of u_N and the cell b of another mesh, which in_a and in_b are in their reference
 * cells, and what C eps(u_N) does there on the strains of the shape functions of b: component by component, as
 * Solution::coefficients() has them. Initial strains are among the loads.
 */
struct WorkOnPart
{
  dealii::Triangulation<2>::cell_iterator a;
  dealii::BoundingBox<2> in_a;
  dealii::Triangulation<2>::cell_iterator b;
  dealii::BoundingBox<2> in_b;
  WorkOnShapes work;
};

/** All of them, by all threads; @p degrees are those of the cells of @p mesh, which descends from the coarse mesh of u_N, too. */
std::vector<WorkOnPart> stress_on_parts(const Solution<2> &solution,
                                        const dealii::Triangulation<2> &mesh,
                                        const Degrees &degrees, PartTables &tables);

/** The work int (s n - G) . w of what acts on a body beside its loads G. */
struct TractionWork
{
  double sum = 0, absolute = 0; ///< [stress length^2]

  /**
   * On the parts of an edge between @p cuts, from 0 to 1, with @p n_points of Gauss on each where the edge is not loaded.
   * w(s, x) has only those components in which the traction is not given.
   */
  void add(const EdgeTraction &edge, const Solution<2> &solution, std::vector<double> cuts,
           unsigned int n_points,
           const std::function<dealii::Tensor<1, 2>(double, const dealii::Point<2> &)> &w);

  /** What a stress out of balance by @p imbalance of its tractions may add. */
  double defect(const double imbalance) const
  {
    return (1e-14 + imbalance) * absolute;
  }
};

/**
 * `(s - sigma(u_N), eps(z)) = L(z) + int (s n - G) . z - a(u_N, z)` but for oscillation, of a z of V on a mesh of its own,
 * a without springs.
 */
struct StressWork
{
  double value = 0, defect = 0;
};
StressWork work_of_difference(const Solution<2> &solution, const ErrorBound &bound,
                              const Solution<2> &z, PartTables &tables);

/** Between what the energy of a displacement is for sure. */
struct EnergyRange
{
  double low = 0, high = 0; ///< |v|^2 [stress length^2]
};

/** A rule for energies of displacements of degree @p p, with a factor of 1 + @p enough or what a dozen more points lead to. */
EnergyRule displacement_rule(const dealii::Triangulation<2>::cell_iterator &cell,
                             const Scene<2> &scene, unsigned int p, double enough = 1e-6);

/** Of the displacement with unknowns @p v on a cell, from strains. */
EnergyRange energy_range(const dealii::DoFHandler<2>::active_cell_iterator &cell,
                         const Scene<2> &scene, const DisplacementSpace<2> &space,
                         const ShapeTables<2> &tables, const dealii::Vector<double> &v,
                         const EnergyRule &rule);

/** What the rule of the stiffness may miss of |v|^2, up or down, v a displacement by the unknowns of @p solution; 0 on parallelograms. */
double missed_energy(const Solution<2> &solution, const dealii::Vector<double> &v);

/** EnergyRange::high of all active cells; @p rules for them, empty at first. */
std::vector<double> largest_energies(const Scene<2> &scene, const DisplacementSpace<2> &space,
                                     const ShapeTables<2> &tables, const dealii::Vector<double> &v,
                                     std::vector<EnergyRule> &rules);
} // namespace hpvi

#endif
