// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/one_thread.h>
#include <hpvi/plane/curved_edges.h>
#include <hpvi/plane/discretisation.h>
#include <hpvi/results/inf_sup.h>
#include <hpvi/solvers/quadratic_program.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
/** How much higher than V_N's the degrees of V_* are. */
constexpr unsigned int additional_degree = 4;

/** One discrete problem with all it stands on. */
template <int dim>
struct Laboratory
{
  CondensedElements<dim> elements;
  const Discretisation<dim> discretisation;

  Laboratory(const Scene<dim> &scene, std::shared_ptr<const Triangulation<dim>> mesh,
             const Degrees &degrees, const std::shared_ptr<const ShapeTables<dim>> &tables)
      : elements(scene, *tables),
        discretisation(scene,
                       std::make_shared<const Spaces<dim>>(scene, std::move(mesh), degrees, tables),
                       elements)
  {
  }

  LAPACKFullMatrix<double> schur_complement(const ConditionRows &rows) const
  {
    return SchurComplement(discretisation.factor(), discretisation.system.f, rows).S();
  }
};

/** Bisect every cell of a copy of @p coarse; returns the degrees of V_* there. */
template <int dim>
Degrees make_reference_mesh(const Triangulation<dim> &coarse, const Degrees &degrees,
                            Triangulation<dim> &fine)
{
  fine.copy_triangulation(coarse);
  Degrees fine_degrees =
      refine_mesh(fine, degrees, {std::vector<bool>(degrees.size(), true), degrees});
  for (unsigned int &degree : fine_degrees)
    degree += additional_degree;
  set_edge_degrees(fine, fine_degrees);
  return fine_degrees;
}

/**
 * T, n_multipliers x n_multipliers of the fine space, with `psi_m = sum_k T_mk phi_k` for the coarse
 * basis psi and the fine phi: the values of psi_m at the points of the fine unknowns. On one half of an
 * edge psi_m has the degree of the coarse multiplier and phi_k four more, so it is exact.
 */
template <int dim>
FullMatrix<double> embedding(const ContactSpace<dim> &coarse, const ContactSpace<dim> &fine)
{
  FullMatrix<double> T(coarse.n_multipliers(), fine.n_multipliers());
  AssertDimension(fine.faces().size(), 2 * coarse.faces().size());
  for (unsigned int k = 0; k < fine.faces().size(); ++k)
  {
    // Both spaces sort their faces along the boundary, so the two halves of a face come together.
    const ContactFace<dim> &half = fine.faces()[k], &face = coarse.faces()[k / 2];
    const Tensor<1, dim> along = face.point(1.) - face.point(0.);
    const auto place = [&](const unsigned int unknown)
    { return (fine.multipliers()[unknown].x - face.point(0.)) * along / along.norm_square(); };
    for (unsigned int i = 0; i < half.n_multipliers; ++i)
    {
      const double s = place(half.first_multiplier + i);
      Assert(s > 0. && s < 1., ExcMessage("This is no half of the face."));
      const std::vector<double> psi = coarse.basis_values(face, s);
      for (unsigned int m = 0; m < psi.size(); ++m)
        T(face.first_multiplier + m, half.first_multiplier + i) = psi[m];
    }
    for (const unsigned int i : half.pressures)
    {
      const std::vector<double> psi = lagrange_basis(face.normal_points, place(i));
      for (unsigned int m = 0; m < psi.size(); ++m)
        T(face.pressures[m], i) = psi[m]; // a vertex between two edges has one value from both
    }
  }
  return T;
}

