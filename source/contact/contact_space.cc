// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/base/input_error.h>
#include <hpvi/contact/contact_space.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
ContactFace<dim> make_face(const typename DoFHandler<dim>::active_cell_iterator &cell,
                           const unsigned int face_no, const unsigned int degree,
                           const int multiplier_offset, const BoundaryCondition<dim> &condition)
{
  const int n_points = std::max(0, static_cast<int>(degree) + multiplier_offset + 1);
  ContactFace<dim> face{
      cell, face_no, degree, &condition, map_of<dim>(cell), 0, static_cast<unsigned int>(n_points),
      0,    0,       {}};
  face.length = face.frame(0.5).measure;
  return face;
}

/** Give the face its rule for g; in `int g |u_t|` g meets the degree p. */
template <int dim>
void integrate_friction(ContactFace<dim> &face, const QGauss<1> &gauss)
{
  face.friction =
      make_friction_rule([&face](const double s) { return face.friction_bound(face.point(s)); },
                         gauss, face.degree + std::max(1U, face.n_points) - 1);
}
/** A scene by code is checked at some points of the boundary, none of which need be @p x. */
template <int dim>
double checked_bound(const ContactFace<dim> &face, const Point<dim> &x)
{
  const double g = face.friction_bound(x);
  if (g >= 0 && std::isfinite(g))
    return g;
  std::ostringstream line;
  line << "Boundary " << face.condition->name << "/Friction bound: is " << g << " at (" << x
       << "); give a bound that is finite and not negative everywhere";
  throw InputError(line.str());
}
} // namespace

template <int dim>
ContactFrame<dim> ContactFace<dim>::frame(const double s) const
{
  return contact_frame<dim>(map, face_no, Point<dim - 1>(s));
}

template <int dim>
Point<dim> ContactFace<dim>::point(const double s) const
{
  return map.point(point_on_face<dim>(face_no, Point<dim - 1>(s)));
}

template <int dim>
double ContactFace<dim>::friction_bound(const Point<dim> &x) const
{
  return condition->friction.bound ? condition->friction.bound->value(x) : 0.;
}

template <int dim>
ContactSpace<dim>::ContactSpace(const Scene<dim> &scene,
                                const DisplacementSpace<dim> &displacement_space)
{
  if (!scene.has_contact())
    return;
  for (const auto &cell : displacement_space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned() && cell->at_boundary())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
        {
          const BoundaryCondition<dim> &condition = scene.boundaries[cell->face(f)->boundary_id()];
          if (condition.has_contact())
            contact_faces.push_back(
                make_face(cell, f, displacement_space.degrees()[cell->active_cell_index()],
                          scene.solver.multiplier_offset, condition));
        }

  std::stable_sort(contact_faces.begin(), contact_faces.end(),
                   [](const ContactFace<dim> &a, const ContactFace<dim> &b)
                   {
                     if (a.condition->id != b.condition->id)
                       return a.condition->id < b.condition->id;
                     return a.frame(0.5).tangent * (b.point(0.5) - a.point(0.5)) > 0;
                   });
  number_multipliers();
}

template <int dim>
void ContactSpace<dim>::number_multipliers()
{
  // deal.II computes the points of a Gauss rule anew for each object, so the rules are kept.
  std::map<unsigned int, QGauss<1>> gauss;
  for (ContactFace<dim> &face : contact_faces)
  {
    // p+1 Gauss points are exact to degree 2p+1 = p + (p-2) + 3: exact for g up to degree 3, or 2
    // for multipliers of degree p-1. Only beyond degree p, where no run goes, it takes more.
    const unsigned int n_gauss = std::max(face.degree + 1, face.n_points);
    integrate_friction(face, gauss.try_emplace(n_gauss, n_gauss).first->second);
    face.first_multiplier = n_unknowns;
    face.n_multipliers = face.friction.vanishes() ? 0 : face.n_points;
    n_unknowns += face.n_multipliers;
    if (face.n_multipliers == 0)
      continue;
    const QGauss<1> &points = gauss.try_emplace(face.n_points, face.n_points).first->second;
    elements.try_emplace(face.n_points, points);
    for (unsigned int i = 0; i < face.n_points; ++i)
    {
      const ContactFrame<dim> frame = face.frame(points.point(i)[0]);
      point_weights.push_back(points.weight(i) * frame.measure);
      bounds.push_back(checked_bound(face, frame.x));
    }
  }
}

template <int dim>
const std::vector<ContactFace<dim>> &ContactSpace<dim>::faces() const
{
  return contact_faces;
}

template <int dim>
unsigned int ContactSpace<dim>::n_multipliers() const
{
  return n_unknowns;
}

template <int dim>
FeasibleSet ContactSpace<dim>::feasible_set() const
{
  FeasibleSet result;
  for (const double g : bounds)
    result.add_interval(-g, g);
  return result;
}

template <int dim>
std::vector<double> ContactSpace<dim>::basis_values(const ContactFace<dim> &face,
                                                    const double s) const
{
  std::vector<double> values(face.n_multipliers);
  if (face.n_multipliers > 0)
  {
    const FE_DGQArbitraryNodes<dim - 1> &element = elements.at(face.n_multipliers);
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] = element.shape_value(i, Point<dim - 1>(s));
  }
  return values;
}

template <int dim>
double ContactSpace<dim>::value(const ContactFace<dim> &face, const Vector<double> &z,
                                const double s) const
{
  const std::vector<double> basis = basis_values(face, s);
  double sum = 0;
  for (unsigned int i = 0; i < basis.size(); ++i)
    sum += basis[i] * z[face.first_multiplier + i];
  return sum;
}

template <int dim>
const std::vector<double> &ContactSpace<dim>::weights() const
{
  return point_weights;
}

template <int dim>
double ContactSpace<dim>::friction_limit() const
{
  double sum = 0;
  for (const ContactFace<dim> &face : contact_faces)
    sum += face.length * face.friction.integral();
  return sum;
}

template <int dim>
double ContactSpace<dim>::discrete_friction_limit() const
{
  return std::inner_product(bounds.begin(), bounds.end(), point_weights.begin(), 0.);
}

template <int dim>
double ContactSpace<dim>::largest_bound() const
{
  return bounds.empty() ? 0. : *std::max_element(bounds.begin(), bounds.end());
}

template <int dim>
std::vector<UnresolvedBound<dim>> ContactSpace<dim>::unresolved_bounds() const
{
  const double negligible = 1e-6 * friction_limit();
  std::vector<UnresolvedBound<dim>> result;
  for (const ContactFace<dim> &face : contact_faces)
  {
    double sum = 0;
    for (unsigned int i = 0; i < face.n_multipliers; ++i)
      sum += point_weights[face.first_multiplier + i] * bounds[face.first_multiplier + i];
    const double integral = face.length * face.friction.integral();
    if (std::abs(sum - integral) > std::max(1e-3 * integral, negligible))
      result.push_back({&face, sum, integral});
  }
  return result;
}

template <int dim>
std::vector<UnresolvedJump<dim>> ContactSpace<dim>::unresolved_jumps() const
{
  const double negligible = 1e-6 * friction_limit();
  std::vector<UnresolvedJump<dim>> result;
  for (const ContactFace<dim> &face : contact_faces)
    for (const FrictionRule::Jump &jump : face.friction.jumps)
      if (std::abs(jump.height) * face.length > negligible)
        result.push_back({&face, face.point(jump.s), std::abs(jump.height)});
  return result;
}

template struct ContactFace<2>;
template class ContactSpace<2>;
} // namespace hpvi
