// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/contact_axes.h>
#include <hpvi/scene/hexahedral_mesh.h>
#include <hpvi/scene/plate_motion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
const std::string meeting_place = dim == 2 ? " at their corner " : " at their common point ";

/** The entry that says what happens to the displacement of a boundary. */
template <int dim>
std::string support_entry(const BoundaryCondition<dim> &boundary)
{
  return boundary.symmetry                        ? "Symmetry"
         : boundary.contact == Contact::bilateral ? "Contact"
                                                  : "Displacement";
}

template <int dim>
[[noreturn]] void reject_meeting(const Scene<dim> &scene, const BoundaryCondition<dim> &one,
                                 const BoundaryCondition<dim> &two, const Point<dim> &point,
                                 const double contradiction)
{
  // The message stands at the boundary whose value can be changed.
  const bool one_is_fixed = one.symmetry || one.contact == Contact::bilateral;
  const BoundaryCondition<dim> &changeable = one_is_fixed ? two : one,
                               &other = one_is_fixed ? one : two;
  reject(scene, section_of(changeable), support_entry(changeable),
         "contradicts " + mention(scene, section_of(other), support_entry(other)) +
             meeting_place<dim> + to_string(point) + " by " + to_string(std::abs(contradiction)) +
             "; make both agree there or free one component");
}

/** Where @p boundary prescribes u_n > u_0 where it meets @p contact. */
template <int dim>
[[noreturn]] void reject_penetration(const Scene<dim> &scene,
                                     const BoundaryCondition<dim> &boundary,
                                     const BoundaryCondition<dim> &contact, const Point<dim> &point,
                                     const double depth)
{
  const std::string limit =
      contact.gap ? mention(scene, section_of(contact), "Gap")
                  : mention(scene, section_of(contact), "Contact", name_of(contact.contact));
  reject(scene, section_of(boundary), support_entry(boundary),
         "contradicts " + limit + meeting_place<dim> + to_string(point) +
             ", for u_n exceeds the gap by " + to_string(depth) +
             "; let u_n <= u_0 there or free one component");
}

/** What @p condition asks for beyond the orthonormal @p basis: no direction if that decides it. */
template <int dim>
PointCondition<dim> rest_of(PointCondition<dim> condition,
                            const std::vector<PointCondition<dim>> &basis)
{
  for (const PointCondition<dim> &q : basis)
  {
    const double product = condition.direction * q.direction;
    condition.direction -= product * q.direction;
    condition.value -= product * q.value;
  }
  return condition;
}

/** Can all @p conditions at one point hold together, and @p limits `u_n <= u_0` with them? */
template <int dim>
void check_meeting(const Scene<dim> &scene, const Point<dim> &point,
                   const std::vector<PointCondition<dim>> &conditions,
                   const std::vector<PointCondition<dim>> &limits, const double tolerance)
{
  std::vector<PointCondition<dim>> basis; // by Gram and Schmidt
  for (const PointCondition<dim> &condition : conditions)
  {
    const PointCondition<dim> rest = rest_of(condition, basis);
    const double norm = rest.direction.norm();
    if (norm > repeated_direction)
      basis.push_back({rest.direction / norm, rest.value / norm, rest.boundary});
    else if (std::abs(rest.value) > tolerance)
      reject_meeting(scene, scene.boundaries[basis.front().boundary],
                     scene.boundaries[rest.boundary], point, rest.value);
  }
  for (const PointCondition<dim> &limit : limits)
    if (const PointCondition<dim> rest = rest_of(limit, basis);
        rest.direction.norm() <= repeated_direction && rest.value < -tolerance)
      reject_penetration(scene, scene.boundaries[basis.front().boundary],
                         scene.boundaries[limit.boundary], point, -rest.value);
}

/**
 * What @p other asks for at a point that it shares with a plate holds whichever way the plate moves: else its free motions
 * would be no motions of the body.
 */
template <int dim>
void check_beside_plate(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary,
                        const PlateMotion<dim> &plate, const BoundaryCondition<dim> &other,
                        const PlateMotion<dim> *const other_plate, const Tensor<1, dim> &normal,
                        const Point<dim> &point, const double tolerance)
{
  std::vector<PointCondition<dim>> conditions =
      conditions_at(other, normal, other.symmetry || other.contact == Contact::bilateral, point);
  for (unsigned int c = 0; other_plate && c < dim; ++c)
  {
    Tensor<1, dim> axis;
    axis[c] = 1.;
    conditions.push_back({axis, other_plate->held(axis, point).value_or(std::nan("")), other.id});
  }
  const std::string entry = other.plate ? "Rigid" : support_entry(other),
                    place = mention(scene, section_of(other), entry) + meeting_place<dim> +
                            to_string(point);
  for (const PointCondition<dim> &condition : conditions)
  {
    const std::optional<double> held = plate.held(condition.direction, point);
    if (!held || std::isnan(condition.value))
      reject(scene, section_of(boundary), "Rigid",
             "leaves a plate free to move against " + place +
                 "; prescribe Displacement and Rotation of the plate as that has it, or end one of "
                 "the two before",
             "true");
    if (std::abs(*held - condition.value) > tolerance)
      reject(scene, section_of(boundary), "Displacement",
             "contradicts " + place + " by " + to_string(std::abs(*held - condition.value)) +
                 "; make both agree there");
  }
  if (const auto held = plate.held(other.held_direction(normal), point);
      other.is_unilateral() && held && *held > other.gap_at(point) + tolerance)
    reject_penetration(scene, boundary, other, point, *held - other.gap_at(point));
}
} // namespace

