// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/evaluation/true_error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A part of the reference cell with sides along its axes. */
template <int dim>
struct Box
{
  Point<dim> origin;
  std::array<double, dim> sides = ones();

  Box child(const unsigned int c) const
  {
    Box result(*this);
    for (unsigned int d = 0; d < dim; ++d)
      result = result.half(d, (c >> d) & 1);
    return result;
  }

  Box half(const unsigned int d, const bool is_upper) const
  {
    Box result(*this);
    result.sides[d] /= 2;
    if (is_upper)
      result.origin[d] += result.sides[d];
    return result;
  }

  Point<dim> point(const Point<dim> &reference) const
  {
    Point<dim> x(origin);
    for (unsigned int d = 0; d < dim; ++d)
      x[d] += sides[d] * reference[d];
    return x;
  }

  double volume() const
  {
    return std::accumulate(sides.begin(), sides.end(), 1., std::multiplies<>());
  }

private:
  static std::array<double, dim> ones()
  {
    std::array<double, dim> result;
    result.fill(1.);
    return result;
  }
};

/** Displacement and gradient at one point. */
template <int dim>
struct Values
{
  Tensor<1, dim> u;
  Tensor<2, dim> gradient; ///< d u_i / d x_j

  Values operator-(const Values &other) const
  {
    return {u - other.u, gradient - other.gradient};
  }
};

/** Sums of squares: of the difference of two fields, and of the one to relate it to. */
struct Squares
{
  double energy = 0, l2 = 0, norm = 0;

  Squares &operator+=(const Squares &other)
  {
    energy += other.energy;
    l2 += other.l2;
    norm += other.norm;
    return *this;
  }
};

/** A polynomial on one cell of a mesh. */
template <int dim>
struct LocalField
{
  unsigned int degree;
  const std::vector<double> &coefficients;
  CellMap<dim> map;

  /** Values at Gauss points of a part of the cell. */
  std::vector<Values<dim>> at(const Box<dim> &box, const Quadrature<dim> &gauss) const
  {
    std::vector<Point<dim>> points;
    for (const Point<dim> &q : gauss.get_points())
      points.push_back(box.point(q));
    const ShapeTable<dim> table = tabulate<dim>(degree, points, gauss.get_weights(), false);
    const std::vector<double> u = evaluate(table.values, coefficients);
    const std::vector<double> derivatives = evaluate(table.derivatives, coefficients);
    std::vector<Values<dim>> result(points.size());
    for (unsigned int q = 0; q < points.size(); ++q)
    {
      const Tensor<2, dim> inverse = invert(map.jacobian(points[q]));
      for (unsigned int c = 0; c < dim; ++c)
      {
        result[q].u[c] = u[c * points.size() + q];
        for (unsigned int r = 0; r < dim; ++r)
          for (unsigned int j = 0; j < dim; ++j)
            result[q].gradient[c][j] +=
                derivatives[c * points.size() * dim + q * dim + r] * inverse[r][j];
      }
    }
    return result;
  }
};

template <int dim>
void add_squares(const HookesLaw<dim> &law, const Values<dim> &field, const Values<dim> &truth,
                 const double weight, Squares &sums)
{
  const Values<dim> difference = truth - field;
  sums.energy += weight * law.energy_product(difference.gradient);
  sums.l2 += weight * difference.u.norm_square();
  sums.norm += weight * law.energy_product(truth.gradient);
}

/** Walks through two meshes that descend from one coarse mesh. */
template <int dim>
class CommonRefinement
{
public:
  using Cell = typename Triangulation<dim>::cell_iterator;

  CommonRefinement(const Scene<dim> &scene, const StoredSolution<dim> &solution,
                   const StoredSolution<dim> &reference)
      : scene(scene), solution(solution), reference(reference)
  {
  }

  Squares integrate()
  {
    auto other = reference.triangulation().begin(0);
    for (auto cell = solution.triangulation().begin(0); cell != solution.triangulation().end(0);
         ++cell, ++other)
      descend(cell, {}, other, {});
    return sums;
  }

private:
  void descend(const Cell &a, const Box<dim> &in_a, const Cell &b, const Box<dim> &in_b)
  {
    if (!a->has_children() && !b->has_children())
      integrate_over_leaf(a, in_a, b, in_b);
    else
      for (unsigned int c = 0; c < GeometryInfo<dim>::max_children_per_cell; ++c)
        descend(a->has_children() ? a->child(c) : a, a->has_children() ? in_a : in_a.child(c),
                b->has_children() ? b->child(c) : b, b->has_children() ? in_b : in_b.child(c));
  }

