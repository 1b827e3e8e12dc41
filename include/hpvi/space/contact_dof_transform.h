// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_dof_transform_h
#define hpvi_contact_dof_transform_h

#include <hpvi/space/primal_space.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace hpvi
{
/**
 * Between contact dofs and the inner nodes of contact faces whose place they take (see BoxTables), in vectors of nodal values without
 * constrained ones: `u = T v` is `u_inner = M^-1 (m - W u_rim)`, all else alike; m of a face that is normal to no axis are first
 * turned from its directions. A contact face is one cell's, so that it works on local elements, those of neighbours included; where
 * another body lies opposite `u_inner = M^-1 (m - W u_rim + R u_opposite)`, with values of FarValues.
 */
template <typename Number>
class ContactDofTransform
{
public:
  using Vector = dealii::LinearAlgebra::distributed::Vector<Number>;

  /** For vectors like @p pattern. */
  ContactDofTransform(const PrimalSpace<3> &space, const Vector &pattern);

  /** T in place; values of neighbours are brought up to date and kept. Puts contact dofs into @p kept where it is not null. */
  void to_nodes(Vector &v, std::vector<Number> *kept = nullptr) const;
  void restore(Vector &v,
               const std::vector<Number> &kept) const; ///< contact dofs that to_nodes() kept
  void to_nodes_transposed(Vector &r) const;           ///< T' in place
  void to_moments(Vector &v) const;                    ///< T^-1 in place, without neighbours then
  void to_moments_transposed(Vector &r) const;         ///< T^-T in place

  /** Called with local elements and weights of `sum weight v`, the value at a node of a cell. */
  static void resolve(const PrimalSpace<3> &space, const Vector &pattern,
                      dealii::types::global_dof_index dof,
                      const std::function<void(unsigned int, double)> &take);

private:
  struct Row ///< one component of a face; of a curved one all
  {
    unsigned int n;                                     ///< contact dofs
    unsigned int first_inner, first_rim, n_rim, matrix; ///< the last in #matrices
    std::size_t first_entry;                            ///< in #to_inner
    unsigned int first_far = 0, n_far = 0;
    std::size_t first_far_entry = 0; ///< in #far_to_inner
  };
  struct Turn ///< of a face whose three components begin there in #inner
  {
    unsigned int n; ///< contact dofs of a component
    unsigned int first_inner;
    std::array<std::array<Number, 3>, 3> directions; ///< by component of v and axis
  };
  struct Matrices
  {
    std::vector<Number> M, M_inverse;
  };

  void add(const PrimalSpace<3> &space, const Vector &pattern, const ContactDofFace<3> &face,
           unsigned int matrix);
  /** The row of @p components of a face, whose `-M^-1 W` is @p C with columns by component and rim node. */
  void add_row(const PrimalSpace<3> &space, const Vector &pattern, const ContactDofFace<3> &face,
               const std::vector<unsigned int> &components, const dealii::FullMatrix<double> &C,
               unsigned int matrix);
  void add_opposite(const PrimalSpace<3> &space, unsigned int face,
                    std::optional<unsigned int> axis, const dealii::FullMatrix<double> &M_inverse);
  void turn(Vector &v, bool to_axes) const;
  template <bool inverse>
  void transform(Vector &v) const;
  template <bool inverse>
  void transform_transposed(Vector &r) const;

  unsigned int largest = 0;       ///< Row::n
  std::vector<Matrices> matrices; ///< the first of unit faces, by degree
  std::vector<Row> rows;
  std::vector<Turn> turns;
  std::vector<unsigned int> inner, rim; ///< local elements
  std::vector<Number> to_inner;      ///< -M^-1 W with constraints resolved, Row::n for each of #rim
  const FarValues *values = nullptr; ///< opposite to faces; null: no bodies touch
  std::vector<unsigned int> far;     ///< places there
  std::vector<Number> far_to_inner;  ///< M^-1 R likewise, Row::n for each of #far
  mutable std::vector<Number> exchanged;
};
} // namespace hpvi

#endif
