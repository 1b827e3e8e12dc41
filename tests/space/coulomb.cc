// SPDX-License-Identifier: LGPL-2.1-or-later
// Friction that follows the pressure, on the primal path: as the reduced path has it in the plane, and in space.
#include "reduced_path.h"

#include <hpvi/base/formatting.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/bound/coulomb_bound.h>
#include <hpvi/driver/load_history.h>
#include <hpvi/results/stored_solution.h>
#include <hpvi/space/box_bound_stages.h>
#include <hpvi/space/friction_coupling.h>
#include <hpvi/space/friction_iteration.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <random>

namespace
{
using namespace space;

/** Laws that know the pressure, each on a contact that has one. */
const std::vector<Overrides> laws{{given::coulomb("0.6")},
                                  {{"Boundary bottom/Friction bound", "0.4"},
                                   {"Boundary bottom/Friction coefficient", "0.2 + 0.1*x"},
                                   {"Boundary bottom/Friction law", "limited"}},
                                  {{"Boundary bottom/Friction bound", "0.2"},
                                   {"Boundary bottom/Friction coefficient", "0.3"},
                                   {"Boundary bottom/Friction law", "cohesive"}}};

Scene<2> plane(const Overrides &overrides)
{
  Scene<2> scene = read_scene<2>(
      "prm/han-6-12-unilateral.prm",
      with({{"Solver/Normal contact", "multiplier"}, given::steps("hap3", "3")}, overrides));
  scene.solver.primal_tolerance = 1e-12;
  return scene;
}

TEST(Coulomb, BothPathsAgreeInThePlane)
{
  for (const Overrides &law : laws) // the reduced path bisects edges with a kink of the limit, too
    for (const char *const contact : {"unilateral", "bilateral"})
      expect_reduced_path(
          plane(with(law, {{"Boundary bottom/Contact", contact}, given::steps("hup3", "2")})));
  for (const char *const method : {"hap2", "hap3", "hap4"})
    expect_reduced_path(plane(with(laws[0], {{"Adaptivity/Method", method}})));
}

/** prm/slab.prm under a law, as thick as one layer or in full. */
Scene<3> rubbing_slab(const Overrides &overrides)
{
  return slab(with({{"Boundary bottom/Contact", "unilateral"}, {"Adaptivity/Maximum steps", "2"}},
                   overrides));
}

/** Plane strain: a slab of one layer with u_z = 0 on both sides has its energy, and at first its indicator. */
TEST(Coulomb, SlabIsPlaneStrain)
{
  for (const Overrides &law : laws)
    for (const char *const contact : {"unilateral", "bilateral"})
    {
      const Overrides both = with(
          law, {{"Boundary bottom/Contact", contact},
                given::steps(&law == &laws[0] ? "hup3" : "hup2", &law == &laws[0] ? "1" : "2")});
      std::vector<std::array<double, 3>> flat;
      AdaptiveSolver<2>(plane(with(both, {{"Material/Plane", "strain"}})))
          .run(
              [&](const StepReport<2> &step) {
                flat.push_back(
                    {{step.energies.lagrangian, step.energies.energy, step.norms.total}});
              });
      const auto thick =
          steps_of<3>(rubbing_slab(with(both, {given::box("4, 4, 0.75", "4, 4, 1"),
                                               {"Boundary left/Traction", "1.5*(5 - y); -0.75; 0"},
                                               {"Boundary front/Displacement", "free; free; 0"},
                                               {"Boundary back/Displacement", "free; free; 0"}})));
      ASSERT_EQ(thick.size(), flat.size());
      for (unsigned int k = 0; k < flat.size(); ++k)
      {
        EXPECT_NEAR(thick[k].lagrangian / 0.75, flat[k][0], 1e-8 * std::abs(flat[k][0]));
        EXPECT_NEAR(thick[k].energy / 0.75, flat[k][1], 1e-6 * std::abs(flat[k][1]));
      }
      EXPECT_NEAR(thick[0].estimate / std::sqrt(0.75), flat[0][2], 1e-6 * flat[0][2]);
    }
}

TEST(Coulomb, TurnedSlabsAgree)
{
  expect_turned(rubbing_slab({given::coulomb("0.4 + 0.1*z")}),
                {{"Friction coefficient", "0.4 + 0.1*y"}}, 1e-9);
}

/**
 * `u = s + (a y, -e y, b y)`: pressed uniformly by p = E e, nu = 0, it slips along s everywhere, with the friction
 * `mu_f p` against it.
 */
KnownField<3> oblique_slip(const double young, const double pressure, const double coefficient,
                           const Tensor<1, 3> &slip)
{
  Tensor<1, 3> slope = 2 * coefficient * pressure / young * slip / slip.norm(); // G = E/2
  slope[1] = -pressure / young;
  Tensor<2, 3> gradient;
  for (unsigned int c = 0; c < 3; ++c)
    gradient[c][1] = slope[c];
  return {[=](const Point<3> &x) { return slip + x[1] * slope; },
          [=](const Point<3> &) { return gradient; }};
}

TEST(Coulomb, ObliqueSlipIsExact)
{
  for (const unsigned int degree : {2U, 3U, 4U})
    for (const Contact contact : {Contact::unilateral, Contact::bilateral})
    {
      Scene<3> scene;
      scene.materials[0].young = 7;
      scene.materials[0].poisson = 0;
      scene.geometry.corners = box_corners(Point<3>(0, 0, 0), Point<3>(2, 1, 3));
      scene.geometry.subdivisions = {{2, 1, 2}};
      scene.geometry.graded_towards = {Point<3>(2, 0, 0)};
      scene.geometry.grading_levels = degree == 4 ? 1 : 2;
      scene.adaptivity.start_degree = degree;
      scene.adaptivity.maximum_steps = 1;
      scene.solver.primal_tolerance = 1e-12;
      scene.boundary("bottom").contact = contact;
      scene.boundary("bottom").friction.coefficient = expression<3>(0.4);
      const KnownField<3> exact = oblique_slip(7, 0.3, 0.4, Tensor<1, 3>({0.03, 0, -0.05}));
      for (const char *const side : {"left", "right", "front", "back", "top"})
        prescribe(scene.boundary(side), exact);
      steps_of<3>(scene,
                  [&](const StepReport<3> &step)
                  {
                    EXPECT_LT(energy_error(step, exact), 1e-10);
                    EXPECT_LT(step.norms.total, 1e-9);
                    EXPECT_EQ(step.primal->newton.n_slipping, step.primal->space.n_discs);
                    EXPECT_GE(step.primal->newton.tresca_problems, 2u);
                    for (const ContactPoint<3> &point : step.contact.at(0).points)
                    {
                      EXPECT_EQ(point.mode(), ContactMode::slip);
                      EXPECT_NEAR(point.friction_bound, 0.4 * 0.3, 1e-10);
                    }
                  });
    }
}

/** At each Gauss point; forces are in balance with this friction. */
TEST(Coulomb, TheLawHoldsAtPoints)
{
  for (const char *const method : {"hap2", "hap3"})
    steps_of<3>(rubbing_slab({{"Adaptivity/Method", method},
                              {"Geometry/Subdivisions", "2, 2, 1"},
                              given::coulomb("0.6")}),
                [](const StepReport<3> &step)
                {
                  EXPECT_LT(step.equilibrium.force_imbalance, 1e-9);
                  EXPECT_LT(step.equilibrium.moment_imbalance, 1e-9);
                  unsigned int n_slipping = 0, n_sticking = 0;
                  for (const ContactPoint<3> &point : step.contact.at(0).points)
                  {
                    const double bound = 0.6 * std::max(0., -point.normal_traction),
                                 size = size_of(point.tangential_traction);
                    EXPECT_NEAR(point.friction_bound, bound, 1e-14);
                    EXPECT_LE(size, bound + 1e-12);
                    if (point.mode() == ContactMode::slip)
                    {
                      // contact dofs slip; the displacement at the point does so nearly
                      EXPECT_NEAR(size, bound, 1e-8 * bound);
                      EXPECT_LT(point.tangential_traction * point.slip, 0);
                      ++n_slipping;
                    }
                    n_sticking += point.mode() == ContactMode::stick;
                  }
                  EXPECT_GT(n_slipping + n_sticking, 0u);
                  EXPECT_EQ(step.primal->newton.n_slipping, n_slipping);
                });
}

/** A solution that is handed to it again takes no step: the friction of a mesh or a load step before is kept. */
TEST(Coulomb, GoesOnFromWhatItHasFound)
{
  steps_of<3>(rubbing_slab({given::coulomb("2")}),
              [](const StepReport<3> &step)
              {
                const PrimalSpace<3> &space = step.primal->space;
                PrimalSystem<3> system(space);
                NewtonMatrix<3> matrix(space, system);
                SemismoothNewton<3> newton(space, system, matrix);
                NewtonSettings settings;
                settings.residual = 1e-8;
                DistributedVector v = space.owned_vector();
                std::vector<ContactVector<3>> lambda;
                const auto solve = [&]()
                { return FrictionIteration<3>(space, newton).solve(v, lambda, settings); };
                const NewtonReport first = solve(), again = solve();
                EXPECT_GT(first.steps, 2u);
                EXPECT_GT(first.n_pressing,
                          first.n_slipping); // where it sticks the force is less than its limit
                EXPECT_GT(first.n_slipping, 0u);
                EXPECT_EQ(again.steps, 0u);
              });
}

/** A law that does not let go: the run ends with what to try. */
TEST(Coulomb, WithoutAFixedPointItFails)
{
  const Scene<3> scene = rubbing_slab({given::coulomb("50"),
                                       {"Boundary left/Traction", "1.5*(5 - y); -7; 0.5"},
                                       {"Adaptivity/Maximum steps", "1"}});
  const std::string failure = ::failure_of<NumericalFailure>([&] { steps_of<3>(scene); });
  EXPECT_TRUE(says(failure, "lower Friction coefficient")) << failure;
}

/** So nobody asks for it at each point where friction acts. */
TEST(Coulomb, ANumberIsKnownForOne)
{
  const auto is_number = [](const std::string &coefficient)
  {
    return is_constant<3>(
        rubbing_slab({given::coulomb(coefficient)}).boundary("bottom").friction.coefficient);
  };
  EXPECT_TRUE(is_number("0.5"));
  EXPECT_FALSE(is_number("0.5 + 0*x"));
}

/** Where no tolerance is named, what the fixed point leaves is small beside the indicator. */
TEST(Coulomb, StopsWhereTheEstimatedErrorSaysSo)
{
  Scene<3> scene = rubbing_slab(with(laws[0], {{"Geometry/Subdivisions", "2, 2, 1"}}));
  const auto exact = steps_of<3>(scene);
  scene.solver.primal_tolerance = 0;
  unsigned int k = 0;
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                EXPECT_GT(step.primal->newton.error,
                          0); // no problem of Tresca needs it, their law does
                EXPECT_LE(step.primal->newton.error, 1e-2 * step.scaled_estimate);
                EXPECT_NEAR(step.energies.norm, exact[k].norm, step.primal->newton.error + 1e-8);
                ++k;
              });
}

