// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/coarse_mesh.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/tensor.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

EdgeCurves::EdgeCurves(const CoarseMesh &mesh) : mesh(mesh)
{
  for (const CoarseMesh::Edge &edge : mesh.edges)
    if (edge.curve)
    {
      curves[edge.vertices] = edge.curve;
      curves[{{edge.vertices[1], edge.vertices[0]}}] = edge.curve.between(1, 0);
    }
}

CurvePiece EdgeCurves::operator()(const unsigned int from, const unsigned int to) const
{
  const auto found = curves.find({{from, to}});
  return found == curves.end() ? CurvePiece() : found->second;
}

BlendedCell::BlendedCell(const EdgeCurves &edges, const unsigned int cell)
{
  const auto &vertices = edges.mesh.cells[cell].vertices;
  for (unsigned int v = 0; v < 4; ++v)
  {
    corners[v] = edges.mesh.vertices[vertices[v]];
    curves[v] = edges(vertices[v], vertices[(v + 1) % 4]);
  }
}

Point<2> BlendedCell::along(const unsigned int edge, const double s) const
{
  return curves[edge] ? curves[edge].point(s)
                      : corners[edge] + s * (corners[(edge + 1) % 4] - corners[edge]);
}

Tensor<1, 2> BlendedCell::derivative(const unsigned int edge, const double s) const
{
  return curves[edge] ? curves[edge].derivative(s) : corners[(edge + 1) % 4] - corners[edge];
}

Point<2> BlendedCell::point(const double s, const double t) const
{
  const Tensor<1, 2> edges = (1 - t) * along(0, s) + s * Tensor<1, 2>(along(1, t)) +
                             t * Tensor<1, 2>(along(2, 1 - s)) +
                             (1 - s) * Tensor<1, 2>(along(3, 1 - t)),
                     bilinear = (1 - s) * ((1 - t) * corners[0] + t * Tensor<1, 2>(corners[3])) +
                                s * ((1 - t) * corners[1] + t * Tensor<1, 2>(corners[2]));
  return Point<2>(edges - bilinear);
}

double BlendedCell::determinant(const double s, const double t) const
{
  const Tensor<1, 2> below = (1 - t) * (corners[1] - corners[0]) + t * (corners[2] - corners[3]),
                     beside = (1 - s) * (corners[3] - corners[0]) + s * (corners[2] - corners[1]),
                     by_s = (1 - t) * derivative(0, s) - t * derivative(2, 1 - s) +
                            (along(1, t) - along(3, 1 - t)) - below,
                     by_t = s * derivative(1, t) - (1 - s) * derivative(3, 1 - t) +
                            (along(2, 1 - s) - along(0, s)) - beside;
  return by_s[0] * by_t[1] - by_s[1] * by_t[0];
}

double BlendedCell::angle(const unsigned int corner) const
{
  const Tensor<1, 2> out = derivative(corner, 0), in = derivative((corner + 3) % 4, 1);
  const double turn = std::atan2(in[0] * out[1] - in[1] * out[0], in * out);
  return 180 - turn * 180 / numbers::PI;
}

CellFlaw worst_cell(const CoarseMesh &mesh)
{
  CellFlaw worst;
  const QGauss<1> gauss(8);
  const EdgeCurves curves(mesh);
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
  {
    const BlendedCell cell(curves, c);
    for (unsigned int v = 0; v < 4; ++v)
      if (const double angle = cell.angle(v);
          angle > worst.angle + 1e-9) // round-off does not choose
        worst = {mesh.vertices[mesh.cells[c].vertices[v]], angle};
    for (const Point<1> &s : gauss.get_points())
      for (const Point<1> &t : gauss.get_points())
        if (!(cell.determinant(s[0], t[0]) > 0))
          return {cell.point(s[0], t[0]), 0, true};
  }
  return worst;
}
} // namespace hpvi
