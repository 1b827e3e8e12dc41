// SPDX-License-Identifier: LGPL-2.1-or-later
// One solver type for the plane and for space: what users of the library ask of it, by either backend.
#include "runs.h"

#include <sstream>

namespace
{
using namespace space;

/** Displacements and stresses of a body that is strained evenly, asked for at points. */
template <int dim>
void expect_even_strain(const SolutionPath path)
{
  Tensor<2, dim> gradient;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      gradient[i][j] = 1e-3 * (1. + i - 2. * j);
  Scene<dim> scene;
  scene.adaptivity.method = Method::hup2;
  scene.adaptivity.start_degree = 2;
  scene.adaptivity.maximum_steps = 2;
  scene.solver.path = path;
  scene.solver.primal_tolerance = 1e-12;
  scene.geometry.subdivisions.fill(2); // a cell for each process
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int side = 0; side < 2 * dim; ++side)
      scene.boundaries[side].displacement[c] =
          expression<dim>(std::function<double(const Point<dim> &)>(
              [gradient, c](const Point<dim> &x) { return gradient[c] * x; }));
  const auto sigma = HookesLaw<dim>(scene.materials[0]).stress(gradient);
  Point<dim> x, outside;
  for (unsigned int d = 0; d < dim; ++d)
  {
    x[d] = 0.3 + 0.2 * d;
    outside[d] = 2;
  }
  unsigned int n = 0;
  AdaptiveSolver<dim>(scene, MPI_COMM_WORLD)
      .run(
          [&](const StepReport<dim> &step)
          {
            const auto at = step.field.at(x);
            ASSERT_TRUE(at);
            EXPECT_LT((at->displacement - gradient * x).norm(), 1e-14);
            EXPECT_LT((at->stress - sigma).norm(), 1e-12);
            EXPECT_FALSE(step.field.at(outside));
            ++n;
          });
  EXPECT_GE(n, 1u);
}

TEST(Ranks, LibraryAsksForDisplacementAndStressAtAPoint)
{
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    expect_even_strain<2>(SolutionPath::reduced);
  expect_even_strain<2>(SolutionPath::primal);
  expect_even_strain<3>(SolutionPath::primal);
}

/** A run that is broken off, written, read and continued: as many processes as one likes. */
template <int dim>
void expect_to_go_on(const Scene<dim> &scene)
{
  std::vector<double> whole, parts;
  Scene<dim> half = scene;
  half.adaptivity.maximum_steps = 2;
  std::string written;
  AdaptiveSolver<dim>(scene, MPI_COMM_WORLD)
      .run([&](const StepReport<dim> &step) { whole.push_back(step.energies.energy); });
  AdaptiveSolver<dim> first(half, MPI_COMM_WORLD);
  first.run(
      [&](const StepReport<dim> &step)
      {
        parts.push_back(step.energies.energy);
        if (step.stopped_by.empty())
          return;
        std::ostringstream out;
        first.state().write(out);
        written = out.str();
      });
  std::istringstream in(written);
  AdaptiveSolver<dim>(scene, RunState<dim>::read(in, "state.dat"), MPI_COMM_WORLD)
      .run(
          [&](const StepReport<dim> &step)
          {
            EXPECT_EQ(step.number, parts.size() + 1);
            parts.push_back(step.energies.energy);
          });
  ASSERT_EQ(whole.size(), 4u);
  ASSERT_EQ(parts.size(), whole.size());
  for (unsigned int k = 0; k < whole.size(); ++k)
    EXPECT_NEAR(parts[k], whole[k], 1e-10 * std::abs(whole[k]));
}

TEST(Ranks, LibraryGoesOnFromARunState)
{
  expect_to_go_on(slab({{"Geometry/Subdivisions", "2, 1, 2"}, given::steps("hap2", "4")}));
  Scene<2> scene = read_scene<2>("prm/han-6-12.prm",
                                 Overrides{given::steps("hap3", "4"), {"Solver/Path", "primal"}});
  scene.solver.primal_tolerance = 1e-11;
  expect_to_go_on(scene);
}
} // namespace
