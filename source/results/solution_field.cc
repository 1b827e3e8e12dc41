// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/results/solution_field.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace hpvi
{
using namespace dealii;

template <int dim>
SolutionField<dim>::SolutionField(const Solution<dim> &solution)
    : SolutionField(std::shared_ptr<const Solution<dim>>(std::shared_ptr<void>(), &solution))
{
}

template <int dim>
SolutionField<dim>::SolutionField(std::shared_ptr<const Solution<dim>> one)
    : Field<dim>(one->scene, one->tables, one->displacement_space.dof_handler()),
      kept(std::move(one)), solution(*kept)
{
  for (const ContactFace<dim> &face : solution.contact_space.faces())
    this->add_face(face.cell, face.face_no);
}

template <int dim>
const ContactFace<dim> &SolutionField<dim>::contact_face(const FieldFace<dim> &face) const
{
  return solution.contact_space.faces()[face.number];
}

template <int dim>
double SolutionField<dim>::coordinate(const FieldFace<dim> &face, const Point<dim> &reference) const
{
  static_assert(dim == 2, "one coordinate along a face");
  return reference[1 - face.face_no / 2];
}

template <int dim>
std::vector<double> SolutionField<dim>::coefficients(const Cell &cell) const
{
  return solution.coefficients(cell->active_cell_index());
}

template <int dim>
double SolutionField<dim>::largest_displacement() const
{
  return solution.u.linfty_norm();
}

template <int dim>
ContactTraction<dim> SolutionField<dim>::traction(const FieldFace<dim> &face,
                                                  const Point<dim> &reference) const
{
  const ContactSpace<dim> &space = solution.contact_space;
  const double s = coordinate(face, reference);
  ContactTraction<dim> result;
  result.friction[0] = space.value(contact_face(face), solution.z, s);
  result.pressure = space.pressure(contact_face(face), solution.z, s);
  return result;
}

template <int dim>
double SolutionField<dim>::bound(const FieldFace<dim> &face, const Point<dim> &reference) const
{
  return solution.contact_space.bound(contact_face(face), solution.z, coordinate(face, reference));
}

template <int dim>
Tangential<dim> SolutionField<dim>::past_slip(const FieldFace<dim> &face, const Point<dim> &x) const
{
  return contact_face(face).past_slip(x);
}

template <int dim>
std::vector<ContactSegment<dim>> SolutionField<dim>::segments(const FieldFace<dim> &face) const
{
  return contact_face(face).segments;
}

template <int dim>
Tensor<1, dim> SolutionField<dim>::opposite(const FieldFace<dim> &face,
                                            const Point<dim> &reference) const
{
  Tensor<1, dim> result;
  if (contact_face(face).segments.empty())
    return result;
  const double s = coordinate(face, reference);
  const ContactSegment<dim> &segment = contact_face(face).segment(s);
  const unsigned int n = segment.degree + 1;
  std::vector<double> nodes;
  for (const Point<1> &node : solution.tables.gauss_lobatto(n).get_points())
    nodes.push_back(node[0]);
  const std::vector<double> basis = lagrange_basis(nodes, segment.opposite(s));
  const auto dofs = solution.displacement_space.cell_dofs(segment.cell->active_cell_index());
  const std::vector<unsigned int> &edge =
      solution.tables.numbering(segment.degree).edge[segment.face_no];
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int j = 0; j < n; ++j)
      result[c] += basis[j] * solution.u[dofs[edge[c * n + j]]];
  return result;
}

