// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/gathered.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/face_axes.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/space/contact_statics.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
static_assert(most_free_motions <= most_equations, "each free motion is one equation");
constexpr double negligible = 1e-9; ///< of the loads: cones are round, and met in the limit

/** Of the first body less the second, if there is one. */
Tensor<1, 3> jump(const BodyMotions &motion, const Point<3> &x, const TouchingBodies &bodies)
{
  Tensor<1, 3> result = motion[bodies[0]].at(x);
  if (bodies[1] != no_body)
    result -= motion[bodies[1]].at(x);
  return result;
}

/** What the spots can resist with along @p motions. */
class StaticAdmissibility : public ForceSet
{
public:
  /** With @p is_rough nothing slides along the spots. */
  StaticAdmissibility(const std::vector<ContactSpot> &spots,
                      const std::vector<BodyMotions> &motions, bool is_rough = false);

  Extreme farthest(const Force &motion) const override;

  Force start() const override
  {
    return {};
  }

  unsigned int n_equations() const override
  {
    return n;
  }

  Force without_lifting(Force motion) const; ///< the part of it that no pressure works on
  bool resists_beyond(const Force &motion, unsigned int i) const; ///< any load?

private:
  struct Row
  {
    Force normal;
    std::array<Force, 2> tangents;
  };

  struct Longest
  {
    double work = 0;
    Force ray;
  };
  void lengthen(Longest &longest, const Force &motion, const Force &ray) const;
  void press(Longest &longest, const Force &motion, unsigned int i) const;

  const std::vector<ContactSpot> &spots;
  const unsigned int n;
  const bool is_rough;
  std::vector<Row> rows;
};

StaticAdmissibility::StaticAdmissibility(const std::vector<ContactSpot> &spots,
                                         const std::vector<BodyMotions> &motions,
                                         const bool is_rough)
    : spots(spots), n(motions.size()), is_rough(is_rough), rows(spots.size())
{
  for (unsigned int i = 0; i < spots.size(); ++i)
  {
    const auto tangents = contact_axes(spots[i].normal).tangents;
    for (unsigned int m = 0; m < n; ++m)
    {
      const Tensor<1, 3> u = jump(motions[m], spots[i].x, spots[i].bodies);
      rows[i].normal[m] = u * spots[i].normal;
      for (unsigned int s = 0; s < 2; ++s)
        rows[i].tangents[s][m] = u * tangents[s];
    }
  }
}

/** Takes @p ray where it works more, for its length, than what was found before. */
void StaticAdmissibility::lengthen(Longest &longest, const Force &motion, const Force &ray) const
{
  const double length = ray.norm(), work = length > 0 ? motion * ray / length : 0;
  if (work > std::max(longest.work, 1e-10 * motion.norm()))
    longest = {work, ray / length};
}

/** Along @p motion at spot @p i: friction of size one against it. */
Force friction_against(const Force &motion, const std::array<Force, 2> &tangents)
{
  const double s = motion * tangents[0], t = motion * tangents[1], slip = std::hypot(s, t);
  return slip > 1e-13 * motion.norm() ? (s * tangents[0] + t * tangents[1]) / slip : Force();
}

/** Pressures without end, with the friction that grows with them. */
void StaticAdmissibility::press(Longest &longest, const Force &motion, const unsigned int i) const
{
  const ContactSpot &spot = spots[i];
  const Force along = friction_against(motion, rows[i].tangents);
  const double slope = std::isfinite(spot.limit.most) ? 0 : spot.limit.coefficient;
  lengthen(longest, motion, rows[i].normal + slope * along);
  if (spot.pulls)
    lengthen(longest, motion, -1. * rows[i].normal);
}

StaticAdmissibility::Extreme StaticAdmissibility::farthest(const Force &motion) const
{
  Longest longest;
  Force sum;
  for (unsigned int i = 0; i < spots.size(); ++i)
  {
    const ContactSpot &spot = spots[i];
    const Force along = friction_against(motion, rows[i].tangents);
    if (spot.presses || spot.pulls)
      press(longest, motion, i);
    if (is_rough)
      lengthen(longest, motion, along);
    sum += spot.area * spot.limit.limit(0.) * along;
    // A largest friction needs a pressure, which may cost more than it brings.
    if (std::isfinite(spot.limit.most) && spot.limit.coefficient > 0)
    {
      const double rise = spot.limit.most - spot.limit.limit(0.);
      const Force both = spot.area * rise * (along + (1 / spot.limit.coefficient) * rows[i].normal);
      sum += motion * both > 0 ? both : Force();
    }
  }
  if (longest.work > 0)
    return {longest.ray, true};
  return {sum, false};
}

