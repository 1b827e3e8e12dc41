// SPDX-License-Identifier: LGPL-2.1-or-later

// The residual indicator (4.44) to (4.51): how far $u_N$ and $\lambda_N$ are from satisfying the
// differential equation and the conditions at the boundary, cell by cell and edge by edge, each
// part in the $L^2$ norm and weighted so that the sum measures the error in energy:
//
// $$\eta_K^2 = \frac{h_K^2}{p_K^2} \|r_K\|^2 + \frac{h_K}{p_K} \sum_{E \subset \partial K} \|R_E\|^2.$$
//
// Where materials differ, residuals count as strains: those of a cell times $c_0/c_K$, $c$ the least
// stiffness of a material and $c_0$ that of the first, jumps between two cells times
// $2 c_0/(c_K + c_{K'})$. With the cell's own $c_K$ for the jumps, the soft side of an interface
// would see what the stiff one leaves, and the indicator would overestimate by 20.
//
// The print of (4.51) sums $\eta_K$ for $\eta_K^2$. Two parts of the weights are theory, one is
// practice: where $p$ is high the indicator overestimates, by a factor that grows with $p$.
#include <deal.II/base/symmetric_tensor.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/thread_pool.h>
#include <hpvi/plane/load_quadrature.h>
#include <hpvi/results/contact_residuals.h>
#include <hpvi/results/elastic_strain.h>
#include <hpvi/results/residual_estimator.h>
#include <hpvi/results/shared_points.h>
#include <hpvi/results/turned_divergence.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

// @sect3{One pass over the cells}
//
// The parts are kept apart: which one dominates says what is missing.
namespace
{
/**
 * d_a d_b u_c at a point, by the chain rule `D^2 u = J^-T (D_xi^2 u - grad u . D_xi^2 x) J^-1`: second derivatives on the
 * reference cell stand in the dim^2 rows behind those of physical_gradient(), @p hessian is that of the map.
 */
template <int dim>
Tensor<3, dim> second_derivatives(const std::vector<double> &derivatives,
                                  const unsigned int first_row, const unsigned int n_rows,
                                  const Tensor<2, dim> &gradient, const Tensor<3, dim> &hessian,
                                  const Tensor<2, dim> &inverse_jacobian)
{
  Tensor<3, dim> second;
  for (unsigned int c = 0; c < dim; ++c)
  {
    Tensor<2, dim> reference;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = 0; b < dim; ++b)
      {
        reference[a][b] = derivatives[c * n_rows + first_row + dim + a * dim + b];
        for (unsigned int k = 0; k < dim; ++k)
          reference[a][b] -= gradient[c][k] * hessian[k][a][b];
      }
    second[c] = transpose(inverse_jacobian) * reference * inverse_jacobian;
  }
  return second;
}

template <int dim>
class Residuals
{
public:
  using Cell = typename Field<dim>::Cell;

  explicit Residuals(const Field<dim> &field);
  ErrorEstimate compute();

private:
  void add_volume(const Cell &cell);
  bool sees_jump(const Cell &cell, unsigned int face) const;
  double jump(const Cell &cell, unsigned int face) const;
  void add_jump(const Cell &cell, const Cell &neighbor, double square)
  {
    const unsigned int one = cell->active_cell_index(), other = neighbor->active_cell_index();
    const double shared = 2 / (1 / softness[one] + 1 / softness[other]);
    for (const Cell &side : {cell, neighbor})
      if (const unsigned int own = side->active_cell_index(); side->is_locally_owned())
        result.jumps[own] += sizes[own] / degrees[own] * shared * square;
  }
  void add_boundary(const Cell &cell, unsigned int face);
  void add_contact(const FieldFace<dim> &face);
  void add_opposite(const FieldFace<dim> &face);
  void add_exerted(const OppositeResidual &residual);
  Tractions<dim> traction_of() const
  {
    return [this](const Cell &cell, const ShapeTable<dim> &table,
                  const std::vector<Tensor<1, dim>> &normals)
    { return tractions(cell, table, normals); };
  }

