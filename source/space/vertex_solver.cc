// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/algebraic_multigrid.h>
#include <hpvi/space/rigid_motions.h>
#include <hpvi/space/vertex_solver.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

namespace
{
using Dof = types::global_dof_index;
} // namespace

VertexSolver::VertexSolver(const MultigridLevel<float> &level)
    : level(level), linear(1), tables(linear.only()),
      dof_handler(level.space.dof_handler.get_triangulation()), inserted(level.space.contact.size())
{
  number();
  find_opposite();
  find_contact();
  assemble();
  level.reinit(change);
}

/** Corners, and for each node of this process a cell of this process that has it. */
void VertexSolver::number()
{
  const PrimalSpace<3> &space = level.space;
  linear.distribute_dofs(dof_handler);
  DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
  constraints.reinit(relevant);
  constrain_plates(space.scene, dof_handler, linear, relevant, constraints);
  std::set<Dof> on_plates; // first components
  collectively(space.communicator(),
               [&]()
               {
                 for (const SupportedNode<3> &node : plate_nodes(space.scene, dof_handler, linear))
                   on_plates.insert(node.dofs[0]);
               });
  for (const BoxTables<3> &of_level : space.tables.all)
  {
    first_weights.push_back(weights.size());
    for (const auto &components : of_level.numbers)
    {
      weights.emplace_back();
      for (unsigned int j = 0; j < 8; ++j)
        weights.back()[j] = GeometryInfo<3>::d_linear_shape_function(
            of_level.fe.unit_support_point(components[0]), j);
    }
  }
  std::vector<Dof> own, of_mesh;
  const auto corners = [&](const auto &cell)
  {
    linear.take_dofs(DoFHandler<3>::active_cell_iterator(*cell, &dof_handler), own);
    space.tables.take_dofs(cell, of_mesh);
  };
  std::vector<Dof> of_own_cells;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (!cell->is_artificial())
    {
      corners(cell);
      const auto &numbers = space.tables.of(cell).numbers;
      for (unsigned int j = 0; j < 8; ++j) // nodes at corners come first
        for (unsigned int c = 0; c < 3; ++c)
        {
          const Dof dof = own[tables.numbers[j][c]];
          if (space.constraints.is_constrained(of_mesh[numbers[j][c]]) &&
              !constraints.is_constrained(dof) && on_plates.count(own[tables.numbers[j][0]]) == 0)
            copy_constraint(cell, of_mesh, j, c, own);
          if (cell->is_locally_owned())
            of_own_cells.push_back(dof);
        }
    }
  constraints.close();
  for (const Dof dof : dof_handler.locally_owned_dofs())
    if (const auto *const line = constraints.get_constraint_entries(dof))
      for (const auto &entry : *line)
        of_own_cells.push_back(entry.first); // of a plate, on any process
  std::sort(of_own_cells.begin(),
            of_own_cells.end()); // one by one an IndexSet takes them in quadratic time
  IndexSet needed(dof_handler.n_dofs());
  needed.add_indices(of_own_cells.begin(), of_own_cells.end());
  residual.reinit(dof_handler.locally_owned_dofs(), needed, space.communicator());
  correction.reinit(residual);
  const auto local = [this](const Dof dof)
  { return residual.get_partitioner()->global_to_local(dof); };
  for (const Dof dof : dof_handler.locally_owned_dofs())
    if (constraints.is_constrained(dof))
    {
      constrained.push_back({local(dof), {}});
      for (const auto &[other, weight] : *constraints.get_constraint_entries(dof))
        constrained.back().others.emplace_back(local(other), weight);
    }
  std::vector<bool> is_taken(space.owned.n_elements());
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      corners(cell);
      cells.emplace_back();
      for (unsigned int j = 0; j < 8; ++j)
        cells.back().vertices[j] =
            residual.get_partitioner()->global_to_local(own[tables.numbers[j][0]]);
      const auto &numbers = space.tables.of(cell).numbers;
      const unsigned int first = first_weights[space.tables.number_of(cell)];
      for (unsigned int i = 0; i < numbers.size(); ++i)
        if (const Dof dof = of_mesh[numbers[i][0]]; space.owned.is_element(dof))
        {
          const unsigned int local = space.owned.index_within_set(dof);
          if (!is_taken[local])
            nodes.push_back({local, static_cast<unsigned short>(first + i)});
          is_taken[local] = true;
        }
      cells.back().end = nodes.size();
    }
}

