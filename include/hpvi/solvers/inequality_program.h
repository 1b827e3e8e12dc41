// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_inequality_program_h
#define hpvi_inequality_program_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <utility>
#include <vector>

namespace hpvi
{
/**
 * The small dense program `min 1/2 x'Hx - h'x` with `E x = e` and `C x >= c`, H positive definite, by the
 * dual method of Goldfarb and Idnani (1983, doi:10.1007/BF02591962): from the minimiser without
 * conditions it takes in one violated row after the other, each time giving up those whose multipliers
 * would turn negative. Rows that depend on one another do no harm: what equations or active rows imply up to round-off
 * counts as met, and takes the place of none of them. More rows may be added after a
 * solution; the next solve() goes on from there.
 */
class InequalityProgram
{
public:
  /** Throws NumericalFailure where @p H is not positive definite. */
  InequalityProgram(const dealii::FullMatrix<double> &H, const dealii::Vector<double> &h);

  /** `row' x = value`, before the first solve(). False: it contradicts those before it. */
  bool add_equality(const dealii::Vector<double> &row, double value);

  /** `row' x >= least`, from the next solve() on. */
  void add_inequality(const dealii::Vector<double> &row, double least);

  /**
   * False: no x meets all rows, or round-off keeps the method from ending. A row that contradicts others by no more
   * than the part @p implied of its terms, round-off of bounds that come from data, and 1e-12 at least, counts as met.
   */
  bool solve(double implied = 0.);

  const dealii::Vector<double> &minimiser() const; ///< x

  /** y with `H x - h = sum_i y_i row_i`, by row in the order of adding; y_i >= 0 for inequalities. */
  std::vector<double> multipliers() const;

private:
  struct Row
  {
    std::vector<std::pair<unsigned int, double>> entries; ///< those that are not zero
    double bound;
    double length; ///< of the entries
    bool is_equality;
  };

  struct Rotation
  {
    double cosine, sine;

    void apply(double &a, double &b) const
    {
      const double old = a;
      a = cosine * old + sine * b;
      b = cosine * b - sine * old;
    }
  };

  void add(const dealii::Vector<double> &row, double bound, bool is_equality);
  double slack(const Row &row, double tolerance) const;
  unsigned int most_violated() const;
  bool recall(double tolerance);
  bool take_in(unsigned int row);
  std::vector<double> combination(const dealii::Vector<double> &d) const;
  double length_in_R(unsigned int place) const;
  void meet_active();
  void move(double step, const dealii::Vector<double> &direction);
  void note_reach();
  Rotation rotate(unsigned int i, double a, double b);
  void activate(unsigned int row, double multiplier);
  void drop(unsigned int place);

  dealii::Vector<double> x;
  dealii::Vector<double> reach;     ///< the largest |x_i| so far, whose round-off x has
  dealii::Vector<double> size_of_x; ///< |x_i|, or as much as that round-off is worth
  std::vector<Row> rows;
  dealii::FullMatrix<double> J; ///< `J'J = H^-1`, turned so that `J N = (R; 0)`, R a triangle,
  dealii::FullMatrix<double> R; ///< where the columns of N are the active rows
  std::vector<unsigned int> active;
  std::vector<double> y;           ///< multipliers of the active rows
  std::vector<bool> is_in;         ///< is a row active?
  std::vector<bool> counts_as_met; ///< as active ones imply it, up to round-off

  /** Of the row that is taken in: J times it, what no active row implies of that, the step; and what active rows miss. */
  dealii::Vector<double> d, free, z, missing;
};
} // namespace hpvi

#endif
