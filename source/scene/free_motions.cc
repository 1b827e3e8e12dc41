// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/contact_axes.h>
#include <hpvi/scene/hexahedral_mesh.h>
#include <hpvi/scene/plate_motion.h>
#include <hpvi/scene/space_motion.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double round_off = 1e-8; ///< of the coefficients of a motion, which are of size 1

/**
 * `u(x) = a + c x (x - centre)/length`: its coefficients, the translation a and then the rotation c, a number in
 * the plane.
 */
template <int dim>
using RigidMotion = std::array<double, dim *(dim + 1) / 2>;

/** What `direction . u = 0` at @p centre + length @p arm asks of a motion. */
RigidMotion<2> row_of(const Tensor<1, 2> &direction, const Tensor<1, 2> &arm)
{
  return {{direction[0], direction[1], direction[1] * arm[0] - direction[0] * arm[1]}};
}

RigidMotion<3> row_of(const Tensor<1, 3> &direction, const Tensor<1, 3> &arm)
{
  const Tensor<1, 3> moment = cross_product_3d(arm, direction);
  return {{direction[0], direction[1], direction[2], moment[0], moment[1], moment[2]}};
}

template <std::size_t n>
bool is_translation(const std::array<double, n> &motion)
{
  constexpr unsigned int dim = n == 3 ? 2 : 3;
  return std::all_of(motion.begin() + dim, motion.end(),
                     [](const double c) { return std::abs(c) < round_off; });
}

/** "in x", or "along" a direction. */
template <int dim>
std::string direction_of(const RigidMotion<dim> &motion)
{
  Point<dim> direction;
  std::string axes;
  for (unsigned int d = 0; d < dim; ++d)
  {
    direction[d] = motion[d];
    if (std::abs(direction[d]) >= round_off)
      axes += "xyz"[d];
  }
  return axes.size() == 1 ? "in " + axes : "along " + to_string(direction);
}

std::string describe(const RigidMotion<2> &motion, const Point<2> &centre, const double length)
{
  if (is_translation(motion))
    return "translation " + direction_of<2>(motion);
  return "rotation about " +
         to_string(centre + length / motion[2] * Point<2>(-motion[1], motion[0]));
}

std::string describe(const RigidMotion<3> &motion, const Point<3> &, const double)
{
  if (is_translation(motion))
    return "translation " + direction_of<3>(motion);
  return "rotation about an axis along " + to_string(Point<3>(motion[3], motion[4], motion[5]));
}

/** A basis of the motions that satisfy all @p rows, conditions on their coefficients, of which @p rest has as many. */
template <class Row>
std::vector<Row> motions_of(std::vector<Row> rows, const Row &rest = Row())
{
  // Gauss and Jordan: each column without pivot is a motion that earlier columns can balance.
  const unsigned int n = rest.size();
  std::vector<unsigned int> pivots;
  std::vector<Row> motions;
  for (unsigned int column = 0; column < n; ++column)
  {
    const unsigned int rank = pivots.size();
    const auto pivot = std::max_element(rows.begin() + rank, rows.end(),
                                        [column](const auto &a, const auto &b)
                                        { return std::abs(a[column]) < std::abs(b[column]); });
    if (pivot == rows.end() || std::abs((*pivot)[column]) < round_off)
    {
      Row motion = rest;
      motion[column] = 1;
      for (unsigned int k = 0; k < rank; ++k)
        motion[pivots[k]] = -rows[k][column] / rows[k][pivots[k]];
      motions.push_back(motion);
      continue;
    }
    std::swap(*pivot, rows[rank]);
    for (unsigned int r = 0; r < rows.size(); ++r)
    {
      const double factor = r == rank ? 0. : rows[r][column] / rows[rank][column];
      for (unsigned int c = 0; c < n; ++c)
        rows[r][c] -= factor * rows[rank][c];
    }
    pivots.push_back(column);
  }
  return motions;
}

/** What holds the body: supports, and what resists beside them, friction and bilateral pressure. */
template <int dim>
struct Rows
{
  std::vector<RigidMotion<dim>> held, resisted;
};

