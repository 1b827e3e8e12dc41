// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries of scenes that plane and space have in common: a slab of one layer in plane strain has the results of the plane.
#include "runs.h"

#include <hpvi/driver/load_history.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

namespace
{
using namespace space;

/** Results of a step by what they are and where, per unit of thickness. */
using Results = std::map<std::string, std::map<std::string, double>>;

double about_z(const double moment)
{
  return moment;
}

double about_z(const Tensor<1, 3> &moment)
{
  return moment[2];
}

template <int dim>
Results results(const StepReport<dim> &step, const double thickness)
{
  Results found;
  found["energy"] = {{"lagrangian", step.energies.lagrangian / thickness},
                     {"square of the norm", std::pow(step.energies.norm, 2) / thickness},
                     {"work", step.load.work / thickness},
                     {"stored", step.load.stored / thickness},
                     {"dissipated", step.load.dissipated / thickness}};
  found["energy with all of friction"]["J"] = step.energies.energy / thickness;
  found["indicator"]["all"] = step.norms.total / std::sqrt(thickness);
  for (const StressSample<dim> &sample : step.extrema)
    if (sample.boundary == numbers::invalid_boundary_id)
      found["stress"]["von Mises"] = std::max(found["stress"]["von Mises"], sample.value);
  for (const ProbeValue<dim> &probe : step.probes)
  {
    const std::string &name = step.scene.probes[probe.probe].name;
    for (unsigned int c = 0; c < 2; ++c)
      found["displacement"][name + std::to_string(c)] = probe.displacement[c].value;
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int d = c; d < 3; ++d)
        found["stress"][name + std::to_string(c) + std::to_string(d)] = probe.stress[c][d];
  }
  const TrueErrors &errors = step.errors;
  for (const auto &[name, value, power] :
       {std::make_tuple("energy", errors.energy, 0.5),
        std::make_tuple("norm", errors.energy_norm, 0.5),
        std::make_tuple("J", errors.reference_energy, 1.), std::make_tuple("L2", errors.l2, 0.5),
        std::make_tuple("friction", errors.multiplier_l2, 0.5),
        std::make_tuple("pressure", errors.pressure_l2, 0.5)})
    if (!std::isnan(value))
      found["true error"][name] = value / std::pow(thickness, power);
  for (const PlateState<dim> &plate : step.equilibrium.plates)
    found["plate"] = {{"U0", plate.displacement[0]},
                      {"U1", plate.displacement[1]},
                      {"phi", about_z(plate.rotation)},
                      {"M", about_z(plate.moment) / thickness}};
  for (const Resultant<dim> &force : step.forces)
    for (unsigned int c = 0; c < 2; ++c)
      found["force"][force.name + std::to_string(c)] += force.force[c].value / thickness;
  return found;
}

template <int dim>
std::vector<Results> all_results(const Scene<dim> &scene, const double thickness)
{
  std::vector<Results> found;
  LoadHistory<dim>(scene).run([&](const StepReport<dim> &step)
                              { found.push_back(results(step, thickness)); });
  return found;
}

/** Entries that both have, then those that they say in their own words; a block that its right side holds. */
struct Row
{
  const char *name;
  Overrides both, plane, space;
};

std::ostream &operator<<(std::ostream &out, const Row &row)
{
  return out << row.name;
}

constexpr double depth = 0.75;

Scene<2> in_plane(const Row &row)
{
  return read_scene<2>("prm/han-6-12.prm", joined({{{"Units/Length", ""},
                                                    {"Units/Stress", ""},
                                                    {"Material/Plane", "strain"},
                                                    given::box("4, 4", "2, 2"),
                                                    given::steps("hup2", "2"),
                                                    {"Solver/Normal contact", "multiplier"},
                                                    {"Boundary left/Traction", ""},
                                                    {"Boundary bottom/Contact", "none"},
                                                    {"Boundary bottom/Friction bound", ""},
                                                    {"Probe inside/At", "1.3, 2.7"},
                                                    {"Probe corner/At", "4, 0"}},
                                                   row.both,
                                                   row.plane}));
}

