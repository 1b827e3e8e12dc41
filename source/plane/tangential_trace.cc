// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/tangential_trace.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace hpvi
{
using namespace dealii;

template <int dim>
TangentialTrace<dim>::TangentialTrace(const ContactSpace<dim> &contact_space,
                                      const DisplacementSpace<dim> &displacement_space,
                                      const ShapeTables<dim> &tables, const Vector<double> &u,
                                      const types::boundary_id boundary)
{
  Point<dim> last;
  for (const ContactFace<dim> &face : contact_space.faces())
    if (face.condition->id == boundary)
    {
      const Point<dim> x = face.point(0.5);
      if (tangent.norm_square() == 0)
      {
        tangent = face.frame(0.5).tangent;
        last = origin = face.point(0.);
      }
      is_straight = is_straight && !face.map.is_curved() &&
                    (face.frame(0.5).tangent - tangent).norm() < same_normal &&
                    (x - last) * tangent >= 0;
      last = x;
    }
  for (const ContactFace<dim> &face : contact_space.faces())
  {
    if (face.condition->id != boundary)
      continue;
    if (!face.segments.empty())
    {
      add_jump(face, displacement_space, tables, u);
      continue;
    }
    const auto dofs = displacement_space.cell_dofs(face.cell->active_cell_index());
    const std::vector<unsigned int> &on_edge = tables.numbering(face.degree).edge[face.face_no];
    const QGaussLobatto<1> &rule = tables.gauss_lobatto(face.degree + 1);
    Piece piece{(face.point(0.) - origin) * tangent,
                (face.point(1.) - origin) * tangent,
                {},
                {},
                {{face.point(0.), face.point(1.)}},
                {}};
    if (face.map.is_curved() && face.map.blends()[face.face_no])
      piece.curve = face.map.blends()[face.face_no].curve();
    for (unsigned int k = 0; k < rule.size(); ++k)
    {
      const Tensor<1, dim> t = is_straight ? tangent : face.node_frame(rule.point(k)[0]).tangent;
      piece.nodes.push_back(rule.point(k)[0]);
      piece.u_t.push_back(0.);
      for (unsigned int c = 0; c < dim; ++c)
        piece.u_t.back() += t[c] * u[dofs[on_edge[c * rule.size() + k]]];
    }
    if (piece.begin > piece.end && is_straight) // the nodes lie symmetrically
    {
      std::swap(piece.begin, piece.end);
      std::swap(piece.ends[0], piece.ends[1]);
      std::reverse(piece.u_t.begin(), piece.u_t.end());
    }
    pieces.push_back(piece);
  }
}

namespace
{
/** u at @p s of an edge by the nodal values there. */
template <int dim>
Tensor<1, dim> edge_value(const typename DoFHandler<dim>::active_cell_iterator &cell,
                          const unsigned int face_no, const unsigned int degree, const double s,
                          const DisplacementSpace<dim> &space, const ShapeTables<dim> &tables,
                          const Vector<double> &u)
{
  std::vector<double> nodes;
  for (const Point<1> &node : tables.gauss_lobatto(degree + 1).get_points())
    nodes.push_back(node[0]);
  const std::vector<double> basis = lagrange_basis(nodes, s);
  const auto dofs = space.cell_dofs(cell->active_cell_index());
  const std::vector<unsigned int> &edge = tables.numbering(degree).edge[face_no];
  Tensor<1, dim> result;
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int j = 0; j <= degree; ++j)
      result[c] += basis[j] * u[dofs[edge[c * (degree + 1) + j]]];
  return result;
}
} // namespace

