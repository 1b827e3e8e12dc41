// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_cutter_h
#define hpvi_box_cutter_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * Cuts [0,1]^2 into boxes, on each of which a Gauss rule gives the same integrals of f as on its parts, to 1e-13 of
 * max |f|: at jumps along lines of coordinates, which are bisected to round-off, else in the middle. At most 64 boxes.
 */
class BoxCutter
{
public:
  using Value = dealii::Tensor<1, 4>; ///< of so many functions at once
  using Function = std::function<Value(const dealii::Point<2> &)>;

  /**
   * A box is compared with as many parts as it has of @p n_parts, the number for the whole in each direction. The whole is cut at
   * @p lines first, from 0 to 1 in each direction; where these are too many, at some of them.
   */
  BoxCutter(Function function, const dealii::QGauss<1> &gauss,
            const std::array<unsigned int, 2> &n_parts, std::array<std::vector<double>, 2> lines);

  struct Piece
  {
    dealii::BoundingBox<2> box;
    Value integral, finer; ///< by the rule on the box, and on its finest parts
    double deviation; ///< the largest difference of moments with 1, xi, eta, xi eta between those
  };

  const std::vector<Piece> &cut();

private:
  using Moments = std::array<Value, 4>; ///< with 1, xi, eta, xi eta

  /** Values at the points of parts in a grid, row by row. */
  struct Grid
  {
    std::array<std::vector<double>, 2> coordinates;
    std::vector<Value> values;
    const Value &at(const std::array<unsigned int, 2> &i) const
    {
      return values[i[1] * coordinates[0].size() + i[0]];
    }
  };

  Grid sample(const dealii::BoundingBox<2> &box, unsigned int n_x, unsigned int n_y,
              Moments &moments);
  std::array<unsigned int, 2> parts_of(const dealii::BoundingBox<2> &box) const;
  void measure(Piece &piece);
  std::optional<double> jump(const Grid &grid, unsigned int d,
                             const std::array<unsigned int, 2> &i) const;
  std::optional<double> common_jump(const Grid &grid, unsigned int d) const;
  std::pair<unsigned int, double> find_cut(const dealii::BoundingBox<2> &box);

  const Function f;
  const dealii::QGauss<1> &gauss;
  const std::array<unsigned int, 2> n_parts; ///< of the whole, per direction
  double largest = 0;
  std::vector<Piece> pieces;
};
} // namespace hpvi

#endif