/** A jump has kinks where edges of the other body end. */
template <int dim>
std::vector<double> SolutionField<dim>::friction_cuts(const FieldFace<dim> &face) const
{
  const ContactFace<dim> &own = contact_face(face);
  if (own.n_multipliers == 0 || face.condition->is_tied())
    return {};
  std::vector<double> cuts = own.friction.cuts;
  if (own.segments.empty())
    return cuts;
  for (const ContactSegment<dim> &segment : own.segments)
    cuts.push_back(segment.begin);
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

namespace
{
/** Is there no pressure at s in [0,1]: of the unknown there, or of those on both sides of it? */
template <int dim>
bool is_open(const ContactFace<dim> &face, const Vector<double> &z, const double s,
             const double negligible)
{
  if (!face.condition->is_unilateral())
    return false;
  const std::vector<double> &points = face.normal_points;
  const unsigned int after =
      std::lower_bound(points.begin(), points.end(), s - 1e-12) - points.begin();
  const auto presses = [&](const unsigned int k)
  { return k < points.size() && z[face.pressures[k]] > negligible; };
  if (after < points.size() && std::abs(points[after] - s) <= 1e-12)
    return !presses(after);
  return !presses(after) && !(after > 0 && presses(after - 1));
}
} // namespace

template <int dim>
std::vector<MultiplierPoint<dim>>
SolutionField<dim>::multiplier_points(const FieldFace<dim> &field_face,
                                      const double negligible) const
{
  const ContactFace<dim> &face = contact_face(field_face);
  const ShapeTable<dim> &table = multiplier_table(field_face);
  std::vector<MultiplierPoint<dim>> result;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const double s = coordinate(field_face, table.points[q]);
    MultiplierPoint<dim> point{table.points[q],
                               table.weights[q] * face.frame(s).measure,
                               0.,
                               {},
                               is_open(face, solution.z, s, negligible)};
    if (face.n_multipliers > 0)
    {
      const unsigned int unknown = face.first_multiplier + q;
      point.bound = solution.contact_space.bound(unknown, solution.z);
      point.traction.friction[0] = solution.z[unknown];
    }
    if (face.condition->has_pressure())
      point.traction.pressure = solution.contact_space.pressure(face, solution.z, s);
    result.push_back(point);
  }
  return result;
}

template <int dim>
const ShapeTable<dim> &SolutionField<dim>::multiplier_table(const FieldFace<dim> &face) const
{
  return solution.tables.face(face.degree(), face.face_no,
                              std::max(contact_face(face).n_points, 1U));
}

template <int dim>
std::vector<PressureValue<dim>>
SolutionField<dim>::pressures(const FieldFace<dim> &field_face) const
{
  const ContactFace<dim> &face = contact_face(field_face);
  std::vector<PressureValue<dim>> result;
  for (unsigned int k = 0; k < face.normal_points.size(); ++k)
    result.push_back({face.point(face.normal_points[k]), solution.z[face.pressures[k]]});
  return result;
}

template <int dim>
double SolutionField<dim>::contact_work() const
{
  const Vector<double> moments = solution.spaces->contact_operator.moments(solution.u);
  double sum = 0;
  for (unsigned int i = 0; i < moments.size(); ++i)
    sum += solution.z[i] * (moments[i] - solution.contact_space.multipliers()[i].gap);
  return sum;
}

template <int dim>
std::unique_ptr<const Field<dim>>
SolutionField<dim>::round_off_probe(const Scene<dim> &unloaded) const
{
  const DisplacementSpace<dim> &space = solution.displacement_space;
  std::mt19937 random;
  std::uniform_real_distribution<double> uniform(-1., 1.);
  Vector<double> u(space.n_dofs());
  for (unsigned int cell = 0; cell < space.degrees().size(); ++cell)
  {
    double largest = 0;
    for (const auto dof : space.cell_dofs(cell))
      largest = std::max(largest, std::abs(solution.u[dof]));
    for (const auto dof : space.cell_dofs(cell))
      u[dof] = std::numeric_limits<double>::epsilon() * largest * uniform(random);
  }
  return std::unique_ptr<const Field<dim>>(new SolutionField(std::make_shared<const Solution<dim>>(
      unloaded, solution.spaces, u, Vector<double>(solution.z.size()))));
}

template class SolutionField<2>;
} // namespace hpvi
