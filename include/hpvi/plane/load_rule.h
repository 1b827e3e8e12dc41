// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_load_rule_h
#define hpvi_load_rule_h

#include <deal.II/dofs/dof_handler.h>
#include <hpvi/plane/displacement_cuts.h>
#include <hpvi/plane/given_data.h>
#include <hpvi/plane/load_quadrature.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace hpvi
{
/** A cell, the same in all meshes with its coarse cells, and a number: the key of what steps share of it. */
using CellKey = std::array<unsigned int, 5>;
CellKey cell_key(const dealii::Triangulation<2>::cell_iterator &cell, unsigned int number);

/** An edge or cell on which the integral of a datum by its rule and by one four times finer are not the same. */
template <int dim>
struct UnresolvedLoad
{
  Datum datum;
  std::string name; ///< as in "Traction on top", "Body force"
  unsigned int cell;
  dealii::Point<dim> where;   ///< the middle of the worst piece
  DatumValue integral, finer; ///< by both rules [unit of the datum, and of the edge or cell]
  double part;                ///< of all data of this kind
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
 * The one quadrature rule for each datum that is integrated on a face or in a cell, for everything that holds it: discrete equations, equilibrated
 * stresses, oscillation, work on test displacements. Data are looked at once, on the coarse mesh, with some 500 samples along a side of the
 * body, 100 x 100 inside and 500 along two lines of each direction, and no fewer than four times as many per direction as a Gauss rule has: where they jump, bend or are narrow, coarse edges are cut
 * by make_cut_rule() and coarse cells into rectangles, at jumps along their axes or by bisection. Refined edges and cells inherit these cuts.
 *
 * On what is not cut, and on each piece, a Gauss rule has as many points per direction, at least p + 2, as give
 * the moments of the datum with polynomials of degree 2 to round-off. Then the discrete equations hold with the exact
 * load for every hat function times a rigid motion, which equilibrated stresses build on.
 *
 * Where no 64 pieces do, the datum is unresolved, on the coarse mesh; on finer ones its edges and cells are
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

  /** In s on [0,1] of a face, which has springs, for their stiffness times products of two polynomials of @p degree. */
  LoadRule<1> spring(const Cell &cell, unsigned int face, unsigned int degree) const;

  /** In reference coordinates; how many points it has is looked for once in each cell. */
  LoadRule<dim> body_force(const Cell &cell, unsigned int degree) const;

  /** Likewise, with p + 3 points at least: equations are those of the polynomials through the values at these points. */
  LoadRule<dim> initial_strain(const Cell &cell, unsigned int degree) const;

  /** Of the active cells of @p mesh: both rules differ by more than 1e-9 of all data of a kind. */
  std::vector<UnresolvedLoad<dim>> unresolved(const dealii::Triangulation<dim> &mesh) const;

  const LoadSum &sum() const;

  /** Of all components of a datum [its unit, and that of the body's area or boundary]; what it is in absolute values. */
  struct Total
  {
    DatumValue sum;
    double absolute = 0;
  };
  const Total &total_of(Datum datum) const;

  /**
   * Has a mesh on which data of a kind have this @p sum seen what lay between the samples: is that not total_of(), by more than 1e-9 of
   * all, where these count as resolved? Curved bodies change with the degree of their cells, and so do sums.
   */
  bool are_missing_something(Datum datum, const DatumValue &sum) const;

  /** Of the tractions of each boundary that has any, on the cells of @p numbering as the discrete equations have them: curved edges change with them. */
  std::map<dealii::types::boundary_id, LoadSum>
  sums_by_boundary(const dealii::DoFHandler<dim> &numbering) const;

  /** What both rules differ by where they agree to 1e-9, in all, over Total::absolute. */
  double difference(Datum datum) const;

private:
  /** A coarse cell, its face or inside, and what is given there. */
  using Place = std::tuple<dealii::types::coarse_cell_id, unsigned int, Datum>;

  DataPieces pieces(const Cell &cell, unsigned int face, Datum datum) const;
  bool is_unresolved(const DataPieces &pieces, Datum datum) const;
  bool is_any_unresolved(Datum datum) const;
  LoadRule<1> on_face(const Cell &cell, unsigned int face, Datum datum, unsigned int degree,
                      const std::vector<std::function<double(double)>> &factors) const;
  LoadRule<dim> in_cell(const Cell &cell, Datum datum, unsigned int degree) const;
  void look_at(const Cell &cell, unsigned int face, Datum datum);
  void add(const Cell &cell, unsigned int face, Datum datum);
  void add_traction(LoadSum &sum, const Cell &cell, unsigned int face, unsigned int degree) const;
  void add(LoadSum &sum, const dealii::Tensor<1, dim> &force, const dealii::Point<dim> &x) const;

  const Scene<dim> &scene;
  const std::shared_ptr<const ShapeTables<dim>> tables;
  const unsigned int finer;
  std::map<Place, DataPieces> coarse; ///< what varies
  /** Of loads and initial strains, by cell and degree. */
  mutable std::array<std::map<CellKey, std::vector<RulePart<dim>>>, 2> known_parts;
  LoadSum total;
  std::array<Total, 4> totals; ///< by datum
};
} // namespace hpvi

#endif
