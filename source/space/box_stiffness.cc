// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/space/box_stiffness.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

bool any(const std::vector<bool> &moment_components)
{
  return std::find(moment_components.begin(), moment_components.end(), true) !=
         moment_components.end();
}

namespace
{
/** Is it a box with moments along the axes alone? */
template <int dim>
bool is_straight(const PrimalSpace<dim> &space, const typename PrimalSpace<dim>::Cell &cell)
{
  if (space.scene.geometry.has_mesh())
    return false;
  for (const unsigned int face : cell->face_indices())
    if (const ContactDofFace<dim> *const own = space.moment_face(cell, face))
      if (own->axes.is_rotated())
        return false;
  return true;
}
} // namespace

template <int dim>
FullMatrix<double> basis_of_moments(const PrimalSpace<dim> &space,
                                    const typename PrimalSpace<dim>::Cell &cell)
{
  const BoxTables<dim> &tables = space.tables.of(cell);
  if (is_straight(space, cell))
    return tables.basis_of_moments(space.moment_components(cell));
  FullMatrix<double> T = IdentityMatrix(tables.fe.dofs_per_cell);
  const auto add = [&](const ContactDofFace<dim> &face)
  {
    const FaceContactDofs &contact_dofs = space.contact_dofs_on(face);
    const unsigned int n = tables.n_contact_dofs();
    const auto number = [&](const auto &shapes, const unsigned int i, const unsigned int c)
    { return tables.numbers[shapes[face.face][i]][c]; };
    FullMatrix<double> rim_to_inner(contact_dofs.M.m(), contact_dofs.W.n());
    contact_dofs.M_inverse.mmult(rim_to_inner, contact_dofs.W);
    if (face.is_curved())
    {
      const unsigned int n_rim = tables.rim[face.face].size();
      for (unsigned int r = 0; r < dim * n; ++r)
      {
        const unsigned int row = number(tables.inner, r % n, r / n);
        for (unsigned int k = 0; k < dim * n; ++k)
          T(row, number(tables.inner, k % n, k / n)) = contact_dofs.M_inverse(r, k);
        for (unsigned int j = 0; j < dim * n_rim; ++j)
          T(row, number(tables.rim, j % n_rim, j / n_rim)) = -rim_to_inner(r, j);
      }
      return;
    }
    for (const unsigned int c : face.components())
      for (unsigned int r = 0; r < n; ++r)
      {
        const unsigned int row = number(tables.inner, r, c);
        T(row, row) = 0;
        for (unsigned int k = 0; k < n; ++k)
          for (const unsigned int own : face.components())
            T(row, number(tables.inner, k, own)) =
                contact_dofs.M_inverse(r, k) * face.direction(own)[c];
        for (unsigned int j = 0; j < contact_dofs.W.n(); ++j)
          T(row, number(tables.rim, j, c)) = -rim_to_inner(r, j);
      }
  };
  for (const unsigned int face : cell->face_indices())
    if (const ContactDofFace<dim> *const own = space.moment_face(cell, face))
      add(*own);
  return T;
}

namespace
{
/** T'KT */
FullMatrix<double> in_basis(const FullMatrix<double> &K, const FullMatrix<double> &T)
{
  FullMatrix<double> KT(K.m(), K.m()), result(K.m(), K.m());
  K.mmult(KT, T);
  T.Tmmult(result, KT);
  return result;
}
} // namespace

template <int dim>
BoxStiffness<dim>::BoxStiffness(const PrimalSpace<dim> &space)
    : space(space), foundation(space.scene, space.tables),
      none(dim * GeometryInfo<dim>::faces_per_cell, false)
{
}

template <int dim>
HookesLaw<dim> BoxStiffness<dim>::law(const Cell &cell) const
{
  return HookesLaw<dim>(space.scene.material_of(cell));
}

template <int dim>
const FullMatrix<double> &BoxStiffness<dim>::of_box(const Cell &cell,
                                                    const std::vector<bool> &components) const
{
  const auto [entry, is_new] =
      matrices.try_emplace({size_class(cell), cell->material_id(), components});
  if (is_new)
  {
    entry->second = space.tables.of(cell).stiffness(law(cell), PrimalSpace<dim>::extent(cell));
    if (any(components))
      entry->second = in_basis(entry->second, basis_of_moments(space, cell));
  }
  return entry->second;
}

/** Of an affine cell, made where it is not there and there is room. */
template <int dim>
const FullMatrix<double> *BoxStiffness<dim>::known(const Cell &cell, const CellMap<dim> &map) const
{
  constexpr std::size_t most = 64;
  if (!map.is_affine())
    return nullptr;
  const Tensor<2, dim> edges = map.jacobian({});
  const types::material_id material = cell->material_id();
  const BoxTables<dim> &tables = space.tables.of(cell);
  for (const auto &one : parallelepipeds)
    if (one->material == material && one->degree == tables.degree &&
        (one->edges - edges).norm() < same_box * edges.norm())
      return &one->K;
  if (parallelepipeds.size() == most)
    return nullptr;
  parallelepipeds.push_back(std::make_unique<Parallelepiped>(
      Parallelepiped{edges, material, tables.degree, tables.stiffness(law(cell), map)}));
  return &parallelepipeds.back()->K;
}

/** Of nodal values, without springs. */
template <int dim>
const FullMatrix<double> &BoxStiffness<dim>::of_body(const Cell &cell) const
{
  if (!space.scene.geometry.has_mesh())
    return of_box(cell, none);
  const CellMap<dim> map = map_of<dim>(cell);
  if (const Matrix *const K = known(cell, map))
    return *K;
  return last = space.tables.of(cell).stiffness(law(cell), map);
}

