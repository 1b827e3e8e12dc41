// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/base/dense_work.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/discretisation/elastic_system.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>
#include <string>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Call @p action(dof, weight) for every free unknown that @p dof depends on. */
template <class Action>
void for_each_free_part(const AffineConstraints<double> &constraints,
                        const types::global_dof_index dof, const Action &action)
{
  if (const auto *entries = constraints.get_constraint_entries(dof))
    for (const auto &entry : *entries)
      action(entry.first, entry.second);
  else
    action(dof, 1.);
}
} // namespace

template <int dim>
ElasticSystem<dim>::ElasticSystem(const Scene<dim> &scene,
                                  const DisplacementSpace<dim> &displacement_space,
                                  const ContactSpace<dim> &contact_space,
                                  const ShapeTables<dim> &tables,
                                  ElementStiffnesses<dim> &stiffnesses)
    : space(displacement_space), contact_space(contact_space), load(displacement_space.n_dofs()),
      interior_loads(scene.has_body_force())
{
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    elements.push_back(stiffnesses.get(
        map_of<dim>(cell), space.degrees()[cell->active_cell_index()], cell->material_id()));
  number_unknowns();
  assemble_loads(scene, tables);
  std::vector<Contribution> contributions;
  for (unsigned int cell = 0; cell < elements.size(); ++cell)
    contributions.push_back(reduce(cell, stiffnesses));
  sum_up(contributions);
  stiffnesses.forget_unused();
  assemble_contact(tables);
  if (scene.free_translation())
    hold(*scene.free_translation());
}

template <int dim>
void ElasticSystem<dim>::number_unknowns()
{
  number.assign(space.n_dofs(), numbers::invalid_unsigned_int);
  for (unsigned int cell = 0; cell < elements.size(); ++cell)
    for (unsigned int i = 0; i < elements[cell]->condensed.m(); ++i)
    {
      const auto dof = space.cell_dofs(cell)[i];
      if (number[dof] == numbers::invalid_unsigned_int && !space.constraints().is_constrained(dof))
      {
        number[dof] = unknowns.size();
        unknowns.push_back(dof);
      }
    }
  f.reinit(unknowns.size());
}

/** Those of @p values, one for each displacement unknown, that belong to the interior of a cell. */
template <int dim>
Vector<double> ElasticSystem<dim>::inside(const unsigned int cell,
                                          const Vector<double> &values) const
{
  const unsigned int n_boundary = elements[cell]->condensed.m();
  const auto dofs = space.cell_dofs(cell);
  Vector<double> result(dofs.size() - n_boundary);
  for (unsigned int i = 0; i < result.size(); ++i)
    result[i] = values[dofs[n_boundary + i]];
  return result;
}

/**
 * `T' K T` of one cell, where T expresses the unknowns on its boundary by free ones. Adds the
 * cell's part of f as well: the load inside the cell, and what prescribed displacements h leave on
 * the right, -T' K h.
 */
template <int dim>
typename ElasticSystem<dim>::Contribution
ElasticSystem<dim>::reduce(const unsigned int cell, ElementStiffnesses<dim> &stiffnesses)
{
  const FullMatrix<double> &K = elements[cell]->condensed;
  const unsigned int n = K.m();
  const auto dofs = space.cell_dofs(cell);
  Contribution result;
  std::vector<ConstraintEntry> T;
  Vector<double> prescribed(n);
  bool is_identity = true, has_prescribed = false;
  for (unsigned int i = 0; i < n; ++i)
  {
    if (!space.constraints().is_constrained(dofs[i]))
    {
      // A free unknown of the cell may have been met before, as the master of a constrained one.
      const unsigned int target = is_identity ? i : result.add_target(number[dofs[i]]);
      if (is_identity)
        result.targets.push_back(number[dofs[i]]);
      T.push_back({i, target, 1.});
      continue;
    }
    is_identity = false;
    for (const auto &entry : *space.constraints().get_constraint_entries(dofs[i]))
      T.push_back({i, result.add_target(number[entry.first]), entry.second});
    prescribed[i] = space.constraints().get_inhomogeneity(dofs[i]);
    has_prescribed = has_prescribed || prescribed[i] != 0.;
  }
  result.matrix = &K;
  if (!is_identity)
  {
    constrained.push_back(stiffnesses.constrained(elements[cell], T, result.targets.size()));
    result.matrix = constrained.back().get();
  }

  if (!interior_loads && !has_prescribed)
    return result;
  Vector<double> local_load(n);
  if (interior_loads && elements[cell]->extension.m() > 0)
    elements[cell]->extension.Tvmult(local_load, inside(cell, load));
  if (has_prescribed)
  {
    Vector<double> reaction(n);
    K.vmult(reaction, prescribed);
    local_load -= reaction;
  }
  for (const ConstraintEntry &part : T)
    f[result.targets[part.target]] += part.weight * local_load[part.local];
  return result;
}

