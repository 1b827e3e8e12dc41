// SPDX-License-Identifier: LGPL-2.1-or-later
// Histories of loads: slip is counted from the load step before, and energy is accounted for.
#include "opening_contact.h"

#include <hpvi/base/input_error.h>
#include <hpvi/driver/load_history.h>
#include <hpvi/plane/interpolation.h>
#include <hpvi/plane/tangential_trace.h>
#include <hpvi/reader/closed_forms/partial_slip.h>
#include <hpvi/results/stored_solution.h>
#include <hpvi/results/true_error.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace
{
using namespace verification;

/** What a load step leaves. */
struct State
{
  LoadStep load;
  Vector<double> u, z;
  unsigned int n_elements, multiplications;
  double energy, slack, slip, largest_slip; ///< slip: int |u_t - past| by the contact points
  std::vector<ContactPoint<2>> points;
  HistorySoFar history = {};
};

/** The last step of each load step. */
std::vector<State> evolution(const Scene<2> &scene)
{
  std::vector<State> states;
  LoadHistory<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        if (step.stopped_by.empty())
          return;
        const Solution<2> &solution = step.solution();
        State state{step.load,
                    solution.u,
                    solution.z,
                    solution.displacement_space.triangulation().n_active_cells(),
                    step.reduced->qp.multiplications,
                    step.energies.energy,
                    step.energies.slack,
                    0.,
                    0.,
                    {},
                    step.history};
        for (const ContactState<2> &contact : step.contact)
          for (const ContactPoint<2> &point : contact.points)
          {
            state.largest_slip = std::max(state.largest_slip, std::abs(point.slip));
            state.points.push_back(point);
          }
        states.push_back(state);
      });
  return states;
}

double difference(const Vector<double> &a, const Vector<double> &b, const double factor = 1)
{
  Vector<double> rest(a);
  rest.add(-factor, b);
  return rest.linfty_norm();
}

// ---------------------------------------------------------------- closed forms

/**
 * A block of height 1 on a plane, sheared by the displacement U of its top: a spring of stiffness mu in
 * series with friction, Jenkins' element. Its sides bear the shear stress, so that the field is
 * `u = (slip + tau y/mu, -p y/E)` with Poisson's ratio 0 and the pressure p.
 */
struct Jenkins
{
  double tau = 0, slip = 0;

  void advance(const double U, const double mu, const double bound)
  {
    tau = std::min(bound, std::max(-bound, mu * (U - slip)));
    slip = U - tau / mu;
  }
};

constexpr double width = 2, young = 3, mu = 1.5;

/** Loads, and the history that they have, at the time t. */
struct Path
{
  std::function<double(double)> displacement, pressure;
  double coefficient; ///< of Coulomb's law, or 0: Tresca's with the pressure as bound
};

double bound(const Path &path, const double t)
{
  return (path.coefficient > 0 ? path.coefficient : 1.) * path.pressure(t);
}

Jenkins jenkins(const Path &path, const unsigned int steps, const unsigned int last)
{
  Jenkins element;
  for (unsigned int k = 1; k <= last; ++k)
    element.advance(path.displacement(k / double(steps)), mu, bound(path, k / double(steps)));
  return element;
}

Scene<2> block(const Path &path, const std::string &contact, const unsigned int steps,
               const double t)
{
  const std::string p = in_digits(path.pressure(t)),
                    tau = in_digits(jenkins(path, steps, std::lround(t * steps)).tau);
  return scene_of({given::box(in_digits(width) + ", 1", "2, 1"),
                   given::elastic(in_digits(young), "0"),
                   {"Boundary bottom/Contact", contact},
                   path.coefficient > 0 ? Overrides{{"Boundary bottom/Friction coefficient",
                                                     in_digits(path.coefficient)}}
                                        : Overrides{{"Boundary bottom/Friction bound", p}},
                   {"Boundary top/Displacement", in_digits(path.displacement(t)) + "; free"},
                   {"Boundary top/Traction", "0; -" + p},
                   {"Boundary right/Traction", "0; " + tau},
                   {"Boundary left/Traction", "0; -(" + tau + ")"},
                   given::steps("hap2", "1")});
}

Scene<2> block(const Path &path, const std::string &contact, const unsigned int steps)
{
  const auto at = [=](const double t) { return block(path, contact, steps, t); };
  Scene<2> scene = at(1. / steps);
  scene.loading = {steps, LoadAdaptivity::every_step, at};
  return scene;
}

const auto wave = [](const double t) { return 0.5 * std::sin(4 * M_PI * t) + 0.1 * t; };

using JenkinsElement = ::testing::TestWithParam<std::pair<std::string, double>>;

