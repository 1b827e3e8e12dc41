// SPDX-License-Identifier: LGPL-2.1-or-later

// The form $b(v,z)$ couples displacement and multiplier. In the thesis it carries the friction
// bound, $\int g\,\mu\,v_t$; here $z$ is the traction $g\lambda$ itself and $g$ stands in the
// feasible set, so that
//
// $$b(v, z) = \int_{\Gamma_C} z_t\, v_t\, ds + \int_{\Gamma_C} z_n\, v_n\, ds$$
//
// knows nothing of laws: the same rows serve Tresca, Coulomb and unilateral contact.
//
// A contact edge of degree $p$ has $p-1$ nodes inside. They belong to one cell, never hang, and no
// other edge sees them. As many multipliers live on the edge, so the nodal values inside can give
// way to <i>moments</i>, $m_i = \int \psi_i u_t / w_i$ with $\psi_i$ the multiplier's Lagrange
// basis at the Gauss points and $w_i = \int\psi_i$. In these unknowns $B$ is the diagonal matrix of
// the weights $w_i$. Nothing is lost, the change of basis has a condition of 1.8 at $p = 14$, and
// everything that comes after becomes simple.
#include <hpvi/plane/contact_operator.h>

#include <numeric>

namespace hpvi
{
using namespace dealii;

// @sect3{Rows of one edge}
//
// The integrand has degree $2p-2$; one Gauss rule integrates it exactly. On a straight edge the
// direction is constant, but the frame is asked at each point: nobody else needs to know where a
// normal comes from. Along a curve $n\,ds$ is a polynomial of degree $p-1$. There the rule goes
// without it, as that of the stiffness does, but between two bodies, of which the other has the same
// integral by another rule.
namespace
{
std::vector<double> coordinates(const std::vector<Point<1>> &points)
{
  std::vector<double> result;
  for (const Point<1> &point : points)
    result.push_back(point[0]);
  return result;
}

/** `int psi_i phi_j d_c` for the multiplier's basis psi and the edge's shape functions phi, by Gauss. */
template <int dim>
FullMatrix<double> moment_rows(const ContactFace<dim> &face, const unsigned int n,
                               Tensor<1, dim> ContactFrame<dim>::*const direction,
                               const ShapeTables<dim> &tables)
{
  // psi_i phi_j has degree 2p - 2 for the thesis's offset, 2p + offset in general.
  const unsigned int p = face.degree, n_gauss = face.segments.empty() || !face.map.is_curved()
                                                    ? std::max(p, n) + 1
                                                    : (n + 2 * p + 1) / 2 + 1;
  const EdgeTable &table = tables.edge(p, n, n_gauss);
  FullMatrix<double> B(n, dim * (p + 1));
  for (unsigned int q = 0; q < n_gauss; ++q)
  {
    const ContactFrame<dim> frame = face.frame(tables.gauss(n_gauss).point(q)[0]);
    const double weight = tables.gauss(n_gauss).weight(q) * frame.measure;
    for (unsigned int i = 0; i < B.m(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int j = 0; j <= p; ++j)
          B(i, c * (p + 1) + j) +=
              weight * table.multipliers(q, i) * table.shapes(q, j) * (frame.*direction)[c];
  }
  return B;
}

// @sect3{The body opposite}
//
// Where two bodies touch, the multiplier works on the jump $[u] = u_s - u_m$. It lives on the edges
// of the slave, and opposite to one of them several edges of the master may end: the integrand is a
// polynomial on each segment between, no further. With segments, uniform pressure goes from any mesh
// to any other to the last digit; with the slave's own Gauss points 0.1 % to 50 % of it would be lost.
//
// Where sides are curved, or at an angle to each other, X is no affine map. Along concentric circles it still is, in the angle by
// which both edges run, and the rule is exact; elsewhere the composition with X is smooth, and some points more than polynomials
// of both degrees ask for leave less than the error of the discretisation.
/** `int psi_i phi'_j d_c` over the segments of an edge, with the edge shape functions phi' of the master. */
template <int dim>
void add_master_rows(const ContactFace<dim> &face, const unsigned int n,
                     Tensor<1, dim> ContactFrame<dim>::*const direction,
                     const DisplacementSpace<dim> &space, const ShapeTables<dim> &tables,
                     typename ContactOperator<dim>::Rows &rows)
{
  std::vector<FullMatrix<double>> blocks;
  const std::vector<double> nodes = coordinates(tables.gauss(n).get_points());
  for (const ContactSegment<dim> &segment : face.segments)
  {
    const unsigned int p = segment.degree;
    const QGauss<1> &gauss =
        tables.gauss(segment.drawn ? (n + p + face.degree) / 2 + 4 : (n + p) / 2 + 1);
    const std::vector<double> edge_nodes = coordinates(tables.gauss_lobatto(p + 1).get_points());
    FullMatrix<double> &block = blocks.emplace_back(n, dim * (p + 1));
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double width = segment.end - segment.begin,
                   s = segment.begin + width * gauss.point(q)[0];
      const ContactFrame<dim> frame = face.frame(s);
      const double weight = width * gauss.weight(q) * frame.measure;
      const std::vector<double> psi = lagrange_basis(nodes, s),
                                phi = lagrange_basis(edge_nodes, segment.opposite(s));
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int j = 0; j <= p; ++j)
            block(i, c * (p + 1) + j) += weight * psi[i] * phi[j] * (frame.*direction)[c];
    }
    for (const unsigned int i : tables.numbering(p).edge[segment.face_no])
      rows.master_dofs.push_back(space.cell_dofs(segment.cell->active_cell_index())[i]);
  }
  rows.master.reinit(n, rows.master_dofs.size());
  unsigned int first = 0;
  for (const FullMatrix<double> &block : blocks)
  {
    rows.master.fill(block, 0, first);
    first += block.n();
  }
}

// @sect3{Pressure at nodes}
//
// The thesis asks for $u_n \le u_0$ at the Gauss-Lobatto points (3.67). These are the nodes of the
// edge; the multiplier of such a condition times its weight is the reaction of a node, and its row
// is a single weight.
/** `w_k n` at the node of each pressure, w_k the Gauss-Lobatto weight on this face. */
template <int dim>
FullMatrix<double> node_rows(const ContactFace<dim> &face, const ShapeTables<dim> &tables)
{
  const unsigned int n_nodes = face.degree + 1;
  const QGaussLobatto<1> &rule = tables.gauss_lobatto(n_nodes);
  FullMatrix<double> B(face.pressures.size(), dim * n_nodes);
  for (unsigned int k = 0, i = 0; k < n_nodes && i < B.m(); ++k)
    if (face.normal_points[i] == rule.point(k)[0])
    {
      const ContactFrame<dim> frame = face.node_frame(face.normal_points[i]);
      for (unsigned int c = 0; c < dim; ++c)
        B(i, c * n_nodes + k) = rule.weight(k) * frame.measure * frame.normal[c];
      ++i;
    }
  return B;
}

// @sect3{Which edges take moments}
//
// Three conditions: as many multipliers as nodes inside, nodes that no support holds, and one normal:
// along a curve each moment has a share of both components. Other edges keep nodal values and general
// rows.
/** May the nodes inside the edge move, and are there as many of them as multipliers? */
template <int dim>
bool takes_moments(const ContactFace<dim> &face, const unsigned int n_multipliers)
{
  return n_multipliers + 1 == face.degree && !face.condition->has_displacement() &&
         !face.map.is_curved();
}

/** Of the measure along it, linear in s, beside its mean. */
template <int dim>
double slope(const ContactFace<dim> &face)
{
  const double begin = face.point(0.)[0], end = face.point(1.)[0];
  return face.is_axisymmetric ? (end - begin) / (end + begin) : 0.;
}
} // namespace

