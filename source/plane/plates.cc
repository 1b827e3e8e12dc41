// SPDX-License-Identifier: LGPL-2.1-or-later

// A rigid plate needs no unknowns of its own. Along it a displacement has three degrees of freedom at
// most, in space six, and those of a few nodes, in the plane its ends, hold them: they are masters, as many
// as the plate has free motions, and the constraints of the space express every other node of the plate by them.
#include <hpvi/plane/plates.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The nodes farthest from the first one, and from that one. */
std::array<unsigned int, 2> ends_of(const std::vector<SupportedNode<2>> &nodes)
{
  const auto farthest_from = [&](const unsigned int from)
  {
    unsigned int result = from;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (nodes[k].x.distance(nodes[from].x) > nodes[result].x.distance(nodes[from].x))
        result = k;
    return result;
  };
  const unsigned int first = farthest_from(0);
  return {{first, farthest_from(first)}};
}

/** e_z x v */
Tensor<1, 2> turned(const Tensor<1, 2> &v)
{
  return Tensor<1, 2>({-v[1], v[0]});
}

/** Of u at both @p ends: the rotation by what they do across the line between them, U at their middle. */
std::array<double, 3> amounts_of(const Point<2> &centre, const std::array<Point<2>, 2> &ends,
                                 const std::array<Tensor<1, 2>, 2> &u)
{
  const Tensor<1, 2> way = ends[1] - ends[0];
  const double angle = (u[1] - u[0]) * turned(way) / way.norm_square();
  const Tensor<1, 2> U = (u[0] + u[1]) / 2. - angle * turned((ends[0] - centre) + way / 2.);
  return {{U[0], U[1], angle}};
}
} // namespace

// @sect3{Masters}
//
// Gauss's elimination with the largest pivot chooses them among the components at the nodes: their
// motions have to be independent of each other, and far from it.
template <int dim>
PlateMasters<dim>::PlateMasters(const PlateMotion<dim> &plate,
                                const std::vector<unsigned int> &all_motions,
                                const std::vector<SupportedNode<dim>> &nodes)
    : motions(all_motions)
{
  std::vector<std::pair<Master, Vector<double>>> rest;
  for (const SupportedNode<dim> &node : nodes)
    for (unsigned int c = 0; c < dim; ++c)
    {
      rest.push_back({{node.dofs[c], node.x, c}, Vector<double>(motions.size())});
      for (unsigned int k = 0; k < motions.size(); ++k)
        rest.back().second[k] =
            plate.motion(motions[k], node.x)[c] / (motions[k] < dim ? 1. : plate.reach());
    }
  for (unsigned int k = 0; k < motions.size() && !rest.empty(); ++k)
  {
    const auto pivot =
        std::max_element(rest.begin(), rest.end(),
                         [](const auto &a, const auto &b)
                         { return a.second.linfty_norm() < (1 - 1e-9) * b.second.linfty_norm(); });
    const auto [master, row] = *pivot;
    if (row.linfty_norm() < 1e-9)
      break;
    rest.erase(pivot);
    const unsigned int column =
        std::max_element(row.begin(), row.end(),
                         [](const double a, const double b) { return std::abs(a) < std::abs(b); }) -
        row.begin();
    for (auto &other : rest)
      other.second.add(-other.second[column] / row[column], row);
    masters.push_back(master);
  }
  if (motions.empty() || masters.size() < motions.size())
    return;
  inverse.reinit(motions.size(), motions.size());
  for (unsigned int i = 0; i < masters.size(); ++i)
    for (unsigned int k = 0; k < motions.size(); ++k)
      inverse(i, k) = plate.motion(motions[k], masters[i].x)[masters[i].component];
  inverse.gauss_jordan();
}

// @sect3{All other nodes}
template <int dim>
void PlateMasters<dim>::constrain(const PlateMotion<dim> &plate, const SupportedNode<dim> &node,
                                  AffineConstraints<double> &constraints) const
{
  for (unsigned int c = 0; c < dim; ++c)
  {
    const types::global_dof_index dof = node.dofs[c];
    if (constraints.is_constrained(dof) || // by another plate that agrees
        std::any_of(masters.begin(), masters.end(),
                    [&](const Master &master) { return master.dof == dof; }))
      continue;
    constraints.add_line(dof);
    double inhomogeneity = plate.prescribed(node.x)[c];
    for (unsigned int i = 0; i < masters.size(); ++i)
    {
      double weight = 0;
      for (unsigned int k = 0; k < motions.size(); ++k)
        weight += plate.motion(motions[k], node.x)[c] * inverse(k, i);
      if (std::abs(weight) < 1e-14)
        continue;
      constraints.add_entry(dof, masters[i].dof, weight);
      inhomogeneity -= weight * plate.prescribed(masters[i].x)[masters[i].component];
    }
    constraints.set_inhomogeneity(dof, inhomogeneity);
  }
}

Plate::Plate(const Scene<2> &scene, const BoundaryCondition<2> &boundary,
             const std::vector<SupportedNode<2>> &all_nodes)
    : plate(*boundary.plate), id(boundary.id), plate_motion(scene, boundary)
{
  for (const SupportedNode<2> &node : all_nodes)
    if (node.is_on(id))
      nodes.push_back(node);
  ends = ends_of(nodes);
}

types::boundary_id Plate::boundary() const
{
  return id;
}

const PlateMotion<2> &Plate::motion() const
{
  return plate_motion;
}

void Plate::constrain(AffineConstraints<double> &constraints) const
{
  const PlateMasters<2> by(plate_motion, plate_motion.free_motions(),
                           {nodes[ends[0]], nodes[ends[1]]});
  for (const SupportedNode<2> &node : nodes)
    by.constrain(plate_motion, node, constraints);
}

// @sect3{Forces}
//
// They act on the motion of the plate, which is a sum over four displacements of its ends.
void Plate::add_load(Vector<double> &load) const
{
  const std::array<Point<2>, 2> x{{nodes[ends[0]].x, nodes[ends[1]].x}};
  for (unsigned int end = 0; end < 2; ++end)
    for (unsigned int c = 0; c < 2; ++c)
    {
      std::array<Tensor<1, 2>, 2> unit;
      unit[end][c] = 1.;
      const auto q = amounts_of(plate_motion.centre(), x, unit);
      for (unsigned int m = 0; m < q.size(); ++m)
        load[nodes[ends[end]].dofs[c]] += plate.force[m] * q[m];
    }
}

std::array<double, PlateMotion<2>::n_motions>
Plate::amounts(const Vector<double> &displacement) const
{
  std::array<Point<2>, 2> x;
  std::array<Tensor<1, 2>, 2> u;
  for (unsigned int end = 0; end < 2; ++end)
  {
    x[end] = nodes[ends[end]].x;
    for (unsigned int c = 0; c < 2; ++c)
      u[end][c] = displacement[nodes[ends[end]].dofs[c]];
  }
  return amounts_of(plate_motion.centre(), x, u);
}

std::vector<Plate> plates_of(const Scene<2> &scene, const std::vector<SupportedNode<2>> &nodes)
{
  std::vector<Plate> result;
  for (const BoundaryCondition<2> &boundary : scene.boundaries)
    if (boundary.plate && std::any_of(nodes.begin(), nodes.end(),
                                      [&](const auto &node) { return node.is_on(boundary.id); }))
      result.emplace_back(scene, boundary, nodes);
  return result;
}

template class PlateMasters<2>;
template class PlateMasters<3>;
} // namespace hpvi