template <int dim>
unsigned int ElasticSystem<dim>::Contribution::add_target(const unsigned int unknown)
{
  const auto found = std::find(targets.begin(), targets.end(), unknown);
  const unsigned int target = found - targets.begin();
  if (found == targets.end())
    targets.push_back(unknown);
  return target;
}

/** Column by column, so that one marker array finds equal entries of neighbouring cells. */
template <int dim>
void ElasticSystem<dim>::sum_up(const std::vector<Contribution> &contributions)
{
  // Where each unknown stands in the contributions: a list per unknown, one after the other.
  struct Place
  {
    const Contribution *contribution;
    unsigned int local;
  };
  std::vector<unsigned int> first(unknowns.size() + 1, 0);
  std::size_t n_entries = 0;
  for (const Contribution &contribution : contributions)
  {
    for (const unsigned int target : contribution.targets)
      ++first[target + 1];
    n_entries += contribution.targets.size() * (contribution.targets.size() + 1) / 2;
  }
  A.resize(n_entries);
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Place> places(first.back());
  std::vector<unsigned int> next(first);
  for (const Contribution &contribution : contributions)
    for (unsigned int i = 0; i < contribution.targets.size(); ++i)
      places[next[contribution.targets[i]]++] = {&contribution, i};

  A.column_start.reserve(unknowns.size() + 1);
  std::vector<int> position(unknowns.size(), -1);
  int end = 0;
  for (unsigned int column = 0; column < unknowns.size(); ++column)
  {
    const int start = end;
    for (unsigned int place = first[column]; place < first[column + 1]; ++place)
    {
      const Contribution &contribution = *places[place].contribution;
      const double *const values = &(*contribution.matrix)(places[place].local, 0);
      for (unsigned int i = 0; i < contribution.targets.size(); ++i)
      {
        const unsigned int row = contribution.targets[i];
        if (row > column)
          continue;
        if (position[row] < start)
        {
          position[row] = end;
          A.row[end++] = row;
        }
        A.value[position[row]] += values[i];
      }
    }
    A.column_start.push_back(end);
  }
  A.resize(end);
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
  // Loads on the boundary of cells; those inside reach f through the condensation.
  for (types::global_dof_index dof = 0; dof < load.size(); ++dof)
    if (load[dof] != 0.)
      for_each_free_part(space.constraints(), dof,
                         [&](const auto free_dof, const double weight)
                         {
                           if (number[free_dof] != numbers::invalid_unsigned_int)
                             f[number[free_dof]] += weight * load[dof];
                         });
}

namespace
{
/** One row of B on one face: values for the unknowns of the cell, by local number. */
template <int dim>
FullMatrix<double> face_coupling(const ContactFace<dim> &face,
                                 const ContactSpace<dim> &contact_space,
                                 const ShapeTables<dim> &tables)
{
  const FrictionRule &rule = face.friction;
  const ShapeTable<dim> &table = face.friction_table(tables);
  const LocalNumbering &numbering = tables.numbering(face.degree);
  FullMatrix<double> local(face.n_multipliers, numbering.shape.size());
  for (unsigned int q = 0; q < rule.points.size(); ++q)
  {
    const double weight = rule.weights[q] * face.length() * rule.values[q];
    const std::vector<double> psi = contact_space.basis_values(face, rule.points[q]);
    for (unsigned int i = 0; i < local.n(); ++i)
    {
      const double v_t = face.tangent[numbering.component[i]] * table.values(q, numbering.shape[i]);
      for (unsigned int m = 0; m < local.m(); ++m)
        local(m, i) += weight * psi[m] * v_t;
    }
  }
  return local;
}

} // namespace

