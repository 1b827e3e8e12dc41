// SPDX-License-Identifier: LGPL-2.1-or-later

// The space $V_N$ of (3.57): on each cell tensor products of polynomials of the cell's own degree,
// continuous across edges, and subject to the supports. It is made in two halves. The numbering
// gives every cell its nodes, and neighbours share those that coincide; the constraints say of all
// nodes that are not free how they follow from others.
#include <hpvi/plane/displacement_space.h>
#include <hpvi/plane/edge_constraints.h>
#include <hpvi/plane/plates.h>

namespace hpvi
{
using namespace dealii;

// @sect3{All constraints in one place}
//
// deal.II's <code>AffineConstraints</code> holds them: $u_i = \sum_j c_{ij} u_j + h_i$. Hanging
// nodes come first and supports second, in chains where both meet: <code>close()</code> resolves
// them, so that every constraint ends in free unknowns. A space that could exist without its
// constraints would be used without them one day; so both are made in the constructor.
namespace
{
template <int dim>
AffineConstraints<double> constraints_of(const Scene<dim> &scene,
                                         const DofNumbering<dim> &numbering,
                                         const ShapeTables<dim> &tables)
{
  AffineConstraints<double> constraints;
  constrain_hanging_nodes(numbering, tables, constraints);
  const std::vector<SupportedNode<dim>> nodes = supported_nodes(scene, numbering, tables);
  for (const Plate &plate : plates_of(scene, nodes))
    plate.constrain(constraints);
  constrain_supports(nodes, constraints);
  constraints.close();
  return constraints;
}
} // namespace

template <int dim>
DisplacementSpace<dim>::DisplacementSpace(const Scene<dim> &scene,
                                          const Triangulation<dim> &triangulation,
                                          const Degrees &degrees, const ShapeTables<dim> &tables,
                                          const LoadRules<dim> *const rules)
    : dof_numbering(triangulation, degrees, tables),
      affine_constraints(constraints_of(scene, dof_numbering, tables)), load_rules(rules)
{
}

// @sect3{What is asked of it}
//
// <code>n_free_dofs()</code> is the $N$ of all rates and charts, as in the thesis: displacements
// after all constraints, without multipliers.
template <int dim>
const DofNumbering<dim> &DisplacementSpace<dim>::numbering() const
{
  return dof_numbering;
}

template <int dim>
const Triangulation<dim> &DisplacementSpace<dim>::triangulation() const
{
  return dof_handler().get_triangulation();
}

template <int dim>
const DoFHandler<dim> &DisplacementSpace<dim>::dof_handler() const
{
  return dof_numbering.dof_handler();
}

template <int dim>
const AffineConstraints<double> &DisplacementSpace<dim>::constraints() const
{
  return affine_constraints;
}

template <int dim>
const Degrees &DisplacementSpace<dim>::degrees() const
{
  return dof_numbering.degrees();
}

template <int dim>
unsigned int DisplacementSpace<dim>::n_dofs() const
{
  return dof_handler().n_dofs();
}

template <int dim>
unsigned int DisplacementSpace<dim>::n_free_dofs() const
{
  return n_dofs() - affine_constraints.n_constraints();
}

template <int dim>
ArrayView<const types::global_dof_index>
DisplacementSpace<dim>::cell_dofs(const unsigned int cell) const
{
  return dof_numbering.cell_dofs(cell);
}

template <int dim>
const LoadRules<dim> &DisplacementSpace<dim>::rules() const
{
  Assert(load_rules, ExcMessage("This space knows no rules for data."));
  return *load_rules;
}

template class DisplacementSpace<2>;
} // namespace hpvi