Scene<3> in_space(const Row &row)
{
  return slab(joined({{given::box("4, 4, 0.75", "2, 2, 1"),
                       given::steps("hup2", "2"),
                       {"Boundary left/Traction", ""},
                       {"Boundary bottom/Contact", "none"},
                       {"Boundary bottom/Friction bound", ""},
                       {"Boundary front/Symmetry", "true"},
                       {"Boundary back/Symmetry", "true"},
                       {"Solver/Primal tolerance", "1e-12"},
                       {"Probe inside/At", "1.3, 2.7, 0.4"},
                       {"Probe corner/At", "4, 0, 0.1"}},
                      row.both,
                      row.space}));
}

using PlaneEntries = ::testing::TestWithParam<Row>;

TEST_P(PlaneEntries, HaveTheResultsOfPlaneStrain)
{
  const auto flat = all_results<2>(in_plane(GetParam()), 1.),
             thick = all_results<3>(in_space(GetParam()), depth);
  ASSERT_EQ(flat.size(), thick.size());
  for (unsigned int k = 0; k < flat.size(); ++k)
    for (const auto &[kind, values] : flat[k])
    {
      double scale = kind == "force" ? 0.1 : 1e-12; // forces may balance each other
      for (const auto &[name, value] : values)
        scale = std::max(scale, std::abs(value));
      // Second derivatives lose digits, and friction is integrated at other points.
      const double tolerance = kind == "indicator"                     ? 1e-6
                               : kind == "energy with all of friction" ? 1e-7
                                                                       : 1e-8;
      for (const auto &[name, value] : values)
      {
        ASSERT_TRUE(thick[k].count(kind) && thick[k].at(kind).count(name)) << kind << " " << name;
        EXPECT_NEAR(thick[k].at(kind).at(name), value, tolerance * scale)
            << kind << " " << name << ", step " << k + 1;
      }
    }
}

Overrides heated(const std::string &temperature, const Overrides &more = {})
{
  return Overrides{{"Material/Thermal expansion", "0.002"},
                   {"Temperature/Expression", temperature}} +
         more;
}

/** On the bottom, in load steps. */
Overrides rough_bottom(const Overrides &more = {})
{
  return Overrides{{"Boundary bottom/Contact", "unilateral"},
                   {"Boundary bottom/Friction coefficient", "0.3"},
                   {"Loading/Steps", "3"},
                   {"Adaptivity/Maximum steps", "1"}} +
         more;
}

const Overrides pushed_in_plane{{"Boundary left/Traction", "0.4; -0.2"}},
    pushed_in_space{{"Boundary left/Traction", "0.4; -0.2; 0"}};

INSTANTIATE_TEST_SUITE_P(
    InitialStrain, PlaneEntries,
    ::testing::Values(
        Row{"constant",
            {},
            {{"Material/Initial strain", "0.01; -0.005; 0.003; 0.004"}},
            {{"Material/Initial strain", "0.01; -0.005; 0.004; 0.003; 0; 0"}}},
        Row{"varies",
            {},
            {{"Material/Initial strain", "0.01*x*y; 0.02*y - 0.01*x; 0.004*x^2; 0.01*x"}},
            {{"Material/Initial strain", "0.01*x*y; 0.02*y - 0.01*x; 0.01*x; 0.004*x^2; 0; 0"}}},
        Row{"heat", heated("10 + 3*x*y - y^2"), {}, {}},
        Row{"heat_and_load", heated("10 + x"), pushed_in_plane, pushed_in_space},
        Row{"both_factorised",
            heated("10 - x^2", {{"Solver/Linear", "direct"}}),
            {{"Material/Initial strain", "0.01*y; 0; 0.01"}},
            {{"Material/Initial strain", "0.01*y; 0; 0; 0.01; 0; 0"}}},
        Row{"algebraic_multigrid", heated("10 - x^2"), {}, {{"Solver/Linear", "amg"}}},
        Row{"materials",
            heated("10 + y*x", {{"Material stiff/Where", "y - 2"},
                                {"Material stiff/Young's modulus", "1500"},
                                {"Material stiff/Thermal expansion", "0.001"}}),
            {{"Material stiff/Initial strain", "0.01; 0; 0; -0.02"}},
            {{"Material stiff/Initial strain", "0.01; 0; -0.02; 0; 0; 0"}}},
        Row{"one_material_of_two",
            {{"Material hot/Where", "2 - x"},
             {"Material hot/Thermal expansion", "0.001"},
             {"Temperature/Expression", "20"}},
            pushed_in_plane,
            pushed_in_space},
        Row{"jump_between_cells", heated("if(x > 2, 20, y)"), {}, {}},
        Row{"history", rough_bottom(heated("20*(t - t^2/2)*(1 + x/4)")), {}, {}},
        Row{"history_with_friction",
            rough_bottom(heated("20*t")),
            {{"Boundary top/Traction", "0.3*t; -0.5"}},
            {{"Boundary top/Traction", "0.3*t; -0.5; 0"}}}),
    [](const auto &info) { return std::string(info.param.name); });