TEST_P(JenkinsElement, IsFollowedThroughItsCycles)
{
  const auto [contact, coefficient] = GetParam();
  // A pressure that falls makes the block slip where its top stands still.
  const Path path{wave, [](const double t) { return 0.4 - 0.2 * t; }, coefficient};
  const unsigned int steps = 24;
  const std::vector<State> states = evolution(block(path, contact, steps));
  ASSERT_EQ(states.size(), steps);
  double dissipated = 0, trapezoidal = 0, slip = 0, work = 0, tau = 0, last_p = 0, U = 0;
  double path_length = 0, rubbed = 0, lowest = 0, highest = 0, shear = 0;
  for (unsigned int k = 1; k <= steps; ++k)
  {
    const State &state = states[k - 1];
    const double t = k / double(steps), p = path.pressure(t);
    const Jenkins exact = jenkins(path, steps, k);
    dissipated += width * exact.tau * (exact.slip - slip);
    trapezoidal += width * (tau + exact.tau) / 2 * (exact.slip - slip);
    // The support above and the pressure on it, by the trapezoidal rule; the sides cancel.
    work += width * (tau + exact.tau) / 2 * (wave(t) - U) +
            width * (last_p + p) / 2 * (p - last_p) / young;
    for (const ContactPoint<2> &point : state.points)
    {
      // The tangent of the bottom points to the right.
      EXPECT_NEAR(point.tangential_displacement, exact.slip, 1e-10) << "t = " << t;
      EXPECT_NEAR(point.slip, exact.slip - slip, 1e-10) << "t = " << t;
      EXPECT_NEAR(point.tangential_traction, -exact.tau, 1e-10) << "t = " << t;
    }
    EXPECT_EQ(state.load.number, k);
    EXPECT_EQ(state.load.t, t);
    EXPECT_NEAR(state.load.dissipated, dissipated, 1e-10);
    EXPECT_NEAR(state.load.trapezoidal, trapezoidal, 1e-10);
    EXPECT_NEAR(state.load.stored, width * (exact.tau * exact.tau / (2 * mu) + p * p / (2 * young)),
                1e-10);
    EXPECT_NEAR(state.load.work, work, 1e-10);
    EXPECT_NEAR(state.load.released, work - dissipated - state.load.stored, 1e-10);
    EXPECT_NEAR(state.load.unbalanced, 0, 1e-12);
    EXPECT_NEAR(state.slack, 0, 1e-12);
    path_length += std::abs(exact.slip - slip);
    rubbed += p * std::abs(exact.slip - slip);
    lowest = std::min(lowest, exact.slip);
    highest = std::max(highest, exact.slip);
    shear = std::max(shear, std::abs(exact.tau));
    for (PointHistory point : state.history.contact.at(0).points)
    {
      EXPECT_NEAR(point.path, path_length, 1e-10);
      EXPECT_NEAR(point.rubbed, rubbed, 1e-10);
      EXPECT_NEAR(point.slip_range(), highest - lowest, 1e-10);
      EXPECT_NEAR(point.dissipated, dissipated / width, 1e-10);
      EXPECT_NEAR(point.shear, shear, 1e-10);
      EXPECT_NEAR(point.pressure, path.pressure(1. / steps), 1e-10);
      EXPECT_NEAR(point.tension, 0, 1e-10);
      EXPECT_EQ(point.open, 0);
    }
    slip = exact.slip;
    tau = exact.tau;
    last_p = p;
    U = wave(t);
  }
  EXPECT_GT(dissipated, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Laws, JenkinsElement,
                         ::testing::Values(std::make_pair(std::string("bilateral"), 0.),
                                           std::make_pair(std::string("unilateral"), 0.),
                                           std::make_pair(std::string("bilateral"), 0.8),
                                           std::make_pair(std::string("unilateral"), 0.8)));

/**
 * Mindlin and Deresiewicz: after Q_1 the force falls to Q, and slip comes back from the ends of the
 * contact, u = u(Q_1) - 2 u((Q_1 - Q)/2) with the field u(Q) of the first loading.
 */
struct Mindlin
{
  static constexpr double a = 0.7, b = 2.1, Q_1 = 1.5;
  Material material;

  /** The stick length for the force Q, of which the whole friction is pi a b / 2. */
  static double stick_length(const double Q)
  {
    return std::sqrt(a * a - 2 * a * Q / (M_PI * b));
  }

  Tensor<1, 2> loading(const double Q, const Point<2> &x) const
  {
    return Q == 0 ? Tensor<1, 2>()
                  : PartialSlip(material, b, a, stick_length(Q), 0.).displacement(x);
  }

  Tensor<1, 2> unloading(const double Q, const Point<2> &x) const
  {
    return loading(Q_1, x) - 2 * loading((Q_1 - Q) / 2, x);
  }

  /** Of the first loading, up to Q. */
  double slip(const double Q, const Point<2> &x) const
  {
    return std::abs(loading(Q, x)[0]);
  }

  /** int g |u_t| likewise. */
  double dissipated(const double Q) const
  {
    const QGauss<1> gauss(20);
    double sum = 0;
    const double c = stick_length(Q), n = 200;
    for (unsigned int k = 0; k < n; ++k) // u_t begins like (x - c)^(3/2), g ends like a root
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double x = c + (a - c) * (k + gauss.point(q)[0]) / n;
        sum += 2 * gauss.weight(q) * (a - c) / n * b * std::sqrt(1 - x * x / (a * a)) *
               slip(Q, Point<2>(x, 0));
      }
    return sum;
  }
};

/** The body of prm/partial-slip.prm under the displacements of @p exact, a field for each load step. */
Scene<2> driven(const Scene<2> &plain, const unsigned int steps,
                const std::function<Tensor<1, 2>(unsigned int, const Point<2> &)> &exact)
{
  Scene<2> scene = plain;
  scene.loading.steps = steps;
  scene.loading.at = [=](const double t)
  {
    Scene<2> result = plain;
    for (const char *const name : {"left", "right", "top"})
      for (unsigned int c = 0; c < 2; ++c)
        result.boundary(name).displacement[c] =
            expression<2>([=, step = std::lround(t * steps) - 1](const Point<2> &x)
                          { return exact(step, x)[c]; });
    return result;
  };
  return scene;
}

/** Along the contact, and by how much it may be missed [length]. */
struct SlipOfPoint
{
  double path, range, path_tolerance, range_tolerance;
};

/** Each point has what @p slip says of x, and all of them dissipate @p dissipated, up to @p share of it. */
void expect_of_points(const StepReport<2> &step,
                      const std::function<SlipOfPoint(const Point<2> &)> &slip,
                      const double dissipated, const double share)
{
  const std::vector<PointHistory> &points = step.history.contact.at(0).points;
  double sum = 0;
  for (unsigned int i = 0; i < points.size(); ++i)
  {
    const Point<2> x(points[i].x[0], 0.);
    const SlipOfPoint wanted = slip(x);
    EXPECT_NEAR(points[i].path, wanted.path, wanted.path_tolerance) << x;
    EXPECT_NEAR(points[i].slip_range(), wanted.range, wanted.range_tolerance) << x;
    sum += step.contact[0].points[i].area * points[i].dissipated;
  }
  EXPECT_NEAR(sum, dissipated, share * dissipated);
}

