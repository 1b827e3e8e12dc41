// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/dual_scene.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr int exponent = 6; ///< smooth enough for rules of quadrature, narrow enough
/** More of R outside of a mesh whose edges are not quite the curves would be seen by the missing mass, 1e-9 of all. */
constexpr double inside_of_mesh = 0.97;

/** Without loads, and without what V does not know. */
void forget_data(BoundaryCondition<2> &boundary)
{
  for (auto &component : boundary.displacement)
    if (component)
      component = expression<2>(0.);
  boundary.traction = {};
  boundary.gap = nullptr;
  boundary.friction = {};
  if (boundary.plate)
  {
    for (auto &displacement : boundary.plate->displacement)
      if (displacement)
        displacement = 0.;
    boundary.plate->force = {};
  }
  if (boundary.contact == Contact::bilateral && !boundary.pair)
    boundary.symmetry = true;
  if (!boundary.pair)
    boundary.contact = Contact::none;
}

/** Pairs that hold nothing together in V are none. */
void forget_pairs(Scene<2> &scene)
{
  std::vector<ContactPair> kept;
  for (unsigned int k = 0; k < scene.pairs.size(); ++k)
  {
    const bool holds = scene.boundaries[scene.pairs[k].parts[0]].contact == Contact::bilateral ||
                       scene.boundaries[scene.pairs[k].parts[0]].is_tied();
    for (BoundaryCondition<2> &boundary : scene.boundaries)
      if (boundary.pair && *boundary.pair == k)
      {
        if (holds)
          boundary.pair = kept.size();
        else
        {
          boundary.pair.reset();
          boundary.contact = Contact::none;
        }
      }
    if (holds)
      kept.push_back(scene.pairs[k]);
  }
  scene.pairs = kept;
}

/** Of a side of straight pieces; of a body of revolution what it turns into. */
double size_of(const Side<2> &side, const Scene<2> &scene)
{
  double result = 0;
  for (const auto &piece : side.pieces)
    result += piece[0].distance(piece[1]) * scene.circumference((piece[0] + piece[1]) / 2.);
  return result;
}

/** The mean of a component along a boundary: on a plate that of its middle, where it is prescribed nothing that V knows. */
void load_boundary(Scene<2> &dual, const Probe<2> &probe, const unsigned int component,
                   const std::map<types::boundary_id, double> &meshed)
{
  const std::vector<Side<2>> sides = sides_of(dual);
  std::map<types::boundary_id, double> sizes = meshed;
  double size = 0;
  for (const types::boundary_id id : probe.on)
    size += sizes.try_emplace(id, size_of(sides[id], dual)).first->second;
  for (const types::boundary_id id : probe.on)
  {
    if (sides[id].pieces.empty()) // parts have it all
      continue;
    BoundaryCondition<2> &boundary = dual.boundaries[id];
    const Tensor<1, 2> n = common_normal(sides[id]);
    for (unsigned int d = 0; d < 2; ++d) // a load may stand beside u_d = 0, and not beside u_n = 0
      if (boundary.symmetry && std::abs(n[d]) > 1 - 1e-12)
      {
        boundary.symmetry = false;
        boundary.displacement[d] = expression<2>(0.);
      }
    if (boundary.plate)
      boundary.plate->force[component] = boundary.plate->is_free(component) ? sizes[id] / size : 0.;
    else if (!boundary.displacement[component])
      boundary.traction[component] = expression<2>(1 / size);
  }
}
} // namespace

Scene<2> dual_scene(const Scene<2> &scene, const Probe<2> &probe, const unsigned int component,
                    const std::map<types::boundary_id, double> &meshed)
{
  Scene<2> result = scene;
  result.exact_solution.reset();
  result.reference_solution.clear();
  result.initial_strains.clear();
  for (Pretension<2> &cut : result.pretensions)
  {
    cut.force = 0;
    cut.is_fixed = true;
  }
  result.body_force = {};
  result.body_force_of_material.clear();
  result.probes.clear();
  result.loading = {};
  result.parameters.reset();
  result.file.clear();
  for (BoundaryCondition<2> &boundary : result.boundaries)
    forget_data(boundary);
  forget_pairs(result);
  if (probe.kind == ProbeKind::boundary)
    load_boundary(result, probe, component, meshed);
  else
    result.body_force[component] = expression<2>(std::function<double(const Point<2> &)>(
        [mean = smooth_mean(scene, probe), at = probe.at](const Point<2> &x)
        { return mean.density(x.distance(at)); }));
  result.thickness = 1;
  result.adaptivity = Adaptivity();
  result.adaptivity.tolerance = 0.15; // |z|_a to 1 %, and z_N near it
  if (scene.geometry.has_curves())    // on each mesh of u_N
    result.adaptivity.maximum_steps = 1;
  else
    result.adaptivity.maximum_unknowns = 20000;
  result.error_bound = true;
  result.error_bound_last = false;
  result.intervals = false;
  result.solver = SolverSettings();
  return result;
}

double SmoothMean::density(const double s) const
{
  const double rest = 1 - s * s / (radius * radius);
  return rest > 0 ? (exponent + 1) / (numbers::PI * radius * radius) *
                        Utilities::fixed_power<exponent>(rest)
                  : 0.;
}

namespace
{
/** The largest of `|tau|^2` over |g|^2 for the stresses of SmoothMean, half of it where the angle does not matter. */
double largest_compliance(const Scene<2> &scene)
{
  double result = 0;
  for (const Material &material : scene.materials)
  {
    const HookesLaw<2> law(material);
    SymmetricTensor<2, 2> along, across;
    along[0][0] = 1;
    along[1][1] = -1;
    across[0][1] = 1;
    const double sum =
        law.complementary_product(along, along) + law.complementary_product(across, across);
    result = std::max(result, material.orthotropy ? sum : sum / 2);
  }
  return result;
}
} // namespace

// The parts of either density within s are f = min(1, s^2/r^2) and 1 - (1 - s^2/R^2)^(k+1), so that g = (their difference)/(2 pi s).
SmoothMean smooth_mean(const Scene<2> &scene, const Probe<2> &probe)
{
  double room = 2 * probe.size;
  for (const Side<2> &side : sides_of(scene))
    for (unsigned int piece = 0; piece < side.pieces.size(); ++piece)
      room = std::min(room, side.distance(piece, probe.at));
  if (scene.geometry.has_curves())
    room *= inside_of_mesh;
  SmoothMean result{std::max(room, probe.size), 0.};
  const QGauss<1> gauss(16);
  double square = 0;
  for (const auto &[begin, end] : {std::pair<double, double>(0., probe.size),
                                   std::pair<double, double>(probe.size, result.radius)})
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double s = begin + (end - begin) * gauss.point(q)[0],
                   inside = std::min(1., std::pow(s / probe.size, 2)),
                   smooth =
                       1 - std::pow(std::max(0., 1 - std::pow(s / result.radius, 2)), exponent + 1);
      square += gauss.weight(q) * (end - begin) * std::pow(inside - smooth, 2) / s;
    }
  result.remainder = std::sqrt(largest_compliance(scene) * square / (2 * numbers::PI));
  return result;
}
} // namespace hpvi
