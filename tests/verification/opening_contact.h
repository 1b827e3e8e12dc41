// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_verification_opening_contact_h
#define hpvi_verification_opening_contact_h

#include "discretisation.h"

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <ostream>

namespace verification
{
inline std::string name_of(const NormalContact normal)
{
  return normal == NormalContact::nodes ? "nodes" : "multiplier";
}

inline const std::vector<NormalContact> both_discretisations = {NormalContact::nodes,
                                                                NormalContact::multiplier};

/** A body described in its own axes, and how they are turned against those of the scene. */
struct Turned
{
  std::string name;
  std::array<Point<2>, 4> corners; ///< counterclockwise from the bottom left
  double angle = 0;                ///< about the origin

  Tensor<1, 2> turned(const Tensor<1, 2> &v) const
  {
    return Point<2>(std::cos(angle) * v[0] - std::sin(angle) * v[1],
                    std::sin(angle) * v[0] + std::cos(angle) * v[1]);
  }

  /** The point of the own axes that @p x is. */
  Point<2> own(const Point<2> &x) const
  {
    return {std::cos(angle) * x[0] + std::sin(angle) * x[1],
            -std::sin(angle) * x[0] + std::cos(angle) * x[1]};
  }

  Geometry<2> geometry(const unsigned int nx, const unsigned int ny) const
  {
    std::array<Point<2>, 4> around;
    for (unsigned int k = 0; k < 4; ++k)
      around[k] = Point<2>(turned(corners[k]));
    Geometry<2> result;
    result.shape = Shape::quadrilateral;
    result.corners = quadrilateral_corners(around);
    result.subdivisions = {{nx, ny}};
    return result;
  }

  /** The components of a field of the own axes. */
  std::array<Expression<2>, 2>
  field(const std::function<Tensor<1, 2>(const Point<2> &)> &values) const
  {
    std::array<Expression<2>, 2> result;
    for (unsigned int c = 0; c < 2; ++c)
      result[c] = expression<2>([values, c, body = *this](const Point<2> &x)
                                { return body.turned(values(body.own(x)))[c]; });
    return result;
  }

  /** Likewise of a number. */
  Expression<2> scalar(const std::function<double(const Point<2> &)> &value) const
  {
    return expression<2>([value, body = *this](const Point<2> &x) { return value(body.own(x)); });
  }

  /** The traction `sigma n` of a stress in the own axes, on the edge from corner @p k to the next. */
  std::array<Expression<2>, 2>
  traction(const unsigned int k,
           const std::function<SymmetricTensor<2, 2>(const Point<2> &)> &stress) const
  {
    const Tensor<1, 2> edge = corners[(k + 1) % 4] - corners[k];
    const Tensor<1, 2> normal = Point<2>(edge[1], -edge[0]) / edge.norm();
    return field([=](const Point<2> &x) { return stress(x) * normal; });
  }
};

inline std::ostream &operator<<(std::ostream &out, const Turned &body)
{
  return out << body.name;
}

/** Boundaries counterclockwise: the edge from corner k to the next. */
inline const std::array<std::string, 4> sides = {{"bottom", "right", "top", "left"}};

/**
 * The conditions of contact by deal.II's shape functions on whole cells: no tables, no moments as
 * unknowns. Row i is `int psi_i v_t` or `int psi_i v_n`, of nodes by the Gauss-Lobatto rule.
 */
struct ContactOracle
{
  FullMatrix<double> B;                       ///< multipliers x displacements
  Vector<double> gap;                         ///< int psi_i u_0
  Vector<double> weight;                      ///< int psi_i
  std::vector<ContactMultiplier<2>> unknowns; ///< as the space has them

  explicit ContactOracle(const Spaces<2> &spaces, const NormalContact normal)
      : unknowns(spaces.contact_space.multipliers())
  {
    const unsigned int n = unknowns.size();
    B.reinit(n, spaces.displacement_space.n_dofs());
    gap.reinit(n);
    weight.reinit(n);
    for (const ContactFace<2> &face : spaces.contact_space.faces())
    {
      if (face.n_multipliers > 0)
        add_contact_dofs(face, face.first_multiplier, face.n_multipliers, false);
      if (face.condition->is_unilateral() && normal == NormalContact::multiplier)
        add_contact_dofs(face, face.pressures.front(), face.pressures.size(), true);
      else if (face.condition->is_unilateral())
        add_nodes(face);
    }
  }

  /** B u, less the moments of the gap, over weights: mean sliding and mean penetration [length]. */
  Vector<double> means(const Vector<double> &u) const
  {
    Vector<double> result(weight.size());
    if (weight.size() == 0)
      return result;
    B.vmult(result, u);
    result -= gap;
    for (unsigned int i = 0; i < weight.size(); ++i)
      result[i] /= weight[i];
    return result;
  }

private:
  static double place(const ContactFace<2> &face, const Point<2> &x)
  {
    const auto edge = face.cell->face(face.face_no);
    const Tensor<1, 2> along = edge->vertex(1) - edge->vertex(0);
    return (x - edge->vertex(0)) * along / along.norm_square();
  }

