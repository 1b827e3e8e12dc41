// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/mesh.h>
#include <hpvi/space/degree_tables.h>

#include <deal.II/hp/fe_collection.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

template <int dim>
DegreeTables<dim>::DegreeTables(const unsigned int degree)
{
  all.emplace_back(degree);
}

template <int dim>
DegreeTables<dim>::DegreeTables(const Scene<dim> &scene) : geometry(&scene.geometry)
{
  for (unsigned int body = 0; body == 0 || body < geometry->bodies.size(); ++body)
  {
    const unsigned int degree = scene.start_degree_of(body);
    const auto known =
        std::find_if(all.begin(), all.end(),
                     [degree](const BoxTables<dim> &tables) { return tables.degree == degree; });
    of_body.push_back(known - all.begin());
    if (known == all.end())
      all.emplace_back(degree);
  }
}

template <int dim>
unsigned int DegreeTables<dim>::number_of(const Cell &cell) const
{
  return all.size() == 1 ? 0 : of_body[body_of<dim>(*geometry, cell)];
}

template <int dim>
const BoxTables<dim> &DegreeTables<dim>::only() const
{
  AssertThrow(all.size() == 1, ExcMessage("Bodies have different degrees."));
  return all.front();
}

// Bodies share no node: of different elements nothing meets, so that nothing has to be matched.
template <int dim>
void DegreeTables<dim>::distribute_dofs(DoFHandler<dim> &dof_handler) const
{
  if (all.size() == 1)
    return dof_handler.distribute_dofs(all.front().fe);
  hp::FECollection<dim> elements;
  for (const BoxTables<dim> &tables : all)
    elements.push_back(tables.fe);
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      cell->set_active_fe_index(number_of(cell));
  dof_handler.distribute_dofs(elements);
}

template class DegreeTables<2>;
template class DegreeTables<3>;
} // namespace hpvi