// @sect3{All rows}
//
// Edge by edge; a face may have friction, pressure, or both. Rows refer to nodal values.
// <code>Unknowns</code> turns them into moments where that is possible.
template <int dim>
ContactOperator<dim>::ContactOperator(const DisplacementSpace<dim> &displacement_space,
                                      const ContactSpace<dim> &contact_space,
                                      const ShapeTables<dim> &tables)
    : space(displacement_space), multipliers(contact_space)
{
  const auto moments = [&](const ContactFace<dim> &face, const unsigned int n) {
    return takes_moments(face, n) ? &tables.nodes_from_moments(face.degree, slope(face)) : nullptr;
  };
  for (const ContactFace<dim> &face : contact_space.faces())
  {
    std::vector<types::global_dof_index> dofs;
    for (const unsigned int i : tables.numbering(face.degree).edge[face.face_no])
      dofs.push_back(space.cell_dofs(face.cell->active_cell_index())[i]);
    if (const unsigned int n = face.n_multipliers; n > 0)
    {
      std::vector<unsigned int> own(n);
      std::iota(own.begin(), own.end(), face.first_multiplier);
      face_rows.push_back({&face,
                           Kind::friction,
                           own,
                           dofs,
                           moment_rows(face, n, &ContactFrame<dim>::tangent, tables),
                           {},
                           FullMatrix<double>(),
                           moments(face, n)});
      add_master_rows(face, n, &ContactFrame<dim>::tangent, space, tables, face_rows.back());
    }
    if (const unsigned int n = face.pressures.size(); n > 0 && face.at_nodes)
      face_rows.push_back({&face,
                           Kind::pressure,
                           face.pressures,
                           dofs,
                           node_rows(face, tables),
                           {},
                           FullMatrix<double>(),
                           nullptr});
    else if (n > 0)
    {
      face_rows.push_back({&face,
                           Kind::pressure,
                           face.pressures,
                           dofs,
                           moment_rows(face, n, &ContactFrame<dim>::normal, tables),
                           {},
                           FullMatrix<double>(),
                           moments(face, n)});
      add_master_rows(face, n, &ContactFrame<dim>::normal, space, tables, face_rows.back());
    }
  }
}

