// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/lapack_support.h>
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/algebra/triangular.h>
#include <hpvi/plane/condensation.h>
#include <hpvi/plane/initial_stress.h>
#include <hpvi/plane/internal_forces.h>

#include <algorithm>
#include <iterator>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * @p K_ii := the block of @p K that belongs to the unknowns inside the cell, by its Cholesky factor. Not
 * returned: a copy of deal.II's matrix forgets that it is a factor.
 */
void factor_interior(const FullMatrix<double> &K, const unsigned int n_boundary,
                     LAPACKFullMatrix<double> &K_ii)
{
  const unsigned int n_interior = K.m() - n_boundary;
  K_ii.reinit(n_interior);
  for (unsigned int i = 0; i < n_interior; ++i)
    for (unsigned int j = 0; j < n_interior; ++j)
      K_ii(i, j) = K(n_boundary + i, n_boundary + j);
  K_ii.set_property(LAPACKSupport::symmetric);
  K_ii.compute_cholesky_factorization();
}
} // namespace

void CondensedElement::solve_inside(double *const x) const
{
  solve_by_cholesky(n_interior, factor, x);
}

template <int dim>
CondensedElements<dim>::CondensedElements(const Scene<dim> &scene, const ShapeTables<dim> &tables,
                                          const Volume volume)
    : scene(scene), tables(tables), matrices(scene, tables, volume),
      interior_loads(has_interior_loads(scene))
{
}

template <int dim>
Volume CondensedElements<dim>::volume() const
{
  return matrices.volume;
}

template <int dim>
std::shared_ptr<CondensedElement>
CondensedElements<dim>::condense(const FullMatrix<double> &K, const unsigned int n_boundary) const
{
  auto element = std::make_shared<CondensedElement>();
  const unsigned int n_interior = element->n_interior = K.m() - n_boundary;
  FullMatrix<double> condensed(n_boundary, n_boundary);
  condensed.fill(K, 0, 0, 0, 0);
  if (n_interior > 0)
  {
    LAPACKFullMatrix<double> K_ii, K_ib(n_interior, n_boundary);
    factor_interior(K, n_boundary, K_ii);
    for (unsigned int i = 0; i < n_interior; ++i)
      for (unsigned int j = 0; j < n_boundary; ++j)
        K_ib(i, j) = -K(n_boundary + i, j);
    K_ii.solve(K_ib);
    FullMatrix<double> extension(n_interior, n_boundary), K_bi(n_boundary, n_interior);
    extension = K_ib;
    K_bi.fill(K, 0, 0, 0, n_boundary);
    K_bi.mmult(condensed, extension, /*adding=*/true);
    element->extension = extension;
    if (interior_loads)
      element->factor.assign(&K_ii(0, 0), &K_ii(0, 0) + K_ii.n_elements());
  }
  element->condensed = condensed;
  return element;
}

// With `K_ii = L L'` and `W = L^-1 K_ib` what is left is `K_bb - W' W`.
template <int dim>
std::shared_ptr<CondensedElement> CondensedElements<dim>::condense(std::vector<double> &K,
                                                                   const unsigned int n,
                                                                   const unsigned int n_boundary)
{
  auto element = std::make_shared<CondensedElement>();
  const types::blas_int n_i = n - n_boundary, n_b = n_boundary, stride = n;
  double *const K_bb = &K[n_i] + std::size_t(n_i) * n;
  if (n_i > 0)
  {
    AssertThrow(cholesky(n_i, K.data(), n), LACExceptions::ExcSingular());
    std::vector<double> W(std::size_t(n_i) * n_b);
    element->factor.resize(std::size_t(n_i) * n_i);
    for (types::blas_int j = 0; j < n_i; ++j)
    {
      const double *const column = &K[std::size_t(j) * n];
      std::copy(column + j, column + n_i, &element->factor[std::size_t(j) * n_i + j]);
      for (types::blas_int i = 0; i < n_b; ++i)
        W[std::size_t(i) * n_i + j] = column[n_i + i];
    }
    solve_triangular('N', n_i, n_b, {element->factor.data(), unsigned(n_i)}, W.data(), n_i);
    const double minus = -1, one = 1;
    syrk("L", "T", &n_b, &n_i, &minus, W.data(), &n_i, &one, K_bb, &stride);
  }
  element->condensed.reinit(n_boundary, n_boundary);
  for (unsigned int j = 0; j < n_boundary; ++j)
    for (unsigned int i = j; i < n_boundary; ++i)
      element->condensed(i, j) = element->condensed(j, i) = K_bb[std::size_t(j) * n + i];
  element->n_interior = n_i;
  return element;
}