  void add_contact_dofs(const ContactFace<2> &face, const unsigned int first, const unsigned int n,
                        const bool is_normal)
  {
    const auto basis = Polynomials::generate_complete_Lagrange_basis(QGauss<1>(n).get_points());
    // More points than the degree needs: gaps are polynomials, too.
    FEFaceValues<2> values(face.cell->get_fe(), QGauss<1>(face.degree + 8),
                           update_values | update_JxW_values | update_quadrature_points |
                               update_normal_vectors);
    values.reinit(face.cell, face.face_no);
    std::vector<types::global_dof_index> dofs(values.dofs_per_cell);
    face.cell->get_dof_indices(dofs);
    for (const unsigned int q : values.quadrature_point_indices())
    {
      const Point<2> x = values.quadrature_point(q);
      const Tensor<1, 2> normal = values.normal_vector(q);
      const Tensor<1, 2> d = is_normal ? normal : Tensor<1, 2>({-normal[1], normal[0]});
      for (unsigned int i = 0; i < n; ++i)
      {
        const double psi = values.JxW(q) * basis[i].value(place(face, x));
        weight[first + i] += psi;
        gap[first + i] += is_normal ? psi * face.condition->gap_at(x) : 0.;
        for (unsigned int k = 0; k < dofs.size(); ++k)
          for (unsigned int c = 0; c < 2; ++c)
            B(first + i, dofs[k]) += psi * d[c] * values.shape_value_component(k, q, c);
      }
    }
  }

  void add_nodes(const ContactFace<2> &face)
  {
    FEFaceValues<2> values(face.cell->get_fe(), QGaussLobatto<1>(face.degree + 1),
                           update_values | update_JxW_values | update_quadrature_points |
                               update_normal_vectors);
    values.reinit(face.cell, face.face_no);
    std::vector<types::global_dof_index> dofs(values.dofs_per_cell);
    face.cell->get_dof_indices(dofs);
    for (const unsigned int q : values.quadrature_point_indices())
      for (const unsigned int i : face.pressures)
        if (unknowns[i].x.distance(values.quadrature_point(q)) < 1e-10 * face.length)
        {
          weight[i] += values.JxW(q);
          gap[i] += values.JxW(q) * face.condition->gap_at(unknowns[i].x);
          for (unsigned int k = 0; k < dofs.size(); ++k)
            for (unsigned int c = 0; c < 2; ++c)
              B(i, dofs[k]) += values.JxW(q) * values.normal_vector(q)[c] *
                               values.shape_value_component(k, q, c);
        }
  }
};

/** `a(u, v) + b(v, z) = L(v)` for all v of the space, by the oracle's B. */
inline void expect_equilibrium(const Solution<2> &solution, const Vector<double> &loads)
{
  const DisplacementSpace<2> &space = solution.displacement_space;
  Vector<double> forces =
      internal_forces(solution.scene, space, solution.tables, solution.u).forces;
  const double size = forces.l2_norm() + loads.l2_norm();
  forces -= loads;
  if (const unsigned int n = solution.z.size())
  {
    const ContactOracle oracle(*solution.spaces, solution.scene.normal_contact());
    Vector<double> contact(forces.size());
    ASSERT_EQ(oracle.B.m(), n);
    oracle.B.Tvmult(contact, solution.z);
    forces += contact;
  }
  for (types::global_dof_index dof = 0; dof < forces.size(); ++dof)
    if (const auto *entries = space.constraints().get_constraint_entries(dof))
    {
      for (const auto &[master, weight] : *entries)
        forces[master] += weight * forces[dof];
      forces[dof] = 0.;
    }
  EXPECT_LE(forces.l2_norm(), 1e-10 * size);
}

/**
 * At every point of the multiplier `z >= 0`, `u_n <= u_0` in the mean and one of both equal, `|z| <= g` and
 * slip with friction, to 1e-10 of the largest displacement and traction.
 */
inline void expect_complementary(const Solution<2> &solution)
{
  const ContactOracle oracle(*solution.spaces, solution.scene.normal_contact());
  const Vector<double> means = oracle.means(solution.u), &z = solution.z;
  double length = solution.u.linfty_norm();
  for (unsigned int i = 0; i < z.size(); ++i)
    length = std::max(length, std::abs(oracle.gap[i] / oracle.weight[i]));
  const double stress = z.linfty_norm();
  for (unsigned int i = 0; i < z.size(); ++i)
  {
    const ContactMultiplier<2> &unknown = oracle.unknowns[i];
    if (unknown.kind == ContactMultiplier<2>::Kind::pressure)
    {
      EXPECT_GE(z[i], 0.) << unknown.x;
      EXPECT_LE(means[i], 1e-10 * length) << unknown.x;
      EXPECT_LE(z[i] * std::abs(means[i]), 1e-10 * length * stress) << unknown.x;
    }
    else
    {
      const double g = unknown.friction.limit(0.);
      EXPECT_LE(std::abs(z[i]), g) << unknown.x;
      const double wrong = z[i] < g && z[i] > -g ? std::abs(means[i]) // sticks
                           : g == 0.             ? 0.
                                                 : -means[i] * z[i] / g; // slips
      EXPECT_LE(wrong, 1e-10 * length) << unknown.x;
    }
  }
}

/** The largest difference of nodal values to a displacement field, over the field's largest value. */
inline double nodal_error(const Solution<2> &solution,
                          const std::function<Tensor<1, 2>(const Point<2> &)> &field)
{
  double error = 0, largest = 0;
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
  {
    const FiniteElement<2> &fe = cell->get_fe();
    const CellMap<2> map = map_of<2>(cell);
    const auto dofs = solution.displacement_space.cell_dofs(cell->active_cell_index());
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
    {
      const double expected =
          field(map.point(fe.unit_support_point(i)))[fe.system_to_component_index(i).first];
      error = std::max(error, std::abs(solution.u[dofs[i]] - expected));
      largest = std::max(largest, std::abs(expected));
    }
  }
  return error / largest;
}

} // namespace verification

#endif
