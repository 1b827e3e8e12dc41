// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/springs.h>

namespace hpvi
{
using namespace dealii;

namespace
{
FullMatrix<double> matrix_of(const Scene<2> &scene, const DisplacementSpace<2> &space,
                             const DoFHandler<2>::active_cell_iterator &cell,
                             const unsigned int face, const ShapeTables<2> &tables,
                             const std::vector<unsigned int> &shapes)
{
  const BoundaryCondition<2> &boundary = scene.boundaries[cell->face(face)->boundary_id()];
  const CellMap<2> map = map_of<2>(cell);
  const unsigned int degree = space.degrees()[cell->active_cell_index()], n = degree + 1;
  const ShapesOfRule at_points(space.rules().spring(cell, face, degree), face, degree, tables);
  const ShapeTable<2> &table = at_points.table;
  FullMatrix<double> result(2 * n, 2 * n);
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Tensor<1, 2> normal = map.normal(face, table.points[q]);
    const Tensor<2, 2> k = boundary.spring.stiffness(map.point(table.points[q]), normal);
    const double ds = table.weights[q] * map.face_measure(face, table.points[q]) *
                      scene.circumference(map.point(table.points[q]));
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
                                     const ShapeTables<dim> &tables)
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
        face.matrix = matrix_of(scene, space, cell, f, tables, shapes);
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
                                              const ShapeTables<2> &);
} // namespace hpvi
