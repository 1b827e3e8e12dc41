// SPDX-License-Identifier: LGPL-2.1-or-later
// Scenes that are built by code: the same as from a file, and refused where they are wrong.
#include "discretisation.h"

#include <hpvi/base/text.h>
#include <hpvi/output/output.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/closed_forms/stick_slip.h>
#include <hpvi/reader/scene_aliases.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/reader/scene_reader.h>

#include <cmath>
#include <limits>
#include <map>
#include <regex>

namespace
{
using namespace verification;

/** prm/han-6-12.prm, Example 5.2 of the thesis. */
Scene<2> pushed_block()
{
  Scene<2> scene;
  scene.geometry.corners = box_corners(Point<2>(0, 0), Point<2>(4, 4));
  scene.geometry.subdivisions = {{4, 4}};
  scene.materials = {{15., 0.4, PlaneModel::stress}};
  // muParser turns 1.5*(5 - y) into this, which differs in the last bit.
  scene.boundary("left").traction = {
      {expression<2>([](const Point<2> &x) { return -1.5 * x[1] + 7.5; }), expression<2>(-0.75)}};
  scene.boundary("right").displacement = {{expression<2>(0.), expression<2>(0.)}};
  scene.boundary("bottom").contact = Contact::bilateral;
  scene.boundary("bottom").friction.bound = expression<2>(4.5);
  scene.adaptivity.method = Method::hpa2;
  scene.adaptivity.indicator = Indicator::residual;
  scene.adaptivity.reading = SmoothnessReading::joint;
  scene.adaptivity.start_degree = own_start_degree(Method::hpa2);
  return scene;
}

/** What a run leaves: energies and errors of each step, and the files that equal runs share. */
struct Record
{
  std::vector<double> numbers;
  std::map<std::string, std::string> files;
};

Record record(const Scene<2> &scene)
{
  const auto directory = std::filesystem::path(::testing::TempDir()) /
                         ("hpvi-scene-" + std::to_string(std::random_device()()));
  Record result;
  {
    Output<2> output(scene, directory.string());
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          const Energies &e = step.energies;
          result.numbers.insert(result.numbers.end(),
                                {e.lagrangian, e.energy, e.slack, e.norm,
                                 step.contact.at(0).friction_resultant, step.estimate.total(),
                                 step.scaled_estimate});
          if (scene.has_known_solution())
            result.numbers.push_back(step.errors.energy);
          output.write_step(step);
        });
  }
  const std::regex timed("convergence\\.csv|summary\\.json|scene\\.prm|\\..*");
  for (const auto &entry : std::filesystem::directory_iterator(directory))
    if (const std::string name = entry.path().filename(); !std::regex_match(name, timed))
    {
      std::ostringstream content;
      content << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      result.files[name] = content.str();
    }
  EXPECT_EQ(std::filesystem::exists(directory / "scene.prm"), scene.parameters != nullptr);
  std::filesystem::remove_all(directory);
  return result;
}

void expect_same(const Record &one, const Record &other)
{
  EXPECT_FALSE(one.numbers.empty());
  EXPECT_EQ(one.numbers, other.numbers);
  EXPECT_FALSE(one.files.empty());
  EXPECT_EQ(one.files.size(), other.files.size());
  for (const auto &[name, content] : one.files)
    EXPECT_TRUE(other.files.count(name) && other.files.at(name) == content) << name;
}

TEST(SceneByCode, IsTheSameAsFromAFile)
{
  Scene<2> scene = pushed_block(), file = shipped_scene("han-6-12");
  scene.title = file.title; // pictures show it, and the units
  scene.length_unit = file.length_unit;
  scene.stress_unit = file.stress_unit;
  for (Scene<2> *each : {&scene, &file})
    each->adaptivity.maximum_steps = 9;
  expect_same(record(scene), record(file));
}