/** A block that is pressed down, and moved by a part of what makes all of it slip; a part of its foundation lies deeper. */
Scene<3> moved_block(const Overrides &entries)
{
  return slab({{"Geometry/Upper corner", "2, 1, 1"},
               {"Geometry/Subdivisions", "2, 1, 1"},
               {"Material/Young's modulus", "100"},
               {"Boundary left/Traction", ""},
               {"Boundary right/Displacement", ""},
               {"Boundary top/Displacement", "0.01; -0.03; 0.004*x"},
               given::coulomb("0.3 + 0.1*x"),
               {"Boundary bottom/Contact", "unilateral"},
               {"Boundary bottom/Gap", "0.002 + 0.03*(x - 0.8)^2"},
               {"Error/Bound", "true"},
               entries});
}

/** The bound of each step is above the error, by a solution that is far finer, and not much. */
TEST(CoulombBound, HoldsOfFinerMeshes)
{
  const std::string file =
      (std::filesystem::temp_directory_path() / "hpvi-coulomb-reference").string();
  struct Row
  {
    const char *name;
    Overrides entries;
    double most; ///< bound over error
    BoundKind kind = BoundKind::coupling;
  };
  for (const Row &row : {Row{"sticks all over",
                             {{"Boundary top/Displacement", "0.05; -0.03; 0.01"},
                              {"Boundary bottom/Gap", ""},
                              {"Boundary bottom/Friction coefficient", "4"},
                              given::steps("hup3", "1")},
                             3,
                             BoundKind::zones},
                         Row{"slides in part, hanging nodes", {given::steps("hap2", "3")}, 7},
                         Row{"slides all over",
                             {{"Boundary top/Displacement", "0.05; -0.03; 0.01"},
                              {"Boundary bottom/Friction coefficient", "0.2"}},
                             6.5},
                         Row{"pressed into a flat floor, p = 3",
                             {{"Boundary bottom/Gap", ""},
                              {"Boundary top/Displacement", "0; -0.02; 0"},
                              {"Boundary bottom/Friction coefficient", "0.5"},
                              {"Adaptivity/Start degree", "3"},
                              {"Adaptivity/Maximum steps", "1"}},
                             6.5},
                         Row{"cohesion",
                             {{"Boundary bottom/Friction bound", "0.2"},
                              {"Boundary bottom/Friction law", "cohesive"}},
                             6.5}})
  {
    const Overrides coarse = with({given::steps("hup2", "2")}, row.entries);
    LoadHistory<3>(
        moved_block(with(row.entries, {given::steps("hup3", "3"), {"Error/Bound", "false"}})))
        .run(
            [&](const StepReport<3> &step)
            {
              std::ofstream out(file, std::ios::binary);
              write_solution(out, step.field, step.energies.energy);
            });
    Scene<3> scene = moved_block(coarse);
    scene.reference_solution = file;
    steps_of<3>(scene,
                [&](const StepReport<3> &step)
                {
                  ASSERT_TRUE(step.bound) << row.name << ": " << step.no_bound;
                  EXPECT_EQ(step.bound->kind, row.kind) << row.name << ": " << step.bound->why;
                  EXPECT_EQ(step.bound->zones.empty(), row.kind == BoundKind::coupling);
                  EXPECT_GT(step.bound->total, step.errors.energy) << row.name;
                  EXPECT_GT(step.bound->total, (1 - 1e-9) * step.bound->estimate) << row.name;
                  EXPECT_LT(step.bound->total, row.most * step.errors.energy) << row.name;
                });
    std::filesystem::remove(file);
  }
}

