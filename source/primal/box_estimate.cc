// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/primal/box_estimate.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** One pass over the cells of this process. */
template <int dim>
class BoxResiduals
{
public:
  using Cell = typename MomentSpace<dim>::Cell;

  BoxResiduals(const MomentSpace<dim> &space, const DistributedVector &u,
               const std::vector<ContactVector<dim>> &lambda);
  ErrorEstimate compute();

private:
  double volume(const Cell &cell, const CellField<dim> &field) const;
  double jumps(const Cell &cell, unsigned int face, const CellField<dim> &field) const;
  double jump(const Cell &cell, unsigned int face, const BoxTable<dim> &table,
              const CellField<dim> &field, const Cell &other,
              const BoxTable<dim> &other_table) const;
  void add_boundary(const Cell &cell, unsigned int face, const CellField<dim> &field);

  Tensor<1, dim> traction(const Cell &cell, const BoxTable<dim> &table, unsigned int q,
                          const CellField<dim> &field, unsigned int face) const;
  Tensor<1, dim> contact_traction(const MomentFace<dim> &face, const Point<dim> &unit) const;
  double tension(const MomentFace<dim> &face) const;
  double penetration(const MomentFace<dim> &face, const CellField<dim> &field) const;

  const MomentSpace<dim> &space;
  const DistributedVector &u;
  const std::vector<ContactVector<dim>> &lambda;
  ErrorEstimate result;
  std::vector<BoxTable<dim>> fine_faces; ///< by face, with twice as many points as u_N has nodes
};

/** Which side of @p whole's centre does @p piece lie on? */
template <int dim, class Cell>
std::array<bool, dim> sides(const Cell &whole, const Cell &piece)
{
  std::array<bool, dim> above{};
  for (unsigned int d = 0; d < dim; ++d)
    above[d] = piece->center()[d] > whole->center()[d];
  return above;
}

template <int dim>
double longest_edge(const Tensor<1, dim> &size)
{
  return *std::max_element(size.begin_raw(), size.end_raw());
}

template <int dim>
BoxResiduals<dim>::BoxResiduals(const MomentSpace<dim> &space, const DistributedVector &u,
                                const std::vector<ContactVector<dim>> &lambda)
    : space(space), u(u), lambda(lambda)
{
  const unsigned int n_cells = space.dof_handler.get_triangulation().n_active_cells();
  for (auto *part : {&result.volume, &result.jumps, &result.neumann, &result.contact})
    part->assign(n_cells, 0.);
  if (!space.scene.has_unilateral_contact())
    return;
  for (auto *part : {&result.normal, &result.penetration, &result.tension})
    part->assign(n_cells, 0.);
  for (const unsigned int face : GeometryInfo<dim>::face_indices())
    fine_faces.push_back(space.tables.face_table(face, 2 * (space.tables.degree + 1)));
}

/** `int |div sigma + F|^2` */
template <int dim>
double BoxResiduals<dim>::volume(const Cell &cell, const CellField<dim> &field) const
{
  const HookesLaw<dim> law(space.scene.material_of(cell));
  const BoxTable<dim> &table = space.tables.cell;
  const Tensor<1, dim> size = MomentSpace<dim>::extent(cell);
  double sum = 0;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    Tensor<3, dim> second;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = 0; b < dim; ++b)
      {
        Tensor<1, dim> derivative;
        for (unsigned int i = 0; i < field.size(); ++i)
          derivative += table.second[a][b](q, i) * field[i];
        for (unsigned int c = 0; c < dim; ++c)
          second[c][a][b] = derivative[c] / (size[a] * size[b]);
      }
    Tensor<1, dim> residual = law.divergence_of_stress(second);
    for (unsigned int c = 0; c < dim; ++c)
      if (space.scene.body_force[c])
        residual[c] +=
            space.scene.body_force[c]->value(MomentSpace<dim>::point_of(cell, table.points[q]));
    sum += table.weights[q] * residual.norm_square();
  }
  return cell->measure() * sum;
}

template <int dim>
Tensor<1, dim> BoxResiduals<dim>::traction(const Cell &cell, const BoxTable<dim> &table,
                                           const unsigned int q, const CellField<dim> &field,
                                           const unsigned int face) const
{
  Tensor<1, dim> normal;
  normal[face / 2] = face % 2 == 0 ? -1. : 1.;
  return HookesLaw<dim>(space.scene.material_of(cell))
      .traction(gradient(table, q, field, MomentSpace<dim>::extent(cell)), normal);
}

/** Of half the traction's jump, over a face or the part of one that both cells share. */
template <int dim>
double BoxResiduals<dim>::jump(const Cell &cell, const unsigned int face,
                               const BoxTable<dim> &table, const CellField<dim> &field,
                               const Cell &other, const BoxTable<dim> &other_table) const
{
  const CellField<dim> other_field = space.field(other, u);
  double sum = 0;
  for (unsigned int q = 0; q < table.points.size(); ++q)
    sum += table.weights[q] * (0.5 * (traction(cell, table, q, field, face) -
                                      traction(other, other_table, q, other_field, face)))
                                  .norm_square();
  return sum * std::min(cell->face(face)->measure(), other->face(face ^ 1U)->measure());
}

template <int dim>
double BoxResiduals<dim>::jumps(const Cell &cell, const unsigned int face,
                                const CellField<dim> &field) const
{
  using Tables = BoxTables<dim>;
  const Tables &tables = space.tables;
  if (cell->neighbor(face)->is_active())
  {
    const Cell neighbor = cell->neighbor(face);
    return jump(cell, face, tables.faces[face], field, neighbor,
                cell->neighbor_is_coarser(face)
                    ? tables.quarters[Tables::part(face ^ 1U, sides<dim>(neighbor, cell))]
                    : tables.faces[face ^ 1U]);
  }
  double sum = 0;
  for (unsigned int s = 0; s < cell->face(face)->n_children(); ++s)
  {
    const Cell child = cell->neighbor_child_on_subface(face, s);
    sum += jump(cell, face, tables.quarters[Tables::part(face, sides<dim>(cell, child))], field,
                child, tables.faces[face ^ 1U]);
  }
  return sum;
}