/** What a rigid plate does not leave free. */
template <int dim>
void add_plate(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary,
               const Point<dim> &centre, const double length, std::vector<RigidMotion<dim>> &held)
{
  const PlateMotion<dim> plate(scene, boundary);
  for (unsigned int m = 0; m < plate.n_motions; ++m)
    if (!boundary.plate->is_free(m) && m < dim)
      held.push_back(row_of(plate.motion(m, centre), (plate.centre() - centre) / length));
    else if (!boundary.plate->is_free(m))
    {
      held.emplace_back();
      held.back().fill(0.);
      held.back()[m] = 1;
    }
}

/** Springs hold those pieces of a side on which they are not zero all along. */
void add_springs(const BoundaryCondition<2> &boundary, const Side<2> &side, const Point<2> &centre,
                 const double length, std::vector<RigidMotion<2>> &held)
{
  const double n_points = 2000; // four times those that look for strips in the body
  for (const bool is_normal : {true, false})
    for (unsigned int k = 0; k < side.pieces.size(); ++k)
    {
      const auto &stiffness = is_normal ? boundary.spring.normal : boundary.spring.tangential;
      bool acts = false;
      for (unsigned int i = 0; stiffness && !acts && i < n_points; ++i)
        acts = stiffness->value(side.point(k, (i + 0.5) / n_points)) != 0;
      for (unsigned int i = 0; acts && i <= 4; ++i)
      {
        const Tensor<1, 2> normal = side.normal(k, i / 4.);
        held.push_back(row_of(is_normal ? normal : -cross_product_2d(normal),
                              (side.point(k, i / 4.) - centre) / length));
      }
    }
}

/** Where conditions on motions are asked for on a piece in space, with its normals: at its corners, or at the nodes that it follows. */
std::vector<std::pair<Point<3>, Tensor<1, 3>>> places_on(const Side<3> &side,
                                                         const unsigned int piece)
{
  std::vector<std::pair<Point<3>, Tensor<1, 3>>> result;
  if (const CurvedFace curve = side.curve(piece); curve && !side.is_flat())
    for (unsigned int k = 0; k < curve.nodes().size(); ++k)
      result.emplace_back(curve.nodes()[k], curve.normal(Point<2>(k % 3 / 2., k / 3 / 2.)));
  else
    for (const Point<3> &corner : side.pieces[piece])
      result.emplace_back(corner, side.is_flat() ? side.outward : normal_of(side.pieces[piece]));
  return result;
}

/** Likewise in the plane. */
std::vector<std::pair<Point<2>, Tensor<1, 2>>> places_on(const Side<2> &side,
                                                         const unsigned int piece)
{
  std::vector<std::pair<Point<2>, Tensor<1, 2>>> result;
  if (side.is_flat())
    for (const Point<2> &end : side.pieces[piece])
      result.emplace_back(end, side.outward);
  else
    for (unsigned int i = 0; i <= 4; ++i)
      result.emplace_back(side.point(piece, i / 4.), side.normal(piece, i / 4.));
  return result;
}

/** Likewise in space, where along a piece springs hold in both directions. */
void add_springs(const BoundaryCondition<3> &boundary, const Side<3> &side, const Point<3> &centre,
                 const double length, std::vector<RigidMotion<3>> &held)
{
  constexpr unsigned int n = 44; // 2000 points, as in the plane
  const auto acts = [&](const Expression<3> &stiffness, const unsigned int piece)
  {
    const CurvedFace curve = side.curve(piece);
    const Side<3>::Piece &corners = side.pieces[piece];
    for (unsigned int i = 0; stiffness && i < n * n; ++i)
    {
      const double s = (i % n + 0.5) / n, t = (i / n + 0.5) / n;
      const Point<3> low = corners[0] + s * (corners[1] - corners[0]),
                     high = corners[2] + s * (corners[3] - corners[2]);
      if (stiffness->value(curve ? curve.point(Point<2>(s, t)) : low + t * (high - low)) != 0)
        return true;
    }
    return false;
  };
  for (unsigned int piece = 0; piece < side.pieces.size(); ++piece)
  {
    const bool is_normal = acts(boundary.spring.normal, piece),
               is_tangential = acts(boundary.spring.tangential, piece);
    for (const auto &[x, normal] : places_on(side, piece))
    {
      if (is_normal)
        held.push_back(row_of(normal, (x - centre) / length));
      for (const Tensor<1, 3> &tangent : contact_axes(normal).tangents)
        if (is_tangential)
          held.push_back(row_of(tangent, (x - centre) / length));
    }
  }
}

