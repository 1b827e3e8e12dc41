// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_metamorphic_dice_h
#define hpvi_metamorphic_dice_h

#include "frame.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace metamorphic
{
/** Random numbers, choices and functions. */
class Dice
{
public:
  explicit Dice(std::mt19937 &random) : random(random)
  {
  }

  double number(const double low, const double high)
  {
    return std::uniform_real_distribution<double>(low, high)(random);
  }

  bool happens(const double probability)
  {
    return number(0, 1) < probability;
  }

  std::string chosen(const std::vector<std::string> &choices)
  {
    return choices[random() % choices.size()];
  }

  /** A number of the size @p magnitude, of either sign. */
  std::string about(const double magnitude)
  {
    return text(std::round(1000 * number(-1, 1)) / 1000 * magnitude);
  }

  /** A function of X and Y of that size. */
  std::string function(const double magnitude)
  {
    const std::string variable = chosen({"X", "Y"});
    switch (random() % 4)
    {
    case 0:
      return about(magnitude);
    case 1:
      return about(magnitude) + " + " + about(magnitude) + "*" + variable;
    case 2:
      return about(magnitude) + " + " + about(magnitude) + "*X*Y + " + about(magnitude) + "*" +
             variable + "^2";
    default:
      return about(magnitude) + "*cos(3*" + variable + ")";
    }
  }

  /** Of one sign. */
  std::string positive(const double magnitude)
  {
    const std::string size = text(magnitude * number(0.1, 1));
    switch (random() % 5)
    {
    case 0:
      return size + "*(0.2 + X^2 + Y)";
    case 1:
      return size + "*exp(-X - Y)";
    case 2:
      return happens(0.5) ? size + "*max(0, X + Y - 0.43)" : size + "*if(X + Y < 0.47, 1, 0.3)";
    default:
      return size;
    }
  }

  /** Zero but in a strip across @p variable, of a place and width that no mesh knows. */
  std::string strip(const std::string &variable, const double magnitude)
  {
    return "if(abs(" + variable + " - " + text(number(0, 1)) + ") < " + text(number(0.02, 0.2)) +
           ", " + text(magnitude * number(0.1, 1)) + ", 0)";
  }

private:
  std::mt19937 &random;
};
} // namespace metamorphic

#endif
