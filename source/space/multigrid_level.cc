// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/cell_basis.h>
#include <hpvi/space/multigrid_level.h>

#include <deal.II/fe/mapping_q1.h>
#include <deal.II/fe/mapping_q_cache.h>

#include <algorithm>
#include <map>
#include <type_traits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** C of a material: column by column the stress of one strain. */
GeneralStiffness stiffness_of(const Material &material)
{
  const HookesLaw<3> law(material);
  GeneralStiffness result;
  for (unsigned int k = 0; k < 3; ++k)
    for (unsigned int l = k; l < 3; ++l)
    {
      Tensor<2, 3> gradient;
      gradient[k][l] = 1;
      const SymmetricTensor<2, 3> sigma = law.stress(gradient);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          result[voigt<3>(i, j)][voigt<3>(k, l)] = sigma[i][j];
    }
  return result;
}

/** Of degree 2, which is exact, where there are curved cells. */
std::unique_ptr<const Mapping<3>> mapping_of(const Triangulation<3> &mesh)
{
  bool is_curved = false;
  for (const auto &cell : mesh.cell_iterators_on_level(0))
    is_curved = is_curved || cell->manifold_id() != numbers::flat_manifold_id;
  if (!is_curved)
    return std::make_unique<MappingQ1<3>>();
  const FE_Q<3> nodes(2);
  auto result = std::make_unique<MappingQCache<3>>(2);
  result->initialize(mesh,
                     [&](const Triangulation<3>::cell_iterator &cell)
                     {
                       const CellMap<3> map = map_of<3>(cell);
                       std::vector<Point<3>> points;
                       for (const Point<3> &node : nodes.get_unit_support_points())
                         points.push_back(map.point(node));
                       return points;
                     });
  return result;
}

/** Two constants a material where they say all, else 21. */
template <typename Number>
std::unique_ptr<CellOperator<Number>> make_cells(const PrimalSpace<3> &space,
                                                 const AffineConstraints<Number> &constraints)
{
  const auto mapping = mapping_of(space.dof_handler.get_triangulation());
  std::vector<IsotropicStiffness> isotropic;
  std::vector<GeneralStiffness> general;
  for (const Material &material : space.scene.materials)
  {
    general.push_back(stiffness_of(material));
    if (!material.orthotropy)
      isotropic.push_back({general.back()[0][1], general.back()[3][3]});
  }
  return isotropic.size() == general.size()
             ? make_cell_operator(*mapping, space.dof_handler, constraints, isotropic)
             : make_cell_operator(*mapping, space.dof_handler, constraints, general);
}
} // namespace

template <typename Number>
MultigridLevel<Number>::MultigridLevel(const PrimalSpace<3> &space)
    : space(space), states(space.contact.size())
{
  constraints.copy_from(space.constraints);
  cells = make_cells<Number>(space, constraints);
  reinit(scratch);
  contact_dofs = std::make_unique<ContactDofTransform<Number>>(space, scratch);
  for (const unsigned int i : cells->constrained())
    if (i < space.owned.n_elements())
      constrained.push_back(i);
  find_springs();
  if constexpr (std::is_same_v<Number, float>) // smoothers have no more digits
    find_entries(BoxStiffness<3>(space));
}

template <typename Number>
void MultigridLevel<Number>::reinit(Vector &v) const
{
  cells->reinit(v);
}

