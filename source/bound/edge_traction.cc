// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/edge_traction.h>

#include <hpvi/bound/legendre.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

Point<2> EdgeTraction::point(const double s) const
{
  return begin + s * (end - begin);
}

Tensor<1, 2> EdgeTraction::value(const double s) const
{
  return Point<2>(legendre::evaluate(components[0], 2 * s - 1),
                  legendre::evaluate(components[1], 2 * s - 1));
}

unsigned int EdgeTraction::n_coefficients() const
{
  return std::max(components[0].size(), components[1].size());
}

namespace
{
/** What there is on all of an edge, on a part of it where the slave of a joint exerts more. */
EdgeTraction on_part(const EdgeTraction &whole, const RowStresses::JointPart &part,
                     const double sign)
{
  EdgeTraction result(whole);
  result.begin = whole.point(part.begin);
  result.end = whole.point(part.end);
  for (unsigned int c = 0; c < 2; ++c)
  {
    std::vector<double> &own = result.components[c];
    const unsigned int n = std::max(own.size(), part.components[c].size());
    own.resize(n);
    Vector<double> all(own.begin(), own.end()), restricted(n);
    legendre::restriction(n, part.begin, part.end).vmult(restricted, all);
    for (unsigned int i = 0; i < n; ++i)
      own[i] = restricted[i] + (i < part.components[c].size() ? sign * part.components[c][i] : 0.);
  }
  return result;
}
} // namespace

// Tractions of edges point towards growing reference coordinates of their first cell.
std::vector<EdgeTraction> edge_tractions(const EquilibratedStress &stress)
{
  const VertexPatches &patches = stress.patches();
  std::vector<EdgeTraction> result;
  for (unsigned int e = 0; e < patches.edges().size(); ++e)
  {
    const StressEdge &edge = patches.edges()[e];
    if (!edge.at_boundary())
      continue;
    const StressEdge::Side &first = edge.sides[0];
    const CellMap<2> map = map_of<2>(patches.cells()[first.cell].iterator);
    for (unsigned int k = 0; k < edge.sides.size(); ++k)
    {
      const auto &cell = patches.cells()[edge.sides[k].cell].iterator;
      const unsigned int face = edge.sides[k].face;
      EdgeTraction traction{cell,
                            face,
                            cell->face(face)->boundary_id(),
                            map.point(point_on_face<2>(first.face, Point<1>(0.))),
                            map.point(point_on_face<2>(first.face, Point<1>(1.))),
                            {}};
      const double sign = (first.face % 2 == 1) == (k == 0) ? 1. : -1.;
      for (unsigned int c = 0; c < 2; ++c)
      {
        traction.components[c].resize(std::max(edge.components[0].n, edge.components[1].n));
        for (unsigned int d = 0; d < 2; ++d)
          for (unsigned int i = 0; i < edge.components[d].n; ++i)
            traction.components[c][i] +=
                sign * edge.components[d].direction[c] * stress.tractions()[e][d][i];
      }
      const auto parts = stress.joint_parts(edge.sides[k].cell, face);
      for (const RowStresses::JointPart &part : parts)
        result.push_back(on_part(traction, part, sign));
      if (parts.empty())
        result.push_back(std::move(traction));
    }
  }
  return result;
}
} // namespace hpvi