bool StaticAdmissibility::resists_beyond(const Force &motion, const unsigned int i) const
{
  Longest longest;
  press(longest, motion, i);
  return longest.work > 1e-6 * motion.norm();
}

Force StaticAdmissibility::without_lifting(Force motion) const
{
  std::vector<Force> lifting; // orthonormal
  for (unsigned int i = 0; i < rows.size() && lifting.size() < n; ++i)
    if (spots[i].presses || spots[i].pulls)
    {
      Force rest = rows[i].normal;
      for (unsigned int pass = 0; pass < 2; ++pass)
        for (const Force &one : lifting)
          rest -= (rest * one) * one;
      if (rest.norm() > 1e-6 * rows[i].normal.norm())
        lifting.push_back(rest / rest.norm());
    }
  for (const Force &one : lifting)
    motion -= (motion * one) * one;
  return motion;
}

constexpr unsigned int n_numbers = 14;

/** Those of all processes. */
std::vector<ContactSpot> of_all_processes(const std::vector<ContactSpot> &own,
                                          MPI_Comm communicator)
{
  std::vector<double> numbers;
  for (const ContactSpot &spot : own)
  {
    for (unsigned int d = 0; d < 3; ++d)
      numbers.push_back(spot.x[d]);
    for (unsigned int d = 0; d < 3; ++d)
      numbers.push_back(spot.normal[d]);
    for (const double number :
         {spot.limit.cohesion, spot.limit.coefficient, spot.limit.most, spot.area,
          double(spot.presses), double(spot.pulls), double(spot.bodies[0]), double(spot.bodies[1])})
      numbers.push_back(number);
  }
  std::vector<ContactSpot> result;
  const std::vector<double> all = gathered(numbers, communicator);
  for (auto p = all.begin(); p != all.end(); p += n_numbers)
    result.push_back(
        {Point<3>(p[0], p[1], p[2]), Tensor<1, 3>({p[3], p[4], p[5]}),
         FrictionLimit{p[6], p[7], p[8]}, p[9], p[10] > 0, p[11] > 0,
         TouchingBodies{{static_cast<unsigned int>(p[12]), static_cast<unsigned int>(p[13])}}});
  return result;
}

/** Of each motion its values at nodes, and what it moves along contact. Collective. */
std::vector<DistributedVector> steps_along(const PrimalSpace<3> &space,
                                           const std::vector<BodyMotions> &motions)
{
  std::vector<types::global_dof_index> dofs;
  std::vector<DistributedVector> result(motions.size(), space.ghosted_vector());
  std::vector<char> is_known(space.relevant.n_elements()); // by the first component at a node
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (!cell->is_artificial())
    {
      const unsigned int body = body_of<3>(space.scene.geometry, cell);
      const CellMap<3> map = map_of<3>(cell);
      const BoxTables<3> &tables = space.tables.take_dofs(cell, dofs);
      for (const auto &components : tables.numbers)
      {
        if (std::exchange(is_known[space.relevant.index_within_set(dofs[components[0]])], true))
          continue; // from another cell
        const Point<3> x = map.point(tables.fe.unit_support_point(components[0]));
        for (unsigned int m = 0; m < motions.size(); ++m)
        {
          const Tensor<1, 3> u = motions[m][body].at(x);
          for (unsigned int c = 0; c < 3; ++c)
            result[m](dofs[components[c]]) = u[c];
        }
      }
    }
  for (DistributedVector &u : result)
    u = space.in_contact_dofs(u);
  return result;
}

/** Friction helps what slides alone. */
std::string remedy(const Scene<3> &scene, const bool slides)
{
  for (const BoundaryCondition<3> &boundary : scene.boundaries)
    if (slides && boundary.has_contact() && boundary.friction)
      return "add a support, raise " + boundary.friction.entry_to_raise() + " or lower the loads";
  return "add a support or change the loads";
}
} // namespace