/** Compares a number of one scene with that of another. */
TEST(SceneByCode, HasTheDefaultsOfAFile)
{
  Scene<2> code;
  // A file that names no limit has a tolerance, which no code gets unasked.
  const Scene<2> file =
      scene_of({{"Boundary right/Displacement", "0; 0"}, {"Adaptivity/Maximum steps", "16"}});
  std::vector<std::string> ours, theirs;
  const auto collect = [](std::vector<std::string> &list)
  {
    return [&list](const char *section, const char *name, const auto &value)
    { list.push_back(std::string(section) + "/" + name + " = " + in_digits(value)); };
  };
  for_each_value(code, collect(ours));
  for_each_value(file, collect(theirs));
  ASSERT_GT(ours.size(), 20U);
  // All cores are what who runs a file wants; code has threads of its own.
  EXPECT_EQ(code.solver.threads, 1U);
  EXPECT_EQ(file.solver.threads, 0U);
  for (std::vector<std::string> *const list : {&ours, &theirs})
    list->erase(std::remove_if(list->begin(), list->end(),
                               [](const std::string &line)
                               { return line.rfind("Solver/Threads", 0) == 0; }),
                list->end());
  EXPECT_EQ(ours, theirs);
  EXPECT_EQ(code.adaptivity.method, file.adaptivity.method);
  EXPECT_EQ(code.adaptivity.reading, file.adaptivity.reading);
  EXPECT_EQ(code.solver.qp_solver, file.solver.qp_solver);
  EXPECT_EQ(code.geometry.shape, file.geometry.shape);
  EXPECT_EQ(code.geometry.corners, file.geometry.corners);
  EXPECT_EQ(code.geometry.subdivisions, file.geometry.subdivisions);
  EXPECT_EQ(code.materials[0].young, file.materials[0].young);
  EXPECT_EQ(code.materials[0].poisson, file.materials[0].poisson);
  EXPECT_EQ(code.materials[0].plane, file.materials[0].plane);
  for (unsigned int b = 0; b < 4; ++b)
  {
    EXPECT_EQ(code.boundaries[b].name, file.boundaries[b].name);
    EXPECT_EQ(code.boundaries[b].contact, file.boundaries[b].contact);
  }
}

// ---------------------------------------------------------------- the body

/** Its size is that of its longer diagonal, its sides know where they are, and inside is inside. */
TEST(Geometry, AnswersWhatStagesAsk)
{
  Geometry<2> body;
  body.corners =
      quadrilateral_corners({{Point<2>(0, 0), Point<2>(4, 0), Point<2>(3, 2), Point<2>(0, 2)}});
  EXPECT_EQ(body.diameter(), std::sqrt(20.));
  EXPECT_EQ(body.centre(), Point<2>(1.75, 1));
  EXPECT_EQ(body.radius(), Point<2>(4, 0).distance(body.centre()));
  for (const auto &[x, is_inside] :
       {std::pair(Point<2>(3.5, 1), true), {Point<2>(3.6, 1), false}, {Point<2>(-1e-9, 1), false}})
    EXPECT_EQ(body.contains(x), is_inside) << x;
  const std::vector<Side<2>> sides = sides_of(body);
  ASSERT_EQ(boundary_names(2).size(), sides.size());
  for (unsigned int b = 0; b < sides.size(); ++b)
  {
    const Point<2> x = sides[b].sample()[7];
    EXPECT_TRUE(body.contains(x));
    EXPECT_FALSE(body.contains(x + 1e-6 * sides[b].normal(x))) << boundary_names(2)[b];
    EXPECT_EQ(sides[b].tangent(x), (Tensor<1, 2>({-sides[b].normal(x)[1], sides[b].normal(x)[0]})));
    EXPECT_EQ(sides[b].axis, b == 0 || b == 1 ? 0U : 1U) << boundary_names(2)[b];
  }
}

// ---------------------------------------------------------------- words that no scene has

