// SPDX-License-Identifier: LGPL-2.1-or-later
// Theorem 4.5, cell by cell: the residual indicator beside the true error, as a table. ./run efficiency.
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/reader/scene_reader.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace
{
using namespace hpvi;

/** The cells that share an edge with one, and itself: K_patch. */
std::vector<unsigned int> patch(const dealii::DoFHandler<2>::active_cell_iterator &cell)
{
  std::vector<unsigned int> result = {cell->active_cell_index()};
  for (const unsigned int f : cell->face_indices())
    if (!cell->at_boundary(f) && cell->face(f)->has_children())
      for (unsigned int part = 0; part < 2; ++part)
        result.push_back(cell->neighbor_child_on_subface(f, part)->active_cell_index());
    else if (!cell->at_boundary(f))
      result.push_back(cell->neighbor(f)->active_cell_index());
  return result;
}

/**
 * A row for each cell: eta_K/c^{1/2}, the error in energy on K and on K_patch, and the multiplier's term
 * `(h_K/(c p_K))^{1/2} |z_N - g lambda|` over the edges of K on Gamma_C, NaN where there are none.
 */
void print(const StepReport<2> &step, const std::string &run)
{
  const Solution<2> &solution = step.solution();
  std::vector<double> multiplier(step.errors.of_cells.size(), TrueErrors::unknown);
  const auto &faces = solution.contact_space.faces();
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    const double g = faces[k].friction_bound(faces[k].point(0.5));
    multiplier[faces[k].cell->active_cell_index()] = g * g * step.errors.of_faces[k];
  }
  const double scale = step.scaled_estimate / step.estimate.total();
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
  {
    const unsigned int index = cell->active_cell_index();
    const unsigned int p = solution.displacement_space.degrees()[index];
    const double h = map_of<2>(cell).longest_edge();
    double near = 0;
    for (const unsigned int other : patch(cell))
      near += step.errors.of_cells[other];
    std::printf("%s,%u,%u,%u,%u,%.6e,%.6e,%.6e,%.6e,%.6e\n", run.c_str(), step.number,
                solution.displacement_space.n_free_dofs(), index, p, h,
                scale * step.estimate.indicator(index), std::sqrt(step.errors.of_cells[index]),
                std::sqrt(near), scale * std::sqrt(h / p * multiplier[index]));
  }
}
} // namespace

int main(const int argc, char **argv)
try
{
  const std::string scene_file = argc > 1 ? argv[1] : "prm/stick-slip.prm";
  std::printf("run,step,dofs_free,cell,degree,size,indicator,error,patch_error,multiplier_error\n");
  using Overrides = std::vector<std::pair<std::string, std::string>>;
  for (const auto &[run, overrides] : std::vector<std::pair<std::string, Overrides>>{
           {"hpa3", {{"Adaptivity/Method", "hpa3"}, {"Adaptivity/Maximum steps", "14"}}},
           {"hap4", {{"Adaptivity/Method", "hap4"}, {"Adaptivity/Maximum steps", "8"}}},
           {"hup2", {{"Adaptivity/Method", "hup2"}, {"Adaptivity/Maximum steps", "5"}}},
           {"pu", {{"Adaptivity/Method", "pu"}, {"Adaptivity/Maximum steps", "9"}}}})
  {
    const Scene<2> scene = read_scene<2>(scene_file, overrides);
    AdaptiveSolver<2>(scene).run([&, name = run](const StepReport<2> &step) { print(step, name); });
  }
  return 0;
}
catch (const std::exception &error)
{
  std::fprintf(stderr, "efficiency: %s\n", error.what());
  return 1;
}
