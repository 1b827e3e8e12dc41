// SPDX-License-Identifier: LGPL-2.1-or-later

// Where meshes of two bodies do not match, the patches of one end inside edges of the other. What one hands over to the other is
// given there: tractions that the laws admit, polynomials on each edge of the slave, pieces of polynomials on those of the master. A
// displacement x makes up for what they miss of z_N, so that all patches of both bodies are in balance (doc/bound.md).
#include <hpvi/bound/joint_tractions.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/bound/pressed_face.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

double stiffness(const Solution<2> &solution, const DoFHandler<2>::active_cell_iterator &cell)
{
  return solution.scene.material_of(cell).residual_weight();
}

std::vector<JointEdge> joint_edges(const ContactSpace<2> &contact_space)
{
  const std::vector<ContactFace<2>> &faces = contact_space.faces();
  std::vector<JointEdge> slaves;
  std::map<std::pair<unsigned int, unsigned int>, JointEdge> masters;
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    JointEdge &slave = slaves.emplace_back(JointEdge{faces[k].cell, faces[k].face_no, true, {}});
    for (const ContactSegment<2> &segment : faces[k].segments)
    {
      slave.pieces.push_back({segment.begin, segment.end, k, segment.begin, segment.end,
                              segment.cell, segment.face_no, segment.at_begin, segment.at_end,
                              true});
      JointEdge &master = masters
                              .try_emplace({segment.cell->active_cell_index(), segment.face_no},
                                           JointEdge{segment.cell, segment.face_no, false, {}})
                              .first->second;
      JointPiece piece{
          segment.at_begin, segment.at_end, k,           segment.begin, segment.end, faces[k].cell,
          faces[k].face_no, segment.begin,  segment.end, true};
      if (piece.begin > piece.end)
      {
        std::swap(piece.begin, piece.end);
        std::swap(piece.at_begin, piece.at_end);
        std::swap(piece.other_begin, piece.other_end);
      }
      master.pieces.push_back(piece);
    }
    if (slave.pieces.empty())
      slave.pieces.push_back({0., 1., k, 0., 1., faces[k].cell, faces[k].face_no, 0., 1., false});
  }
  for (auto &[place, master] : masters)
  {
    std::sort(master.pieces.begin(), master.pieces.end(),
              [](const JointPiece &a, const JointPiece &b) { return a.begin < b.begin; });
    slaves.push_back(std::move(master));
  }
  return slaves;
}

namespace
{
/** sigma(u_N) at a point of a cell. */
SymmetricTensor<2, 2> stress_at(const Solution<2> &solution,
                                const DoFHandler<2>::active_cell_iterator &cell,
                                const Point<2> &reference)
{
  const unsigned int index = cell->active_cell_index();
  const CellMap<2> map = map_of<2>(cell);
  const ShapeTable<2> table =
      tabulate<2>(solution.displacement_space.degrees()[index], {reference}, {1.}, false);
  const std::vector<double> slopes = evaluate(table.derivatives, solution.coefficients(index));
  const HookesLaw<2> law(solution.scene.material_of(cell));
  SymmetricTensor<2, 2> result = law.stress(
      physical_gradient<2>(slopes, 0, table.derivatives.m(), invert(map.jacobian(reference))));
  if (solution.scene.has_initial_strain())
    result -= law.stress(solution.scene.initial_strain_in(cell, map.point(reference)));
  return result;
}

/** Of two bodies that must not part there; a rigid foundation has no multiplier then. */
bool is_joint(const ContactFace<2> &face)
{
  return !face.segments.empty() &&
         (face.condition->is_tied() || face.condition->contact == Contact::bilateral);
}
} // namespace

JointTractions::JointTractions(const Solution<2> &solution, const AdmissibleFriction<2> &friction,
                               const AdmissiblePressure<2> &pressure)
    : solution(solution), friction(friction), all(joint_edges(solution.contact_space)),
      parts(solution.contact_space.faces().size())
{
  for (unsigned int k = 0; k < all.size(); ++k)
    by_cell[{all[k].cell->active_cell_index(), all[k].face_no}] = k;
  for (unsigned int k = 0; k < parts.size(); ++k)
  {
    const ContactFace<2> &face = solution.contact_space.faces()[k];
    if (face.condition->is_unilateral())
      parts[k][0] = pressure.value(k);
    else if (is_joint(face))
      parts[k] = wanted(k);
    if (!face.condition->is_tied())
      parts[k][1] = {};
  }
  balance_moments();
}

const std::vector<JointEdge> &JointTractions::edges() const
{
  return all;
}

const JointEdge *JointTractions::edge(const unsigned int cell, const unsigned int face_no) const
{
  const auto found = by_cell.find({cell, face_no});
  return found == by_cell.end() ? nullptr : &all[found->second];
}

double JointTractions::pressure(const unsigned int face, const double s) const
{
  return parts[face][0](s);
}

Tensor<1, 2> JointTractions::value(const unsigned int k, const double s) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[k];
  const ContactFrame<2> frame = face.frame(s);
  const double bound = face.friction.vanishes() ? 0. : face.friction_bound(frame.x);
  return parts[k][0](s) * frame.normal +
         (parts[k][1](s) + (bound == 0. ? 0. : bound * friction.value(k, s))) * frame.tangent;
}

unsigned int JointTractions::degree(const unsigned int face) const
{
  std::size_t n = 1;
  for (unsigned int i = 0; i < 2; ++i)
    n = std::max({n, parts[face][i].coefficients().size(),
                  friction.part(face, i).coefficients().size() + 1});
  return n - 1;
}

unsigned int JointTractions::degree(const JointEdge &edge) const
{
  unsigned int result = 0;
  for (const JointPiece &piece : edge.pieces)
    result = std::max(result, degree(piece.face));
  return result;
}

