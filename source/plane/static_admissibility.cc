// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/base/numbers.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/plane/failure_mechanism.h>
#include <hpvi/plane/static_admissibility.h>
#include <hpvi/solvers/equality_constraints.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Tractions at points, each with a factor between two sides: what contact can do is their sum. */
template <int dim>
struct Tractions
{
  std::vector<Point<dim>> x;
  std::vector<Tensor<1, dim>> direction; ///< of the displacement that it works on
  std::vector<unsigned int> cell;        ///< of its face; none for a part of a multiplier
  std::vector<TouchingBodies> bodies;
  TouchingBodies here; ///< of what is added next
  FeasibleSet factors;

  void add(const Point<dim> &point, const Tensor<1, dim> &traction, const double lower,
           const double upper, const unsigned int at = none)
  {
    x.push_back(point);
    bodies.push_back(here);
    direction.push_back(traction);
    cell.push_back(at);
    factors.add_interval(lower, upper);
  }

  /**
   * Pressure with friction that needs it: the sides of the cone, `n + mu t` and `n - mu t`, up to the largest
   * friction @p most, from where on `n` alone is left.
   */
  void add_cone(const Point<dim> &point, const Tensor<1, dim> &normal,
                const Tensor<1, dim> &tangent, const double mu, const double most,
                const unsigned int at = none)
  {
    for (const double sign : {-1., 1.})
      add(point, normal + sign * mu * tangent, 0., mu > 0. ? most / mu : infinity, at);
    if (std::isfinite(most))
      add(point, normal, 0., infinity, at);
  }
};

template <int dim>
Tractions<dim> on_this_mesh(const ContactSpace<dim> &contact_space)
{
  using Kind = typename ContactMultiplier<dim>::Kind;
  Tractions<dim> result;
  for (const ContactMultiplier<dim> &unknown : contact_space.multipliers())
  {
    result.here = unknown.bodies;
    if (unknown.is_bilateral || unknown.kind == Kind::pressure)
      result.add(unknown.x, unknown.direction, unknown.is_bilateral ? -infinity : 0., infinity);
    else if (unknown.partner == none)
      result.add(unknown.x, unknown.weight * unknown.direction, -unknown.friction.limit(0.),
                 unknown.friction.limit(0.));
    else
    {
      const FrictionLimit &friction = unknown.friction;
      if (const double cohesion = friction.limit(0.); cohesion > 0.)
        result.add(unknown.x, unknown.weight * unknown.direction, -cohesion, cohesion);
      result.add_cone(unknown.x, contact_space.multipliers()[unknown.partner].direction,
                      unknown.direction, friction.coefficient,
                      unknown.weight * (friction.most - friction.limit(0.)));
    }
  }
  return result;
}

/**
 * More than on any mesh: pressures act at points, where friction that has a largest value obeys either the
 * cone, or with @p capped that value on the whole face; with @p is_rough nothing slides.
 */
template <int dim>
Tractions<dim> on_any_mesh(const ContactSpace<dim> &contact_space, const bool capped = false,
                           const bool is_rough = false)
{
  Tractions<dim> result;
  for (const ContactFace<dim> &face : contact_space.faces())
  {
    const ContactFrame<dim> middle = face.frame(0.5);
    result.here = face.bodies;
    double most = 0;
    for (const PointLimit &point : face.limits)
      most += face.length * point.weight * point.friction.most;
    const bool is_capped = capped && std::isfinite(most);
    const double friction = face.condition->is_tied() || is_rough ? infinity
                            : is_capped                           ? most
                                        : face.friction_without_pressure();
    result.add(middle.x, middle.tangent, -friction, friction);
    if (!face.condition->has_pressure())
      continue;
    const unsigned int pieces = 8, cell = face.cell->active_cell_index();
    std::vector<double> points = face.normal_points;
    for (unsigned int k = 0; k <= pieces; ++k)
      points.push_back(double(k) / pieces);
    for (const double s : points)
    {
      const ContactFrame<dim> here = face.frame(s);
      result.add(here.x, here.normal, face.condition->is_unilateral() ? 0. : -infinity, infinity,
                 cell);
      if (face.condition->friction.knows_pressure() && !is_capped)
        result.add_cone(here.x, here.normal, here.tangent, face.friction_coefficient(here.x),
                        infinity, cell);
    }
  }
  return result;
}

/** Has friction a largest value anywhere, whatever presses? */
template <int dim>
bool has_cap(const ContactSpace<dim> &contact_space)
{
  return std::any_of(contact_space.multipliers().begin(), contact_space.multipliers().end(),
                     [](const ContactMultiplier<dim> &unknown)
                     { return unknown.partner != none && std::isfinite(unknown.friction.most); });
}

/** What @p traction does along a motion; round-off of a point where the motion ought to vanish is zero. */
template <int dim>
double work(const Tractions<dim> &tractions, const unsigned int i,
            const RigidBodyMotion<dim> &motion)
{
  const Point<dim> &x = tractions.x[i];
  const Tensor<1, dim> &traction = tractions.direction[i];
  const double product = traction * motion.jump(x, tractions.bodies[i]),
               terms = motion.largest_translation() +
                       motion.largest_rotation() * x.distance(motion.centre);
  return std::abs(product) <= 1e-13 * traction.norm() * terms ? 0. : product;
}

