// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/contact/tangential_trace.h>

#include <algorithm>
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
  for (const ContactFace<dim> &face : contact_space.faces())
  {
    if (face.condition->id != boundary)
      continue;
    if (pieces.empty())
    {
      tangent = face.frame(0.5).tangent;
      origin = face.point(0.);
    }
    const auto dofs = displacement_space.cell_dofs(face.cell->active_cell_index());
    const std::vector<unsigned int> &on_edge = tables.numbering(face.degree).edge[face.face_no];
    const QGaussLobatto<1> &rule = tables.gauss_lobatto(face.degree + 1);
    Piece piece{(face.point(0.) - origin) * tangent, (face.point(1.) - origin) * tangent, {}, {}};
    for (unsigned int k = 0; k < rule.size(); ++k)
    {
      piece.nodes.push_back(rule.point(k)[0]);
      piece.u_t.push_back(0.);
      for (unsigned int c = 0; c < dim; ++c)
        piece.u_t.back() += tangent[c] * u[dofs[on_edge[c * rule.size() + k]]];
    }
    if (piece.begin > piece.end) // the nodes lie symmetrically
    {
      std::swap(piece.begin, piece.end);
      std::reverse(piece.u_t.begin(), piece.u_t.end());
    }
    pieces.push_back(piece);
  }
}

template <int dim>
double TangentialTrace<dim>::value(const Point<dim> &x, const unsigned int) const
{
  const double place = (x - origin) * tangent;
  const auto after = std::upper_bound(pieces.begin(), pieces.end(), place,
                                      [](const double a, const Piece &b) { return a < b.begin; });
  const Piece &piece = after == pieces.begin() ? pieces.front() : *std::prev(after);
  const std::vector<double> basis =
      lagrange_basis(piece.nodes, (place - piece.begin) / (piece.end - piece.begin));
  return std::inner_product(basis.begin(), basis.end(), piece.u_t.begin(), 0.);
}

template <int dim>
PastSlip<dim> past_slip(const ContactSpace<dim> &contact_space,
                        const DisplacementSpace<dim> &displacement_space,
                        const ShapeTables<dim> &tables, const Vector<double> &u)
{
  PastSlip<dim> result;
  for (const ContactFace<dim> &face : contact_space.faces())
    if (face.condition->friction && result.count(face.condition->id) == 0)
      result[face.condition->id] = std::make_shared<const TangentialTrace<dim>>(
          contact_space, displacement_space, tables, u, face.condition->id);
  return result;
}

template class TangentialTrace<2>;
template PastSlip<2> past_slip(const ContactSpace<2> &, const DisplacementSpace<2> &,
                               const ShapeTables<2> &, const Vector<double> &);
} // namespace hpvi
