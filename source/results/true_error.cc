// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/base/processes.h>
#include <hpvi/plane/load_quadrature.h>
#include <hpvi/results/common_refinement.h>
#include <hpvi/results/field_difference.h>
#include <hpvi/results/graded_boxes.h>
#include <hpvi/results/true_error.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Over the cells of this process and those of a mesh that descends from the same coarse mesh. */
template <int dim>
DifferenceSquares squares_of_difference(const Field<dim> &field,
                                        const StoredSolution<dim> &reference)
{
  using Cell = typename Triangulation<dim>::cell_iterator;
  const Triangulation<dim> &mesh = field.dof_handler.get_triangulation();
  DifferenceSquares sums;
  for_each_common_part(
      mesh, reference.triangulation(),
      [&](const Cell &a, const BoundingBox<dim> &in_a, const Cell &b, const BoundingBox<dim> &in_b)
      {
        const unsigned int j = b->active_cell_index();
        const LocalField<dim> own = local_field(
            field, typename Field<dim>::Cell(&mesh, a->level(), a->index(), &field.dof_handler));
        const LocalField<dim> truth{reference.degree(j), reference.coefficients(j), map_of<dim>(b)};
        // One point more than affine cells need, for those that are not.
        const QGauss<dim> gauss(std::max(own.degree, truth.degree) + 2);
        auto field_values = own.at(in_a, gauss), truth_values = truth.at(in_b, gauss);
        const double share = in_a.volume();
        const HookesLaw<dim> law(field.scene.material_of(a));
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const Point<dim> s = in_a.unit_to_real(gauss.point(q)), x = own.map.point(s);
          if (field.scene.is_axisymmetric())
            for (FieldValues<dim> *const values : {&field_values[q], &truth_values[q]})
              values->hoop = values->u[0] / x[0];
          sums.add(law, field_values[q], truth_values[q],
                   gauss.weight(q) * share * std::abs(determinant(own.map.jacobian(s))) *
                       field.scene.circumference(x));
        }
      });
  return sums;
}
} // namespace

template <int dim>
TrueError<dim>::TrueError(const Scene<dim> &scene) : scene(scene)
{
  if (!scene.exact_solution && !scene.reference_solution.empty())
    reference = std::make_unique<const StoredSolution<dim>>(scene, scene.reference_solution);
}

template <int dim>
TrueError<dim>::~TrueError() = default;

template <int dim>
TrueErrors TrueError<dim>::measure(const Field<dim> &field,
                                   const std::vector<ContactState<dim>> &contact) const
{
  TrueErrors errors;
  if (scene.exact_solution)
    compare_with_exact(field, contact, errors);
  else if (reference)
    compare_with_reference(field, errors);
  return errors;
}

template <int dim>
void TrueError<dim>::compare_with_reference(const Field<dim> &field, TrueErrors &errors) const
{
  const DifferenceSquares sums =
      total(squares_of_difference(field, *reference), field.communicator());
  errors.energy = std::sqrt(sums.energy);
  errors.l2 = std::sqrt(sums.l2);
  errors.energy_norm = std::sqrt(sums.norm);
  errors.reference_energy = reference->energy();
}

namespace
{
/** A face with straight edges and right angles between them. */
template <int dim>
struct FlatFace
{
  Point<dim> origin;
  std::array<Tensor<1, dim>, dim - 1> edges;
  Tensor<1, dim> normal; ///< outer unit normal
  unsigned int face_no;

