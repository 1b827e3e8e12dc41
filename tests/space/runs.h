// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_space_runs_h
#define hpvi_space_runs_h

#include <gtest/gtest.h>
#include <hpvi/primal/primal_solver.h>
#include <hpvi/scene/scene_reader.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace space
{
using namespace dealii;
using namespace hpvi;

using Overrides = std::vector<std::pair<std::string, std::string>>;

/** prm/slab.prm, solved until Newton's method stands still. */
inline Scene<3> slab(const Overrides &overrides = {})
{
  Scene<3> scene = read_scene<3>("prm/slab.prm", overrides);
  scene.solver.primal_tolerance = 1e-11;
  return scene;
}

/** What is left of a step when it is over. */
struct Step
{
  std::size_t n_cells, n_free;
  unsigned int n_slipping, n_contact_points;
  double lagrangian, energy, estimate, norm;
  unsigned int n_pressing = 0;
};

template <int dim>
using Look = std::function<void(const PrimalReport<dim> &)>;

/** All steps of a run on the processes of @p communicator; @p look sees the reports. */
template <int dim>
std::vector<Step> steps_of(
    const Scene<dim> &scene, const Look<dim> &look = [](const PrimalReport<dim> &) {},
    MPI_Comm communicator = MPI_COMM_SELF)
{
  std::vector<Step> steps;
  PrimalSolver<dim>(scene, communicator)
      .run(
          [&](const PrimalReport<dim> &step)
          {
            steps.push_back({step.n_cells, step.space.n_free, step.newton.n_slipping,
                             static_cast<unsigned int>(step.contact.size()),
                             step.energies.lagrangian, step.energies.energy, step.total_estimate,
                             step.energies.norm, step.newton.n_pressing});
            look(step);
          });
  return steps;
}

/** A displacement and its gradient, (i,j) is d_j u_i. */
template <int dim>
struct Field
{
  std::function<Tensor<1, dim>(const Point<dim> &)> value;
  std::function<Tensor<2, dim>(const Point<dim> &)> gradient;
};

/** The energy norm of u_N minus @p exact, on one process. */
template <int dim>
double energy_error(const PrimalReport<dim> &step, const Field<dim> &exact)
{
  double sum = 0;
  const BoxTable<dim> &table = step.space.tables.cell;
  for (const auto &cell : step.space.dof_handler.active_cell_iterators())
  {
    const auto size = MomentSpace<dim>::extent(cell);
    const CellField<dim> field = step.space.field(cell, step.u);
    for (unsigned int q = 0; q < table.points.size(); ++q)
    {
      Point<dim> x = cell->vertex(0);
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += table.points[q][d] * size[d];
      sum += table.weights[q] * cell->measure() *
             HookesLaw<dim>(step.space.scene.materials[0])
                 .energy_product(gradient(table, q, field, size) - exact.gradient(x));
    }
  }
  return std::sqrt(sum);
}

/** Prescribes @p exact on a boundary. */
template <int dim>
void prescribe(BoundaryCondition<dim> &boundary, const Field<dim> &exact)
{
  for (unsigned int c = 0; c < dim; ++c)
    boundary.displacement[c] = expression<dim>(std::function<double(const Point<dim> &)>(
        [exact, c](const Point<dim> &x) { return exact.value(x)[c]; }));
}
} // namespace space

#endif