/** Of a component at a corner, which is prescribed or depends on others there: no corner of the coarsest mesh hangs. */
void VertexSolver::copy_constraint(const PrimalSpace<3>::Cell &cell,
                                   const std::vector<Dof> &of_mesh, const unsigned int corner,
                                   const unsigned int component, const std::vector<Dof> &own)
{
  const PrimalSpace<3> &space = level.space;
  const Dof dof = own[tables.numbers[corner][component]];
  const auto &numbers = space.tables.of(cell).numbers;
  constraints.add_line(dof);
  for (const auto &[other, weight] :
       *space.constraints.get_constraint_entries(of_mesh[numbers[corner][component]]))
    for (unsigned int c = 0; c < 3; ++c)
      if (of_mesh[numbers[corner][c]] == other)
        constraints.add_entry(dof, own[tables.numbers[corner][c]], weight);
}

void VertexSolver::assemble()
{
  const PrimalSpace<3> &space = level.space;
  const IndexSet &owned = dof_handler.locally_owned_dofs();
  {
    IndexSet rows = relevant;
    for (const ContactFace &face : faces)
      for (const Dof dof : face.vertices)
        rows.add_range(dof, dof + 3);
    DynamicSparsityPattern pattern(rows);
    DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, false);
    for (const ContactFace &face : faces)
      for (const Dof row : face.vertices)
        for (const Dof column : face.vertices)
          for (unsigned int c = 0; c < 9; ++c)
            pattern.add(row + c / 3, column + c % 3);
    SparsityTools::distribute_sparsity_pattern(pattern, owned, space.communicator(), rows);
    A.reinit(owned, owned, pattern, space.communicator());
  }
  const Point<3> centre = space.scene.geometry.centre();
  const double length = space.scene.geometry.radius();
  const ElasticFoundation<3> foundation(space.scene, linear);
  motions.resize(owned.n_elements() * n_motions<3>);
  std::vector<Dof> dofs(tables.fe.dofs_per_cell);
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      cell->get_dof_indices(dofs);
      FullMatrix<double> K =
          tables.stiffness(HookesLaw<3>(space.scene.material_of(cell)), map_of<3>(cell));
      foundation.add_to(K, cell);
      constraints.distribute_local_to_global(K, dofs, A);
      for (unsigned int j = 0; j < 8; ++j)
        for (unsigned int c = 0; c < 3; ++c)
          if (const Dof dof = dofs[tables.numbers[j][c]];
              owned.is_element(dof) && !constraints.is_constrained(dof))
            for (unsigned int m = 0; m < n_motions<3>; ++m)
              motions[m * owned.n_elements() + owned.index_within_set(dof)] =
                  rigid_motion<3>(m, (cell->vertex(j) - centre) / length)[c];
    }
  A.compress(VectorOperation::add);
}