template <int dim>
std::vector<std::pair<Point<dim>, Tensor<1, dim>>> places_on(const Side<dim> &side)
{
  std::vector<std::pair<Point<dim>, Tensor<1, dim>>> result;
  for (unsigned int piece = 0; piece < side.pieces.size(); ++piece)
    for (const auto &place : places_on(side, piece))
      result.push_back(place);
  return result;
}

/** Conditions at the corners of each piece, for a rigid-body motion is linear along it. */
template <int dim>
Rows<dim> rows_of(const Scene<dim> &scene, const unsigned int body, const Point<dim> &centre,
                  const double length)
{
  const auto is_other = [&](const BoundaryCondition<dim> &boundary)
  { return boundary.pair || scene.geometry.body_of_side(boundary.side) != body; };
  const std::vector<Side<dim>> sides = sides_of(scene);
  Rows<dim> rows;
  for (unsigned int f = 0; f < sides.size(); ++f)
    for (const auto &[end, normal] : places_on(sides[f]))
    {
      const BoundaryCondition<dim> &boundary = scene.boundaries[f];
      if (is_other(boundary))
        continue;
      const Tensor<1, dim> arm = (end - centre) / length;
      for (const PointCondition<dim> &condition : conditions_at(
               boundary, normal, boundary.symmetry || boundary.contact == Contact::bilateral, end))
        // Coulomb's law has a multiplier where bilateral contact is a support else.
        (boundary.has_pressure() ? rows.resisted : rows.held)
            .push_back(row_of(condition.direction, arm));
      if constexpr (dim == 2)
        if (boundary.friction) // where it vanishes, the mesh decides
          rows.resisted.push_back(row_of(-cross_product_2d(boundary.held_direction(normal)), arm));
      if constexpr (dim == 3)
        if (boundary.friction)
          for (const Tensor<1, dim> &tangent :
               contact_axes(boundary.held_direction(normal)).tangents)
            rows.resisted.push_back(row_of(tangent, arm));
    }
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    if (!is_other(boundary))
    {
      add_springs(boundary, sides[boundary.id], centre, length, rows.held);
      if (boundary.plate)
        add_plate(scene, boundary, centre, length, rows.held);
    }
  if constexpr (dim == 2)
    if (scene.is_axisymmetric()) // strains around the axis: the way along it alone is rigid
      for (const RigidMotion<dim> &motion : {RigidMotion<dim>{{1, 0, 0}}, {{0, 0, 1}}})
        rows.held.push_back(motion);
  rows.resisted.insert(rows.resisted.end(), rows.held.begin(), rows.held.end());
  return rows;
}

/** The motion as one about @p centre, a translation of unit length. */
RigidBodyMotion<2> motion_about(const Point<2> &centre, const double length,
                                const RigidMotion<2> &motion)
{
  RigidBodyMotion<2> free{Tensor<1, 2>({motion[0], motion[1]}), motion[2] / length, centre};
  if (is_translation(motion))
  {
    free.translation /= free.translation.norm();
    free.rotation = 0;
  }
  return free;
}
/** The free motions of each of several bodies by itself; whether contact can hold them together is seen when it is solved. */
std::vector<RigidBodyMotion<2>> motions_of_bodies(const Scene<2> &scene, const Point<2> &centre,
                                                  const double length)
{
  const unsigned int n_bodies = scene.geometry.bodies.size(), most = 8;
  std::vector<RigidBodyMotion<2>> rest(n_bodies), result;
  for (unsigned int b = 0; b < n_bodies; ++b)
    rest[b] = {{}, 0, centre, scene.geometry.bodies[b].name, {}};
  unsigned int n_floating = 0;
  for (unsigned int b = 0; b < n_bodies; ++b)
  {
    const auto motions = motions_of(rows_of(scene, b, centre, length).held);
    n_floating += motions.empty() ? 0 : 1;
    const bool touches = std::any_of(scene.boundaries.begin(), scene.boundaries.end(),
                                     [&](const BoundaryCondition<2> &boundary) {
                                       return boundary.has_contact() &&
                                              scene.geometry.body_of_side(boundary.side) == b;
                                     });
    if (!motions.empty() && (!touches || n_floating > most))
      throw InputError(printable(scene.origin(), 400) + ": Body " + rest[b].name +
                       ": its supports leave a rigid-body motion free, " +
                       describe(motions.front(), centre, length) +
                       (touches ? ", and no more than " + std::to_string(most) +
                                      " bodies may be held by contact alone"
                                : ", and it touches nothing") +
                       "; prescribe a displacement component of it");
    for (const RigidMotion<2> &motion : motions)
    {
      std::vector<RigidBodyMotion<2>> all = rest;
      all[b] = motion_about(centre, length, motion);
      all[b].name = rest[b].name;
      result.push_back(all[0]);
      result.back().others.assign(all.begin() + 1, all.end());
    }
  }
  return result;
}