ContactStatics::ContactStatics(const PrimalSpace<3> &space, const DistributedVector &f)
    : space(space), motions(free_motions_in_space(space.scene)), steps(steps_along(space, motions))
{
  for (unsigned int j = 0; j < motions.size(); ++j)
  {
    double size = 0;
    for (unsigned int i = 0; i < space.owned.n_elements(); ++i)
      size += std::abs(f.local_element(i) * steps[j].local_element(i));
    sizes.push_back(Utilities::MPI::sum(size, space.communicator()));
    const double load = f * steps[j];
    loads[j] = std::abs(load) > 1e-11 * sizes[j] ? load : 0;
  }
  std::vector<ContactSpot> own, own_ends;
  collectively(space.communicator(), // what limits friction is a function
               [&]()
               {
                 for (const ContactDofFace<3> &face : space.faces)
                 {
                   const auto spots = spots_of(face), corners = ends_of(face);
                   own.insert(own.end(), spots.begin(), spots.end());
                   own_ends.insert(own_ends.end(), corners.begin(), corners.end());
                 }
               });
  on_mesh = of_all_processes(own, space.communicator());
  ends = of_all_processes(own_ends, space.communicator());
}

TouchingBodies ContactStatics::bodies_at(const ContactDofFace<3> &face) const
{
  const Geometry<3> &geometry = space.scene.geometry;
  const BoundaryCondition<3> &boundary = space.condition(face.cell, face.face);
  if (geometry.bodies.empty())
    return {{0, no_body}};
  TouchingBodies result{{geometry.body_of_side(boundary.side), no_body}};
  if (boundary.pair)
    for (const unsigned int side : space.scene.pairs[*boundary.pair].sides)
      if (const unsigned int body = geometry.body_of_side(side); body != result[0])
        result[1] = body;
  return result;
}

std::vector<ContactSpot> ContactStatics::spots_of(const ContactDofFace<3> &face) const
{
  const BoundaryCondition<3> &boundary = space.condition(face.cell, face.face);
  std::vector<ContactSpot> result;
  for (unsigned int k = 0; k < space.tables.of(face.cell).n_contact_dofs(); ++k)
  {
    const ContactDof<3> &contact_dof = space.contact[face.first() + k];
    result.push_back({contact_dof.centroid, face.axes_at(k).normal,
                      face.has_friction() ? contact_dof.limit : FrictionLimit(), contact_dof.area,
                      face.has_pressure(), face.has_pressure() && !boundary.is_unilateral(),
                      bodies_at(face)});
  }
  return result;
}

/** Friction that has a largest value is counted where the mesh has it: here its area is 0. */
std::vector<ContactSpot> ContactStatics::ends_of(const ContactDofFace<3> &face) const
{
  std::vector<ContactSpot> result;
  const BoundaryCondition<3> &boundary = space.condition(face.cell, face.face);
  const CellMap<3> map = map_of<3>(face.cell);
  for (unsigned int v = 0; v < 4 && face.has_pressure(); ++v)
  {
    const unsigned int corner = GeometryInfo<3>::face_to_cell_vertices(face.face, v);
    const Point<3> x = map.vertices()[corner];
    result.push_back(
        {x,
         face.is_curved()
             ? axes_of_face(map, face.face, GeometryInfo<3>::unit_cell_vertex(corner), boundary)
                   .normal
             : face.axes.normal,
         boundary.friction ? boundary.friction.at(x) : FrictionLimit(), 0., true,
         !boundary.is_unilateral(), bodies_at(face)});
  }
  return result;
}

BodyMotions ContactStatics::sum(const Force &coefficients) const
{
  BodyMotions result = motions[0];
  for (unsigned int b = 0; b < result.size(); ++b)
  {
    result[b] = {{}, {}, result[b].centre};
    for (unsigned int j = 0; j < motions.size(); ++j)
      result[b].add(coefficients[j], motions[j][b]);
    // A rotation about a far axis is one more to read than a body that slides or lifts off.
    if (result[b].rotation.norm() * space.scene.geometry.radius() <
        0.01 * result[b].translation.norm())
      result[b].rotation = 0;
  }
  return result;
}

double ContactStatics::speed(const SpaceMotion &motion) const
{
  return motion.translation.norm() + motion.rotation.norm() * space.scene.geometry.radius();
}

/** The body that moves most; of equal ones the first. */
unsigned int ContactStatics::first_of(const BodyMotions &motion) const
{
  return std::max_element(motion.begin(), motion.end(),
                          [&](const SpaceMotion &a, const SpaceMotion &b)
                          { return speed(a) < (1 - 1e-6) * speed(b); }) -
         motion.begin();
}

/** Of those that move, that which moves most before the others. */
std::string ContactStatics::names_of(const BodyMotions &motion, const unsigned int first) const
{
  if (motion.size() == 1)
    return "the body";
  std::string result = space.scene.geometry.bodies[first].name;
  for (unsigned int b = 0; b < motion.size(); ++b)
    if (b != first && speed(motion[b]) > 0.01 * speed(motion[first]))
      result += ", " + space.scene.geometry.bodies[b].name;
  return result;
}