/** What a hint tells to write is there, and what it is about is not told twice. */
TEST(Hints, NameEntriesThatThereAre)
{
  for (const int dim : {2, 3})
  {
    std::vector<std::string> paths, words;
    UserNames names;
    names.pairs = {"joint"};
    names.sides = boundary_names(dim);
    for (const Entry &entry : scene_entries(dim, names))
      paths.push_back(entry.path());
    for (const Alias &hint : scene_aliases(dim, boundary_names(dim), {"inside"}))
    {
      if (hint.in.empty()) // else it is told before the others
        words.insert(words.end(), hint.words.begin(), hint.words.end());
      const std::regex quoted("\"([^\"]*)\"");
      for (std::sregex_iterator it(hint.remedy.begin(), hint.remedy.end(), quoted), end; it != end;
           ++it)
        EXPECT_EQ(std::count(paths.begin(), paths.end(), (*it)[1]), 1) << hint.remedy;
    }
    EXPECT_GT(words.size(), 50U);
    for (const std::string &word : words)
    {
      EXPECT_EQ(std::count(words.begin(), words.end(), word), 1) << word;
      EXPECT_EQ(lower_case(word), word);
    }
  }
}

// ---------------------------------------------------------------- several materials

/** Every stage asks for the material of its cell: a first one with the same mu is never seen. */
TEST(SceneByCode, MayNumberItsMaterialsAsItLikes)
{
  const auto scene = [](const bool second, const Overrides &overrides)
  {
    Scene<2> result = shipped_scene("han-6-12", overrides);
    if (second)
    {
      const Material unused{2 * result.materials[0].mu(), 0., PlaneModel::strain};
      result.materials.insert(result.materials.begin(), unused);
      result.material_at = [](const Point<2> &) { return 1; };
    }
    return result;
  };
  const Overrides fine = {{"Adaptivity/Maximum steps", "4"},
                          {"Output/Reference solution", "true"},
                          {"Output/VTU", "false"}}; // which has an array of materials
  const Record one = record(scene(false, fine)), other = record(scene(true, fine));
  expect_same(one, other);

  const auto file = std::filesystem::path(::testing::TempDir()) /
                    ("hpvi-reference-" + std::to_string(std::random_device()()));
  std::ofstream(file, std::ios::binary) << one.files.at("reference.dat");
  const Overrides coarse = {{"Adaptivity/Maximum steps", "2"},
                            {"Error/Reference solution", file.string()},
                            {"Output/VTU", "false"}};
  expect_same(record(scene(false, coarse)), record(scene(true, coarse)));
  std::filesystem::remove(file);
}

/** A cantilever of two layers takes the materials where material_at says. */
TEST(SceneByCode, PutsMaterialsWhereItSays)
{
  Scene<2> scene;
  scene.geometry.subdivisions = {{4, 2}};
  scene.geometry.graded_towards = {Point<2>(0, 0)};
  scene.geometry.grading_levels = 3;
  scene.materials = {{1., 0.3, PlaneModel::strain}, {50., 0.2, PlaneModel::strain}};
  scene.material_at = [](const Point<2> &x) { return x[1] < 0.5 ? 0 : 1; };
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  EXPECT_GT(mesh.n_active_cells(), 8U);
  for (const auto &cell : mesh.active_cell_iterators())
    EXPECT_EQ(&scene.material_of(cell), &scene.materials[cell->center()[1] < 0.5 ? 0 : 1]);

  scene.material_at = [](const Point<2> &) { return 2; };
  Triangulation<2> other;
  EXPECT_THROW(make_mesh(scene, other), InputError);
}

// ---------------------------------------------------------------- wrong scenes

// What files may have wrong, too, is in tests/bad_input: here is what only code can do, and a row of each check.

struct Mistake
{
  std::string words; ///< how the message goes on after "scene: "
  std::function<void(Scene<2> &)> make;
};

using WrongScene = ::testing::TestWithParam<Mistake>;

TEST_P(WrongScene, IsRefused)
{
  Scene<2> scene = pushed_block();
  ASSERT_NO_THROW(check(scene));
  const std::string message = failure_of<InputError>(
      [&]
      {
        GetParam().make(scene);
        check(scene);
      });
  EXPECT_EQ(message.rfind("scene: " + GetParam().words, 0), 0U) << message;
  EXPECT_FALSE(says(message, "\n"));
  EXPECT_TRUE(says(message, "; ")) << "no remedy: " << message;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Material, WrongScene,
    ::testing::Values(
        Mistake{"Material/Young's modulus = -15: is not accepted here; give a number E > 0",
                [](Scene<2> &s) { s.materials[0].young = -15; }},
        Mistake{"Material/Young's modulus = 0: is not accepted here",
                [](Scene<2> &s)
                {
                  s.materials.push_back({0., 0.3, PlaneModel::strain});
                  s.material_at = [](const Point<2> &) { return 0; };
                }},
        Mistake{"Material: is missing", [](Scene<2> &s) { s.materials.clear(); }},
        Mistake{"Material: says nowhere which of 2 is where; set material_at",
                [](Scene<2> &s) { s.materials.resize(2); }}));