template <int dim>
void ElasticSystem<dim>::assemble_contact(const ShapeTables<dim> &tables)
{
  const AffineConstraints<double> &constraints = space.constraints();
  std::vector<bool> touches(contact_space.n_multipliers() > 0 ? unknowns.size() : 0, false);
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
                             [&](const auto dof, double) { touches[number[dof]] = true; });
        else
          couplings.back()(m, i) = 0.; // shape functions of other faces: zero up to round-off
  }

  std::vector<unsigned int> column(touches.size());
  for (unsigned int unknown = 0; unknown < touches.size(); ++unknown)
    if (touches[unknown])
    {
      column[unknown] = contact_unknowns.size();
      contact_unknowns.push_back(unknown);
    }
  const DenseWork dense{contact_unknowns.size(), contact_space.n_multipliers()};
  if (dense.n_multipliers > 0)
    require_memory(dense.coupling_bytes() + dense.bytes(), dense.name());
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
                           { B(face.first_multiplier + m, column[number[dof]]) += b * weight; });
      }
  }
}

namespace
{
/** Why a body that friction alone could hold has no friction on this mesh. */
template <int dim>
std::string nothing_resists(const Tensor<1, dim> &direction, const double load)
{
  std::ostringstream line;
  line
      << "nothing holds the body along (" << direction << "): the loads push it with "
      << std::abs(load)
      << ", friction can resist with 0, for Friction bound vanishes wherever this mesh samples it; "
         "raise Geometry/Subdivisions, set Geometry/Graded towards where it acts, or add a support";
  return line.str();
}
} // namespace

/**
 * The spring is soft beside the body: for the quadratic program it is a penalty of weight 1/spring on
 * R'(f - B' lambda), and a strong one converges fast. It costs as many digits of u along R alone.
 */
template <int dim>
void ElasticSystem<dim>::hold(const Tensor<1, dim> &free_translation)
{
  translation.reinit(unknowns.size());
  for (const auto &cell : space.dof_handler().active_cell_iterators())
  {
    const auto dofs = space.cell_dofs(cell->active_cell_index());
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (number[dofs[i]] != numbers::invalid_unsigned_int)
        translation[number[dofs[i]]] =
            free_translation[cell->get_fe().system_to_component_index(i).first];
  }
  if (contact_unknowns.empty())
    throw NumericalFailure(nothing_resists(
        free_translation, std::inner_product(f.begin(), f.end(), translation.begin(), 0.)));
  const unsigned int held =
      *std::max_element(contact_unknowns.begin(), contact_unknowns.end(),
                        [this](const auto a, const auto b)
                        { return std::abs(translation[a]) < std::abs(translation[b]); });
  for (int k = A.column_start[held]; k < A.column_start[held + 1]; ++k)
    if (A.row[k] == static_cast<int>(held))
    {
      const double stiffness = 1e-2 * A.value[k];
      A.value[k] += stiffness;
      spring = stiffness * translation[held] * translation[held];
    }
}

template <int dim>
Vector<double> ElasticSystem<dim>::recover(const Vector<double> &x) const
{
  Vector<double> u(space.n_dofs());
  for (unsigned int k = 0; k < unknowns.size(); ++k)
    u[unknowns[k]] = x[k];
  space.constraints().distribute(u);
  for (unsigned int cell = 0; cell < elements.size(); ++cell)
    if (elements[cell]->extension.m() > 0)
    {
      Vector<double> interior(elements[cell]->extension.m());
      if (interior_loads)
      {
        interior = inside(cell, load);
        elements[cell]->K_ii.solve(interior);
      }
      extend(cell, interior, u);
    }
  return u;
}

template <int dim>
double ElasticSystem<dim>::work(const Vector<double> &u) const
{
  // deal.II's product would split the sum by threads; a result must not depend on their number.
  return std::inner_product(load.begin(), load.end(), u.begin(), 0.);
}

template <int dim>
const Vector<double> &ElasticSystem<dim>::loads() const
{
  return load;
}