/** Glued to a foundation at the bottom, below a load. */
Overrides on_springs(const std::string &stiffness, const Overrides &more = {})
{
  return Overrides{{"Boundary bottom/Spring", stiffness}} + more;
}

const Overrides without_support{{"Boundary right/Displacement", ""}};

INSTANTIATE_TEST_SUITE_P(
    Springs, PlaneEntries,
    ::testing::Values(
        Row{"hold_the_body", on_springs("2; 3", without_support), pushed_in_plane, pushed_in_space},
        Row{"along_the_normal", on_springs("5; 0"), pushed_in_plane, pushed_in_space},
        Row{"vary", on_springs("2 + x^2; 1 + x", without_support), pushed_in_plane,
            pushed_in_space},
        Row{"stiff", on_springs("1e6; 1e5", without_support), pushed_in_plane, pushed_in_space},
        Row{"factorised", on_springs("2; 3", {without_support, {"Solver/Linear", "direct"}}),
            pushed_in_plane, pushed_in_space},
        Row{"algebraic_multigrid",
            on_springs("2; 3", without_support),
            pushed_in_plane,
            {pushed_in_space, {"Solver/Linear", "amg"}}},
        Row{"beside_a_load",
            {},
            {{"Boundary left/Traction", "0.4; -0.2"}, {"Boundary left/Spring", "3; 1"}},
            {{"Boundary left/Traction", "0.4; -0.2; 0"}, {"Boundary left/Spring", "3; 1"}}},
        Row{"beside_a_displacement",
            {},
            {{"Boundary left/Displacement", "0.1; free"}, {"Boundary left/Spring", "3; 1"}},
            {{"Boundary left/Displacement", "0.1; free; free"}, {"Boundary left/Spring", "3; 1"}}},
        Row{"on_hot_materials",
            on_springs("2; 3", {without_support,
                                heated("10 + x", {{"Material stiff/Where", "y - 2"},
                                                  {"Material stiff/Young's modulus", "1500"}})}),
            {},
            {}},
        Row{"beside_contact",
            {{"Boundary bottom/Contact", "unilateral"},
             {"Boundary bottom/Friction coefficient", "0.3"},
             {"Boundary left/Spring", "1; 2"},
             {"Adaptivity/Maximum steps", "1"},
             {"Boundary right/Displacement", ""}},
            {{"Boundary top/Traction", "0.1; -0.5"}},
            {{"Boundary top/Traction", "0.1; -0.5; 0"}}},
        Row{"history",
            rough_bottom({{"Boundary left/Spring", "1; 2"}, {"Boundary right/Spring", "x; 1"}}),
            {{"Boundary right/Displacement", "0.1*t; free"}, {"Boundary top/Traction", "0; -0.5"}},
            {{"Boundary right/Displacement", "0.1*t; free; free"},
             {"Boundary top/Traction", "0; -0.5; 0"}}}),
    [](const auto &info) { return std::string(info.param.name); });

/** An entry of a plate; forces of space are those of its depth. */
struct Said
{
  std::string entry, in_plane, in_space;
};