/** From mesh to mesh: what points know is carried over along straight lines, which is right to h^2 or, at the ends, h. */
TEST(LoadHistory, UnloadsAsMindlinAndDeresiewiczFound)
{
  const Scene<2> plain = shipped_scene("partial-slip", {{"Exact solution/Solution", "none"},
                                                        given::clamped({"left", "right", "top"}),
                                                        {"Error/Bound", "false"},
                                                        {"Adaptivity/Tolerance", "1e-4"},
                                                        {"Adaptivity/Maximum steps", "20"}});
  const Mindlin mindlin{plain.materials[0]};
  const double longest = mindlin.slip(Mindlin::Q_1, {Mindlin::a, 0.});
  const std::vector<double> forces = {1.5, 0.4, -1.}; // the first is Q_1
  const auto exact = [&](const unsigned int step, const Point<2> &x)
  { return step == 0 ? mindlin.loading(Mindlin::Q_1, x) : mindlin.unloading(forces[step], x); };
  std::vector<double> dissipated = {mindlin.dissipated(Mindlin::Q_1)};
  for (unsigned int k = 1; k < forces.size(); ++k)
    dissipated.push_back(dissipated[0] + 2 * mindlin.dissipated((Mindlin::Q_1 - forces[k]) / 2));
  LoadHistory<2>(driven(plain, forces.size(), exact))
      .run(
          [&](const StepReport<2> &step)
          {
            if (step.stopped_by.empty())
              return;
            const unsigned int k = step.load.number - 1;
            EXPECT_LE(nodal_error(step.solution(), [&](const Point<2> &x) { return exact(k, x); }),
                      1e-5);
            EXPECT_NEAR(step.contact[0].friction_resultant, -forces[k], 1e-4);
            EXPECT_NEAR(step.load.dissipated, dissipated[k], 1e-4 * dissipated[k]) << k;
            expect_of_points(
                step,
                [&](const Point<2> &x)
                {
                  const double forth = mindlin.slip(Mindlin::Q_1, x),
                               back = 2 * mindlin.slip((Mindlin::Q_1 - forces[k]) / 2, x),
                               tolerance = 1e-3 * std::max(longest, forth + back);
                  return SlipOfPoint{forth + back, std::max(forth, back), tolerance, tolerance};
                },
                dissipated[k], 1e-3);
          });
}

/**
 * On one mesh, graded to where slip begins: there it is K r^(3/2), of which edges of length h miss (h/a)^(3/2), 5e-5. A whole cycle between
 * Q_1 and -Q_1 dissipates what Johnson's integral of slip and traction over a contact says, 4 int g |u(Q_1)|.
 */
TEST(LoadHistory, CyclesAsMindlinAndDeresiewiczFound)
{
  const double Q_2 = 0.4, c_1 = Mindlin::stick_length(Mindlin::Q_1),
               c_2 = Mindlin::stick_length((Mindlin::Q_1 - Q_2) / 2);
  std::string places;
  for (const double x : {Mindlin::a, c_1, c_2})
    places += in_digits(-x) + ", 0; " + in_digits(x) + ", 0; ";
  const Scene<2> plain = shipped_scene(
      "partial-slip", {{"Exact solution/Solution", "none"},
                       given::clamped({"left", "right", "top"}),
                       {"Error/Bound", "false"},
                       {"Geometry/Graded towards", places.substr(0, places.size() - 2)},
                       {"Geometry/Grading levels", "10"},
                       {"Adaptivity/Start degree", "5"},
                       {"Adaptivity/Maximum steps", "1"}});
  const Mindlin mindlin{plain.materials[0]};
  const double longest = mindlin.slip(Mindlin::Q_1, {Mindlin::a, 0.});
  const std::vector<double> forces = {Mindlin::Q_1, Q_2, -Mindlin::Q_1, -Q_2, Mindlin::Q_1};
  const auto exact = [&](const unsigned int step, const Point<2> &x)
  {
    const double way = step == 0 || step > 2 ? -1 : 1; // from Q_1 down, from -Q_1 up
    return step == 0 ? mindlin.loading(Mindlin::Q_1, x)
                     : way * mindlin.unloading(way * forces[step], x);
  };
  const double whole = mindlin.dissipated(Mindlin::Q_1),
               part = mindlin.dissipated((Mindlin::Q_1 - Q_2) / 2);
  const std::vector<double> dissipated = {whole, whole + 2 * part, 3 * whole, 3 * whole + 2 * part,
                                          5 * whole};
  LoadHistory<2>(driven(plain, forces.size(), exact))
      .run(
          [&](const StepReport<2> &step)
          {
            const unsigned int k = step.load.number - 1;
            EXPECT_NEAR(step.contact[0].friction_resultant, -forces[k], 1e-4);
            EXPECT_NEAR(step.load.dissipated, dissipated[k], 1e-4 * dissipated[k]) << k;
            expect_of_points(
                step,
                [&](const Point<2> &x)
                {
                  const double forth = mindlin.slip(Mindlin::Q_1, x),
                               back = 2 * mindlin.slip((Mindlin::Q_1 - Q_2) / 2, x),
                               tolerance = 1e-4 * longest;
                  const std::vector<double> paths = {forth, forth + back, 3 * forth,
                                                     3 * forth + back, 5 * forth};
                  return SlipOfPoint{paths[k], k < 2 ? std::max(forth, back) : 2 * forth,
                                     (k + 1) * tolerance, 2 * tolerance};
                },
                dissipated[k], 1e-4);
          });
}

// ---------------------------------------------------------------- identities

/** A bar on a plane, moved by its right end: slip begins there and grows inwards. */
Scene<2> bar(const unsigned int steps, const std::string &displacement, const Overrides &more = {})
{
  Overrides entries = {given::box("4, 0.5", "8, 1"),
                       {"Material/Young's modulus", "10"},
                       given::rough("bottom", "bilateral", "0.1"),
                       {"Boundary right/Displacement", displacement + "; free"},
                       given::steps("hap3", "1"),
                       {"Loading/Steps", std::to_string(steps)},
                       {"Loading/Adapt", "first step"}};
  entries.insert(entries.end(), more.begin(), more.end());
  return scene_of(entries);
}

/** At n load steps of each straight piece from one corner to the next, all of the same duration. */
std::string zigzag(const std::vector<double> &corners)
{
  std::string result = in_digits(corners.back()), s = in_digits(corners.size()) + "*t";
  for (unsigned int k = corners.size(); k-- > 0;)
  {
    const double from = k == 0 ? 0. : corners[k - 1];
    result = "if(" + s + " <= " + in_digits(k + 1 + 1e-9) + ", " + in_digits(from) + " + (" + s +
             " - " + in_digits(k) + ")*" + in_digits(corners[k] - from) + ", " + result + ")";
  }
  return result;
}

TEST(LoadHistory, UnloadsAlongTheLoadingCurveTwiceAsLarge) // Masing's rule
{
  const unsigned int n = 6;
  const std::vector<State> states = evolution(bar(2 * n, zigzag({0.03, -0.03})));
  const State &turn = states[n - 1];
  unsigned int partly = 0;
  for (unsigned int k = 0; k < n; ++k)
  {
    Vector<double> change(turn.u), friction(turn.z);
    change -= states[n + k].u;
    friction -= states[n + k].z;
    EXPECT_LE(difference(change, states[k].u, 2), 1e-10 * turn.u.linfty_norm()) << k;
    EXPECT_LE(difference(friction, states[k].z, 2), 1e-9 * turn.z.linfty_norm()) << k;
    partly += states[k].points.back().slips && !states[k].points.front().slips;
  }
  EXPECT_GE(partly, 2U); // else nothing is tested
}