/** On the last mesh of a run of a block that is moved. */
void on_block(const Overrides &entries,
              const std::function<void(const PrimalSpace<3> &, const DistributedVector &)> &look)
{
  steps_of<3>(moved_block(with(entries, {{"Error/Bound", "false"}})),
              [&](const StepReport<3> &step)
              {
                if (!step.stopped_by.empty())
                  look(step.primal->space, step.primal->u);
              });
}

/** theta by Lanczos' method is that of the whole compliance, which one solution for each component of a force makes. */
TEST(CoulombBound, HasTheCouplingOfTheWholeCompliance)
{
  for (const char *const linear : {"multigrid", "amg", "direct"})
    on_block({{"Solver/Linear", linear}, given::steps("hap2", "2")},
             [&](const PrimalSpace<3> &space, const DistributedVector &)
             {
               PrimalSystem<3> system(space);
               NewtonMatrix<3> matrix(space, system);
               matrix.linearise(std::vector<ContactDofState<3>>(space.contact.size()), true);
               std::vector<std::pair<unsigned int, unsigned int>> forces; // contact dof, component
               for (unsigned int k = 0; k < space.contact.size(); ++k)
                 for (unsigned int c = 0; c < space.contact[k].n_unknowns(); ++c)
                   forces.emplace_back(k, c);
               const unsigned int n = forces.size();
               LAPACKFullMatrix<double> S(n);
               for (unsigned int j = 0; j < n; ++j)
               {
                 DistributedVector b = space.owned_vector(), v = b;
                 ContactVector<3> unit;
                 unit[forces[j].second] = 1;
                 space.set_contact_value(b, forces[j].first, unit);
                 matrix.solve(v, b, 1e-10);
                 for (unsigned int i = 0; i < n; ++i)
                   S(i, j) = space.contact_value(v, forces[i].first)[forces[i].second];
               }
               std::mt19937 random(3);
               std::uniform_real_distribution<double> any(-0.5, 0.5);
               std::vector<ContactVector<3>> mu_chi(space.contact.size());
               std::map<std::pair<unsigned int, unsigned int>, unsigned int> places;
               for (unsigned int i = 0; i < n; ++i)
                 places[forces[i]] = i;
               for (unsigned int k = 0; k < mu_chi.size(); ++k)
                 if (space.contact[k].has_partner())
                   mu_chi[k] = ContactVector<3>({any(random), any(random)});
               // B = D' (S^-1)_PP D S_FF, of which the largest eigenvalue is real, by powers
               LAPACKFullMatrix<double> inverse(S);
               inverse.invert();
               Vector<double> f(n);
               for (double &value : f)
                 value = any(random);
               double theta = 0;
               for (unsigned int step = 0; step < 2000; ++step)
               {
                 Vector<double> g(n), next(n);
                 for (unsigned int k = 0; k < mu_chi.size(); ++k)
                   for (unsigned int c = 0; space.contact[k].has_partner() && c < 2; ++c)
                     for (unsigned int l = 0; l < mu_chi.size(); ++l)
                       for (unsigned int d = 0; space.contact[l].has_partner() && d < 2; ++d)
                         g[places[{space.contact[k].partner, 0}]] +=
                             mu_chi[k][c] * S(places[{k, c}], places[{l, d}]) * f[places[{l, d}]];
                 for (unsigned int k = 0; k < mu_chi.size(); ++k)
                   for (unsigned int l = 0; space.contact[k].has_partner() && l < mu_chi.size();
                        ++l)
                     for (unsigned int c = 0; space.contact[l].has_partner() && c < 2; ++c)
                       next[places[{k, c}]] += mu_chi[k][c] *
                                               inverse(places[{space.contact[k].partner, 0}],
                                                       places[{space.contact[l].partner, 0}]) *
                                               g[places[{space.contact[l].partner, 0}]];
                 theta = std::sqrt(next.l2_norm() / f.l2_norm());
                 f = next;
                 f /= next.l2_norm();
               }
               const double found = friction_coupling(space, matrix, mu_chi);
               EXPECT_NEAR(found, theta, 2e-3 * theta) << linear;
               EXPECT_GT(theta, 0.1);
             });
}

