// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numbers.h>
#include <hpvi/plane/contact_space.h>
#include <hpvi/plane/curved_edges.h>
#include <hpvi/plane/mesh.h>

#include <algorithm>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * The edges of one boundary, ascending, as they follow each other. The mesh begins its loops anywhere: what ends where a chain of
 * edges begins comes before it, so that a chain begins at an end of the boundary.
 */
std::vector<unsigned int> chained(const CoarseMesh &mesh, std::vector<unsigned int> edges)
{
  const auto meet = [&](const unsigned int one, const unsigned int other)
  { return mesh.edges[one].vertices[1] == mesh.edges[other].vertices[0]; };
  for (auto begin = edges.begin(); begin != edges.end();)
  {
    auto end = begin + 1;
    while (end != edges.end() && meet(end[-1], *end))
      ++end;
    const auto last =
        std::find_if(end, edges.end(), [&](const unsigned int edge) { return meet(edge, *begin); });
    if (last != edges.end())
    {
      auto first = last;
      while (first != end && meet(first[-1], *first))
        --first;
      std::rotate(begin, first, last + 1);
      end += last + 1 - first;
    }
    begin = end;
  }
  return edges;
}

/**
 * Sorts faces one boundary after the other: of a mesh as its edges follow each other, counterclockwise around the body, from an end
 * of the boundary; of a grid by place along the tangent.
 */
template <int dim>
void sort_along_boundaries(const Geometry<dim> &geometry, std::vector<ContactFace<dim>> &faces)
{
  if (!geometry.mesh)
    return std::stable_sort(faces.begin(), faces.end(),
                            [](const ContactFace<dim> &a, const ContactFace<dim> &b)
                            {
                              if (a.condition->id != b.condition->id)
                                return a.condition->id < b.condition->id;
                              return a.frame(0.5).tangent * (b.point(0.5) - a.point(0.5)) > 0;
                            });
  const EdgePlaces places(*geometry.mesh);
  std::vector<EdgePlace> at;
  std::map<types::boundary_id, std::vector<unsigned int>> edges;
  for (const ContactFace<dim> &face : faces)
  {
    at.push_back(places(face.cell, face.face_no));
    edges[face.condition->id].push_back(at.back().edge);
  }
  std::map<unsigned int, unsigned int> ranks;
  for (auto &[boundary, own] : edges)
  {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    for (const unsigned int edge : chained(*geometry.mesh, own))
      ranks.emplace(edge, ranks.size());
  }
  std::vector<std::pair<double, unsigned int>> order;
  for (unsigned int k = 0; k < faces.size(); ++k)
    order.emplace_back(ranks.at(at[k].edge) + (at[k].from + at[k].to) / 2, k);
  std::sort(order.begin(), order.end());
  std::vector<ContactFace<dim>> sorted;
  for (const auto &[place, k] : order)
    sorted.push_back(faces[k]);
  faces = std::move(sorted);
}

template <int dim>
ContactFace<dim> make_face(const typename DoFHandler<dim>::active_cell_iterator &cell,
                           const unsigned int face_no, const unsigned int degree,
                           const int multiplier_offset, const BoundaryCondition<dim> &condition)
{
  ContactFace<dim> face{cell, face_no, degree, &condition, map_of<dim>(cell), 0, 0, 0,
                        0,    {},      {},     {}};
  face.n_points = std::max(0, static_cast<int>(degree) + multiplier_offset + 1);
  face.length = face.map.is_curved() ? face.map.face_area(face_no) : face.frame(0.5).measure;
  return face;
}
} // namespace

