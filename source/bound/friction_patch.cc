// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/bound/friction_patch.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/solvers/inequality_program.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** By how much |l| may exceed 1, and how near to its bound a moment counts as that. */
constexpr double beyond_one = 1e-14;

/** The constant that does the work of z_N on a patch, or the admissible one that is nearest to it. */
double constant_part(const std::vector<PatchFace *> &sides)
{
  double work = 0, limit = 0;
  for (const PatchFace *side : sides)
  {
    work += side->work;
    limit += side->limit;
  }
  return std::max(-1., std::min(1., work / limit));
}

/** Bring l into [-1,1] by as much of the constant as it takes, which changes none of its conditions. */
void shrink(const std::vector<PatchFace *> &sides)
{
  const double c = constant_part(sides);
  double part = 0;
  for (const PatchFace *side : sides)
    for (const double s : side->l.extremes())
      if (const double value = side->l(s); std::abs(value) > 1. + beyond_one)
        part = std::max(part, (std::abs(value) - 1.) / std::abs(value - c));
  if (part == 0)
    return;
  for (PatchFace *side : sides)
  {
    std::vector<double> coefficients = side->l.coefficients();
    for (double &coefficient : coefficients)
      coefficient *= 1. - part;
    coefficients[0] += part * c * std::sqrt(2.);
    side->l = EdgePolynomial(coefficients);
  }
}

/** The quadratic program for those sides of one patch that no forced slip determines. */
class PatchProgram
{
public:
  PatchProgram(const std::vector<PatchFace *> &sides, const std::vector<PatchFace *> &free);

  /** Set l of the free sides; false: there is none, and they are undefined. */
  bool solve();

private:
  Vector<double> row(unsigned int side, const Vector<double> &values) const;
  InequalityProgram start() const;
  bool add_conditions(InequalityProgram &program) const;
  void add_bounds(unsigned int side, double s, InequalityProgram &program) const;
  void read(const InequalityProgram &program);

  const std::vector<PatchFace *> &sides, &free;
  std::vector<unsigned int> first; ///< unknown of each free side; their number
};

PatchProgram::PatchProgram(const std::vector<PatchFace *> &sides,
                           const std::vector<PatchFace *> &free)
    : sides(sides), free(free), first{0}
{
  for (const PatchFace *side : free)
    first.push_back(first.back() + side->h.size());
}

Vector<double> PatchProgram::row(const unsigned int side, const Vector<double> &values) const
{
  Vector<double> result(first.back());
  std::copy(values.begin(), values.end(), result.begin() + first[side]);
  return result;
}

InequalityProgram PatchProgram::start() const
{
  FullMatrix<double> H(first.back(), first.back());
  Vector<double> h(first.back());
  for (unsigned int k = 0; k < free.size(); ++k)
  {
    H.fill(free[k]->H, first[k], first[k], 0, 0);
    h += row(k, free[k]->h);
  }
  return InequalityProgram(H, h);
}

/** The work of z_N, and continuity at the vertex. */
bool PatchProgram::add_conditions(InequalityProgram &program) const
{
  double work = 0;
  for (const PatchFace *side : sides)
    work += side->work;
  for (const PatchFace *side : sides)
    if (std::find(free.begin(), free.end(), side) == free.end())
      work -= side->forced() * side->limit;
  Vector<double> moments(first.back());
  for (unsigned int k = 0; k < free.size(); ++k)
    moments += row(k, free[k]->moments);
  if (!program.add_equality(moments, work))
    return false;
  if (sides.size() < 2)
    return true;
  const auto at_vertex = [&](const unsigned int k)
  { return row(k, legendre_basis(free[k]->h.size(), free[k]->end)); };
  Vector<double> jump = at_vertex(0);
  if (free.size() == 2)
    jump -= at_vertex(1);
  const double other =
      free.size() == 2 ? 0. : (sides[0] == free[0] ? sides[1] : sides[0])->forced();
  return program.add_equality(jump, other);
}

/** -1 <= l(s) <= 1 */
void PatchProgram::add_bounds(const unsigned int side, const double s,
                              InequalityProgram &program) const
{
  Vector<double> values = row(side, legendre_basis(free[side]->h.size(), s));
  program.add_inequality(values, -1.);
  values *= -1.;
  program.add_inequality(values, -1.);
}

void PatchProgram::read(const InequalityProgram &program)
{
  const auto begin = program.minimiser().begin();
  for (unsigned int k = 0; k < free.size(); ++k)
    free[k]->l = EdgePolynomial({begin + first[k], begin + first[k + 1]});
}

bool PatchProgram::solve()
try
{
  InequalityProgram program = start();
  if (!add_conditions(program) || !program.solve())
    return false;
  read(program);
  if (std::all_of(free.begin(), free.end(),
                  [](const PatchFace *side)
                  {
                    const auto [least, most] = side->l.enclosure();
                    return least >= -1. && most <= 1.;
                  }))
    return true; // as where the body sticks well
  for (unsigned int k = 0; k < free.size(); ++k)
    for (unsigned int i = 0, n = free[k]->h.size(); i <= n; ++i)
      add_bounds(k, 0.5 - 0.5 * std::cos(numbers::PI * i / n), program);
  // Exchange: the extremes that stand out become points as well, and move towards those of the minimum.
  bool stands_out = true;
  for (unsigned int round = 0; stands_out && round < 20; ++round)
  {
    if (!program.solve())
      return false;
    read(program);
    stands_out = false;
    for (unsigned int k = 0; k < free.size(); ++k)
      for (const double s : free[k]->l.extremes())
        if (std::abs(free[k]->l(s)) > 1. + 0.5 * beyond_one)
        {
          stands_out = true;
          add_bounds(k, s, program);
        }
  }
  if (stands_out)
    shrink(sides);
  return true;
}
catch (const NumericalFailure &) // g is zero up to round-off
{
  return false;
}
} // namespace

double PatchFace::forced() const
{
  if (slip != 0. || leans)
    return slip;
  return std::abs(work) < (1. - 10. * beyond_one) * limit ? 0. : work < 0. ? -1. : 1.;
}

void distribute(const std::vector<PatchFace *> &sides)
{
  std::vector<PatchFace *> free;
  double slip = 0;
  bool is_contradictory = false;
  for (PatchFace *side : sides)
    if (const double forced = side->forced(); forced == 0.)
      free.push_back(side);
    else
    {
      side->l = EdgePolynomial::constant(forced);
      is_contradictory = is_contradictory || slip * forced < 0.;
      slip = forced;
    }
  if (is_contradictory || (!free.empty() && !PatchProgram(sides, free).solve()))
    if (!PatchProgram(sides, sides).solve())
      for (PatchFace *side : sides)
        side->l = EdgePolynomial::constant(constant_part(sides));
  double missing = 0, limit = 0;
  for (const PatchFace *side : sides)
  {
    const std::vector<double> coefficients = side->l.coefficients();
    missing += side->work;
    limit += side->limit;
    for (unsigned int i = 0; i < coefficients.size(); ++i)
      missing -= coefficients[i] * side->moments[i];
  }
  for (PatchFace *side : sides)
    side->missing = missing * side->limit / limit;
}
} // namespace hpvi