  FacePoints<dim> face_points(const Cell &cell, const unsigned int face,
                              const ShapeTable<dim> &table) const
  {
    return hpvi::face_points(maps[cell->active_cell_index()], face, table, scene.is_axisymmetric());
  }
  std::vector<Tensor<1, dim>> tractions(const Cell &cell, const ShapeTable<dim> &table,
                                        const std::vector<Tensor<1, dim>> &normals) const;
  /** Of u_N in an axisymmetric body, where they strain, else none. */
  std::vector<double> values(const unsigned int cell, const ShapeTable<dim> &table) const
  {
    return scene.is_axisymmetric() ? evaluate(table.values, coefficients[cell])
                                   : std::vector<double>();
  }
  double weight(unsigned int cell) const; ///< h_K/p_K c_0/c_K

  const Field<dim> &field;
  const Scene<dim> &scene;
  const ShapeTables<dim> &tables;
  std::vector<unsigned int> degrees;             ///< p_K, by active cell index
  std::vector<std::vector<double>> coefficients; ///< of u_N, by active cell index
  std::vector<double> sizes;                     ///< h_K, the longest edge
  std::vector<double> softness;                  ///< c_0/c_K of the materials' coercivities
  std::vector<CellMap<dim>> maps;
  ErrorEstimate result;
};

template <int dim>
Residuals<dim>::Residuals(const Field<dim> &field)
    : field(field), scene(field.scene), tables(field.tables)
{
  const unsigned int n_cells = field.dof_handler.get_triangulation().n_active_cells();
  for (auto *part : {&result.volume, &result.jumps, &result.neumann, &result.contact})
    part->assign(n_cells, 0.);
  if (scene.has_pressure())
    for (auto *part : {&result.normal, &result.penetration, &result.tension})
      part->assign(n_cells, 0.);
  if (scene.has_coulomb_friction())
    result.excess.assign(n_cells, 0.);
  coefficients.resize(n_cells);
  degrees.resize(n_cells);
  for (const Cell &cell : field.dof_handler.active_cell_iterators())
  {
    if (!cell->is_artificial())
    {
      degrees[cell->active_cell_index()] = field.degree(cell);
      coefficients[cell->active_cell_index()] = field.coefficients(cell);
    }
    maps.push_back(map_of<dim>(cell));
    sizes.push_back(maps.back().longest_edge());
    softness.push_back(scene.reference_coercivity() / scene.material_of(cell).coercivity(dim));
  }
}

template <int dim>
double Residuals<dim>::weight(const unsigned int cell) const
{
  return sizes[cell] / degrees[cell] * softness[cell];
}

// @sect3{Inside a cell}
//
// $r_K = -\mathrm{div}\,\sigma(u_N) - F$ (4.44) needs second derivatives of $u_N$. On a
// parallelogram they are those on the reference cell, transformed twice; on other quadrilaterals
// the second derivatives of the map come in.
/** -div sigma(u) - F at points. */
template <int dim>
void Residuals<dim>::add_volume(const Cell &cell)
{
  const unsigned int index = cell->active_cell_index(), p = degrees[index];
  const HookesLaw<dim> law(scene.material_of(cell));
  const ShapeTable<dim> &table = tables.cell(p, p + 1);
  const std::vector<double> u = values(index, table);
  const std::vector<double> derivatives = evaluate(table.derivatives, coefficients[index]);
  const unsigned int n_rows = table.derivatives.m();
  Tensor<2, dim> J, inverse;
  Tensor<3, dim> H;
  double sum = 0;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    if (q == 0 || !maps[index].is_affine())
    {
      J = maps[index].jacobian(table.points[q]);
      H = maps[index].hessian(table.points[q]);
      inverse = invert(J);
    }
    const unsigned int row = q * table.rows_per_point;
    const Tensor<2, dim> gradient = physical_gradient<dim>(derivatives, row, n_rows, inverse);
    const Tensor<3, dim> second =
        second_derivatives<dim>(derivatives, row, n_rows, gradient, H, inverse);
    Tensor<1, dim> residual = -law.divergence_of_stress(second);
    if (scene.has_initial_strain())
      residual += initial_stress_divergence(scene, cell, maps[index], table.points[q]);
    const Point<dim> x = maps[index].point(table.points[q]);
    if (scene.is_axisymmetric())
      residual -= turned_divergence(scene, cell, maps[index], table.points[q],
                                    vector_at<dim>(u, table.points.size(), q), gradient);
    if (scene.has_body_force())
      residual -= load_at<dim>(scene.body_force_in(cell), x);
    sum += table.weights[q] * std::abs(determinant(J)) * scene.circumference(x) *
           residual.norm_square();
  }
  result.volume[index] = sizes[index] / degrees[index] * weight(index) * sum;
}

