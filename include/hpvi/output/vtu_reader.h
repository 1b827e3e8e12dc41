// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_vtu_reader_h
#define hpvi_vtu_reader_h

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace hpvi
{
/** The solution at points, as solution-NN.vtu holds it, on what can be seen of it. */
struct SampledField
{
  std::vector<std::array<double, 3>> points;       ///< of the undeformed body [length]
  std::vector<std::array<float, 3>> displacements; ///< there [length]
  std::vector<float> von_mises;                    ///< there [stress]
  std::vector<std::array<unsigned int, 4>> quads;  ///< points around them
  std::vector<float> degrees;                      ///< of the cells, by quad
};

/**
 * Appends what one file of hpvi::vtu() holds, cells of Lagrange's kind in the plane too: in the plane all cells, in space
 * the faces around each patch. Throws InputError with what is wrong with it.
 */
void add_vtu(SampledField &field, const std::string &text, unsigned int dim);
} // namespace hpvi

#endif
