// SPDX-License-Identifier: LGPL-2.1-or-later
// What is known of A before anyone looks at it: is it true?
#include "discretisation.h"

#include <hpvi/plane/dissection.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace
{
using namespace verification;
using Numbers = std::vector<unsigned int>;

/** By unknown of A, those it has entries with. */
std::vector<std::set<unsigned int>> neighbours(const SymmetricMatrix &A)
{
  std::vector<std::set<unsigned int>> result(A.n());
  for (unsigned int column = 0; column < A.n(); ++column)
    for (int k = A.column_start[column]; k < A.column_start[column + 1]; ++k)
    {
      result[column].insert(A.row[k]);
      result[A.row[k]].insert(column);
    }
  return result;
}

TEST(Dissection, UnknownsThatAreAlikeHaveEntriesInTheSamePlaces)
{
  for (const std::string file : {"han-6-12", "resting", "ballast", "punch-plate", "laminate"})
    for (const unsigned int seed : {1, 2})
    {
      SCOPED_TRACE(file + ", seed " + std::to_string(seed));
      const Scene<2> scene = shipped_scene(file);
      const RandomMesh mesh(scene, seed, 2);
      const Laboratory step(scene, mesh);
      const Numbers &alike = step.system.hints.supervariables;
      ASSERT_EQ(alike.size(), step.system.A.n());
      const auto entries = neighbours(step.system.A);
      std::map<unsigned int, unsigned int> first;
      for (unsigned int i = 0; i < alike.size(); ++i)
        EXPECT_EQ(entries[i], entries[first.try_emplace(alike[i], i).first->second]) << i;
      EXPECT_LT(first.size(), alike.size() / 3); // or it would be of no use
    }
}

/** Node by node of a mesh. */
Numbers stages_of_vertices(const Triangulation<2> &mesh)
{
  Dissection dissection(mesh, mesh.n_vertices());
  for (const auto &cell : mesh.active_cell_iterators())
    dissection.add(cell->active_cell_index(), {cell->vertex_index(0), cell->vertex_index(1),
                                               cell->vertex_index(2), cell->vertex_index(3)});
  return dissection.stages();
}

/** The lines between halves of the unit square, of its halves and of its quarters, which have 1024 cells. */
TEST(Dissection, CutsCellsIntoHalves)
{
  Triangulation<2> mesh;
  GridGenerator::hyper_cube(mesh);
  mesh.refine_global(6);
  const Numbers stages = stages_of_vertices(mesh);
  std::vector<Point<2>> places(mesh.n_vertices());
  for (const auto &cell : mesh.active_cell_iterators())
    for (const unsigned int v : cell->vertex_indices())
      places[cell->vertex_index(v)] = cell->vertex(v);
  const auto parts = [](const Point<2> &x) // which line, by where it is
  {
    if (x[1] == 0.5)
      return 7;
    if (x[0] == 0.5)
      return x[1] < 0.5 ? 3 : 6;
    if (x[1] == 0.25 || x[1] == 0.75)
      return 1 + (x[0] > 0.5) + 3 * (x[1] > 0.5);
    return 0;
  };
  for (unsigned int v = 0; v < places.size(); ++v)
    EXPECT_EQ(stages[v], parts(places[v])) << places[v];
}

TEST(Dissection, EliminatesAtOnceWhatNoCellHas)
{
  Triangulation<2> mesh;
  GridGenerator::hyper_cube(mesh);
  mesh.refine_global(6);
  Dissection dissection(mesh, 2);
  for (const auto &cell : mesh.active_cell_iterators())
    dissection.add(cell->active_cell_index(), {1});
  EXPECT_EQ(dissection.stages(), (Numbers{0, 7}));
}

TEST(Dissection, LeavesSmallMeshesAndCoarseCellsAlone)
{
  Triangulation<2> small;
  GridGenerator::hyper_cube(small);
  small.refine_global(4);
  EXPECT_TRUE(stages_of_vertices(small).empty());

  Triangulation<2> coarse;
  GridGenerator::subdivided_hyper_cube(coarse, 40);
  const Numbers stages = stages_of_vertices(coarse);
  EXPECT_EQ(std::set<unsigned int>(stages.begin(), stages.end()).size(), 2U);
  EXPECT_EQ(std::count(stages.begin(), stages.end(), 0U), 4); // corners have one cell
}
} // namespace
