// SPDX-License-Identifier: LGPL-2.1-or-later

// $|Tv|^2 = (Dv_t)\cdot\Sigma(Dv_t)$ with $\Sigma = (S^{-1})_{PP}$, and of all v with these v_t that of least energy has forces f along contact
// alone: $|v|^2 = f\cdot S_{FF}f$. So $\theta^2$ is the largest eigenvalue of $B = D'\Sigma DS_{FF}$, which is symmetric in the product of $S_{FF}$.
#include <hpvi/bound/coupling_spaces.h>
#include <hpvi/space/friction_coupling.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double exact = 1e-3;           ///< of theta^2
constexpr double linear_residual = 1e-6; ///< relative
constexpr unsigned int most_steps = 40;

class Coupling
{
public:
  Coupling(const PrimalSpace<3> &space, NewtonMatrix<3> &matrix,
           const std::vector<ContactVector<3>> &mu_chi, const std::vector<bool> &sticks)
      : space(space), matrix(matrix), mu_chi(mu_chi), free(space.contact.size()), held(free)
  {
    for (unsigned int k = 0; k < held.size(); ++k)
    {
      held[k].is_held = true;
      free[k].is_held = !sticks.empty() && sticks[k];
    }
  }

  double largest_eigenvalue() const;

private:
  using Forces = std::vector<ContactVector<3>>; ///< by contact dof; traces likewise

  Forces start() const;
  Forces trace(const Forces &f) const;
  Forces back(const Forces &v) const;
  double product(const Forces &a, const Forces &b) const;

  const PrimalSpace<3> &space;
  NewtonMatrix<3> &matrix;
  const std::vector<ContactVector<3>> &mu_chi;
  std::vector<ContactDofState<3>> free, held;
};

double Coupling::product(const Forces &a, const Forces &b) const
{
  double result = 0;
  for (unsigned int k = 0; k < a.size(); ++k)
    result += a[k] * b[k];
  return result;
}

/** S_FF f */
Coupling::Forces Coupling::trace(const Forces &f) const
{
  DistributedVector b = space.owned_vector(), v = b;
  for (unsigned int k = 0; k < f.size(); ++k)
    if (!free[k].is_held)
      space.set_contact_value(b, k, f[k]);
  matrix.linearise(free, /*anew=*/true);
  matrix.solve(v, b, linear_residual * b.l2_norm());
  Forces result(f.size());
  for (unsigned int k = 0; k < f.size(); ++k)
    if (space.contact[k].is_friction())
      result[k] = space.contact_value(v, k);
  return result;
}

/** D' Sigma D v */
Coupling::Forces Coupling::back(const Forces &v) const
{
  DistributedVector X = space.owned_vector(), r = X;
  for (unsigned int k = 0; k < v.size(); ++k)
    if (space.contact[k].has_partner())
      space.set_contact_value(X, space.contact[k].partner,
                              ContactVector<3>({mu_chi[k] * v[k], 0.}));
  matrix.linearise(held, /*anew=*/true);
  DistributedVector of_trace = X;
  matrix.multiply(of_trace, X);
  for (unsigned int k = 0; k < v.size(); ++k)
    space.set_contact_value(of_trace, k, {});
  matrix.solve(X, r, linear_residual * of_trace.l2_norm());
  matrix.multiply(r, X);
  Forces result(v.size());
  for (unsigned int k = 0; k < v.size(); ++k)
    if (space.contact[k].has_partner())
      result[k] = space.contact_value(r, space.contact[k].partner)[0] * mu_chi[k];
  return result;
}

/** Forces in no order, along friction that couples. */
Coupling::Forces Coupling::start() const
{
  Forces result(space.contact.size());
  for (unsigned int k = 0; k < result.size(); ++k)
    result[k] = mu_chi[k] * space.contact[k].area * (1 + 0.3 * std::sin(7. * k + 1));
  return result;
}

// The whole sequence is kept orthogonal.
double Coupling::largest_eigenvalue() const
{
  std::vector<Forces> forces, traces;
  std::vector<double> diagonal, beside;
  double value = 0;
  Forces f = start();
  for (unsigned int step = 0; step < most_steps; ++step)
  {
    Forces v = trace(f);
    const double square = product(f, v), before = value;
    if (!(square > 0))
      break;
    const double norm = std::sqrt(square);
    if (step > 0)
    {
      if (norm <= 1e-4 * value) // no direction is left
        break;
      beside.push_back(norm);
    }
    for (unsigned int k = 0; k < f.size(); ++k)
    {
      f[k] /= norm;
      v[k] /= norm;
    }
    forces.push_back(f);
    traces.push_back(v);
    f = back(v);
    diagonal.push_back(product(f, v));
    value = largest_of_tridiagonal(diagonal, beside);
    if (step > 2 && value - before <= exact * value)
      break;
    for (unsigned int i = 0; i < forces.size(); ++i)
    {
      const double share = product(f, traces[i]);
      for (unsigned int k = 0; k < f.size(); ++k)
        f[k] -= share * forces[i][k];
    }
  }
  return value;
}
} // namespace

double friction_coupling(const PrimalSpace<3> &space, NewtonMatrix<3> &matrix,
                         const std::vector<ContactVector<3>> &mu_chi,
                         const std::vector<bool> &sticks)
{
  return std::sqrt(std::max(0., Coupling(space, matrix, mu_chi, sticks).largest_eigenvalue()));
}
} // namespace hpvi
