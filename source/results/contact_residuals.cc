// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/results/contact_residuals.h>
#include <hpvi/results/turned_divergence.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
Point<dim> on_edge(const unsigned int face_no, const double s)
{
  Point<dim - 1> place;
  place[0] = s;
  return point_on_face<dim>(face_no, place);
}
} // namespace

template <int dim>
double penetration(const FieldFace<dim> &face, const Field<dim> &field)
{
  const ShapeTable<dim> &table =
      field.tables.face(face.degree(), face.face_no, 2 * (face.degree() + 1));
  const unsigned int n = table.points.size();
  const Material *material = &field.scene.material_of(face.cell);
  for (const types::material_id opposite : field.materials_opposite(face))
    if (const Material &other = field.scene.materials[opposite];
        other.residual_weight() < material->residual_weight())
      material = &other;
  const double weight = material->residual_weight(),
               softest = field.scene.reference_coercivity() / material->coercivity(dim);
  const std::vector<double> u = evaluate(table.values, field.coefficients(face.cell));
  double sum = 0;
  for (unsigned int q = 0; q < n; ++q)
  {
    const FaceFrame<dim> frame = face.frame(table.points[q]);
    const Tensor<1, dim> jump = vector_at<dim>(u, n, q) - field.opposite(face, table.points[q]);
    double depth = -face.condition->gap_at(frame.x);
    for (unsigned int c = 0; c < dim; ++c)
      depth += frame.normal[c] * jump[c];
    if (face.condition->is_unilateral())
      depth = std::max(depth, 0.);
    const double along = face.condition->is_tied() ? size_of(frame.tangential(jump)) : 0.;
    sum += table.weights[q] * frame.measure *
           (std::pow(weight * depth, 2) + std::pow(weight * along, 2));
  }
  return softest * sum;
}

template <int dim>
std::vector<OppositeResidual> opposite_residuals(const FieldFace<dim> &face,
                                                 const Field<dim> &field,
                                                 const Tractions<dim> &tractions)
{
  std::vector<OppositeResidual> result;
  for (const ContactSegment<dim> &segment : field.segments(face))
  {
    const CellMap<dim> map = map_of<dim>(segment.cell);
    const QGauss<1> &gauss = field.tables.gauss(std::max(face.degree(), segment.degree) + 1);
    const double width = segment.end - segment.begin;
    std::vector<Point<dim>> points;
    std::vector<Tensor<1, dim>> normals;
    for (const Point<1> &q : gauss.get_points())
    {
      points.push_back(
          on_edge<dim>(segment.face_no, segment.opposite(segment.begin + q[0] * width)));
      normals.push_back(map.normal(segment.face_no, points.back()));
    }
    const auto own = tractions(
        segment.cell, tabulate<dim>(segment.degree, points, gauss.get_weights(), false), normals);
    OppositeResidual residual{segment.cell->active_cell_index(), 0., 0.};
    for (unsigned int q = 0; q < own.size(); ++q)
    {
      const Point<dim> reference =
          on_edge<dim>(face.face_no, segment.begin + gauss.point(q)[0] * width);
      const FaceFrame<dim> frame = face.frame(reference);
      const ContactTraction<dim> contact = field.traction(face, reference);
      const double ds = width * gauss.weight(q) * frame.measure;
      for (unsigned int d = 0; d < dim - 1; ++d)
        residual.tangential += ds * std::pow(own[q] * frame.tangents[d] - contact.friction[d], 2);
      residual.normal += ds * std::pow(own[q] * frame.normal - contact.pressure, 2);
    }
    result.push_back(residual);
  }
  return result;
}

namespace
{
/** A part of an edge of a master that nobody lies opposite to, by coordinates in [0,1] of the edge. */
template <int dim>
struct FreePart
{
  typename Field<dim>::Cell cell;
  unsigned int face_no;
  double begin, end;
};

template <int dim>
std::vector<FreePart<dim>> free_parts(const Field<dim> &field)
{
  using Edge = std::pair<unsigned int, unsigned int>; // cell, face
  std::map<Edge, std::vector<std::array<double, 2>>> covered;
  for (const FieldFace<dim> &face : field.faces())
  {
    covered[{face.cell->active_cell_index(), face.face_no}] = {{{0., 1.}}};
    for (const ContactSegment<dim> &segment : field.segments(face))
      covered[{segment.cell->active_cell_index(), segment.face_no}].push_back(
          {{std::min(segment.at_begin, segment.at_end),
            std::max(segment.at_begin, segment.at_end)}});
  }
  std::vector<FreePart<dim>> result;
  for (const auto &cell : field.dof_handler.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->at_boundary(f) && field.scene.boundaries[cell->face(f)->boundary_id()].pair)
      {
        std::vector<std::array<double, 2>> &parts = covered[{cell->active_cell_index(), f}];
        std::sort(parts.begin(), parts.end());
        parts.push_back({{1., 1.}});
        double end = 0;
        for (const auto &[from, to] : parts)
        {
          if (from > end + same_on_edge)
            result.push_back({cell, f, end, from});
          end = std::max(end, to);
        }
      }
  return result;
}

} // namespace