INSTANTIATE_TEST_SUITE_P(
    Geometry, WrongScene,
    ::testing::Values(
        Mistake{"Geometry/Upper corner = (4, 0): is not above and right of the lower corner (0, 4)",
                [](Scene<2> &s)
                { s.geometry.corners = box_corners(Point<2>(0, 4), Point<2>(4, 0)); }},
        Mistake{"Geometry/Upper corner = (nan, 4): is not above",
                [](Scene<2> &s) { s.geometry.corners[3][0] = nan; }},
        Mistake{"Geometry/Shape = box: has corners that are not those of a box",
                [](Scene<2> &s) { s.geometry.corners[1][1] = 0.1; }},
        Mistake{"Geometry/Corners: is degenerate, clockwise or not convex at (1, 1)",
                [](Scene<2> &s)
                {
                  s.geometry.shape = Shape::quadrilateral;
                  s.geometry.corners = quadrilateral_corners(
                      {{Point<2>(0, 0), Point<2>(4, 0), Point<2>(1, 1), Point<2>(0, 4)}});
                }},
        Mistake{"Geometry/Upper corner: has lengths from 1e-200 to 1e-200", [](Scene<2> &s)
                { s.geometry.corners = box_corners(Point<2>(), Point<2>(1e-200, 1e-200)); }},
        Mistake{"Geometry/Subdivisions = 4, 0: makes no cells",
                [](Scene<2> &s) { s.geometry.subdivisions[1] = 0; }},
        Mistake{"Geometry/Grading levels: has no point to grade to",
                [](Scene<2> &s) { s.geometry.grading_levels = 2; }},
        Mistake{"Geometry/Grading levels = 41: is not accepted here", [](Scene<2> &s)
                {
                  s.geometry.graded_towards = {Point<2>(0, 0)};
                  s.geometry.grading_levels = 41;
                }}));

INSTANTIATE_TEST_SUITE_P(
    Boundary, WrongScene,
    ::testing::Values(
        Mistake{"Boundary botom: there is none of this name; give left, right, bottom, top",
                [](Scene<2> &s) { s.boundary("botom").contact = Contact::bilateral; }},
        Mistake{"Boundary: has 3 instead of 4", [](Scene<2> &s) { s.boundaries.pop_back(); }},
        Mistake{"Boundary left: has the id 1 and stands at 0",
                [](Scene<2> &s) { s.boundary("left").id = 1; }},
        Mistake{"Boundary right/Traction: acts on the component x that Displacement prescribes",
                [](Scene<2> &s) { s.boundary("right").traction[0] = expression<2>(1.); }},
        Mistake{"Boundary left, right, bottom, top/Displacement: the supports leave a rigid-body "
                "motion free, translation in x, and no friction resists it",
                [](Scene<2> &s)
                {
                  s.boundary("right").displacement = {};
                  s.boundary("bottom").friction = {};
                }}));

/** @p make after the bottom may open. */
Mistake unilateral(const std::string &words, const std::function<void(Scene<2> &)> &make)
{
  return {words, [make](Scene<2> &s)
          {
            s.boundary("bottom").contact = Contact::unilateral;
            check(s);
            make(s);
          }};
}

/** u_0 at the bottom. */
Mistake gap(const std::string &words, const std::function<double(const Point<2> &)> &u_0)
{
  return unilateral(words, [u_0](Scene<2> &s) { s.boundary("bottom").gap = expression<2>(u_0); });
}

