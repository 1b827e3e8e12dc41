// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_unknowns_h
#define hpvi_unknowns_h

#include <hpvi/algebra/schur_complement.h>
#include <hpvi/plane/contact_operator.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace hpvi
{
/** A sum over unknowns: pairs of number and weight. */
using Terms = dealii::ArrayView<const std::pair<unsigned int, double>>;

/**
 * The unknowns x of the linear system: every displacement unknown on the boundary of a cell is
 * `u = T x + h`, with h from prescribed displacements. Unknowns are the free displacements and, in
 * the place of those inside a contact edge, its moments (see ContactOperator), beside which a direction
 * without moments keeps its nodal values; those inside cells are left to Condensation.
 */
template <int dim>
class Unknowns
{
public:
  /** Both must outlive this object. */
  Unknowns(const DisplacementSpace<dim> &displacement_space,
           const ContactOperator<dim> &contact_operator, const ShapeTables<dim> &tables);

  unsigned int n() const;

  /** Row of T; empty for displacements that are prescribed or inside a cell. */
  Terms terms(dealii::types::global_dof_index dof) const;
  double prescribed(dealii::types::global_dof_index dof) const; ///< h

  /** Is this displacement one of the unknowns itself? */
  bool is_plain(dealii::types::global_dof_index dof) const;

  dealii::Vector<double> expand(const dealii::Vector<double> &x) const;       ///< T x
  dealii::Vector<double> distribute(const dealii::Vector<double> &x) const;   ///< T x + h
  dealii::Vector<double> collect(const dealii::Vector<double> &forces) const; ///< T' forces

  /**
   * The contact conditions in x, `B x + prescribed = B u - (the gap's moments)`: a row has one entry where
   * moments are unknowns.
   */
  ConditionRows contact_rows() const;

  /** x of a displacement u that meets all constraints with h = 0. */
  dealii::Vector<double> coordinates(const dealii::Vector<double> &u) const;

private:
  using Line = std::vector<std::pair<unsigned int, double>>;
  using EdgeRows = typename ContactOperator<dim>::Rows;

  /** The displacement of a node along a direction, as an unknown. */
  struct NodalValue
  {
    unsigned int unknown;
    std::array<dealii::types::global_dof_index, dim> dofs;
    dealii::Tensor<1, dim> direction;
  };

  std::vector<unsigned int> number(const ShapeTables<dim> &tables);
  std::map<dealii::types::global_dof_index, Line>
  edges_with_moments(const std::vector<unsigned int> &numbers);
  void express(const EdgeRows *rows, const std::vector<dealii::types::global_dof_index> &edge_dofs,
               const dealii::Tensor<1, dim> &direction, unsigned int component,
               const std::vector<unsigned int> &numbers,
               std::map<dealii::types::global_dof_index, Line> &lines);
  Line moments_opposite(const EdgeRows &rows, const dealii::FullMatrix<double> &N, unsigned int j,
                        const std::vector<unsigned int> &numbers, double &offset) const;
  void add_terms(dealii::types::global_dof_index dof, double weight,
                 const std::vector<unsigned int> &numbers, Line &line, double &offset) const;

  const DisplacementSpace<dim> &space;
  const ContactOperator<dim> &contact_operator;
  std::vector<dealii::types::global_dof_index> dofs;    ///< by unknown
  std::vector<unsigned int> moments;                    ///< by multiplier: its unknown, or none
  std::vector<NodalValue> rotated;                      ///< unknowns that are no component of u
  std::vector<std::pair<unsigned int, double>> entries; ///< of T, row by row
  std::vector<std::size_t> first_entry;
  dealii::Vector<double> offsets; ///< h
};
} // namespace hpvi

#endif
