// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fibres.h"

#include "dice.h"

#include <cmath>

namespace metamorphic
{
/** With E3 <= E2 <= E1 and such ratios the compliance is positive definite. */
Fibres random_fibres(const double ratio, std::mt19937 &random)
{
  Dice dice(random);
  Fibres result;
  result.E1 = std::pow(ratio, dice.number(0, 1));
  result.E3 = std::pow(10, dice.number(-0.5, 0));
  result.nu12 = dice.number(-0.3, 0.45);
  result.nu13 = dice.number(-0.3, 0.45);
  result.nu23 = dice.number(-0.3, 0.4);
  result.G12 = std::pow(10, dice.number(-0.7, 0.3));
  result.angle = dice.happens(0.2) ? 90. * std::round(dice.number(-2, 2)) : dice.number(-180, 180);
  return result;
}

/** Axis 2 has no sign. */
std::vector<std::pair<std::string, std::string>> entries(const Fibres &fibres, const double young,
                                                         const Frame &frame)
{
  const double degree = numbers::PI / 180, stress = young * frame.stress;
  const Tensor<1, 2> axis =
      frame.Q * Tensor<1, 2>({std::cos(degree * fibres.angle), std::sin(degree * fibres.angle)});
  return {
      {"Elasticity", "orthotropic"},
      {"Young's moduli",
       text(fibres.E1 * stress) + ", " + text(stress) + ", " + text(fibres.E3 * stress)},
      {"Poisson's ratios", text(fibres.nu12) + ", " + text(fibres.nu13) + ", " + text(fibres.nu23)},
      {"Shear moduli", text(fibres.G12 * stress)},
      {"Angle", text(std::atan2(axis[1], axis[0]) / degree)}};
}
} // namespace metamorphic