/** The contact's traction `-g lambda - p n` at a point of a face; zero in components without a multiplier. */
template <int dim>
Tensor<1, dim> BoxResiduals<dim>::contact_traction(const MomentFace<dim> &face,
                                                   const Point<dim> &unit) const
{
  Tensor<1, dim> result;
  for (unsigned int k = 0; k < space.tables.n_moments(); ++k)
  {
    const double psi = space.tables.psi(k, face.face, unit);
    for (unsigned int s = 0; face.has_friction() && s < dim - 1; ++s)
      result[tangents<dim>(face.face)[s]] -=
          psi * space.contact[face.friction + k].bound * lambda[face.friction + k][s];
    if (face.has_pressure())
      result[face.face / 2] -=
          psi * space.contact[face.pressure + k].sign * lambda[face.pressure + k][0];
  }
  return result;
}

/** sigma n - G in the components that nothing holds; on contact without the traction that it exerts. */
template <int dim>
void BoxResiduals<dim>::add_boundary(const Cell &cell, const unsigned int face,
                                     const CellField<dim> &field)
{
  const BoundaryCondition<dim> &condition = space.condition(cell, face);
  const MomentFace<dim> *const moment_face = space.moment_face(cell, face);
  const BoxTable<dim> &table = space.tables.faces[face];
  Tensor<1, dim> squares;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    Tensor<1, dim> residual = traction(cell, table, q, field, face);
    if (moment_face)
      residual -= contact_traction(*moment_face, table.points[q]);
    for (unsigned int c = 0; c < dim; ++c)
    {
      if (condition.traction[c])
        residual[c] -=
            condition.traction[c]->value(MomentSpace<dim>::point_of(cell, table.points[q]));
      const bool is_held = condition.displacement[c] || (condition.holds_normal() && c == face / 2);
      squares[c] += is_held ? 0. : table.weights[q] * residual[c] * residual[c];
    }
  }
  squares *= cell->face(face)->measure();
  for (unsigned int c = 0; c < dim; ++c)
    (!condition.has_contact()                     ? result.neumann
     : c != face / 2                              ? result.contact
     : moment_face && moment_face->has_pressure() ? result.normal
                                                  : result.neumann)[cell->active_cell_index()] +=
        squares[c];
  if (moment_face && moment_face->has_pressure())
  {
    result.tension[cell->active_cell_index()] += tension(*moment_face);
    result.penetration[cell->active_cell_index()] += penetration(*moment_face, field);
  }
}

/** `|min(p, 0)|^2`, of a pressure that is positive at its Gauss points and need not be between them. */
template <int dim>
double BoxResiduals<dim>::tension(const MomentFace<dim> &face) const
{
  const BoxTable<dim> &table = space.tables.faces[face.face];
  double sum = 0;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    double pressure = 0;
    for (unsigned int k = 0; k < space.tables.n_moments(); ++k)
      pressure += space.tables.psi(k, face.face, table.points[q]) * lambda[face.pressure + k][0];
    sum += table.weights[q] * std::pow(std::min(pressure, 0.), 2);
  }
  return sum * face.cell->face(face.face)->measure();
}

/** `mu^2 |max(u_n - u_0, 0)|^2`, seen at twice as many points in each direction as u_N has nodes. */
template <int dim>
double BoxResiduals<dim>::penetration(const MomentFace<dim> &face,
                                      const CellField<dim> &field) const
{
  const BoundaryCondition<dim> &condition = space.condition(face.cell, face.face);
  const double mu = space.scene.material_of(face.cell).mu();
  const BoxTable<dim> &table = fine_faces[face.face];
  double sum = 0;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const double depth = space.contact[face.pressure].sign * value(table, q, field)[face.face / 2] -
                         condition.gap_at(MomentSpace<dim>::point_of(face.cell, table.points[q]));
    sum += table.weights[q] * std::pow(mu * std::max(depth, 0.), 2);
  }
  return sum * face.cell->face(face.face)->measure();
}

template <int dim>
ErrorEstimate BoxResiduals<dim>::compute()
{
  for (const Cell &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const unsigned int index = cell->active_cell_index();
      const double weight =
          longest_edge(MomentSpace<dim>::extent(cell)) / space.tables.degree; // h_K/p
      const CellField<dim> field = space.field(cell, u);
      result.volume[index] = weight * weight * volume(cell, field);
      for (const unsigned int face : cell->face_indices())
        if (cell->at_boundary(face))
          add_boundary(cell, face, field);
        else
          result.jumps[index] += weight * jumps(cell, face, field);
      result.neumann[index] *= weight;
      result.contact[index] *= weight;
      if (result.normal.empty())
        continue;
      result.normal[index] *= weight;
      result.tension[index] *= weight;
      result.penetration[index] /= weight;
    }
  return std::move(result);
}
} // namespace

template <int dim>
ErrorEstimate estimate_error(const MomentSpace<dim> &space, const DistributedVector &u,
                             const std::vector<ContactVector<dim>> &lambda)
{
  return BoxResiduals<dim>(space, u, lambda).compute();
}

template ErrorEstimate estimate_error(const MomentSpace<2> &, const DistributedVector &,
                                      const std::vector<ContactVector<2>> &);
template ErrorEstimate estimate_error(const MomentSpace<3> &, const DistributedVector &,
                                      const std::vector<ContactVector<3>> &);
} // namespace hpvi