Row with_plate(const char *const name, const std::vector<Said> &entries, const Overrides &both = {},
               const std::string &boundary = "left")
{
  const std::string section = "Boundary " + boundary + "/";
  Row row{name, both + Overrides{{section + "Rigid", "true"}}, {}, {}};
  bool is_held = false, is_turned = false;
  for (const auto &[entry, in_plane, in_space] : entries)
  {
    row.plane.emplace_back(section + entry, in_plane);
    row.space.emplace_back(section + entry, in_space);
    is_held = is_held || entry == "Displacement";
    is_turned = is_turned || entry == "Rotation";
  }
  if (!is_held)
    row.space.emplace_back(section + "Displacement", "free; free; 0");
  if (!is_turned)
    row.space.emplace_back(section + "Rotation", "0; 0; free");
  return row;
}

INSTANTIATE_TEST_SUITE_P(
    Plates, PlaneEntries,
    ::testing::Values(
        with_plate("force", {{"Force", "1.6; -0.8", "1.2; -0.6; free"}}),
        with_plate("force_and_moment",
                   {{"Force", "1.6; -0.8", "1.2; -0.6; free"}, {"Moment", "2", "free; free; 1.5"}}),
        with_plate("moment", {{"Moment", "2", "free; free; 1.5"}}),
        with_plate("rotation", {{"Rotation", "0.01", "0; 0; 0.01"}}),
        with_plate("displacement_beside_force", {{"Displacement", "0.1; free", "0.1; free; 0"},
                                                 {"Force", "free; -0.8", "free; -0.6; free"}}),
        with_plate("on_a_part",
                   {{"Force", "1.6; -0.8", "1.2; -0.6; free"}, {"Moment", "2", "free; free; 1.5"}},
                   {{"Boundary jaw/On", "left"}, {"Boundary jaw/Where", "y - 2"}}, "jaw"),
        with_plate("factorised", {{"Force", "1.6; -0.8", "1.2; -0.6; free"}},
                   {{"Solver/Linear", "direct"}}),
        with_plate("on_a_hot_body", {{"Force", "1.6; -0.8", "1.2; -0.6; free"}},
                   heated("10 + 3*x*y - y^2")),
        with_plate("above_contact", {{"Force", "0.4; -8", "0.3; -6; free"}},
                   {{"Boundary bottom/Contact", "unilateral"},
                    {"Boundary bottom/Friction coefficient", "0.3"},
                    {"Boundary right/Displacement", ""},
                    {"Boundary left/Spring", "1; 2"},
                    {"Adaptivity/Maximum steps", "1"}},
                   "top"),
        with_plate("history_of_a_force",
                   {{"Force", "0.4*t; -8*t", "0.3*t; -6*t; free"},
                    {"Moment", "t", "free; free; 0.75*t"}},
                   rough_bottom({{"Boundary bottom/Friction coefficient", ""},
                                 {"Boundary right/Displacement", ""},
                                 {"Boundary left/Spring", "1; 2"}}),
                   "top"),
        with_plate("history_of_a_motion",
                   {{"Displacement", "free; -0.1*t", "free; -0.1*t; 0"},
                    {"Rotation", "0.01*t", "0; 0; 0.01*t"},
                    {"Force", "t; free", "0.75*t; free; free"}},
                   rough_bottom({{"Boundary right/Displacement", ""},
                                 {"Boundary left/Spring", "1; 2"}}),
                   "top")),
    [](const auto &info) { return std::string(info.param.name); });

/** A body on y = 0 with a closed form, in plane strain, which its other sides follow. */
Row in_closed_form(const char *const name, const Overrides &entries, const Overrides &plane = {})
{
  const Overrides both{{"Boundary left/Displacement", "exact"},
                       {"Boundary right/Displacement", "exact"},
                       {"Boundary top/Displacement", "exact"},
                       {"Material/Poisson's ratio", "0.3"}};
  return {name,
          both + entries,
          Overrides{{"Geometry/Lower corner", "-2, 0"},
                    given::box("2, 2", "4, 2"),
                    {"Probe inside/At", "0.3, 0.7"},
                    {"Probe corner/At", "2, 0"}} +
              plane,
          {{"Geometry/Lower corner", "-2, 0, 0"},
           given::box("2, 2, 0.75", "4, 2, 1"),
           {"Boundary front/Symmetry", "false"},
           {"Boundary back/Symmetry", "false"},
           {"Boundary front/Displacement", "free; free; 0"},
           {"Boundary back/Displacement", "free; free; exact"},
           {"Probe inside/At", "0.3, 0.7, 0.4"},
           {"Probe corner/At", "2, 0, 0.1"}}};
}

