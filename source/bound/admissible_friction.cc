// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/admissible_friction.h>
#include <hpvi/bound/friction_patch.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/plane/matching.h>
#include <hpvi/results/contact_traces.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
double hat(const unsigned int end, const double s)
{
  return end == 0 ? 1. - s : s;
}

/** 1 or -1 where u_Nt has that sign wherever g acts on a face; else 0. */
double common_motion(const EdgePolynomial &u_t, const FrictionRule &rule)
{
  double sum = 0, of_sizes = 0;
  for (unsigned int q = 0; q < rule.points.size(); ++q)
  {
    const double work = rule.weights[q] * rule.values[q] * u_t(rule.points[q]);
    sum += work;
    of_sizes += std::abs(work);
  }
  return std::abs(sum) < (1. - 1e-10) * of_sizes ? 0. : sum < 0. ? -1. : sum > 0. ? 1. : 0.;
}

/** 1 or -1 where all Gauss points of a face slip that way, those that feel g; where none does, u_Nt says it; else 0. */
template <int dim>
double common_slip(const ContactFace<dim> &face, const Solution<dim> &solution,
                   const EdgePolynomial &u_t, const FrictionRule &rule)
{
  double result = 0;
  for (unsigned int i = face.first_multiplier; i < face.first_multiplier + face.n_multipliers; ++i)
  {
    if (solution.contact_space.multipliers()[i].friction.vanishes())
      continue;
    const double slip = slip_at(i, solution.z, solution.contact_space);
    if (slip == 0. || slip * result < 0.)
      return 0.;
    result = slip;
  }
  return result != 0. ? result : common_motion(u_t, rule);
}

/** z_N as a polynomial of degree p-2 along a face. */
template <int dim>
EdgePolynomial discrete_friction(const ContactFace<dim> &face, const Solution<dim> &solution)
{
  const auto first = solution.z.begin() + face.first_multiplier;
  return EdgePolynomial::through({first, first + face.n_multipliers},
                                 solution.tables.gauss(face.n_multipliers));
}

/** What g l_a should be near: z_N; where that is one number, for p = 2, with the slope of -sigma_t(u_N). */
template <int dim>
EdgePolynomial wanted_friction(const ContactFace<dim> &face, const Solution<dim> &solution)
{
  EdgePolynomial z = discrete_friction(face, solution);
  if (face.n_multipliers > 1)
    return z;
  const QGauss<1> &gauss = solution.tables.gauss(face.degree + 1);
  const ContactTraces<dim> traces(face, gauss.size(), solution);
  std::vector<double> values;
  for (unsigned int q = 0; q < gauss.size(); ++q)
    values.push_back(-traces.traction(q) * face.frame(gauss.point(q)[0]).tangent);
  std::vector<double> coefficients = EdgePolynomial::through(values, gauss).coefficients();
  coefficients[0] = z.coefficients()[0];
  return EdgePolynomial(coefficients);
}

/** What a face adds to the patches of both its ends. */
template <int dim>
class FaceIntegrals
{
public:
  FaceIntegrals(const unsigned int number, const Solution<dim> &solution)
      : number(number), face(solution.contact_space.faces()[number]),
        n(traction_degree(face, solution.z, solution.contact_space) + 1),
        rule(traction_rule(face, n - 1, solution.tables)),
        weight(face.length /
               (2. * solution.scene.material_of(face.cell).residual_weight() * face.degree)),
        leans(may_have_transition(number, solution.z, solution.contact_space)),
        gauss(solution.tables.gauss(face.n_multipliers + 1)), z(discrete_friction(face, solution)),
        wanted(wanted_friction(face, solution)),
        u_t(slip_trace(face, solution.displacement_space, solution.tables, solution.u)),
        slip(leans ? 0. : common_slip(face, solution, u_t, rule))
  {
  }

  std::array<PatchFace, 2> sides() const; ///< by end

private:
  const unsigned int number;
  const ContactFace<dim> &face;
  const unsigned int n;
  const FrictionRule rule;
  const double weight;
  const bool leans;
  const QGauss<1> &gauss;
  const EdgePolynomial z, wanted, u_t;
  const double slip; ///< of a PatchFace
};

