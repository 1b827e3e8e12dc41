// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/evaluation/contact_traces.h>
#include <hpvi/evaluation/unseen_contact.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
bool presses(const ContactFace<dim> &face, const Vector<double> &z)
{
  return std::any_of(face.pressures.begin(), face.pressures.end(),
                     [&](const unsigned int unknown) { return z[unknown] > 0.; });
}

/** The deepest point of one face. */
template <int dim>
UnseenContact<dim> deepest_point(const ContactFace<dim> &face, const Solution<dim> &solution)
{
  const EdgeDisplacement<dim> u_n(face, solution, &ContactFrame<dim>::normal);
  const auto gap = [&](const double s) { return face.condition->gap_at(face.point(s)) - u_n(s); };
  const unsigned int n_samples = 4 * (face.degree + 1);
  std::vector<double> samples;
  for (unsigned int k = 0; k <= n_samples; ++k)
    samples.push_back(gap(double(k) / n_samples));
  UnseenContact<dim> deepest{&face, face.point(0.), -samples[0]};
  for (unsigned int k = 0; k <= n_samples; ++k)
  {
    const unsigned int before = k == 0 ? 0 : k - 1, after = std::min(k + 1, n_samples);
    if (samples[k] > samples[before] || samples[k] > samples[after])
      continue;
    const auto [s, least] = boost::math::tools::brent_find_minima(gap, double(before) / n_samples,
                                                                  double(after) / n_samples, 40);
    if (-least > deepest.depth)
      deepest = {&face, face.point(s), -least};
  }
  return deepest;
}
} // namespace

template <int dim>
std::vector<UnseenContact<dim>> unseen_contacts(const Solution<dim> &solution)
{
  const std::vector<ContactFace<dim>> &faces = solution.contact_space.faces();
  const double negligible = 1e-10 * solution.u.linfty_norm();
  const auto is_next_to = [&](const ContactFace<dim> &face, const unsigned int other)
  {
    return other < faces.size() && faces[other].condition == face.condition &&
           presses(faces[other], solution.z);
  };
  std::vector<UnseenContact<dim>> result;
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (faces[k].condition->is_unilateral() && !presses(faces[k], solution.z) &&
        !is_next_to(faces[k], k + 1) && !(k > 0 && is_next_to(faces[k], k - 1)))
      if (const UnseenContact<dim> deepest = deepest_point(faces[k], solution);
          deepest.depth > negligible)
        result.push_back(deepest);
  return result;
}

template std::vector<UnseenContact<2>> unseen_contacts(const Solution<2> &);
} // namespace hpvi