const Overrides stick_slip{{"Exact solution/Solution", "stick-slip"},
                           {"Material/Young's modulus", "1"},
                           {"Boundary bottom/Contact", "bilateral"},
                           {"Boundary bottom/Friction bound", "0.3"}};

INSTANTIATE_TEST_SUITE_P(
    ExactSolution, PlaneEntries,
    ::testing::Values(
        in_closed_form("stick_slip", stick_slip),
        in_closed_form("on_the_primal_path", stick_slip, {{"Solver/Path", "primal"}}),
        in_closed_form("smooth", stick_slip + Overrides{{"Exact solution/Solution", "smooth"},
                                                        {"Boundary bottom/Friction bound", "0.1"}}),
        in_closed_form("hertz", {{"Exact solution/Solution", "hertz"},
                                 {"Exact solution/Length", "0.7"},
                                 {"Exact solution/Pressure", "7"},
                                 {"Material/Young's modulus", "200"},
                                 {"Boundary bottom/Contact", "unilateral"},
                                 {"Boundary bottom/Gap", "0.0455*x^2"}})),
    [](const auto &info) { return std::string(info.param.name); });

/** A run on finer meshes of higher degree, in a file. */
template <int dim>
std::string stored(const Scene<dim> &scene, const std::string &name)
{
  const std::string file =
      (std::filesystem::temp_directory_path() / ("hpvi-plane-entries-" + name)).string();
  LoadHistory<dim>(scene).run(
      [&](const StepReport<dim> &step)
      {
        std::ofstream out(file, std::ios::binary);
        write_solution(out, step.field, step.energies.energy);
      });
  return file;
}

/** Both measured against finer solutions of their own. */
TEST(ReferenceSolution, IsThatOfThePlane)
{
  Row row{"reference",
          {{"Boundary bottom/Contact", "bilateral"}, {"Boundary bottom/Friction bound", "0.1"}},
          pushed_in_plane,
          pushed_in_space};
  for (const char *const path : {"reduced", "primal"})
  {
    row.plane = pushed_in_plane + Overrides{{"Solver/Path", path}};
    Row finer = row;
    finer.both = row.both + given::steps("hup3", "3");
    Scene<2> flat = in_plane(row);
    Scene<3> thick = in_space(row);
    flat.reference_solution = stored(in_plane(finer), "plane");
    thick.reference_solution = stored(in_space(finer), "space");
    const auto expected = all_results<2>(flat, 1.), found = all_results<3>(thick, depth);
    ASSERT_EQ(expected.size(), found.size());
    for (unsigned int k = 0; k < found.size(); ++k)
    {
      const auto &errors = expected[k].at("true error");
      ASSERT_EQ(errors.size(), 4u);
      EXPECT_GT(errors.at("energy"), 1e-2 * errors.at("norm"));
      for (const auto &[name, value] : errors)
        EXPECT_NEAR(found[k].at("true error").at(name), value,
                    1e-8 * std::max(std::abs(value), errors.at("norm")))
            << name;
    }
    std::filesystem::remove(flat.reference_solution);
    std::filesystem::remove(thick.reference_solution);
  }
}

/** Fibres at 30 degrees in planes of constant z; G13 and G23 are nobody's there. */
const Overrides wood{{"Material/Elasticity", "orthotropic"},
                     {"Material/Young's modulus", ""},
                     {"Material/Poisson's ratio", ""},
                     {"Material/Young's moduli", "2000, 100, 150"},
                     {"Material/Poisson's ratios", "0.3, 0.2, 0.25"}},
    wood_in_plane{{"Material/Shear moduli", "20"}, {"Material/Angle", "30"}},
    wood_in_space{{"Material/Shear moduli", "20, 40, 50"},
                  {"Material/Axes", "1.7320508075688772, 1, 0; 0, 3, 0"}};