TEST(LoadHistory, RepeatsItsLoop)
{
  const unsigned int n = 5;
  const double U = 0.03;
  const std::vector<State> states = evolution(bar(5 * n, zigzag({U, -U, U, -U, U})));
  const double once = states[3 * n - 1].load.dissipated - states[n - 1].load.dissipated;
  EXPECT_GT(once, 0);
  for (unsigned int k = n; k < 3 * n; ++k)
  {
    const State &first = states[k], &second = states[k + 2 * n];
    EXPECT_LE(difference(first.u, second.u), 1e-10 * first.u.linfty_norm()) << k;
    EXPECT_LE(difference(first.z, second.z), 1e-9 * 0.1) << k;
    EXPECT_NEAR(second.load.dissipated - first.load.dissipated, once, 1e-10 * once) << k;
  }
}

TEST(LoadHistory, DoesNotDependOnItsRate)
{
  const std::vector<State> few = evolution(bar(2, "0.03*t")), many = evolution(bar(12, "0.03*t"));
  Scene<2> static_scene = bar(1, "0.03*t").loading.at(1);
  each_step<2>(static_scene,
               [&](const StepReport<2> &step)
               {
                 EXPECT_LE(difference(few.back().u, step.solution().u), 1e-10 * 0.03);
                 EXPECT_LE(difference(few.back().z, step.solution().z), 1e-9 * 0.1);
               });
  EXPECT_LE(difference(few.back().u, many.back().u), 1e-10 * 0.03);
  EXPECT_LE(difference(few.back().z, many.back().z), 1e-9 * 0.1);
  EXPECT_NEAR(many.back().load.dissipated, few.back().load.dissipated,
              1e-9 * few.back().load.dissipated);
  EXPECT_GT(few.back().load.dissipated, 0.1 * few.back().load.work);
}

/** Friction gives way below a support that stands still, by and by or at once: nothing outside moves. */
TEST(LoadHistory, DoesNoWorkWhereNothingOutsideMoves)
{
  for (const char *const bound : {"0.1*(1.3 - t)", "if(t < 0.9, 0.1, 0)",
                                  "if(t < 0.9 | x > 3, 0.1, 0)"}) // edges lose their multipliers
  {
    const std::vector<State> states =
        evolution(bar(6, "0.03*min(2*t, 1)", {{"Boundary bottom/Friction bound", bound}}));
    const LoadStep &moved = states[2].load, &last = states.back().load;
    for (unsigned int k = 3; k < 6; ++k)
      EXPECT_NEAR(states[k].load.work, moved.work, 1e-13 * moved.work) << bound;
    EXPECT_LT(last.stored, 0.95 * moved.stored) << bound;
    EXPECT_GT(last.released, moved.released + 0.01 * moved.stored) << bound;
    EXPECT_NEAR(last.work, last.stored + last.dissipated + last.released, 1e-12 * last.work)
        << bound;
  }
}

/** Of a path that is smooth the trapezoidal rule loses dt^2, but dt where the bounds change. */
TEST(LoadHistory, ReleasesLessTheSmallerItsSteps)
{
  const auto released = [](const unsigned int steps, const char *const bound)
  {
    const LoadStep load =
        evolution(bar(steps, "0.03*t", {{"Boundary bottom/Friction bound", bound}})).back().load;
    return std::abs(load.released / load.dissipated);
  };
  const double constant = released(10, "0.1") / released(80, "0.1"),
               changing = released(10, "0.05*(1 + t)") / released(80, "0.05*(1 + t)");
  EXPECT_GT(constant, 30);
  EXPECT_GT(changing, 5);
  EXPECT_LT(changing, 15);
}

/** A foundation that comes nearer does work; one that stands at a distance does none. */
TEST(LoadHistory, CountsTheWorkOfMovingGaps)
{
  const auto pressed = [](const std::string &top, const std::string &gap, const unsigned int steps)
  {
    return evolution(scene_of({given::elastic("3", "0"),
                               {"Boundary top/Displacement", "0; " + top},
                               {"Boundary bottom/Contact", "unilateral"},
                               {"Boundary bottom/Gap", gap},
                               given::steps("hap2", "1"),
                               {"Loading/Steps", std::to_string(steps)}}))
        .back()
        .load;
  };
  for (const unsigned int steps : {1, 4})
  {
    const LoadStep lifted = pressed("0", "-0.2*t", steps);
    EXPECT_NEAR(lifted.work, 3 * 0.2 * 0.2 / 2, 1e-12);
    EXPECT_NEAR(lifted.stored, lifted.work, 1e-12);
    EXPECT_NEAR(lifted.released, 0, 1e-12);
    const LoadStep interference = pressed("0", "-0.2", steps);
    EXPECT_NEAR(interference.work, 3 * 0.2 * 0.2 / 2, 1e-12);
    EXPECT_NEAR(interference.released, 0, 1e-12);
  }
  // Half the force acts over the whole way, a quarter of which is free.
  const LoadStep at_once = pressed("-0.2", "0.05", 1);
  EXPECT_NEAR(at_once.work, 3 * 0.15 / 2 * 0.2, 1e-12);
  EXPECT_NEAR(at_once.stored, 3 * 0.15 * 0.15 / 2, 1e-12);
  EXPECT_NEAR(at_once.released, 3 * 0.15 / 2 * 0.05, 1e-12);
  const LoadStep slowly = pressed("-0.2*t", "0.05", 4); // touches at the end of the first step
  EXPECT_NEAR(slowly.work, 3 * 0.15 * 0.15 / 2, 1e-12);
  EXPECT_NEAR(slowly.released, 0, 1e-12);
}

TEST(LoadHistory, BeginsEachLoadStepWithTheFrictionOfTheLast)
{
  unsigned int multiplications[2] = {0, 0};
  for (const bool warm : {false, true})
    for (const State &state :
         evolution(bar(10, "0.03*t", {{"Solver/QP warm start", warm ? "true" : "false"}})))
      multiplications[warm] += state.multiplications;
  EXPECT_LT(multiplications[true], 0.7 * multiplications[false]);
}

