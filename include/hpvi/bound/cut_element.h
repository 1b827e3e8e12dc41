// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cut_element_h
#define hpvi_cut_element_h

#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/bound/row_element.h>

#include <deal.II/base/bounding_box.h>

#include <memory>
#include <vector>

namespace hpvi
{
/**
 * A cell that is cut along lines of its reference coordinates: stresses by rows in each of its boxes, continuous tractions between
 * them. From outside it is one cell whose tractions are polynomials on its four faces; those between boxes are the best, in
 * balance in every box. On faces in contact each box has tractions of its own besides, as data.
 */
class CutElement
{
public:
  /** A box in reference coordinates, its element, and the size and the middle of that [length]. */
  struct Part
  {
    dealii::BoundingBox<2> box;
    const RowElement *element;
    double h;
    dealii::Point<2> centre;
  };

  /** Boxes n_xi x n_eta, xi fastest, of a cell of size @p h about @p centre. */
  CutElement(const std::vector<Part> &parts, unsigned int n_xi, double h,
             const dealii::Point<2> &centre);

  TractionEnergy energy() const; ///< of the whole cell, in units of its h

  /** Of each box: derivatives of its energy and what misses N'r = 0, without tractions of faces and between boxes. */
  struct Data
  {
    std::vector<std::vector<double>> gradients;
    std::vector<RowElement::Conditions> defects;
  };

  std::vector<double> gradient(const Data &data) const; ///< for energy()
  RowElement::Conditions defect(const Data &data) const;

  /** Of what RowElement::moments() has for a box what it is for the cell, in the same units as the defect. */
  RowElement::Conditions of_cell(unsigned int box, const RowElement::Conditions &moments) const;

  /** Of its conditions before they had length 1, as RowElement::lengths. */
  const RowElement::Conditions &lengths() const
  {
    return norms;
  }

  /** Tractions on the faces of each box, those in @p data not among them, for @p faces of the cell. */
  std::vector<std::vector<double>> tractions(const std::vector<double> &faces,
                                             const Data &data) const;

private:
  unsigned int n_faces() const ///< tractions on the four faces of the cell
  {
    return 8 * (k + 1);
  }
  void set_places(unsigned int n_xi);
  void set_rows();
  void add_box(unsigned int box);
  std::vector<double> inner(const Data &data) const;

  const std::vector<Part> parts;
  const double h;
  const dealii::Point<2> centre;
  const unsigned int k, n_motions; ///< conditions of balance of each box
  unsigned int n_conditions = 0;   ///< of the cell: with those on the axis
  unsigned int n = 0;              ///< tractions on the faces of the cell and between boxes
  std::vector<dealii::FullMatrix<double>> to; ///< by box: its tractions by those
  std::vector<std::array<bool, 4>> is_outer;  ///< by box and face: on one of the cell?
  dealii::FullMatrix<double> A;               ///< energy, n x n
  dealii::FullMatrix<double>
      C; ///< conditions on what is between boxes x n: balance of all but the last, and ends on the axis
  /** By box and condition: the row of C, or none. */
  std::vector<std::array<unsigned int, 5>> rows;
  std::unique_ptr<const LuFactor>
      factor; ///< of the inner tractions and the multipliers of their conditions
  dealii::FullMatrix<double> best; ///< n x n_faces: all tractions by those on faces, without data
  std::vector<double> G, N;
  RowElement::Conditions norms;
  std::vector<dealii::FullMatrix<double>> conditions; ///< by box: of the cell by those of the box
};
} // namespace hpvi

#endif
