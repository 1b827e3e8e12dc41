// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/contact_trace.h>
#include <hpvi/plane/matching.h>

#include <iterator>
#include <map>

namespace hpvi
{
using namespace dealii;

EdgePolynomial Trace::rest(const Vector<double> &w) const
{
  std::vector<double> result(u);
  for (unsigned int k = 0; k < unknowns.size(); ++k)
    for (unsigned int i = 0; i < result.size(); ++i)
      result[i] -= legendre(i, k) * w[unknowns[k]];
  return EdgePolynomial(result);
}

void Trace::extend(const FullMatrix<double> &more, const unsigned int first)
{
  FullMatrix<double> all(more.m(), unknowns.size() + more.n());
  all.fill(legendre, 0, 0, 0, 0);
  all.fill(more, 0, unknowns.size(), 0, 0);
  legendre = all;
  for (unsigned int i = 0; i < more.n(); ++i)
    unknowns.push_back(first + i);
  u.resize(more.m());
}

Trace trace_of(const ContactFace<2> &face, const Tensor<1, 2> &direction,
               const Solution<2> &solution, const Unknowns<2> &unknowns,
               const FullMatrix<double> &legendre)
{
  const unsigned int n = face.degree + 1;
  const FaceDofs<2> dofs(face, solution.displacement_space, solution.tables);
  std::map<unsigned int, Vector<double>> columns; // values at nodes by unknown
  Vector<double> u(n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int c = 0; c < 2; ++c)
    {
      u[j] += direction[c] * dofs.jump(solution.u, c * n + j);
      const auto add = [&](const types::global_dof_index dof, const double sign)
      {
        for (const auto &[unknown, weight] : unknowns.terms(dof))
        {
          Vector<double> &column = columns[unknown];
          if (column.size() == 0)
            column.reinit(n);
          column[j] += sign * direction[c] * weight;
        }
      };
      add(dofs.own[c * n + j], 1.);
      if (!dofs.opposite.empty())
        add(dofs.opposite[c * n + j], -1.);
    }
  Trace result;
  Vector<double> of_u(n);
  legendre.vmult(of_u, u);
  result.u.assign(of_u.begin(), of_u.end());
  for (auto column = columns.begin(); column != columns.end();)
    // Far from the origin the rounded edges of one side differ in direction, and share unknowns of their vertices.
    column = column->second.linfty_norm() < 1e-10 ? columns.erase(column) : std::next(column);
  result.legendre.reinit(n, columns.size());
  for (const auto &[unknown, values] : columns)
  {
    Vector<double> coefficients(n);
    legendre.vmult(coefficients, values);
    for (unsigned int i = 0; i < n; ++i)
      result.legendre(i, result.unknowns.size()) = coefficients[i];
    result.unknowns.push_back(unknown);
  }
  return result;
}
} // namespace hpvi
