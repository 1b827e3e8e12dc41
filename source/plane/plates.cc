// SPDX-License-Identifier: LGPL-2.1-or-later

// A rigid plate needs no unknowns of its own. Along it a displacement has three degrees of freedom at
// most, and those of its end nodes hold them: they are masters, as many as the plate has free motions, and
// the constraints of the space express every other node of the plate by them.
#include <deal.II/lac/full_matrix.h>
#include <hpvi/plane/plates.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
bool is_on(const SupportedNode<2> &node, const types::boundary_id boundary)
{
  return std::any_of(node.conditions.begin(), node.conditions.end(),
                     [&](const PointCondition<2> &condition)
                     { return condition.boundary == boundary; });
}

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
} // namespace

Plate::Plate(const Scene<2> &scene, const BoundaryCondition<2> &boundary,
             const std::vector<SupportedNode<2>> &all_nodes)
    : plate(*boundary.plate), id(boundary.id), plate_motion(scene, boundary)
{
  for (const SupportedNode<2> &node : all_nodes)
    if (is_on(node, id))
      nodes.push_back(node);
  ends = ends_of(nodes);
}

types::boundary_id Plate::boundary() const
{
  return id;
}

const PlateMotion &Plate::motion() const
{
  return plate_motion;
}

// @sect3{ContactInterface}
//
// Gauss's elimination with the largest pivot chooses them among the four unknowns of the ends: their
// motions have to be independent of each other, and far from it.
std::vector<Plate::Master> Plate::masters() const
{
  std::vector<std::pair<Master, Vector<double>>> rest;
  const std::vector<unsigned int> free = plate_motion.free_motions();
  for (const unsigned int end : ends)
    for (unsigned int c = 0; c < 2; ++c)
    {
      rest.push_back({{nodes[end].dofs[c], nodes[end].x, c}, Vector<double>(free.size())});
      for (unsigned int k = 0; k < free.size(); ++k)
        rest.back().second[k] = plate_motion.motion(free[k], nodes[end].x)[c] /
                                (free[k] == 2 ? plate_motion.reach() : 1.);
    }
  std::vector<Master> result;
  for (unsigned int k = 0; k < free.size(); ++k)
  {
    const auto pivot =
        std::max_element(rest.begin(), rest.end(),
                         [](const auto &a, const auto &b)
                         { return a.second.linfty_norm() < (1 - 1e-9) * b.second.linfty_norm(); });
    const auto [master, row] = *pivot;
    rest.erase(pivot);
    const unsigned int column =
        std::max_element(row.begin(), row.end(),
                         [](const double a, const double b) { return std::abs(a) < std::abs(b); }) -
        row.begin();
    for (auto &other : rest)
      other.second.add(-other.second[column] / row[column], row);
    result.push_back(master);
  }
  return result;
}

// @sect3{All other nodes}
//
// With R(masters) the matrix of free motions there, `q = R^{-1} (u(masters) - prescribed)`.
void Plate::constrain(AffineConstraints<double> &constraints) const
{
  const std::vector<unsigned int> free = plate_motion.free_motions();
  const std::vector<Master> by = masters();
  FullMatrix<double> R(by.size(), by.size());
  for (unsigned int i = 0; i < by.size(); ++i)
    for (unsigned int k = 0; k < free.size(); ++k)
      R(i, k) = plate_motion.motion(free[k], by[i].x)[by[i].component];
  if (!by.empty())
    R.gauss_jordan();
  for (const SupportedNode<2> &node : nodes)
    for (unsigned int c = 0; c < 2; ++c)
    {
      const types::global_dof_index dof = node.dofs[c];
      if (constraints.is_constrained(dof) || // by another plate that agrees
          std::any_of(by.begin(), by.end(),
                      [&](const Master &master) { return master.dof == dof; }))
        continue;
      constraints.add_line(dof);
      double inhomogeneity = plate_motion.prescribed(node.x)[c];
      for (unsigned int i = 0; i < by.size(); ++i)
      {
        double weight = 0;
        for (unsigned int k = 0; k < free.size(); ++k)
          weight += plate_motion.motion(free[k], node.x)[c] * R(k, i);
        if (std::abs(weight) < 1e-14)
          continue;
        constraints.add_entry(dof, by[i].dof, weight);
        inhomogeneity -= weight * plate_motion.prescribed(by[i].x)[by[i].component];
      }
      constraints.set_inhomogeneity(dof, inhomogeneity);
    }
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
      const auto q = plate_motion.amounts(x, unit);
      for (unsigned int m = 0; m < q.size(); ++m)
        load[nodes[ends[end]].dofs[c]] += plate.force[m] * q[m];
    }
}

std::array<double, PlateMotion::n_motions> Plate::amounts(const Vector<double> &displacement) const
{
  std::array<Point<2>, 2> x;
  std::array<Tensor<1, 2>, 2> u;
  for (unsigned int end = 0; end < 2; ++end)
  {
    x[end] = nodes[ends[end]].x;
    for (unsigned int c = 0; c < 2; ++c)
      u[end][c] = displacement[nodes[ends[end]].dofs[c]];
  }
  return plate_motion.amounts(x, u);
}

std::vector<Plate> plates_of(const Scene<2> &scene, const std::vector<SupportedNode<2>> &nodes)
{
  std::vector<Plate> result;
  for (const BoundaryCondition<2> &boundary : scene.boundaries)
    if (boundary.plate && std::any_of(nodes.begin(), nodes.end(),
                                      [&](const auto &node) { return is_on(node, boundary.id); }))
      result.emplace_back(scene, boundary, nodes);
  return result;
}
} // namespace hpvi