/** Along which of the first @p n motions, the others at rest, @p tractions cannot balance the loads. */
template <int dim>
std::optional<Imbalance> imbalance_of(const Tractions<dim> &tractions,
                                      const LoadedMotions<dim> &loaded, const unsigned int n)
{
  const unsigned int m = loaded.motions.size();
  EqualityConstraints balance{FullMatrix<double>(tractions.x.size(), m), loaded.loads};
  for (unsigned int i = 0; i < tractions.x.size(); ++i)
    for (unsigned int j = 0; j < n; ++j)
      balance.G(i, j) = work(tractions, i, loaded.motions[j]);
  return find_imbalance(tractions.factors, balance);
}

/** The largest rotation of the motions, about one over the size of the body. */
template <int dim>
double fastest_turn(const LoadedMotions<dim> &loaded)
{
  double turn = 0;
  for (const RigidBodyMotion<dim> &motion : loaded.motions)
    turn = std::max(turn, motion.largest_rotation());
  return turn;
}

/** What @p tractions resist with at most where those that press and rub without end do not act. */
template <int dim>
double bounded_resistance(const Tractions<dim> &tractions, const RigidBodyMotion<dim> &motion)
{
  double sum = 0;
  for (unsigned int i = 0; i < tractions.x.size(); ++i)
    if (std::isfinite(tractions.factors.upper_side(i)))
      sum += tractions.factors.upper_side(i) * std::abs(work(tractions, i, motion));
  return sum;
}

/** Of several bodies what moves less than a thousandth of the fastest rests; a rotation by @p turn moves as much as a translation by one. */
template <int dim>
void forget_small(RigidBodyMotion<dim> &motion, const double turn)
{
  const double least = 1e-3 * std::max(motion.largest_translation(),
                                       turn > 0 ? motion.largest_rotation() / turn : 0.);
  const auto forget = [&](RigidBodyMotion<dim> &one)
  {
    if (std::abs(one.rotation) < least * turn)
      one.rotation = 0;
    if (one.translation.norm() < least)
      one.translation = 0;
  };
  forget(motion);
  for (RigidBodyMotion<dim> &other : motion.others)
    forget(other);
}

/** The motion, without what is too small to be told. */
template <int dim>
RigidBodyMotion<dim> seen_motion(const LoadedMotions<dim> &loaded,
                                 const Vector<double> &coefficients)
{
  RigidBodyMotion<dim> motion = loaded.sum(coefficients);
  // A rotation about a far point is one more to read than a sliding body.
  if (motion.others.empty() &&
      std::abs(motion.rotation) < 0.1 * fastest_turn(loaded) * motion.translation.norm())
    motion.rotation = 0;
  if (!motion.others.empty())
    forget_small(motion, fastest_turn(loaded));
  return motion;
}

/** Does each contact open that moves at all? */
template <int dim>
bool opens(const ContactSpace<dim> &contact_space, const RigidBodyMotion<dim> &motion)
{
  const double rest = 1e-10 * motion.largest_translation();
  return std::all_of(contact_space.faces().begin(), contact_space.faces().end(),
                     [&](const ContactFace<dim> &face)
                     {
                       const ContactFrame<dim> middle = face.frame(0.5);
                       const Tensor<1, dim> jump = motion.jump(middle.x, face.bodies);
                       return jump.norm() <= rest ||
                              (face.condition->is_unilateral() && middle.normal * jump < -rest);
                     });
}

/** As in "the loads turn the body about (1 0) with 2, contact can resist with 1". */
template <int dim>
std::string in_words(const LoadedMotions<dim> &loaded, const Imbalance &imbalance,
                     const double otherwise = infinity)
{
  const RigidBodyMotion<dim> motion = seen_motion(loaded, imbalance.motion);
  const bool pushes = motion.is_translation();
  // Of unit length, or with a rotation by one, so that the numbers are forces or moments.
  const double unit =
      (pushes ? motion.largest_translation() : motion.largest_rotation()) / loaded.thickness;
  std::ostringstream line;
  line.precision(10);
  line << "the loads " << (pushes ? "push" : "turn") << (motion.others.empty() ? " the body " : " ")
       << motion.direction() << " with " << imbalance.load / unit << ", contact can resist with "
       << imbalance.resistance / unit;
  if (std::isfinite(otherwise))
    line << " there and " << otherwise / unit << " on a fine one";
  return line.str();
}
} // namespace

template <int dim>
RigidBodyMotion<dim> LoadedMotions<dim>::sum(const Vector<double> &coefficients) const
{
  return hpvi::sum(motions, coefficients);
}