// @sect3{Tractions}
//
// All residuals on edges are differences of tractions, $\sigma(u_N)\nu$ on one side against
// something on the other.
template <int dim>
std::vector<Tensor<1, dim>>
Residuals<dim>::tractions(const Cell &cell, const ShapeTable<dim> &table,
                          const std::vector<Tensor<1, dim>> &normals) const
{
  const unsigned int index = cell->active_cell_index();
  const HookesLaw<dim> law(scene.material_of(cell));
  const std::vector<double> derivatives = evaluate(table.derivatives, coefficients[index]);
  std::vector<Tensor<1, dim>> result(table.points.size());
  const std::vector<double> u = values(index, table);
  Tensor<2, dim> inverse;
  for (unsigned int q = 0; q < result.size(); ++q)
  {
    if (q == 0 || !maps[index].is_affine())
      inverse = invert(maps[index].jacobian(table.points[q]));
    const Tensor<2, dim> gradient = physical_gradient<dim>(derivatives, q * table.rows_per_point,
                                                           table.derivatives.m(), inverse);
    const ElasticStrain<dim> strain = elastic_strain(
        scene, cell->material_id(), maps[index], table.points[q],
        u.empty() ? Tensor<1, dim>() : vector_at<dim>(u, result.size(), q), gradient);
    result[q] = law.traction(strain.in_plane, normals[q], strain.hoop);
  }
  return result;
}

// @sect3{Between cells}
//
// Against the neighbour's traction: half the jump (4.45), and both cells get it with their own
// weights. At a hanging node each half of the long edge counts as an edge, and likewise each quarter of
// a face. Beside a cell of another process both look at the face, each for its own cell.
/** Is it seen from @p cell, its finer or first side, and does it matter to this process? */
template <int dim>
bool Residuals<dim>::sees_jump(const Cell &cell, const unsigned int face) const
{
  if (cell->face(face)->has_children())
    return false;
  const auto neighbor = cell->neighbor(face);
  return (cell->is_locally_owned() || neighbor->is_locally_owned()) &&
         (cell->neighbor_is_coarser(face) ||
          cell->active_cell_index() < neighbor->active_cell_index());
}

/** Its square over the face. */
template <int dim>
double Residuals<dim>::jump(const Cell &cell, const unsigned int face) const
{
  const Cell neighbor = cell->neighbor(face);
  const unsigned int index = cell->active_cell_index(), other = neighbor->active_cell_index();
  const unsigned int n_gauss = std::max(degrees[index], degrees[other]) + 1;
  const ShapeTable<dim> *other_table;
  if (cell->neighbor_is_coarser(face))
  {
    const auto [other_face, subface] = cell->neighbor_of_coarser_neighbor(face);
    other_table = &tables.subface(
        degrees[other], other_face,
        shared_subface(maps[index], face, maps[other], other_face, subface), n_gauss);
  }
  else
    other_table = &tables.face(degrees[other], cell->neighbor_of_neighbor(face), n_gauss);

  const ShapeTable<dim> &table = tables.face(degrees[index], face, n_gauss);
  const FacePoints<dim> points = face_points(cell, face, table);
  const std::vector<unsigned int> places =
      shared_points(maps[index], table, maps[other], *other_table);
  std::vector<Tensor<1, dim>> normals(points.normals.size());
  for (unsigned int q = 0; q < places.size(); ++q)
    normals[places[q]] = points.normals[q];
  const auto own = tractions(cell, table, points.normals),
             opposite = tractions(neighbor, *other_table, normals);
  double sum = 0;
  for (unsigned int q = 0; q < own.size(); ++q)
    sum += points.weights[q] * (0.5 * (own[q] - opposite[places[q]])).norm_square();
  return sum;
}

