// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numbers.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/solvers/inequality_program.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * What counts as zero: of the slack of a row; of the part of a row that no other one implies, or of what another one adds
 * to it; and of its contradiction to those that imply it.
 */
constexpr double round_off = 1e-14, dependent = 1e-10, contradiction = 1e-12;

/** `L^-1` with `H = LL'`. */
FullMatrix<double> inverse_factor(const FullMatrix<double> &H)
{
  const unsigned int n = H.m();
  FullMatrix<double> L(n, n), inverse(n, n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j <= i; ++j)
    {
      double rest = H(i, j);
      for (unsigned int k = 0; k < j; ++k)
        rest -= L(i, k) * L(j, k);
      if (i == j && !(rest > 0.))
        throw NumericalFailure("the matrix of a quadratic program is not positive definite");
      L(i, j) = i == j ? std::sqrt(rest) : rest / L(j, j);
    }
  for (unsigned int i = 0; i < n; ++i)
  {
    inverse(i, i) = 1.;
    for (unsigned int k = 0; k < i; ++k)
      for (unsigned int j = 0; j <= k; ++j)
        inverse(i, j) -= L(i, k) * inverse(k, j);
    for (unsigned int j = 0; j <= i; ++j)
      inverse(i, j) /= L(i, i);
  }
  return inverse;
}
} // namespace

InequalityProgram::InequalityProgram(const FullMatrix<double> &H, const Vector<double> &h)
    : x(h.size()), reach(h.size()), size_of_x(h.size()), J(inverse_factor(H)),
      R(h.size(), h.size()), d(h.size()), free(h.size()), z(h.size()), missing(h.size())
{
  Vector<double> Jh(h.size());
  J.vmult(Jh, h);
  J.Tvmult(x, Jh);
  note_reach();
}

void InequalityProgram::add(const Vector<double> &row, const double bound, const bool is_equality)
{
  rows.push_back({{}, bound, row.l2_norm(), is_equality});
  for (unsigned int i = 0; i < row.size(); ++i)
    if (row[i] != 0.)
      rows.back().entries.emplace_back(i, row[i]);
  is_in.push_back(false);
  counts_as_met.push_back(false);
}

bool InequalityProgram::add_equality(const Vector<double> &row, const double value)
{
  add(row, value, true);
  return take_in(rows.size() - 1);
}

void InequalityProgram::add_inequality(const Vector<double> &row, const double least)
{
  add(row, least, false);
}

/** `row' x - bound`, zero where round-off of @p tolerance cannot tell: of x, and where that is next to nothing of what it was. */
double InequalityProgram::slack(const Row &row, const double tolerance) const
{
  double sum = -row.bound, size = std::abs(row.bound);
  for (const auto &[i, entry] : row.entries)
  {
    sum += entry * x[i];
    size += std::abs(entry) * size_of_x[i];
  }
  return std::abs(sum) > tolerance * size ? sum : 0.;
}

/** Farthest from where it holds, of the inequalities. */
unsigned int InequalityProgram::most_violated() const
{
  unsigned int result = none;
  double worst = 0.;
  for (unsigned int i = 0; i < rows.size(); ++i)
    if (!is_in[i] && !counts_as_met[i] && !rows[i].is_equality)
    {
      const double violation = -slack(rows[i], round_off) / rows[i].length;
      if (violation > worst)
      {
        worst = violation;
        result = i;
      }
    }
  return result;
}

bool InequalityProgram::solve(const double implied)
{
  const double tolerance = std::max(implied, contradiction);
  const unsigned int patience = 20 * (x.size() + rows.size());
  for (unsigned int step = 0; step < patience; ++step)
  {
    const unsigned int row = most_violated();
    if (row == none)
    {
      if (!recall(tolerance))
        return true;
      continue;
    }
    if (take_in(row))
      continue;
    if (slack(rows[row], tolerance) != 0.)
      return false;
    counts_as_met[row] = true;
  }
  return false;
}

/**
 * Rows that others implied when their turn came, where x was far away and round-off large, may contradict those where x is now, or
 * others may have gone. Such rows count no longer; true: there are some.
 */
bool InequalityProgram::recall(const double tolerance)
{
  bool result = false;
  for (unsigned int i = 0; i < rows.size(); ++i)
    if (counts_as_met[i] && slack(rows[i], tolerance) < 0.)
    {
      counts_as_met[i] = false;
      result = true;
    }
  return result;
}

