// SPDX-License-Identifier: LGPL-2.1-or-later
#include "relations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace metamorphic
{
namespace
{
using Claim = Relation::Claim;

/** Another discretisation, or a side that touches nothing, has another bound, a few times as large or none. */
Tolerances otherwise()
{
  Tolerances result;
  result.bound = 4;
  result.same_bounds = false;
  return result;
}

/**
 * The correction w that the bound counts is sought with conditions at points where it nearly fails them, and round-off decides
 * which: 2 gap + |w|^2, which it makes least, agrees to 1e-10, |w| alone, which the bound counts beside oscillation, to 1e-5.
 */
Tolerances in_another_frame()
{
  Tolerances result;
  result.bound = 1e-4;
  return result;
}

class Relations
{
public:
  Relations(const RandomScene &scene, std::mt19937 &random) : scene(scene), random(random)
  {
  }

  void tell_in_another_way();
  void solve_otherwise();
  void take_the_primal_path();
  void say_what_says_nothing();
  void hold_without_friction();
  void carry_along();
  void meet_another_method();

  std::vector<Relation> result;

private:
  using Settings = std::map<std::string, std::string>;

  RandomScene without_friction() const;
  bool has_history() const
  {
    return scene.settings.count("Loading/Steps") > 0;
  }

  void add(const std::string &name, const RandomScene &one, const RandomScene &other,
           const Claim claim = Claim::same)
  {
    result.push_back({name, one, other, other.own_frame(), claim, otherwise()});
  }

  void vary(const std::string &name, const Settings &settings, const Claim claim = Claim::same)
  {
    RandomScene other = scene;
    for (const auto &[entry, value] : settings)
      other.settings[entry] = value;
    add(name, scene, other, claim);
  }

  const RandomScene &scene;
  std::mt19937 &random;
};

/** A box is given by two corners: then its lower side is the bottom. */
void write_box(Frame &frame, const RandomScene &scene)
{
  frame.writes_box = frame.writes_box && scene.is_box && frame.keeps_axes();
  for (unsigned int k = 0; k < 4 && frame.writes_box; ++k)
  {
    frame.first = k;
    const unsigned int start = frame.corner(0);
    const Tensor<1, 2> across = frame.Q * (scene.corners[(start + 2) % 4] - scene.corners[start]);
    if (across[0] > 0 && across[1] > 0)
      return;
  }
}

void Relations::tell_in_another_way()
{
  for (unsigned int k = 0; k < 2; ++k)
  {
    add("told in another way", scene, scene);
    result.back().frame = random_frame(scene.own_frame(), scene.needs_axes(), random);
    result.back().tolerances = in_another_frame();
    write_box(result.back().frame, scene);
  }
}

void Relations::solve_otherwise()
{
  if (scene.has(&Side::coefficient))
    vary("the fixed point", {{"Solver/Coulomb solver", "fixed point"}});
  else
    vary("the other solver",
         {{"Solver/QP solver",
           scene.settings.at("Solver/QP solver") == "mprgp" ? "active set" : "mprgp"}});
  vary("a cold start", {{"Solver/QP warm start", "false"}, {"Solver/Diagonal scaling", "false"}});
  if (!has_history())
    vary("a history of one load step", {{"Loading/Steps", "1"}});
}

/** Both paths have rules of their own for data that are no polynomials; bodies held by contact alone it refuses. */
void Relations::take_the_primal_path()
{
  const std::string method = scene.settings.at("Adaptivity/Method").substr(0, 3);
  if (scene.is_box && scene.is_isotropic() && scene.is_held() && !scene.has(&Side::coefficient) &&
      !has_history() && !scene.has_direction() && !scene.has_plates() && !scene.has_springs() &&
      !scene.has_initial_strain() && (method == "hup" || method == "hap") &&
      scene.has_polynomial_data() && scene.settings.at("Solver/Normal contact") == "multiplier")
    vary("the primal path", {{"Solver/Path", "primal"}}, Claim::same_primal);
}

/** A bound of zero, and an obstacle that nothing reaches. */
void Relations::say_what_says_nothing()
{
  if (scene.has_plates()) // nothing may hold what they are free to move
    return;
  RandomScene other = scene;
  bool is_said = false;
  for (Side &side : other.sides)
    if (!side.contact.empty() && side.bound.empty() && side.coefficient.empty())
    {
      side.bound = "0";
      is_said = true;
    }
    else if (scene.is_held() && side.contact.empty() && side.displacement[0].empty() &&
             side.displacement[1].empty() && side.spring[0].empty())
    {
      side.contact = "unilateral";
      side.gap = "10"; // counts in round-off
      is_said = true;
    }
  if (!is_said)
    return;
  add("data that say nothing", scene, other);
  result.back().tolerances.same_multipliers = false;
}

RandomScene Relations::without_friction() const
{
  RandomScene result = scene;
  for (Side &side : result.sides)
  {
    side.bound = side.coefficient = side.law = "";
    if (side.contact == "tangential")
    {
      side.contact = "";
      side.turn.reset();
    }
  }
  return result;
}

/** Bilateral contact without friction is a support of one component. */
void Relations::hold_without_friction()
{
  RandomScene one = without_friction();
  if (scene.has_plates() || !one.is_box || one.sides[0].contact.empty())
    return;
  one.sides[0].contact = "bilateral";
  one.sides[0].gap = "";
  one.sides[0].turn.reset();
  RandomScene other = one;
  other.sides[0].contact = "";
  other.sides[0].displacement[1] = "0";
  add("a support for bilateral contact", one, other);
  result.back().tolerances.same_multipliers = false;
}

/** Supports and foundations move together. */
void Relations::carry_along()
{
  const RandomScene one = without_friction();
  RandomScene other = one;
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  const Tensor<1, 2> motion({uniform(random), uniform(random)});
  for (Side &side : other.sides)
  {
    if (side.contact == "bilateral" || side.displacement[0].empty() != side.displacement[1].empty())
      return;
    for (unsigned int c = 0; c < 2 && !side.displacement[c].empty(); ++c)
      side.displacement[c] = "(" + side.displacement[c] + ") + " + text(motion[c]);
    const double u_n = motion * scene.contact_direction(side);
    if (!side.contact.empty())
      side.gap = (side.gap.empty() ? "" : "(" + side.gap + ") + ") + text(u_n);
  }
  if (!has_history() && !scene.has_springs())
    add("supports and foundations that move together", one, other, Claim::same_moved);
}

void Relations::meet_another_method()
{
  if (has_history() || scene.has(&Side::coefficient) || scene.has_direction())
    return; // no intervals of energy
  const std::array<std::string, 5> methods = {{"hup3", "hap2", "pu", "hpa2", "hpa3"}};
  vary("another method",
       {{"Adaptivity/Method", methods[random() % methods.size()]},
        {"Adaptivity/Indicator", "bound"},
        {"Solver/Normal contact",
         scene.settings.at("Solver/Normal contact") == "nodes" ? "multiplier" : "nodes"}},
       Claim::overlapping);
}
} // namespace

std::vector<std::string> Relation::flaws(Outcome first, Outcome second) const
{
  if (claim == Claim::overlapping)
    return disjoint_intervals(first, second);
  if (claim == Claim::same_moved)
    for (Outcome *const outcome : {&first, &second})
      for (StepOutcome &step : outcome->steps)
        step.energy = step.lagrangian = unknown;
  if (claim == Claim::same_primal)
    return energy_differences(first, second, tolerances);
  return differences(first, second, tolerances);
}

std::vector<Relation> relations(const RandomScene &scene, std::mt19937 &random)
{
  Relations all(scene, random);
  all.tell_in_another_way();
  all.solve_otherwise();
  all.take_the_primal_path();
  all.say_what_says_nothing();
  all.hold_without_friction();
  all.carry_along();
  all.meet_another_method();
  return all.result;
}
} // namespace metamorphic
