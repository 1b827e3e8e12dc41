// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/cut_rule.h>
#include <hpvi/base/text.h>
#include <hpvi/bound/test_motion.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
Tensor<1, 2> turned(const Tensor<1, 2> &n)
{
  return Point<2>(-n[1], n[0]);
}

/** Of what is along the normal of a boundary without prescribed displacements. */
TractionKind normal_kind(const BoundaryCondition<2> &boundary)
{
  if (boundary.is_unilateral())
    return TractionKind::pressure;
  if (boundary.symmetry || boundary.contact == Contact::bilateral || boundary.is_tied())
    return TractionKind::reaction;
  return TractionKind::given;
}
} // namespace

bool is_straight(const Side<2> &side)
{
  for (unsigned int piece = 0; piece < side.pieces.size(); ++piece)
    for (const double s : {0., 0.2, 0.4, 0.5, 0.6, 0.8, 1.})
      if ((side.normal(piece, s) - side.normal(0, 0.5)).norm() > 1e-9)
        return false;
  return true;
}

std::array<TractionAlong, 2> tractions_of(const BoundaryCondition<2> &boundary,
                                          const Tensor<1, 2> &normal)
{
  const Tensor<1, 2> x = Point<2>(1, 0), y = Point<2>(0, 1);
  const TractionKind reaction = TractionKind::reaction, given = TractionKind::given;
  if (boundary.plate || boundary.spring)
    return {{{x, reaction}, {y, reaction}}};
  if (boundary.has_displacement() && (boundary.has_contact() || boundary.symmetry))
    return {{{x, reaction}, {y, reaction}}}; // askew to each other
  if (boundary.has_displacement())
    return {{{x, boundary.displacement[0] ? reaction : given},
             {y, boundary.displacement[1] ? reaction : given}}};
  const Tensor<1, 2> held = boundary.held_direction(normal);
  return {{{held, normal_kind(boundary)},
           {turned(held), boundary.is_tied()  ? reaction
                          : boundary.friction ? TractionKind::friction
                                              : given}}};
}

/** `direction . w = value` at a point. */
struct TestMotion::Row
{
  unsigned int boundary;
  Tensor<1, 2> direction;
  double value;
  TractionKind kind;
};

/** A point at which boundaries end. */
struct TestMotion::Meeting
{
  Point<2> at;
  std::vector<unsigned int> boundaries;
};

TestMotion::TestMotion(const Scene<2> &scene, const std::vector<Side<2>> &sides,
                       const unsigned int boundary, const BoundaryMotion resultant)
    : original(scene), sides(sides), goal(boundary),
      body(scene.geometry.body_of_side(scene.boundaries[boundary].side)), resultant(resultant)
{
  for (const Side<2> &side : sides)
    turns.push_back(!side.pieces.empty() && !is_straight(side));
  const std::string &name = scene.boundaries[goal].name;
  const bool is_along =
      resultant == BoundaryMotion::normal || resultant == BoundaryMotion::tangential;
  if (turns[goal] && is_along)
    why_not = "forces along the normal of " + name + ", which has more than one";
  for (const BoundaryCondition<2> &other : scene.boundaries)
    if (turns[other.id] && other.has_traction() &&
        (other.has_contact() || other.symmetry || other.spring))
      why_not = "forces on bodies of which " + other.name + " has loads and more than one normal";
  for (const Meeting &meeting : meetings())
    if (why_not.empty())
      meet(meeting);
}

const std::string &TestMotion::flaw() const
{
  return why_not;
}

const std::vector<TestMotion::Fall> &TestMotion::falls() const
{
  return all_falls;
}

bool TestMotion::is_zero() const
{
  const auto &pieces = sides[goal].pieces;
  if (pieces.empty())
    return true;
  for (const auto &end : pieces.front())
    for (const Row &row : rows(goal, end))
      if (row.kind != TractionKind::given &&
          (resultant == BoundaryMotion::moment || std::abs(row.value) > 1e-12))
        return false;
  return true;
}

double TestMotion::largest() const
{
  double result = 0;
  for (const auto &piece : sides[goal].pieces)
    for (const auto &end : piece)
      result = std::max(result, motion(goal, end).norm());
  return result;
}

