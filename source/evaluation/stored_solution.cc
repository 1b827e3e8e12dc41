// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/evaluation/stored_solution.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
const FileFormat
    format("reference solution", 1,
           "make the reference solution anew from a scene of the same problem with the "
           "same coarse mesh");

/** What of a scene decides about its solution; the coarse mesh's grading has a check of its own. */
bool belongs_to_problem(const std::string &section, const std::string &entry)
{
  return section == "Material" || section == "Body force" || section == "Exact solution" ||
         section.rfind("Boundary ", 0) == 0 ||
         (section == "Geometry" && entry != "Graded towards" && entry != "Grading levels");
}

std::string content_of(const std::string &file)
{
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file))
    format.reject(file, "the reference solution cannot be read");
  return format.read(in, file);
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

/** The entries of the problem and J(u), which ends them. */
std::vector<std::string> read_problem(std::istream &in, const std::string &file, double &energy)
{
  const std::string last = "J(u) = ";
  std::vector<std::string> problem;
  std::string line;
  while (std::getline(in, line) && line.rfind(last, 0) != 0)
    problem.push_back(line);
  if (!in || !(std::istringstream(line.substr(last.size())) >> energy))
    format.reject(file, "not a reference solution");
  return problem;
}

std::map<std::string, CellRecord> read_records(std::istream &in, const std::string &file,
                                               const int dim)
{
  std::map<std::string, CellRecord> records;
  std::string cell;
  while (in >> cell)
  {
    CellRecord record;
    if (!(in >> record.degree) || record.degree == 0 || record.degree > 100)
      format.reject(file, "not a reference solution");
    record.coefficients.resize(dim * Utilities::fixed_power<2>(record.degree + 1));
    for (double &value : record.coefficients)
      if (!(in >> value))
        format.reject(file, "the reference solution is incomplete");
    records.emplace(cell, std::move(record));
  }
  return records;
}
} // namespace

template <int dim>
StoredSolution<dim>::StoredSolution(const Solution<dim> &solution, const double energy)
    : mesh(&solution.displacement_space.triangulation()),
      problem(entries_of(solution.scene.effective_parameters(), belongs_to_problem)),
      energy_value(energy), degrees(solution.displacement_space.degrees())
{
  for (unsigned int cell = 0; cell < degrees.size(); ++cell)
    cell_coefficients.push_back(solution.coefficients(cell));
}

template <int dim>
StoredSolution<dim>::StoredSolution(const Scene<dim> &scene, const std::string &file)
    : mesh(&own_mesh)
{
  static_assert(dim == 2, "the number of coefficients of a cell");
  std::istringstream content(content_of(file));
  problem = read_problem(content, file, energy_value);
  format.check_entries(file, problem, entries_of(scene.effective_parameters(), belongs_to_problem));
  const std::map<std::string, CellRecord> records = read_records(content, file, dim);
  make_mesh(scene, own_mesh);
  // Bisect every cell that is not in the file until all active cells are.
  for (bool complete = false; !complete;)
  {
    complete = true;
    for (const auto &cell : own_mesh.active_cell_iterators())
      if (records.count(path<dim>(cell)) == 0)
      {
        if (own_mesh.n_active_cells() > records.size())
          format.reject(file, "the reference solution has another coarse mesh");
        cell->set_refine_flag();
        complete = false;
      }
    own_mesh.execute_coarsening_and_refinement();
  }
  if (own_mesh.n_active_cells() != records.size())
    format.reject(file, "the reference solution has another coarse mesh");
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
  std::ostringstream content;
  content.precision(17);
  for (const std::string &entry : problem)
    content << entry << '\n';
  content << "J(u) = " << energy_value << '\n';
  for (const auto &cell : mesh->active_cell_iterators())
  {
    content << path<dim>(cell) << ' ' << degrees[cell->active_cell_index()];
    for (const double value : cell_coefficients[cell->active_cell_index()])
      content << ' ' << value;
    content << '\n';
  }
  format.write(out, content.str());
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
