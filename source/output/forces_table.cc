// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/forces_table.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The centre of its interval, where there is one, and half the width of that. */
void add(Record &record, const std::string &name, const Measured &number)
{
  record.emplace_back(name, number.best());
  record.emplace_back(name + "_bound",
                      number.interval ? Value(number.interval->half_width) : Value());
}

constexpr const char *kinds[] = {"support", "contact", "load", "pretension"}; // of ForceKind

/** On the coarse mesh, so that a refined one does not shift the mean. */
template <int dim>
std::vector<Point<dim>> coarse_points(const Triangulation<dim> &mesh, const types::boundary_id id)
{
  std::vector<Point<dim>> points;
  for (const auto &cell : mesh.cell_iterators_on_level(0))
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary() && face->boundary_id() == id)
        for (const unsigned int v : face->vertex_indices())
          points.push_back(face->vertex(v));
  return points;
}
} // namespace

template <int dim>
std::vector<Record> forces_rows(const StepReport<dim> &step)
{
  const bool is_history = step.load.number > 0;
  std::vector<Record> rows;
  for (const Resultant<dim> &force : step.forces)
  {
    Record row{{"step", step.number},
               {"load_step", is_history ? Value(step.load.number) : Value()},
               {"t", is_history ? Value(step.load.t) : Value()},
               {"name", force.name},
               {"kind", kinds[static_cast<unsigned int>(force.kind)]}};
    for (unsigned int d = 0; d < dim; ++d)
      add(row, std::string("F") + "xyz"[d], force.force[d]);
    for (unsigned int d = 0; d < force.n_moments; ++d)
      add(row, dim == 2 ? "M" : std::string("M") + "xyz"[d], force.moment[d]);
    add(row, "normal", force.normal);
    add(row, "friction", force.friction);
    rows.push_back(row);
  }
  return rows;
}

template <int dim>
Record prescribed_displacements(const StepReport<dim> &step)
{
  Record record;
  for (const BoundaryCondition<dim> &boundary : step.scene.boundaries)
    for (unsigned int d = 0; d < dim; ++d)
    {
      if (!boundary.displacement[d])
        continue;
      double sum = 0;
      const std::vector<double> values =
          values_at<dim>(coarse_points(step.field.dof_handler.get_triangulation(), boundary.id),
                         boundary.displacement[d]);
      for (const double value : values)
        sum += value / values.size();
      record.emplace_back("displacement_" + boundary.name + "_" + "xyz"[d],
                          values.empty() ? Value() : Value(sum));
    }
  return record;
}

template Record prescribed_displacements(const StepReport<2> &);
template Record prescribed_displacements(const StepReport<3> &);
template std::vector<Record> forces_rows(const StepReport<2> &);
template std::vector<Record> forces_rows(const StepReport<3> &);
} // namespace hpvi