bool TestMotion::turns_along_curve() const
{
  return turns[goal] && resultant == BoundaryMotion::moment && original.geometry.has_curves();
}

Tensor<1, 2> TestMotion::motion(const unsigned int boundary, const Point<2> &x) const
{
  Tensor<1, 2> result;
  if (boundary != goal)
    return result;
  switch (resultant)
  {
  case BoundaryMotion::x:
    result[0] = 1;
    break;
  case BoundaryMotion::y:
    result[1] = 1;
    break;
  case BoundaryMotion::moment:
    return turned(x - original.geometry.centre());
  case BoundaryMotion::normal:
    return original.boundaries[goal].held_direction(sides[goal].normal(x));
  case BoundaryMotion::tangential:
    return turned(original.boundaries[goal].held_direction(sides[goal].normal(x)));
  case BoundaryMotion::none:
    break;
  }
  return result;
}

std::vector<TestMotion::Row> TestMotion::rows(const unsigned int boundary, const Point<2> &x) const
{
  std::vector<Row> result;
  const Tensor<1, 2> wanted = motion(boundary, x);
  const BoundaryCondition<2> &condition = original.boundaries[boundary];
  std::array<TractionAlong, 2> parts = tractions_of(condition, sides[boundary].normal(x));
  if (turns[boundary] && (condition.has_contact() || condition.symmetry))
    parts = {{{Point<2>(1, 0), TractionKind::reaction}, {Point<2>(0, 1), TractionKind::reaction}}};
  for (const TractionAlong &part : parts)
    result.push_back({boundary, part.direction, part.direction * wanted, part.kind});
  return result;
}

std::vector<TestMotion::Meeting> TestMotion::meetings() const
{
  const double near = 1e-9 * original.geometry.diameter();
  std::vector<Meeting> result;
  const auto at = [&](const Point<2> &x) -> Meeting &
  {
    for (Meeting &known : result)
      if (known.at.distance(x) < near)
        return known;
    return result.emplace_back(Meeting{x, {}});
  };
  const auto &all = original.boundaries;
  for (unsigned int a = 0; a < all.size(); ++a)
    for (unsigned int b = 0; b < all.size(); ++b)
      if (a != b && original.geometry.body_of_side(all[a].side) == body &&
          original.geometry.body_of_side(all[b].side) == body)
        for (const Point<2> &x : common_points(sides[a], sides[b]))
        {
          auto &met = at(x).boundaries;
          if (std::find(met.begin(), met.end(), a) == met.end())
            met.push_back(a);
        }
  return result;
}

// @sect3{Where boundaries meet}
//
// What reactions ask of w must hold; what pressure and friction ask is met as far as that leaves a choice.
void TestMotion::meet(const Meeting &meeting)
{
  std::vector<Row> all;
  for (const unsigned int b : meeting.boundaries)
    for (const Row &row : rows(b, meeting.at))
      if (row.kind != TractionKind::given)
        all.push_back(row);
  std::stable_sort(all.begin(), all.end(),
                   [](const Row &a, const Row &b) { return a.kind > b.kind; });
  Tensor<1, 2> w;
  std::vector<Tensor<1, 2>> basis;
  for (const Row &row : all)
  {
    Tensor<1, 2> rest = row.direction;
    for (const Tensor<1, 2> &q : basis)
      rest -= (rest * q) * q;
    if (rest.norm() < 1e-6)
      continue;
    const Tensor<1, 2> q = rest / rest.norm();
    w += (row.value - row.direction * w) / (row.direction * q) * q;
    basis.push_back(q);
  }
  const double tolerance =
      1e-9 * std::max(1., resultant == BoundaryMotion::moment ? original.geometry.diameter() : 1.);
  for (const Row &row : all)
  {
    const double missed = row.direction * w - row.value;
    if (std::abs(missed) <= tolerance)
      continue;
    if (row.kind == TractionKind::reaction)
    {
      std::vector<std::string> names;
      for (const unsigned int b : meeting.boundaries)
        names.push_back(original.boundaries[b].name);
      std::sort(names.begin(), names.end());
      std::string all_names;
      for (const std::string &name : names)
        all_names += (all_names.empty() ? "" : " and ") + name;
      why_not =
          "what each of " + all_names + " carries where they meet, at " + to_string(meeting.at);
      return;
    }
    const Side<2> &side = sides[row.boundary];
    Tensor<1, 2> towards = turned(side.normal(meeting.at));
    for (const auto &piece : side.pieces)
      for (unsigned int end = 0; end < 2; ++end)
        if (piece[end].distance(meeting.at) < 1e-9 * original.geometry.diameter())
          towards = (piece[1 - end] - piece[end]) / piece[0].distance(piece[1]);
    all_falls.push_back({row.boundary, meeting.at, missed * row.direction, towards, row.kind});
  }
}

