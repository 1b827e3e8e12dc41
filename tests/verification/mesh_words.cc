// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_texts.h"

#include <hpvi/output/mesh_words.h>

#include <gtest/gtest.h>

using namespace hpvi;

TEST(MeshWords, TellLengthsAreasAndTheWidestCorner)
{
  EXPECT_EQ(mesh_words(read_text(two_squares_41), "mm"),
            (std::vector<std::string>{
                "mesh: 2 cells, 6 vertices, largest angle 90 degrees at (0, 0)",
                "boundary bottom: 2 edges, length 2 mm", "boundary 7: 1 edge, length 1 mm",
                "boundary without a name, free: 3 edges, length 3 mm",
                "curve inside joint: 1 edge, length 1 mm", "surface soft part: 1 cell, area 1 mm^2",
                "surface stiff: 1 cell, area 1 mm^2"}));
}

/** A parabola of chord 2 and height 1/4: area 1/3 beside the 2 of the rectangle, tangents of slope 1/2, length by its integral. */
TEST(MeshWords, TakeCurvesAsTheyAre)
{
  for (const std::string &text : {curved_cell_22, curved_cell_41})
  {
    const CoarseMesh mesh = read_text(text);
    EXPECT_EQ(mesh_words(mesh, "1"),
              (std::vector<std::string>{
                  "mesh: 1 cell, 4 vertices, largest angle 116.565 degrees at (0, 0)",
                  "boundary bottom: 1 edge, curved, length 2.08046",
                  "boundary without a name, free: 3 edges, length 4",
                  "surface 1: 1 cell, area 2.33333"}));
    EXPECT_NEAR(worst_cell(mesh).angle, 116.56505117707799, 1e-10); // 90 + atan(1/2)
  }
}