/** By Gram and Schmidt, in coordinates of one length. */
template <int dim>
std::optional<double> LoadedMotions<dim>::along(const RigidBodyMotion<dim> &motion) const
{
  static_assert(dim == 2, "one rotation");
  const double turn = fastest_turn(*this);
  if (turn == 0. && motion.largest_rotation() != 0.)
    return {};
  const auto coordinates = [&](const RigidBodyMotion<dim> &all)
  {
    std::vector<double> result;
    for (unsigned int b = 0; b < n_bodies(); ++b)
    {
      const RigidBodyMotion<dim> &one = b == 0 ? all : all.others[b - 1];
      const Tensor<1, dim> at_centre = all.at(motions.front().centre, b);
      result.insert(result.end(),
                    {at_centre[0], at_centre[1], turn > 0. ? one.rotation / turn : 0.});
    }
    return Vector<double>(result.begin(), result.end());
  };
  std::vector<Vector<double>> basis;
  std::vector<double> load;
  for (unsigned int m = 0; m < motions.size(); ++m)
  {
    Vector<double> rest = coordinates(motions[m]);
    load.push_back(loads[m]);
    for (unsigned int k = 0; k < m; ++k)
    {
      const double part = dot(rest, basis[k]);
      rest.add(-part, basis[k]);
      load.back() -= part * load[k];
    }
    const double length = rest.l2_norm();
    load.back() /= length;
    rest /= length;
    basis.push_back(rest);
  }
  Vector<double> rest = coordinates(motion);
  const double size = rest.l2_norm();
  double result = 0;
  for (unsigned int k = 0; k < basis.size(); ++k)
  {
    const double part = dot(rest, basis[k]);
    rest.add(-part, basis[k]);
    result += part * load[k];
  }
  return rest.l2_norm() <= 1e-8 * size ? std::optional<double>(result) : std::nullopt;
}

template <int dim>
void require_static_admissibility(const ContactSpace<dim> &contact_space,
                                  const LoadedMotions<dim> &loaded)
{
  std::optional<Imbalance> imbalance;
  for (const bool capped : {false, true})
    if (!imbalance && (!capped || has_cap(contact_space)))
      imbalance = imbalance_of(on_any_mesh(contact_space, capped), loaded, loaded.motions.size());
  if (!imbalance)
    return;
  std::string words = failure_mechanism(contact_space, loaded);
  if (words.empty())
  {
    // What even friction without limit does not hold lifts off or topples; what goes straight away from all contact lifts off,
    // though on a curve such friction might clamp it.
    std::optional<Imbalance> lifted = imbalance_of(
        on_any_mesh(contact_space, false, /*is_rough=*/true), loaded, loaded.motions.size());
    if (const RigidBodyMotion<dim> motion = seen_motion(loaded, imbalance->motion);
        !lifted && imbalance->resistance == 0. && motion.is_translation() &&
        opens(contact_space, motion))
      lifted = imbalance;
    const std::string entry = lifted ? "" : friction_entry(contact_space);
    words = (!lifted                                                ? "sliding: "
             : seen_motion(loaded, lifted->motion).is_translation() ? "lifting off: "
                                                                    : "toppling: ") +
            in_words(loaded, lifted ? *lifted : *imbalance) + " at most; add a support" +
            (entry.empty() ? " " : ", raise " + entry + " ") + "or change the loads";
  }
  throw NumericalFailure("no equilibrium: " + words);
}

template <int dim>
std::optional<InadmissibleContact> inadmissible_contact(const ContactSpace<dim> &contact_space,
                                                        const LoadedMotions<dim> &loaded)
{
  const std::optional<Imbalance> imbalance =
      imbalance_of(on_this_mesh(contact_space), loaded, loaded.n_seen);
  if (!imbalance)
    return {};
  const RigidBodyMotion<dim> motion = loaded.sum(imbalance->motion);
  const Tractions<dim> tractions = on_any_mesh(contact_space);
  std::set<unsigned int> cells;
  double most = 0;
  Point<dim> where;
  for (unsigned int i = 0; i < tractions.x.size(); ++i)
    if (const double resistance = work(tractions, i, motion);
        tractions.cell[i] != none && resistance > 0.)
    {
      cells.insert(tractions.cell[i]);
      if (resistance > most)
        where = tractions.x[i];
      most = std::max(most, resistance);
    }
  std::ostringstream why;
  why << "no equilibrium on this mesh: ";
  if (!cells.empty())
    why << in_words(loaded, *imbalance) << "; it could near (" << where
        << "), which the points of its multiplier do not reach: set Geometry/Graded towards there "
           "with more Grading levels, or move the loads";
  else
    why << in_words(loaded, *imbalance, bounded_resistance(tractions, motion))
        << ", for Friction bound varies between the points of its multiplier; raise "
           "Geometry/Subdivisions or set Geometry/Graded towards where it does";
  return InadmissibleContact{{cells.begin(), cells.end()}, why.str()};
}

template struct LoadedMotions<2>;
template void require_static_admissibility(const ContactSpace<2> &, const LoadedMotions<2> &);
template std::optional<InadmissibleContact> inadmissible_contact(const ContactSpace<2> &,
                                                                 const LoadedMotions<2> &);
} // namespace hpvi