Row of_wood(const char *const name, const Overrides &both, const Overrides &plane,
            const Overrides &space)
{
  return {name, wood + both, wood_in_plane + plane, wood_in_space + space};
}

INSTANTIATE_TEST_SUITE_P(
    Orthotropy, PlaneEntries,
    ::testing::Values(
        Row{"along_the_cells",
            wood,
            {pushed_in_plane, {"Material/Shear moduli", "20"}},
            {pushed_in_space, {"Material/Shear moduli", "20, 40, 50"}}},
        of_wood("askew", {}, pushed_in_plane, pushed_in_space),
        of_wood("factorised", {{"Solver/Linear", "direct"}}, pushed_in_plane, pushed_in_space),
        of_wood("algebraic_multigrid", {}, pushed_in_plane,
                {pushed_in_space, {"Solver/Linear", "amg"}}),
        of_wood("axis_3_in_the_plane",
                {{"Material/Young's moduli", "2000, 150, 100"},
                 {"Material/Poisson's ratios", "0.3, 0.3, 0.2"}},
                {pushed_in_plane,
                 {"Material/Young's moduli", "2000, 100, 150"},
                 {"Material/Poisson's ratios", "0.3, 0.3, 0.13333333333333333"}},
                {pushed_in_space,
                 {"Material/Shear moduli", "40, 20, 50"},
                 {"Material/Axes", "1.7320508075688772, 1, 0; 0, 0, -1"}}),
        of_wood("heat", heated("10 + 3*x*y - y^2"), pushed_in_plane, pushed_in_space),
        of_wood("initial_strain", {},
                {{"Material/Initial strain", "0.01*x*y; 0.02*y; 0.004*x^2; 0.01*x"}},
                {{"Material/Initial strain", "0.01*x*y; 0.02*y; 0.01*x; 0.004*x^2; 0; 0"}}),
        of_wood("beside_another_material",
                {{"Material steel/Where", "y - 2"},
                 {"Material steel/Elasticity", "isotropic"},
                 {"Material steel/Young's modulus", "1500"},
                 {"Material steel/Poisson's ratio", "0.3"}},
                pushed_in_plane, pushed_in_space),
        of_wood("history_with_friction", rough_bottom(heated("20*t")),
                {{"Boundary top/Traction", "0.3*t; -0.5"}},
                {{"Boundary top/Traction", "0.3*t; -0.5; 0"}})),
    [](const auto &info) { return std::string(info.param.name); });

/** An obstacle whose normal is not that of the bottom, at @p boundary. */
Row along_a_direction(const char *const name, const std::string &contact, const Overrides &both,
                      const std::string &boundary = "Boundary bottom")
{
  return {
      name,
      both + Overrides{{boundary + "/Contact", contact}, {"Adaptivity/Maximum steps", "1"}},
      {{"Boundary top/Traction", "0.1; -0.5"}, {boundary + "/Contact direction", "3; -4"}},
      {{"Boundary top/Traction", "0.1; -0.5; 0"}, {boundary + "/Contact direction", "3; -4; 0"}}};
}

const Overrides coulomb{{"Boundary bottom/Friction coefficient", "0.3"}};

INSTANTIATE_TEST_SUITE_P(
    ContactDirection, PlaneEntries,
    ::testing::Values(
        along_a_direction("smooth", "unilateral", {{"Boundary bottom/Gap", "0.0002*x"}}),
        along_a_direction("tresca", "unilateral", {{"Boundary bottom/Friction bound", "0.1"}}),
        along_a_direction("coulomb", "unilateral", coulomb),
        along_a_direction("factorised", "unilateral",
                          coulomb + Overrides{{"Solver/Linear", "direct"}}),
        along_a_direction("bilateral", "bilateral", coulomb),
        along_a_direction("tangential", "tangential", {{"Boundary bottom/Friction bound", "0.1"}}),
        along_a_direction("on_a_part", "unilateral",
                          {{"Boundary foot/On", "bottom"},
                           {"Boundary foot/Where", "x - 2"},
                           {"Boundary foot/Friction coefficient", "0.3"}},
                          "Boundary foot")),
    [](const auto &info) { return std::string(info.param.name); });