namespace
{
template <int dim>
unsigned int body_of(const Scene<dim> &scene, const types::boundary_id boundary)
{
  return scene.geometry.body_of_side(scene.boundaries[boundary].side);
}

/** What could contradict another boundary's wish where both meet. */
template <int dim>
bool asks_for_displacements(const BoundaryCondition<dim> &boundary)
{
  return boundary.has_displacement() || boundary.symmetry || boundary.has_contact() ||
         boundary.plate;
}
} // namespace

/** The normal displacement is held on plane faces. */
void check_curved_faces(const Scene<3> &scene)
{
  const HexahedralMesh &mesh = *hexahedra_of(scene.geometry);
  for (const BoundaryCondition<3> &boundary : scene.boundaries)
    for (const HexahedralMesh::Face &face : mesh.faces)
    {
      if (face.boundary != boundary.side || mesh.bent.count(face.cell) == 0)
        continue;
      const std::string at = to_string(mesh.corners[face.vertices[0]]);
      if (boundary.holds_normal() &&
          (!mesh.curve_of(face).is_plane() || (!boundary.symmetry && boundary.friction)))
        reject(scene, section_of(boundary), boundary.symmetry ? "Symmetry" : "Contact",
               "holds u_n = 0 on the face at " + at +
                   " of a curved cell, and space offers that where it is plane, without friction; "
                   "give it a Displacement, or set Contact = unilateral");
      if (boundary.contact_direction)
        reject(scene, section_of(boundary), "Contact direction",
               "is given on the face at " + at +
                   " of a curved cell, and space offers it on plane cells; give cells there first "
                   "order and plane faces");
    }
}

/** Bilateral contact, which tells its forces node by node, holds one component: that of an axis. */
void check_held_faces(const Scene<3> &scene, const std::vector<Side<3>> &sides)
{
  for (const BoundaryCondition<3> &boundary : scene.boundaries)
    for (const Side<3>::Piece &piece : sides[boundary.id].pieces)
      if ((scene.geometry.has_mesh() || boundary.contact_direction) && boundary.holds_normal() &&
          !boundary.symmetry &&
          contact_axes(boundary.held_direction(normal_of(piece))).is_rotated())
        reject(scene, section_of(boundary), "Contact",
               "holds u_n = 0 on the face at " + to_string(piece[0]) +
                   " along no axis, which space does not offer; turn the body, or set "
                   "unilateral",
               "bilateral");
}

template <int dim>
void check_supports(const Scene<dim> &scene)
{
  const std::vector<Side<dim>> sides = sides_of(scene);
  const double tolerance = support_tolerance(scene);
  if constexpr (dim == 3)
  {
    if (scene.geometry.has_mesh())
      check_curved_faces(scene);
    check_held_faces(scene, sides);
  }
  std::vector<std::unique_ptr<const PlateMotion<dim>>> plates(sides.size());
  for (unsigned int a = 0; a < sides.size(); ++a)
    if (scene.boundaries[a].plate)
      plates[a] = std::make_unique<const PlateMotion<dim>>(scene, scene.boundaries[a]);
  for (unsigned int a = 0; a < sides.size(); ++a)
    for (unsigned int b = a + 1; b < sides.size(); ++b)
    {
      if (body_of(scene, a) != body_of(scene, b) || // bodies may touch there, and share no point
          !asks_for_displacements(scene.boundaries[a]) ||
          !asks_for_displacements(scene.boundaries[b]))
        continue;
      for (const Point<dim> &point : common_points(sides[a], sides[b]))
      {
        std::vector<PointCondition<dim>> conditions, limits;
        for (const unsigned int f : {a, b})
        {
          const BoundaryCondition<dim> &boundary = scene.boundaries[f];
          if (boundary.pair)
            continue; // what is opposite may move
          for (const Tensor<1, dim> &normal : normals_at(sides[f], point))
          {
            for (const PointCondition<dim> &condition :
                 conditions_at(boundary, normal,
                               boundary.symmetry || boundary.contact == Contact::bilateral, point))
              conditions.push_back(condition);
            if (boundary.is_unilateral())
              limits.push_back(
                  {boundary.held_direction(normal), boundary.gap_at(point), boundary.id});
          }
        }
        check_meeting(scene, point, conditions, limits, tolerance);
        for (const auto &[one, other] : {std::pair{a, b}, std::pair{b, a}})
          if (plates[one] && !scene.boundaries[other].pair)
            for (const Tensor<1, dim> &normal : normals_at(sides[other], point))
              check_beside_plate<dim>(scene, scene.boundaries[one], *plates[one],
                                      scene.boundaries[other], plates[other].get(), normal, point,
                                      tolerance);
      }
    }
}

template void check_supports(const Scene<2> &);
template void check_supports(const Scene<3> &);
} // namespace hpvi
