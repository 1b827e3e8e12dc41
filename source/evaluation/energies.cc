// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/evaluation/energies.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The points in (0,1) where a function of one variable vanishes, as far as its samples show. */
template <class F>
std::vector<double> zeros(const F &function, const unsigned int n_samples)
{
  std::vector<double> result;
  double left = 0., f_left = function(left);
  for (unsigned int k = 1; k <= n_samples; ++k)
  {
    const double right = static_cast<double>(k) / n_samples, f_right = function(right);
    if ((f_left < 0. && f_right > 0.) || (f_left > 0. && f_right < 0.))
    {
      const auto bracket = boost::math::tools::bisect(
          function, left, right, boost::math::tools::eps_tolerance<double>(48));
      result.push_back(0.5 * (bracket.first + bracket.second));
    }
    else if (f_right == 0. && k < n_samples)
      result.push_back(right);
    left = right;
    f_left = f_right;
  }
  return result;
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

/** int g |u_t| over one face: the pieces of its rule are cut further where u_t changes sign. */
template <int dim>
double friction_work(const ContactFace<dim> &face, const TangentialDisplacement<dim> &u_t,
                     const QGauss<1> &gauss)
{
  std::vector<double> cuts = zeros(u_t, 8 * face.degree);
  cuts.insert(cuts.end(), face.friction.cuts.begin(), face.friction.cuts.end());
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double width = cuts[k + 1] - cuts[k], s = cuts[k] + width * gauss.point(q)[0];
      sum += width * gauss.weight(q) * face.friction_bound(face.point(s)) * std::abs(u_t(s));
    }
  return face.length() * sum;
}

/** The friction force along t has one direction where there is one contact boundary alone. */
template <int dim>
bool has_one_contact_boundary(const Scene<dim> &scene)
{
  return std::count_if(scene.boundaries.begin(), scene.boundaries.end(),
                       [](const auto &boundary) { return boundary.has_contact(); }) == 1;
}
} // namespace

template <int dim>
Energies energies(const Solution<dim> &solution, const ElasticSystem<dim> &system,
                  const ShapeTables<dim> &tables, const double a)
{
  double friction = 0, coupling = 0, resultant = 0;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
    if (face.n_multipliers > 0)
    {
      const TangentialDisplacement<dim> u_t(face, solution, tables);
      friction += friction_work(face, u_t, tables.gauss(face.degree + 2));
      const FrictionRule &rule = face.friction;
      double face_coupling = 0, face_resultant = 0;
      for (unsigned int q = 0; q < rule.points.size(); ++q)
      {
        const double s = rule.points[q], g = rule.values[q];
        const double lambda = solution.contact_space.value(face, solution.lambda, s);
        face_coupling += rule.weights[q] * (g * u_t(s) * lambda);
        face_resultant += rule.weights[q] * (g * lambda);
      }
      coupling += face.length() * face_coupling;
      resultant -= face.length() * face_resultant;
    }
  if (!has_one_contact_boundary(solution.scene))
    resultant = std::numeric_limits<double>::quiet_NaN();
  const double potential = 0.5 * a - system.work(solution.u);
  const double norm =
      std::sqrt(std::max(a, 0.)); // round-off has any sign where nothing is strained
  return {potential + coupling, potential + friction, norm, resultant, friction - coupling};
}

template Energies energies(const Solution<2> &, const ElasticSystem<2> &, const ShapeTables<2> &,
                           double);
} // namespace hpvi
