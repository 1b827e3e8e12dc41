// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_verification_friction_quadrature_h
#define hpvi_verification_friction_quadrature_h

#include "discretisation.h"

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

namespace verification
{
/** Integrals over the contact boundary. */
struct FrictionIntegrals
{
  double bound = 0;     ///< int g
  double friction = 0;  ///< int g |u_t|
  double coupling = 0;  ///< int g lambda u_t
  double resultant = 0; ///< -int g lambda
  double overshoot = 0; ///< int g (|lambda| - 1)_+ |u_t|: what lets the slack be negative
};

/** By many short panels: no pieces, no sign changes. A jump of g has to lie between two panels. */
inline FrictionIntegrals integrate_friction(const Solution<2> &solution,
                                            const unsigned int n_panels)
{
  FrictionIntegrals sums;
  const QGauss<1> gauss(3);
  for (const ContactFace<2> &face : solution.contact_space.faces())
  {
    const FiniteElement<2> &fe = face.cell->get_fe();
    const auto dofs = solution.displacement_space.cell_dofs(face.cell->active_cell_index());
    const CellMap<2> map = map_of<2>(face.cell);
    const unsigned int from = GeometryInfo<2>::face_to_cell_vertices(face.face_no, 0),
                       to = GeometryInfo<2>::face_to_cell_vertices(face.face_no, 1);
    const Point<2> start = GeometryInfo<2>::unit_cell_vertex(from),
                   end = GeometryInfo<2>::unit_cell_vertex(to);
    // The values of u_t at as many points as the degree needs; Lagrange between them.
    const std::vector<Point<1>> nodes = QGaussLobatto<1>(fe.degree + 1).get_points();
    const auto basis = Polynomials::generate_complete_Lagrange_basis(nodes);
    std::vector<double> u_t(nodes.size());
    for (unsigned int k = 0; k < nodes.size(); ++k)
      for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
        u_t[k] += solution.u[dofs[i]] * fe.shape_value(i, start + nodes[k][0] * (end - start)) *
                  face.frame(0.5).tangent[fe.system_to_component_index(i).first];
    for (unsigned int panel = 0; panel < n_panels; ++panel)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double s = (panel + gauss.point(q)[0]) / n_panels;
        const double g = gauss.weight(q) / n_panels * face.length *
                         face.friction_bound(map.point(start + s * (end - start)));
        const double z = gauss.weight(q) / n_panels * face.length *
                         solution.contact_space.value(face, solution.z, s);
        double u = 0;
        for (unsigned int k = 0; k < u_t.size(); ++k)
          u += u_t[k] * basis[k].value(s);
        sums.bound += g;
        sums.friction += g * std::abs(u);
        sums.coupling += z * u;
        sums.resultant -= z;
        sums.overshoot += std::max(std::abs(z) - g, 0.) * std::abs(u);
      }
  }
  return sums;
}

/** `g |u_t| - z u_t >= -(|z| - g)_+ |u_t|` at every point, so for the integrals too. */
inline void expect_slack_of_overshoot_alone(const Solution<2> &solution, const double slack)
{
  const FrictionIntegrals sums = integrate_friction(solution, 256);
  EXPECT_GE(slack, -1.01 * sums.overshoot - 1e-11 * sums.friction);
}
} // namespace verification

#endif