INSTANTIATE_TEST_SUITE_P(
    Gap, WrongScene,
    ::testing::Values(
        Mistake{"Boundary bottom/Gap: needs contact that can open; set Contact = unilateral",
                [](Scene<2> &s) { s.boundary("bottom").gap = expression<2>(0.); }},
        gap("Boundary right/Displacement: contradicts Boundary bottom/Gap at their corner (4, 0), "
            "for u_n exceeds the gap by 0.25",
            [](const Point<2> &x) { return (3.5 - x[0]) / 2; })));

INSTANTIATE_TEST_SUITE_P(
    Method, WrongScene,
    ::testing::Values(
        Mistake{"Adaptivity/Start degree = 0: is no degree",
                [](Scene<2> &s) { s.adaptivity.start_degree = 0; }},
        Mistake{
            "Adaptivity/Maximum degree = 21: is not accepted here; give an integer from 1 to 20",
            [](Scene<2> &s) { s.adaptivity.maximum_degree = 21; }},
        Mistake{"Adaptivity/hap threshold = 0: is not accepted here",
                [](Scene<2> &s) { s.adaptivity.hap_threshold = 0; }}));

INSTANTIATE_TEST_SUITE_P(
    Errors, WrongScene,
    ::testing::Values(
        Mistake{"Output/Reference solution: compares the entries of two files",
                [](Scene<2> &s) { s.output.reference = true; }},
        Mistake{"Error/Reference solution: compares the entries of two files",
                [](Scene<2> &s) { s.reference_solution = "reference.dat"; }},
        Mistake{
            "Boundary left/Traction: contradicts Exact solution/Solution at (0, 0); write exact",
            [](Scene<2> &s)
            { s.exact_solution = std::make_shared<StickSlip>(s.materials[0], 4.5, 2., 1.); }}));

// ---------------------------------------------------------------- contact that opens

/** What of a scene the entries of unilateral contact set. */
TEST(SceneByCode, HasGapsAsFromAFile)
{
  Scene<2> code = pushed_block();
  BoundaryCondition<2> &bottom = code.boundary("bottom");
  bottom.contact = Contact::unilateral;
  bottom.gap = expression<2>([](const Point<2> &x) { return x[0] <= 1 ? -0.25 : 0.5 * x[0]; });
  code.solver.normal_contact = NormalContact::multiplier;
  EXPECT_NO_THROW(check(code));
  const Scene<2> file = shipped_scene("han-6-12", {{"Boundary bottom/Contact", "unilateral"},
                                                   {"Boundary bottom/Gap", "if(x<=1,-0.25,0.5*x)"},
                                                   {"Solver/Normal contact", "multiplier"}});
  EXPECT_EQ(file.boundaries[2].contact, bottom.contact);
  EXPECT_EQ(file.solver.normal_contact, code.solver.normal_contact);
  for (const double x : {0., 0.3, 1., 1.1, 4.})
    EXPECT_EQ(file.boundaries[2].gap_at(Point<2>(x, 0)), bottom.gap_at(Point<2>(x, 0)));
  EXPECT_TRUE(file.has_unilateral_contact());
}

TEST(SceneByCode, HasNoGapUnlessItSaysSo)
{
  for (const std::string u_0 : {"", "0", "0.0"})
  {
    const Scene<2> scene = shipped_scene(
        "han-6-12", {{"Boundary bottom/Contact", "unilateral"}, {"Boundary bottom/Gap", u_0}});
    EXPECT_EQ(scene.boundaries[2].gap, nullptr) << u_0;
    EXPECT_EQ(scene.boundaries[2].gap_at(Point<2>(1, 0)), 0.);
    EXPECT_EQ(scene.solver.normal_contact, NormalContact::nodes);
  }
  EXPECT_EQ(shipped_scene("partial-slip").boundaries[2].contact, Contact::tangential);
}

