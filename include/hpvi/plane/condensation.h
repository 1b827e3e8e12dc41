// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_condensation_h
#define hpvi_condensation_h

#include <boost/functional/hash.hpp>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <hpvi/plane/displacement_space.h>
#include <hpvi/plane/element_matrices.h>

#include <map>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * Static condensation of the stiffness matrix K of one element: of its unknowns in deal.II's local
 * numbering those in its interior (i) are eliminated, those on its boundary (b) are kept.
 */
struct CondensedElement
{
  dealii::FullMatrix<double> condensed; ///< K_bb - K_bi K_ii^-1 K_ib, n_b x n_b
  unsigned int n_interior = 0;          ///< n_i

  /**
   * -K_ii^-1 K_ib, n_i x n_b: u_i = extension u_b. Of a parallelogram, which many cells share; of another cell Condensation finds from
   * strains what K_ib does: this would be a fifth of all work at the cell.
   */
  dealii::FullMatrix<double> extension;
  std::vector<double>
      factor; ///< of K_ii by columns, n_i x n_i; of a parallelogram none unless loads act in the interior

  /** `x := K_ii^-1 x`; of a parallelogram where loads act in the interior. */
  void solve_inside(double *x) const;
};

/** Entry (local, target) of the matrix T that expresses the unknowns of a cell by free ones. */
struct ConstraintEntry
{
  unsigned int local, target;
  double weight;

  bool operator==(const ConstraintEntry &other) const
  {
    return local == other.local && target == other.target && weight == other.weight;
  }

  friend std::size_t hash_value(const ConstraintEntry &entry)
  {
    std::size_t seed = boost::hash_value(entry.weight);
    boost::hash_combine(seed, entry.local);
    boost::hash_combine(seed, entry.target);
    return seed;
  }
};

/**
 * Condensed elements by congruence class, each computed once. A class is kept as long as a system
 * uses it.
 */
template <int dim>
class CondensedElements
{
public:
  /** Both must outlive this object. */
  CondensedElements(const Scene<dim> &scene, const ShapeTables<dim> &tables,
                    Volume volume = Volume::full);

  const Scene<dim> &scene;
  const ShapeTables<dim> &tables;

  Volume volume() const;

  std::shared_ptr<const CondensedElement> get(const CellMap<dim> &map, unsigned int degree,
                                              dealii::types::material_id material);

  /**
   * `T'KT`, n_targets x n_targets, with K the condensed matrix of @p element. Most cells keep their
   * neighbours from step to step, and T with them.
   */
  std::shared_ptr<const dealii::FullMatrix<double>>
  constrained(const std::shared_ptr<const CondensedElement> &element,
              const std::vector<ConstraintEntry> &T, unsigned int n_targets);

  /** K_ii of one cell, factored: what only a correction of round-off asks for is not kept. */
  void interior(const CellMap<dim> &map, unsigned int degree, dealii::types::material_id material,
                dealii::LAPACKFullMatrix<double> &K_ii) const;

  /** Forget the constrained matrices that no system uses. */
  void forget_unused();

private:
  std::shared_ptr<CondensedElement> condense(const dealii::FullMatrix<double> &K,
                                             unsigned int n_boundary) const;

  /** The same of ElementMatrices::triangle(), in its place. */
  std::shared_ptr<CondensedElement> condense(std::vector<double> &K, unsigned int n,
                                             unsigned int n_boundary);

  const ElementMatrices<dim> matrices;
  const bool interior_loads;
  std::vector<double> triangle; ///< keeps its memory from cell to cell
  std::map<typename ElementMatrices<dim>::Class, std::weak_ptr<const CondensedElement>> known;

  using ConstrainedKey =
      std::pair<std::shared_ptr<const CondensedElement>, std::vector<ConstraintEntry>>;
  std::unordered_map<ConstrainedKey, std::weak_ptr<const dealii::FullMatrix<double>>,
                     boost::hash<ConstrainedKey>>
      known_constrained;
};

/**
 * Static condensation on one mesh: the unknowns inside cells are eliminated cell by cell, and found
 * again from those on the boundary of cells.
 */
template <int dim>
class Condensation
{
public:
  /** The space must outlive this object, and what @p elements are made of. */
  Condensation(const DisplacementSpace<dim> &space, CondensedElements<dim> &elements);

  /** By active cell index. */
  const std::shared_ptr<const CondensedElement> &element(unsigned int cell) const;

  /** Forces on unknowns inside cells, carried to those on the boundary of cells: `f_b - K_bi K_ii^-1 f_i`. */
  void eliminate(dealii::Vector<double> &forces) const;

  /** u_i of every cell from u_b, `-K_ii^-1 K_ib u_b`. */
  void extend(dealii::Vector<double> &u) const;

  /** The factored blocks K_ii of elements that have none of their own: what is asked for by add_interior(). */
  using Interiors = std::map<const CondensedElement *, dealii::LAPACKFullMatrix<double>>;
  Interiors interiors(const CondensedElements<dim> &elements) const;

  /** `u_i += K_ii^-1 f_i`; with extend() the answer to @p forces. */
  void add_interior(const dealii::Vector<double> &forces, const Interiors &interiors,
                    dealii::Vector<double> &u) const;

  /** The same with the blocks that elements keep where loads act inside cells. */
  void add_interior(const dealii::Vector<double> &forces, dealii::Vector<double> &u) const;

private:
  template <class F>
  void for_each_extension(const F &f) const;

  template <class Solve>
  void solve_inside(const std::vector<unsigned int> &cells, const dealii::Vector<double> &forces,
                    const Solve &solve, dealii::Vector<double> &u) const;
  dealii::Vector<double> strained(const dealii::Vector<double> &u) const;
  void clear_interiors(dealii::Vector<double> &u) const;

  const DisplacementSpace<dim> &space;
  const Scene<dim> &scene;
  const ShapeTables<dim> &tables;
  std::vector<std::shared_ptr<const CondensedElement>> elements; ///< by active cell index
  std::vector<unsigned int> with_extension, with_interior;       ///< cells that have these
};
} // namespace hpvi

#endif