std::string ContactStatics::in_words(const Force &motion, const double load,
                                     const std::string &what, const double resistance) const
{
  const double way = load < 0 ? -1 : 1; // the one in which the loads push
  const BodyMotions all = sum(way * motion);
  const unsigned int first = first_of(all);
  const SpaceMotion &moved = all[first];
  // Of unit length, or with a rotation by one, so that the numbers are forces or moments.
  const double unit = way * (moved.turns() ? moved.rotation.norm() : moved.translation.norm());
  std::ostringstream line;
  line.precision(10);
  line << "the loads " << (moved.turns() ? "turn" : "push") << ' ' << names_of(all, first) << ' '
       << moved.in_words() << " with " << load / unit << ", contact " << what << " with "
       << (std::abs(resistance) <= 1e-9 * std::abs(load) ? 0. : resistance / unit);
  return line.str();
}

bool ContactStatics::turns(const Force &motion) const
{
  const BodyMotions all = sum(motion);
  return all[first_of(all)].turns();
}

/**
 * Of what separates the loads from @p spots. Where even friction without limit would not help the body lifts off or topples.
 * Else it slides: the part of the motion that lifts nothing is named, along which contact resists with what the rest leaves.
 */
std::string ContactStatics::why(const std::vector<ContactSpot> &spots,
                                const Separation &separation) const
{
  const StaticAdmissibility rough(spots, motions, /*is_rough=*/true);
  if (const auto lifted = separate(rough, loads, negligible))
    return (turns(lifted->motion) ? "toppling: " : "lifting off: ") +
           in_words(lifted->motion, lifted->load, "can resist", lifted->resistance);
  const Force sliding = rough.without_lifting(separation.motion),
              lifting = separation.motion - sliding;
  return "sliding: " +
         in_words(sliding, sliding * loads, "can resist", separation.resistance - lifting * loads);
}

void ContactStatics::require_static_admissibility() const
{
  std::vector<ContactSpot> spots = on_mesh;
  spots.insert(spots.end(), ends.begin(), ends.end());
  if (const auto separation = separate(StaticAdmissibility(spots, motions), loads, negligible))
  {
    const std::string words = why(spots, *separation);
    throw NumericalFailure("no equilibrium: " + words + " at most; " +
                           remedy(space.scene, words.rfind("sliding", 0) == 0));
  }
}

std::optional<ContactStatics::Missing> ContactStatics::missing() const
{
  const auto separation = separate(StaticAdmissibility(on_mesh, motions), loads, negligible);
  if (!separation)
    return {};
  Missing result{{},
                 0,
                 "no equilibrium on this mesh, whose pressures act inside of its faces: " +
                     why(on_mesh, *separation) +
                     " there; raise Geometry/Subdivisions or move the loads"};
  for (const ContactDofFace<3> &face : space.faces)
  {
    const std::vector<ContactSpot> corners = ends_of(face);
    const StaticAdmissibility here(corners, motions);
    for (unsigned int v = 0; v < corners.size(); ++v)
      if (here.resists_beyond(separation->motion, v))
      {
        result.cells.push_back(face.cell);
        break;
      }
  }
  result.n_cells = Utilities::MPI::sum(result.cells.size(), space.communicator());
  return result;
}

double ContactStatics::imbalance(const std::vector<ContactVector<3>> &lambda,
                                 std::string &words) const
{
  std::vector<double> resisted, forces;
  for (unsigned int j = 0; j < motions.size(); ++j)
  {
    std::vector<double> own{0., 0.}, sums(2);
    for (unsigned int k = 0; k < lambda.size(); ++k)
    {
      const ContactDof<3> &contact_dof = space.contact[k];
      const double part = contact_dof.area * contact_dof.bound_by(lambda) *
                          (lambda[k] * space.contact_value(steps[j], k));
      own[0] += part;
      own[1] += std::abs(part);
    }
    Utilities::MPI::sum(own, space.communicator(), sums);
    resisted.push_back(sums[0]);
    forces.push_back(sizes[j] + sums[1]);
  }
  const double all = *std::max_element(forces.begin(), forces.end());
  double worst = 0;
  for (unsigned int j = 0; j < motions.size(); ++j)
    if (const double left = all > 0 ? std::abs(loads[j] - resisted[j]) / all : 0; left > worst)
    {
      Force motion;
      motion[j] = 1;
      worst = left;
      words = in_words(motion, loads[j], "resists", resisted[j]);
    }
  return worst;
}
} // namespace hpvi
