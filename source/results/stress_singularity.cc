// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/grid/grid_tools.h>
#include <hpvi/results/contact_traces.h>
#include <hpvi/results/stress_singularity.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double growth = 1.15; ///< no less is taken for one without bound
constexpr unsigned int n_rings = 4;

/** Of @p largest stresses in rings, each twice as wide as the one inside of it, the innermost first. */
bool grows_inwards(const std::vector<double> &largest)
{
  for (unsigned int k = 1; k < largest.size(); ++k)
    if (!(largest[k] > 0 && largest[k - 1] > growth * largest[k]))
      return false;
  return largest[0] / largest[1] > 0.9 * largest[n_rings - 2] / largest[n_rings - 1];
}

/** The one of @p extrema, of the step before, that @p peak has grown from by more than 15 %; else null. */
template <int dim>
const StressSample<dim> *grown_from(const std::vector<StressSample<dim>> &extrema,
                                    const StressSample<dim> &peak)
{
  for (const StressSample<dim> &before : extrema) // the largest first
    if (before.boundary == peak.boundary && before.where.distance(peak.where) <= 2 * before.length)
      return peak.value > growth * before.value ? &before : nullptr;
  return nullptr;
}

/** Singularities stand at corners, ends and transitions, which meshes close in on with their vertices. */
template <int dim>
Point<dim> next_vertex(const StressSample<dim> &peak, const Field<dim> &field)
{
  const Triangulation<dim> &mesh = field.dof_handler.get_triangulation();
  const Point<dim> own = mesh.get_vertices()[GridTools::find_closest_vertex(mesh, peak.where)];
  const std::vector<Point<dim>> all = Utilities::MPI::all_gather(field.communicator(), own);
  return *std::min_element(all.begin(), all.end(),
                           [&](const Point<dim> &a, const Point<dim> &b)
                           { return a.distance(peak.where) < b.distance(peak.where); });
}

/** Of the pressures on the edges within reach of the last cells. */
template <int dim>
double force_within(const StressSample<dim> &peak, const double radius, const Field<dim> &field)
{
  const auto is_within = [&](const FieldFace<dim> &face)
  {
    for (const unsigned int v : face.cell->face(face.face_no)->vertex_indices())
      if (face.cell->face(face.face_no)->vertex(v).distance(peak.where) > (1 + 1e-6) * radius)
        return false;
    return true;
  };
  double force = 0;
  for (const FieldFace<dim> &face : field.faces())
    if (face.condition->id == peak.boundary && is_within(face))
      for (const PressurePoint<dim> &point : pressure_points(face, field))
        force += point.weight * point.pressure;
  return Utilities::MPI::sum(force, field.communicator());
}
} // namespace

template <int dim>
std::vector<StressSample<dim>>
growing_extrema(const std::vector<std::vector<StressSample<dim>>> &steps)
{
  const unsigned int n_steps = 3;
  std::vector<StressSample<dim>> result;
  if (steps.size() <= n_steps)
    return result;
  for (const StressSample<dim> &peak : steps.back())
  {
    const StressSample<dim> *earlier = &peak;
    for (unsigned int k = 1; k <= n_steps && earlier; ++k)
      earlier = grown_from(steps[steps.size() - 1 - k], *earlier);
    if (earlier)
      result.push_back(peak);
  }
  return result;
}

// A field like r^-a beside a vertex has the same growth from ring to ring around it on one mesh as from mesh to mesh beside the
// vertex. One that is bounded grows less from ring to ring the nearer they are, as soon as cells are smaller than what rounds it.
template <int dim>
std::vector<StressSample<dim>> extrema_of_rings(const std::vector<StressSample<dim>> &extrema,
                                                const std::vector<StressSample<dim>> &samples,
                                                const Field<dim> &field)
{
  std::vector<StressSample<dim>> result;
  for (const StressSample<dim> &peak : extrema)
  {
    const Point<dim> centre = next_vertex(peak, field);
    std::vector<double> own(n_rings), largest(n_rings);
    for (const StressSample<dim> &sample : samples)
      if (sample.boundary == peak.boundary)
        if (const double ring = std::max(
                0., 1 + std::floor(std::log2(centre.distance(sample.where) / peak.length)));
            ring < n_rings)
          own[ring] = std::max(own[ring], sample.value);
    Utilities::MPI::max(own, field.communicator(), largest);
    if (largest[0] <= peak.value && grows_inwards(largest))
      result.push_back(peak);
  }
  return result;
}

template <int dim>
std::vector<StressSingularity<dim>>
stress_singularities(const std::vector<StressSample<dim>> &extrema,
                     const std::vector<StressSample<dim>> &samples, const Field<dim> &field)
{
  std::vector<StressSingularity<dim>> result;
  for (const StressSample<dim> &peak : extrema)
  {
    const auto is_near = [&](const StressSample<dim> &sample)
    {
      return std::any_of(extrema.begin(), extrema.end(),
                         [&](const StressSample<dim> &other)
                         {
                           return other.boundary == sample.boundary &&
                                  other.where.distance(sample.where) <= reach(other, field.scene);
                         });
    };
    StressSingularity<dim> unbounded{
        peak, next_vertex(peak, field), 2 * peak.length, 0., reach(peak, field.scene), 0., {}};
    unbounded.force = force_within(peak, unbounded.within, field);
    for (const StressSample<dim> &sample : samples)
      if (sample.boundary == peak.boundary && sample.value > unbounded.largest && !is_near(sample))
      {
        unbounded.largest = sample.value;
        unbounded.largest_point = sample.where;
      }
    for (const auto &[value, x] : Utilities::MPI::all_gather(
             field.communicator(), std::make_pair(unbounded.largest, unbounded.largest_point)))
      if (value > unbounded.largest)
      {
        unbounded.largest = value;
        unbounded.largest_point = x;
      }
    result.push_back(unbounded);
  }
  return result;
}

template std::vector<StressSample<2>>
growing_extrema(const std::vector<std::vector<StressSample<2>>> &);
template std::vector<StressSample<2>> extrema_of_rings(const std::vector<StressSample<2>> &,
                                                       const std::vector<StressSample<2>> &,
                                                       const Field<2> &);
template std::vector<StressSample<3>> extrema_of_rings(const std::vector<StressSample<3>> &,
                                                       const std::vector<StressSample<3>> &,
                                                       const Field<3> &);
template std::vector<StressSingularity<2>>
stress_singularities(const std::vector<StressSample<2>> &, const std::vector<StressSample<2>> &,
                     const Field<2> &);
template std::vector<StressSample<3>>
growing_extrema(const std::vector<std::vector<StressSample<3>>> &);
template std::vector<StressSingularity<3>>
stress_singularities(const std::vector<StressSample<3>> &, const std::vector<StressSample<3>> &,
                     const Field<3> &);
} // namespace hpvi