/** What a bound under Coulomb's law is made of. */
struct Stages : BoxBound
{
  using BoxBound::against;
  using BoxBound::BoxBound;
  using BoxBound::bumps;
  using BoxBound::contact;
  using BoxBound::coulomb_gap;
  using BoxBound::coupling;
  using BoxBound::coupling_of;
  using BoxBound::energy_norm;
  using BoxBound::face_dofs;
  using BoxBound::p;
  using BoxBound::space;
  using BoxBound::w;
};

/** Multipliers by contact dof of a step that is solved, of its contact points. */
std::vector<ContactVector<3>> multipliers_of(const StepReport<3> &step)
{
  const PrimalSpace<3> &space = step.primal->space;
  std::vector<ContactVector<3>> result(space.contact.size());
  for (const ContactState<3> &state : step.contact)
    for (const ContactPoint<3> &point : state.points)
      for (const ContactDofFace<3> &face : space.faces)
        for (unsigned int k = 0; k < space.tables.only().n_contact_dofs(); ++k)
          if (space.contact[face.friction + k].x.distance(point.x) < 1e-10)
          {
            for (unsigned int s = 0; s < 2; ++s)
              result[face.friction + k][s] = point.lambda * face.direction(face.tangential(s));
            result[face.pressure + k][0] = -point.normal_traction;
          }
  return result;
}