// @sect3{Under loads}
//
// Against the load and what springs exert. A component that a support prescribes has no residual, and a rigid plate none
// at all: whatever traction they need is their reaction, and the discrete equations balance what presses the plate.
template <int dim>
void Residuals<dim>::add_boundary(const Cell &cell, const unsigned int face)
{
  const auto &condition = scene.boundaries[cell->face(face)->boundary_id()];
  if (condition.plate)
    return;
  const unsigned int index = cell->active_cell_index();
  const ShapeTable<dim> &table = tables.face(degrees[index], face, degrees[index] + 1);
  const FacePoints<dim> points = face_points(cell, face, table);
  const auto own = tractions(cell, table, points.normals);
  const std::vector<double> u = evaluate(table.values, coefficients[index]);
  double sum = 0;
  for (unsigned int q = 0; q < own.size(); ++q)
  {
    const Point<dim> x = maps[index].point(table.points[q]);
    Tensor<1, dim> residual = own[q] - load_at<dim>(condition.traction, x);
    for (unsigned int c = 0; c < dim && condition.spring; ++c)
      residual += u[c * own.size() + q] * condition.spring.stiffness(x, points.normals[q])[c];
    if (condition.symmetry)
      residual -= (residual * points.normals[q]) * points.normals[q];
    for (unsigned int c = 0; c < dim; ++c)
      if (!condition.displacement[c])
        sum += points.weights[q] * residual[c] * residual[c];
  }
  result.neumann[index] += weight(index) * sum;
}

// @sect3{Along the contact}
//
// Against the multiplier: $\sigma_t + g\lambda_N$ (4.45). For unilateral contact the normal
// traction is compared with the pressure, and what the discrete conditions leave between their
// points is added: penetration, pressures below zero, friction beyond its cone. Penetration is a
// displacement and not a traction, so it is weighted the other way round, with $\mu^2 p_K/h_K$, $\mu$ the weight of its material.
/**
 * What the body's traction sigma n - G misses of that of the contact: along the tangents z_N, along the
 * normal the pressure of unilateral contact, or nothing where only friction acts.
 */
template <int dim>
void Residuals<dim>::add_contact(const FieldFace<dim> &face)
{
  const unsigned int index = face.cell->active_cell_index();
  const auto &condition = *face.condition;
  const ShapeTable<dim> &table = tables.face(face.degree(), face.face_no, face.degree() + 1);
  const auto own = tractions(face.cell, table, face_points(face.cell, face.face_no, table).normals);
  double tangential = 0, normal = 0, tension = 0, excess = 0;
  for (unsigned int q = 0; q < own.size(); ++q)
  {
    const FaceFrame<dim> frame = face.frame(table.points[q]);
    const ContactTraction<dim> contact = field.traction(face, table.points[q]);
    const double ds = table.weights[q] * frame.measure;
    const Tensor<1, dim> missing = own[q] - load_at<dim>(condition.traction, frame.x);
    for (unsigned int s = 0; s < dim - 1; ++s)
      tangential += ds * std::pow(missing * frame.tangents[s] + contact.friction[s], 2);
    normal += ds * std::pow(missing * frame.normal + contact.pressure, 2);
    tension += condition.is_unilateral() ? ds * std::pow(std::min(contact.pressure, 0.), 2) : 0.;
    if (condition.friction.knows_pressure())
      excess += ds * std::pow(std::max(0., size_of(frame.tangential(contact.friction)) -
                                               field.bound(face, table.points[q])),
                              2);
  }
  result.contact[index] += weight(index) * tangential;
  if (condition.contact == Contact::tangential)
    result.neumann[index] += weight(index) * normal;
  if (!condition.has_pressure())
    return;
  result.normal[index] += weight(index) * normal;
  result.tension[index] += weight(index) * tension;
  if (condition.friction.knows_pressure())
    result.excess[index] += weight(index) * excess;
  result.penetration[index] += penetration(face, field) / (sizes[index] / degrees[index]);
  add_opposite(face);
}

