// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/one_thread.h>
#include <hpvi/discretisation/elastic_system.h>
#include <hpvi/evaluation/inf_sup.h>
#include <hpvi/solver/linear_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** How much higher than V_N's the degrees of V_* are. */
constexpr unsigned int additional_degree = 4;

/** The spaces and matrices on one mesh; each member is built from the ones above it. */
template <int dim>
struct Discretisation
{
  ElementStiffnesses<dim> stiffnesses;
  const DisplacementSpace<dim> displacement_space;
  const ContactSpace<dim> contact_space;
  const ElasticSystem<dim> system;

  Discretisation(const Scene<dim> &scene, const Triangulation<dim> &triangulation,
                 const Degrees &degrees, const ShapeTables<dim> &tables)
      : stiffnesses(scene, tables), displacement_space(scene, triangulation, degrees, tables),
        contact_space(scene, displacement_space),
        system(scene, displacement_space, contact_space, tables, stiffnesses)
  {
  }

  LAPACKFullMatrix<double> schur_complement(const FullMatrix<double> &B) const
  {
    return SchurComplement(system.A, system.f, system.contact_unknowns, B).S();
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
  return fine_degrees;
}

/**
 * T, n_multipliers x n_multipliers of the fine space, with `psi_m = sum_k T_mk phi_k` for the
 * coarse basis psi and the fine phi: the values of psi_m at the fine Gauss points. On one half of
 * an edge psi_m has degree p + offset and phi_k the degree p + 4 + offset, so it is exact. It is
 * right to leave out halves without multipliers: g vanishes there.
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
    const QGauss<1> gauss(std::max(1U, half.n_multipliers));
    const Tensor<1, dim> along = face.point(1.) - face.point(0.);
    for (unsigned int i = 0; i < half.n_multipliers; ++i)
    {
      const double s =
          (half.point(gauss.point(i)[0]) - face.point(0.)) * along / along.norm_square();
      Assert(s > 0. && s < 1., ExcMessage("This is no half of the face."));
      const std::vector<double> psi = coarse.basis_values(face, s);
      for (unsigned int m = 0; m < psi.size(); ++m)
        T(face.first_multiplier + m, half.first_multiplier + i) = psi[m];
    }
  }
  return T;
}

/** S_* over the multipliers of @p coarse, from B_* = T B with B of the reference mesh. */
template <int dim>
LAPACKFullMatrix<double>
reference_schur_complement(const Scene<dim> &scene, const Triangulation<dim> &triangulation,
                           const Degrees &degrees, const ContactSpace<dim> &coarse,
                           const ShapeTables<dim> &tables)
{
  Triangulation<dim> fine_triangulation;
  const Degrees fine_degrees = make_reference_mesh(triangulation, degrees, fine_triangulation);
  const Discretisation<dim> fine(scene, fine_triangulation, fine_degrees, tables);
  FullMatrix<double> B(coarse.n_multipliers(), fine.system.B.n());
  embedding(coarse, fine.contact_space).mmult(B, fine.system.B);
  return fine.schur_complement(B);
}

/** `S_ij := scale_i S_ij scale_j` */
void scale(LAPACKFullMatrix<double> &S, const Vector<double> &factors)
{
  for (unsigned int j = 0; j < S.n(); ++j)
    for (unsigned int i = 0; i < S.m(); ++i)
      S(i, j) *= factors[i] * factors[j];
}

/**
 * The smallest eigenvalue of `S z = x S_ref z` by dsygv: Cholesky of S_ref, then dsyev, eigenvalues
 * alone. Both matrices are scaled by the diagonal of S_ref first, which keeps the eigenvalues and
 * takes away the factors g^2 that could spoil the Cholesky factorisation.
 */
double smallest_eigenvalue(LAPACKFullMatrix<double> S, LAPACKFullMatrix<double> S_ref)
{
  const Vector<double> factors = diagonal_scale(S_ref);
  scale(S, factors);
  scale(S_ref, factors);
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
                       const Degrees &degrees, const ShapeTables<dim> &tables)
{
  const OneThread one_thread;
  const Discretisation<dim> own(scene, triangulation, degrees, tables);
  InfSup result{std::numeric_limits<double>::infinity(), own.contact_space.n_multipliers(), 0, 0};
  if (result.n_multipliers == 0)
    return result;
  for (const ContactFace<dim> &face : own.contact_space.faces())
    if (face.n_multipliers > 0)
    {
      result.highest_degree = std::max(result.highest_degree, face.degree);
      result.lowest_degree =
          result.lowest_degree == 0 ? face.degree : std::min(result.lowest_degree, face.degree);
    }
  const double square = smallest_eigenvalue(
      own.schur_complement(own.system.B),
      reference_schur_complement(scene, triangulation, degrees, own.contact_space, tables));
  result.beta = std::sqrt(std::max(square, 0.)); // a zero may come out as a negative round-off
  return result;
}

template InfSup measure_inf_sup(const Scene<2> &, const Triangulation<2> &, const Degrees &,
                                const ShapeTables<2> &);
} // namespace hpvi