TEST(LoadHistory, RestsWhereLoadsRest)
{
  const std::vector<State> states =
      evolution(bar(6, "0.03*min(2*t, 1)", {{"Loading/Adapt", "every step"}}));
  EXPECT_GT(states[2].largest_slip, 1e-4);
  for (unsigned int k = 3; k < 6; ++k)
  {
    EXPECT_LE(states[k].largest_slip, 1e-15);
    EXPECT_LE(difference(states[k].u, states[2].u), 1e-12 * 0.03);
    EXPECT_NEAR(states[k].load.dissipated, states[2].load.dissipated, 1e-16);
    EXPECT_NEAR(states[k].load.work, states[2].load.work, 1e-16);
  }
}

/** On any mesh that descends from that of the past, and with degrees that are not lower. */
TEST(LoadHistory, HandsOnPastSlipWithoutError)
{
  for (const unsigned int seed : {1, 2, 3, 4})
  {
    Scene<2> scene =
        scene_of({given::quadrilateral("Geometry", "0, 0; 3, 1; 2, 3; -0.5, 2", "3, 2"),
                  {"Boundary bottom/Contact", "unilateral"},
                  {"Boundary bottom/Friction coefficient", "0.3"},
                  given::rough("right", "tangential", "1 + x"),
                  given::rough("top", "tangential", "1"),
                  given::rough("left", "unilateral", "1")});
    const RandomMesh coarse(scene, seed, 2, 2, 6);
    std::mt19937 random(seed);
    const Laboratory before(scene, coarse);
    const Solution<2> past = before.random_field(random);

    Refinement refinement;
    refinement.degrees = coarse.degrees;
    for (unsigned int &degree : refinement.degrees)
    {
      refinement.bisect.push_back(random() % 3 == 0);
      degree += random() % 3;
    }
    Triangulation<2> mesh;
    mesh.copy_triangulation(coarse.mesh);
    const Degrees degrees = refine_mesh(mesh, coarse.degrees, refinement);
    const PastSlip<2> slip =
        past_slip(past.contact_space, past.displacement_space, past.tables, past.u);
    EXPECT_EQ(slip.size(), 4U); // tangents along and against edges
    const Laboratory after(scene, mesh, degrees, std::make_shared<const ShapeTables<2>>(), slip);
    const Vector<double> u = interpolate(past, after.displacement_space);

    EXPECT_NEAR(
        internal_forces(scene, after.displacement_space, after.tables, u).energy_product /
            internal_forces(scene, before.displacement_space, before.tables, past.u).energy_product,
        1., 1e-12);
    const Vector<double> moments = after.contact_operator.moments(u);
    unsigned int frictions = 0;
    for (unsigned int i = 0; i < moments.size(); ++i)
      if (const ContactMultiplier<2> &unknown = after.contact_space.multipliers()[i];
          unknown.kind == ContactMultiplier<2>::Kind::friction)
      {
        EXPECT_NEAR(unknown.gap, moments[i], 1e-13 * unknown.weight * past.u.linfty_norm()) << i;
        ++frictions;
      }
    EXPECT_GT(frictions, 10U);
  }
}

TEST(LoadHistory, AdaptsAsLongAsTheFirstLoadStepIsMoreAccurate)
{
  const Overrides steps = {given::steps("hpa3", "6")};
  Overrides each = steps;
  each.push_back({"Loading/Adapt", "every step"});
  std::vector<unsigned int> elements;
  double first = 0;
  unsigned int number = 0, tolerances = 0;
  LoadHistory<2>(bar(5, "0.03*sin(6*t)", each))
      .run(
          [&](const StepReport<2> &step)
          {
            EXPECT_EQ(step.number, ++number);
            if (step.stopped_by.empty())
              return;
            tolerances += text(step.stopped_by) == "error of load step 1";
            if (step.load.number == 1)
              first = step.relative_estimate;
            else
              EXPECT_TRUE(step.relative_estimate < 1.2 * first ||
                          text(step.stopped_by) == "Maximum steps");
            elements.push_back(step.solution().displacement_space.degrees().size());
          });
  EXPECT_GE(tolerances, 2U);
  EXPECT_TRUE(std::is_sorted(elements.begin(), elements.end()));
  EXPECT_GT(elements.back(), elements.front());
  const std::vector<State> fixed = evolution(bar(5, "0.03*sin(6*t)", steps));
  for (const State &state : fixed)
    EXPECT_EQ(state.n_elements, elements.front());
}

/** What is exact to round-off sets no tolerance: else all later load steps would take all their steps. */
TEST(LoadHistory, TakesItsToleranceWhereThereIsAnError)
{
  for (const char *const load : {"0; 0", "0; -0.1"})
  {
    std::vector<std::string> stopped_by;
    LoadHistory<2>(bar(4, "0.03*max(0, t - 0.3)",
                       {{"Loading/Adapt", "every step"},
                        {"Material/Poisson's ratio", "0"},
                        {"Boundary top/Traction", load},
                        {"Adaptivity/Maximum steps", "5"}}))
        .run(
            [&](const StepReport<2> &step)
            {
              if (!step.stopped_by.empty())
                stopped_by.push_back(text(step.stopped_by));
            });
    EXPECT_EQ(stopped_by,
              (std::vector<std::string>{"round-off", "Maximum steps", "error of load step 2",
                                        "error of load step 2"}));
  }
}

