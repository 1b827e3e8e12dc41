// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/correction_search.h>
#include <hpvi/bound/nodal_displacement.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The polynomial over that of degree 1 or 2 which vanishes at some ends and is 1 at the other, or s (1 - s). */
EdgePolynomial divided(const EdgePolynomial &polynomial, const std::array<bool, 2> &ends,
                       const ShapeTables<2> &tables)
{
  const QGauss<1> &gauss = tables.gauss(polynomial.coefficients().size());
  std::vector<double> values;
  for (const Point<1> &point : gauss.get_points())
  {
    const double s = point[0];
    values.push_back(polynomial(s) / ((ends[0] ? s : 1.) * (ends[1] ? 1. - s : 1.)));
  }
  return EdgePolynomial::through(values, gauss);
}
} // namespace

double height_over(const EdgePolynomial &polynomial, const std::array<bool, 2> &held,
                   const double round_off, const ShapeTables<2> &tables)
{
  // An end where the polynomial is zero can be divided out; one where it is negative has a pole, and polynomials that follow
  // that oscillate. But there it is positive at a distance only, no less than that of its last zero.
  constexpr double touching = 1e-8;
  const std::vector<double> zeros = polynomial.zeros();
  std::array<bool, 2> touches{};
  double distances = 1.;
  for (unsigned int end = 0; end < 2; ++end)
    if (held[end])
    {
      touches[end] = std::abs(polynomial(end)) <= touching * polynomial.largest();
      if (!touches[end] && !zeros.empty())
        distances *= end == 0 ? zeros.front() : 1. - zeros.back();
    }
  return largest_value(touches[0] || touches[1] ? divided(polynomial, touches, tables) : polynomial,
                       round_off) /
         distances;
}

double largest_value(const EdgePolynomial &polynomial, const double round_off)
{
  double result = 0.;
  if (polynomial.largest() <= round_off || polynomial.enclosure().second <= 0.)
    return result;
  for (const double s : polynomial.extremes())
    result = std::max(result, polynomial(s));
  return result;
}

/**
 * The unknowns of a displacement that is u_Nt where the body sticks and u_Nn - u_0 where it presses;
 * elsewhere of no use.
 */
template <int dim>
Vector<double> CorrectionSearch<dim>::fixed_displacement() const
{
  NodalDisplacement<dim> all(solution, freedom);
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (slips[k].mode == Slip::nowhere)
      all.wish(faces[k], faces[k].frame(0.5).tangent, EdgePolynomial(traces[k].u));
  all.move(); // a tangent of one side may be the normal of another, which matters more
  for (const Joint &joint : joints)
    all.wish(faces[joint.face], joint.direction, EdgePolynomial(joint.trace.u));
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (openings[k] && openings[k]->mode == Opening::closed)
      all.wish(faces[k], faces[k].frame(0.5).normal, EdgePolynomial(openings[k]->penetration.u));
  all.move();
  Vector<double> result = discretisation.unknowns.coordinates(all.u);
  result.grow_or_shrink(A.n());
  return result;
}

/** The largest jump of u_N - w along joints that must not open; 0 where that is round-off. */
template <int dim>
double CorrectionSearch<dim>::open_joints(const Vector<double> &w) const
{
  double result = 0;
  for (const Joint &joint : joints)
    result = std::max(result, joint.trace.rest(w).largest());
  return result <= 1e-12 * solution.u.linfty_norm() ? 0. : result;
}

/** Is the normal displacement at an end of a face prescribed, by supports or by joints that meet there, so that w_n vanishes? */
template <int dim>
std::vector<std::array<bool, 2>> CorrectionSearch<dim>::held_ends() const
{
  NodalDisplacement<dim> still(solution, freedom);
  for (const Joint &joint : joints)
    still.wish(faces[joint.face], joint.direction, [](const double) { return 0.; });
  return still.held_ends(faces);
}