template <int dim>
std::shared_ptr<const CondensedElement>
CondensedElements<dim>::get(const CellMap<dim> &map, const unsigned int degree,
                            const types::material_id material)
{
  auto &entry = known[matrices.congruence_class(map, degree, material)];
  std::shared_ptr<const CondensedElement> element = entry.lock();
  if (!element)
  {
    const unsigned int n_boundary = matrices.n_boundary(degree);
    if (matrices.is_factorised(map))
    {
      matrices.triangle(map, degree, material, triangle);
      element = condense(triangle, dim * Utilities::pow(degree + 1, dim), n_boundary);
    }
    else
      element = condense(matrices.stiffness(map, degree, material), n_boundary);
    entry = element;
  }
  return element;
}

template <int dim>
void CondensedElements<dim>::interior(const CellMap<dim> &map, const unsigned int degree,
                                      const types::material_id material,
                                      LAPACKFullMatrix<double> &K_ii) const
{
  factor_interior(matrices.stiffness(map, degree, material), matrices.n_boundary(degree), K_ii);
}

namespace
{
/** T' K T, first its rows, then its columns: T is nearly the identity. */
FullMatrix<double> congruence(const std::vector<ConstraintEntry> &T, const unsigned int n_targets,
                              const FullMatrix<double> &K)
{
  FullMatrix<double> rows(n_targets, K.n()), result(n_targets, n_targets);
  for (const ConstraintEntry &entry : T)
  {
    double *const sum = &rows(entry.target, 0);
    const double *const row = &K(entry.local, 0);
    for (unsigned int j = 0; j < K.n(); ++j)
      sum[j] += entry.weight * row[j];
  }
  for (unsigned int i = 0; i < n_targets; ++i)
  {
    double *const sum = &result(i, 0);
    const double *const row = &rows(i, 0);
    for (const ConstraintEntry &entry : T)
      sum[entry.target] += entry.weight * row[entry.local];
  }
  return result;
}
} // namespace

template <int dim>
std::shared_ptr<const FullMatrix<double>>
CondensedElements<dim>::constrained(const std::shared_ptr<const CondensedElement> &element,
                                    const std::vector<ConstraintEntry> &T,
                                    const unsigned int n_targets)
{
  auto &entry = known_constrained[{element, T}];
  std::shared_ptr<const FullMatrix<double>> matrix = entry.lock();
  if (!matrix)
  {
    matrix =
        std::make_shared<const FullMatrix<double>>(congruence(T, n_targets, element->condensed));
    entry = matrix;
  }
  return matrix;
}

template <int dim>
void CondensedElements<dim>::forget_unused()
{
  for (auto entry = known_constrained.begin(); entry != known_constrained.end();)
    entry = entry->second.expired() ? known_constrained.erase(entry) : std::next(entry);
}

template <int dim>
Condensation<dim>::Condensation(const DisplacementSpace<dim> &space,
                                CondensedElements<dim> &condensed)
    : space(space), scene(condensed.scene), tables(condensed.tables),
      elements(space.degrees().size())
{
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const unsigned int index = cell->active_cell_index();
      elements[index] =
          condensed.get(map_of<dim>(cell), space.degrees()[index], cell->material_id());
      if (elements[index]->n_interior > 0)
        (elements[index]->extension.empty() ? with_interior : with_extension).push_back(index);
    }
}

template <int dim>
const std::shared_ptr<const CondensedElement> &
Condensation<dim>::element(const unsigned int cell) const
{
  return elements[cell];
}

/** Calls f(extension, unknowns, x inside, x on the boundary) for each cell that has an extension. */
template <int dim>
template <class F>
void Condensation<dim>::for_each_extension(const F &f) const
{
  Vector<double> inside, boundary; // keep their memory from cell to cell
  for (const unsigned int cell : with_extension)
  {
    const FullMatrix<double> &extension = elements[cell]->extension;
    inside.reinit(extension.m(), /*omit_zeroing_entries=*/true);
    boundary.reinit(extension.n(), /*omit_zeroing_entries=*/true);
    f(extension, space.cell_dofs(cell), inside, boundary);
  }
}