/** Loads and displacements that fall to a tiny part of the largest, or to where bodies just touch, leave what is zero beside it, at once. */
TEST(LoadHistory, ZeroIsBesideTheLargestLoad)
{
  const Overrides blocks = {given::block("lower", "1, 1", "2, 2"),
                            given::block("upper", "0, 1.01", "1, 2.01", "3, 3"),
                            given::elastic("1000", "0"),
                            {"Boundary lower.bottom/Displacement", "0; 0"},
                            {"Contact touch/Between", "upper.bottom, lower.top"},
                            {"Loading/Steps", "2"}},
                  pad = {given::box("2, 1", "4, 2"),
                         given::elastic("1000", "0.3"),
                         {"Boundary top/Displacement", "0.001*t; free"},
                         {"Boundary bottom/Contact", "unilateral"},
                         {"Loading/Steps", "2"}};
  struct Row
  {
    Overrides scene;
    std::string entry, least, friction; ///< with least in the place of LEAST
    bool is_zero = true;                ///< beside the largest load; else small, and no failure
  };
  const std::string lifted = "0.003; -if(t < 0.9, 0.02, LEAST)", pressed = "if(t < 0.9, 1, LEAST)";
  for (const Row &row :
       {Row{blocks, lifted, "0.01", "0.2"}, Row{blocks, lifted, "0.01", ""},
        Row{blocks, lifted, "0.01 + 1e-14", "0.2"}, Row{blocks, lifted, "0.01 + 1e-13", "0.2"},
        Row{blocks, lifted, "0.01 - 1e-13", "0.2"},
        Row{blocks, lifted, "0.01 + 2e-12", "0.2", false}, // 1e-10 of the largest strain
        Row{pad, pressed, "1e-10", "0.3"}, Row{pad, pressed, "1e-12", "0.3"},
        Row{pad, pressed, "0", "0.3"}})
    for (const std::string adapt : {"first step", "every step"})
    {
      Overrides entries = row.scene;
      const bool is_pad = row.entry == pressed;
      std::string value = row.entry;
      value.replace(value.find("LEAST"), 5, row.least);
      entries.emplace_back(is_pad ? "Boundary top/Pressure" : "Boundary upper.top/Displacement",
                           value);
      entries.emplace_back(is_pad ? "Boundary bottom/Friction coefficient"
                                  : "Contact touch/Friction coefficient",
                           row.friction);
      entries.emplace_back("Loading/Adapt", adapt);
      entries.emplace_back("Adaptivity/Maximum steps", "8");
      unsigned int last_steps = 0;
      double first = 0, last = 0, seconds = 0, pressure = 0;
      std::string stopped_by;
      LoadHistory<2>(scene_of(entries))
          .run(
              [&](const StepReport<2> &step)
              {
                pressure = step.solution().z.linfty_norm();
                (step.load.number == 1 ? first : last) = step.energies.norm;
                last_steps += step.load.number == 2;
                stopped_by = text(step.stopped_by);
                seconds = step.seconds;
              });
      if (row.is_zero)
      {
        EXPECT_EQ(stopped_by, "round-off") << value << ' ' << adapt;
        EXPECT_EQ(last_steps, 1U) << value << ' ' << adapt;
      }
      const bool is_dropped = row.least == "0.01" || row.least == "0.01 + 1e-14"; // 1e-24 of energy
      EXPECT_TRUE(!is_dropped || pressure == 0.) << value << ' ' << adapt;
      EXPECT_LT(last, 2e-9 * first) << value << ' ' << adapt;
      EXPECT_LT(seconds, 10.) << value << ' ' << adapt;
    }
}

/** What is exact on the coarse mesh, as no load at all, leaves the mesh to the next load step. */
TEST(LoadHistory, AdaptsInTheFirstLoadStepThatHasAnError)
{
  std::vector<std::string> stopped_by;
  std::vector<unsigned int> elements;
  LoadHistory<2>(bar(5, "0.03*max(0, t - 0.3)^2", {{"Adaptivity/Maximum steps", "4"}}))
      .run(
          [&](const StepReport<2> &step)
          {
            if (step.stopped_by.empty())
              return;
            stopped_by.push_back(text(step.stopped_by));
            elements.push_back(step.solution().displacement_space.degrees().size());
          });
  EXPECT_EQ(stopped_by[0], "round-off");
  EXPECT_EQ(stopped_by[1], "Maximum steps");
  EXPECT_EQ(elements[0], 8U);
  EXPECT_GT(elements[1], 8U);
  for (unsigned int k = 2; k < 5; ++k)
  {
    EXPECT_EQ(elements[k], elements[1]);
    EXPECT_TRUE(stopped_by[k] == "error of load step 2" || stopped_by[k] == "Adapt = first step")
        << stopped_by[k];
  }
}

/** @p scene load step by load step, as LoadHistory does it, with the factor of the last one or its own. */
std::vector<State> chain(const Scene<2> &scene, const bool keeps, unsigned int &kept)
{
  std::vector<State> states;
  std::vector<std::shared_ptr<const Scene<2>>> scenes; // solutions refer to them
  std::unique_ptr<AdaptiveSolver<2>> solver;
  PastSlip<2> past;
  for (unsigned int k = 1; k <= scene.loading.steps; ++k)
  {
    auto next = std::make_shared<Scene<2>>(scene.loading.at(scene.loading.time(k)));
    scenes.push_back(next);
    if (!keeps && solver)
      AdaptiveSolver<2> thief(*next, *solver, past); // the factor is handed over once
    solver = k == 1 ? std::make_unique<AdaptiveSolver<2>>(*next)
                    : std::make_unique<AdaptiveSolver<2>>(*next, *solver, past);
    bool is_factored = false;
    solver->run(
        [&](const StepReport<2> &step)
        {
          const Solution<2> &solution = step.solution();
          states.push_back({{}, solution.u, solution.z, 0, 0, 0., 0., 0., 0., {}});
          past = past_slip(solution.contact_space, solution.displacement_space, solution.tables,
                           solution.u);
        },
        [&](const Progress &progress)
        { is_factored = is_factored || progress.stage.find("factorising") == 0; });
    kept += !is_factored;
  }
  return states;
}

/** Of one mesh: to the last bit what it would be with a factor of its own. */
TEST(LoadHistory, KeepsTheFactorWhileTheMatrixStays)
{
  struct Case
  {
    Overrides entries;
    unsigned int kept; ///< of six load steps: the second is the first to find one
  };
  const std::vector<Case> cases = {
      {{}, 4},
      {{{"Boundary bottom/Friction bound", "0.1*(1 + t)"},
        {"Boundary top/Traction", "0; -t"},
        {"Body force/Expression", "0; -0.1*t"}},
       4},
      {{{"Boundary bottom/Friction bound", "if(t < 0.6 | x > 2, 0.1, 0)"}}, 3}, // edges lose it
      {{{"Boundary bottom/Friction bound", // as many, but others
         "if(t < 0.6, if(x < 2, 0.1, 0), if(x > 2, 0.1, 0))"}},
       3},
      {{{"Boundary bottom/Contact", "unilateral"},
        {"Boundary bottom/Gap", "-0.01*t"},
        {"Boundary right/Displacement", ""}, // contact alone holds the body
        {"Boundary right/Traction", "0.3*t; 0"},
        {"Boundary top/Traction", "0; -0.2"}},
       4},
      {{given::coulomb("0.3"), {"Boundary top/Traction", "0; -0.2"}}, 4}};
  for (const Case &one : cases)
  {
    const Scene<2> scene = bar(6, "0.03*sin(6*t)", one.entries);
    unsigned int kept = 0, never = 0;
    const std::vector<State> with = chain(scene, true, kept), without = chain(scene, false, never),
                             history = evolution(scene);
    const unsigned int which = &one - cases.data();
    EXPECT_EQ(kept, one.kept) << which;
    EXPECT_EQ(never, 0U);
    for (unsigned int k = 0; k < 6; ++k)
    {
      EXPECT_EQ(with[k].u, without[k].u) << which << ", " << k;
      EXPECT_EQ(with[k].z, without[k].z) << which << ", " << k;
      EXPECT_EQ(with[k].u, history[k].u) << which << ", " << k;
    }
  }
}