/** mu_f chi of @p stages at a point of the contact boundary. */
Tensor<1, 3> coupling_at(const Stages &stages, const Point<3> &x)
{
  Tensor<1, 3> result;
  for (unsigned int k = 0; k < stages.contact.size(); ++k)
  {
    const ContactDofFace<3> &face = stages.space.faces[k];
    const Tensor<1, 3> unit = [&]()
    {
      Tensor<1, 3> of_cell = x - map_of<3>(face.cell).point(Point<3>());
      for (unsigned int d = 0; d < 3; ++d)
        of_cell[d] /= PrimalSpace<3>::extent(face.cell)[d];
      return of_cell;
    }();
    const auto axes = tangents<3>(face.face);
    if (std::abs(unit[face.face / 2] - face.face % 2) > 1e-9 || unit[axes[0]] < 0 ||
        unit[axes[0]] > 1 || unit[axes[1]] < 0 || unit[axes[1]] > 1)
      continue;
    const auto a = bernstein(stages.p, unit[axes[0]]), b = bernstein(stages.p, unit[axes[1]]);
    for (unsigned int t = 0; t < 2; ++t)
      for (unsigned int j = 0; j < stages.contact[k].lambda[t].size(); ++j)
        result[axes[t]] +=
            a[j % (stages.p + 1)] * b[j / (stages.p + 1)] * stages.contact[k].lambda[t][j];
    return stages.space.condition(face.cell, face.face).friction.coefficient_at(x) * result;
  }
  return result;
}

