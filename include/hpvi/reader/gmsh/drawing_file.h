// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_drawing_file_h
#define hpvi_drawing_file_h

#include <hpvi/reader/gmsh/gmsh_file.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace hpvi
{
/** What a scene says of a drawing. */
struct DrawingRequest
{
  double size = 0;       ///< of cells [length]; 0: a tenth of the drawing's
  double curvature = 12; ///< cells per turn of curves
  std::string unit;      ///< of the result; empty: the file's own
  std::map<std::int64_t, std::string> curves = {}; ///< names by the numbers of curves
  std::map<std::string, std::string> bent = {};    ///< circle or spline, by the names of curves
};

/** Those that it gives to curves, sorted. */
std::vector<std::string> names_of_curves(const DrawingRequest &request);

/** What the process that reads a drawing may take. */
struct DrawingLimits
{
  double seconds = 60, megabytes = 8000;
};

/**
 * The drawing or mesh @p path, or the GivenMesh of that name, by its content: a deck by read_deck_mesh(), all else by the
 * program hpvi_drawing, a process beside this one. Throws InputError of one line, where that dies, too.
 */
GmshFile read_drawing(const std::string &path, unsigned int dim, const DrawingRequest &request = {},
                      const DrawingLimits &limits = {});
} // namespace hpvi

#endif