  void integrate_over_leaf(const Cell &a, const Box<dim> &in_a, const Cell &b, const Box<dim> &in_b)
  {
    const unsigned int i = a->active_cell_index(), j = b->active_cell_index();
    const LocalField<dim> field{solution.degree(i), solution.coefficients(i), map_of<dim>(a)};
    const LocalField<dim> truth{reference.degree(j), reference.coefficients(j), map_of<dim>(b)};
    // One point more than affine cells need, for those that are not.
    const QGauss<dim> gauss(std::max(field.degree, truth.degree) + 2);
    const auto field_values = field.at(in_a, gauss), truth_values = truth.at(in_b, gauss);
    const double share = in_a.volume();
    const HookesLaw<dim> law(scene.material_of(a));
    for (unsigned int q = 0; q < gauss.size(); ++q)
      add_squares(law, field_values[q], truth_values[q],
                  gauss.weight(q) * share *
                      std::abs(determinant(field.map.jacobian(in_a.point(gauss.point(q))))),
                  sums);
  }

  const Scene<dim> &scene;
  const StoredSolution<dim> &solution, &reference;
  Squares sums;
};

/** Lengths of the sides of @p box in space, measured in its middle. */
template <int dim>
std::array<double, dim> lengths(const CellMap<dim> &map, const Box<dim> &box,
                                const Point<dim> &middle)
{
  const auto jacobian = map.jacobian(middle);
  std::array<double, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
  {
    double square = 0;
    for (unsigned int c = 0; c < dim; ++c)
      square += jacobian[c][d] * jacobian[c][d];
    result[d] = box.sides[d] * std::sqrt(square);
  }
  return result;
}

/**
 * Parts of a cell, small near singular points: no part is much larger than its distance. Sides below
 * a quarter of the longest are not cut: of a cell of 1:1000 that would make a thousand parts a level.
 */
