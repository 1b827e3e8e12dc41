// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_space_runs_h
#define hpvi_space_runs_h

#include "../overrides.h"

#include <gtest/gtest.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/reader/scene_reader.h>

#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace space
{
using namespace dealii;
using namespace hpvi;

using ::Overrides;

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

/** A material of @p section whose axis 1 is twenty times as stiff as the others, by Axes. */
inline Overrides fibres(const std::string &axes, const std::string &section = "Material")
{
  return {{section + "/Elasticity", "orthotropic"},
          {section + "/Young's modulus", ""},
          {section + "/Poisson's ratio", ""},
          {section + "/Young's moduli", "2000, 100, 150"},
          {section + "/Poisson's ratios", "0.3, 0.2, 0.25"},
          {section + "/Shear moduli", "30, 40, 50"},
          {section + "/Axes", axes}};
}

template <int dim>
using Look = std::function<void(const StepReport<dim> &)>;

/** Of all contact boundaries, on the first process. */
template <int dim>
unsigned int n_points(const std::vector<ContactState<dim>> &contact)
{
  unsigned int n = 0;
  for (const ContactState<dim> &state : contact)
    n += state.points.size();
  return n;
}

/** All steps of a run on the processes of @p communicator; @p look sees the reports. */
template <int dim>
std::vector<Step> steps_of(
    const Scene<dim> &scene, const Look<dim> &look = [](const StepReport<dim> &) {},
    MPI_Comm communicator = MPI_COMM_SELF)
{
  std::vector<Step> steps;
  Scene<dim> by_primal_path = scene;
  by_primal_path.solver.path = SolutionPath::primal;
  if (scene.error_bound_last) // by default: tests of the bound ask for it in each step
    by_primal_path.error_bound = false;
  AdaptiveSolver<dim>(by_primal_path, communicator)
      .run(
          [&](const StepReport<dim> &step)
          {
            steps.push_back({step.size.n_cells, step.primal->space.n_free,
                             step.primal->newton.n_slipping, n_points(step.contact),
                             step.energies.lagrangian, step.energies.energy, step.norms.total,
                             step.energies.norm, step.primal->newton.n_pressing});
            look(step);
          });
  return steps;
}

/**
 * y and z of @p upright changed about: the foundation, which has @p contact there, lies in front, or, mirrored, behind.
 */
inline void expect_turned(const Scene<3> &upright, const Overrides &contact, const double tolerance)
{
  const auto known = steps_of<3>(upright);
  for (const auto &[side, depth, sign] :
       {std::make_tuple("front", "z", "-"), std::make_tuple("back", "(4 - z)", "")})
  {
    const std::string section = std::string("Boundary ") + side + "/";
    Overrides entries{
        given::box("4, 2, 4", "4, 2, 4"),
        {"Boundary left/Traction", std::string("1.5*(5 - ") + depth + "); 0.5; " + sign + "0.75"},
        {"Boundary bottom/Contact", "none"},
        {"Boundary bottom/Friction bound", ""},
        {section + "Contact", "unilateral"},
        {"Adaptivity/Maximum steps", "2"}};
    for (const auto &[entry, value] : contact)
      entries.emplace_back(section + entry, value);
    const auto turned = steps_of<3>(slab(entries));
    ASSERT_EQ(turned.size(), known.size());
    for (unsigned int k = 0; k < known.size(); ++k)
    {
      EXPECT_EQ(known[k].n_free, turned[k].n_free);
      EXPECT_EQ(known[k].n_slipping, turned[k].n_slipping);
      EXPECT_EQ(known[k].n_pressing, turned[k].n_pressing);
      EXPECT_NEAR(known[k].lagrangian, turned[k].lagrangian,
                  tolerance * std::abs(turned[k].lagrangian));
    }
  }
}

/** A displacement and its gradient, (i,j) is d_j u_i. */
template <int dim>
struct KnownField
{
  std::function<Tensor<1, dim>(const Point<dim> &)> value;
  std::function<Tensor<2, dim>(const Point<dim> &)> gradient;
};

/** The energy norm of u_N minus @p exact, on one process. */
template <int dim>
double energy_error(const StepReport<dim> &step, const KnownField<dim> &exact)
{
  double sum = 0;
  const BoxTable<dim> &table = step.primal->space.tables.only().cell;
  for (const auto &cell : step.primal->space.dof_handler.active_cell_iterators())
  {
    const auto size = PrimalSpace<dim>::extent(cell);
    const CellField<dim> field = step.primal->space.field(cell, step.primal->u);
    for (unsigned int q = 0; q < table.points.size(); ++q)
    {
      Point<dim> x = cell->vertex(0);
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += table.points[q][d] * size[d];
      sum += table.weights[q] * cell->measure() *
             HookesLaw<dim>(step.primal->space.scene.materials[0])
                 .energy_product(gradient(table, q, field, size) - exact.gradient(x));
    }
  }
  return std::sqrt(sum);
}

/** Prescribes @p exact on a boundary. */
template <int dim>
void prescribe(BoundaryCondition<dim> &boundary, const KnownField<dim> &exact)
{
  for (unsigned int c = 0; c < dim; ++c)
    boundary.displacement[c] = expression<dim>(std::function<double(const Point<dim> &)>(
        [exact, c](const Point<dim> &x) { return exact.value(x)[c]; }));
}
} // namespace space

#endif