/** theta of the same chi in the space of @p degree on @p mesh. */
double coupling_on(const PrimalSpace<3> &space, const unsigned int degree, const Stages &stages)
{
  const DegreeTables<3> tables(degree);
  const PrimalSpace<3> finer(
      space.scene,
      dynamic_cast<const PrimalSpace<3>::Mesh &>(space.dof_handler.get_triangulation()), tables);
  PrimalSystem<3> system(finer);
  NewtonMatrix<3> matrix(finer, system);
  std::vector<ContactVector<3>> mu_chi(finer.contact.size());
  for (const ContactDofFace<3> &face : finer.faces)
    for (unsigned int k = 0; k < tables.only().n_contact_dofs(); ++k)
      if (finer.contact[face.friction + k].has_partner())
      {
        const Tensor<1, 3> chi = coupling_at(stages, finer.contact[face.friction + k].x);
        for (unsigned int s = 0; s < 2; ++s)
          mu_chi[face.friction + k][s] = chi * face.direction(face.tangential(s));
      }
  return friction_coupling(finer, matrix, mu_chi);
}

/** Of any displacement: chi is continuous and in the disc, M' where it has to be, and X has it as its normal trace. */
TEST(CoulombBound, HasStagesThatTheTheoremAsksFor)
{
  const Overrides cohesive{given::steps("hap2", "3"),
                           {"Boundary bottom/Friction coefficient", "0.5"},
                           {"Boundary bottom/Friction bound", "0.3 + 0.1*z"},
                           {"Boundary bottom/Friction law", "cohesive"}},
      held_in_part{{"Geometry/Subdivisions", "2, 1, 2"},
                   {"Boundary part/On", "left"},
                   {"Boundary part/Where", "0.5 - z"},
                   {"Boundary part/Displacement", "free; free; 0"}};
  for (const Overrides &entries : {cohesive, with(cohesive, held_in_part)})
    on_block(
        entries,
        [&](const PrimalSpace<3> &space, const DistributedVector &solution)
        {
          ASSERT_TRUE(space.dof_handler.get_triangulation().has_hanging_nodes());
          std::mt19937 random(7);
          std::uniform_real_distribution<double> any(-1, 1);
          DistributedVector u = solution;
          std::vector<ContactVector<3>> lambda(space.contact.size());
          for (const ContactDofFace<3> &face : space.faces)
            for (unsigned int k = 0; k < space.tables.only().n_contact_dofs(); ++k)
            {
              const double angle = 3 * any(random);
              lambda[face.friction + k] = ContactVector<3>({std::cos(angle), std::sin(angle)});
              lambda[face.pressure + k][0] = face.cell->center()[0] > 0.5 ? 1 + any(random) : 0;
            }
          PrimalSystem<3> system(space);
          NewtonMatrix<3> matrix(space, system);
          Stages stages(space, matrix, u, lambda, 0);
          const ErrorBound bound = stages.compute();
          std::map<std::array<int, 2>, std::array<double, 3>> known; // chi and M' at places
          DistributedVector X = space.ghosted_vector();
          const std::vector<BoxModes> bumps = stages.bumps(X).value();
          double largest = 0, gap = 0;
          const QGauss<1> rule(12);
          for (unsigned int k = 0; k < space.faces.size(); ++k)
          {
            const ContactDofFace<3> &face = space.faces[k];
            const CellMap<3> map = map_of<3>(face.cell);
            const std::vector<double> points{0, 0.25, 0.5, 0.75, 1}, odd{0.03, 0.21, 0.62, 0.97};
            const auto values_of =
                [&](const std::vector<double> &where, const BoxModes &coefficients)
            { return at(bernstein_at(where, stages.p), coefficients); };
            const BoxModes chi_x = values_of(points, stages.contact[k].lambda[0]),
                           chi_z = values_of(points, stages.contact[k].lambda[1]),
                           bump = values_of(points, bumps[k]), beside = values_of(odd, bumps[k]);
            for (unsigned int q = 0; q < 25; ++q)
            {
              const Point<3> x =
                  map.point(on_cell_face(face.face, {{points[q % 5], points[q / 5], 0.}}));
              EXPECT_LE(std::hypot(chi_x[q], chi_z[q]), 1 + 1e-12);
              const std::array<double, 3> here{{chi_x[q], chi_z[q], bump[q]}};
              const auto [at_place, is_new] = known.emplace(
                  std::array<int, 2>{{int(std::lround(1e6 * x[0])), int(std::lround(1e6 * x[2]))}},
                  here);
              for (unsigned int i = 0; i < 3 && !is_new; ++i)
                EXPECT_NEAR(at_place->second[i], here[i], 1e-10) << x;
            }
            const std::vector<double> needed = stages.against(k, odd);
            for (unsigned int q = 0; q < needed.size(); ++q)
            {
              EXPECT_GE(beside[q], needed[q]);
              largest = std::max(largest, needed[q]);
            }
            // X has this normal trace, and none along the face
            const auto dofs = stages.face_dofs(face);
            const std::vector<Point<1>> nodes = QGaussLobatto<1>(stages.p + 1).get_points();
            std::vector<double> of_nodes;
            for (const Point<1> &node : nodes)
              of_nodes.push_back(node[0]);
            const BoxModes normal = values_of(of_nodes, bumps[k]);
            for (unsigned int i = 0; i < normal.size(); ++i)
            {
              EXPECT_NEAR(-X(dofs[1][i]), normal[i], 1e-12);
              EXPECT_EQ(X(dofs[0][i]), 0);
              EXPECT_EQ(X(dofs[2][i]), 0);
            }
            std::vector<double> gauss;
            for (const Point<1> &point : rule.get_points())
              gauss.push_back(point[0]);
            const BoxModes pressure = values_of(gauss, stages.contact[k].pressure),
                           M = values_of(gauss, bumps[k]),
                           along_x = values_of(gauss, stages.contact[k].lambda[0]),
                           along_z = values_of(gauss, stages.contact[k].lambda[1]);
            const Tensor<1, 3> size = PrimalSpace<3>::extent(face.cell);
            const CellField<3> field = space.field(face.cell, u),
                               of_w = space.field(face.cell, stages.w);
            for (unsigned int q = 0; q < M.size(); ++q)
            {
              const Point<3> unit(gauss[q % 12], 0, gauss[q / 12]);
              Tensor<1, 3> U;
              for (unsigned int i = 0; i < field.size(); ++i)
                U += space.tables.only().fe.shape_value(space.tables.only().numbers[i][1], unit) *
                     (field[i] - of_w[i]);
              const BoundaryCondition<3> &condition = space.condition(face.cell, face.face);
              const double u_0 = condition.gap->value(map.point(unit)),
                           g = condition.friction.bound_at(map.point(unit));
              gap += rule.weight(q % 12) * rule.weight(q / 12) * size[0] * size[2] *
                     (pressure[q] * (u_0 + U[1] + M[q]) +
                      g * (std::hypot(U[0], U[2]) - along_x[q] * U[0] - along_z[q] * U[2]));
            }
          }
          EXPECT_GT(largest, 1e-4);
          EXPECT_NEAR(stages.coulomb_gap(bumps), gap, 1e-3 * gap); // it adds what rules differ by
          DistributedVector product = space.owned_vector(), of_X = space.in_contact_dofs(X);
          matrix.multiply(product, of_X);
          EXPECT_NEAR(stages.energy_norm(X), std::sqrt(product * of_X), 1e-9);
          EXPECT_LE(bound.coupling, largest_coupling);
          const auto sum = [](const std::vector<double> &all)
          { return std::accumulate(all.begin(), all.end(), 0.); };
          const double b = std::sqrt(sum(bound.moved)),
                       A = std::sqrt(sum(bound.squares) - bound.slip * bound.slip);
          EXPECT_NEAR(bound.total,
                      coulomb_bound(bound.coupling,
                                    {A, stages.coulomb_gap(bumps), b, stages.energy_norm(X)}),
                      1e-9 * bound.total);
        });
}