TEST(LoadHistory, IsNoMatterOfASingleRun)
{
  const Scene<2> history = bar(3, "0.03*t");
  EXPECT_THROW(AdaptiveSolver<2>{history}, InputError);
  EXPECT_THROW(AdaptiveSolver<2>(history, RunState<2>()), InputError);
  Scene<2> incomplete = history;
  incomplete.loading.at = nullptr;
  EXPECT_THROW(LoadHistory<2>{incomplete}, InputError);
  incomplete = history;
  incomplete.loading.steps = 0;
  EXPECT_THROW(LoadHistory<2>{incomplete}, InputError);
  unsigned int steps = 0; // without history it is that run
  LoadHistory<2>(history.loading.at(1))
      .run(
          [&](const StepReport<2> &step)
          {
            EXPECT_EQ(step.load.number, 0U);
            ++steps;
          });
  EXPECT_EQ(steps, 1U);
}

/** What happens while @p scene runs, and in how many load steps it gets through. */
std::string failure(const Scene<2> &scene, unsigned int &finished)
{
  return failure_of<std::exception>(
      [&] {
        LoadHistory<2>(scene).run([&](const StepReport<2> &step) { finished = step.load.number; });
      });
}

TEST(LoadHistory, SaysInWhichLoadStepItFailed)
{
  // Friction alone holds the bar, with up to 0.4.
  unsigned int finished = 0;
  const std::string line = failure(
      bar(10, "free", {{"Boundary right/Displacement", ""}, {"Boundary right/Traction", "t; 0"}}),
      finished);
  EXPECT_EQ(finished, 8U);
  EXPECT_EQ(line.find("load step 9, t = 0.9: no equilibrium"), 0U) << line;
  // A pole between the points at which expressions are tried.
  const std::string pole =
      failure(bar(10, "0.03*t",
                  {{"Boundary top/Traction", "if(abs(t - 0.3) < 0.01 & x > 1.01 & x < 1.12, 1/0, "
                                             "0.001); 0"}}),
              finished);
  EXPECT_EQ(finished, 2U) << pole;
  EXPECT_NE(pole.find("t = 0.3"), std::string::npos) << pole;
}

TEST(LoadHistory, RemembersTheWarningsOfAllLoadSteps)
{
  std::vector<std::string> last;
  unsigned int earlier = 0;
  double worst = 0, share = 0;
  std::string where;
  LoadHistory<2>(
      bar(4, "0.03*t",
          {{"Boundary top/Traction", "0; if(t < 0.4, 0.01 - x/100, if(t < 0.9, 0.2 - x/20, -5))"}}))
      .run(
          [&](const StepReport<2> &step)
          {
            last = texts(step.warnings);
            for (const std::string &warning : step.load.number < 4 ? last : decltype(last)())
              if (std::sscanf(warning.c_str(), "bilateral contact pulls: %lf", &share) == 1)
              {
                ++earlier;
                if (share > worst)
                {
                  worst = share;
                  where = "(load step " + std::to_string(step.load.number) + ",";
                }
              }
          });
  EXPECT_EQ(earlier, 3U);
  EXPECT_EQ(std::count_if(last.begin(), last.end(),
                          [](const std::string &warning)
                          { return warning.find("bilateral contact pulls") == 0; }),
            1);
  for (const std::string &warning : last)
    if (std::sscanf(warning.c_str(), "bilateral contact pulls: %lf", &share) == 1)
    {
      EXPECT_EQ(share, worst) << warning; // of the worst load step, which is not the first
      EXPECT_NE(warning.find(where), std::string::npos) << warning;
      EXPECT_EQ(warning.find("(load step 1,"), std::string::npos) << warning;
    }
}

struct History
{
  std::string name;
  Overrides entries;
};

using Balance = ::testing::TestWithParam<History>;

/** External work is what is stored, dissipated and released, through refinement too. */
TEST_P(Balance, HoldsInEachLoadStep)
{
  Overrides entries = {given::quadrilateral("Geometry", "0, 0; 4, -0.5; 3.5, 1.5; 0.2, 1", "4, 1"),
                       {"Material/Young's modulus", "10"},
                       given::steps("hpa2", "2"),
                       {"Adaptivity/Tolerance", "1e-9"},
                       {"Loading/Steps", "6"}};
  entries.insert(entries.end(), GetParam().entries.begin(), GetParam().entries.end());
  const std::vector<State> states = evolution(scene_of(entries));
  ASSERT_EQ(states.size(), 6U);
  double last = 0;
  for (const State &state : states)
  {
    EXPECT_NEAR(state.load.work,
                state.load.dissipated + state.load.stored + state.load.released +
                    state.load.unbalanced,
                1e-10 * states.back().load.work)
        << "t = " << state.load.t;
    EXPECT_GE(state.load.dissipated, last - 1e-14 * states.back().load.work);
    last = state.load.dissipated;
  }
  EXPECT_GT(last, 1e-3 * states.back().load.work);
  EXPECT_GT(states.back().n_elements, states.front().n_elements);
  const double unbalanced = std::abs(states.back().load.unbalanced);
  EXPECT_GT(unbalanced, 1e-9 * states.back().load.work);
  EXPECT_LT(unbalanced, 1e-2 * states.back().load.work);

  entries.push_back({"Adaptivity/Maximum steps", "1"});
  const std::vector<State> on_one_mesh = evolution(scene_of(entries));
  const double all = on_one_mesh.back().load.work;
  for (const State &state : on_one_mesh)
  {
    const LoadStep &load = state.load;
    EXPECT_NEAR(load.unbalanced, 0, 1e-12 * all) << "t = " << load.t;
    EXPECT_NEAR(load.work, load.dissipated + load.stored + load.released, 1e-11 * all)
        << "t = " << load.t;
  }
}