// Where another body lies opposite, its traction is compared with the multiplier, too, on each of its
// edges by itself: a body is refined for what it misses.
template <int dim>
void Residuals<dim>::add_opposite(const FieldFace<dim> &face)
{
  for (const OppositeResidual &residual : opposite_residuals<dim>(face, field, traction_of()))
  {
    result.contact[residual.cell] += weight(residual.cell) * residual.tangential;
    (face.condition->has_pressure() ? result.normal : result.neumann)[residual.cell] +=
        weight(residual.cell) * residual.normal;
  }
}

/** The same of a master in space. */
template <int dim>
void Residuals<dim>::add_exerted(const OppositeResidual &residual)
{
  result.contact[residual.cell] += weight(residual.cell) * residual.tangential;
  (scene.has_pressure() ? result.normal : result.neumann)[residual.cell] +=
      weight(residual.cell) * residual.normal;
}

template <int dim>
ErrorEstimate Residuals<dim>::compute()
{
  std::vector<Cell> cells; // that this process knows
  for (const Cell &cell : field.dof_handler.active_cell_iterators())
    if (!cell->is_artificial())
      cells.push_back(cell);
  constexpr double unseen = -1;
  std::vector<std::array<double, GeometryInfo<dim>::faces_per_cell>> jumps(cells.size());
  const auto look_at = [&](const unsigned int k)
  {
    const Cell &cell = cells[k];
    jumps[k].fill(unseen);
    if (cell->is_locally_owned())
      add_volume(cell);
    for (const unsigned int face : cell->face_indices())
      if (!cell->at_boundary(face))
        jumps[k][face] = sees_jump(cell, face) ? jump(cell, face) : unseen;
      else if (cell->is_locally_owned() &&
               !scene.boundaries[cell->face(face)->boundary_id()].has_contact())
        add_boundary(cell, face);
  };
  parallel_for_each(cells.size(), 8, look_at);
  for (unsigned int k = 0; k < cells.size(); ++k) // in order, for they belong to two cells
    for (const unsigned int face : cells[k]->face_indices())
      if (jumps[k][face] != unseen)
        add_jump(cells[k], cells[k]->neighbor(face), jumps[k][face]);
  for (const FieldFace<dim> &face : field.faces())
    add_contact(face);
  for (const OppositeResidual &residual : exerted_residuals<dim>(field, traction_of()))
    add_exerted(residual);
  if (dim == 2 && scene.has_pairs()) // where edges reach beyond the other body they are free
    for (const OppositeResidual &residual : free_residuals<dim>(field, traction_of()))
      result.neumann[residual.cell] +=
          weight(residual.cell) * (residual.tangential + residual.normal);
  return std::move(result);
}
} // namespace

template <int dim>
ErrorEstimate estimate_error(const Field<dim> &field)
{
  ErrorEstimate result;
  collectively(field.communicator(), [&]() { result = Residuals<dim>(field).compute(); });
  return result;
}

template ErrorEstimate estimate_error(const Field<2> &);
template ErrorEstimate estimate_error(const Field<3> &);
} // namespace hpvi