/** Loads that stay move nothing more: without slip since then the bound of the second load step is no larger, and of the computed past. */
TEST(CoulombBound, CountsSlipFromTheComputedPast)
{
  for (const bool is_coulomb : {false, true})
  {
    Overrides entries{{"Loading/Steps", "2"},
                      {"Boundary top/Displacement", "0.03; -0.03; 0.01"},
                      given::steps("hup2", "2")};
    if (!is_coulomb)
      entries = with(entries, {{"Boundary bottom/Friction coefficient", ""},
                               {"Boundary bottom/Friction bound", "0.5"}});
    std::vector<ErrorBound> bounds;
    LoadHistory<3>(moved_block(entries))
        .run(
            [&](const StepReport<3> &step)
            {
              EXPECT_TRUE(step.bound) << step.no_bound;
              if (step.bound && !step.stopped_by.empty())
                bounds.push_back(*step.bound);
            });
    ASSERT_EQ(bounds.size(), 2U);
    EXPECT_NE(bounds[0].kind, BoundKind::history);
    EXPECT_EQ(bounds[1].kind, BoundKind::history);
    EXPECT_TRUE(std::isnan(bounds[1].energy_below));
    EXPECT_LT(bounds[1].total, 1.001 * bounds[0].total);
    EXPECT_LT(bounds[1].slip, bounds[0].slip);
  }
}
/**
 * theta is above that of far finer spaces, for the same chi. HPVI_STEPS steps of each scene, one by default; --gtest_output=xml:FILE has each
 * value, over theirs.
 */
