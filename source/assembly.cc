// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <hpvi/assembly.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

template <int dim>
ElasticSystem<dim>::ElasticSystem(const Scene<dim> &scene,
                                  const DisplacementSpace<dim> &displacement_space,
                                  const ContactSpace<dim> &contact_space,
                                  const ShapeTables<dim> &tables,
                                  ElementStiffnesses<dim> &stiffnesses)
    : space(displacement_space), interior_loads(scene.has_body_force())
{
  const unsigned int n = space.n_dofs();
  f.reinit(n);
  load.reinit(n);
  assemble_loads(scene, tables);
  assemble_stiffness(stiffnesses);
  assemble_contact(contact_space, tables);
}

template <int dim>
void ElasticSystem<dim>::assemble_stiffness(ElementStiffnesses<dim> &stiffnesses)
{
  const unsigned int n = space.n_dofs();
  elements.resize(space.triangulation().n_active_cells());
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
      elements[cell->active_cell_index()] =
          stiffnesses.get(map_of<dim>(cell), space.degrees()[cell->active_cell_index()]);

  std::vector<types::global_dof_index> boundary_dofs;
  const auto locate = [&](const unsigned int cell)
  {
    const auto dofs = space.cell_dofs(cell);
    boundary_dofs.assign(dofs.begin(), dofs.begin() + elements[cell]->condensed.m());
  };

  DynamicSparsityPattern dynamic_pattern(n);
  std::vector<bool> is_unknown(n, false);
  for (unsigned int cell = 0; cell < elements.size(); ++cell)
  {
    locate(cell);
    space.constraints().add_entries_local_to_global(boundary_dofs, dynamic_pattern, false);
    for (const auto dof : boundary_dofs)
      is_unknown[dof] = !space.constraints().is_constrained(dof);
  }
  pattern.copy_from(dynamic_pattern);
  A.reinit(pattern);
  for (types::global_dof_index dof = 0; dof < n; ++dof)
    if (is_unknown[dof])
      unknowns.push_back(dof);

  Vector<double> condensed_load;
  for (unsigned int cell = 0; cell < elements.size(); ++cell)
  {
    locate(cell);
    condensed_load.reinit(boundary_dofs.size());
    if (interior_loads && elements[cell]->extension.m() > 0)
    {
      const auto dofs = space.cell_dofs(cell);
      Vector<double> inside(dofs.size() - boundary_dofs.size());
      for (unsigned int i = 0; i < inside.size(); ++i)
        inside[i] = load[dofs[boundary_dofs.size() + i]];
      elements[cell]->extension.Tvmult(condensed_load, inside);
    }
    space.constraints().distribute_local_to_global(elements[cell]->condensed, condensed_load,
                                                   boundary_dofs, A, f);
  }
}

namespace
{
/** Evaluate the components of an expression; null means zero. */
template <int dim>
Tensor<1, dim> value(const std::array<typename BoundaryCondition<dim>::Expression, dim> &components,
                     const Point<dim> &x)
{
  Tensor<1, dim> result;
  for (unsigned int c = 0; c < dim; ++c)
    if (components[c])
      result[c] = components[c]->value(x);
  return result;
}

/** local_i += sum_q weight_q phi_i(x_q) . force(x_q) */
template <int dim, class Force>
void integrate_load(const ShapeTable<dim> &table, const LocalNumbering &numbering,
                    const CellMap<dim> &map, const Force &force_times_measure,
                    Vector<double> &local)
{
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Tensor<1, dim> force =
        table.weights[q] * force_times_measure(table.points[q], map.point(table.points[q]));
    for (unsigned int i = 0; i < local.size(); ++i)
      local[i] += table.values(q, numbering.shape[i]) * force[numbering.component[i]];
  }
}
} // namespace

template <int dim>
void ElasticSystem<dim>::assemble_loads(const Scene<dim> &scene, const ShapeTables<dim> &tables)
{
  // One point more than a linear load needs, so that smooth loads are integrated well too.
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned() && (interior_loads || cell->at_boundary()))
    {
      const unsigned int degree = space.degrees()[cell->active_cell_index()];
      const LocalNumbering &numbering = tables.numbering(degree);
      const CellMap<dim> map = map_of<dim>(cell);
      Vector<double> local(numbering.shape.size());
      if (interior_loads)
        integrate_load(
            tables.cell(degree, degree + 2), numbering, map,
            [&](const Point<dim> &reference, const Point<dim> &x) {
              return std::abs(determinant(map.jacobian(reference))) *
                     value<dim>(scene.body_force, x);
            },
            local);
      for (const unsigned int face : cell->face_indices())
        if (cell->face(face)->at_boundary())
        {
          const auto &condition = scene.boundaries[cell->face(face)->boundary_id()];
          if (condition.has_traction())
            integrate_load(
                tables.face(degree, face, degree + 2), numbering, map,
                [&](const Point<dim> &, const Point<dim> &x)
                { return cell->face(face)->measure() * value<dim>(condition.traction, x); },
                local);
        }
      const auto dofs = space.cell_dofs(cell->active_cell_index());
      for (unsigned int i = 0; i < local.size(); ++i)
        load[dofs[i]] += local[i];
    }
  // Interior loads reach f through the condensation, all others through the constraints.
  f = load;
  space.constraints().condense(f);
}