/** The ends of faces by the first displacement unknown of one of all vertices that lie opposite to each other there. */
template <int dim>
std::vector<std::array<types::global_dof_index, 2>> CorrectionSearch<dim>::meeting_places() const
{
  std::map<types::global_dof_index, types::global_dof_index> next; // to the one that stands for all
  const auto last = [&](types::global_dof_index vertex)
  {
    while (next.emplace(vertex, vertex).first->second != vertex)
      vertex = next[vertex];
    return vertex;
  };
  std::vector<std::array<types::global_dof_index, 2>> result;
  for (const ContactFace<dim> &face : faces)
  {
    const FaceDofs<dim> dofs(face, solution.displacement_space, solution.tables);
    for (const unsigned int node : {0U, face.degree})
      if (!dofs.opposite.empty())
        next[last(dofs.opposite[node])] = last(dofs.own[node]);
    result.push_back({{dofs.own[0], dofs.own[face.degree]}});
  }
  for (auto &ends : result)
    for (types::global_dof_index &vertex : ends)
      vertex = last(vertex);
  return result;
}

/** Of the sides that meet at a place each direction has its own; what is on one side, or along one normal, moves together. */
template <int dim>
double &CorrectionSearch<dim>::Heights::at(const types::global_dof_index place,
                                           const ContactFace<dim> &face)
{
  const Tensor<1, dim> normal = face.frame(0.5).normal;
  for (AtVertex &known : at_vertices[place])
    if (known.side == face.condition->id || std::abs(std::abs(known.normal * normal) - 1.) < 1e-12)
      return known.height;
  at_vertices[place].push_back({face.condition->id, normal, 0.});
  return at_vertices[place].back().height;
}

/** The largest of u_Nn - w_n - u_0, and the heights that take it away: each vertex has the largest of its faces on either side. */
template <int dim>
double CorrectionSearch<dim>::penetration(const Vector<double> &w, Heights &heights) const
{
  double result = 0;
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (openings[k])
    {
      const EdgePolynomial rest = openings[k]->penetration.rest(w);
      const double depth = largest_value(rest, tolerance);
      result = std::max(result, depth);
      if (depth == 0.)
        continue;
      const std::array<bool, 2> &held = are_held[k];
      const double height =
          held[0] || held[1] ? height_over(rest, held, tolerance, solution.tables) : depth;
      if (held[0] && held[1])
        heights.on_faces[k] = height;
      for (unsigned int end = 0; end < 2; ++end)
        if (!held[end])
        {
          double &at_vertex = heights.at(places[k][end], faces[k]);
          at_vertex = std::max(at_vertex, height);
        }
    }
  return result;
}

/**
 * w_n += a function that takes away what penetrates, linear along each face, quadratic where both ends are held. Returns
 * by how much it still does, because supports are in the way; 0 where that is round-off.
 */
template <int dim>
double CorrectionSearch<dim>::lift(Vector<double> &w) const
{
  Heights heights;
  if (penetration(w, heights) <= tolerance)
    return 0.;
  NodalDisplacement<dim> lifting(solution, freedom);
  for (const Joint &joint : joints) // stay as they are
    lifting.wish(faces[joint.face], joint.direction, [](const double) { return 0.; });
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (openings[k])
    {
      const double first = heights.at(places[k][0], faces[k]),
                   last = heights.at(places[k][1], faces[k]), inside = heights.on_faces[k];
      if (first > 0. || last > 0. || inside > 0.)
        lifting.wish(faces[k], faces[k].frame(0.5).normal,
                     [first, last, inside](const double s) {
                       return (1. + 1e-10) * (first + s * (last - first) + s * (1. - s) * inside);
                     });
    }
  lifting.move();
  const Vector<double> lifted = discretisation.unknowns.coordinates(lifting.u);
  for (unsigned int i = 0; i < lifted.size(); ++i)
    w[i] += lifted[i];
  const double rest = penetration(w, heights);
  return rest <= std::max(tolerance, 1e-12 * solution.u.linfty_norm()) ? 0. : rest;
}

template Vector<double> CorrectionSearch<2>::fixed_displacement() const;
template double CorrectionSearch<2>::open_joints(const Vector<double> &) const;
template std::vector<std::array<bool, 2>> CorrectionSearch<2>::held_ends() const;
template std::vector<std::array<types::global_dof_index, 2>>
CorrectionSearch<2>::meeting_places() const;
template double CorrectionSearch<2>::lift(Vector<double> &) const;
} // namespace hpvi
