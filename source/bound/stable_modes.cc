// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/stable_modes.h>

namespace hpvi
{
using namespace dealii;

Modes<3> without_oscillating_pressure(Modes<3> sigma, const unsigned int p, const Tensor<2, 2> &B,
                                      const Material &material)
{
  const HookesLaw<2> law(material);
  const Tensor<2, 2> to_trace = transpose(B) * B, unit = invert(to_trace);
  for (unsigned int i = 0; i < sigma.n; ++i)
    for (unsigned int j = 0; j < sigma.n; ++j)
      if (i + j >= p)
      {
        const double trace = sigma(0, i, j) * to_trace[0][0] + sigma(1, i, j) * to_trace[1][1] +
                             2 * sigma(2, i, j) * to_trace[0][1];
        const double pressure = law.volumetric_stress(trace);
        sigma(0, i, j) -= pressure * unit[0][0];
        sigma(1, i, j) -= pressure * unit[1][1];
        sigma(2, i, j) -= pressure * unit[0][1];
      }
  return sigma;
}
} // namespace hpvi
