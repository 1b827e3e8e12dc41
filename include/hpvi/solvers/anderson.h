// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_anderson_h
#define hpvi_anderson_h

#include <deal.II/lac/vector.h>

#include <deque>

namespace hpvi
{
/** `|x - T(x)| -> 0` faster than by `x := T(x)` (Walker & Ni 2011, doi:10.1137/10078356X). */
class Anderson
{
public:
  /** The next x after `f = T(x) - x`. */
  dealii::Vector<double> next(const dealii::Vector<double> &x, const dealii::Vector<double> &f);

  double contraction = 0; ///< the largest `|T(x) - T(y)| / |x - y|` of successive x

private:
  dealii::Vector<double> last_x, last_f;
  std::deque<dealii::Vector<double>> dx, df;
};
} // namespace hpvi

#endif
