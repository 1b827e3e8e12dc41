// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/qprojector.h>
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/contact/contact_space.h>

#include <algorithm>

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
  const Tensor<1, dim> normal = outer_normal<dim>(cell, face_no);
  const int n_points = std::max(0, static_cast<int>(degree) + multiplier_offset + 1);
  return {cell,
          face_no,
          degree,
          &condition,
          normal,
          -cross_product_2d(normal),
          static_cast<unsigned int>(n_points),
          0,
          0,
          {},
          nullptr};
}

/** Give the face its rule for g; the integrands of B have degree p + n_points - 1 beside g. */
template <int dim>
void integrate_friction(ContactFace<dim> &face, const QGauss<1> &gauss)
{
  const unsigned int degree = face.degree + std::max(1U, face.n_points) - 1;
  face.friction = make_friction_rule(
      [&face](const double s) { return face.friction_bound(face.point(s)); }, gauss, degree);
  if (face.friction.cuts.size() == 2)
    return;
  std::vector<Point<1>> points;
  for (const double s : face.friction.points)
    points.emplace_back(s);
  std::vector<Point<dim>> on_face(points.size());
  QProjector<dim>::project_to_face(ReferenceCells::get_hypercube<dim>(), Quadrature<1>(points),
                                   face.face_no, on_face);
  face.own_table = std::make_shared<const ShapeTable<dim>>(
      tabulate<dim>(face.degree, on_face, face.friction.weights, false));
}
} // namespace

template <int dim>
double ContactFace<dim>::friction_bound(const Point<dim> &x) const
{
  return condition->friction.bound ? condition->friction.bound->value(x) : 0.;
}

template <int dim>
Point<dim> ContactFace<dim>::point(const double s) const
{
  const auto edge = cell->face(face_no);
  return edge->vertex(0) + s * (edge->vertex(1) - edge->vertex(0));
}

template <int dim>
double ContactFace<dim>::length() const
{
  return cell->face(face_no)->diameter();
}

template <int dim>
const ShapeTable<dim> &ContactFace<dim>::friction_table(const ShapeTables<dim> &tables) const
{
  return own_table ? *own_table : tables.face(degree, face_no, friction.points.size());
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
                     return a.tangent * (b.point(0.5) - a.point(0.5)) > 0;
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
    if (face.n_multipliers > 0 && elements.count(face.n_multipliers) == 0)
      elements.emplace(face.n_multipliers, QGauss<1>(face.n_multipliers));
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
  Vector<double> lower(n_unknowns), upper(n_unknowns);
  lower = -1.;
  upper = 1.;
  return {lower, upper};
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
double ContactSpace<dim>::value(const ContactFace<dim> &face, const Vector<double> &lambda,
                                const double s) const
{
  const std::vector<double> basis = basis_values(face, s);
  double sum = 0;
  for (unsigned int i = 0; i < basis.size(); ++i)
    sum += basis[i] * lambda[face.first_multiplier + i];
  return sum;
}

template <int dim>
double ContactSpace<dim>::friction_limit() const
{
  double sum = 0;
  for (const ContactFace<dim> &face : contact_faces)
    sum += face.length() * face.friction.integral();
  return sum;
}

template <int dim>
std::vector<UnresolvedJump<dim>> ContactSpace<dim>::unresolved_jumps() const
{
  const double negligible = 1e-6 * friction_limit();
  std::vector<UnresolvedJump<dim>> result;
  for (const ContactFace<dim> &face : contact_faces)
    for (const FrictionRule::Jump &jump : face.friction.jumps)
      if (std::abs(jump.height) * face.length() > negligible)
        result.push_back({&face, face.point(jump.s), std::abs(jump.height)});
  return result;
}

template struct ContactFace<2>;
template class ContactSpace<2>;
} // namespace hpvi
