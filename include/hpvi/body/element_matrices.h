// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_element_matrices_h
#define hpvi_element_matrices_h

#include <boost/functional/hash.hpp>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <hpvi/body/shape_tables.h>
#include <hpvi/scene/scene.h>

#include <array>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * Gauss points per direction that integrate products of gradients over a cell. p + 1 are exact on
 * affine cells. On others 1/det J stands under the integral, and n points beyond p leave a relative
 * error of rho^{-2n}: rho, the sum of the half axes of the ellipse up to its pole, is
 * `(sqrt(r) + 1)/(sqrt(r) - 1)` for a quotient r of the values of det J at the ends of an edge. As
 * many are taken as bring that below 1e-14, so that Galerkin's orthogonality holds to round-off.
 */
template <int dim>
unsigned int stiffness_points(const CellMap<dim> &map, unsigned int degree);

/**
 * Static condensation of the stiffness matrix K of one element: of its unknowns in deal.II's local
 * numbering those in its interior (i) are eliminated, those on its boundary (b) are kept.
 */
struct ElementStiffness
{
  dealii::FullMatrix<double> condensed;  ///< K_bb - K_bi K_ii^-1 K_ib, n_b x n_b
  dealii::FullMatrix<double> extension;  ///< -K_ii^-1 K_ib, n_i x n_b: u_i = extension u_b
  dealii::LAPACKFullMatrix<double> K_ii; ///< factored; empty unless loads act in the interior
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
 * Element matrices by congruence class. In two dimensions a(.,.) does not change when a cell is
 * moved or scaled, so an adaptive mesh has a handful of different element matrices for each
 * material. A class is kept as long as a system uses it.
 */
template <int dim>
class ElementStiffnesses
{
public:
  ElementStiffnesses(const Scene<dim> &scene, const ShapeTables<dim> &tables);

  std::shared_ptr<const ElementStiffness> get(const CellMap<dim> &map, unsigned int degree,
                                              dealii::types::material_id material);

  /**
   * `T'KT`, n_targets x n_targets, with K the condensed matrix of @p element. Most cells keep their
   * neighbours from step to step, and T with them.
   */
  std::shared_ptr<const dealii::FullMatrix<double>>
  constrained(const std::shared_ptr<const ElementStiffness> &element,
              const std::vector<ConstraintEntry> &T, unsigned int n_targets);

  /** K_ii of one cell, factored: what only a correction of round-off asks for is not kept. */
  void interior(const CellMap<dim> &map, unsigned int degree, dealii::types::material_id material,
                dealii::LAPACKFullMatrix<double> &K_ii) const;

  /** Forget the constrained matrices that no system uses. */
  void forget_unused();

private:
  using Key = std::array<long, 2 + dim * dealii::GeometryInfo<dim>::vertices_per_cell>;
  static Key congruence_class(const typename CellMap<dim>::Vertices &vertices, unsigned int degree,
                              dealii::types::material_id material);
  dealii::FullMatrix<double> stiffness(const CellMap<dim> &map, unsigned int degree,
                                       dealii::types::material_id material) const;
  std::shared_ptr<ElementStiffness> condense(const dealii::FullMatrix<double> &K,
                                             unsigned int n_boundary) const;

  const std::vector<Material> materials;
  const bool interior_loads;
  const ShapeTables<dim> &tables;
  std::map<Key, std::weak_ptr<const ElementStiffness>> known;

  using ConstrainedKey =
      std::pair<std::shared_ptr<const ElementStiffness>, std::vector<ConstraintEntry>>;
  std::unordered_map<ConstrainedKey, std::weak_ptr<const dealii::FullMatrix<double>>,
                     boost::hash<ConstrainedKey>>
      known_constrained;
};
} // namespace hpvi

#endif
