// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/plane/rigid_motion.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Of a sum of loads, in parts of the sum of their absolute values. */
constexpr double round_off = 1e-14;

/** The entry of A on the diagonal. */
double diagonal(const SymmetricMatrix &A, const unsigned int unknown)
{
  for (int k = A.column_start[unknown]; k < A.column_start[unknown + 1]; ++k)
    if (A.row[k] == static_cast<int>(unknown))
      return A.value[k];
  return 0.;
}

/** A sum whose bits do not depend on threads, unlike deal.II's product. */
/** What loads as large as @p f could do along @p R: loads across it are no less subject to round-off. */
double largest_work(const Vector<double> &f, const Vector<double> &R)
{
  return f.l1_norm() * R.linfty_norm();
}

/**
 * Soft beside the body, a hundredth of the mean stiffness of @p kept: for the quadratic program it is a
 * penalty, and a strong one converges fast. It costs as many digits of u along R alone.
 */
Stabilisation stabilise(const SymmetricMatrix &A, const Vector<double> &R,
                        const std::vector<unsigned int> &kept, const Vector<double> &P)
{
  Stabilisation result;
  double stiffness = 0, product = 0;
  for (unsigned int k = 0; k < kept.size(); ++k)
    if (P[k] != 0.)
    {
      result.P.emplace_back(kept[k], P[k]);
      stiffness += diagonal(A, kept[k]) * R[kept[k]] * R[kept[k]];
      product += P[k] * R[kept[k]];
    }
  result.stiffness = 1e-2 * stiffness / result.P.size() / (product * product);
  return result;
}

/** The motion as a displacement of the space. */
template <int dim>
Vector<double> interpolate(const RigidBodyMotion<dim> &motion, const Geometry<dim> &geometry,
                           const DisplacementSpace<dim> &space)
{
  Vector<double> u(space.n_dofs());
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const CellMap<dim> map = map_of<dim>(cell);
      const unsigned int body = body_of<dim>(geometry, cell);
      const auto dofs = space.cell_dofs(cell->active_cell_index());
      const auto &nodes = cell->get_fe().get_unit_support_points();
      for (unsigned int i = 0; i < dofs.size(); ++i)
        u[dofs[i]] =
            motion.at(map.point(nodes[i]), body)[cell->get_fe().system_to_component_index(i).first];
    }
  return u;
}

/** B x at unknowns, without what is prescribed. */
Vector<double> apply(const ConditionRows &rows, const Vector<double> &x)
{
  Vector<double> result(rows.n_rows());
  for (unsigned int i = 0; i < rows.n_rows(); ++i)
    for (const auto &[place, weight] : rows.B[i])
      result[i] += weight * x[rows.interface[place]];
  return result;
}
} // namespace

template <int dim>
RigidMotions<dim>::RigidMotions(const std::vector<RigidBodyMotion<dim>> &basis,
                                const Geometry<dim> &geometry, const DisplacementSpace<dim> &space,
                                const Unknowns<dim> &unknowns, const ConditionRows &rows,
                                const std::vector<ContactMultiplier<dim>> &multipliers,
                                const ElasticSystem<dim> &system, const double precision)
    : basis(basis)
{
  const unsigned int n = basis.size();
  std::vector<Vector<double>> columns, B_columns;
  for (const RigidBodyMotion<dim> &motion : basis)
  {
    columns.push_back(unknowns.coordinates(interpolate(motion, geometry, space)));
    B_columns.push_back(apply(rows, columns.back()));
  }
  double contact = 0;
  std::vector<Vector<double>> weighted = B_columns;
  for (unsigned int i = 0; i < multipliers.size(); ++i)
  {
    contact += multipliers[i].weight;
    for (Vector<double> &column : weighted)
      column[i] /= std::sqrt(multipliers[i].weight);
  }
  split_by_contact(std::move(weighted), std::max(1e-20, precision * precision) * contact);
  equations.G.reinit(multipliers.size(), n_seen());
  equations.e.reinit(n_seen());
  equations.round_off.reinit(n_seen());
  for (unsigned int m = 0; m < n; ++m)
  {
    R.emplace_back(unknowns.n());
    for (unsigned int j = 0; j < n; ++j)
      R[m].add(combinations[m][j], columns[j]);
    if (m >= n_seen())
      continue;
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < multipliers.size(); ++i)
        equations.G(i, m) += combinations[m][j] * B_columns[j][i];
    equations.e[m] = dot(system.f, R[m]);
    equations.round_off[m] = round_off * largest_work(system.f, R[m]);
    if (std::abs(equations.e[m]) <= equations.round_off[m])
      equations.e[m] = 0.;
  }
  stabilise_seen(rows, multipliers, system.A);
  hold_unseen(system);
}

/**
 * Combinations of @p columns that are orthogonal, the longest first, by Jacobi's rotations of pairs: one
 * that ought to vanish is left with round-off, where an eigenvalue of the Gram matrix would have its root.
 */
