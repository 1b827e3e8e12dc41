// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/restricted_energy.h>
#include <hpvi/bound/admissible_contact.h>
#include <hpvi/bound/nodal_displacement.h>
#include <hpvi/bound/pressed_face.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace hpvi
{
using namespace dealii;

MatchingContact::MatchingContact(const Solution<2> &solution,
                                 const Discretisation<2> &discretisation,
                                 const AdmissibleFriction<2> &friction,
                                 const AdmissiblePressure<2> &pressure,
                                 const ContactCorrection<2> &correction)
    : solution(solution), discretisation(discretisation), friction(friction), pressures(pressure),
      correction(correction)
{
}

double MatchingContact::slip(const unsigned int face, const double s) const
{
  return correction.slip(face)(s);
}

double MatchingContact::room(const unsigned int face, const double s) const
{
  return -correction.penetration_along(face)(s);
}

double MatchingContact::largest_slip(const unsigned int face) const
{
  return correction.slip(face).largest();
}

double MatchingContact::pressure(const unsigned int face, const double s) const
{
  return pressures.value(face)(s);
}

double MatchingContact::direction(const unsigned int face, const double s) const
{
  return friction.value(face, s);
}

std::vector<double> MatchingContact::kinks(unsigned int) const
{
  return {0., 1.};
}

std::vector<std::pair<double, double>> MatchingContact::points(const unsigned int k) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[k];
  std::vector<double> cuts = correction.slip(k).zeros();
  cuts.insert(cuts.end(), {0., 1.});
  cuts.insert(cuts.end(), face.friction.cuts.begin(), face.friction.cuts.end());
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  const QGauss<1> &gauss = solution.tables.gauss(face.degree + 12);
  std::vector<std::pair<double, double>> result;
  for (unsigned int i = 0; i + 1 < cuts.size(); ++i)
    for (unsigned int q = 0; q < gauss.size(); ++q)
      result.emplace_back(cuts[i] + (cuts[i + 1] - cuts[i]) * gauss.point(q)[0],
                          face.length * (cuts[i + 1] - cuts[i]) * gauss.weight(q));
  return result;
}

namespace
{
/** Faces that touch one with a bump, or have one. X moves nodes of these alone. Where bodies touch all have some. */
std::vector<bool> near_bumps(const std::vector<ContactFace<2>> &faces,
                             const std::vector<Bump> &bumps)
{
  std::set<unsigned int> vertices;
  const auto ends = [&](const unsigned int k)
  {
    const auto face = faces[k].cell->face(faces[k].face_no);
    return std::array<unsigned int, 2>{{face->vertex_index(0), face->vertex_index(1)}};
  };
  bool has_pairs = false;
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    has_pairs = has_pairs || !faces[k].segments.empty();
    if (!bumps[k].is_zero())
      for (const unsigned int vertex : ends(k))
        vertices.insert(vertex);
  }
  std::vector<bool> result(faces.size());
  for (unsigned int k = 0; k < faces.size(); ++k)
    result[k] = has_pairs || vertices.count(ends(k)[0]) > 0 || vertices.count(ends(k)[1]) > 0;
  return result;
}
} // namespace

double MatchingContact::lift(const std::vector<Bump> &bumps) const
{
  const std::vector<ContactFace<2>> &faces = solution.contact_space.faces();
  const NodeFreedom freedom(solution, discretisation.unknowns);
  NodalDisplacement<2> X(solution, freedom);
  const std::vector<bool> near = near_bumps(faces, bumps);
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (near[k] && (faces[k].condition->friction || faces[k].condition->is_tied()))
      X.wish(faces[k], faces[k].frame(0.5).tangent, [](const double) { return 0.; });
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (near[k])
      X.wish(faces[k], faces[k].frame(0.5).normal, bumps[k]);
  X.move();
  double largest = 0;
  for (const Bump &bump : bumps)
    largest = std::max(largest, bump.largest());
  const auto is_moved = [&](const ContactFace<2> &face)
  {
    const FaceDofs<2> dofs(face, solution.displacement_space, solution.tables);
    return std::any_of(dofs.own.begin(), dofs.own.end(),
                       [&](const types::global_dof_index dof) { return X.u[dof] != 0.; });
  };
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    if (!near[k] && !is_moved(faces[k]))
      continue;
    const auto along = [&](const Tensor<1, 2> &direction)
    { return edge_trace(faces[k], direction, solution.displacement_space, solution.tables, X.u); };
    const EdgePolynomial normal = along(faces[k].frame(0.5).normal),
                         tangent = along(faces[k].frame(0.5).tangent);
    if ((faces[k].condition->friction || faces[k].condition->is_tied()) &&
        tangent.largest() > 1e-9 * largest)
      return std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i <= 8; ++i)
      if (std::abs(normal(i / 8.) - bumps[k](i / 8.)) > 1e-9 * largest)
        return std::numeric_limits<double>::infinity();
  }
  const Vector<double> x = discretisation.unknowns.coordinates(X.u);
  return std::sqrt(std::max(0., BorderedMatrix{discretisation.system.A, {}}.energy(x)));
}
} // namespace hpvi