const Overrides shears = {
    {"Boundary top/Displacement", "0.1*sin(6*t); -0.01*t + 0.003*x*t*sin(9*t)"}};

INSTANTIATE_TEST_SUITE_P(
    Contacts, Balance,
    ::testing::Values(
        History{"bilateral",
                with(shears, {given::rough("bottom", "bilateral", "0.02*(1 + t)*(1 + x)")})},
        History{"tangential", with(shears, {given::rough("bottom", "tangential", "0.1"),
                                            {"Body force/Expression", "0; -0.1*t"}})},
        History{"nodes", with(shears, {given::rough("bottom", "unilateral", "0.05*(2 - t)"),
                                       {"Boundary bottom/Gap", "0.002*x - 0.01*t"}})},
        History{"multiplier", with(shears, {given::rough("bottom", "unilateral", "0.05"),
                                            {"Boundary bottom/Gap", "0.002*x - 0.01*t^2"},
                                            {"Solver/Normal contact", "multiplier"}})},
        History{"coulomb", with(shears, {{"Boundary bottom/Contact", "unilateral"},
                                         {"Boundary bottom/Friction coefficient", "0.3"},
                                         {"Boundary bottom/Gap", "0.002*x - 0.01*t"}})},
        History{"coulomb_bilateral",
                with(shears, {{"Boundary bottom/Contact", "bilateral"},
                              {"Boundary bottom/Friction coefficient", "0.3"}})},
        History{"loads",
                {given::rough("bottom", "bilateral", "0.1"),
                 {"Boundary right/Displacement", "0.01*t*(1 + y^2); free"},
                 {"Boundary left/Traction", "0.5*sin(8*t); 0.1"},
                 {"Body force/Expression", "0.1*t; -0.1"}}}));

/** Both load steps of a block that is pressed, pushed to the right and back. */
Scene<2> pushed_and_back(const Overrides &entries)
{
  return scene_of(with({{"Geometry/Upper corner", "2, 1"},
                        {"Geometry/Subdivisions", "4, 2"},
                        {"Material/Young's modulus", "100"},
                        {"Material/Poisson's ratio", "0.3"},
                        {"Loading/Steps", "2"},
                        {"Boundary top/Displacement", "if(t < 0.7, 0.04, 0.015); -0.03"},
                        {"Error/Bound", "true"}},
                       entries));
}

/**
 * In the second load step the bound is one for the slip that the first has computed: it is above the error, by a solution with
 * this past that is far finer.
 */
TEST(LoadHistory, HasABoundForTheComputedPast)
{
  const std::string file =
      (std::filesystem::temp_directory_path() / "hpvi-past-reference").string();
  const Overrides coarse{given::steps("hup2", "1")},
      fine{given::steps("hup3", "3"), {"Error/Bound", "false"}};
  struct Row
  {
    Overrides entries;
    double most; ///< bound over error
  };
  for (const Row &row :
       {Row{given::rough("bottom", "bilateral", "1.2"), 2.},
        Row{with(given::rough("bottom", "unilateral", "0.8 + 0.3*x"),
                 {{"Boundary bottom/Gap", "0.004*(x - 1)^2"}}),
            3.},
        Row{with(given::coulomb("0.4"), {{"Boundary bottom/Contact", "unilateral"}}), 4.}})
  {
    PastSlip<2> past;
    LoadHistory<2>(pushed_and_back(with(row.entries, coarse)))
        .run(
            [&](const StepReport<2> &step)
            {
              const Solution<2> &solution = step.solution();
              if (step.load.number == 1)
                past = past_slip(solution.contact_space, solution.displacement_space,
                                 solution.tables, solution.u);
            });
    const Scene<2> finer = pushed_and_back(with(row.entries, fine));
    const Scene<2> first = load_step(finer, 1, {}), second = load_step(finer, 2, data_scale(first));
    AdaptiveSolver<2> before(first);
    before.run([](const StepReport<2> &) {});
    AdaptiveSolver<2>(second, before, past)
        .run(
            [&](const StepReport<2> &step)
            {
              std::ofstream out(file);
              write_solution(out, step.field, step.energies.energy);
            });
    Scene<2> compared = second;
    compared.reference_solution = file;
    const TrueError<2> error(compared);
    unsigned int n_bounds = 0;
    LoadHistory<2>(pushed_and_back(with(row.entries, coarse)))
        .run(
            [&](const StepReport<2> &step)
            {
              ASSERT_TRUE(step.bound) << step.no_bound;
              if (step.load.number == 1)
              {
                EXPECT_NE(step.bound->kind, BoundKind::history);
                return;
              }
              ++n_bounds;
              const double distance = error.measure(step.field, step.contact).energy;
              EXPECT_EQ(step.bound->kind, BoundKind::history) << step.bound->why;
              EXPECT_TRUE(std::isnan(step.bound->energy_below));
              EXPECT_GT(step.bound->total, distance);
              EXPECT_LT(step.bound->total, row.most * distance);
            });
    EXPECT_GT(n_bounds, 0U);
    std::filesystem::remove(file);
  }
}

/** Where tractions are given, what the first load step has computed is no part of them: a reason in place of a bound. */
TEST(LoadHistory, SaysWhyJointsCurvesAndAxesHaveNoLaterBound)
{
  for (const auto &[name, entries] :
       {std::pair<std::string, Overrides>{"blocks",
                                          {{"Boundary upper.top/Displacement", "0.03*t; -0.02"}}},
        {"askew", {}},
        {"brake-shoe", {}},
        {"sleeve", {}}})
  {
    SCOPED_TRACE(name);
    unsigned int n_later = 0;
    LoadHistory<2>(shipped_scene(name, with({{"Loading/Steps", "2"},
                                             {"Adaptivity/Maximum steps", "1"},
                                             {"Error/Bound", "true"}},
                                            entries)))
        .run(
            [&](const StepReport<2> &step)
            {
              if (step.load.number == 1)
                return;
              ++n_later;
              EXPECT_FALSE(step.bound);
              EXPECT_EQ(step.no_bound, "friction between bodies, along curves and directions and "
                                       "around an axis counts slip from the load step before");
            });
    EXPECT_GT(n_later, 0U);
  }
}
} // namespace
