// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/stored_solution.h>

#include <fstream>
#include <map>

namespace hpvi
{
using namespace dealii;

template <int dim>
StoredSolution<dim>::StoredSolution(const Solution<dim> &solution, const ShapeTables<dim> &tables,
                                    const double energy)
    : mesh(&solution.displacement_space.triangulation()), energy_value(energy),
      degrees(solution.displacement_space.degrees())
{
  for (unsigned int cell = 0; cell < degrees.size(); ++cell)
    cell_coefficients.push_back(solution.coefficients(cell, tables.numbering(degrees[cell])));
}

namespace
{
[[noreturn]] void does_not_fit(const std::string &file, const std::string &what)
{
  throw InputError(file + ": " + what +
                   "; make the reference solution anew from a scene with the same coarse mesh");
}

/**
 * A cell by its coarse cell and the children on the way to it. (deal.II's CellId holds 30 levels,
 * and meshes that close in on a transition go deeper.)
 */
template <int dim>
std::string path(typename Triangulation<dim>::cell_iterator cell)
{
  std::string children;
  for (; cell->level() > 0; cell = cell->parent())
    for (unsigned int c = 0; c < GeometryInfo<dim>::max_children_per_cell; ++c)
      if (cell->parent()->child(c) == cell)
        children.insert(children.begin(), '0' + c);
  return std::to_string(cell->index()) + ':' + children;
}

struct CellRecord
{
  unsigned int degree;
  std::vector<double> coefficients;
};

std::map<std::string, CellRecord> read_records(const std::string &file, const int dim,
                                               double &energy)
{
  std::ifstream in(file);
  if (!in)
    does_not_fit(file, "the reference solution cannot be read");
  if (!(in >> energy))
    does_not_fit(file, "not a reference solution");
  std::map<std::string, CellRecord> records;
  std::string cell;
  while (in >> cell)
  {
    CellRecord record;
    if (!(in >> record.degree) || record.degree == 0 || record.degree > 100)
      does_not_fit(file, "not a reference solution");
    record.coefficients.resize(dim * Utilities::fixed_power<2>(record.degree + 1));
    for (double &value : record.coefficients)
      if (!(in >> value))
        does_not_fit(file, "the reference solution is incomplete");
    records.emplace(cell, std::move(record));
  }
  return records;
}
} // namespace

template <int dim>
StoredSolution<dim>::StoredSolution(const Scene<dim> &scene, const std::string &file)
    : mesh(&own_mesh)
{
  static_assert(dim == 2, "the number of coefficients of a cell");
  const std::map<std::string, CellRecord> records = read_records(file, dim, energy_value);
  make_mesh(scene, own_mesh);
  // Bisect every cell that is not in the file until all active cells are.
  for (bool complete = false; !complete;)
  {
    complete = true;
    for (const auto &cell : own_mesh.active_cell_iterators())
      if (records.count(path<dim>(cell)) == 0)
      {
        if (own_mesh.n_active_cells() > records.size())
          does_not_fit(file, "the reference solution has another coarse mesh");
        cell->set_refine_flag();
        complete = false;
      }
    own_mesh.execute_coarsening_and_refinement();
  }
  if (own_mesh.n_active_cells() != records.size())
    does_not_fit(file, "the reference solution has another coarse mesh");
  for (const auto &cell : own_mesh.active_cell_iterators())
  {
    const CellRecord &record = records.at(path<dim>(cell));
    degrees.push_back(record.degree);
    cell_coefficients.push_back(record.coefficients);
  }
}

template <int dim>
void StoredSolution<dim>::write(std::ostream &out) const
{
  out.precision(17);
  out << energy_value << '\n';
  for (const auto &cell : mesh->active_cell_iterators())
  {
    out << path<dim>(cell) << ' ' << degrees[cell->active_cell_index()];
    for (const double value : cell_coefficients[cell->active_cell_index()])
      out << ' ' << value;
    out << '\n';
  }
}

template <int dim>
double StoredSolution<dim>::energy() const
{
  return energy_value;
}

template <int dim>
const Triangulation<dim> &StoredSolution<dim>::triangulation() const
{
  return *mesh;
}

template <int dim>
unsigned int StoredSolution<dim>::degree(const unsigned int cell) const
{
  return degrees[cell];
}

template <int dim>
const std::vector<double> &StoredSolution<dim>::coefficients(const unsigned int cell) const
{
  return cell_coefficients[cell];
}

template class StoredSolution<2>;
} // namespace hpvi