/** What `automatic` is taken for, and that scene.prm repeats it. */
TEST(NormalContactOf, AScene)
{
  using Kind = NormalContact;
  const Overrides opens = {{"Boundary bottom/Contact", "unilateral"}},
                  coulomb = {{"Boundary bottom/Contact", "unilateral"}, given::coulomb("0.3")},
                  primal = {{"Boundary bottom/Contact", "unilateral"},
                            {"Solver/Path", "primal"},
                            {"Adaptivity/Method", "hap2"}},
                  named = {{"Boundary bottom/Contact", "unilateral"},
                           {"Solver/Normal contact", "multiplier"}};
  for (const auto &[overrides, kind] :
       {std::pair(opens, Kind::nodes), std::pair(coulomb, Kind::multiplier),
        std::pair(primal, Kind::multiplier), std::pair(named, Kind::multiplier)})
  {
    const Scene<2> scene = shipped_scene("han-6-12", overrides);
    EXPECT_EQ(scene.normal_contact(), kind);
    const std::regex line(std::string("set Normal contact += ") +
                          (kind == Kind::nodes ? "nodes" : "multiplier"));
    EXPECT_TRUE(std::regex_search(effective_parameters(scene), line));
  }
  Scene<2> code = pushed_block();
  BoundaryCondition<2> &bottom = code.boundary("bottom");
  bottom.contact = Contact::unilateral;
  EXPECT_EQ(code.normal_contact(), Kind::nodes);
  bottom.friction = {nullptr, expression<2>(0.3)};
  EXPECT_EQ(code.normal_contact(), Kind::multiplier);
  EXPECT_NO_THROW(check(code));
  code.solver.normal_contact = Kind::nodes;
  EXPECT_THROW(check(code), InputError);
  EXPECT_EQ(Scene<3>().normal_contact(), Kind::multiplier);
}

/** A corner may lie on the obstacle, lift from it, or be of two edges that both may open. */
TEST(SceneByCode, MayMeetItsGapAtACorner)
{
  Scene<2> scene = pushed_block();
  scene.boundary("bottom").contact = Contact::unilateral;
  for (const double u_y : {0., 0.1})
  {
    scene.boundary("right").displacement[1] = expression<2>(u_y);
    EXPECT_NO_THROW(check(scene));
  }
  scene.boundary("right").displacement[1] = expression<2>(0.);
  scene.boundary("bottom").gap = // whose round-off is that of its values elsewhere
      expression<2>([](const Point<2> &x) { return 0.1 * (4 - x[0]) - 1e-13; });
  EXPECT_NO_THROW(check(scene));
  scene.boundary("right").displacement[1] = expression<2>(-0.1); // u_n = 0.1 = u_0 by round-off
  scene.boundary("bottom").gap = expression<2>(0.1 - 1e-13);
  EXPECT_NO_THROW(check(scene));
  scene.boundary("bottom").gap = expression<2>(0.1 - 1e-8);
  EXPECT_THROW(check(scene), InputError);
  scene.boundary("bottom").gap = expression<2>(-1.);
  scene.boundary("right").displacement[1] = nullptr;
  EXPECT_NO_THROW(check(scene));
  scene.boundary("top").contact = Contact::unilateral;
  for (const Contact contact : {Contact::unilateral, Contact::bilateral})
  {
    scene.boundary("left").traction = {};
    scene.boundary("left").contact = contact;
    EXPECT_NO_THROW(check(scene));
  }
}

/** Without a multiplier any degree will do. */
TEST(SceneByCode, MayStartAtDegreeOneWhereNodesTouch)
{
  Scene<2> scene = pushed_block();
  scene.boundary("bottom").contact = Contact::unilateral;
  scene.boundary("bottom").friction = {};
  scene.adaptivity.start_degree = 1;
  EXPECT_NO_THROW(check(scene));
  scene.solver.multiplier_offset = 0;
  EXPECT_NO_THROW(check(scene));
  scene.boundary("bottom").friction.bound = expression<2>(1.);
  EXPECT_THROW(check(scene), InputError);
}

