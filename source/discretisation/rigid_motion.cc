// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/discretisation/rigid_motion.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Why a body that friction alone could hold has no friction on this mesh. */
template <int dim>
std::string nothing_resists(const Tensor<1, dim> &direction, const double load)
{
  std::ostringstream line;
  line
      << "nothing holds the body along (" << direction << "): the loads push it with "
      << std::abs(load)
      << ", friction can resist with 0, for Friction bound vanishes wherever this mesh samples it; "
         "raise Geometry/Subdivisions, set Geometry/Graded towards where it acts, or add a support";
  return line.str();
}

/** The entry of A on the diagonal. */
double diagonal(const SymmetricMatrix &A, const unsigned int unknown)
{
  for (int k = A.column_start[unknown]; k < A.column_start[unknown + 1]; ++k)
    if (A.row[k] == static_cast<int>(unknown))
      return A.value[k];
  return 0.;
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

/** B'(G/w), the mean of the displacement along R over the contact, as it is on every mesh. */
Vector<double> mean_along(const ConditionRows &rows, const Vector<double> &G,
                          const std::vector<double> &weights)
{
  Vector<double> P(rows.kept.size());
  for (unsigned int i = 0; i < rows.n_rows(); ++i)
    for (const auto &[place, weight] : rows.B[i])
      P[place] += weight * G[i] / weights[i];
  return P;
}
} // namespace

template <int dim>
bool RigidMotion<dim>::is_seen() const
{
  return std::any_of(G.begin(), G.end(), [](const double value) { return value != 0.; });
}

template <int dim>
double RigidMotion<dim>::penalty() const
{
  double product = 0;
  for (const auto &[unknown, value] : stabilisation.P)
    product += value * R[unknown];
  return 1 / (stabilisation.stiffness * product * product);
}

template <int dim>
RigidMotion<dim>
make_translation(const Tensor<1, dim> &direction, const DisplacementSpace<dim> &space,
                 const Unknowns<dim> &unknowns, const ConditionRows &rows,
                 const std::vector<double> &weights, const ElasticSystem<dim> &system)
{
  Vector<double> u(space.n_dofs());
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const auto dofs = space.cell_dofs(cell->active_cell_index());
      for (unsigned int i = 0; i < dofs.size(); ++i)
        u[dofs[i]] = direction[cell->get_fe().system_to_component_index(i).first];
    }
  RigidMotion<dim> result{direction, unknowns.coordinates(u), Vector<double>(rows.n_rows()), {}, 0};
  for (unsigned int i = 0; i < rows.n_rows(); ++i)
    for (const auto &[place, weight] : rows.B[i])
      result.G[i] += weight * result.R[rows.kept[place]];
  // A sum whose bits do not depend on threads, unlike deal.II's product.
  const auto along = [&](const Vector<double> &f)
  { return std::inner_product(f.begin(), f.end(), result.R.begin(), 0.); };
  result.load = along(system.f);
  if (result.is_seen())
  {
    result.stabilisation =
        stabilise(system.A, result.R, rows.kept, mean_along(rows, result.G, weights));
    return result;
  }
  double absolute = 0;
  for (unsigned int k = 0; k < system.f.size(); ++k)
    absolute += std::abs(system.f[k] * result.R[k]);
  if (std::abs(result.load) > 1e-10 * absolute)
    throw NumericalFailure(nothing_resists(direction, result.load));
  const unsigned int held =
      std::max_element(result.R.begin(), result.R.end(),
                       [](const double a, const double b) { return std::abs(a) < std::abs(b); }) -
      result.R.begin();
  const std::vector<double> R_held = {result.R[held]};
  result.stabilisation =
      stabilise(system.A, result.R, {held}, Vector<double>(R_held.begin(), R_held.end()));
  return result;
}

template struct RigidMotion<2>;
template RigidMotion<2> make_translation(const Tensor<1, 2> &, const DisplacementSpace<2> &,
                                         const Unknowns<2> &, const ConditionRows &,
                                         const std::vector<double> &, const ElasticSystem<2> &);
} // namespace hpvi
