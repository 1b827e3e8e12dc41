// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/level_transfer.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/mpi.templates.h>

#include <cmath>
#include <map>
#include <unordered_set>

namespace hpvi
{
using namespace dealii;

namespace
{
using Dof = types::global_dof_index;
using Cell = typename PrimalSpace<3>::Cell;
using AnyCell = typename Triangulation<3>::cell_iterator;
constexpr unsigned int same_cell = GeometryInfo<3>::max_children_per_cell;

/** Of the first component at each node; the others follow, see PrimalSpace. */
std::vector<Dof> bases_of(const PrimalSpace<3> &space, const AnyCell &cell)
{
  std::vector<Dof> dofs, result;
  const Cell own(*cell, &space.dof_handler);
  for (const auto &components : space.tables.take_dofs(own, dofs).numbers)
    result.push_back(dofs[components[0]]);
  return result;
}

/** Where a cell lies along the curve by which p4est shares cells among processes: its tree, by which deal.II calls it, then child by child. */
using Place = std::pair<unsigned int, std::vector<std::uint8_t>>;

Place place_of(const CellId &id)
{
  const auto children = id.get_child_indices();
  return {id.get_coarse_cell_id(), {children.begin(), children.end()}};
}

/** Processes that have cells, by the place of their first one. */
std::map<Place, unsigned int> owners_of(const PrimalSpace<3>::Mesh &mesh)
{
  std::vector<Place> first;
  for (const auto &cell : mesh.active_cell_iterators())
    if (cell->is_locally_owned())
      if (const Place place = place_of(cell->id()); first.empty() || place < first.front())
        first.assign(1, place);
  std::map<Place, unsigned int> result;
  const auto all = Utilities::MPI::all_gather(mesh.get_communicator(), first);
  for (unsigned int rank = 0; rank < all.size(); ++rank)
    for (const Place &place : all[rank])
      result[place] = rank;
  return result;
}

/** The active cell that is @p id or its parent, or where another process knows more, an ancestor. */
AnyCell cell_at(const PrimalSpace<3>::Mesh &mesh, const CellId &id)
{
  AnyCell cell = mesh.create_cell_iterator(CellId(id.get_coarse_cell_id(), {}));
  for (const std::uint8_t child : id.get_child_indices())
  {
    if (cell->is_active())
      break;
    cell = cell->child(child);
  }
  return cell;
}

/** What one process tells another of a cell of the fine mesh. */
using Message = std::pair<CellId::binary_type, std::vector<Dof>>;
using Messages = std::map<unsigned int, std::vector<Message>>;
} // namespace

struct LevelTransfer::Assembly
{
  std::vector<bool>
      is_taken; ///< nodes of this process, by the local element of the first component
  std::unordered_set<Dof> others;             ///< of other processes
  std::map<CellId, unsigned int> first_nodes; ///< of coarse cells that are reached more than once
  Messages messages;                          ///< by process
};

// Fine and coarse mesh grow from the same cells: both trees are gone down together.
LevelTransfer::LevelTransfer(const MultigridLevel<float> &coarse, const MultigridLevel<float> &fine)
    : coarse(coarse), fine(fine)
{
  for (const BoxTables<3> &tables : fine.space.tables.all)
    build_matrices(tables);
  Assembly assembly;
  assembly.is_taken.resize(fine.space.owned.n_elements());
  const auto &coarse_mesh =
      dynamic_cast<const PrimalSpace<3>::Mesh &>(coarse.space.dof_handler.get_triangulation());
  const std::function<void(const AnyCell &, const AnyCell &)> visit =
      [&](const AnyCell &above, const AnyCell &below)
  {
    if (!above->is_active())
    {
      for (unsigned int c = 0; c < above->n_children() && !below->is_active(); ++c)
        visit(above->child(c), below->child(c));
      return;
    }
    for (unsigned int c = 0; c < (below->is_active() ? 1 : same_cell); ++c)
    {
      const AnyCell own = below->is_active() ? below : below->child(c);
      if (!own->is_active() || !own->is_locally_owned())
        continue;
      const unsigned int child = below->is_active() ? same_cell : c;
      if (above->is_locally_owned())
        add_piece(assembly, Cell(*above, &coarse.space.dof_handler), child,
                  bases_of(fine.space, own));
    }
  };
  const auto &fine_mesh = fine.space.dof_handler.get_triangulation();
  for (auto above = coarse_mesh.begin(0), below = fine_mesh.begin(0); below != fine_mesh.end(0);
       ++above, ++below)
    visit(above, below);
  // Cells whose coarse cell, they themselves or their parent, is another process's.
  if (Utilities::MPI::n_mpi_processes(fine.space.communicator()) > 1)
  {
    const std::map<Place, unsigned int> owners = owners_of(coarse_mesh);
    for (const auto &cell : fine_mesh.active_cell_iterators())
      if (cell->is_locally_owned() && !cell_at(coarse_mesh, cell->id())->is_locally_owned())
        assembly.messages[std::prev(owners.upper_bound(place_of(cell->id())))->second].push_back(
            {cell->id().to_binary<3>(), bases_of(fine.space, cell)});
  }
  for (const auto &[rank, received] :
       Utilities::MPI::some_to_some(fine.space.communicator(), assembly.messages))
    for (const Message &message : received)
    {
      const CellId id(message.first);
      const AnyCell above = cell_at(coarse_mesh, id);
      const auto children = id.get_child_indices();
      AssertThrow(above->is_active() && above->is_locally_owned(), ExcInternalError());
      const bool is_same = static_cast<unsigned int>(above->level()) == children.size();
      add_piece(assembly, Cell(*above, &coarse.space.dof_handler),
                is_same ? same_cell : children[children.size() - 1], message.second);
    }
  share_rows();
}

void LevelTransfer::build_matrices(const BoxTables<3> &tables)
{
  const FE_Q<3> element(tables.degree);
  const unsigned int n_nodes = tables.n_shapes;
  const auto &points = element.get_unit_support_points();
  interpolations.emplace_back(same_cell + 1);
  Interpolation &interpolation = interpolations.back();
  for (unsigned int child = 0; child <= same_cell; ++child)
    for (unsigned int i = 0; i < n_nodes; ++i)
    {
      const Point<3> x = child == same_cell
                             ? points[i]
                             : GeometryInfo<3>::child_to_cell_coordinates(points[i], child);
      interpolation[child].emplace_back();
      for (unsigned int j = 0; j < n_nodes; ++j)
        if (const double value = element.shape_value(j, x); std::abs(value) > 1e-12)
          interpolation[child].back().emplace_back(j, value);
    }
}

unsigned int LevelTransfer::coarse_nodes(const Cell &cell)
{
  const unsigned int first = nodes.size();
  std::vector<Dof> dofs;
  const BoxTables<3> &tables = coarse.space.tables.take_dofs(cell, dofs);
  for (unsigned int i = 0; i < tables.n_shapes; ++i)
  {
    bool is_free = true;
    for (unsigned int c = 0; c < 3; ++c)
      is_free = is_free && !coarse.space.constraints.is_constrained(dofs[tables.numbers[i][c]]);
    if (is_free)
    {
      nodes.push_back(coarse.partitioner().global_to_local(dofs[tables.numbers[i][0]]));
      continue;
    }
    nodes.push_back(-1 - static_cast<int>(hanging.size()));
    hanging.emplace_back();
    for (unsigned int c = 0; c < 3; ++c)
      coarse.resolve(dofs[tables.numbers[i][c]], [&](const unsigned int local, const double weight)
                     { hanging.back()[c].emplace_back(local, weight); });
  }
  return first;
}

void LevelTransfer::add_piece(Assembly &assembly, const Cell &cell, const unsigned int child,
                              const std::vector<Dof> &bases)
{
  const auto [known, is_new] = assembly.first_nodes.try_emplace(cell->id());
  if (is_new)
    known->second = coarse_nodes(cell);
  Piece piece{known->second, coarse.space.tables.number_of(cell), child,
              static_cast<unsigned int>(rows.size()), 0};
  for (unsigned int i = 0; i < bases.size(); ++i)
  {
    bool is_new_node;
    if (fine.space.owned.is_element(bases[i]))
    {
      auto flag = assembly.is_taken[fine.space.owned.index_within_set(bases[i])];
      is_new_node = !flag;
      flag = true;
    }
    else
      is_new_node = assembly.others.insert(bases[i]).second;
    if (is_new_node)
      rows.push_back({bases[i], static_cast<unsigned short>(i), 1.f});
  }
  piece.end = rows.size();
  pieces.push_back(piece);
  add_links(cell, child, bases);
}

/** Fine contact dofs lie in squares of the coarse face, (p-1)^2 of them, each of which has one coarse contact dof. */
void LevelTransfer::add_links(const Cell &cell, const unsigned int child,
                              const std::vector<Dof> &bases)
{
  const BoxTables<3> &tables = coarse.space.tables.of(cell);
  const unsigned int n = tables.degree - 1;
  for (unsigned int number = 0; cell->at_boundary() && number < 6; ++number)
  {
    const ContactDofFace<3> *const face =
        cell->at_boundary(number) ? coarse.space.moment_face(cell, number) : nullptr;
    if (!face || (child != same_cell && ((child >> (number / 2)) & 1) != number % 2))
      continue;
    const auto axes = tangents<3>(number);
    for (unsigned int k = 0; k < tables.n_contact_dofs(); ++k)
    {
      unsigned int own = 0;
      for (unsigned int s = 2; s-- > 0;)
      {
        double x = tables.moment_points[number].points[k][axes[s]];
        if (child != same_cell)
          x = 0.5 * (x + ((child >> axes[s]) & 1));
        own = own * n + static_cast<unsigned int>(n * x);
      }
      const Dof base = bases[tables.inner[number][k]];
      if (face->has_friction())
        links.push_back(
            {face->friction + own, {{base + face->tangential(0), base + face->tangential(1)}}});
      if (face->has_pressure())
        links.push_back({face->pressure + own, {{base + face->normal(), base + face->normal()}}});
    }
  }
}

/** A vector with all nodes of the rows; those to which several processes add get a share from each. */
void LevelTransfer::share_rows()
{
  IndexSet others(fine.space.owned.size());
  std::vector<Dof> indices;
  for (const Row &row : rows)
    for (unsigned int c = 0; c < 3; ++c)
      if (!fine.space.owned.is_element(row.fine + c))
        indices.push_back(row.fine + c);
  for (const Link &link : links)
    for (const Dof dof : link.fine)
      if (!fine.space.owned.is_element(dof))
        indices.push_back(dof);
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  others.add_indices(indices.begin(), indices.end());
  buffer.reinit(fine.space.owned, others, fine.space.communicator());
  const auto &partitioner = *buffer.get_partitioner();
  for (Row &row : rows)
  {
    row.fine = partitioner.global_to_local(row.fine);
    buffer.local_element(row.fine) += 1;
  }
  for (Link &link : links)
    for (unsigned int &dof : link.fine)
      dof = partitioner.global_to_local(dof);
  buffer.compress(VectorOperation::add);
  buffer.update_ghost_values();
  for (Row &row : rows)
    row.weight = 1 / buffer.local_element(row.fine);
  buffer.zero_out_ghost_values();
}

void LevelTransfer::prolongate(Vector &fine_v, Vector &coarse_v) const
{
  coarse.transform().to_nodes(coarse_v);
  buffer = 0;
  std::vector<float> values;
  unsigned int loaded = numbers::invalid_unsigned_int;
  for (const Piece &piece : pieces)
  {
    const Interpolation &interpolation = interpolations[piece.tables];
    const unsigned int n_nodes = interpolation[same_cell].size();
    values.resize(3 * n_nodes);
    if (loaded != piece.coarse)
      for (unsigned int i = 0; i < n_nodes; ++i)
      {
        const int node = nodes[piece.coarse + i];
        for (unsigned int c = 0; c < 3; ++c)
          if (node >= 0)
            values[3 * i + c] = coarse_v.local_element(node + c);
          else
          {
            values[3 * i + c] = 0;
            for (const auto &[local, weight] : hanging[-1 - node][c])
              values[3 * i + c] += weight * coarse_v.local_element(local);
          }
      }
    loaded = piece.coarse;
    for (unsigned int r = piece.first; r < piece.end; ++r)
    {
      float sum[3] = {0, 0, 0};
      for (const auto &[node, weight] : interpolation[piece.child][rows[r].node])
        for (unsigned int c = 0; c < 3; ++c)
          sum[c] += weight * values[3 * node + c];
      for (unsigned int c = 0; c < 3; ++c)
        buffer.local_element(rows[r].fine + c) += rows[r].weight * sum[c];
    }
  }
  coarse_v.zero_out_ghost_values();
  buffer.compress(VectorOperation::add);
  fine_v.copy_locally_owned_data_from(buffer);
  fine.transform().to_moments(fine_v);
  fine.mask(fine_v);
}

void LevelTransfer::restrict_to(Vector &coarse_r, Vector &fine_r) const
{
  fine.mask(fine_r);
  fine.transform().to_moments_transposed(fine_r);
  buffer.copy_locally_owned_data_from(fine_r);
  buffer.update_ghost_values();
  coarse_r = 0;
  std::vector<float> values;
  for (unsigned int p = 0; p < pieces.size(); ++p)
  {
    const Piece &piece = pieces[p];
    const Interpolation &interpolation = interpolations[piece.tables];
    const unsigned int n_nodes = interpolation[same_cell].size();
    if (p == 0 || pieces[p - 1].coarse != piece.coarse)
      values.assign(3 * n_nodes, 0.f);
    for (unsigned int r = piece.first; r < piece.end; ++r)
      for (const auto &[node, weight] : interpolation[piece.child][rows[r].node])
        for (unsigned int c = 0; c < 3; ++c)
          values[3 * node + c] += weight * rows[r].weight * buffer.local_element(rows[r].fine + c);
    if (p + 1 < pieces.size() && pieces[p + 1].coarse == piece.coarse)
      continue;
    for (unsigned int i = 0; i < n_nodes; ++i)
    {
      const int node = nodes[piece.coarse + i];
      for (unsigned int c = 0; c < 3; ++c)
        if (node >= 0)
          coarse_r.local_element(node + c) += values[3 * i + c];
        else
          for (const auto &[local, weight] : hanging[-1 - node][c])
            coarse_r.local_element(local) += weight * values[3 * i + c];
    }
  }
  buffer.zero_out_ghost_values();
  coarse_r.compress(VectorOperation::add);
  coarse.transform().to_nodes_transposed(coarse_r);
  coarse.mask(coarse_r);
}

std::vector<ContactDofState<3>> LevelTransfer::coarse_states() const
{
  std::vector<ContactDofState<3>> result(coarse.space.contact.size());
  for (ContactDofState<3> &state : result)
    state.is_held = true;
  const auto tell = [this](const auto &number)
  {
    buffer = 0;
    for (unsigned int k = 0; k < fine.states.size(); ++k)
      for (unsigned int s = 0; s < fine.space.contact[k].n_unknowns(); ++s)
        buffer.local_element(fine.space.contact[k].unknowns[s]) = number(fine.states[k], s);
    buffer.update_ghost_values();
  };
  const auto slips = [](const ContactDofState<3> &state) { return state.is_held ? 0. : 1.; };
  tell([&](const ContactDofState<3> &state, unsigned int) { return 1 - slips(state); });
  for (const Link &link : links)
    result[link.coarse].is_held =
        result[link.coarse].is_held && buffer.local_element(link.fine[0]) > 0.5;
  tell([&](const ContactDofState<3> &state, const unsigned int s)
       { return slips(state) * state.stiffness[s][s]; });
  for (const Link &link : links)
    for (unsigned int s = 0; s < 2; ++s)
      result[link.coarse].stiffness[s][s] += buffer.local_element(link.fine[s]);
  tell([&](const ContactDofState<3> &state, unsigned int)
       { return slips(state) * state.stiffness[0][1]; });
  for (const Link &link : links)
    result[link.coarse].stiffness[0][1] += buffer.local_element(link.fine[0]);
  buffer.zero_out_ghost_values();
  return result;
}
} // namespace hpvi
