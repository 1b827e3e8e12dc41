// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/output/result_directory.h>
#include <hpvi/output/summary.h>
#include <hpvi/output/tables.h>

#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#include <boost/property_tree/json_parser.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

using namespace hpvi;

namespace
{
boost::property_tree::ptree parsed(const std::string &json)
{
  std::istringstream stream(json);
  boost::property_tree::ptree tree;
  read_json(stream, tree);
  return tree;
}

// A displacement of zero has no relative error.
TEST(Summary, HasNullForWhatIsNoNumber)
{
  const double infinity = std::numeric_limits<double>::infinity();
  Scene<2> scene;
  for (const unsigned int component : {0, 1})
    scene.boundaries[0].displacement[component] =
        std::make_shared<dealii::Functions::ZeroFunction<2>>();
  scene.boundaries[3].traction[1] = std::make_shared<dealii::Functions::ConstantFunction<2>>(1.);
  scene.adaptivity.maximum_steps = 1;
  Summary summary;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        ASSERT_TRUE(step.bound);
        StepReport<2> odd = step;
        odd.relative_bound = infinity;
        odd.energies.energy = -infinity;
        odd.equilibrium.force_imbalance = std::numeric_limits<double>::quiet_NaN();
        Tables<2> tables;
        tables.add(odd);
        Record row = tables.convergence.last;
        row.insert(row.end(),
                   {{"infinite", -infinity}, {"nan", std::nan("")}, {"word", "infinite"}});
        summary.add(odd, row);
      });
  const auto tree = parsed(summary.json(scene, {"summary.json"}));
  for (const char *const name :
       {"error_bound.relative", "balance.force", "final.infinite", "final.nan"})
    EXPECT_EQ(tree.get<std::string>(name), "null") << name;
  for (const auto &end : tree.get_child("error_bound.energy"))
    EXPECT_EQ(end.second.data(), "null");
  EXPECT_EQ(tree.get<std::string>("final.word"), "infinite");
}

using Names = std::vector<std::string>;

TEST(FileNames, AreRangesOfOneWidth)
{
  FileNames names;
  for (unsigned int step = 98; step <= 101; ++step)
  {
    EXPECT_TRUE(names.add(numbered("contact", step, ".csv")));
    EXPECT_TRUE(names.add(numbered("solution", step, ".0.vtu")));
  }
  EXPECT_TRUE(names.add(numbered("contact", 7, ".csv")));
  EXPECT_TRUE(names.add("scene.prm"));
  EXPECT_FALSE(names.add("scene.prm"));
  EXPECT_FALSE(names.add("contact-99.csv"));
  EXPECT_EQ(names.list(),
            Names({"contact-07.csv", "contact-{98..99}.csv", "contact-{100..101}.csv", "scene.prm",
                   "solution-{98..99}.0.vtu", "solution-{100..101}.0.vtu"}));
  EXPECT_FALSE(names.contains("contact-08.csv"));
  EXPECT_FALSE(names.contains("contact-098.csv"));
  EXPECT_FALSE(names.contains("contact-98.svg"));
}

TEST(FileNames, AreReadAsTheyAreListed)
{
  FileNames names;
  for (const char *const entry : {"mesh-{03..09}.svg", "mesh-12.svg", "degrees.csv"})
    EXPECT_TRUE(names.add(entry));
  for (const char *const entry : {"mesh-{5..9}.svg", "mesh-{20..19}.svg", "mesh-{1..020}.svg"})
    names.add(entry); // what this program has not written claims no file
  for (unsigned int step = 0; step < 30; ++step)
    EXPECT_EQ(names.contains(numbered("mesh", step, ".svg")),
              (step >= 3 && step <= 9) || step == 12)
        << step;
}

TEST(FileNames, LeaveGapsWhereOneIsRemoved)
{
  FileNames names;
  names.add("mesh-{03..09}.svg");
  for (const char *const name : {"mesh-03.svg", "mesh-05.svg", "mesh-09.svg", "mesh-20.svg"})
    names.remove(name);
  EXPECT_EQ(names.list(), Names({"mesh-04.svg", "mesh-{06..08}.svg"}));
  EXPECT_TRUE(names.add("mesh-05.svg"));
  EXPECT_TRUE(names.contains("mesh-05.svg"));
}
} // namespace