template <int dim>
Vector<double> ElasticSystem<dim>::friction_forces(const Vector<double> &lambda,
                                                   const types::boundary_id only) const
{
  Vector<double> forces(space.n_dofs());
  for (unsigned int k = 0; k < couplings.size(); ++k)
  {
    if (only != numbers::invalid_boundary_id && contact_space.faces()[k].condition->id != only)
      continue;
    const auto dofs = space.cell_dofs(contact_space.faces()[k].cell->active_cell_index());
    for (unsigned int m = 0; m < couplings[k].m(); ++m)
      for (unsigned int i = 0; i < couplings[k].n(); ++i)
        forces[dofs[i]] +=
            couplings[k](m, i) * lambda[contact_space.faces()[k].first_multiplier + m];
  }
  return forces;
}

template <int dim>
Vector<double> ElasticSystem<dim>::tangential_moments(const Vector<double> &u) const
{
  Vector<double> moments(B.m());
  for (unsigned int k = 0; k < couplings.size(); ++k)
  {
    const auto dofs = space.cell_dofs(contact_space.faces()[k].cell->active_cell_index());
    for (unsigned int m = 0; m < couplings[k].m(); ++m)
      for (unsigned int i = 0; i < couplings[k].n(); ++i)
        moments[contact_space.faces()[k].first_multiplier + m] += couplings[k](m, i) * u[dofs[i]];
  }
  return moments;
}

template <int dim>
Vector<double> ElasticSystem<dim>::reduce(const Vector<double> &forces) const
{
  Vector<double> carried(forces), result(unknowns.size());
  for (unsigned int cell = 0; cell < elements.size(); ++cell)
    if (elements[cell]->extension.m() > 0)
    {
      const auto dofs = space.cell_dofs(cell);
      Vector<double> on_boundary(elements[cell]->extension.n());
      elements[cell]->extension.Tvmult(on_boundary, inside(cell, forces));
      for (unsigned int i = 0; i < on_boundary.size(); ++i)
        carried[dofs[i]] += on_boundary[i];
    }
  for (types::global_dof_index dof = 0; dof < carried.size(); ++dof)
    for_each_free_part(space.constraints(), dof,
                       [&](const auto free_dof, const double weight)
                       {
                         if (number[free_dof] != numbers::invalid_unsigned_int)
                           result[number[free_dof]] += weight * carried[dof];
                       });
  return result;
}

template <int dim>
typename ElasticSystem<dim>::Interiors
ElasticSystem<dim>::interiors(const ElementStiffnesses<dim> &stiffnesses) const
{
  Interiors result;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
  {
    const unsigned int index = cell->active_cell_index();
    if (elements[index]->extension.m() > 0 && result.count(elements[index].get()) == 0)
      stiffnesses.interior(map_of<dim>(cell), space.degrees()[index], cell->material_id(),
                           result[elements[index].get()]);
  }
  return result;
}

template <int dim>
Vector<double> ElasticSystem<dim>::respond(const Vector<double> &x, const Vector<double> &forces,
                                           const Interiors &interiors) const
{
  Vector<double> u(space.n_dofs());
  for (types::global_dof_index dof = 0; dof < u.size(); ++dof)
    for_each_free_part(space.constraints(), dof,
                       [&](const auto free_dof, const double weight)
                       {
                         if (number[free_dof] != numbers::invalid_unsigned_int)
                           u[dof] += weight * x[number[free_dof]];
                       });
  for (unsigned int cell = 0; cell < elements.size(); ++cell)
    if (elements[cell]->extension.m() > 0)
    {
      Vector<double> interior = inside(cell, forces);
      interiors.at(elements[cell].get()).solve(interior);
      extend(cell, interior, u);
    }
  return u;
}

/** Put `extension u_b` more than @p interior into the unknowns inside a cell. */
template <int dim>
void ElasticSystem<dim>::extend(const unsigned int cell, Vector<double> &interior,
                                Vector<double> &u) const
{
  const FullMatrix<double> &extension = elements[cell]->extension;
  const auto dofs = space.cell_dofs(cell);
  Vector<double> boundary(extension.n());
  for (unsigned int i = 0; i < boundary.size(); ++i)
    boundary[i] = u[dofs[i]];
  extension.vmult(interior, boundary, /*adding=*/true);
  for (unsigned int i = 0; i < interior.size(); ++i)
    u[dofs[boundary.size() + i]] = interior[i];
}

template class ElasticSystem<2>;
} // namespace hpvi
