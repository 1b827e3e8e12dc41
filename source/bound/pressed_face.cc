// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/admissible_pressure.h>
#include <hpvi/bound/pressed_face.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A cell far from the origin has rounded vertices: what one frame knows is no rectangle, all do. */
constexpr double negligible_angle = 1e-10;

/** Adds `weight z psi_a` and `weight z psi_a s` at a point. */
void add_contact_dofs(PressedFace &face, const double s, const double weighted)
{
  for (unsigned int end = 0; end < 2; ++end)
  {
    const double hat = end == 0 ? 1. - s : s;
    face.force[end] += weighted * hat;
    face.moment[end] += weighted * hat * s;
  }
}

void set_moments(PressedFace &result, const ContactFace<2> &face, const EdgePolynomial &z,
                 const Solution<2> &solution)
{
  if (face.at_nodes)
  {
    const QGaussLobatto<1> &rule = solution.tables.gauss_lobatto(face.degree + 1);
    for (unsigned int k = 0, i = 0; k < rule.size() && i < face.normal_points.size(); ++k)
      if (face.normal_points[i] == rule.point(k)[0])
        add_contact_dofs(result, rule.point(k)[0],
                         face.length * rule.weight(k) * solution.z[face.pressures[i++]]);
    return;
  }
  const QGauss<1> &gauss = solution.tables.gauss(result.n + 1);
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const double s = gauss.point(q)[0];
    add_contact_dofs(result, s, face.length * gauss.weight(q) * z(s));
  }
}

/** One of them. */
Vector<double> own_part(const PressedFace &face, const unsigned int end)
{
  Vector<double> t(face.wanted[end]);
  t[0] = face.force[end] / (face.length * mean_factor);
  t[1] = (2. * face.moment[end] / face.length - mean_factor * t[0]) / slope_factor;
  if (!face.is_skew)
    return t;
  const Vector<double> L = legendre_basis(face.n, 1. - end);
  double square = 0;
  for (unsigned int i = 2; i < face.n; ++i)
    square += L[i] * L[i];
  const double value = t * L;
  for (unsigned int i = 2; i < face.n; ++i)
    t[i] -= value / square * L[i];
  return t;
}
} // namespace

EdgePolynomial PressedFace::pressure() const
{
  Vector<double> sum(t[0]);
  sum += t[1];
  return EdgePolynomial({sum.begin(), sum.end()});
}

double PressedFace::least() const
{
  const EdgePolynomial pi = pressure();
  double result = pi(0.);
  for (const double s : pi.extremes())
    result = std::min(result, pi(s));
  return result;
}

void PressedFace::take_own_parts()
{
  for (unsigned int end = 0; end < 2; ++end)
    t[end] = own_part(*this, end);
}

EdgePolynomial discrete_traction(const ContactFace<2> &face, const Solution<2> &solution,
                                 const bool is_pressure)
{
  const ContactSpace<2> &space = solution.contact_space;
  const QGauss<1> &gauss = solution.tables.gauss(face.degree + 1);
  std::vector<double> values;
  for (const Point<1> &point : gauss.get_points())
    values.push_back(is_pressure ? space.pressure(face, solution.z, point[0])
                                 : space.value(face, solution.z, point[0]));
  return EdgePolynomial::through(values, gauss);
}

PressedFace pressed_face(const ContactFace<2> &face, const Solution<2> &solution,
                         const LegendreTables &legendre)
{
  const ContactFrame<2> frame = face.frame(0.5);
  PressedFace result;
  result.n = traction_degree(face, solution.z, solution.contact_space) + 1;
  result.length = face.length;
  result.weight =
      face.length / (2. * solution.scene.material_of(face.cell).residual_weight() * face.degree);
  const Tensor<2, 2> J = face.map.jacobian({0.5, 0.5});
  result.is_skew =
      std::abs(J[0][0] * J[0][1] + J[1][0] * J[1][1]) > negligible_angle * J.norm_square();
  result.origin = face.point(0.) * frame.tangent;
  result.step = face.point(1.) * frame.tangent - result.origin;
  result.boundary = face.condition;
  const EdgePolynomial z = discrete_traction(face, solution, /*is_pressure=*/true),
                       u_0 = gap_at_nodes(face, solution.tables, legendre),
                       u_n = edge_trace(face, frame.normal, solution.displacement_space,
                                        solution.tables, solution.u);
  set_moments(result, face, z, solution);
  const QGauss<1> &gauss = solution.tables.gauss(result.n + 1);
  result.openness.reinit(result.n);
  for (unsigned int end = 0; end < 2; ++end)
    result.wanted[end].reinit(result.n);
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const double s = gauss.point(q)[0], weight = 2. * gauss.weight(q);
    const Vector<double> L = legendre_basis(result.n, s);
    result.openness.add(weight * (u_0(s) - u_n(s)), L);
    result.wanted[0].add(weight * (1. - s) * z(s), L);
    result.wanted[1].add(weight * s * z(s), L);
  }
  for (unsigned int end = 0; end < 2; ++end)
    result.vertices[end] = face.cell->face(face.face_no)->vertex_index(end);
  result.take_own_parts();
  return result;
}
} // namespace hpvi