/** All processes are told of corners of masters, for which of them a slave asks is seen there. */
void VertexSolver::find_opposite()
{
  const PrimalSpace<3> &space = level.space;
  if (!space.opposite)
    return;
  constexpr unsigned int length =
      7; // cell, face, corners, and a bit for each component that is held
  std::vector<Dof> own, dofs(tables.fe.dofs_per_cell);
  for (const auto &cell : dof_handler.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      if (cell->is_locally_owned() && cell->at_boundary(face) &&
          space.is_opposite(cell->face(face)->boundary_id()))
      {
        cell->get_dof_indices(dofs);
        own.insert(own.end(), {cell->active_cell_index(), face, 0, 0, 0, 0, 0});
        for (unsigned int j = 0; j < 4; ++j)
          for (unsigned int c = 0; c < 3; ++c)
          {
            const Dof dof =
                dofs[tables.numbers[GeometryInfo<3>::face_to_cell_vertices(face, j)][c]];
            if (c == 0)
              *(own.end() - 5 + j) = dof;
            if (constraints.is_constrained(dof))
              own.back() |= 1u << (3 * j + c);
          }
      }
  const auto all = Utilities::MPI::all_gather(space.communicator(), own);
  std::map<std::array<Dof, 3>, const Dof *> corners; // by process, cell and face
  for (unsigned int process = 0; process < all.size(); ++process)
    for (const Dof *one = all[process].data(), *const end = one + all[process].size(); one != end;
         one += length)
      corners[{{process, one[0], one[1]}}] = one + 2;
  for (const MasterFace &master : space.opposite->masters)
  {
    const Dof *const vertices = corners.at({{master.process, master.cell, master.face}});
    for (unsigned int j = 0; j < 12; ++j)
      if (vertices[4] >> j & 1u)
        held.insert(vertices[j / 3] + j % 3);
    unsigned int i = 0;
    const BoxTables<3> &of_master = space.tables.all[master.tables];
    for (const auto *const shapes : {&of_master.rim[master.face], &of_master.inner[master.face]})
      for (const unsigned int shape : *shapes)
      {
        auto &weighted = opposite[master.nodes[i++].first];
        weighted.clear();
        for (unsigned int j = 0; j < 4; ++j)
          weighted.emplace_back(vertices[j],
                                weights[first_weights[master.tables] + shape]
                                       [GeometryInfo<3>::face_to_cell_vertices(master.face, j)]);
      }
  }
}

namespace
{
/** Of a face whose directions turn the mean of all three, near enough for what only precedes others. */
double mean_of(const OppositeFaces::Row &row, const ContactDofFace<3> &face, const unsigned int k)
{
  if (!face.is_curved())
    return row.moments[k];
  double sum = 0;
  for (unsigned int d = 0; d < 3; ++d)
    sum += row.turned[d * row.turned.size() / 3 + k] * face.direction(d, k);
  return sum / 3;
}
} // namespace

/** With the opposite sign. */
void VertexSolver::add_opposite(ContactFace &face) const
{
  const PrimalSpace<3> &space = level.space;
  std::map<Dof, unsigned int> places;
  for (const OppositeFaces::Row &row : (*space.opposite)[face.face - space.faces.data()].rows)
    for (const auto &[vertex, weight] : opposite.at(space.opposite->nodes[row.node].first))
    {
      const auto [place, is_new] = places.emplace(vertex, face.vertices.size());
      if (is_new)
        face.vertices.push_back(vertex);
      for (unsigned int k = 0; k < face.means.size(); ++k)
      {
        face.means[k].resize(face.vertices.size());
        face.means[k][place->second] -= weight * mean_of(row, *face.face, k);
      }
    }
}

void VertexSolver::find_contact()
{
  const PrimalSpace<3> &space = level.space;
  std::vector<Dof> dofs(tables.fe.dofs_per_cell);
  for (const ContactDofFace<3> &face : space.faces)
  {
    DoFHandler<3>::active_cell_iterator(*face.cell, &dof_handler)->get_dof_indices(dofs);
    faces.emplace_back();
    faces.back().face = &face;
    const FaceContactDofs &contact_dofs = space.contact_dofs_on(face);
    const BoxTables<3> &of_mesh = space.tables.of(face.cell);
    const unsigned int first = first_weights[space.tables.number_of(face.cell)];
    faces.back().means.resize(of_mesh.n_contact_dofs(), std::vector<double>(4));
    for (unsigned int j = 0; j < 4; ++j)
    {
      const unsigned int corner = GeometryInfo<3>::face_to_cell_vertices(face.face, j);
      faces.back().vertices.push_back(dofs[tables.numbers[corner][0]]);
      for (unsigned int c = 0; c < 3; ++c)
        if (const Dof dof = dofs[tables.numbers[corner][c]]; constraints.is_constrained(dof))
          held.insert(dof);
      for (unsigned int k = 0; k < faces.back().means.size(); ++k)
      {
        double &mean = faces.back().means[k][j] = 0;
        if (face.is_curved()) // near enough for what only precedes others
        {
          mean = GeometryInfo<3>::d_linear_shape_function(
              of_mesh.moment_points[face.face].points[k], corner);
          continue;
        }
        const auto add =
            [&](const FullMatrix<double> &matrix, const std::vector<unsigned int> &shapes)
        {
          for (unsigned int i = 0; i < shapes.size(); ++i)
            mean += matrix(k, i) * weights[first + shapes[i]][corner];
        };
        add(contact_dofs.M, of_mesh.inner[face.face]);
        add(contact_dofs.W, of_mesh.rim[face.face]);
      }
    }
    if (space.opposite)
      add_opposite(faces.back());
  }
}

/** S */
VertexSolver::Block VertexSolver::stiffness(const std::size_t k) const
{
  return level.states[k].is_held ? level.blocks[k] : level.states[k].stiffness;
}

/** The change of S since the last call, along @p components of the face. */
void VertexSolver::add(const ContactFace &face, const unsigned int k,
                       const std::vector<unsigned int> &components, const std::size_t contact_dof)
{
  const Block S = stiffness(contact_dof), change = S - inserted[contact_dof];
  inserted[contact_dof] = S;
  Tensor<2, 3> of_axes;
  for (unsigned int s = 0; s < components.size(); ++s)
    for (unsigned int t = 0; t < components.size(); ++t)
      of_axes += change[s][t] * outer_product(face.face->direction(components[s], k),
                                              face.face->direction(components[t], k));
  std::vector<Dof> dofs;
  std::vector<std::pair<unsigned int, unsigned int>> places; // of them: vertex and component
  for (unsigned int i = 0; i < face.vertices.size(); ++i)
    for (unsigned int c = 0; c < 3; ++c)
      if (held.count(face.vertices[i] + c) == 0)
      {
        dofs.push_back(face.vertices[i] + c);
        places.emplace_back(i, c);
      }
  FullMatrix<double> local(dofs.size(), dofs.size());
  for (unsigned int row = 0; row < dofs.size(); ++row)
    for (unsigned int column = 0; column < dofs.size(); ++column)
      local(row, column) = face.means[k][places[row].first] *
                           of_axes[places[row].second][places[column].second] *
                           face.means[k][places[column].first];
  A.add(dofs, local);
}

/** Of all contact dofs. */
void VertexSolver::add_contact()
{
  for (const ContactFace &face : faces)
    for (unsigned int k = 0; k < face.means.size(); ++k)
    {
      if (face.face->has_friction())
        add(face, k, {face.face->tangential(0), face.face->tangential(1)}, face.face->friction + k);
      if (face.face->has_pressure())
        add(face, k, {face.face->normal()}, face.face->pressure + k);
    }
  A.compress(VectorOperation::add);
}

// ML smooths by the matrix as it is: that changes when ML is set up, and not before.
void VertexSolver::linearise()
{
  const PrimalSpace<3> &space = level.space;
  std::vector<bool> is_held(level.states.size());
  types::global_dof_index changed = 0;
  for (unsigned int k = 0; k < is_held.size(); ++k)
  {
    is_held[k] = level.states[k].is_held;
    changed += amg && is_held[k] != was_held[k];
  }
  if (amg &&
      50 * Utilities::MPI::sum(changed, space.communicator()) <= space.n_discs + space.n_pressures)
    return;
  was_held = is_held;
  add_contact();
  std::vector<double> free_motions = motions; // ML scales them
  Teuchos::ParameterList parameters = algebraic_multigrid<3>(free_motions);
  amg = std::make_unique<TrilinosWrappers::PreconditionAMG>();
  amg->initialize(A, parameters);
}

void VertexSolver::correct(Vector &x, Vector &r) const
{
  level.mask(r);
  level.transform().to_moments_transposed(r);
  residual = 0;
  auto node = nodes.begin();
  for (const Cell &cell : cells)
    for (; node != nodes.begin() + cell.end; ++node)
      for (unsigned int j = 0; j < 8; ++j)
        if (const double weight = weights[node->shape][j]; weight != 0)
          for (unsigned int c = 0; c < 3; ++c)
            residual.local_element(cell.vertices[j] + c) +=
                weight * r.local_element(node->local + c);
  residual.compress(VectorOperation::add);
  for (const Constrained &one : constrained)
  {
    for (const auto &[other, weight] : one.others)
      residual.local_element(other) += weight * residual.local_element(one.element);
    residual.local_element(one.element) = 0;
  }
  if (!level.space.plates.empty()) // masters may be another process's
    residual.compress(VectorOperation::add);
  amg->vmult(correction, residual);
  if (!level.space.plates.empty())
    correction.update_ghost_values();
  for (const Constrained &one : constrained)
  {
    correction.local_element(one.element) = 0;
    for (const auto &[other, weight] : one.others)
      correction.local_element(one.element) += weight * correction.local_element(other);
  }
  correction.update_ghost_values();
  change = 0;
  node = nodes.begin();
  for (const Cell &cell : cells)
    for (; node != nodes.begin() + cell.end; ++node)
      for (unsigned int c = 0; c < 3; ++c)
      {
        double sum = 0;
        for (unsigned int j = 0; j < 8; ++j)
          sum += weights[node->shape][j] * correction.local_element(cell.vertices[j] + c);
        change.local_element(node->local + c) = sum;
      }
  correction.zero_out_ghost_values();
  level.transform().to_moments(change);
  level.mask(change);
  x += change;
}
} // namespace hpvi