// Of a cell with hanging nodes an unknown J has `sum_ij w_iJ K_ij w_jJ`, over all nodes that depend on it; else K_JJ, if it
// is not prescribed.
template <typename Number>
void MultigridLevel<Number>::find_entries(const BoxStiffness<3> &stiffness)
{
  reinit(inverse_diagonal);
  blocks.resize(space.contact.size());
  std::vector<types::global_dof_index> dofs;
  const auto resolve = [&](const unsigned int i, const auto &take)
  { ContactDofTransform<Number>::resolve(space, inverse_diagonal, dofs[i], take); };
  const auto hangs = [this](const auto dof)
  {
    const auto *const line = space.constraints.get_constraint_entries(dof);
    return line && !line->empty();
  };
  std::vector<Number> far(space.opposite ? space.opposite->unknowns().size() : 0);
  for (const auto &cell : space.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    const bool has_moments = any(space.moment_components(cell));
    const FullMatrix<double> *const in_moments = has_moments ? &stiffness(cell) : nullptr;
    if (has_moments)
      set_blocks(cell, *in_moments);
    if (has_opposite(space, cell))
    {
      add_diagonal(cell, stiffness.nodal(cell), far);
      continue;
    }
    space.tables.take_dofs(cell, dofs);
    if (std::none_of(dofs.begin(), dofs.end(), hangs))
    {
      std::vector<double> diagonal;
      if (!has_moments)
        diagonal = stiffness.diagonal(cell);
      while (diagonal.size() < dofs.size())
        diagonal.push_back((*in_moments)(diagonal.size(), diagonal.size()));
      for (unsigned int i = 0; i < dofs.size(); ++i)
        resolve(i, [&](const unsigned int local, double)
                { inverse_diagonal.local_element(local) += diagonal[i]; });
      continue;
    }
    const FullMatrix<double> &K = has_moments ? *in_moments : stiffness(cell);
    std::map<unsigned int, std::vector<std::pair<unsigned int, double>>> shares;
    for (unsigned int i = 0; i < dofs.size(); ++i)
      resolve(i, [&](const unsigned int local, const double weight)
              { shares[local].emplace_back(i, weight); });
    for (const auto &[local, nodes] : shares)
    {
      double sum = 0;
      for (const auto &[i, w_i] : nodes)
        for (const auto &[j, w_j] : nodes)
          sum += w_i * K(i, j) * w_j;
      inverse_diagonal.local_element(local) += sum;
    }
  }
  inverse_diagonal.compress(VectorOperation::add);
  if (space.opposite)
    space.opposite->unknowns().add(far, inverse_diagonal.begin());
  for (unsigned int i = 0; i < inverse_diagonal.locally_owned_size(); ++i)
    inverse_diagonal.local_element(i) = 1 / inverse_diagonal.local_element(i);
  for (const unsigned int i : constrained)
    inverse_diagonal.local_element(i) = 0;
}

/** Of a cell of a slave with the nodes opposite; what is neither of this process nor beside it goes to @p far. */
template <typename Number>
void MultigridLevel<Number>::add_diagonal(const PrimalSpace<3>::Cell &cell,
                                          const FullMatrix<double> &K, std::vector<Number> &far)
{
  const CellBasis basis = cell_basis(space, cell);
  const std::vector<double> diagonal = basis.diagonal(K);
  for (unsigned int j = 0; j < diagonal.size(); ++j)
    if (const auto unknown = basis.unknowns[j];
        partitioner().in_local_range(unknown) || partitioner().is_ghost_entry(unknown))
      inverse_diagonal.local_element(partitioner().global_to_local(unknown)) += diagonal[j];
    else
      far[space.opposite->unknowns().place(unknown)] += diagonal[j];
}

/** Contact dofs belong to one cell. */
template <typename Number>
void MultigridLevel<Number>::set_blocks(const PrimalSpace<3>::Cell &cell,
                                        const FullMatrix<double> &K)
{
  for (const unsigned int number_of_face : cell->face_indices())
  {
    const ContactDofFace<3> *const own = space.moment_face(cell, number_of_face);
    if (!own)
      continue;
    const ContactDofFace<3> &face = *own;
    const BoxTables<3> &tables = space.tables.of(face.cell);
    const auto number = [&](const unsigned int k, const unsigned int axis)
    { return tables.numbers[tables.inner[face.face][k]][axis]; };
    for (unsigned int k = 0; k < tables.n_contact_dofs(); ++k)
    {
      for (unsigned int s = 0; face.has_friction() && s < 2; ++s)
        for (unsigned int t = 0; t <= s; ++t)
          blocks[face.friction + k][s][t] =
              K(number(k, face.tangential(s)), number(k, face.tangential(t)));
      if (const unsigned int i = number(k, face.normal()); face.has_pressure())
        blocks[face.pressure + k] = K(i, i) * unit_symmetric_tensor<2>();
    }
  }
}

template <typename Number>
void MultigridLevel<Number>::find_springs()
{
  const ElasticFoundation<3> foundation(space.scene, space.tables);
  std::vector<types::global_dof_index> dofs;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && foundation.holds(cell))
    {
      const BoxTables<3> &tables = space.tables.take_dofs(cell, dofs);
      for (SpringsOfFace<3> &face : foundation.below(cell))
      {
        springs.push_back({std::move(face), {}});
        for (const unsigned int shape : springs.back().of_face.shapes)
          for (unsigned int c = 0; c < 3; ++c)
          {
            auto &elements = springs.back().nodes.emplace_back();
            resolve(dofs[tables.numbers[shape][c]],
                    [&](const unsigned int local, const double weight)
                    { elements.emplace_back(local, weight); });
          }
      }
    }
}

