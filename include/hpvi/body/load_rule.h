// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_load_rule_h
#define hpvi_load_rule_h

#include <deal.II/dofs/dof_handler.h>
#include <hpvi/body/displacement_cuts.h>
#include <hpvi/body/load_quadrature.h>
#include <hpvi/body/strain_points.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** An edge or cell on which the load by its rule and by one four times finer are not the same. */
template <int dim>
struct UnresolvedLoad
{
  std::string name; ///< as in "Traction on top", "Body force"
  unsigned int cell;
  dealii::Point<dim> where;            ///< the middle of the worst piece
  dealii::Tensor<1, dim> force, finer; ///< by both rules [stress length^(dim-1)]
  double deviation; ///< of forces and, with a lever of half the edge or cell, moments
};

/** All loads of a scene together. */
struct LoadSum
{
  dealii::Point<2> centre;    ///< of the body
  dealii::Tensor<1, 2> force; ///< [stress length]
  double moment = 0;          ///< about the centre [stress length^2]
  double absolute = 0;        ///< int |G_x| + |G_y|, and of the body force likewise

  /** That of a body of @p thickness, where this is one of a unit. */
  LoadSum times(const double thickness) const
  {
    return {centre, thickness * force, thickness * moment, thickness * absolute};
  }
};

/**
 * The one quadrature rule for each load on each face and cell, for everything that holds the load: discrete equations, equilibrated
 * stresses, oscillation. Loads are looked at once, on the coarse mesh, with some 500 samples along a side of the
 * body, 100 x 100 inside, and no fewer than four times as many per direction as a Gauss rule has: where they jump, bend or are narrow, coarse edges are cut
 * by make_cut_rule() and coarse cells into rectangles, at jumps along their axes or by bisection. Refined edges and cells inherit these cuts.
 *
 * On what is not cut, and on each piece, a Gauss rule has as many points per direction, at least p + 2, as give
 * the moments of the load with polynomials of degree 2 to round-off. Then the discrete equations hold with the exact
 * load for every hat function times a rigid motion, which equilibrated stresses build on.
 *
 * Where no 64 pieces do, the load is unresolved, on the coarse mesh; on finer ones its edges and cells are
 * cut anew, and may be resolved there.
 */
template <int dim>
class LoadRules : public DisplacementCuts<dim>
{
public:
  using Cell = coarse_cuts::Cell;

  /**
   * Of the loads of @p scene on the coarse cells of @p mesh; the scene must outlive this object. @p finer: with so many times
   * as many samples along a side.
   */
  LoadRules(const Scene<dim> &scene, const dealii::Triangulation<dim> &mesh,
            std::shared_ptr<const ShapeTables<dim>> tables, unsigned int finer = 1);

  /** In s on [0,1] of a face, which has a traction. */
  LoadRule<1> traction(const Cell &cell, unsigned int face, unsigned int degree) const;

  /** In reference coordinates; how many points it has is looked for once in each cell. */
  LoadRule<dim> body_force(const Cell &cell, unsigned int degree) const;

  /** As strain_points() has them, which looks for them once in each cell. */
  unsigned int strain_points(const Cell &cell, unsigned int degree) const;

  /** Of the active cells of @p mesh: both rules differ by more than 1e-9 of all loads. */
  std::vector<UnresolvedLoad<dim>> unresolved(const dealii::Triangulation<dim> &mesh) const;

  const LoadSum &sum() const;

  /**
   * Has a mesh with the resultant @p force of its loads seen what lay between the samples: is that not sum(), by more than 1e-9 of all loads, where
   * these count as resolved? Curved bodies change with the degree of their cells, and so do resultants.
   */
  bool are_missing_something(const dealii::Tensor<1, dim> &force) const;

  /** Of the tractions of each boundary that has any, on the cells of @p numbering as the discrete equations have them: curved edges change with them. */
  std::map<dealii::types::boundary_id, LoadSum>
  sums_by_boundary(const dealii::DoFHandler<dim> &numbering) const;

  /** What both rules differ by where they agree to 1e-9, in all, over LoadSum::absolute. */
  double difference() const;

private:
  /** Both rules of a load on an edge or in a cell. */
  struct Comparison
  {
    dealii::Tensor<1, dim> force, finer;
    double deviation = 0;     ///< as UnresolvedLoad has it
    dealii::Point<dim> worst; ///< in reference coordinates
  };

  struct Pieces
  {
    std::vector<double> cuts;                    ///< of an edge: 0, where pieces meet, 1
    std::vector<dealii::BoundingBox<dim>> boxes; ///< of a cell; all of it
    Comparison comparison;
  };

  using Place = std::pair<dealii::types::coarse_cell_id, unsigned int>; ///< its face; none: inside

  Pieces cut_cell(const Cell &cell) const;
  Pieces cut(const Cell &cell, unsigned int face) const;
  Pieces pieces(const Cell &cell, unsigned int face) const;
  bool is_unresolved(const Pieces &pieces) const;
  void add(const Cell &cell, unsigned int face);
  void add_traction(LoadSum &sum, const Cell &cell, unsigned int face, unsigned int degree) const;
  void add(LoadSum &sum, const dealii::Tensor<1, dim> &force, const dealii::Point<dim> &x) const;

  const Scene<dim> &scene;
  const std::shared_ptr<const ShapeTables<dim>> tables;
  const unsigned int finer;
  std::map<Place, Pieces> coarse; ///< what varies
  mutable std::map<CellKey, unsigned int> known_strain_points,
      known_force_points; ///< by cell and degree; 0: the rule is cut
  LoadSum total;
};
} // namespace hpvi

#endif
