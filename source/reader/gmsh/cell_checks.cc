// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/cell_checks.h>
#include <hpvi/scene/geometry.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

double degrees_between(const Tensor<1, 2> &one, const Tensor<1, 2> &two)
{
  const double angle = std::atan2(one[0] * two[1] - one[1] * two[0], one * two) * 180 / numbers::PI;
  return angle < 0 ? angle + 360 : angle;
}

namespace
{
double corner_degrees(const CoarseMesh &mesh, const CoarseMesh::Cell &cell,
                      const unsigned int corner)
{
  const auto vertex = [&](const unsigned int k) { return mesh.vertices[cell.vertices[k % 4]]; };
  return degrees_between(vertex(corner + 1) - vertex(corner), vertex(corner + 3) - vertex(corner));
}

bool is_clockwise(const CoarseMesh &mesh, const CoarseMesh::Cell &cell)
{
  const auto &v = cell.vertices;
  const Tensor<1, 2> one = mesh.vertices[v[2]] - mesh.vertices[v[0]],
                     two = mesh.vertices[v[3]] - mesh.vertices[v[1]];
  return one[0] * two[1] < one[1] * two[0];
}

constexpr double least_degrees = 0.1, largest_degrees = 179.9;

bool is_bad(const double degrees)
{
  return !(degrees > least_degrees && degrees < largest_degrees);
}

/** How far from 90, so that the worst is told. */
double badness(const double degrees)
{
  return std::abs(degrees - 90);
}
} // namespace

void orient_cells(CoarseMesh &mesh, const std::vector<std::size_t> &numbers,
                  const MeshComplaint &complain)
{
  unsigned int n_bad = 0;
  std::size_t number = 0;
  Corner worst = {{}, 90};
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
  {
    CoarseMesh::Cell &cell = mesh.cells[c];
    if (is_clockwise(mesh, cell))
      std::swap(cell.vertices[1], cell.vertices[3]);
    bool bad = false;
    for (unsigned int k = 0; k < 4; ++k)
      if (const double degrees = corner_degrees(mesh, cell, k); is_bad(degrees))
      {
        bad = true;
        if (badness(degrees) > badness(worst.degrees))
        {
          worst = {mesh.vertices[cell.vertices[k]], degrees};
          number = numbers[c];
        }
      }
    n_bad += bad;
  }
  if (n_bad > 0)
    complain.of(number, "the cell has a corner of " + to_string(worst.degrees) + " degrees at " +
                            to_string(worst.at) +
                            (n_bad > 1 ? ", one of " + std::to_string(n_bad) + " such cells" : "") +
                            "; corners must be convex: mesh finer, or with another "
                            "Mesh.RecombinationAlgorithm");
}

namespace
{
/** Angles around a vertex of one sheet do not exceed a full turn. */
void check_angles(const CoarseMesh &mesh, const MeshComplaint &complain)
{
  std::vector<double> sums(mesh.vertices.size(), 0.);
  for (const CoarseMesh::Cell &cell : mesh.cells)
    for (unsigned int k = 0; k < 4; ++k)
      sums[cell.vertices[k]] += corner_degrees(mesh, cell, k);
  for (unsigned int v = 0; v < sums.size(); ++v)
    if (sums[v] > 360.1)
      complain("cells overlap around the point " + to_string(mesh.vertices[v]) +
               "; remove the surface that overlaps others from the drawing");
}

/** Vertices by their place along the longer axis of the body: few lie beside an edge. */
class SortedVertices
{
public:
  explicit SortedVertices(const CoarseMesh &mesh) : mesh(mesh), order(mesh.vertices.size())
  {
    Point<2> low = mesh.vertices[0], high = low;
    for (const Point<2> &x : mesh.vertices)
      for (unsigned int d = 0; d < 2; ++d)
      {
        low[d] = std::min(low[d], x[d]);
        high[d] = std::max(high[d], x[d]);
      }
    axis = high[0] - low[0] < high[1] - low[1] ? 1 : 0;
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](const unsigned int v, const unsigned int w)
              { return mesh.vertices[v][axis] < mesh.vertices[w][axis]; });
  }

  /** One in the inner of the edge between two others, up to round-off; CoarseMesh::inside: none. */
  unsigned int on_edge(const std::array<unsigned int, 2> &ends) const
  {
    const Point<2> a = mesh.vertices[ends[0]], b = mesh.vertices[ends[1]];
    const Tensor<1, 2> chord = b - a;
    const double margin = 1e-10 * chord.norm(), high = std::max(a[axis], b[axis]) + margin;
    auto v = std::lower_bound(order.begin(), order.end(), std::min(a[axis], b[axis]) - margin,
                              [&](const unsigned int w, const double x)
                              { return mesh.vertices[w][axis] < x; });
    for (; v != order.end() && mesh.vertices[*v][axis] <= high; ++v)
    {
      const Tensor<1, 2> offset = mesh.vertices[*v] - a;
      const double along = (offset * chord) / (chord * chord);
      if (*v != ends[0] && *v != ends[1] && along > 0 && along < 1 &&
          (offset - along * chord).norm() <= margin)
        return *v;
    }
    return CoarseMesh::inside;
  }

private:
  const CoarseMesh &mesh;
  std::vector<unsigned int> order;
  unsigned int axis;
};

void check_hanging_nodes(const CoarseMesh &mesh, const CellEdges &edges,
                         const MeshComplaint &complain)
{
  const SortedVertices vertices(mesh);
  for (const unsigned int e : edges.loops())
    if (const unsigned int v = vertices.on_edge(edges.all()[e].vertices); v != CoarseMesh::inside)
      complain("the node at " + to_string(mesh.vertices[v]) + " hangs on the edge " +
               edge_in_words(mesh, edges.all()[e].vertices) +
               " of another cell; give both surfaces one curve there, Coherence in the drawing "
               "makes it, or a subsection Body NAME for each with its Surfaces, if they are bodies "
               "of their own");
}
} // namespace

void check_connection(const CoarseMesh &mesh, const CellEdges &edges, const MeshComplaint &complain)
{
  check_angles(mesh, complain);
  check_hanging_nodes(mesh, edges, complain);
}
} // namespace hpvi