template <int dim>
ContactSpace<dim>::ContactSpace(const Scene<dim> &scene,
                                const DisplacementSpace<dim> &displacement_space,
                                const ShapeTables<dim> &tables, const PastSlip<dim> &past)
{
  if (!scene.has_contact())
    return;
  const MortarSegmentation<dim> segmentation(scene, displacement_space);
  for (const auto &cell : displacement_space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned() && cell->at_boundary())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
        {
          const BoundaryCondition<dim> &condition = scene.boundaries[cell->face(f)->boundary_id()];
          if (!condition.has_contact() || segmentation.is_master(condition.id))
            continue;
          contact_faces.push_back(make_face(cell, f,
                                            displacement_space.degrees()[cell->active_cell_index()],
                                            scene.solver.multiplier_offset, condition));
          ContactFace<dim> &face = contact_faces.back();
          face.segments = segmentation.segments(cell, f);
          face.bodies[0] = body_of<dim>(scene.geometry, cell);
          if (!face.segments.empty())
            face.bodies[1] = body_of<dim>(scene.geometry, face.segments.front().cell);
        }

  sort_along_boundaries(scene.geometry, contact_faces);
  for (ContactFace<dim> &face : contact_faces)
  {
    face.is_axisymmetric = scene.is_axisymmetric();
    if (const auto found = past.find(face.condition->id); found != past.end())
      face.past = found->second;
    number_friction(face, scene, tables);
    if (!face.condition->has_pressure())
      continue;
    // With nodes a limit that follows the pressure could turn negative between them, and bodies would hand over forces wrongly.
    face.at_nodes = scene.normal_contact() == NormalContact::nodes &&
                    !face.condition->friction.knows_pressure() && !face.condition->pair;
    if (face.at_nodes)
      number_nodes(face, displacement_space, tables);
    else
      number_pressures(face, tables);
  }
  for (const ContactFace<dim> &face : contact_faces)
  {
    for (unsigned int i = 0; i < face.n_multipliers; ++i)
      unknowns[face.first_multiplier + i].bodies = face.bodies;
    for (const unsigned int i : face.pressures)
      unknowns[i].bodies = face.bodies;
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
  return unknowns.size();
}

template <int dim>
const std::vector<ContactMultiplier<dim>> &ContactSpace<dim>::multipliers() const
{
  return unknowns;
}

template <int dim>
FeasibleSet ContactSpace<dim>::feasible_set() const
{
  FeasibleSet result;
  for (const ContactMultiplier<dim> &unknown : unknowns)
    if (unknown.is_bilateral || unknown.partner != none)
      result.add_interval(-infinity, infinity);
    else if (unknown.kind == Kind::friction)
      result.add_interval(-unknown.friction.limit(0.), unknown.friction.limit(0.));
    else
      result.add_interval(0., infinity);
  return result;
}

template <int dim>
std::vector<FrictionCones::Cone> ContactSpace<dim>::cones() const
{
  std::vector<FrictionCones::Cone> result;
  for (unsigned int i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].partner != none)
      result.push_back({i, unknowns[i].partner, unknowns[i].friction});
  return result;
}

template <int dim>
ContactSpace<dim> ContactSpace<dim>::under(const std::vector<std::function<double(double)>> &limits,
                                           const Vector<double> &z,
                                           const ShapeTables<dim> &tables) const
{
  ContactSpace<dim> result(*this);
  for (unsigned int i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].kind == Kind::friction)
      result.unknowns[i].friction = {bound(i, z), 0.};
  for (unsigned int k = 0; k < contact_faces.size(); ++k)
    if (limits[k])
    {
      ContactFace<dim> &face = result.contact_faces[k];
      const unsigned int n = std::max(face.degree + 1, face.n_points);
      face.limit = limits[k];
      face.friction = make_friction_rule(limits[k], tables.gauss(n),
                                         face.degree + std::max(1U, face.n_points) - 1);
    }
  return result;
}

template <int dim>
double ContactSpace<dim>::bound(const unsigned int unknown, const Vector<double> &z) const
{
  const ContactMultiplier<dim> &own = unknowns[unknown];
  return own.friction.limit(own.partner == none ? 0. : z[own.partner]);
}

template <int dim>
double ContactSpace<dim>::bound(const ContactFace<dim> &face, const Vector<double> &z,
                                const double s) const
{
  const Point<dim> x = face.point(s);
  const FrictionLaw<dim> &law = face.condition->friction;
  return law.limit(x, law.knows_pressure() ? pressure(face, z, s) : 0.);
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
double ContactSpace<dim>::pressure(const ContactFace<dim> &face, const Vector<double> &z,
                                   const double s) const
{
  const std::vector<double> basis = lagrange_basis(face.normal_points, s);
  double sum = 0;
  for (unsigned int i = 0; i < basis.size(); ++i)
    sum += basis[i] * z[face.pressures[i]];
  return sum;
}

template <int dim>
double ContactSpace<dim>::friction_limit() const
{
  double sum = 0;
  for (const ContactFace<dim> &face : contact_faces)
    sum += face.friction_without_pressure();
  return sum;
}

template <int dim>
double ContactSpace<dim>::discrete_friction_limit() const
{
  double sum = 0;
  for (const ContactMultiplier<dim> &unknown : unknowns)
    sum += unknown.weight * unknown.friction.limit(0.);
  return sum;
}

template <int dim>
double ContactSpace<dim>::largest_bound() const
{
  double largest = 0;
  for (const ContactMultiplier<dim> &unknown : unknowns)
    largest = std::max(largest, unknown.friction.limit(0.));
  return largest;
}

template class ContactSpace<2>;
} // namespace hpvi
