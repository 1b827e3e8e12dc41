// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/cut_rule.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
struct Sample
{
  double s, f;
};

bool before(const Sample &a, const Sample &b)
{
  return a.s < b.s;
}

/** A part of [0,1] with f on it, on its halves, on its quarters and on finer parts. */
struct Piece
{
  double begin, end;
  std::vector<Sample> rule;    ///< at the Gauss points of the piece itself
  std::vector<Sample> samples; ///< at those of its parts as well, by position
  double deviation = 0;        ///< of the integrals on coarser parts from those on the finest
  double finer_integral = 0;   ///< int f on the finest

  double largest() const
  {
    double result = 0;
    for (const Sample &sample : samples)
      result = std::max(result, std::abs(sample.f));
    return result;
  }
};

/** Cuts [0,1] into pieces. */
class Cutter
{
public:
  Cutter(const std::function<double(double)> &f, const QGauss<1> &gauss,
         const std::vector<unsigned int> &factors, const unsigned int n_parts)
      : f(f), gauss(gauss), factors(factors), n_parts(n_parts), pieces{sampled(0., 1.)}
  {
  }

  CutRule cut();

private:
  Piece sampled(double begin, double end) const;
  std::vector<double> integrals(Piece &piece, unsigned int n) const;
  double find_cut(const Piece &piece);

  const std::function<double(double)> &f;
  const QGauss<1> &gauss;
  const std::vector<unsigned int> factors;
  const unsigned int n_parts;
  std::vector<Piece> pieces;
  std::vector<CutRule::Jump> jumps;
};

/** Of f times each factor, on @p n parts of the piece; their points join its samples. */
std::vector<double> Cutter::integrals(Piece &piece, const unsigned int n) const
{
  std::vector<double> result(factors.size());
  const double width = (piece.end - piece.begin) / n;
  for (unsigned int part = 0; part < n; ++part)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double s = piece.begin + part * width + width * gauss.point(q)[0], value = f(s);
      piece.samples.push_back({s, value});
      for (unsigned int k = 0; k < factors.size(); ++k)
        result[k] += width * gauss.weight(q) * value * std::legendre(factors[k], 2 * s - 1);
    }
  return result;
}

Piece Cutter::sampled(const double begin, const double end) const
{
  // Even and odd factors: a jump in the middle of a piece deceives either kind alone.
  Piece piece{begin, end, {}, {}};
  std::vector<std::vector<double>> levels;
  for (const unsigned int n : {1U, 2U, 4U})
    levels.push_back(integrals(piece, n));
  const unsigned int n_finest = std::ceil(n_parts * (end - begin));
  if (n_finest > 4)
    levels.push_back(integrals(piece, n_finest));
  piece.rule.assign(piece.samples.begin(), piece.samples.begin() + gauss.size());
  std::sort(piece.samples.begin(), piece.samples.end(), before);
  for (const std::vector<double> &level : levels)
    for (unsigned int k = 0; k < factors.size(); ++k)
      piece.deviation = std::max(piece.deviation, std::abs(level[k] - levels.back()[k]));
  piece.finer_integral = levels.back()[0];
  return piece;
}

/** At a jump, which bisection of the steepest interval does not flatten, else in the middle. */
double Cutter::find_cut(const Piece &piece)
{
  const auto change = [](const Sample &a, const Sample &b) { return std::abs(b.f - a.f); };
  auto steepest = piece.samples.begin();
  for (auto sample = steepest; std::next(sample) != piece.samples.end(); ++sample)
    if (change(*sample, *std::next(sample)) > change(*steepest, *std::next(steepest)))
      steepest = sample;
  Sample left = *steepest, right = *std::next(steepest);
  const double half_change = 0.5 * change(left, right);
  while (change(left, right) > half_change)
  {
    const double s = 0.5 * (left.s + right.s);
    if (!(left.s < s && s < right.s)) // neighbouring numbers
    {
      jumps.push_back({s, right.f - left.f});
      return s;
    }
    const Sample middle{s, f(s)};
    (change(left, middle) > change(middle, right) ? right : left) = middle;
  }
  return 0.5 * (piece.begin + piece.end);
}

CutRule Cutter::cut()
{
  const std::size_t most_pieces = 64;
  double largest = pieces.front().largest();
  while (pieces.size() < most_pieces)
  {
    const auto worst =
        std::max_element(pieces.begin(), pieces.end(),
                         [](const Piece &a, const Piece &b) { return a.deviation < b.deviation; });
    if (!(worst->deviation > 1e-13 * largest))
      break;
    const double cut = find_cut(*worst);
    const Piece right = sampled(cut, worst->end);
    *worst = sampled(worst->begin, cut);
    largest = std::max({largest, worst->largest(), right.largest()});
    pieces.insert(std::next(worst), right);
  }

  CutRule result{{0.}, {}, {}, {}, jumps};
  double largest_deviation = 0;
  for (const Piece &piece : pieces)
  {
    result.cuts.push_back(piece.end);
    result.finer_integral += piece.finer_integral;
    result.deviation += piece.deviation;
    if (piece.deviation > largest_deviation)
    {
      largest_deviation = piece.deviation;
      result.worst = 0.5 * (piece.begin + piece.end);
    }
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      result.points.push_back(piece.rule[q].s);
      result.weights.push_back((piece.end - piece.begin) * gauss.weight(q));
      result.values.push_back(piece.rule[q].f);
    }
  }
  return result;
}
} // namespace

bool CutRule::vanishes() const
{
  return std::all_of(values.begin(), values.end(), [](const double f) { return f == 0.; });
}

double CutRule::integral() const
{
  return std::inner_product(values.begin(), values.end(), weights.begin(), 0.);
}

CutRule make_cut_rule(const std::function<double(double)> &f, const QGauss<1> &gauss,
                      const std::vector<unsigned int> &factors, const unsigned int n_parts)
{
  return Cutter(f, gauss, factors, n_parts).cut();
}
} // namespace hpvi
