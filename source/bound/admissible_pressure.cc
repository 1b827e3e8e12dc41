// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/admissible_pressure.h>
#include <hpvi/bound/pressed_face.h>
#include <hpvi/bound/pressure_neighbourhoods.h>
#include <hpvi/plane/matching.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hpvi
{
using namespace dealii;

template <int dim>
AdmissiblePressure<dim>::AdmissiblePressure(const Solution<dim> &solution)
    : parts(solution.contact_space.faces().size())
{
  static_assert(dim == 2, "vertices of edges");
  const LegendreTables legendre;
  std::map<unsigned int, PressedFace> faces;
  double scale = 0;
  for (unsigned int k = 0; k < parts.size(); ++k)
    if (const ContactFace<dim> &face = solution.contact_space.faces()[k];
        face.condition->is_unilateral() && !face.pressures.empty()) // others may pull
    {
      faces[k] = pressed_face(face, solution, legendre);
      for (const unsigned int pressure : face.pressures)
        scale = std::max(scale, std::abs(solution.z[pressure]));
    }
  const bool is_admissible = press(faces, scale);
  for (const auto &[k, face] : faces)
  {
    for (unsigned int end = 0; end < 2; ++end)
      parts[k][end] = EdgePolynomial({face.t[end].begin(), face.t[end].end()});
    if (!face.is_balanced)
      redistributed.push_back(k);
    if (!is_admissible)
      largest_tension = std::max(largest_tension, -face.least() / scale);
  }
}

template <int dim>
const EdgePolynomial &AdmissiblePressure<dim>::part(const unsigned int face,
                                                    const unsigned int end) const
{
  return parts[face][end];
}

template <int dim>
EdgePolynomial AdmissiblePressure<dim>::value(const unsigned int face) const
{
  return parts[face][0] + parts[face][1];
}

template <int dim>
double AdmissiblePressure<dim>::tension() const
{
  return largest_tension;
}

template <int dim>
bool AdmissiblePressure<dim>::is_balanced() const
{
  return redistributed.empty();
}

template <int dim>
Vector<double> AdmissiblePressure<dim>::missing_forces(const Solution<dim> &solution) const
{
  Vector<double> result(solution.u.size());
  for (const unsigned int k : redistributed)
  {
    const ContactFace<dim> &face = solution.contact_space.faces()[k];
    const unsigned int n = face.degree + 1;
    const Tensor<1, dim> normal = face.frame(0.5).normal;
    const FaceDofs<dim> dofs(face, solution.displacement_space, solution.tables);
    const auto add = [&](const unsigned int node, const double force)
    {
      for (unsigned int c = 0; c < dim; ++c)
        dofs.add_force(c * n + node, force * normal[c], result);
    };
    // z_n at the nodes has their weights, as a multiplier it is integrated.
    const EdgePolynomial pi = value(k), z = discrete_traction(face, solution, /*is_pressure=*/true);
    const QGaussLobatto<1> &nodes = solution.tables.gauss_lobatto(n);
    for (unsigned int j = 0, i = 0; face.at_nodes && j < n && i < face.pressures.size(); ++j)
      if (face.normal_points[i] == nodes.point(j)[0])
        add(j, face.length * nodes.weight(j) * solution.z[face.pressures[i++]]);
    const unsigned int n_gauss = pi.coefficients().size() + 1;
    const QGauss<1> &gauss = solution.tables.gauss(n_gauss);
    const FullMatrix<double> &shapes =
        solution.tables.edge(face.degree, face.n_points, n_gauss).shapes;
    for (unsigned int q = 0; q < n_gauss; ++q)
    {
      const double s = gauss.point(q)[0], rest = (face.at_nodes ? 0. : z(s)) - pi(s);
      for (unsigned int j = 0; j < n; ++j)
        add(j, face.length * gauss.weight(q) * rest * shapes(q, j));
    }
  }
  return result;
}

template <int dim>
double gap_on_face(const ContactFace<dim> &face, const double s)
{
  const auto gap = [&](const double t) { return face.condition->gap_at(face.point(t)); };
  const double value = gap(s);
  if (s > 0. && s < 1.)
    return value;
  const double inside = gap(std::abs(s - 1e-9));
  const bool jumps = std::abs(inside - value) > 1e-6 * std::abs(inside - gap(0.5)) &&
                     std::abs(inside - value) > 1e-6 * std::abs(value);
  return jumps ? inside : value;
}

template <int dim>
EdgePolynomial gap_at_nodes(const ContactFace<dim> &face, const ShapeTables<dim> &tables,
                            const LegendreTables &legendre)
{
  const unsigned int n = face.degree + 1;
  Vector<double> values(n), coefficients(n);
  for (unsigned int k = 0; k < n; ++k)
    values[k] = gap_on_face(face, tables.gauss_lobatto(n).point(k)[0]);
  legendre.from_nodes(face.degree).vmult(coefficients, values);
  return EdgePolynomial({coefficients.begin(), coefficients.end()});
}

template class AdmissiblePressure<2>;
template double gap_on_face(const ContactFace<2> &, double);
template EdgePolynomial gap_at_nodes(const ContactFace<2> &, const ShapeTables<2> &,
                                     const LegendreTables &);
} // namespace hpvi
