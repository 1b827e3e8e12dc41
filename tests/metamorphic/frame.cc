// SPDX-License-Identifier: LGPL-2.1-or-later
#include "frame.h"

#include <deal.II/base/numbers.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace metamorphic
{
std::string text(const double value)
{
  std::ostringstream out;
  out << std::setprecision(17) << value;
  return out.str();
}

bool Frame::keeps_axes() const
{
  return Q[0][0] * Q[0][1] == 0.;
}

unsigned int Frame::side(const unsigned int k) const
{
  return is_mirrored() ? (first + 3 - k) % 4 : (first + k) % 4;
}

Point<2> Frame::point(const Point<2> &x) const
{
  return Point<2>(shift + length * (Q * x));
}

Point<2> Frame::point_back(const Point<2> &x) const
{
  return Point<2>(transpose(Q) * (x - Point<2>(shift)) / length);
}

std::string Frame::function(const std::string &function, const double factor) const
{
  // (X Y) = edges^-1 (Q' (x' - shift)/length - origin)
  const Tensor<2, 2> M = invert(edges) * transpose(Q) / length;
  const Tensor<1, 2> at_zero = -(M * shift) - invert(edges) * origin;
  std::string result;
  for (const char c : function)
    if (c == 'X' || c == 'Y')
    {
      const unsigned int k = c == 'X' ? 0 : 1;
      result += "(" + text(M[k][0]) + "*x + " + text(M[k][1]) + "*y + " + text(at_zero[k]) + ")";
    }
    else if (c == 'P')
      result += "(p/" + text(amplitude * stress) + ")";
    else
      result += c;
  return factor == 1. || result.empty() ? result : text(factor) + "*(" + result + ")";
}

Frame random_frame(Frame frame, const bool along_axes, std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  const unsigned int quarter = random() % 4;
  const double cosines[] = {1, 0, -1, 0}, sines[] = {0, 1, 0, -1};
  double cosine = cosines[quarter], sine = sines[quarter];
  const double angle = numbers::PI * uniform(random);
  const bool is_turned = uniform(random) < 0.2; // else by quarters
  if (!along_axes && is_turned)
  {
    cosine = std::cos(angle);
    sine = std::sin(angle);
  }
  const double mirror = random() % 2 == 0 ? 1. : -1.;
  frame.Q = Tensor<2, 2>({{cosine, -sine * mirror}, {sine, cosine * mirror}});
  const auto magnitude = [&](const double decades)
  { return random() % 2 == 0 ? 1. : std::pow(10., decades * uniform(random)); };
  frame.length = magnitude(4);
  frame.stress = magnitude(8);
  frame.amplitude = magnitude(3);
  frame.thickness = magnitude(2);
  const double far = random() % 2 == 0 ? 0. : frame.length * magnitude(2);
  frame.shift = far * Point<2>(uniform(random), uniform(random));
  frame.first = random() % 4;
  frame.writes_box = random() % 2 == 0;
  frame.order = random();
  return frame;
}
} // namespace metamorphic
