// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/edge_polynomial.h>
#include <hpvi/bound/open_contact.h>
#include <hpvi/plane/coarse_cuts.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * Half of a lower bound of u_0 - u_Nn on a face; the other half is for what u_0 has beyond polynomials. It comes from
 * 4n Chebyshev points, between which a polynomial of degree below n exceeds its values by less than a twentieth of their range (EdgePolynomial::enclosure()).
 */
double room_on(const Solution<2> &solution, const ContactFace<2> &face)
{
  const Tensor<1, 2> normal = face.frame(0.5).normal;
  const EdgePolynomial u_n =
      edge_trace(face, normal, solution.displacement_space, solution.tables, solution.u);
  // Where there is a bound, a gap that varies is a polynomial of degree p + 12, see DataError.
  const unsigned int m = 4 * (face.degree + (coarse_cuts::varies(face.condition->gap) ? 13 : 1));
  double least = std::numeric_limits<double>::max(), largest = -least;
  for (unsigned int k = 0; k < m; ++k)
  {
    const double s = 0.5 * (1 - std::cos((k + 0.5) * numbers::PI / m)),
                 room = face.condition->gap_at(face.point(s)) - u_n(s);
    least = std::min(least, room);
    largest = std::max(largest, room);
  }
  return 0.5 * (least - 0.05 * (largest - least));
}
} // namespace

OpenContact::OpenContact(const Solution<2> &solution, const ErrorBound &bound,
                         const unsigned int boundary, const Point<2> &from)
{
  const double near = 1e-9 * solution.scene.geometry.diameter(),
               nothing = 1e-20 * bound.total * bound.total;
  std::vector<Piece> all;
  for (const ContactFace<2> &face : solution.contact_space.faces())
    if (face.condition->id == boundary && !face.condition->pair)
    {
      const double a = face.point(0.).distance(from), b = face.point(1.).distance(from);
      const unsigned int cell = face.cell->active_cell_index();
      const bool is_moved = bound.moved[cell] > nothing || (!bound.moved_by_energy.empty() &&
                                                            bound.moved_by_energy[cell] > nothing);
      all.push_back({std::min(a, b), std::max(a, b), is_moved ? 0. : room_on(solution, face)});
    }
  std::sort(all.begin(), all.end(),
            [](const Piece &a, const Piece &b) { return a.begin < b.begin; });
  for (const Piece &piece : all)
  {
    if (!(piece.room > 0) || std::abs(piece.begin - length()) > near)
      return;
    pieces.push_back(piece);
  }
}

double OpenContact::length() const
{
  return pieces.empty() ? 0. : pieces.back().end;
}

double OpenContact::kappa(const double l) const
{
  double result = 0;
  for (const Piece &piece : pieces)
    result = std::max(result, (1 - piece.begin / l) / piece.room);
  return result;
}
} // namespace hpvi