double TestMotion::Fall::work(const Scene<2> &scene, const double l) const
{
  if (kind != TractionKind::friction)
    return 0.;
  constexpr unsigned int n_points = 16, n_parts = 32; // as many samples as loads have along a side
  const FrictionLaw<2> &friction = scene.boundaries[boundary].friction;
  const CutRule rule = make_cut_rule(
      [&](const double s)
      {
        const Point<2> x = from + s * l * towards;
        return (1 - s) * scene.circumference(x) * friction.bound_at(x);
      },
      QGauss<1>(n_points), {0, 1, 2}, n_parts);
  return offset.norm() * l * (std::max(rule.integral(), rule.finer_integral) + rule.deviation);
}

TestMotion::TestMotion(const TestMotion &other, const Fall &fall)
    : original(other.original), sides(other.sides), turns(other.turns), goal(fall.boundary),
      body(other.body), resultant(BoundaryMotion::none), all_falls({fall})
{
}

TestMotion TestMotion::pressing(const Fall &fall, const double l) const
{
  constexpr unsigned int n_samples = 512; // as many as loads have along a side
  const BoundaryCondition<2> &boundary = original.boundaries[fall.boundary];
  double largest = 0;
  for (unsigned int i = 0; i <= n_samples; ++i)
    largest = std::max(
        largest, boundary.friction.coefficient_at(fall.from + l * i / n_samples * fall.towards));
  const Tensor<1, 2> n = boundary.held_direction(sides[fall.boundary].normal(fall.from));
  TestMotion result(*this, {fall.boundary, fall.from, largest * fall.offset.norm() * n,
                            fall.towards, TractionKind::pressure});
  for (const Meeting &meeting : meetings())
    if (meeting.at.distance(fall.from) < 1e-9 * original.geometry.diameter())
      for (const unsigned int b : meeting.boundaries)
        for (const Row &row : rows(b, meeting.at))
          if (b != fall.boundary && row.kind != TractionKind::given &&
              std::abs(row.direction * n) > 1e-9)
            result.why_not = "the friction of " + boundary.name + " and what " +
                             original.boundaries[b].name + " carries where they meet, at " +
                             to_string(meeting.at);
  return result;
}

std::vector<double> TestMotion::kinks(const unsigned int boundary, const Point<2> &begin,
                                      const Point<2> &end, const std::vector<double> &l) const
{
  std::vector<double> result = {0., 1.};
  bool is_at_rest = boundary != goal;
  for (unsigned int k = 0; k < all_falls.size(); ++k)
    if (all_falls[k].boundary == boundary)
    {
      const double b = all_falls[k].from.distance(begin), e = all_falls[k].from.distance(end);
      is_at_rest = is_at_rest && std::min(b, e) >= l[k];
      if (const double s = (l[k] - b) / (e - b); s > 0 && s < 1)
        result.push_back(s);
    }
  return is_at_rest ? std::vector<double>() : result;
}

unsigned int TestMotion::body_number() const
{
  return body;
}

std::vector<PointCondition<2>> TestMotion::conditions(const unsigned int boundary,
                                                      const Point<2> &x,
                                                      const std::vector<double> &l) const
{
  std::vector<PointCondition<2>> result;
  if (original.geometry.body_of_side(original.boundaries[boundary].side) != body)
    return result;
  for (const Row &row : rows(boundary, x))
  {
    if (row.kind == TractionKind::given)
      continue;
    double value = row.value;
    for (unsigned int k = 0; k < all_falls.size(); ++k)
      if (all_falls[k].boundary == boundary)
        value += row.direction * all_falls[k].offset *
                 std::max(0., 1 - x.distance(all_falls[k].from) / l[k]);
    result.push_back({row.direction, value, boundary});
  }
  return result;
}
} // namespace hpvi