/** S_* over the multipliers of @p coarse, from B_* = T B with B of the reference mesh. */
template <int dim>
LAPACKFullMatrix<double>
reference_schur_complement(const Scene<dim> &scene, const Triangulation<dim> &triangulation,
                           const Degrees &degrees, const ContactSpace<dim> &coarse,
                           const std::shared_ptr<const ShapeTables<dim>> &tables)
{
  const auto mesh = std::make_shared<Triangulation<dim>>();
  const Degrees fine_degrees = make_reference_mesh(triangulation, degrees, *mesh);
  // Rows hold no g, but faces without friction have none: here both halves of a face want theirs.
  Scene<dim> rough(scene);
  for (BoundaryCondition<dim> &boundary : rough.boundaries)
    boundary.friction = boundary.friction.everywhere();
  // On the finer mesh the other side of a pair may have more multipliers.
  for (ContactPair &pair : rough.pairs)
    pair.slave = std::any_of(coarse.faces().begin(), coarse.faces().end(),
                             [&](const ContactFace<dim> &face)
                             { return face.condition->id == pair.parts[1]; });
  const Laboratory<dim> fine(rough, mesh, fine_degrees, tables);
  const ConditionRows &rows = fine.discretisation.contact_rows;
  const FullMatrix<double> T = embedding(coarse, fine.discretisation.spaces->contact_space);
  ConditionRows combined{rows.interface, std::vector<ConditionRows::Row>(T.m()),
                         Vector<double>(T.m())};
  for (unsigned int m = 0; m < T.m(); ++m)
  {
    std::map<unsigned int, double> row;
    for (unsigned int k = 0; k < T.n(); ++k)
      if (T(m, k) != 0.)
        for (const auto &[place, weight] : rows.B[k])
          row[place] += T(m, k) * weight;
    combined.B[m].assign(row.begin(), row.end());
  }
  return fine.schur_complement(combined);
}

/**
 * The smallest eigenvalue of `S_N z = x S_* z` by dsygv: Cholesky of S_*, then dsyev, eigenvalues
 * alone. Both matrices are scaled by the diagonal of S_* first, which keeps the eigenvalues and
 * takes away the squares of weights that could spoil the Cholesky factorisation.
 */
double smallest_eigenvalue(const LAPACKFullMatrix<double> &S_N,
                           const LAPACKFullMatrix<double> &S_star)
{
  const Vector<double> factors = diagonal_scale(S_star);
  LAPACKFullMatrix<double> S = scaled(S_N, factors), S_ref = scaled(S_star, factors);
  const types::blas_int n = S.n(), type = 1, work_size = 34 * n; // block size 32 + 2
  std::vector<double> eigenvalues(n), work(work_size);
  types::blas_int info = 0;
  sygv(&type, "N", "L", &n, &S(0, 0), &n, &S_ref(0, 0), &n, eigenvalues.data(), work.data(),
       &work_size, &info);
  if (info != 0 || std::isnan(eigenvalues.front()))
    throw NumericalFailure("the inf-sup constant cannot be measured: the Schur complement of the "
                           "reference space is not positive definite to round-off, or has NaN");
  return eigenvalues.front();
}
} // namespace

double InfSup::bound() const
{
  const double p = highest_degree;
  return p < 2 ? std::numeric_limits<double>::quiet_NaN()
               : 1. / (std::sqrt(p) * std::pow(std::log(p), 1.5));
}

template <int dim>
InfSup measure_inf_sup(const Scene<dim> &scene, const Triangulation<dim> &triangulation,
                       const Degrees &degrees)
{
  const OneThread one_thread;
  const auto tables = std::make_shared<const ShapeTables<dim>>();
  const Laboratory<dim> own(scene, borrowed(triangulation), degrees, tables);
  const ContactSpace<dim> &contact_space = own.discretisation.spaces->contact_space;
  InfSup result{std::numeric_limits<double>::infinity(), contact_space.n_multipliers(), 0, 0};
  if (result.n_multipliers == 0)
    return result;
  for (const ContactFace<dim> &face : contact_space.faces())
    if (face.n_multipliers > 0 || !face.pressures.empty())
    {
      result.highest_degree = std::max(result.highest_degree, face.degree);
      result.lowest_degree =
          result.lowest_degree == 0 ? face.degree : std::min(result.lowest_degree, face.degree);
    }
  const double square = smallest_eigenvalue(
      own.schur_complement(own.discretisation.contact_rows),
      reference_schur_complement(scene, triangulation, degrees, contact_space, tables));
  result.beta = std::sqrt(std::max(square, 0.)); // a zero may come out as a negative round-off
  return result;
}

template InfSup measure_inf_sup(const Scene<2> &, const Triangulation<2> &, const Degrees &);
} // namespace hpvi
