// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/edge_bubbles.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Unknowns of degree q on the boundary of a cell from those of degree p. */
FullMatrix<double> embedding(const unsigned int p, const unsigned int q,
                             const ShapeTables<2> &tables)
{
  const LocalNumbering &low = tables.numbering(p), &high = tables.numbering(q);
  const EdgeInterpolation &along = tables.edge_interpolation(p, p, q, whole_edge);
  FullMatrix<double> result(high.n_boundary, low.n_boundary);
  for (unsigned int face = 0; face < high.edge.size(); ++face)
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int j = 0; j <= q; ++j)
        for (unsigned int i = 0; i <= p; ++i) // a vertex has its 1 from both of its edges
          result(high.edge[face][c * (q + 1) + j], low.edge[face][c * (p + 1) + along.nodes[i]]) =
              along.weights(j, i);
  return result;
}
} // namespace

EdgeBubbles::Energies EdgeBubbles::energies(const Traces &traces, const Scene<2> &scene,
                                            const ShapeTables<2> &tables)
{
  const ContactFace<2> &face = *traces[0].first;
  const unsigned int q = traces[0].second.m() / 2 - 1;
  unsigned int n = 0;
  for (const auto &[on_face, columns] : traces)
    n += columns.n();
  const auto material = face.cell->material_id();
  auto &element =
      elements[ElementMatrices<2>(scene, tables).congruence_class(face.map, q, material)];
  if (!element)
    element = CondensedElements<2>(scene, tables).get(face.map, q, material);
  const FullMatrix<double> &K = element->condensed;
  FullMatrix<double> b(K.m(), n), forces(K.m(), n);
  unsigned int first = 0;
  for (const auto &[on_face, columns] : traces)
  {
    const std::vector<unsigned int> &on_edge = tables.numbering(q).edge[on_face->face_no];
    for (unsigned int i = 0; i < on_edge.size(); ++i)
      for (unsigned int j = 0; j < columns.n(); ++j)
        b(on_edge[i], first + j) = columns(i, j);
    first += columns.n();
  }
  K.mmult(forces, b);
  Energies result;
  result.own.reinit(n, n);
  b.Tmmult(result.own, forces);
  // What is inside a cell, of a shape function too, does no work on a displacement of least energy.
  const FullMatrix<double> shapes = embedding(face.degree, q, tables);
  result.with_shapes.reinit(shapes.n(), n);
  shapes.Tmmult(result.with_shapes, forces);
  return result;
}
} // namespace hpvi
