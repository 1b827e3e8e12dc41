// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_localised_coupling_h
#define hpvi_localised_coupling_h

#include <hpvi/bound/coupling_spaces.h>

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * Contact with Coulomb's law along one straight side that ends at right angles, and the rectangle of the body above it: there is the
 * partition of unity, at (x, y) of its frame,
 *
 *     phi_1 = cos(pi x/2 length) cos(pi y/2 height),  phi_2 = sin(pi x/2 length) cos(pi y/2 height),  phi_0 = sin(pi y/2 height),
 *
 * and where phi_1 or phi_2 is not zero the body is, with its supports, a wedge of 90 degrees with its tip at one end.
 */
class ContactStrip
{
public:
  explicit ContactStrip(const Scene<2> &scene);

  std::string why_none; ///< in words; empty: there is one

  double length = 0, height = 0;     ///< of the rectangle [length]
  std::array<double, 2> wedges = {}; ///< theta of the wedge at either end for mu_f chi = 1

  dealii::Point<2> in_frame(const dealii::Point<2> &x) const; ///< (x, y), contact at y = 0
  bool reaches(const dealii::Point<2> &place) const; ///< are phi_1 and phi_2 not zero there?
  std::array<dealii::Tensor<1, 2>, 2>
  gradients(const dealii::Point<2> &place) const; ///< of phi_1 and phi_2

private:
  template <class Edges, class SetReason>
  void set(const Edges &edges, const BoundaryCondition<2> &contact, const Material &material,
           const SetReason &set_reason);

  dealii::Point<2> origin;
  dealii::Tensor<1, 2> along, inwards;
};

/** mu_f chi over x of a strip; a straight line over what sticks. Slopes are by samples, with a tenth in reserve. */
class FrictionOnStrip
{
public:
  FrictionOnStrip(const ContactStrip &strip, const std::vector<ContactFace<2>> &faces,
                  const FrictionAlong &friction);

  struct Range
  {
    double largest, slope; ///< |mu_f chi| and its derivative, no less
  };
  Range between(double from, double to) const;

private:
  struct Piece
  {
    double from, to, largest, slope;
  };
  std::vector<Piece> pieces;
};

/**
 * Cells K of the mesh of a scene, bisected until kappa is little above the couplings of both wedges: |T y| <= kappa |y| for all y whose moments
 *
 *     int_K y . R,  int_K Ty . R,  int_K sigma(Ty) : sym(grad phi_i x R)
 *
 * with rigid motions R vanish.
 */
class StripCells
{
public:
  StripCells(const Scene<2> &scene, const ContactStrip &strip, const FrictionOnStrip &friction);

  const std::shared_ptr<dealii::Triangulation<2>> mesh; ///< may be bisected further
  double kappa = 0;
  unsigned int n_cells = 0; ///< below the strip

  using Cell = dealii::Triangulation<2>::cell_iterator;
  Cell parent_of(
      Cell cell) const; ///< that of those which @p cell of the mesh bisected further is a part of

private:
  std::set<std::pair<int, int>> active; ///< levels and indices
};

/** The moments of StripCells of displacements in a space whose mesh has come of theirs. */
class StripMoments
{
public:
  static constexpr unsigned int n_kinds = 9; ///< three of v, two times three of sigma(v)

  StripMoments(const ContactStrip &strip, const StripCells &cells, const Spaces<2> &spaces,
               const Material &material);

  std::vector<double> of(const Solution<2> &solution) const; ///< kind by kind, by cell

private:
  struct Part
  {
    unsigned int cell, place; ///< of the space, and that of K
    dealii::FullMatrix<double> forms;
  };
  std::vector<Part> parts;
  unsigned int n_cells = 0;
};

/**
 * The largest eigenvalue of M with @p bound times the identity in the place of what it is on the complement of the columns of @p W, and
 * that of M there.
 */
std::pair<double, double> with_complement(const dealii::FullMatrix<double> &M,
                                          const dealii::FullMatrix<double> &W, double bound);
} // namespace hpvi

#endif