namespace
{
/** One row of B on one face: values for the unknowns of the cell, by local number. */
template <int dim>
FullMatrix<double> face_coupling(const ContactFace<dim> &face,
                                 const ContactSpace<dim> &contact_space,
                                 const ShapeTables<dim> &tables)
{
  // p+1 Gauss points are exact to degree 2p+1 = p + (p-2) + 3: exact for g up to degree 3.
  const unsigned int n_gauss = face.degree + 1;
  const ShapeTable<dim> &table = tables.face(face.degree, face.face_no, n_gauss);
  const LocalNumbering &numbering = tables.numbering(face.degree);
  const QGauss<1> gauss(n_gauss);
  FullMatrix<double> local(face.n_multipliers, numbering.shape.size());
  for (unsigned int q = 0; q < n_gauss; ++q)
  {
    const double s = gauss.point(q)[0];
    const double weight = gauss.weight(q) * face.length() * face.friction_bound(face.point(s));
    const std::vector<double> psi = contact_space.basis_values(face, s);
    for (unsigned int i = 0; i < local.n(); ++i)
    {
      const double v_t = face.tangent[numbering.component[i]] * table.values(q, numbering.shape[i]);
      for (unsigned int m = 0; m < local.m(); ++m)
        local(m, i) += weight * psi[m] * v_t;
    }
  }
  return local;
}

/** Call @p action(dof, weight) for every free unknown that @p dof depends on. */
template <class Action>
void for_each_free_part(const AffineConstraints<double> &constraints,
                        const types::global_dof_index dof, const Action &action)
{
  if (!constraints.is_constrained(dof))
    action(dof, 1.);
  else
    for (const auto &entry : *constraints.get_constraint_entries(dof))
      action(entry.first, entry.second);
}
} // namespace

template <int dim>
void ElasticSystem<dim>::assemble_contact(const ContactSpace<dim> &contact_space,
                                          const ShapeTables<dim> &tables)
{
  const AffineConstraints<double> &constraints = space.constraints();
  std::vector<FullMatrix<double>> couplings;
  std::vector<bool> touches(contact_space.n_multipliers() > 0 ? space.n_dofs() : 0, false);
  const double negligible = 1e-14;
  for (const ContactFace<dim> &face : contact_space.faces())
  {
    couplings.emplace_back();
    if (face.n_multipliers == 0)
      continue;
    couplings.back() = face_coupling(face, contact_space, tables);
    const double largest = couplings.back().linfty_norm();
    const auto dofs = space.cell_dofs(face.cell->active_cell_index());
    for (unsigned int i = 0; i < dofs.size(); ++i)
      for (unsigned int m = 0; m < couplings.back().m(); ++m)
        if (std::abs(couplings.back()(m, i)) > negligible * largest)
          for_each_free_part(constraints, dofs[i],
                             [&](const auto dof, double) { touches[dof] = true; });
        else
          couplings.back()(m, i) = 0.; // shape functions of other faces: zero up to round-off
  }

  std::vector<unsigned int> column(touches.size());
  for (unsigned int dof = 0; dof < touches.size(); ++dof)
    if (touches[dof])
    {
      column[dof] = contact_unknowns.size();
      contact_unknowns.push_back(dof);
    }
  B.reinit(contact_space.n_multipliers(), contact_unknowns.size());
  B_prescribed.reinit(contact_space.n_multipliers());
  for (unsigned int k = 0; k < couplings.size(); ++k)
  {
    const ContactFace<dim> &face = contact_space.faces()[k];
    const auto dofs = space.cell_dofs(face.cell->active_cell_index());
    for (unsigned int m = 0; m < couplings[k].m(); ++m)
      for (unsigned int i = 0; i < couplings[k].n(); ++i)
      {
        const double b = couplings[k](m, i);
        if (b == 0.)
          continue;
        B_prescribed[face.first_multiplier + m] += b * constraints.get_inhomogeneity(dofs[i]);
        for_each_free_part(constraints, dofs[i],
                           [&](const auto dof, const double weight)
                           { B(face.first_multiplier + m, column[dof]) += b * weight; });
      }
  }
}

template <int dim>
void ElasticSystem<dim>::recover(Vector<double> &u) const
{
  space.constraints().distribute(u);
  for (unsigned int cell = 0; cell < elements.size(); ++cell)
  {
    const ElementStiffness &element = *elements[cell];
    const unsigned int n_boundary = element.extension.n(), n_interior = element.extension.m();
    if (n_interior == 0)
      continue;
    const auto dofs = space.cell_dofs(cell);
    Vector<double> boundary(n_boundary), interior(n_interior);
    if (interior_loads)
    {
      for (unsigned int i = 0; i < n_interior; ++i)
        interior[i] = load[dofs[n_boundary + i]];
      element.K_ii.solve(interior);
    }
    for (unsigned int i = 0; i < n_boundary; ++i)
      boundary[i] = u[dofs[i]];
    element.extension.vmult(interior, boundary, /*adding=*/true);
    for (unsigned int i = 0; i < n_interior; ++i)
      u[dofs[n_boundary + i]] = interior[i];
  }
}

template <int dim>
double ElasticSystem<dim>::energy_product(const Vector<double> &u) const
{
  double a = 0;
  for (unsigned int cell = 0; cell < elements.size(); ++cell)
  {
    const auto dofs = space.cell_dofs(cell);
    Vector<double> local(dofs.size());
    for (unsigned int i = 0; i < dofs.size(); ++i)
      local[i] = u[dofs[i]];
    a += elements[cell]->K.matrix_norm_square(local);
  }
  return a;
}

template <int dim>
double ElasticSystem<dim>::work(const Vector<double> &u) const
{
  return load * u;
}

template class ElasticSystem<2>;
} // namespace hpvi