/** What springs do where nodes move by x, as the product with cells does. */
template <typename Number>
void MultigridLevel<Number>::add_springs(Vector &y, Vector &x) const
{
  const bool knows_neighbours = x.has_ghost_elements();
  x.update_ghost_values();
  CellField<3> u;
  for (const Springs &face : springs)
  {
    const std::vector<unsigned int> &shapes = face.of_face.shapes;
    u.resize(shapes.back() + 1);
    for (unsigned int i = 0; i < face.nodes.size(); ++i)
    {
      double sum = 0;
      for (const auto &[local, weight] : face.nodes[i])
        sum += weight * x.local_element(local);
      u[shapes[i / 3]][i % 3] = sum;
    }
    const std::vector<Tensor<1, 3>> forces = face.of_face.forces(u);
    for (unsigned int i = 0; i < face.nodes.size(); ++i)
      for (const auto &[local, weight] : face.nodes[i])
        y.local_element(local) += weight * forces[i / 3][i % 3];
  }
  y.compress(VectorOperation::add);
  if (!knows_neighbours)
    x.zero_out_ghost_values();
}

template <typename Number>
void MultigridLevel<Number>::multiply(Vector &y, const Vector &x) const
{
  Vector &nodal = const_cast<Vector &>(x); // as it was when this returns
  contact_dofs->to_nodes(nodal, &kept);
  cells->multiply(y, nodal);
  if (space.scene.has_springs())
    add_springs(y, nodal);
  contact_dofs->restore(nodal, kept);
  contact_dofs->to_nodes_transposed(y);
}

template <typename Number>
void MultigridLevel<Number>::linearise(const std::vector<ContactDofState<3>> &new_states)
{
  states = new_states;
}

template <typename Number>
void MultigridLevel<Number>::vmult(Vector &y, const Vector &x) const
{
  multiply(y, x);
  for (unsigned int k = 0; k < states.size(); ++k)
  {
    const auto &contact_dof = space.contact[k];
    for (unsigned int s = 0; !states[k].is_held && s < contact_dof.n_unknowns(); ++s)
      for (unsigned int t = 0; t < contact_dof.n_unknowns(); ++t)
        y.local_element(contact_dof.unknowns[s]) +=
            states[k].stiffness[s][t] * x.local_element(contact_dof.unknowns[t]);
  }
  mask(y);
}

template <typename Number>
void MultigridLevel<Number>::mask(Vector &x) const
{
  for (const unsigned int i : constrained)
    x.local_element(i) = 0;
  for (unsigned int k = 0; k < states.size(); ++k)
    for (unsigned int s = 0; states[k].is_held && s < space.contact[k].n_unknowns(); ++s)
      x.local_element(space.contact[k].unknowns[s]) = 0;
}

template <typename Number>
void MultigridLevel<Number>::precondition(Vector &z, const Vector &r) const
{
  Assert(inverse_diagonal.size() > 0, ExcMessage("Only levels of floats are smoothed."));
  const unsigned int n = z.locally_owned_size();
  Number *const to = z.begin();
  const Number *const from = r.begin(), *const factor = inverse_diagonal.begin();
  for (unsigned int i = 0; i < n; ++i)
    to[i] = factor[i] * from[i];
  for (unsigned int k = 0; k < states.size(); ++k)
  {
    const auto &contact_dof = space.contact[k];
    if (states[k].is_held || states[k].stiffness.norm() == 0)
      continue;
    const Block inverse = invert(blocks[k] + states[k].stiffness);
    for (unsigned int s = 0; s < contact_dof.n_unknowns(); ++s)
    {
      Number sum = 0;
      for (unsigned int t = 0; t < contact_dof.n_unknowns(); ++t)
        sum += inverse[s][t] * from[contact_dof.unknowns[t]];
      to[contact_dof.unknowns[s]] = sum;
    }
  }
  mask(z);
}

template class MultigridLevel<double>;
template class MultigridLevel<float>;
} // namespace hpvi