std::vector<std::pair<double, double>> JointTractions::points(const JointPiece &piece,
                                                              const unsigned int more) const
{
  const FrictionRule &rule = solution.contact_space.faces()[piece.face].friction;
  std::vector<double> cuts = {0., 1.}; // along the piece
  for (const double cut : rule.cuts)
    if (const double at = (cut - piece.at_begin) / (piece.at_end - piece.at_begin);
        at > 0. && at < 1.)
      cuts.push_back(at);
  std::sort(cuts.begin(), cuts.end());
  const ContactFace<2> &face = solution.contact_space.faces()[piece.face];
  const QGauss<1> &gauss = solution.tables.gauss((degree(piece.face) + more) / 2 + 1 +
                                                 (varies(rule) || face.map.is_curved() ? 8 : 0));
  std::vector<std::pair<double, double>> result;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double width = cuts[k + 1] - cuts[k], at = cuts[k] + width * gauss.point(q)[0];
      result.emplace_back(piece.begin + at * (piece.end - piece.begin), width * gauss.weight(q));
    }
  return result;
}

/** Of degree p, along normal and tangent. */
std::array<EdgePolynomial, 2> JointTractions::wanted(const unsigned int k) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[k];
  const unsigned int n = face.degree + 1;
  std::array<std::vector<double>, 2> result{{std::vector<double>(n), std::vector<double>(n)}};
  for (const JointPiece &piece : all[k].pieces)
  {
    const double mu = stiffness(solution, face.cell),
                 opposite = piece.has_other ? stiffness(solution, piece.other) : 0.,
                 share = piece.has_other ? opposite / (mu + opposite) : 1.;
    const QGauss<1> &gauss = solution.tables.gauss(n + 2);
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double s = piece.begin + (piece.end - piece.begin) * gauss.point(q)[0],
                   weight = 2 * (piece.end - piece.begin) * gauss.weight(q);
      const ContactFrame<2> frame = face.frame(s);
      SymmetricTensor<2, 2> sigma =
          share * stress_at(solution, face.cell, point_on_face<2>(face.face_no, Point<1>(s)));
      if (piece.has_other)
        sigma += (1 - share) *
                 stress_at(solution, piece.other,
                           point_on_face<2>(piece.other_face, Point<1>(piece.on_other(s))));
      const Tensor<1, 2> traction = -(sigma * frame.normal);
      const Vector<double> L = legendre_basis(n, s);
      for (unsigned int i = 0; i < n; ++i)
      {
        result[0][i] += weight * L[i] * (traction * frame.normal);
        result[1][i] += weight * L[i] * (traction * frame.tangent);
      }
    }
  }
  result[0][0] = discrete_traction(face, solution, /*is_pressure=*/true).coefficients()[0];
  result[1][0] = discrete_traction(face, solution, /*is_pressure=*/false).coefficients()[0];
  return {{EdgePolynomial(result[0]), EdgePolynomial(result[1])}};
}

/** Along each side that cannot open: the moment that edges lack besides their means, by what is linear along each of them. */
void JointTractions::balance_moments()
{
  const std::vector<ContactFace<2>> &faces = solution.contact_space.faces();
  const auto first_moment = [](const EdgePolynomial &f)
  {
    const std::vector<double> c = f.coefficients();
    return c.size() > 1 ? c[1] : 0.;
  };
  // Along the side from its first face on, as each face runs or the other way.
  const auto along = [&](const unsigned int k, const unsigned int first)
  { return (faces[k].point(1.) - faces[k].point(0.)) * faces[first].frame(0.5).tangent; };
  for (unsigned int first = 0, end; first < faces.size(); first = end)
  {
    double missing = 0, lengths = 0;
    const bool is_open = !is_joint(faces[first]);
    for (end = first; end < faces.size() && faces[end].condition == faces[first].condition; ++end)
    {
      if (is_open)
        continue;
      const double run = along(end, first);
      missing += run * faces[end].length *
                 (first_moment(discrete_traction(faces[end], solution, /*is_pressure=*/true)) -
                  first_moment(parts[end][0]));
      lengths += run * run * faces[end].length;
    }
    for (unsigned int k = first; !is_open && k < end; ++k)
      parts[k][0] = parts[k][0] + EdgePolynomial({0., missing / lengths * along(k, first)});
  }
}

Vector<double> JointTractions::missing_forces() const
{
  Vector<double> result = solution.spaces->contact_operator.forces(solution.z);
  for (const JointEdge &edge : all)
  {
    const unsigned int cell = edge.cell->active_cell_index(),
                       p = solution.displacement_space.degrees()[cell], n = p + 1;
    const auto dofs = solution.displacement_space.cell_dofs(cell);
    const std::vector<unsigned int> &on_edge = solution.tables.numbering(p).edge[edge.face_no];
    std::vector<double> nodes;
    for (const Point<1> &node : solution.tables.gauss_lobatto(n).get_points())
      nodes.push_back(node[0]);
    for (const JointPiece &piece : edge.pieces)
    {
      const double width = std::abs(piece.at_end - piece.at_begin);
      for (const auto &[s, weight] : points(piece, p))
      {
        const double at = piece.on_slave(s),
                     ds = width * weight *
                          solution.contact_space.faces()[piece.face].frame(at).measure;
        const Tensor<1, 2> force = (edge.is_slave ? -1. : 1.) * ds * value(piece.face, at);
        const std::vector<double> phi = lagrange_basis(nodes, s);
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int j = 0; j < n; ++j)
            result[dofs[on_edge[c * n + j]]] += force[c] * phi[j];
      }
    }
  }
  return result;
}
} // namespace hpvi
