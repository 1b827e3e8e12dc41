// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/multigrid.h>

#include <deal.II/multigrid/mg_transfer_global_coarsening.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

namespace
{
// Of degree 4 over a range of 30 it takes twice as many steps on adapted meshes, in more time (doc/space.md).
constexpr unsigned int smoothing_degree = 6;
constexpr double smoothing_range =
    40; ///< eigenvalues above the largest over this are the smoother's
/** Unknowns of the coarsest mesh; with twice as many a factorisation in each Newton step takes longer than all the rest. */
constexpr types::global_dof_index most_factorised = 1500;
/** Likewise where bodies touch, whose coarsest mesh has corners opposite to each other. */
constexpr types::global_dof_index most_factorised_of_bodies = 12000;
} // namespace

bool Multigrid::is_for(const PrimalSpace<3> &space)
{
  return std::all_of(space.tables.all.begin(), space.tables.all.end(),
                     [](const BoxTables<3> &tables) { return has_cell_operator(tables.degree); });
}

Multigrid::Multigrid(const PrimalSpace<3> &space) : finest(space)
{
  const auto meshes = MGTransferGlobalCoarseningTools::create_geometric_coarsening_sequence(
      space.dof_handler.get_triangulation());
  levels.resize(meshes.size());
  for (unsigned int l = 0; l < levels.size(); ++l)
  {
    Level &level = levels[l];
    level.mesh = meshes[l];
    if (l + 1 < levels.size())
      level.own_space = std::make_unique<PrimalSpace<3>>(
          space.scene, dynamic_cast<const PrimalSpace<3>::Mesh &>(*meshes[l]), space.tables);
    level.matrix =
        std::make_unique<MultigridLevel<float>>(level.own_space ? *level.own_space : space);
    for (Vector *const v : {&level.x, &level.b, &level.r})
      level.matrix->reinit(*v);
    if (l > 0)
      level.from_below = std::make_unique<LevelTransfer>(*levels[l - 1].matrix, *level.matrix);
  }
  if (levels.front().matrix->space.dof_handler.n_dofs() <=
      (space.opposite ? most_factorised_of_bodies : most_factorised))
    factors = std::make_unique<CoarseSolver>(*levels.front().matrix);
  else
    vertices = std::make_unique<VertexSolver>(*levels.front().matrix);
  finest.reinit(from);
  finest.reinit(to);
}

/** The largest eigenvalue is that without what is held and H, of which both make it smaller. */
void Multigrid::prepare(Level &level)
{
  Smoother::AdditionalData settings;
  settings.degree = smoothing_degree;
  settings.smoothing_range = smoothing_range;
  settings.preconditioner = std::make_shared<BlockJacobi<float>>(*level.matrix);
  settings.eig_cg_n_iterations =
      20; // 12 fall short on tapered cells, where the cycle was indefinite then
  level.smoother = std::make_unique<Smoother>();
  level.smoother->initialize(*level.matrix, settings);
  level.smoother->estimate_eigenvalues(level.b);
}

void Multigrid::linearise(const std::vector<ContactDofState<3>> &states)
{
  finest.linearise(states);
  for (unsigned int l = levels.size(); l-- > 0;)
  {
    if ((l > 0 || vertices) && !levels[l].smoother)
      prepare(levels[l]);
    levels[l].matrix->linearise(l + 1 == levels.size() ? states
                                                       : levels[l + 1].from_below->coarse_states());
  }
  factors ? factors->factor() : vertices->linearise();
}

void Multigrid::multiply(DistributedVector &y, const DistributedVector &x) const
{
  from.copy_locally_owned_data_from(x);
  finest.multiply(to, from);
  y.copy_locally_owned_data_from(to);
}

void Multigrid::multiply_linearised(DistributedVector &y, const DistributedVector &x) const
{
  from.copy_locally_owned_data_from(x);
  finest.vmult(to, from);
  y.copy_locally_owned_data_from(to);
}

void Multigrid::precondition(DistributedVector &z, const DistributedVector &r) const
{
  const Level &top = levels.back();
  top.b.copy_locally_owned_data_from(r);
  top.matrix->mask(top.b);
  cycle(levels.size() - 1);
  z.copy_locally_owned_data_from(top.x);
}

void Multigrid::cycle(const unsigned int l) const
{
  const Level &level = levels[l];
  if (l == 0 && factors)
  {
    factors->solve(level.x, level.b);
    return;
  }
  level.smoother->vmult(level.x, level.b);
  level.matrix->vmult(level.r, level.x);
  level.r.sadd(-1., 1., level.b);
  if (l == 0)
    vertices->correct(level.x, level.r);
  else
  {
    const Level &below = levels[l - 1];
    level.from_below->restrict_to(below.b, level.r);
    cycle(l - 1);
    level.from_below->prolongate(level.r, below.x);
    level.x += level.r;
  }
  level.smoother->step(level.x, level.b);
}
} // namespace hpvi