template <int dim>
void RigidMotions<dim>::split_by_contact(std::vector<Vector<double>> columns, const double smallest)
{
  const unsigned int n = columns.size();
  for (unsigned int j = 0; j < n; ++j)
  {
    combinations.emplace_back(n);
    combinations[j][j] = 1;
  }
  const unsigned int sweeps = 20;
  for (unsigned int sweep = 0; sweep < sweeps; ++sweep)
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = j + 1; k < n; ++k)
      {
        const double a = dot(columns[j], columns[j]), b = dot(columns[k], columns[k]),
                     c = dot(columns[j], columns[k]);
        if (std::abs(c) <= 1e-15 * std::sqrt(a * b))
          continue;
        const double zeta = (b - a) / (2 * c),
                     tangent = std::copysign(1 / (std::abs(zeta) + std::hypot(1, zeta)), zeta),
                     cosine = 1 / std::hypot(1, tangent), sine = cosine * tangent;
        for (auto *vectors : {&columns, &combinations})
        {
          const Vector<double> first = (*vectors)[j];
          (*vectors)[j].sadd(cosine, -sine, (*vectors)[k]);
          (*vectors)[k].sadd(cosine, sine, first);
        }
      }
  std::vector<unsigned int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](const unsigned int a, const unsigned int b)
                   { return columns[a].norm_sqr() > columns[b].norm_sqr(); });
  std::vector<Vector<double>> sorted;
  unsigned int n_seen = 0;
  for (const unsigned int m : order)
  {
    sorted.push_back(combinations[m]);
    if (*std::max_element(sorted.back().begin(), sorted.back().end()) < sorted.back().linfty_norm())
      sorted.back() *= -1.; // the largest coefficient is positive
    n_seen += columns[m].norm_sqr() > smallest ? 1 : 0;
  }
  combinations = sorted;
  equations.e.reinit(n_seen);
}

template <int dim>
void RigidMotions<dim>::stabilise_seen(const ConditionRows &rows,
                                       const std::vector<ContactMultiplier<dim>> &multipliers,
                                       const SymmetricMatrix &A)
{
  inverse_stiffness.reinit(n_seen(), n_seen());
  for (unsigned int m = 0; m < n_seen(); ++m)
  {
    Vector<double> P(rows.interface.size()); // B' W^-1 G, the mean along R over the contact
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
      for (const auto &[place, weight] : rows.B[i])
        P[place] += weight * equations.G(i, m) / multipliers[i].weight;
    terms.push_back(stabilise(A, R[m], rows.interface, P));
    double product = 0;
    for (const auto &[unknown, value] : terms.back().P)
      product += value * R[m][unknown];
    inverse_stiffness(m, m) = 1 / (terms.back().stiffness * product * product);
  }
}

/** A spring at one unknown for each, where those before it do not move. */
template <int dim>
void RigidMotions<dim>::hold_unseen(const ElasticSystem<dim> &system)
{
  std::vector<Vector<double>> rest(R.begin() + n_seen(), R.end());
  for (unsigned int m = 0; m < rest.size(); ++m)
  {
    const Vector<double> &free = rest[m];
    const unsigned int held =
        std::max_element(free.begin(), free.end(),
                         [](const double a, const double b) { return std::abs(a) < std::abs(b); }) -
        free.begin();
    const std::vector<double> at_held = {free[held]};
    terms.push_back(
        stabilise(system.A, free, {held}, Vector<double>(at_held.begin(), at_held.end())));
    for (unsigned int k = m + 1; k < rest.size(); ++k)
      rest[k].add(-rest[k][held] / free[held], free);
  }
}

template <int dim>
unsigned int RigidMotions<dim>::n_seen() const
{
  return equations.e.size();
}

template <int dim>
const EqualityConstraints &RigidMotions<dim>::balance() const
{
  return equations;
}

template <int dim>
const FullMatrix<double> &RigidMotions<dim>::penalty() const
{
  return inverse_stiffness;
}

template <int dim>
const std::vector<Stabilisation> &RigidMotions<dim>::stabilisation() const
{
  return terms;
}

template <int dim>
RigidBodyMotion<dim> RigidMotions<dim>::motion(const Vector<double> &amounts) const
{
  return sum(basis, in_basis(amounts));
}

template <int dim>
Vector<double> RigidMotions<dim>::at_unknowns(const Vector<double> &amounts) const
{
  Vector<double> x(R.front().size());
  for (unsigned int m = 0; m < amounts.size(); ++m)
    x.add(amounts[m], R[m]);
  return x;
}

template <int dim>
Vector<double> RigidMotions<dim>::in_basis(const Vector<double> &amounts) const
{
  Vector<double> result(basis.size());
  for (unsigned int m = 0; m < amounts.size(); ++m)
    result.add(amounts[m], combinations[m]);
  return result;
}

template <int dim>
Vector<double> RigidMotions<dim>::from_basis(const Vector<double> &coefficients) const
{
  Vector<double> result(n_seen());
  for (unsigned int m = 0; m < n_seen() && coefficients.size() > 0; ++m)
    result[m] = dot(combinations[m], coefficients);
  return result;
}

template class RigidMotions<2>;
} // namespace hpvi
