// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies of drawings solved: closed forms, forces by statics, the same body by other cells.
#include "drawing_files.h"

#include <cmath>

namespace
{
using namespace drawings;

/** On the coarse mesh with one degree. */
double energy_of(const Scene<2> &scene, const unsigned int degree)
{
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  Degrees degrees(mesh.n_active_cells(), degree);
  set_edge_degrees(mesh, degrees);
  const Laboratory laboratory(scene, mesh, degrees);
  const Solution<2> solution = laboratory.solve();
  return 0.5 * internal_forces(laboratory.scene, solution.displacement_space, solution.tables,
                               solution.u)
                   .energy_product -
         laboratory.system.work(solution.u);
}

/** Lame's ring of a STEP file under pressure inside: as near to J = -p u_r(1) pi/4 as the shape that is a ring. */
TEST(DrawnBodies, AreLamesRing)
{
  const Folder folder;
  folder.draw(ring + saved({"mm.step"}));
  std::string metres = folder.text("mm.step");
  const std::string unit = "SI_UNIT(.MILLI.,.METRE.)";
  metres.replace(metres.find(unit), unit.size(), "SI_UNIT($,.METRE.)");
  folder.write("m.step", metres);
  const double u = 0.13 * (0.4 / 3 + 4. / 3), J = -u * numbers::PI / 4;
  const auto error_of = [&](const Overrides &geometry, const std::string &inner,
                            const std::vector<std::string> &cuts, const unsigned int degree)
  {
    Overrides entries = geometry + given::elastic("10", "0.3") + given::symmetric(cuts);
    entries.emplace_back("Boundary " + inner + "/Pressure", "1");
    return std::abs(energy_of(scene_of(entries), degree) / J - 1);
  };
  const double round_off = 1e-13;
  for (const unsigned int degree : {4U, 8U})
  {
    const double shape = error_of({{"Geometry/Shape", "ring sector"},
                                   {"Geometry/Radii", "1, 2"},
                                   {"Geometry/Subdivisions", "2, 4"}},
                                  "inner", {"start", "end"}, degree);
    for (const std::string file : {"mm.step", "m.step"})
      EXPECT_LT(error_of({{"Geometry/Shape", "file"}, {"Geometry/File", folder(file)}}, "4",
                         {"1", "3"}, degree),
                2 * shape + round_off)
          << file << degree;
  }
}

/** A bracket by quadrilaterals, triangles and a mixture, its curves those of CAD: one energy. */
TEST(DrawnBodies, HaveOneEnergyByAllCells)
{
  const Folder folder;
  folder.draw(bracket + saved({"bracket.step"}));
  const std::string step = "Merge \"bracket.step\";\n";
  const auto scene = [&](const std::string &options)
  {
    folder.write("drawing.geo", kernel + step + options);
    return scene_of({{"Geometry/Shape", "file"},
                     {"Geometry/File", folder("drawing.geo")},
                     {"Boundary 1/Displacement", "0; 0"},
                     {"Boundary hole/Curves", "8"},
                     {"Boundary hole/Pressure", "1"},
                     given::elastic("10", "0.3")});
  };
  const double quadrilaterals = energy_of(scene(""), 9),
               triangles = energy_of(scene("Mesh.RecombineAll = 0;\n"), 6),
               mixture = energy_of(scene("Mesh.RecombinationAlgorithm = 0;\n"), 6);
  EXPECT_NEAR(triangles / quadrilaterals, 1, 1e-6);
  EXPECT_NEAR(mixture / quadrilaterals, 1, 1e-6);
}

/** The error of polynomial edges of second and third order and of splines falls like h^4, that of straight ones like h^2. */
TEST(DrawnBodies, HaveTheErrorOfTheirEdges)
{
  const Folder folder;
  folder.draw(ring + saved({"ring.step"}));
  const std::string script = kernel +
                             "Merge \"ring.step\";\nPhysical Surface(\"body\") = Surface{:};\n"
                             "Physical Curve(\"inner\") = {4}; Physical Curve(\"x\") = {1};\n"
                             "Physical Curve(\"outer\") = {2};\n"
                             "Physical Curve(\"y\") = {3}; Mesh.RecombineAll = 1;\n"
                             "Transfinite Curve{1, 3} = 3; Transfinite Surface{1};\n";
  const double u = 0.13 * (0.4 / 3 + 4. / 3), J = -u * numbers::PI / 4;
  const auto error = [&](const unsigned int order, const unsigned int n, const std::string &curve)
  {
    const std::string name = "ring" + std::to_string(order) + std::to_string(n) + ".msh";
    folder.draw(script + "Transfinite Curve{2, 4} = " + std::to_string(n + 1) +
                ";\nMesh 2; SetOrder " + std::to_string(order) + ";\n" + saved({name}));
    Overrides entries{{"Geometry/Shape", "file"},       {"Geometry/File", folder(name)},
                      {"Boundary inner/Pressure", "1"}, {"Boundary inner/Curve", curve},
                      {"Boundary outer/Curve", curve},  given::elastic("10", "0.3")};
    const Overrides cuts = given::symmetric({"x", "y"});
    entries.insert(entries.end(), cuts.begin(), cuts.end());
    return std::abs(energy_of(scene_of(entries), 7) / J - 1);
  };
  struct Row
  {
    unsigned int order;
    std::string curve;
    double rate;
  };
  for (const Row &row : std::vector<Row>{{1, "", 2}, {2, "", 4}, {3, "", 4}, {1, "spline", 4}})
  {
    const double rate = std::log2(error(row.order, 4, row.curve) / error(row.order, 8, row.curve));
    EXPECT_GT(rate, row.rate - 0.5) << row.order << row.curve;
  }
}
} // namespace
