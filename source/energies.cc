// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/energies.h>
#include <hpvi/internal_forces.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The points in (0,1) where a function of one variable changes sign, with 0 and 1 around them. */
template <class F>
std::vector<double> sign_changes(const F &function, const unsigned int n_samples)
{
  std::vector<double> cuts{0.};
  double left = 0., f_left = function(left);
  for (unsigned int k = 1; k <= n_samples; ++k)
  {
    const double right = static_cast<double>(k) / n_samples, f_right = function(right);
    if (f_left * f_right < 0.)
    {
      const auto bracket = boost::math::tools::bisect(
          function, left, right, boost::math::tools::eps_tolerance<double>(48));
      cuts.push_back(0.5 * (bracket.first + bracket.second));
    }
    left = right;
    f_left = f_right;
  }
  cuts.push_back(1.);
  return cuts;
}

/** u_Nt along one contact face: the polynomial through its values at p+1 Gauss points. */
template <int dim>
class TangentialDisplacement
{
public:
  TangentialDisplacement(const ContactFace<dim> &face, const Solution<dim> &solution,
                         const ShapeTables<dim> &tables)
      : basis(tables.gauss_lagrange(face.degree + 1)), nodal(face.degree + 1)
  {
    const std::vector<double> values = evaluate(
        tables.face(face.degree, face.face_no, face.degree + 1).values,
        solution.coefficients(face.cell->active_cell_index(), tables.numbering(face.degree)));
    for (unsigned int k = 0; k < nodal.size(); ++k)
      for (unsigned int c = 0; c < dim; ++c)
        nodal[k] += face.tangent[c] * values[c * nodal.size() + k];
  }

  double operator()(const double s) const
  {
    double sum = 0;
    for (unsigned int k = 0; k < nodal.size(); ++k)
      sum += nodal[k] * basis[k].value(s);
    return sum;
  }

private:
  const std::vector<Polynomials::Polynomial<double>> &basis;
  std::vector<double> nodal;
};

/** int weight(s, u_t) over one face by Gauss quadrature between consecutive cuts. */
template <class F, class Weight>
double integrate(const F &u_t, const std::vector<double> &cuts, const QGauss<1> &gauss,
                 const Weight &weight)
{
  double sum = 0;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double width = cuts[k + 1] - cuts[k], s = cuts[k] + width * gauss.point(q)[0];
      sum += width * gauss.weight(q) * weight(s, u_t(s));
    }
  return sum;
}
} // namespace

template <int dim>
Energies energies(const Solution<dim> &solution, const ElasticSystem<dim> &system,
                  const ShapeTables<dim> &tables)
{
  double friction = 0, coupling = 0, resultant = 0;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
    if (face.n_multipliers > 0)
    {
      const TangentialDisplacement<dim> u_t(face, solution, tables);
      const auto g = [&](const double s) { return face.friction_bound(face.point(s)); };
      friction += face.length() *
                  integrate(u_t, sign_changes(u_t, 8 * face.degree), tables.gauss(face.degree + 2),
                            [&](const double s, const double u) { return g(s) * std::abs(u); });
      coupling +=
          face.length() *
          integrate(u_t, {0., 1.}, tables.gauss(face.degree + 1),
                    [&](const double s, const double u)
                    { return g(s) * u * solution.contact_space.value(face, solution.lambda, s); });
      resultant -= face.length() *
                   integrate(u_t, {0., 1.}, tables.gauss(face.degree + 1),
                             [&](const double s, double) {
                               return g(s) * solution.contact_space.value(face, solution.lambda, s);
                             });
    }
  const double a =
      internal_forces(solution.scene.material, solution.displacement_space, tables, solution.u)
          .energy_product;
  const double potential = 0.5 * a - system.work(solution.u);
  const double norm =
      std::sqrt(std::max(a, 0.)); // round-off has any sign where nothing is strained
  return {potential + coupling, potential + friction, norm, resultant, friction - coupling};
}

template Energies energies(const Solution<2> &, const ElasticSystem<2> &, const ShapeTables<2> &);
} // namespace hpvi
