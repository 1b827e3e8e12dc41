// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/data_scale.h>

#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Raises @p magnitude to what @p function has at @p points, but for what its check refuses. */
template <int dim>
void raise(double &magnitude, const Expression<dim> &function,
           const std::vector<Point<dim>> &points, const std::function<double(double)> &size)
{
  if (function)
    for (const Point<dim> &point : points)
      if (const double value = size(function->value(point)); value <= largest_magnitude)
        magnitude = std::max(magnitude, value);
}

/** Wherever its material may be. */
template <int dim>
double largest_initial_stress(const Scene<dim> &scene)
{
  double largest = 0;
  for (unsigned int m = 0; m < scene.materials.size(); ++m)
    for (const Point<dim> &x : sample_body(scene.geometry))
      largest = std::max(largest,
                         scene.materials[m].residual_weight() * scene.initial_strain(m, x).norm());
  return largest <= largest_magnitude ? largest : 0.;
}

/** Forces and moments as stresses on a body of @p size, rotations as displacements there. */
template <int dim>
void raise_by(const RigidPlate<dim> &plate, const double size, DataScale &scale)
{
  for (unsigned int m = 0; m < plate.n_motions; ++m)
  {
    const double lever = m < dim ? 1. : size;
    scale.displacement =
        std::max(scale.displacement, lever * std::abs(plate.displacement[m].value_or(0.)));
    scale.stress =
        std::max(scale.stress, std::abs(plate.force[m]) / (lever * std::pow(size, dim - 1)));
  }
}

/** @p function, but 0 where that is round-off. */
template <int dim>
void drop(const double round_off, Expression<dim> &function)
{
  if (function)
    function = expression<dim>(
        [function = function, round_off](const Point<dim> &x)
        {
          const double value = function->value(x);
          return std::abs(value) < round_off ? 0. : value;
        });
}
/** The same of a plate, with round-off of stresses and displacements. */
template <int dim>
void drop_round_off(const double stress, const double displacement, const double size,
                    RigidPlate<dim> &plate)
{
  for (unsigned int m = 0; m < plate.n_motions; ++m)
  {
    const double lever = m < dim ? 1. : size;
    if (plate.displacement[m] && std::abs(*plate.displacement[m]) * lever < displacement)
      plate.displacement[m] = 0.;
    if (std::abs(plate.force[m]) < stress * lever * std::pow(size, dim - 1))
      plate.force[m] = 0.;
  }
}
} // namespace

template <int dim>
DataScale data_scale(const Scene<dim> &scene)
{
  const double size = scene.geometry.diameter();
  const auto absolute = [](const double value) { return std::abs(value); };
  DataScale scale = scene.past_data;
  double force = 0;
  for (const Load<dim> &load : scene.body_forces())
    for (const Expression<dim> &component : load)
      raise<dim>(force, component, sample_body(scene.geometry), absolute);
  scale.stress = std::max(scale.stress, force * size);
  if (scene.has_initial_strain())
    scale.stress = std::max(scale.stress, largest_initial_stress(scene));
  if constexpr (dim == 2)
    for (const Pretension<2> &cut : scene.pretensions)
      scale.stress =
          std::max(scale.stress, cut.force / (scene.thickness * section_of_cut(scene, cut)));
  const std::vector<Side<dim>> sides = sides_of(scene);
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
  {
    const std::vector<Point<dim>> points = sides[boundary.id].sample();
    for (unsigned int c = 0; c < dim; ++c)
    {
      raise<dim>(scale.stress, boundary.traction[c], points, absolute);
      raise<dim>(scale.displacement, boundary.displacement[c], points, absolute);
    }
    raise<dim>(scale.displacement, boundary.gap, points, [](const double gap) { return -gap; });
    if (boundary.plate)
      raise_by(*boundary.plate, size, scale);
  }
  double softest = scene.largest_weight();
  for (const Material &material : scene.materials)
    softest = std::min(softest, material.residual_weight());
  const double strain = scale.stress / scene.largest_weight();
  scale.stress = std::max(scale.stress, softest * scale.displacement / size);
  scale.displacement = std::max(scale.displacement, strain * size);
  return scale;
}

template <int dim>
double support_tolerance(const Scene<dim> &scene)
{
  return 1e-10 * data_scale(scene).displacement;
}

template <int dim>
Scene<dim> load_step(const Scene<dim> &scene, const unsigned int number, const DataScale &past)
{
  Scene<dim> result = scene.loading.at(scene.loading.time(number));
  result.past_data = past;
  result.solver.path = scene.solver.path; // settled for the whole history
  // A tenth of what counts as round-off of a solution: nothing that is seen is lost.
  const auto round_off = [](const double largest)
  { return std::max(0.1 * round_off_of_data * largest, smallest_magnitude); };
  const DataScale scale = data_scale(result);
  const auto drop_force = [&](Load<dim> &load)
  {
    for (Expression<dim> &component : load)
      drop(round_off(scale.stress / scene.geometry.diameter()), component);
  };
  drop_force(result.body_force);
  std::for_each(result.body_force_of_material.begin(), result.body_force_of_material.end(),
                drop_force);
  for (InitialStrain<dim> &initial : result.initial_strains)
  {
    const double strain = round_off(scale.stress) / scene.largest_weight();
    for (Expression<dim> &component : initial.components)
      drop(strain, component);
    drop(strain / std::max(std::abs(initial.expansion), smallest_magnitude), initial.temperature);
  }
  for (BoundaryCondition<dim> &boundary : result.boundaries)
  {
    for (unsigned int c = 0; c < dim; ++c)
    {
      drop(round_off(scale.stress), boundary.traction[c]);
      drop(round_off(scale.displacement), boundary.displacement[c]);
    }
    drop(round_off(scale.displacement), boundary.gap);
    if (boundary.plate)
      drop_round_off(round_off(scale.stress), round_off(scale.displacement),
                     scene.geometry.diameter(), *boundary.plate);
  }
  return result;
}

template DataScale data_scale(const Scene<2> &);
template DataScale data_scale(const Scene<3> &);
template double support_tolerance(const Scene<2> &);
template double support_tolerance(const Scene<3> &);
template Scene<2> load_step(const Scene<2> &, unsigned int, const DataScale &);
template Scene<3> load_step(const Scene<3> &, unsigned int, const DataScale &);
} // namespace hpvi