/** What holds one body; InputError where neither supports nor contact could hold it. */
template <int dim>
Rows<dim> checked_rows(const Scene<dim> &scene, const Point<dim> &centre, const double length)
{
  const Rows<dim> rows = rows_of(scene, 0, centre, length);
  // Unilateral contact holds some motions one way, and what none holds may be in balance.
  if (scene.has_unilateral_contact())
    return rows;
  std::string names;
  for (const std::string &name : scene.geometry.boundary_names())
    names += (names.empty() || name.empty() ? "" : ", ") + name;
  if (const auto motions = motions_of(rows.resisted); !motions.empty())
    throw InputError(printable(scene.origin(), 400) + ": Boundary " + names +
                     "/Displacement: the supports leave a rigid-body motion free, " +
                     describe(motions.front(), centre, length) +
                     ", and no friction resists it; prescribe a displacement component or contact "
                     "that stops it");
  return rows;
}

/** Coefficients of the motions of all bodies, six of each. */
using BodiesRow = std::vector<double>;

/** What `direction . u` asks of the first body of a pair less the second; with one alone of that. */
BodiesRow row_between(const unsigned int n_bodies, const std::vector<unsigned int> &bodies,
                      const RigidMotion<3> &row)
{
  BodiesRow result(6 * n_bodies);
  for (unsigned int k = 0; k < bodies.size(); ++k)
    for (unsigned int c = 0; c < 6; ++c)
      result[6 * bodies[k] + c] = k == 0 ? row[c] : -row[c];
  return result;
}

/** What one side of a pair adds: where it is tied all, where it is bilateral its normal, and what resists beside that. */
void add_pair(const Scene<3> &scene, const ContactPair &pair, const Point<3> &centre,
              const double length, std::vector<BodiesRow> &held, std::vector<BodiesRow> &resisted)
{
  const BoundaryCondition<3> &part = scene.boundaries[pair.parts[0]];
  const std::vector<unsigned int> bodies{scene.geometry.body_of_side(pair.sides[0]),
                                         scene.geometry.body_of_side(pair.sides[1])};
  const unsigned int n = scene.geometry.bodies.size();
  for (const auto &[x, normal] : places_on(sides_of(scene)[part.id]))
  {
    const Tensor<1, 3> arm = (x - centre) / length;
    if (part.is_tied() || part.contact == Contact::bilateral)
      held.push_back(row_between(n, bodies, row_of(normal, arm)));
    for (const Tensor<1, 3> &tangent : contact_axes(normal).tangents)
      if (part.is_tied() || part.friction)
        (part.is_tied() ? held : resisted).push_back(row_between(n, bodies, row_of(tangent, arm)));
  }
}

[[noreturn]] void reject_motion(const Scene<3> &scene, const BodiesRow &motion,
                                const Point<3> &centre, const double length, const std::string &why)
{
  unsigned int moves = 0;
  while (std::all_of(&motion[6 * moves], &motion[6 * moves] + 6,
                     [](const double c) { return std::abs(c) < round_off; }))
    ++moves;
  RigidMotion<3> of_body;
  std::copy_n(&motion[6 * moves], 6, of_body.begin());
  throw InputError(printable(scene.origin(), 400) + ": Body " + scene.geometry.bodies[moves].name +
                   ": its supports leave a rigid-body motion free, " +
                   describe(of_body, centre, length) + ", and " + why +
                   "; prescribe a displacement, set Symmetry, or tie it to a body that is held");
}

