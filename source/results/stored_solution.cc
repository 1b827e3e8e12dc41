// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/processes.h>
#include <hpvi/plane/curved_edges.h>
#include <hpvi/reader/scene_reader.h>
#include <hpvi/results/stored_solution.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
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
  return section == "Material" || section.rfind("Material ", 0) == 0 || section == "Body force" ||
         section == "Exact solution" || section.rfind("Boundary ", 0) == 0 ||
         section.rfind("Contact ", 0) == 0 ||
         ((section == "Geometry" || section.rfind("Body ", 0) == 0) && entry != "Graded towards" &&
          entry != "Grading levels");
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
    record.coefficients.resize(dim * std::lround(std::pow(record.degree + 1, dim)));
    for (double &value : record.coefficients)
      if (!(in >> value))
        format.reject(file, "the reference solution is incomplete");
    records.emplace(cell, std::move(record));
  }
  return records;
}
} // namespace

template <int dim>
StoredSolution<dim>::StoredSolution(const Scene<dim> &scene, const std::string &file)
{
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file))
    format.reject(file, "the reference solution cannot be read");
  std::istringstream content(format.read(in, file));
  const std::vector<std::string> problem = read_problem(content, file, energy_value);
  format.check_entries(file, problem, entries_of(effective_parameters(scene), belongs_to_problem));
  const std::map<std::string, CellRecord> records = read_records(content, file, dim);
  make_mesh(scene, mesh);
  // Bisect every cell that is not in the file until all active cells are.
  for (bool complete = false; !complete;)
  {
    complete = true;
    for (const auto &cell : mesh.active_cell_iterators())
      if (records.count(path<dim>(cell)) == 0)
      {
        if (mesh.n_active_cells() > records.size())
          format.reject(file, "the reference solution has another coarse mesh");
        cell->set_refine_flag();
        complete = false;
      }
    mesh.execute_coarsening_and_refinement();
  }
  if (mesh.n_active_cells() != records.size())
    format.reject(file, "the reference solution has another coarse mesh");
  for (const auto &cell : mesh.active_cell_iterators())
  {
    const CellRecord &record = records.at(path<dim>(cell));
    degrees.push_back(record.degree);
    cell_coefficients.push_back(record.coefficients);
  }
  if constexpr (dim == 2)
    set_edge_degrees(mesh, degrees);
}

template <int dim>
void write_solution(std::ostream &out, const Field<dim> &field, const double energy)
{
  std::ostringstream content;
  content.precision(17);
  if (rank_of(field.communicator()) == 0)
  {
    for (const std::string &entry :
         entries_of(effective_parameters(field.scene), belongs_to_problem))
      content << entry << '\n';
    content << "J(u) = " << energy << '\n';
  }
  for (const auto &cell : field.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    content << path<dim>(cell) << ' ' << field.degree(cell);
    for (const double value : field.coefficients(cell))
      content << ' ' << value;
    content << '\n';
  }
  std::string text;
  for (const std::string &part : Utilities::MPI::all_gather(field.communicator(), content.str()))
    text += part;
  if (rank_of(field.communicator()) == 0)
    format.write(out, text);
}

template <int dim>
double StoredSolution<dim>::energy() const
{
  return energy_value;
}

template <int dim>
const Triangulation<dim> &StoredSolution<dim>::triangulation() const
{
  return mesh;
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
template class StoredSolution<3>;
template void write_solution(std::ostream &, const Field<2> &, double);
template void write_solution(std::ostream &, const Field<3> &, double);
} // namespace hpvi