/** Hexahedra that are no boxes, of a body that nothing holds but what it would do by itself. */
Scene<3> free_foot(const Overrides &entries)
{
  return read_scene<3>("prm/foot.prm", joined({{{"Boundary bottom/Contact", "none"},
                                                {"Boundary bottom/Friction coefficient", ""},
                                                {"Boundary flank/Pressure", ""},
                                                {"Solver/Primal tolerance", "1e-12"},
                                                given::steps("hup2", "1"),
                                                {"Probe inside/At", "0.1, 0.3, 0.2"}},
                                               entries}));
}

/** All six components by their places: u = eps_0 x is without stress, and its energy is that of eps_0 over the body. */
TEST(InitialStrain, OfAllComponentsStrainsAFreeBodyWithoutStress)
{
  const Scene<3> scene = free_foot(
      {{"Material rubber/Initial strain", "0.01; -0.02; 0.03; 0.004; 0.005; -0.006"},
       {"Boundary top/Displacement", "0.01*x + 0.004*y + 0.005*z; 0.004*x - 0.02*y - 0.006*z; "
                                     "0.005*x - 0.006*y + 0.03*z"}});
  double stored = 1;
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                const auto &u = step.probes.at(0).displacement;
                EXPECT_NEAR(u[0].value, 0.0032, 1e-12);
                EXPECT_NEAR(u[1].value, -0.0068, 1e-12);
                EXPECT_NEAR(u[2].value, 0.0047, 1e-12);
                for (const StressSample<3> &sample : step.extrema)
                  EXPECT_LT(sample.value, 1e-11);
                EXPECT_LT(step.norms.total, 1e-9);
                stored = 0.5 * std::pow(step.energies.norm, 2) + step.primal->work_done().initial;
                EXPECT_NEAR(step.energies.lagrangian, -0.5 * std::pow(step.energies.norm, 2),
                            1e-12);
              });
  EXPECT_NEAR(stored, 0., 1e-12);
}

/** A temperature that is linear leaves a free body without stress: it bends, u of degree two. */
TEST(InitialStrain, LinearTemperaturesBendAFreeBodyWithoutStress)
{
  const Scene<3> scene =
      slab({given::box("4, 1, 1", "4, 1, 1"),
            {"Boundary left/Traction", ""},
            {"Boundary bottom/Contact", "none"},
            {"Boundary bottom/Friction bound", ""},
            {"Boundary right/Displacement", ""},
            {"Boundary front/Displacement", "0.001*(x*x/2 - y*y/2); 0.001*x*y; 0"},
            {"Material/Thermal expansion", "0.001"},
            {"Temperature/Expression", "x"},
            given::steps("hup2", "1")});
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                for (const StressSample<3> &sample : step.extrema)
                  EXPECT_LT(sample.value, 1e-10);
              });
}

/** Stress of heat alone, which acts as no load: supports balance each other, and tables name no other force. */
TEST(InitialStrain, IsNoForce)
{
  const Scene<3> scene = slab({{"Boundary left/Traction", ""},
                               {"Boundary left/Displacement", "0; free; free"},
                               {"Boundary bottom/Contact", "none"},
                               {"Boundary bottom/Friction bound", ""},
                               {"Material/Thermal expansion", "0.001"},
                               {"Temperature/Expression", "10 + y*z"},
                               given::steps("hap2", "2")});
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                EXPECT_LT(step.equilibrium.force_imbalance, 1e-9);
                EXPECT_LT(step.equilibrium.moment_imbalance, 1e-9);
                EXPECT_EQ(step.equilibrium.loads.force.norm(), 0.);
                ASSERT_EQ(step.forces.size(), 2u);
                EXPECT_NEAR(step.forces[0].force[0].value, -step.forces[1].force[0].value, 1e-8);
                EXPECT_GT(std::abs(step.forces[0].force[0].value), 0.1);
              });
}
} // namespace