  FlatFace(const CellMap<dim> &map, const unsigned int face_no)
      : origin(map.point(point_on_face<dim>(face_no, Point<dim - 1>()))), face_no(face_no)
  {
    Point<dim - 1> middle;
    for (unsigned int s = 0; s < dim - 1; ++s)
    {
      edges[s] = map.point(point_on_face<dim>(face_no, Point<dim - 1>::unit_vector(s))) - origin;
      middle[s] = 0.5;
    }
    normal = map.normal(face_no, point_on_face<dim>(face_no, middle));
  }
};

/** All of the direction @p d more. */
template <int k>
BoundingBox<k> stretched(const BoundingBox<k - 1> &box, const unsigned int d)
{
  std::pair<Point<k>, Point<k>> corners;
  corners.second[d] = 1;
  for (unsigned int i = 0; i + 1 < k; ++i)
  {
    corners.first[i < d ? i : i + 1] = box.lower_bound(i);
    corners.second[i < d ? i : i + 1] = box.upper_bound(i);
  }
  return BoundingBox<k>(corners);
}

/**
 * Boxes of a cell or face with these @p edges at right angles, graded towards singular points. In space those are lines along
 * z, and boxes are as long as an edge along z.
 */
template <std::size_t k, int dim>
std::vector<BoundingBox<int(k)>>
graded_along(const Point<dim> &origin, const std::array<Tensor<1, dim>, k> &edges,
             const std::vector<Point<dim>> &singular, const unsigned int levels)
{
  if constexpr (dim == 3 && k > 1)
    for (unsigned int d = 0; d < k; ++d)
      if (std::abs(edges[d][2]) > 0.5 * edges[d].norm())
      {
        std::array<Tensor<1, dim>, k - 1> others;
        std::copy(edges.begin(), edges.begin() + d, others.begin());
        std::copy(edges.begin() + d + 1, edges.end(), others.begin() + d);
        std::vector<BoundingBox<int(k)>> result;
        for (const auto &box : graded_along(origin, others, singular, levels))
          result.push_back(stretched<int(k)>(box, d));
        return result;
      }
  typename CellMap<int(k)>::Vertices vertices; // in coordinates along the edges
  for (unsigned int v = 0; v < vertices.size(); ++v)
    for (unsigned int s = 0; s < k; ++s)
      vertices[v][s] = (v >> s) & 1 ? edges[s].norm() : 0.;
  std::vector<Point<int(k)>> along(singular.size());
  for (unsigned int n = 0; n < along.size(); ++n)
    for (unsigned int s = 0; s < k; ++s)
      along[n][s] = (singular[n] - origin) * edges[s] / edges[s].norm();
  return graded_boxes(CellMap<int(k)>(vertices), along, levels);
}

std::vector<BoundingBox<2>> graded_cell(const CellMap<2> &map, const ExactSolution<2> &exact,
                                        const unsigned int levels)
{
  return graded_boxes(map, exact.singularities(), levels);
}

std::vector<BoundingBox<3>> graded_cell(const CellMap<3> &map, const ExactSolution<3> &exact,
                                        const unsigned int levels)
{
  const Point<3> origin = map.point(Point<3>());
  std::array<Tensor<1, 3>, 3> edges;
  for (unsigned int d = 0; d < 3; ++d)
    edges[d] = map.point(Point<3>::unit_vector(d)) - origin;
  return graded_along(origin, edges, exact.singularities(), levels);
}

/** int f(reference, x) over @p face, graded towards singular points of @p exact. */
template <int dim, class F>
double integrate_over(const FlatFace<dim> &face, const ExactSolution<dim> &exact,
                      const unsigned int n_gauss, const F &f)
{
  double area = 1;
  for (const Tensor<1, dim> &edge : face.edges)
    area *= edge.norm();
  const QGauss<dim - 1> gauss(n_gauss);
  double sum = 0;
  for (const BoundingBox<dim - 1> &box :
       graded_along(face.origin, face.edges, exact.singularities(), 40))
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const Point<dim - 1> s = box.unit_to_real(gauss.point(q));
      Point<dim> x = face.origin;
      for (unsigned int d = 0; d < dim - 1; ++d)
        x += s[d] * face.edges[d];
      sum += gauss.weight(q) * box.volume() * area * f(point_on_face<dim>(face.face_no, s), x);
    }
  return sum;
}

/** |lambda - z_N/g|^2 over one contact face. */
double multiplier_square(const Field<2> &field, const FieldFace<2> &face,
                         const ExactSolution<2> &exact)
{
  return integrate_over(FlatFace<2>(face.map, face.face_no), exact, face.degree() + 8,
                        [&](const Point<2> &reference, const Point<2> &x)
                        {
                          const double g = field.bound(face, reference);
                          const double difference =
                              exact.multiplier(x) -
                              (g == 0. ? 0. : field.traction(face, reference).friction[0] / g);
                          return difference * difference;
                        });
}

/** In space lambda is a vector, that of the stress. */
double multiplier_square(const Field<3> &field, const FieldFace<3> &face,
                         const ExactSolution<3> &exact)
{
  const HookesLaw<3> law(field.scene.material_of(face.cell));
  return integrate_over(FlatFace<3>(face.map, face.face_no), exact, face.degree() + 8,
                        [&](const Point<3> &reference, const Point<3> &x)
                        {
                          const FaceFrame<3> frame = face.frame(reference);
                          const double g = field.bound(face, reference);
                          const Tensor<1, 3> difference =
                              frame.tangential(law.traction(exact.gradient(x), frame.normal)) +
                              frame.tangential(field.traction(face, reference).friction);
                          return g == 0. ? 0. : difference.norm_square() / (g * g);
                        });
}

/** |p - lambda_Nn|^2 over one contact face. */
template <int dim>
double pressure_square(const Field<dim> &field, const FieldFace<dim> &face,
                       const ExactSolution<dim> &exact)
{
  return integrate_over(FlatFace<dim>(face.map, face.face_no), exact, face.degree() + 8,
                        [&](const Point<dim> &reference, const Point<dim> &x)
                        {
                          const double difference =
                              exact.pressure(x) - field.traction(face, reference).pressure;
                          return difference * difference;
                        });
}