/** Those of several bodies in space, which touch each other or a foundation; as coefficients. */
std::vector<BodiesRow> motions_of_bodies_in_space(const Scene<3> &scene, const Point<3> &centre,
                                                  const double length)
{
  const unsigned int n = scene.geometry.bodies.size();
  std::vector<BodiesRow> held, resisted;
  for (unsigned int b = 0; b < n; ++b)
  {
    const Rows<3> rows = rows_of(scene, b, centre, length);
    for (const RigidMotion<3> &row : rows.held)
      held.push_back(row_between(n, {b}, row));
    for (const RigidMotion<3> &row : rows.resisted)
      resisted.push_back(row_between(n, {b}, row));
  }
  for (const ContactPair &pair : scene.pairs)
    add_pair(scene, pair, centre, length, held, resisted);
  resisted.insert(resisted.end(), held.begin(), held.end());
  const BodiesRow rest(6 * n);
  const std::vector<BodiesRow> motions = motions_of(held, rest);
  if (motions.size() > most_free_motions)
    reject_motion(scene, motions.front(), centre, length,
                  "contact alone holds " + std::to_string(most_free_motions) +
                      " motions of all bodies at most, here they are " +
                      std::to_string(motions.size()));
  for (const BodiesRow &motion : motions)
    for (unsigned int b = 0; b < n; ++b)
    {
      const bool moves = std::any_of(&motion[6 * b], &motion[6 * b] + 6,
                                     [](const double c) { return std::abs(c) >= round_off; });
      const bool touches = std::any_of(scene.boundaries.begin(), scene.boundaries.end(),
                                       [&](const BoundaryCondition<3> &boundary) {
                                         return boundary.has_contact() &&
                                                scene.geometry.body_of_side(boundary.side) == b;
                                       });
      if (moves && !touches)
        reject_motion(scene, motion, centre, length, "it touches nothing");
    }
  if (!motions.empty() && !scene.has_unilateral_contact())
    if (const auto left = motions_of(resisted, rest); !left.empty())
      reject_motion(scene, left.front(), centre, length, "no friction resists it");
  return motions;
}
} // namespace

/** In space see free_motions_in_space(). */
template <int dim>
std::vector<RigidBodyMotion<dim>> Scene<dim>::free_motions() const
{
  const Point<dim> centre = geometry.centre();
  const double length = geometry.radius();
  if constexpr (dim == 2)
    if (!geometry.bodies.empty())
      return motions_of_bodies(*this, centre, length);
  if constexpr (dim == 3)
    if (!geometry.bodies.empty())
    {
      motions_of_bodies_in_space(*this, centre, length);
      return {};
    }
  const Rows<dim> rows = checked_rows(*this, centre, length);
  std::vector<RigidBodyMotion<dim>> result;
  if constexpr (dim == 2)
    for (const RigidMotion<dim> &motion : motions_of(rows.held))
      result.push_back(motion_about(centre, length, motion));
  return result;
}

std::vector<BodyMotions> free_motions_in_space(const Scene<3> &scene)
{
  const Point<3> centre = scene.geometry.centre();
  const double length = scene.geometry.radius();
  std::vector<BodiesRow> motions;
  if (!scene.geometry.bodies.empty())
    motions = motions_of_bodies_in_space(scene, centre, length);
  else
    for (const RigidMotion<3> &motion : motions_of(checked_rows(scene, centre, length).held))
      motions.emplace_back(motion.begin(), motion.end());
  std::vector<BodyMotions> result;
  for (const BodiesRow &motion : motions)
  {
    result.emplace_back();
    for (auto c = motion.begin(); c != motion.end(); c += 6)
      result.back().push_back(
          {Tensor<1, 3>({c[0], c[1], c[2]}), Tensor<1, 3>({c[3], c[4], c[5]}) / length, centre});
  }
  return result;
}

template std::vector<RigidBodyMotion<2>> Scene<2>::free_motions() const;
template std::vector<RigidBodyMotion<3>> Scene<3>::free_motions() const;
} // namespace hpvi
