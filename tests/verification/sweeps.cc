// SPDX-License-Identifier: LGPL-2.1-or-later
// What a sweep reads, how it names its directories, what its table holds, and its threads.
#include "../texts.h"

#include <gtest/gtest.h>
#include <hpvi/base/cores.h>
#include <hpvi/base/input_error.h>
#include <hpvi/output/record.h>
#include <hpvi/reader/input/sweep.h>

#include <atomic>
#include <cmath>
#include <stdexcept>

namespace
{
using namespace hpvi;
using Texts = std::vector<std::string>;

Texts values(const std::string &text)
{
  return swept_entry("Section/Entry=" + text).values;
}

TEST(Sweeps, SplitValues)
{
  EXPECT_EQ(values("1"), Texts({"1"}));
  EXPECT_EQ(values(" 1,2 , 3e-1"), Texts({"1", "2", "3e-1"}));
  EXPECT_EQ(values("min(x, 1), max(x, (y, 2)), 3"), Texts({"min(x, 1)", "max(x, (y, 2))", "3"}));
  EXPECT_EQ(values("1, 1 | 2, 3"), Texts({"1, 1", "2, 3"}));
  EXPECT_EQ(values("x>1 || y>1, 2"), Texts({"x>1 || y>1", "2"}));
  EXPECT_EQ(values("x>1 || y>1 | 2"), Texts({"x>1 || y>1", "2"}));
  EXPECT_EQ(values("(a|b), 2"), Texts({"(a|b)", "2"}));
  EXPECT_EQ(values("0; 1, ), 2"), Texts({"0; 1", ")", "2"}));
  EXPECT_EQ(values("a=1, b"), Texts({"a=1", "b"}));
}

TEST(Sweeps, RefuseWhatIsNone)
{
  for (const char *const text :
       {"Section/Entry", "=1, 2", "Section/=1", "Section/Entry=", "Section/Entry=1,,2",
        "Section/Entry=1|2|", "Section/Entry=1, 2, 1", "Dimension=2, 3"})
    EXPECT_THROW(swept_entry(text), InputError) << text;
  EXPECT_THROW(swept_scenes({{"A/B", {"1"}}, {"A/B", {"2"}}}), InputError);
}

Texts directories(const Texts &sweeps)
{
  std::vector<SweptEntry> entries;
  for (const std::string &sweep : sweeps)
    entries.push_back(swept_entry(sweep));
  Texts names;
  for (const SweptScene &scene : swept_scenes(entries))
    names.push_back(scene.directory);
  return names;
}

TEST(Sweeps, NameDirectories)
{
  EXPECT_EQ(directories({"Boundary  bottom/Friction   bound=4.5, 1e+3, -x"}),
            Texts({"Friction bound=4.5", "Friction bound=1e+3", "Friction bound=-x"}));
  EXPECT_EQ(directories({"A/B=a b/c, \xc3\xa4"}), Texts({"B=a_b_c", "B=__"}));
  EXPECT_EQ(directories({"Title=x, y", "A/B=1|2"}),
            Texts({"Title=x,B=1", "Title=x,B=2", "Title=y,B=1", "Title=y,B=2"}));
  // Which of them is taken by another is not taken twice.
  EXPECT_EQ(directories({"A/B=1*2, 1/2, 1_2_2, 1;2"}),
            Texts({"B=1_2", "B=1_2_3", "B=1_2_2", "B=1_2_4"}));
  const std::string value(300, 'x');
  EXPECT_EQ(directories({"A/B=" + value + ", " + value + "y"}),
            Texts({"B=" + value.substr(0, 100), "B=" + value.substr(0, 100) + "_2"}));
}

TEST(Sweeps, GiveEachSceneItsValues)
{
  const std::vector<SweptScene> scenes =
      swept_scenes({{"A/B", {"1", "2"}}, {"C/D", {"3", "4", "5"}}});
  ASSERT_EQ(scenes.size(), 6U);
  EXPECT_EQ(scenes[4].words(), "A/B = 2, C/D = 4");
  EXPECT_TRUE(is_same_entry(" A b / C  d", "A b/C d"));
  EXPECT_FALSE(is_same_entry("A/C", "B/C"));
}

TEST(Sweeps, TellOfAllInOneTable)
{
  const std::string table =
      csv({{{"A/B", "1, \"2\""}, {"directory", "B=1"}, {"status", "failed"}},
           {{"A/B", "3"}, {"directory", "B=3,C=4"}, {"status", "done"}, {"step", 7U}}});
  EXPECT_EQ(table, "A/B,directory,status,step\n\"1, \"\"2\"\"\",B=1,failed,\n"
                   "3,\"B=3,C=4\",done,7\n");
  EXPECT_EQ(csv(records(table)), table);
  EXPECT_EQ(words_of(records(table).at(1), "directory"), "B=3,C=4");
  EXPECT_TRUE(records("").empty());
}

/** What is read is written as it was, and a number is one only where that is so. */
TEST(Records, KeepWhatStandsInAFile)
{
  const std::vector<std::string> fields{"",    "7",      "1e+05", "-0",
                                        "0.1", "1e-300", "007",   "0.0",
                                        "nan", "-inf",   "1e400", "99999999999999999999"};
  for (const std::string &field : fields)
  {
    const Value value = value_from(field);
    EXPECT_EQ(text(value), field);
    const std::size_t kind = &field - fields.data();
    EXPECT_EQ(value.index(), kind == 0 ? 0U : kind == 1 ? 1U : kind < 6 ? 2U : 3U) << field;
  }
  EXPECT_EQ(text(Value(std::nan(""))), "");
  EXPECT_EQ(json_object({{"a", "7"}, {"b", 7U}, {"c", 0.1}, {"d", ""}, {"e", Value()}}),
            "{\n    \"a\": \"7\",\n    \"b\": 7,\n    \"c\": 0.1,\n    \"d\": null,\n    \"e\": "
            "null\n  }");
  EXPECT_EQ(records("a,b\n1,2\n3\n4,5\n").size(), 1U);
}

TEST(Cores, ShareAllWork)
{
  EXPECT_GE(n_usable_cores(), 1U);
  for (const unsigned int n_threads : {1U, 3U, 200U})
  {
    std::vector<unsigned int> done(100, 0);
    std::atomic<unsigned int> calls(0);
    on_threads(n_threads, done.size(),
               [&](const unsigned int k)
               {
                 done[k] = k + 1;
                 ++calls;
               });
    EXPECT_EQ(calls, 100U);
    for (unsigned int k = 0; k < done.size(); ++k)
      EXPECT_EQ(done[k], k + 1);
  }
}

/** The first by number, not by time, and the others are done. */
TEST(Cores, ThrowWhatTheFirstThrew)
{
  for (const unsigned int n_threads : {1U, 4U})
  {
    std::atomic<unsigned int> calls(0);
    const std::string failure = failure_of<std::runtime_error>(
        [&]
        {
          on_threads(n_threads, 50,
                     [&](const unsigned int k)
                     {
                       ++calls;
                       if (k % 10 == 7)
                         throw std::runtime_error(std::to_string(k));
                     });
        });
    EXPECT_EQ(failure, "7");
    EXPECT_EQ(calls, 50U);
  }
}
} // namespace
