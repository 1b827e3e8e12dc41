// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/contact/friction_rule.h>

#include <algorithm>
#include <array>
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
  double s, g;
};

bool before(const Sample &a, const Sample &b)
{
  return a.s < b.s;
}

/** A part of the edge with g on it, on its halves and on its quarters. */
struct Piece
{
  double begin, end;
  std::vector<Sample> rule;    ///< at the Gauss points of the piece itself
  std::vector<Sample> samples; ///< at those of its parts as well, by position
  double deviation = 0;        ///< of the integrals by the three rules

  double largest() const
  {
    double result = 0;
    for (const Sample &sample : samples)
      result = std::max(result, std::abs(sample.g));
    return result;
  }
};

/** Cuts an edge into pieces. */
class Cutter
{
public:
  Cutter(const std::function<double(double)> &g, const QGauss<1> &gauss, const unsigned int degree)
      : g(g), gauss(gauss), degree(degree), pieces{sampled(0., 1.)}
  {
  }

  FrictionRule cut();

private:
  Piece sampled(double begin, double end) const;
  double find_cut(const Piece &piece);

  const std::function<double(double)> &g;
  const QGauss<1> &gauss;
  const unsigned int degree;
  std::vector<Piece> pieces;
  std::vector<FrictionRule::Jump> jumps;
};

Piece Cutter::sampled(const double begin, const double end) const
{
  // Even and odd factors: a jump in the middle of a piece deceives either kind alone.
  Piece piece{begin, end, {}, {}};
  const std::array<unsigned int, 3> factors{{0, degree - 1, degree}};
  std::array<std::array<double, factors.size()>, 3> integrals{};
  for (unsigned int level = 0; level < integrals.size(); ++level)
    for (unsigned int part = 0; part < (1U << level); ++part)
    {
      const double width = (end - begin) / (1U << level), start = begin + part * width;
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double s = start + width * gauss.point(q)[0], value = g(s);
        piece.samples.push_back({s, value});
        for (unsigned int k = 0; k < factors.size(); ++k)
          integrals[level][k] +=
              width * gauss.weight(q) * value * std::legendre(factors[k], 2 * s - 1);
      }
    }
  piece.rule.assign(piece.samples.begin(), piece.samples.begin() + gauss.size());
  std::sort(piece.samples.begin(), piece.samples.end(), before);
  for (const unsigned int level : {0, 1})
    for (unsigned int k = 0; k < factors.size(); ++k)
      piece.deviation = std::max(piece.deviation, std::abs(integrals[level][k] - integrals[2][k]));
  return piece;
}

/** At a jump, which bisection of the steepest interval does not flatten, else in the middle. */
double Cutter::find_cut(const Piece &piece)
{
  const auto change = [](const Sample &a, const Sample &b) { return std::abs(b.g - a.g); };
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
      jumps.push_back({s, right.g - left.g});
      return s;
    }
    const Sample middle{s, g(s)};
    (change(left, middle) > change(middle, right) ? right : left) = middle;
  }
  return 0.5 * (piece.begin + piece.end);
}

FrictionRule Cutter::cut()
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

  FrictionRule result{{0.}, {}, {}, {}, jumps};
  for (const Piece &piece : pieces)
  {
    result.cuts.push_back(piece.end);
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      result.points.push_back(piece.rule[q].s);
      result.weights.push_back((piece.end - piece.begin) * gauss.weight(q));
      result.values.push_back(piece.rule[q].g);
    }
  }
  return result;
}
} // namespace

bool FrictionRule::vanishes() const
{
  return std::all_of(values.begin(), values.end(), [](const double g) { return g == 0.; });
}

double FrictionRule::integral() const
{
  return std::inner_product(values.begin(), values.end(), weights.begin(), 0.);
}

FrictionRule make_friction_rule(const std::function<double(double)> &g, const QGauss<1> &gauss,
                                const unsigned int degree)
{
  return Cutter(g, gauss, degree).cut();
}
} // namespace hpvi