/** -L(u) + int g |u_t| of the exact solution on one face of the boundary. */
template <int dim>
double boundary_potential(const BoundaryCondition<dim> &boundary, const FlatFace<dim> &face,
                          const ExactSolution<dim> &exact)
{
  if (!boundary.has_traction() && !boundary.friction)
    return 0.;
  return integrate_over(face, exact, 12,
                        [&](const Point<dim> &, const Point<dim> &x)
                        {
                          const Tensor<1, dim> u = exact.displacement(x);
                          double density = -(load_at<dim>(boundary.traction, x) * u);
                          if (boundary.friction)
                            density += boundary.friction.limit(x, 0.) *
                                       (u - (u * face.normal) * face.normal).norm();
                          return density;
                        });
}

/** Largest distance of an exact transition to the nearest one of u_N; NaN where there is none. */
template <int dim>
double transition_error(const std::vector<Point<dim>> &found, const ExactSolution<dim> &exact)
{
  const std::vector<Point<dim>> sought = exact.transitions();
  if (found.empty() || sought.empty())
    return TrueErrors::unknown;
  double largest = 0;
  for (const Point<dim> &x : sought)
  {
    double nearest = std::numeric_limits<double>::max();
    for (const Point<dim> &y : found)
      nearest = std::min(nearest, x.distance(y));
    largest = std::max(largest, nearest);
  }
  return largest;
}

/** Squares on one cell; @p body_work gets `int F u` of the exact solution. */
template <int dim>
DifferenceSquares compare_cell(const Field<dim> &field, const typename Field<dim>::Cell &cell,
                               const ExactSolution<dim> &exact, double &body_work)
{
  const Scene<dim> &scene = field.scene;
  const LocalField<dim> own = local_field(field, cell);
  // Boxes shrink to about 1e-8 of the body: what a stress like r^{-1/2} leaves out there is far
  // below round-off of the sum.
  const unsigned int levels = std::max(1, 27 - cell->level());
  const QGauss<dim> gauss(own.degree + 5);
  const HookesLaw<dim> law(scene.material_of(cell));
  DifferenceSquares sums;
  for (const BoundingBox<dim> &box : graded_cell(own.map, exact, levels))
  {
    const auto field_values = own.at(box, gauss);
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const Point<dim> reference_point = box.unit_to_real(gauss.point(q));
      const Point<dim> x = own.map.point(reference_point);
      const double weight =
          gauss.weight(q) * box.volume() * std::abs(determinant(own.map.jacobian(reference_point)));
      const Tensor<1, dim> u = exact.displacement(x);
      sums.add(law, field_values[q], {u, exact.gradient(x)}, weight);
      body_work += weight * (load_at<dim>(scene.body_force_in(cell), x) * u);
    }
  }
  return sums;
}
} // namespace

template <int dim>
void TrueError<dim>::compare_with_exact(const Field<dim> &field,
                                        const std::vector<ContactState<dim>> &contact,
                                        TrueErrors &errors) const
{
  const ExactSolution<dim> &exact = *scene.exact_solution;
  DifferenceSquares own;
  double potential = 0, friction = 0, pressure = 0;
  errors.of_cells.resize(field.dof_handler.get_triangulation().n_active_cells());
  bool has_multipliers = false;
  collectively(
      field.communicator(),
      [&]()
      {
        double body_work = 0;
        for (const auto &cell : field.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
          {
            const DifferenceSquares here = compare_cell<dim>(field, cell, exact, body_work);
            errors.of_cells[cell->active_cell_index()] = here.energy;
            own += here;
          }
        potential = 0.5 * own.norm - body_work;
        for (const auto &cell : field.dof_handler.active_cell_iterators())
          for (const unsigned int f : cell->face_indices())
            if (cell->is_locally_owned() && cell->at_boundary(f))
              potential += boundary_potential(scene.boundaries[cell->face(f)->boundary_id()],
                                              FlatFace<dim>(map_of<dim>(cell), f), exact);
        for (const FieldFace<dim> &face : field.faces())
        {
          has_multipliers = has_multipliers || !field.friction_cuts(face).empty() ||
                            !field.pressures(face).empty();
          errors.of_faces.push_back(face.condition->friction ? multiplier_square(field, face, exact)
                                                             : 0.);
          friction += errors.of_faces.back();
          pressure += face.condition->has_pressure() ? pressure_square(field, face, exact) : 0.;
        }
      });
  const MPI_Comm all = field.communicator();
  const DifferenceSquares sums = total(own, all);
  errors.energy = std::sqrt(sums.energy);
  errors.l2 = std::sqrt(sums.l2);
  errors.energy_norm = std::sqrt(sums.norm);
  errors.reference_energy = Utilities::MPI::sum(potential, all);
  friction = Utilities::MPI::sum(friction, all);
  pressure = Utilities::MPI::sum(pressure, all);
  if (Utilities::MPI::max(has_multipliers ? 1 : 0, all) == 0)
    return;
  if (scene.has_friction())
    errors.multiplier_l2 = std::sqrt(friction);
  if (scene.has_pressure())
    errors.pressure_l2 = std::sqrt(pressure);
  errors.transition =
      Utilities::MPI::all_gather(all, transition_error(transitions(contact), exact)).front();
}

template class TrueError<2>;
template class TrueError<3>;
} // namespace hpvi