/** Of two bodies the jump of u_t, a polynomial on each segment; along curves one through some points more. */
template <int dim>
void TangentialTrace<dim>::add_jump(const ContactFace<dim> &face,
                                    const DisplacementSpace<dim> &space,
                                    const ShapeTables<dim> &tables, const Vector<double> &u)
{
  for (const ContactSegment<dim> &segment : face.segments)
  {
    const unsigned int degree = std::max(face.degree, segment.degree + (segment.drawn ? 4 : 0));
    const QGaussLobatto<1> &rule = tables.gauss_lobatto(degree + 1);
    const std::array<Point<dim>, 2> ends{{face.point(segment.begin), face.point(segment.end)}};
    Piece piece{(ends[0] - origin) * tangent, (ends[1] - origin) * tangent, {}, {}, ends, {}};
    if (face.map.is_curved() && face.map.blends()[face.face_no])
      piece.curve = face.map.blends()[face.face_no].curve().between(segment.begin, segment.end);
    for (const Point<1> &node : rule.get_points())
    {
      const double s = segment.begin + node[0] * (segment.end - segment.begin);
      const Tensor<1, dim> t = is_straight ? tangent : face.frame(s).tangent;
      piece.nodes.push_back(node[0]);
      piece.u_t.push_back(t *
                          (edge_value(face.cell, face.face_no, face.degree, s, space, tables, u) -
                           edge_value(segment.cell, segment.face_no, segment.degree,
                                      segment.opposite(s), space, tables, u)));
    }
    if (piece.begin > piece.end && is_straight)
    {
      std::swap(piece.begin, piece.end);
      std::swap(piece.ends[0], piece.ends[1]);
      std::reverse(piece.u_t.begin(), piece.u_t.end());
    }
    pieces.push_back(piece);
  }
  if (is_straight)
    std::sort(pieces.begin(), pieces.end(),
              [](const Piece &a, const Piece &b) { return a.begin < b.begin; });
}

template <int dim>
double TangentialTrace<dim>::Piece::nearest(const Point<dim> &x) const
{
  if (curve)
    return curve.nearest(x);
  const Tensor<1, dim> way = ends[1] - ends[0];
  return std::clamp((x - ends[0]) * way / way.norm_square(), 0., 1.);
}

template <int dim>
double TangentialTrace<dim>::Piece::value(const double s) const
{
  const std::vector<double> basis = lagrange_basis(nodes, s);
  return std::inner_product(basis.begin(), basis.end(), u_t.begin(), 0.);
}

template <int dim>
const typename TangentialTrace<dim>::Piece &
TangentialTrace<dim>::piece_at(const Point<dim> &x) const
{
  const Piece *result = &pieces.front();
  double least = std::numeric_limits<double>::max();
  for (const Piece &piece : pieces)
  {
    const Tensor<1, dim> chord = piece.ends[1] - piece.ends[0];
    if ((piece.ends[0] + chord / 2.).distance(x) - chord.norm() > least)
      continue; // farther whatever its curve does
    const double s = piece.nearest(x);
    const Point<dim> there =
        piece.curve ? piece.curve.point(s) : piece.ends[0] + s * (piece.ends[1] - piece.ends[0]);
    if (const double distance = there.distance(x); distance < least)
    {
      least = distance;
      result = &piece;
    }
  }
  return *result;
}

template <int dim>
double TangentialTrace<dim>::value(const Point<dim> &x, const unsigned int) const
{
  if (!is_straight)
  {
    const Piece &piece = piece_at(x);
    return piece.value(piece.nearest(x));
  }
  const double place = (x - origin) * tangent;
  const auto after = std::upper_bound(pieces.begin(), pieces.end(), place,
                                      [](const double a, const Piece &b) { return a < b.begin; });
  const Piece &piece = after == pieces.begin() ? pieces.front() : *std::prev(after);
  return piece.value((place - piece.begin) / (piece.end - piece.begin));
}

template <int dim>
PastSlip<dim> past_slip(const ContactSpace<dim> &contact_space,
                        const DisplacementSpace<dim> &displacement_space,
                        const ShapeTables<dim> &tables, const Vector<double> &u)
{
  PastSlip<dim> result;
  for (const ContactFace<dim> &face : contact_space.faces())
    if (face.condition->friction && result.count(face.condition->id) == 0)
    {
      const auto trace = std::make_shared<const TangentialTrace<dim>>(
          contact_space, displacement_space, tables, u, face.condition->id);
      result[face.condition->id] = trace;
      if (!face.segments
               .empty()) // the other side may have the multipliers next; the jump is the same from there
        result[face.segments.front().boundary()] = trace;
    }
  return result;
}

template class TangentialTrace<2>;
template PastSlip<2> past_slip(const ContactSpace<2> &, const DisplacementSpace<2> &,
                               const ShapeTables<2> &, const Vector<double> &);
} // namespace hpvi
