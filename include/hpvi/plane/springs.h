// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_springs_h
#define hpvi_springs_h

#include <hpvi/plane/displacement_space.h>
#include <hpvi/plane/shape_tables.h>
#include <hpvi/scene/scene.h>

#include <vector>

namespace hpvi
{
/** An edge of the mesh on an elastic foundation. */
struct SpringFace
{
  dealii::types::boundary_id boundary;
  unsigned int cell, face; ///< by active cell index, and there
  std::vector<dealii::types::global_dof_index>
      dofs;                          ///< component by component, each along the edge
  dealii::FullMatrix<double> matrix; ///< int k_n v_n w_n + k_t v_t w_t of two of their functions
};

/** All of a mesh, by the rules of @p space. */
template <int dim>
std::vector<SpringFace> spring_faces(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                                     const ShapeTables<dim> &tables);

/** What springs add to a(u, v_i) and to a(u, u): `int k_n u_n v_n + k_t u_t v_t`; of all boundaries, or of one. */
double
add_spring_forces(const std::vector<SpringFace> &faces, const dealii::Vector<double> &u,
                  dealii::Vector<double> &forces,
                  dealii::types::boundary_id boundary = dealii::numbers::invalid_boundary_id);
} // namespace hpvi

#endif
