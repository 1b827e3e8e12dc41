// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/body/cell_map.h>
#include <hpvi/discretisation/springs.h>

namespace hpvi
{
using namespace dealii;

const QGauss<1> &spring_rule(const BoundaryCondition<2> &boundary, const unsigned int degree,
                             const ShapeTables<2> &tables)
{
  const bool varies = (boundary.spring.normal && !is_constant<2>(boundary.spring.normal)) ||
                      (boundary.spring.tangential && !is_constant<2>(boundary.spring.tangential));
  return tables.gauss(degree + (varies ? 6 : 1));
}

namespace
{
FullMatrix<double> matrix_of(const Scene<2> &scene, const BoundaryCondition<2> &boundary,
                             const CellMap<2> &map, const unsigned int face,
                             const unsigned int degree, const ShapeTables<2> &tables,
                             const std::vector<unsigned int> &shapes, const unsigned int times)
{
  const QGauss<1> &rule = spring_rule(boundary, degree, tables);
  const ShapeTable<2> &table = tables.face(degree, face, times * rule.size());
  const unsigned int n = degree + 1;
  FullMatrix<double> result(2 * n, 2 * n);
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Tensor<1, 2> normal = map.normal(face, table.points[q]);
    const Tensor<2, 2> k = boundary.spring.stiffness(map.point(table.points[q]), normal);
    const double ds = table.weights[q] * map.face_measure(face, table.points[q]) *
                      scene.turn(map.point(table.points[q]));
    for (unsigned int i = 0; i < 2 * n; ++i)
      for (unsigned int j = 0; j < 2 * n; ++j)
        result(i, j) +=
            ds * k[i / n][j / n] * table.values(q, shapes[i % n]) * table.values(q, shapes[j % n]);
  }
  return result;
}
} // namespace

template <int dim>
std::vector<SpringFace> spring_faces(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                                     const ShapeTables<dim> &tables, const unsigned int times)
{
  static_assert(dim == 2, "two components along an edge");
  std::vector<SpringFace> result;
  if (!scene.has_springs())
    return result;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->at_boundary(f) && scene.boundaries[cell->face(f)->boundary_id()].spring)
      {
        const unsigned int index = cell->active_cell_index(), p = space.degrees()[index];
        const LocalNumbering &numbering = tables.numbering(p);
        const auto dofs = space.cell_dofs(index);
        SpringFace face{cell->face(f)->boundary_id(), index, f, {}, FullMatrix<double>()};
        std::vector<unsigned int> shapes;
        for (const unsigned int i : numbering.edge[f])
        {
          face.dofs.push_back(dofs[i]);
          shapes.push_back(numbering.shape[i]);
        }
        face.matrix = matrix_of(scene, scene.boundaries[face.boundary], map_of<dim>(cell), f, p,
                                tables, shapes, times);
        result.push_back(std::move(face));
      }
  return result;
}

double add_spring_forces(const std::vector<SpringFace> &faces, const Vector<double> &u,
                         Vector<double> &forces, const types::boundary_id boundary)
{
  double product = 0;
  for (const SpringFace &face : faces)
  {
    if (boundary != numbers::invalid_boundary_id && face.boundary != boundary)
      continue;
    Vector<double> local(face.dofs.size()), force(face.dofs.size());
    for (unsigned int i = 0; i < local.size(); ++i)
      local[i] = u[face.dofs[i]];
    face.matrix.vmult(force, local);
    product += force * local;
    for (unsigned int i = 0; i < local.size(); ++i)
      forces[face.dofs[i]] += force[i];
  }
  return product;
}

template std::vector<SpringFace> spring_faces(const Scene<2> &, const DisplacementSpace<2> &,
                                              const ShapeTables<2> &, unsigned int);
} // namespace hpvi
