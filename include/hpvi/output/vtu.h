// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_vtu_h
#define hpvi_vtu_h

#include <hpvi/driver/step_report.h>

#include <string>
#include <vector>

namespace hpvi
{
/** The solution of one step as VTK reads it. */
struct Vtu
{
  std::string piece; ///< `solution-NN.vtu`, or `solution-NN.RANK.vtu`: the cells of this process
  std::string index; ///< `solution-NN.pvtu`, which names all pieces; empty where there is one
};

/**
 * Displacement and stress at points, degree and eta_K of cells: each cell of the mesh is a Lagrange cell of VTK of the degree that u_N has
 * there, up to 8, so that on affine cells these fields are those of u_N to the digits of a float. @p pieces: the names of the files
 * by process.
 */
template <int dim>
Vtu vtu(const StepReport<dim> &step, const std::vector<std::string> &pieces);
} // namespace hpvi

#endif