/** Contact that opens holds a body up and against turning; it resists no motion along itself. */
TEST(SceneByCode, LeavesMotionsToContact)
{
  Scene<2> scene;
  scene.body_force[1] = expression<2>(-1.);
  BoundaryCondition<2> &bottom = scene.boundary("bottom");
  bottom.contact = Contact::unilateral;
  EXPECT_NO_THROW(check(scene)); // nothing pushes it along: its place is not unique
  bottom.friction.bound = expression<2>(1.);
  EXPECT_NO_THROW(check(scene));
  EXPECT_EQ(scene.free_motions().size(), 3U);
  scene.boundary("left").displacement[0] = expression<2>(0.);
  bottom.friction = {};
  EXPECT_NO_THROW(check(scene));
  const auto motions = scene.free_motions();
  ASSERT_EQ(motions.size(), 1U);
  EXPECT_EQ(motions[0].at(Point<2>(1, 1)), (Tensor<1, 2>({0., 1.})));
  EXPECT_EQ(shipped_scene("resting").free_motions().size(), 3U);
  EXPECT_EQ(shipped_scene("receding").free_motions().size(), 1U);
  EXPECT_EQ(shipped_scene("punch").free_motions().size(), 0U);
}

/** Closed forms that are not those of the scene. */
TEST(SceneByCode, IsComparedWithHertzsContact)
{
  const auto message = [](const std::string &name, const std::function<void(Scene<2> &)> &make)
  {
    Scene<2> scene = shipped_scene(name);
    scene.parameters = nullptr;
    check(scene);
    make(scene);
    return failure_of<InputError>([&] { check(scene); });
  };
  const auto bottom = [](Scene<2> &s) -> BoundaryCondition<2> & { return s.boundary("bottom"); };
  const auto starts = [](const std::string &text, const std::string &words)
  { EXPECT_EQ(text.rfind(words, 0), 0U) << text; };
  starts(message("hertz",
                 [&](Scene<2> &s) {
                   bottom(s).gap =
                       expression<2>([](const Point<2> &x) { return x[0] * x[0] > 3 ? 1 : 0.; });
                 }),
         "hertz: Boundary bottom/Gap: contradicts Exact solution/Solution at (-1.625, 0)");
  starts(message("hertz",
                 [&](Scene<2> &s) {
                   bottom(s).gap =
                       expression<2>([](const Point<2> &x) { return 0.0456 * x[0] * x[0]; });
                 }),
         "hertz: Boundary bottom/Gap: contradicts Exact solution/Solution at (-0.625, 0)");
  starts(message("hertz", [&](Scene<2> &s) { bottom(s).traction[1] = expression<2>(-1.); }),
         "hertz: Boundary bottom/Traction: contradicts Exact solution/Solution at (-2, 0)");
  starts(message("hertz", [&](Scene<2> &s) { bottom(s).traction[0] = expression<2>(-1.); }),
         "hertz: Boundary bottom/Traction: contradicts Exact solution/Solution at (-2, 0)");
  starts(message("hertz", [&](Scene<2> &s) { bottom(s).friction.bound = expression<2>(1.); }),
         "hertz: Boundary bottom/Friction bound: contradicts Exact solution/Solution at (-2, 0)");
  starts(message("stick-slip", [&](Scene<2> &s) { bottom(s).contact = Contact::tangential; }),
         "stick-slip: Boundary bottom/Contact: contradicts Exact solution/Solution at (-1, 0)");
}

/** The constant is measured where no run can succeed. */
TEST(SceneByCode, MayHaveTooManyMultipliersToMeasureThem)
{
  Scene<2> scene = pushed_block();
  scene.solver.multiplier_offset = 0;
  EXPECT_NO_THROW(check(scene, SceneUse::measure));
  EXPECT_THROW(AdaptiveSolver<2>{scene}, InputError);
}
/** Between the points where check() looks, at a Gauss point of the multiplier. */
TEST(SceneByCode, IsRefusedWhereItsBoundIsNegative)
{
  Scene<2> scene = pushed_block();
  const double gauss_point = 0.5 - 0.5 / std::sqrt(3.);
  for (const double wrong : {-1., std::numeric_limits<double>::quiet_NaN()})
  {
    scene.boundary("bottom").friction.bound = expression<2>(
        [=](const Point<2> &x) { return std::abs(x[0] - gauss_point) < 1e-9 ? wrong : 4.5; });
    ASSERT_NO_THROW(check(scene));
    const std::string message = failure_of<InputError>([&] { failure_of(scene); });
    EXPECT_EQ(message.rfind("Boundary bottom/Friction bound: is ", 0), 0U) << message;
  }
}
} // namespace