namespace
{
void by_own_factor(const CondensedElement &element, Vector<double> &x)
{
  element.solve_inside(x.begin());
}
} // namespace

/** `u_i := 0` of cells without extension. */
template <int dim>
void Condensation<dim>::clear_interiors(Vector<double> &u) const
{
  for (const unsigned int cell : with_interior)
  {
    const auto dofs = space.cell_dofs(cell);
    for (unsigned int i = elements[cell]->condensed.m(); i < dofs.size(); ++i)
      u[dofs[i]] = 0.;
  }
}

/** K u, springs aside, which have nothing inside cells. */
template <int dim>
Vector<double> Condensation<dim>::strained(const Vector<double> &u) const
{
  return internal_forces(scene, space, tables, u).forces;
}

template <int dim>
void Condensation<dim>::eliminate(Vector<double> &forces) const
{
  Vector<double> taken; // from cells without extension, before others have added what is theirs
  if (!with_interior.empty())
  {
    Vector<double> x(forces.size());
    solve_inside(with_interior, forces, by_own_factor, x);
    taken = strained(x);
    clear_interiors(taken);
  }
  for_each_extension(
      [&](const auto &extension, const auto &dofs, auto &inside, auto &boundary)
      {
        for (unsigned int i = 0; i < inside.size(); ++i)
          inside[i] = forces[dofs[boundary.size() + i]];
        extension.Tvmult(boundary, inside);
        for (unsigned int i = 0; i < boundary.size(); ++i)
          forces[dofs[i]] += boundary[i];
      });
  if (!with_interior.empty())
    forces -= taken;
}

template <int dim>
void Condensation<dim>::extend(Vector<double> &u) const
{
  for_each_extension(
      [&](const auto &extension, const auto &dofs, auto &inside, auto &boundary)
      {
        for (unsigned int i = 0; i < boundary.size(); ++i)
          boundary[i] = u[dofs[i]];
        extension.vmult(inside, boundary);
        for (unsigned int i = 0; i < inside.size(); ++i)
          u[dofs[boundary.size() + i]] = inside[i];
      });
  if (with_interior.empty())
    return;
  clear_interiors(u);
  Vector<double> forces = strained(u);
  forces *= -1.;
  solve_inside(with_interior, forces, by_own_factor, u);
}

template <int dim>
typename Condensation<dim>::Interiors
Condensation<dim>::interiors(const CondensedElements<dim> &condensed) const
{
  Interiors result;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const unsigned int index = cell->active_cell_index();
      if (elements[index]->extension.m() > 0 && result.count(elements[index].get()) == 0)
        condensed.interior(map_of<dim>(cell), space.degrees()[index], cell->material_id(),
                           result[elements[index].get()]);
    }
  return result;
}

/** `u_i += K_ii^-1 f_i` of some cells. */
template <int dim>
template <class Solve>
void Condensation<dim>::solve_inside(const std::vector<unsigned int> &cells,
                                     const Vector<double> &forces, const Solve &solve,
                                     Vector<double> &u) const
{
  Vector<double> inside; // keeps its memory from cell to cell
  for (const unsigned int cell : cells)
  {
    const auto dofs = space.cell_dofs(cell);
    const unsigned int n_boundary = elements[cell]->condensed.m();
    inside.reinit(elements[cell]->n_interior, /*omit_zeroing_entries=*/true);
    for (unsigned int i = 0; i < inside.size(); ++i)
      inside[i] = forces[dofs[n_boundary + i]];
    solve(*elements[cell], inside);
    for (unsigned int i = 0; i < inside.size(); ++i)
      u[dofs[n_boundary + i]] += inside[i];
  }
}

template <int dim>
void Condensation<dim>::add_interior(const Vector<double> &forces, const Interiors &interiors,
                                     Vector<double> &u) const
{
  solve_inside(
      with_extension, forces,
      [&](const CondensedElement &element, Vector<double> &inside)
      { interiors.at(&element).solve(inside); },
      u);
  solve_inside(with_interior, forces, by_own_factor, u);
}

template <int dim>
void Condensation<dim>::add_interior(const Vector<double> &forces, Vector<double> &u) const
{
  solve_inside(with_extension, forces, by_own_factor, u);
  solve_inside(with_interior, forces, by_own_factor, u);
}

template class CondensedElements<2>;
template class Condensation<2>;
} // namespace hpvi
