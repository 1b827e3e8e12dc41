// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_equilibration_h
#define hpvi_box_equilibration_h

#include <hpvi/bound/box_stress.h>
#include <hpvi/space/primal_space.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace hpvi
{
/** Legendre coefficients of a polynomial on [-1,1]^n, those of the first axis fastest. */
using BoxModes = std::vector<double>;

/** A applied along each of @p n_axes of coefficients. */
BoxModes along_axes(const dealii::FullMatrix<double> &A, BoxModes values, unsigned int n_axes);

/** Of a polynomial on a box, (p+1)^3 of them, on its @p face. */
BoxModes on_face(const BoxModes &modes, unsigned int n, unsigned int face);

/** The tractions of a face of the boundary that are given, (p+1)^2 modes of each component; empty: zero. */
struct GivenTractions
{
  std::array<bool, 3> is_given{};
  std::array<BoxModes, 3> modes;
};

/**
 * A stress on a mesh of boxes in balance with given loads and tractions, which are polynomials of degree p: tractions between
 * cells are sums over the vertices of what is best on the patch of each (doc/space.md), and of degree p. Patches that are alike share their factors. On one
 * process.
 */
class BoxEquilibration
{
public:
  using Sides =
      std::map<std::pair<unsigned int, unsigned int>, GivenTractions>; ///< by cell and face

  /**
   * @p forces: (p+1)^3 modes of each component by active cell, or none. @p sides: all faces of the boundary. Both must outlive this object, and
   * may be filled before balance().
   */
  BoxEquilibration(const PrimalSpace<3> &space, const std::vector<BoxModes> &forces,
                   const Sides &sides);

  /** Near the stress of @p u, modes over length() by cell, which the loads and tractions are in balance with; returns what that lacks, over all tractions. */
  double balance(const std::vector<dealii::Vector<double>> &u);

  /** From sigma(@p u) on @p cell, u as modes over length(). */
  BoxStress::Distance distance(unsigned int cell, const dealii::Vector<double> &u) const;

  const BoxStress &element(unsigned int cell) const
  {
    return *elements[classes[cell]];
  }

  /** The cube root of its volume. */
  double length(unsigned int cell) const
  {
    return lengths[cell];
  }

private:
  /** Tractions between two cells, or on the boundary, are those of a whole face. */
  struct Use
  {
    unsigned int block;
    int part;    ///< a quarter of that face; -1: all
    double sign; ///< -1: the face is the other cell's
  };
  /** A vertex: the cells on which its hat function lives, by their places. */
  struct Patch
  {
    std::vector<unsigned int> cells;
    std::vector<std::array<double, 8>> hats;
  };
  struct Local;

  /** The mode of data on a face that mode @p i of a traction is. */
  unsigned int of_face(const unsigned int i) const
  {
    return i % m + n * (i / m);
  }

  void find_classes();
  void find_faces();
  void find_hats();
  const GivenTractions *given(unsigned int cell, unsigned int face) const;
  Local local(const Patch &patch) const;
  double weight(const Patch &patch, unsigned int member) const;
  std::vector<double> gradient(const Patch &patch, unsigned int member,
                               const dealii::Vector<double> &u) const;
  double solve(const std::vector<const Patch *> &alike, const Local &local,
               const std::vector<dealii::Vector<double>> &u,
               std::vector<std::vector<double>> &solutions) const;

  const PrimalSpace<3> &space;
  const unsigned int n, m; ///< modes of data along an axis, and of the tractions between cells
  const std::vector<BoxModes> &forces;
  const Sides &sides;
  std::vector<PrimalSpace<3>::Cell> cells;
  std::vector<std::unique_ptr<const BoxStress>> elements;
  std::vector<unsigned int> classes; ///< of cells: their shapes and materials
  std::vector<double> lengths;
  std::vector<std::array<Use, 6>> faces;
  std::vector<dealii::FullMatrix<double>> parts; ///< coefficients on a quarter of a face
  std::vector<std::vector<double>> tractions;    ///< by block: of each component
  std::vector<Patch> patches;
};
} // namespace hpvi

#endif