/** Move to the minimiser over the active rows and this one, giving up inequalities on the way. */
bool InequalityProgram::take_in(const unsigned int row)
{
  for (double multiplier = 0.;;)
  {
    for (unsigned int i = 0; i < d.size(); ++i)
    {
      d[i] = 0.;
      for (const auto &[k, entry] : rows[row].entries)
        d[i] += J(i, k) * entry;
    }
    const std::vector<double> r = combination(d);
    // For what is round-off of the row no other one gives way, least of all where equations alone imply it.
    const double least = dependent * d.l2_norm();
    double dual_step = infinity;
    unsigned int blocking = none;
    for (unsigned int k = 0; k < r.size(); ++k)
      if (r[k] > 0. && !rows[active[k]].is_equality && y[k] / r[k] < dual_step &&
          r[k] * length_in_R(k) > least)
      {
        dual_step = y[k] / r[k];
        blocking = k;
      }
    free = d;
    std::fill(free.begin(), free.begin() + r.size(), 0.);
    const bool is_independent = free.l2_norm() > least;
    if (!is_independent && rows[row].is_equality)
      return slack(rows[row], dependent) == 0.; // what others imply need not be active
    double full_step = infinity;
    if (is_independent)
      full_step = -slack(rows[row], 0.) / free.norm_sqr();
    const double step = std::min(dual_step, full_step);
    if (step == infinity)
      return false;
    if (is_independent)
    {
      J.Tvmult(z, free);
      move(step, z);
    }
    for (unsigned int k = 0; k < r.size(); ++k)
      y[k] = rows[active[k]].is_equality ? y[k] - step * r[k] : std::max(0., y[k] - step * r[k]);
    multiplier += step;
    if (step == full_step)
    {
      activate(row, multiplier);
      meet_active();
      return true;
    }
    drop(blocking);
  }
}

/** The row as a sum over active ones, as far as it is one: `R^-1 d_1`, d_1 the first entries of d. */
std::vector<double> InequalityProgram::combination(const Vector<double> &d) const
{
  std::vector<double> r(active.size());
  for (unsigned int i = r.size(); i-- > 0;)
  {
    r[i] = d[i];
    for (unsigned int k = i + 1; k < r.size(); ++k)
      r[i] -= R(i, k) * r[k];
    r[i] /= R(i, i);
  }
  return r;
}

/** Of an active row, in the norm of H^-1. */
double InequalityProgram::length_in_R(const unsigned int place) const
{
  double sum = 0.;
  for (unsigned int i = 0; i <= place; ++i)
    sum += R(i, place) * R(i, place);
  return std::sqrt(sum);
}

/** Take from x what round-off of the steps leaves of the active rows, else rows that these imply seem violated. */
void InequalityProgram::meet_active()
{
  missing = 0.;
  for (unsigned int k = 0; k < active.size(); ++k)
  {
    missing[k] = -slack(rows[active[k]], 0.);
    for (unsigned int i = 0; i < k; ++i)
      missing[k] -= R(i, k) * missing[i];
    missing[k] /= R(k, k);
  }
  J.Tvmult(z, missing);
  move(1., z);
}

void InequalityProgram::move(const double step, const Vector<double> &direction)
{
  x.add(step, direction);
  note_reach();
}

void InequalityProgram::note_reach()
{
  for (unsigned int i = 0; i < x.size(); ++i)
  {
    reach[i] = std::max(reach[i], std::abs(x[i]));
    size_of_x[i] = std::max(std::abs(x[i]), 1e-10 * reach[i]);
  }
}

/** Turn rows i and i + 1 of J so that (a, b) becomes (length, 0). */
InequalityProgram::Rotation InequalityProgram::rotate(const unsigned int i, const double a,
                                                      const double b)
{
  const double length = std::hypot(a, b);
  const Rotation turn{length == 0. ? 1. : a / length, length == 0. ? 0. : b / length};
  for (unsigned int k = 0; k < J.n(); ++k)
    turn.apply(J(i, k), J(i + 1, k));
  return turn;
}

/** The last active row from now on is @p row with `d = J row`. */
void InequalityProgram::activate(const unsigned int row, const double multiplier)
{
  const unsigned int q = active.size();
  for (unsigned int i = d.size() - 1; i > q; --i)
    rotate(i - 1, d[i - 1], d[i]).apply(d[i - 1], d[i]);
  for (unsigned int i = 0; i <= q; ++i)
    R(i, q) = d[i];
  active.push_back(row);
  y.push_back(multiplier);
  is_in[row] = true;
}

void InequalityProgram::drop(const unsigned int place)
{
  is_in[active[place]] = false;
  active.erase(active.begin() + place);
  y.erase(y.begin() + place);
  for (unsigned int k = place; k < active.size(); ++k)
    for (unsigned int i = 0; i <= k + 1; ++i)
      R(i, k) = R(i, k + 1);
  for (unsigned int k = place; k < active.size(); ++k)
  {
    const Rotation turn = rotate(k, R(k, k), R(k + 1, k));
    for (unsigned int column = k; column < active.size(); ++column)
      turn.apply(R(k, column), R(k + 1, column));
  }
}

const Vector<double> &InequalityProgram::minimiser() const
{
  return x;
}

std::vector<double> InequalityProgram::multipliers() const
{
  std::vector<double> result(rows.size());
  for (unsigned int k = 0; k < active.size(); ++k)
    result[active[k]] = y[k];
  return result;
}
} // namespace hpvi