// @sect3{Both ways}
//
// $Bu$, the weighted mean displacements along the contact, and $B^Tz$, the nodal forces of
// tractions on it.
template <int dim>
Vector<double> ContactOperator<dim>::moments(const Vector<double> &u) const
{
  Vector<double> result(multipliers.n_multipliers());
  for (const Rows &rows : face_rows)
    for (unsigned int i = 0; i < rows.B.m(); ++i)
    {
      for (unsigned int j = 0; j < rows.B.n(); ++j)
        result[rows.multipliers[i]] += rows.B(i, j) * u[rows.dofs[j]];
      for (unsigned int j = 0; j < rows.master.n(); ++j)
        result[rows.multipliers[i]] -= rows.master(i, j) * u[rows.master_dofs[j]];
    }
  return result;
}

template <int dim>
Vector<double> ContactOperator<dim>::forces(const Vector<double> &z,
                                            const types::boundary_id only) const
{
  Vector<double> result(space.n_dofs());
  const auto is_asked_for = [only](const types::boundary_id id)
  { return only == numbers::invalid_boundary_id || only == id; };
  for (const Rows &rows : face_rows)
  {
    if (is_asked_for(rows.face->condition->id))
      for (unsigned int i = 0; i < rows.B.m(); ++i)
        for (unsigned int j = 0; j < rows.B.n(); ++j)
          result[rows.dofs[j]] += rows.B(i, j) * z[rows.multipliers[i]];
    if (!rows.face->segments.empty() && is_asked_for(rows.face->segments.front().boundary()))
      for (unsigned int i = 0; i < rows.B.m(); ++i)
        for (unsigned int j = 0; j < rows.master.n(); ++j)
          result[rows.master_dofs[j]] -= rows.master(i, j) * z[rows.multipliers[i]];
  }
  return result;
}

template <int dim>
const std::vector<typename ContactOperator<dim>::Rows> &ContactOperator<dim>::rows() const
{
  return face_rows;
}

template <int dim>
const ContactSpace<dim> &ContactOperator<dim>::contact_space() const
{
  return multipliers;
}

template class ContactOperator<2>;
} // namespace hpvi
