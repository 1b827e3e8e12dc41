// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_verification_discretisation_h
#define hpvi_verification_discretisation_h

#include "../overrides.h"

#include <gtest/gtest.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/plane/internal_forces.h>
#include <hpvi/reader/scene_reader.h>
#include <hpvi/results/solution_field.h>
#include <hpvi/results/stored_solution.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace verification
{
using namespace dealii;
using namespace hpvi;

using ::in_digits;
using ::Overrides;

/** One of the scenes that come with the program. */
inline Scene<2> shipped_scene(const std::string &name, const Overrides &overrides = {})
{
  return read_scene<2>("prm/" + name + ".prm", overrides);
}

/** A scene that consists of @p entries alone. */
inline Scene<2> scene_of(const Overrides &entries)
{
  const auto file = std::filesystem::path(::testing::TempDir()) /
                    ("hpvi-" + std::to_string(std::random_device()()) + ".prm");
  std::ofstream(file) << "set Dimension = 2\n";
  Scene<2> scene = read_scene<2>(file.string(), entries);
  std::filesystem::remove(file);
  return scene;
}

/** All steps of a run. */
template <int dim>
void each_step(const Scene<dim> &scene, const std::function<void(const StepReport<dim> &)> &heard)
{
  AdaptiveSolver<dim>(scene).run(heard);
}

/** The step by which a limit ends a run. */
template <int dim>
void last_step(const Scene<dim> &scene, const std::function<void(const StepReport<dim> &)> &heard)
{
  each_step<dim>(scene,
                 [&](const StepReport<dim> &step)
                 {
                   if (!step.stopped_by.empty())
                     heard(step);
                 });
}

/**
 * The energy of a finer run, of @p steps with hpa3, lies in the interval of each step of @p methods; the bound is above the error, by at
 * most @p nearness times, or, for 0, nobody asks; @p heard gets the step and this error.
 */
inline void
expect_bounds(const std::function<Scene<2>(const std::string &method, unsigned int steps)> &scene,
              const unsigned int steps, const std::vector<std::string> &methods,
              const double nearness,
              const std::function<void(const StepReport<2> &, double error)> &heard)
{
  double J = 0, doubt = 0;
  each_step<2>(scene("hpa3", steps),
               [&](const StepReport<2> &step)
               {
                 ASSERT_TRUE(step.bound) << step.no_bound;
                 J = step.energies.energy;
                 doubt = step.bound->energy_below + step.bound->energy_above;
               });
  for (const std::string &method : methods)
    each_step<2>(scene(method, 3),
                 [&](const StepReport<2> &step)
                 {
                   SCOPED_TRACE(method);
                   ASSERT_TRUE(step.bound) << step.no_bound;
                   EXPECT_LE(step.energies.energy - step.bound->energy_below, J + doubt);
                   EXPECT_GE(step.energies.energy + step.bound->energy_above, J - doubt);
                   if (nearness == 0)
                     return;
                   const double error = std::sqrt(2 * std::max(0., step.energies.energy - J));
                   EXPECT_GE(step.bound->total, 0.999 * error);
                   EXPECT_LE(step.bound->total, nearness * error + std::sqrt(2 * doubt));
                   heard(step, error);
                 });
}

/** Why @p scene has no solution; empty: it has one. */
inline std::string failure_of(const Scene<2> &scene)
{
  return ::failure_of<NumericalFailure>(
      [&]
      {
        each_step<2>(scene,
                     [](const StepReport<2> &step)
                     {
                       EXPECT_TRUE(std::isfinite(step.energies.energy));
                       EXPECT_TRUE(std::isfinite(step.solution().u.l2_norm()));
                     });
      });
}
using ::failure_of;

/** Bisect a third of the cells, some levels deep; deal.II keeps the mesh 1-irregular. */
inline void refine_at_random(Triangulation<2> &mesh, const unsigned int levels,
                             std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform;
  for (unsigned int level = 0; level < levels; ++level)
  {
    for (const auto &cell : mesh.active_cell_iterators())
      if (uniform(random) < 1. / 3.)
        cell->set_refine_flag();
    mesh.execute_coarsening_and_refinement();
  }
}

inline Degrees random_degrees(const Triangulation<2> &mesh, const unsigned int lowest,
                              const unsigned int highest, std::mt19937 &random)
{
  std::uniform_int_distribution<unsigned int> degree(lowest, highest);
  Degrees degrees(mesh.n_active_cells());
  for (unsigned int &p : degrees)
    p = degree(random);
  return degrees;
}

/** The mesh of a scene, with its materials in turn, refined at random, with random degrees. */
struct RandomMesh
{
  Triangulation<2> mesh;
  Degrees degrees;

  RandomMesh(const Scene<2> &scene, const unsigned int seed, const unsigned int levels,
             const unsigned int lowest = 2, const unsigned int highest = 8)
  {
    std::mt19937 random(seed);
    make_mesh(scene, mesh);
    for (const auto &cell : mesh.active_cell_iterators())
      cell->set_material_id(cell->active_cell_index() % scene.materials.size());
    refine_at_random(mesh, levels, random);
    degrees = random_degrees(mesh, lowest, highest, random);
    set_edge_degrees(mesh, degrees);
  }
};

/** The stages of one step on a given mesh, each open to questions. */
class Laboratory
{
public:
  const Scene<2> &scene;
  CondensedElements<2> elements;
  const Discretisation<2> discretisation;
  const std::shared_ptr<const Spaces<2>> spaces;
  const ShapeTables<2> &tables;
  const DisplacementSpace<2> &displacement_space;
  const ContactSpace<2> &contact_space;
  const ContactOperator<2> &contact_operator;
  const ElasticSystem<2> &system;

  Laboratory(const Scene<2> &scene, const Triangulation<2> &mesh, const Degrees &degrees,
             const std::shared_ptr<const ShapeTables<2>> &shared =
                 std::make_shared<const ShapeTables<2>>(),
             const PastSlip<2> &past = {})
      : scene(scene), elements(scene, *shared),
        discretisation(scene,
                       std::make_shared<const Spaces<2>>(scene, borrowed(mesh), degrees, shared,
                                                         nullptr, past),
                       elements),
        spaces(discretisation.spaces), tables(*spaces->tables),
        displacement_space(spaces->displacement_space), contact_space(spaces->contact_space),
        contact_operator(spaces->contact_operator), system(discretisation.system)
  {
  }

  Laboratory(const Scene<2> &scene, const RandomMesh &mesh)
      : Laboratory(scene, mesh.mesh, mesh.degrees)
  {
  }

  SchurComplement reduce() const
  {
    if (!solver)
      solver = std::make_unique<const LinearSolver>(discretisation.factor());
    return SchurComplement(*solver, system.f, discretisation.contact_rows);
  }

  QuadraticProgram quadratic_program(const SchurComplement &schur_complement) const
  {
    return {schur_complement.S(), schur_complement.d(), contact_space.feasible_set()};
  }

  /** By the scene's solver and tolerance, from zero. */
  Solution<2> solve() const
  {
    const SchurComplement schur_complement = reduce();
    ReducedSolution reduced;
    reduced.z.reinit(contact_space.n_multipliers());
    Vector<double> u = IterativeRefinement<2>(discretisation, elements, *solver, schur_complement)
                           .solve(reduced, algebraic);
    return {scene, spaces, std::move(u), std::move(reduced.z)};
  }

  /** Random displacement that meets all constraints, with any multiplier between -1 and 1. */
  Solution<2> random_field(std::mt19937 &random) const
  {
    std::uniform_real_distribution<double> uniform(-1., 1.);
    Vector<double> u(displacement_space.n_dofs()), z(contact_space.n_multipliers());
    for (double &value : u)
      value = uniform(random);
    for (double &value : z)
      value = uniform(random);
    displacement_space.constraints().distribute(u);
    return {scene, spaces, std::move(u), std::move(z)};
  }

  mutable AlgebraicError algebraic; ///< of the last solve(); corrections would hide a wrong system

private:
  mutable std::unique_ptr<const LinearSolver> solver;
};

/** The one edge at the bottom of a unit square of one cell, and what of friction it misses under a pressure. */
struct PressedEdge
{
  explicit PressedEdge(const Scene<2> &scene, const unsigned int p = 3)
      : mesh(scene, 1, 0, p, p), lab(scene, mesh), z(lab.contact_space.n_multipliers())
  {
  }

  /** Multipliers of this pressure and no friction. */
  const Vector<double> &under(const double pressure)
  {
    for (const unsigned int k : lab.contact_space.faces().at(0).pressures)
      z[k] = pressure;
    return z;
  }

  auto bounds(const double pressure)
  {
    return space.unresolved_bounds(under(pressure));
  }

  const RandomMesh mesh;
  const Laboratory lab;
  const ContactSpace<2> &space = lab.contact_space;
  Vector<double> z;
};

/** A reference solution in a file of its own for the time of a test. */
class ReferenceFile
{
public:
  explicit ReferenceFile(const Scene<2> &scene)
      : path((std::filesystem::path(::testing::TempDir()) /
              ("hpvi-" + std::to_string(std::random_device()()) + ".dat"))
                 .string())
  {
    const ShapeTables<2> tables;
    last_step<2>(scene,
                 [&](const StepReport<2> &step)
                 {
                   std::ofstream file(path);
                   write_solution(file, step.field, step.energies.energy);
                 });
  }
  ~ReferenceFile()
  {
    std::filesystem::remove(path);
  }

  const std::string path;
};

} // namespace verification

#endif