template <int dim>
const FullMatrix<double> &BoxStiffness<dim>::nodal(const Cell &cell) const
{
  const Matrix &K = of_body(cell);
  if (!foundation.holds(cell))
    return K;
  if (&K != &last)
    last = K;
  foundation.add_to(last, cell);
  return last;
}

template <int dim>
const FullMatrix<double> &BoxStiffness<dim>::operator()(const Cell &cell) const
{
  const std::vector<bool> components = space.moment_components(cell);
  if (!space.scene.geometry.has_mesh() && !foundation.holds(cell) &&
      (!any(components) || is_straight(space, cell)))
    return of_box(cell, components);
  const Matrix &K = nodal(cell);
  return any(components) ? last = in_basis(K, basis_of_moments(space, cell)) : K;
}

template <int dim>
std::vector<double> BoxStiffness<dim>::diagonal(const Cell &cell) const
{
  const BoxTables<dim> &tables = space.tables.of(cell);
  std::vector<double> result(tables.fe.dofs_per_cell);
  const bool is_box = !space.scene.geometry.has_mesh();
  const CellMap<dim> map = map_of<dim>(cell);
  foundation.add_to_diagonal(result, cell);
  if (const Matrix *const K = is_box ? &of_box(cell, none) : known(cell, map))
  {
    for (unsigned int i = 0; i < result.size(); ++i)
      result[i] += (*K)(i, i);
    return result;
  }
  const CellGradients<dim> of_cell(tables.cell, map);
  const HookesLaw<dim> law = this->law(cell);
  for (unsigned int i = 0; i < tables.n_shapes; ++i)
  {
    Tensor<2, dim> products;
    for (unsigned int q = 0; q < of_cell.volumes.size(); ++q)
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          products[a][b] +=
              of_cell.volumes[q] * of_cell.gradients[a](q, i) * of_cell.gradients[b](q, i);
    for (unsigned int c = 0; c < dim; ++c)
      result[tables.numbers[i][c]] += law.stiffness(
          [&](const unsigned int a, const unsigned int b) { return products[a][b]; }, c, c);
  }
  return result;
}

template <int dim>
void BoxStiffness<dim>::multiply(const Cell &cell, Vector<double> &result,
                                 const Vector<double> &u) const
{
  multiply_body(cell, result, u);
  if (!foundation.holds(cell))
    return;
  const auto &numbers = space.tables.of(cell).numbers;
  CellField<dim> field(numbers.size());
  for (unsigned int i = 0; i < numbers.size(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      field[i][c] = u[numbers[i][c]];
  for (const SpringsOfFace<dim> &springs : foundation.below(cell))
  {
    const std::vector<Tensor<1, dim>> forces = springs.forces(field);
    for (unsigned int i = 0; i < forces.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        result[numbers[springs.shapes[i]][c]] += forces[i][c];
  }
}

/** Without springs. */
template <int dim>
void BoxStiffness<dim>::multiply_body(const Cell &cell, Vector<double> &result,
                                      const Vector<double> &u) const
{
  if (!space.scene.geometry.has_mesh())
    return of_box(cell, none).vmult(result, u);
  const CellMap<dim> map = map_of<dim>(cell);
  if (const Matrix *const K = known(cell, map))
    return K->vmult(result, u);
  const CellGradients<dim> of_cell(space.tables.of(cell).cell, map);
  const HookesLaw<dim> law = this->law(cell);
  const auto &numbers = space.tables.of(cell).numbers;
  result = 0;
  for (unsigned int q = 0; q < of_cell.volumes.size(); ++q)
  {
    Tensor<2, dim> gradient;
    for (unsigned int i = 0; i < numbers.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int a = 0; a < dim; ++a)
          gradient[c][a] += of_cell.gradients[a](q, i) * u[numbers[i][c]];
    const Tensor<2, dim> stress = of_cell.volumes[q] * Tensor<2, dim>(law.stress(gradient));
    for (unsigned int i = 0; i < numbers.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int a = 0; a < dim; ++a)
          result[numbers[i][c]] += of_cell.gradients[a](q, i) * stress[c][a];
  }
}

template <int dim>
unsigned int BoxStiffness<dim>::size_class(const Cell &cell) const
{
  const auto &cuts = space.scene.geometry.cuts;
  if (std::all_of(cuts.begin(), cuts.end(), [](const auto &lines) { return lines.empty(); }))
    return cell->level();
  const Tensor<1, dim> size = PrimalSpace<dim>::extent(cell);
  const auto known = std::find_if(sizes.begin(), sizes.end(),
                                  [&](const Tensor<1, dim> &other)
                                  {
                                    for (unsigned int d = 0; d < dim; ++d)
                                      if (std::abs(other[d] - size[d]) > same_box * size[d])
                                        return false;
                                    return true;
                                  });
  if (known == sizes.end())
  {
    sizes.push_back(size);
    return sizes.size() - 1;
  }
  return known - sizes.begin();
}

template FullMatrix<double> basis_of_moments(const PrimalSpace<2> &, const PrimalSpace<2>::Cell &);
template FullMatrix<double> basis_of_moments(const PrimalSpace<3> &, const PrimalSpace<3>::Cell &);
template class BoxStiffness<2>;
template class BoxStiffness<3>;
} // namespace hpvi
