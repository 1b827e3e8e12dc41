// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/deformation.h>
#include <hpvi/results/contact_traces.h>
#include <hpvi/results/solution_field.h>
#include <hpvi/results/unseen_contact.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

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
UnseenContact<dim> deepest_point(const ContactFace<dim> &face, const FieldFace<dim> &field_face,
                                 const Field<dim> &field)
{
  const EdgeDisplacement<dim> u_n(field_face, field, false);
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
    if (-samples[k] > deepest.depth) // so narrow a minimum may be lost again
      deepest = {&face, face.point(double(k) / n_samples), -samples[k]};
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
  const SolutionField<dim> field(solution);
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
      if (const UnseenContact<dim> deepest = deepest_point(faces[k], field.faces()[k], field);
          deepest.depth > negligible)
        result.push_back(deepest);
  return result;
}

namespace
{
/** Where the conditions of a face look at the gap, in [0,1]. */
template <int dim>
std::vector<double> condition_points(const ContactFace<dim> &face, const ShapeTables<dim> &tables)
{
  const Quadrature<1> &rule =
      face.at_nodes ? static_cast<const Quadrature<1> &>(tables.gauss_lobatto(face.degree + 1))
                    : tables.gauss(std::max(face.degree, face.n_points) + 2);
  // A gap that jumps at a vertex has two values there, of which the one on this face counts.
  const double inside = 1e-4;
  std::vector<double> points;
  for (const Point<1> &point : rule.get_points())
    points.push_back(std::min(std::max(point[0], inside), 1 - inside));
  return points;
}

/** The place where the gap is missed most, by more than @p negligible; none without a face. */
template <int dim>
UnseenGap<dim> missed_gap(const ContactFace<dim> &face, const Solution<dim> &solution,
                          const SolutionField<dim> &field, const double negligible)
{
  const auto gap = [&](const double s) { return face.condition->gap_at(face.point(s)); };
  const std::vector<double> points = condition_points(face, solution.tables);
  std::vector<double> values;
  for (const double s : points)
    values.push_back(gap(s));
  const EdgeDisplacement<dim> u_n(field.faces()[&face - &solution.contact_space.faces().front()],
                                  field, false);
  UnseenGap<dim> worst{nullptr, {}, 0., 0.};
  double most = negligible;
  for (const double value : values)
    most = std::max(most, 1e-9 * std::abs(value)); // round-off is no miss
  const unsigned int n_samples = 128;
  for (unsigned int k = 0; k < n_samples; ++k)
  {
    const double s = (k + 0.5) / n_samples, here = gap(s);
    const std::vector<double> basis = lagrange_basis(points, s);
    const double seen = std::inner_product(basis.begin(), basis.end(), values.begin(), 0.);
    if (std::abs(seen - here) > most && u_n(s) > std::min(seen, here) - negligible)
    {
      most = std::abs(seen - here);
      worst = {&face, face.point(s), here, seen};
    }
  }
  return worst;
}
} // namespace

template <int dim>
double deformation(const Field<dim> &field)
{
  Deformation<dim> deformation;
  for (const auto &cell : field.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    const CellMap<dim> map = map_of<dim>(cell);
    const auto &nodes = cell->get_fe().base_element(0).get_unit_support_points();
    const std::vector<double> u = field.coefficients(cell);
    for (unsigned int i = 0; i < nodes.size(); ++i)
    {
      Tensor<1, dim> value;
      for (unsigned int c = 0; c < dim; ++c)
        value[c] = u[c * nodes.size() + i];
      deformation.add(map.point(nodes[i]), value);
    }
  }
  return deformation.largest(field.communicator());
}

template <int dim>
std::vector<UnseenGap<dim>> unseen_gaps(const Solution<dim> &solution)
{
  const double shortest = 1e-6 * solution.scene.geometry.diameter();
  const auto &faces = solution.contact_space.faces();
  const auto may_miss = [&](const ContactFace<dim> &face)
  { return face.condition->is_unilateral() && face.condition->gap && face.length > shortest; };
  std::vector<UnseenGap<dim>> result;
  if (std::none_of(faces.begin(), faces.end(), may_miss))
    return result;
  const SolutionField<dim> field(solution);
  const double negligible = 1e-3 * deformation(field);
  for (const ContactFace<dim> &face : faces)
    if (may_miss(face))
      if (const UnseenGap<dim> missed = missed_gap(face, solution, field, negligible); missed.face)
        result.push_back(missed);
  return result;
}

template <int dim>
std::vector<MissedDisplacement<dim>> within_reach(std::vector<MissedDisplacement<dim>> missed,
                                                  const Solution<dim> &solution)
{
  const double reach = 3 * solution.u.linfty_norm();
  const auto &faces = solution.contact_space.faces();
  const auto nobody_closes = [&](const MissedDisplacement<dim> &one)
  {
    const auto has_it = [&](const auto &face)
    {
      return face.cell->active_cell_index() == one.cell &&
             one.name == "Gap on " + face.condition->name;
    };
    return one.is_gap && (std::min(one.value, one.interpolated) > reach ||
                          std::none_of(faces.begin(), faces.end(), has_it));
  };
  missed.erase(std::remove_if(missed.begin(), missed.end(), nobody_closes), missed.end());
  return missed;
}

template std::vector<UnseenContact<2>> unseen_contacts(const Solution<2> &);
template double deformation(const Field<2> &);
template double deformation(const Field<3> &);
template std::vector<UnseenGap<2>> unseen_gaps(const Solution<2> &);
template std::vector<MissedDisplacement<2>> within_reach(std::vector<MissedDisplacement<2>>,
                                                         const Solution<2> &);
} // namespace hpvi