TEST(CoulombBound, HasTheCouplingOfFarFinerSpaces)
{
  const char *const steps = std::getenv("HPVI_STEPS");
  const Overrides flat{{"Boundary bottom/Gap", ""}, {"Boundary top/Displacement", "0; -0.02; 0"}};
  struct Row
  {
    const char *name;
    Overrides entries;
    std::string degree = "2";
  };
  for (const Row &row :
       {Row{"slides-in-part", {}},
        Row{"slides-all-over", {{"Boundary top/Displacement", "0.05; -0.03; 0.01"}}},
        Row{"pressed-on-a-flat-floor", flat},
        Row{"moved-on-a-flat-floor",
            with(flat, {given::coulomb("0.3"), {"Boundary top/Displacement", "0.05; -0.02; 0"}})},
        Row{"degree-3", flat, "3"}, Row{"degree-4", flat, "4"}})
    on_block(with(row.entries, {given::steps("hup3", "3")}),
             [&](const PrimalSpace<3> &fine, const DistributedVector &)
             {
               const Overrides coarse{given::steps("hap2", steps ? steps : "1"),
                                      {"Adaptivity/Start degree", row.degree}};
               steps_of<3>(moved_block(with(row.entries, coarse)),
                           [&](const StepReport<3> &step)
                           {
                             const PrimalSpace<3> &space = step.primal->space;
                             PrimalSystem<3> system(space);
                             NewtonMatrix<3> matrix(space, system);
                             const std::vector<ContactVector<3>> lambda = multipliers_of(step);
                             Stages stages(space, matrix, step.primal->u, lambda, 0);
                             const double theta = stages.compute().coupling;
                             EXPECT_NEAR(theta, step.bound.value().coupling, 1e-3);
                             const double own = stages.coupling_of(
                                 stages.p, std::vector<bool>(space.faces.size()));
                             EXPECT_NEAR(coupling_on(space, stages.p, stages), own, 1e-9);
                             const double finer = coupling_on(fine, 3, stages);
                             EXPECT_GT(theta, 1.03 * finer) << row.name << ", " << space.n_free;
                             EXPECT_LT(theta, 1.4 * finer) << row.name << ", " << space.n_free;
                             const std::string key =
                                 row.name + ("_" + std::to_string(space.n_free));
                             RecordProperty(key + "_of_its_degree", text(own / finer, 3));
                             RecordProperty(key + "_taken", text(theta / finer, 3));
                           });
             });
}
} // namespace