template <int dim>
std::vector<OppositeResidual> free_residuals(const Field<dim> &field,
                                             const Tractions<dim> &tractions)
{
  std::vector<OppositeResidual> result;
  for (const FreePart<dim> &part : free_parts(field))
  {
    const CellMap<dim> map = map_of<dim>(part.cell);
    const unsigned int degree = field.degree(part.cell);
    const QGauss<1> &gauss = field.tables.gauss(degree + 1);
    std::vector<Point<dim>> points;
    std::vector<Tensor<1, dim>> normals;
    for (const Point<1> &q : gauss.get_points())
    {
      points.push_back(on_edge<dim>(part.face_no, part.begin + q[0] * (part.end - part.begin)));
      normals.push_back(map.normal(part.face_no, points.back()));
    }
    const auto own =
        tractions(part.cell, tabulate<dim>(degree, points, gauss.get_weights(), false), normals);
    OppositeResidual residual{part.cell->active_cell_index(), 0., 0.};
    for (unsigned int q = 0; q < own.size(); ++q)
    {
      const double ds = (part.end - part.begin) * gauss.weight(q) *
                        map.face_measure(part.face_no, points[q]),
                   along_normal = own[q] * normals[q];
      residual.normal += ds * along_normal * along_normal;
      residual.tangential += ds * (own[q].norm_square() - along_normal * along_normal);
    }
    result.push_back(residual);
  }
  return result;
}

namespace
{
/** Squares of sigma n - t at points of a face of a master, t what is exerted there. */
template <int dim>
OppositeResidual residual_at(const ExertedTraction<dim> &part, const Field<dim> &field,
                             const Tractions<dim> &tractions)
{
  const CellMap<dim> map = map_of<dim>(part.cell);
  std::vector<Tensor<1, dim>> normals;
  for (const Point<dim> &reference : part.references)
    normals.push_back(map.normal(part.face_no, reference));
  const auto own = tractions(
      part.cell, tabulate<dim>(field.degree(part.cell), part.references, part.weights, false),
      normals);
  OppositeResidual residual{part.cell->active_cell_index(), 0., 0.};
  for (unsigned int q = 0; q < own.size(); ++q)
  {
    const Tensor<1, dim> missing = own[q] - part.tractions[q];
    const double along_normal = missing * part.normal;
    residual.normal += part.weights[q] * along_normal * along_normal;
    residual.tangential += part.weights[q] * (missing.norm_square() - along_normal * along_normal);
  }
  return residual;
}
} // namespace

template <int dim>
std::vector<OppositeResidual> exerted_residuals(const Field<dim> &field,
                                                const Tractions<dim> &tractions)
{
  std::vector<OppositeResidual> result;
  for (const ExertedTraction<dim> &part : field.exerted())
    result.push_back(residual_at(part, field, tractions));
  return result;
}

template std::vector<OppositeResidual> exerted_residuals(const Field<2> &, const Tractions<2> &);
template std::vector<OppositeResidual> exerted_residuals(const Field<3> &, const Tractions<3> &);
template std::vector<OppositeResidual> free_residuals(const Field<2> &, const Tractions<2> &);
template std::vector<OppositeResidual> free_residuals(const Field<3> &, const Tractions<3> &);
template double penetration(const FieldFace<2> &, const Field<2> &);
template double penetration(const FieldFace<3> &, const Field<3> &);
template std::vector<OppositeResidual> opposite_residuals(const FieldFace<2> &, const Field<2> &,
                                                          const Tractions<2> &);
template std::vector<OppositeResidual> opposite_residuals(const FieldFace<3> &, const Field<3> &,
                                                          const Tractions<3> &);
} // namespace hpvi