template <int dim>
void add_graded_boxes(const CellMap<dim> &map, const Box<dim> &box,
                      const std::vector<Point<dim>> &singularities, const unsigned int levels_left,
                      std::vector<Box<dim>> &boxes)
{
  Point<dim> centre;
  for (unsigned int d = 0; d < dim; ++d)
    centre[d] = 0.5;
  const Point<dim> middle = box.point(centre), in_space = map.point(middle);
  const std::array<double, dim> sides = lengths(map, box, middle);
  const double diameter =
      std::sqrt(std::inner_product(sides.begin(), sides.end(), sides.begin(), 0.));
  const bool near =
      std::any_of(singularities.begin(), singularities.end(),
                  [&](const Point<dim> &x) { return x.distance(in_space) < 1.2 * diameter; });
  if (!near || levels_left == 0)
  {
    boxes.push_back(box);
    return;
  }
  std::vector<Box<dim>> parts{box};
  for (unsigned int d = 0; d < dim; ++d)
    if (sides[d] > *std::max_element(sides.begin(), sides.end()) / 4)
    {
      const std::vector<Box<dim>> lower = std::exchange(parts, {});
      for (const bool is_upper : {false, true})
        for (const Box<dim> &part : lower)
          parts.push_back(part.half(d, is_upper));
    }
  for (const Box<dim> &part : parts)
    add_graded_boxes(map, part, singularities, levels_left - 1, boxes);
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
TrueErrors TrueError<dim>::measure(const Solution<dim> &solution,
                                   const std::vector<ContactState<dim>> &contact) const
{
  TrueErrors errors;
  if (scene.exact_solution)
    compare_with_exact(solution, contact, errors);
  else if (reference)
    compare_with_reference(solution, errors);
  return errors;
}

template <int dim>
void TrueError<dim>::compare_with_reference(const Solution<dim> &solution, TrueErrors &errors) const
{
  const StoredSolution<dim> field(solution);
  const Squares sums = CommonRefinement<dim>(scene, field, *reference).integrate();
  errors.energy = std::sqrt(sums.energy);
  errors.l2 = std::sqrt(sums.l2);
  errors.energy_norm = std::sqrt(sums.norm);
  errors.reference_energy = reference->energy();
}

namespace
{
/** int f(s, x) over the straight edge from @p a to @p b, graded towards singular points of @p exact. */
template <int dim, class F>
double integrate_along(const Point<dim> &a, const Point<dim> &b, const ExactSolution<dim> &exact,
                       const unsigned int n_gauss, const F &f)
{
  const double length = a.distance(b);
  const CellMap<1>::Vertices ends{{Point<1>(0.), Point<1>(length)}};
  std::vector<Point<1>> singular;
  for (const Point<dim> &x : exact.singularities())
    singular.emplace_back((x - a) * (b - a) / length);
  std::vector<Box<1>> boxes;
  add_graded_boxes<1>(CellMap<1>(ends), {}, singular, 40, boxes);
  const QGauss<1> gauss(n_gauss);
  double sum = 0;
  for (const Box<1> &box : boxes)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double s = box.point(gauss.point(q))[0];
      sum += gauss.weight(q) * box.volume() * length * f(s, a + s * (b - a));
    }
  return sum;
}

/** |lambda - z_N/g|^2 over one contact face. */
template <int dim>
double multiplier_square(const Solution<dim> &solution, const ContactFace<dim> &face,
                         const ExactSolution<dim> &exact)
{
  return integrate_along(face.point(0.), face.point(1.), exact, face.degree + 8,
                         [&](const double s, const Point<dim> &x)
                         {
                           const double g = solution.contact_space.bound(face, solution.z, s);
                           const double difference =
                               exact.multiplier(x) -
                               (g == 0. ? 0.
                                        : solution.contact_space.value(face, solution.z, s) / g);
                           return difference * difference;
                         });
}

/** |p - lambda_Nn|^2 over one contact face. */
template <int dim>
double pressure_square(const Solution<dim> &solution, const ContactFace<dim> &face,
                       const ExactSolution<dim> &exact)
{
  return integrate_along(face.point(0.), face.point(1.), exact, face.degree + 8,
                         [&](const double s, const Point<dim> &x)
                         {
                           const double difference =
                               exact.pressure(x) -
                               solution.contact_space.pressure(face, solution.z, s);
                           return difference * difference;
                         });
}

/** -L(u) + int g |u_t| of the exact solution on one edge of the boundary. */
template <int dim>
double boundary_potential(const BoundaryCondition<dim> &boundary, const Point<dim> &a,
                          const Point<dim> &b, const Tensor<1, dim> &normal,
                          const ExactSolution<dim> &exact)
{
  if (!boundary.has_traction() && !boundary.friction.bound)
    return 0.;
  return integrate_along(a, b, exact, 12,
                         [&](double, const Point<dim> &x)
                         {
                           const Tensor<1, dim> u = exact.displacement(x);
                           double density = 0;
                           for (unsigned int c = 0; c < dim; ++c)
                             if (boundary.traction[c])
                               density -= boundary.traction[c]->value(x) * u[c];
                           if (boundary.friction.bound)
                             density += boundary.friction.bound->value(x) *
                                        (u - (u * normal) * normal).norm();
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
} // namespace

template <int dim>
void TrueError<dim>::compare_with_exact(const Solution<dim> &solution,
                                        const std::vector<ContactState<dim>> &contact,
                                        TrueErrors &errors) const
{
  const ExactSolution<dim> &exact = *scene.exact_solution;
  const StoredSolution<dim> stored(solution);
  Squares sums;
  errors.of_cells.resize(stored.triangulation().n_active_cells());
  for (const auto &cell : stored.triangulation().active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    const unsigned int index = cell->active_cell_index();
    const LocalField<dim> field{stored.degree(index), stored.coefficients(index),
                                map_of<dim>(cell)};
    // Boxes shrink to about 1e-8 of the body: what a stress like r^{-1/2} leaves out there is far
    // below round-off of the sum.
    const unsigned int levels = std::max(1, 27 - cell->level());
    std::vector<Box<dim>> boxes;
    add_graded_boxes<dim>(field.map, {}, exact.singularities(), levels, boxes);
    const QGauss<dim> gauss(field.degree + 5);
    const HookesLaw<dim> law(scene.material_of(cell));
    Squares own;
    for (const Box<dim> &box : boxes)
    {
      const auto field_values = field.at(box, gauss);
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const Point<dim> reference_point = box.point(gauss.point(q));
        const Point<dim> x = field.map.point(reference_point);
        add_squares(law, field_values[q], {exact.displacement(x), exact.gradient(x)},
                    gauss.weight(q) * box.volume() *
                        std::abs(determinant(field.map.jacobian(reference_point))),
                    own);
      }
    }
    errors.of_cells[index] = own.energy;
    sums += own;
  }
  errors.energy = std::sqrt(sums.energy);
  errors.l2 = std::sqrt(sums.l2);
  errors.energy_norm = std::sqrt(sums.norm);
  errors.reference_energy = 0.5 * sums.norm;
  for (const auto &cell : stored.triangulation().active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->is_locally_owned() && cell->at_boundary(f))
        errors.reference_energy += boundary_potential(
            scene.boundaries[cell->face(f)->boundary_id()], cell->face(f)->vertex(0),
            cell->face(f)->vertex(1),
            map_of<dim>(cell).normal(f, point_on_face<dim>(f, Point<dim - 1>(0.5))), exact);
  if (solution.contact_space.n_multipliers() == 0)
    return;
  double friction = 0, pressure = 0;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
  {
    errors.of_faces.push_back(scene.has_friction() ? multiplier_square(solution, face, exact) : 0.);
    friction += errors.of_faces.back();
    pressure += face.condition->has_pressure() ? pressure_square(solution, face, exact) : 0.;
  }
  if (scene.has_friction())
    errors.multiplier_l2 = std::sqrt(friction);
  if (scene.has_pressure())
    errors.pressure_l2 = std::sqrt(pressure);
  errors.transition = transition_error(transitions(contact), exact);
}

template class TrueError<2>;
} // namespace hpvi
