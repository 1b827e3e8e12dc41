// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/hexahedral_mesh.h>
#include <hpvi/scene/slave_side.h>

#include <array>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Contact dofs of one component that the coarse mesh would have on one part of a pair, and the mean of the moduli behind them. */
struct PairPart
{
  unsigned int n_contact_dofs = 0;
  double stiffness = 0;
};

PairPart part_of_pair(const Scene<3> &scene, const BoundaryCondition<3> &boundary)
{
  PairPart result;
  double area = 0;
  for (const CoarseFace<3> &face : coarse_faces(scene.geometry, boundary.side))
    if (boundary_at(scene, boundary.side, middle_of(face)) == boundary.id)
    {
      const double own = area_of(face.corners);
      const unsigned int p = scene.start_degree_of(scene.geometry.mesh->cells[face.cell].body);
      result.n_contact_dofs += (p - 1) * (p - 1);
      area += own;
      result.stiffness +=
          own *
          scene.materials[scene.material_of_coarse_cell(face.inside, face.cell)].coercivity(3);
    }
  result.stiffness /= area;
  return result;
}
} // namespace

unsigned int slave_of(const Scene<3> &scene, const ContactPair &pair)
{
  constexpr double similar = 3;
  if (pair.slave)
    return *pair.slave;
  const std::array<PairPart, 2> parts{{part_of_pair(scene, scene.boundaries[pair.parts[0]]),
                                       part_of_pair(scene, scene.boundaries[pair.parts[1]])}};
  const double ratio = parts[1].stiffness / parts[0].stiffness;
  if (ratio >= similar || ratio <= 1 / similar ||
      parts[0].n_contact_dofs == parts[1].n_contact_dofs)
    return ratio < 1 - 1e-12 ? 1 : 0;
  return parts[1].n_contact_dofs > parts[0].n_contact_dofs ? 1 : 0;
}

std::vector<bool> masters_of(const Scene<3> &scene)
{
  std::vector<bool> result(scene.boundaries.size(), false);
  for (const ContactPair &pair : scene.pairs)
    result[pair.parts[1 - slave_of(scene, pair)]] = true;
  return result;
}

std::vector<bool> curved_pairs(const Scene<3> &scene)
{
  std::vector<bool> result(scene.pairs.size(), false);
  const HexahedralMesh *const mesh = hexahedra_of(scene.geometry);
  if (!mesh || mesh->bent.empty())
    return result;
  for (const HexahedralMesh::Face &face : mesh->faces)
    if (mesh->bent.count(face.cell) > 0)
      for (unsigned int p = 0; p < result.size(); ++p)
        if (face.boundary == scene.pairs[p].sides[0] || face.boundary == scene.pairs[p].sides[1])
          result[p] = true;
  return result;
}

std::vector<bool> opposite_boundaries(const Scene<3> &scene)
{
  std::vector<bool> result = masters_of(scene);
  const std::vector<bool> curved = curved_pairs(scene);
  for (unsigned int p = 0; p < curved.size(); ++p)
    for (const BoundaryCondition<3> &boundary : scene.boundaries)
      if (curved[p] && boundary.side == scene.pairs[p].sides[1 - slave_of(scene, scene.pairs[p])] &&
          !boundary.has_contact())
        result[boundary.id] = true;
  return result;
}
} // namespace hpvi