template <int dim>
std::array<PatchFace, 2> FaceIntegrals<dim>::sides() const
{
  std::array<PatchFace, 2> result;
  for (unsigned int end = 0; end < 2; ++end)
    result[end] = {
        number, end, 0.,   0.,   Vector<double>(n), FullMatrix<double>(n, n), Vector<double>(n),
        {},     0.,  slip, leans};
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const double s = gauss.point(q)[0], work = face.length * gauss.weight(q) * z(s);
    for (PatchFace &side : result)
      side.work += hat(side.end, s) * work;
  }
  std::vector<double> L(n);
  const double largest = *std::max_element(rule.values.begin(), rule.values.end());
  for (unsigned int q = 0; q < rule.points.size(); ++q)
  {
    const double s = rule.points[q], g = rule.values[q], ds = face.length * rule.weights[q];
    legendre::set_values(n, 2. * s - 1., L.data());
    const double t = wanted(s), slipped = leans ? u_t(s) : 0.,
                 lambda = g > 0. ? std::max(-1., std::min(1., t / g)) : 0.,
                 small = 1e-6 * weight * ds * largest * largest;
    for (PatchFace &side : result)
    {
      const double psi = hat(side.end, s);
      side.limit += ds * psi * g;
      // A little everywhere, so that l is determined where the hat or g is next to nothing.
      const double part = weight * ds * (psi + 1e-3), share = part * g * g + small,
                   wanted_moment = part * g * t + small * lambda + ds * psi * g * slipped;
      for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int j = 0; j < n; ++j)
          side.H(i, j) += share * L[i] * L[j];
        side.moments[i] += ds * psi * g * L[i];
        side.h[i] += wanted_moment * L[i];
      }
    }
  }
  return result;
}

/** Do the faces of two sides meet without a corner? What two bodies opposite share is no friction of either. */
template <int dim>
bool are_aligned(const PatchFace &a, const PatchFace &b, const std::vector<ContactFace<dim>> &faces)
{
  const bool rubs_bodies = !faces[a.face].segments.empty() || !faces[b.face].segments.empty();
  return !(rubs_bodies && faces[a.face].condition != faces[b.face].condition) &&
         (faces[a.face].node_frame(a.end).normal - faces[b.face].node_frame(b.end).normal).norm() <
             1e-6;
}
} // namespace

template <int dim>
AdmissibleFriction<dim>::AdmissibleFriction(const Solution<dim> &solution)
    : parts(solution.contact_space.faces().size()), missing(parts.size())
{
  static_assert(dim == 2, "vertices of edges");
  const std::vector<ContactFace<dim>> &faces = solution.contact_space.faces();
  std::map<unsigned int, std::vector<PatchFace>> sides; // by vertex
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (!faces[k].friction.vanishes() && faces[k].n_multipliers > 0)
    {
      for (PatchFace &side : FaceIntegrals<dim>(k, solution).sides())
        sides[faces[k].cell->face(faces[k].face_no)->vertex_index(side.end)].push_back(
            std::move(side));
    }
  for (auto &[vertex, around] : sides)
  {
    if (around.size() == 2 && are_aligned(around[0], around[1], faces))
      distribute({&around[0], &around[1]});
    else
      for (PatchFace &side : around)
        distribute({&side});
    for (const PatchFace &side : around)
    {
      parts[side.face][side.end] = side.l;
      missing[side.face][side.end] = side.missing;
      largest_imbalance = std::max(largest_imbalance, std::abs(side.missing) / side.limit);
    }
  }
}

template <int dim>
const EdgePolynomial &AdmissibleFriction<dim>::part(const unsigned int face,
                                                    const unsigned int end) const
{
  return parts[face][end];
}

template <int dim>
double AdmissibleFriction<dim>::value(const unsigned int face, const double s) const
{
  const double first = parts[face][0](s), second = parts[face][1](s);
  return first + s * (second - first); // where both are 1 it is
}

template <int dim>
double AdmissibleFriction<dim>::imbalance() const
{
  return largest_imbalance;
}

/** By the density `m (4 psi_a - 2 psi_b)/length`, which does the work m on psi_a and none on psi_b. */
template <int dim>
Vector<double> AdmissibleFriction<dim>::missing_forces(const Solution<dim> &solution) const
{
  Vector<double> result(solution.u.size());
  for (unsigned int k = 0; k < missing.size(); ++k)
  {
    if (missing[k][0] == 0. && missing[k][1] == 0.)
      continue;
    const ContactFace<dim> &face = solution.contact_space.faces()[k];
    const unsigned int n = face.degree + 1;
    const Tensor<1, dim> tangent = face.frame(0.5).tangent;
    const FaceDofs<dim> dofs(face, solution.displacement_space, solution.tables);
    const FullMatrix<double> &shapes = solution.tables.edge(face.degree, face.n_points, n).shapes;
    const QGauss<1> &gauss = solution.tables.gauss(n);
    for (unsigned int q = 0; q < n; ++q)
    {
      const double s = gauss.point(q)[0], first = 4. - 6. * s, last = 6. * s - 2.,
                   work = gauss.weight(q) * (missing[k][0] * first + missing[k][1] * last);
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int j = 0; j < n; ++j)
          dofs.add_force(c * n + j, work * shapes(q, j) * tangent[c], result);
    }
  }
  return result;
}

template class AdmissibleFriction<2>;
} // namespace hpvi
