// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/input_error.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/text.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/space/spread_mesh.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
std::shared_ptr<typename MomentSpace<dim>::Mesh> spread_mesh(const Scene<dim> &scene,
                                                             MPI_Comm communicator)
{
  together(communicator, [&]() { check_primal_path(scene); });
  const auto mesh = std::make_shared<typename MomentSpace<dim>::Mesh>(communicator);
  make_mesh(scene, static_cast<Triangulation<dim> &>(*mesh));
  const auto n = hpvi::n_processes(communicator);
  if (mesh->n_global_active_cells() < n)
    throw InputError(printable(scene.origin(), 400) +
                     ": Geometry/Subdivisions: makes fewer cells, " +
                     std::to_string(mesh->n_global_active_cells()) + ", than the " +
                     std::to_string(n) + " processes; start fewer of them or take more cells");
  return mesh;
}

template std::shared_ptr<MomentSpace<2>::Mesh> spread_mesh(const Scene<2> &, MPI_Comm);
template std::shared_ptr<MomentSpace<3>::Mesh> spread_mesh(const Scene<3> &, MPI_Comm);
} // namespace hpvi
