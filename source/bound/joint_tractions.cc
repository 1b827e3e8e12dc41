// SPDX-License-Identifier: LGPL-2.1-or-later

// Where meshes of two bodies do not match, the patches of one end inside edges of the other. What one hands over to the other is
// given there: tractions that the laws admit, polynomials on each edge of the slave, pieces of polynomials on those of the master. A
// displacement x makes up for what they miss of z_N, so that all patches of both bodies are in balance (doc/bound.md).
#include <hpvi/base/tolerances.h>
#include <hpvi/bound/cell_constants.h>
#include <hpvi/bound/joint_tractions.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/bound/pressed_face.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

double stiffness(const Solution<2> &solution, const DoFHandler<2>::active_cell_iterator &cell)
{
  return solution.scene.material_of(cell).residual_weight();
}

Tensor<1, 2> displacement_at(const Solution<2> &solution,
                             const DoFHandler<2>::active_cell_iterator &cell,
                             const unsigned int face_no, const double s)
{
  const unsigned int index = cell->active_cell_index(),
                     p = solution.displacement_space.degrees()[index];
  const auto dofs = solution.displacement_space.cell_dofs(index);
  const std::vector<unsigned int> &on_edge = solution.tables.numbering(p).edge[face_no];
  std::vector<double> nodes;
  for (const Point<1> &node : solution.tables.gauss_lobatto(p + 1).get_points())
    nodes.push_back(node[0]);
  const std::vector<double> phi = lagrange_basis(nodes, s);
  Tensor<1, 2> result;
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j <= p; ++j)
      result[c] += phi[j] * solution.u[dofs[on_edge[c * (p + 1) + j]]];
  return result;
}

namespace
{
/** By polynomials, which follow smooth curves to round-off. */
std::shared_ptr<const FacingCoordinates> facing(const ContactSegment<2> &segment)
{
  if (!segment.drawn)
    return nullptr;
  const QGauss<1> gauss(n_of_curve);
  const double along = segment.end - segment.begin, across = segment.at_end - segment.at_begin;
  std::vector<double> on_master, on_slave;
  for (const Point<1> &point : gauss.get_points())
    on_master.push_back(segment.opposite(segment.begin + point[0] * along));
  auto result = std::make_shared<FacingCoordinates>();
  result->on_master = EdgePolynomial::through(on_master, gauss);
  const EdgePolynomial slope = result->on_master.derivative();
  for (const Point<1> &point : gauss.get_points())
  {
    // Of the master's piece from its lower end on.
    const double at =
        across > 0. ? segment.at_begin + point[0] * across : segment.at_end - point[0] * across;
    double share = across > 0. ? point[0] : 1. - point[0];
    for (unsigned int k = 0; k < 50; ++k) // Newton
    {
      const double step = (at - result->on_master(share)) / slope(share);
      share += step;
      if (std::abs(step) < 1e-15)
        break;
    }
    on_slave.push_back(segment.begin + share * along);
  }
  result->on_slave = EdgePolynomial::through(on_slave, gauss);
  result->speed = result->on_slave.derivative();
  return result;
}
} // namespace

namespace
{
/** Of a face, cut once more at s. */
std::vector<ContactSegment<2>> segments_of(const ContactFace<2> &face, const double s)
{
  std::vector<ContactSegment<2>> result;
  for (const ContactSegment<2> &segment : face.segments)
  {
    ContactSegment<2> before = segment, after = segment;
    if (s > segment.begin + same_on_edge && s < segment.end - same_on_edge)
    {
      before.end = after.begin = s;
      before.at_end = after.at_begin = segment.opposite(s);
      result.push_back(before);
    }
    result.push_back(after);
  }
  return result;
}
} // namespace

std::vector<JointEdge> joint_edges(const ContactSpace<2> &contact_space,
                                   const std::vector<double> &ends)
{
  const std::vector<ContactFace<2>> &faces = contact_space.faces();
  std::vector<JointEdge> slaves;
  std::map<std::pair<unsigned int, unsigned int>, JointEdge> masters;
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    JointEdge &slave = slaves.emplace_back(JointEdge{faces[k].cell, faces[k].face_no, true, {}});
    slave.is_cut = ends[k] > 0.;
    for (const ContactSegment<2> &segment : segments_of(faces[k], ends[k]))
    {
      const auto drawn = facing(segment);
      slave.pieces.push_back({segment.begin, segment.end, k, segment.begin, segment.end,
                              segment.cell, segment.face_no, segment.at_begin, segment.at_end,
                              /*has_other=*/true, /*is_slave=*/true, drawn});
      JointEdge &master = masters
                              .try_emplace({segment.cell->active_cell_index(), segment.face_no},
                                           JointEdge{segment.cell, segment.face_no, false, {}})
                              .first->second;
      JointPiece piece{segment.at_begin,   segment.at_end,     k,
                       segment.begin,      segment.end,        faces[k].cell,
                       faces[k].face_no,   segment.begin,      segment.end,
                       /*has_other=*/true, /*is_slave=*/false, drawn};
      if (piece.begin > piece.end)
      {
        std::swap(piece.begin, piece.end);
        std::swap(piece.at_begin, piece.at_end);
        std::swap(piece.other_begin, piece.other_end);
      }
      master.pieces.push_back(piece);
    }
    const std::vector<double> cuts =
        slave.is_cut ? std::vector<double>{0., ends[k], 1.} : std::vector<double>{0., 1.};
    for (unsigned int i = 0; faces[k].segments.empty() && i + 1 < cuts.size(); ++i)
      slave.pieces.push_back({cuts[i], cuts[i + 1], k, cuts[i], cuts[i + 1], faces[k].cell,
                              faces[k].face_no, cuts[i], cuts[i + 1], /*has_other=*/false,
                              /*is_slave=*/true, nullptr});
  }
  for (auto &[place, master] : masters)
  {
    master.is_cut = true;
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
  const double hoop =
      solution.scene.is_axisymmetric()
          ? evaluate(table.values, solution.coefficients(index))[0] / map.point(reference)[0]
          : 0.;
  SymmetricTensor<2, 2> result = law.stress(
      physical_gradient<2>(slopes, 0, table.derivatives.m(), invert(map.jacobian(reference))),
      hoop);
  if (solution.scene.has_initial_strain())
    result -= law.stress(solution.scene.initial_strain_in(cell, map.point(reference)));
  return result;
}

/** Must what touches not part there, and has that a multiplier? */
bool is_joint(const ContactFace<2> &face)
{
  return !face.condition->is_unilateral() && !face.pressures.empty();
}
} // namespace

namespace
{
/** Where contact ends inside a face: is its first point pressed? */
bool presses_first(const ContactFace<2> &face, const Solution<2> &solution)
{
  return solution.z[face.pressures.front()] > 0.;
}
} // namespace

JointTractions::JointTractions(const Solution<2> &solution, const AdmissibleFriction<2> &friction,
                               const AdmissiblePressure<2> &pressure)
    : solution(solution), friction(friction), parts(solution.contact_space.faces().size()),
      motions(solution.scene.free_motions())
{
  for (unsigned int k = 0; k < parts.size(); ++k)
    ends.push_back(end_of_contact(k));
  all = joint_edges(solution.contact_space, ends);
  for (unsigned int k = 0; k < all.size(); ++k)
    by_cell[{all[k].cell->active_cell_index(), all[k].face_no}] = k;
  for (unsigned int k = 0; k < parts.size(); ++k)
  {
    const ContactFace<2> &face = solution.contact_space.faces()[k];
    if (ends[k] > 0.)
      set_pressure_before_end(k);
    else if (face.condition->is_unilateral())
      parts[k][0] = pressure.value(k);
    else if (is_joint(face))
      parts[k] = wanted(k, 0., 1.);
    if (!face.condition->is_tied())
      parts[k][1] = {};
  }
  balance_moments();
  balance_motions();
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

/** What the amounts of motions are along normal and tangent; dimensionless. */
std::array<double, 2> JointTractions::share_of_motions(const unsigned int k, const double s) const
{
  if (!added)
    return {};
  const ContactFace<2> &face = solution.contact_space.faces()[k];
  const ContactFrame<2> frame = face.node_frame(s);
  const Tensor<1, 2> jump = added->jump(frame.x, face.bodies);
  return {{jump * frame.normal, jump * frame.tangent}};
}

double JointTractions::pressure(const unsigned int k, const double s) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[k];
  double begin = 0., width = 1.;
  if (ends[k] > 0.)
  {
    const bool is_first = presses_first(face, solution);
    if ((s < ends[k]) != is_first)
      return 0.;
    begin = is_first ? 0. : ends[k];
    width = is_first ? ends[k] : 1. - ends[k];
  }
  const double own = parts[k][0]((s - begin) / width), share = share_of_motions(k, s)[0];
  return face.condition->is_unilateral() ? own * (1. + share)
         : is_joint(face)                ? own + unit * share
                                         : own;
}

bool JointTractions::presses(const JointPiece &piece) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[piece.face];
  if (ends[piece.face] > 0.)
    return ((piece.at_begin + piece.at_end) / 2 < ends[piece.face]) ==
           presses_first(face, solution);
  return std::all_of(face.pressures.begin(), face.pressures.end(),
                     [&](const unsigned int i) { return solution.z[i] > 0.; });
}

double JointTractions::limit(const unsigned int k, const double s) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[k];
  return face.friction.vanishes()
             ? 0.
             : face.condition->friction.limit(face.point(s), std::max(0., pressure(k, s)));
}

/** Friction keeps its bound as long as shares are below a half. */
double JointTractions::direction(const unsigned int k, const double s) const
{
  const double lambda = friction.value(k, s);
  return lambda + (1. - lambda * lambda) * share_of_motions(k, s)[1];
}

Tensor<1, 2> JointTractions::value(const unsigned int k, const double s) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[k];
  const ContactFrame<2> frame = face.node_frame(s);
  const double bound = limit(k, s),
               of_tie = face.condition->is_tied() ? unit * share_of_motions(k, s)[1] : 0.,
               along = parts[k][1](s) + of_tie + (bound == 0. ? 0. : bound * direction(k, s));
  return pressure(k, s) * frame.normal + along * frame.tangent;
}

double JointTractions::measure(const JointPiece &piece, const double s) const
{
  return piece.speed(s) *
         solution.contact_space.faces()[piece.face].frame(piece.on_slave(s)).measure;
}

Tensor<1, 2> JointTractions::density(const JointPiece &piece, const double s) const
{
  return measure(piece, s) * value(piece.face, piece.on_slave(s));
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
                                                              const double begin, const double end,
                                                              const unsigned int more) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[piece.face];
  std::vector<double> cuts = {begin, end};
  for (const double cut : face.friction.cuts)
    if (const double at = piece.from_slave(cut); at > begin && at < end)
      cuts.push_back(at);
  std::sort(cuts.begin(), cuts.end());
  const bool is_polynomial = !varies(face.friction) && !face.map.is_curved() && !piece.drawn;
  const QGauss<1> &gauss =
      solution.tables.gauss((degree(piece.face) + more + face.is_axisymmetric) / 2 + 1 +
                            (is_polynomial ? 0 : n_of_curve / 2));
  std::vector<std::pair<double, double>> result;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
    for (unsigned int q = 0; q < gauss.size(); ++q)
      result.emplace_back(cuts[k] + (cuts[k + 1] - cuts[k]) * gauss.point(q)[0],
                          (cuts[k + 1] - cuts[k]) * gauss.weight(q));
  return result;
}

/** Of degree p, along normal and tangent, nearest on a part of the face, whose mean is that of z_N there; by the share of it. */
std::array<EdgePolynomial, 2> JointTractions::wanted(const unsigned int k, const double begin,
                                                     const double end) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[k];
  const unsigned int n = face.degree + 1;
  std::array<std::vector<double>, 2> result{{std::vector<double>(n), std::vector<double>(n)}};
  for (const JointPiece &piece : all[k].pieces)
  {
    if (const double middle = (piece.begin + piece.end) / 2; middle < begin || middle > end)
      continue;
    const double mu = stiffness(solution, face.cell),
                 opposite = piece.has_other ? stiffness(solution, piece.other) : 0.,
                 share = piece.has_other ? opposite / (mu + opposite) : 1.;
    const QGauss<1> &gauss = solution.tables.gauss(n + 2);
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double s = piece.begin + (piece.end - piece.begin) * gauss.point(q)[0],
                   weight = 2 * (piece.end - piece.begin) / (end - begin) * gauss.weight(q);
      const ContactFrame<2> frame = face.node_frame(s);
      SymmetricTensor<2, 2> sigma =
          share * stress_at(solution, face.cell, point_on_face<2>(face.face_no, Point<1>(s)));
      if (piece.has_other)
        sigma += (1 - share) *
                 stress_at(solution, piece.other,
                           point_on_face<2>(piece.other_face, Point<1>(piece.on_other(s))));
      const Tensor<1, 2> traction = -(sigma * frame.normal);
      const Vector<double> L = legendre_basis(n, (s - begin) / (end - begin));
      for (unsigned int i = 0; i < n; ++i)
      {
        result[0][i] += weight * L[i] * (traction * frame.normal);
        result[1][i] += weight * L[i] * (traction * frame.tangent);
      }
    }
  }
  for (unsigned int c = 0; c < 2; ++c)
    result[c][0] =
        discrete_traction(face, solution, /*is_pressure=*/c == 0).coefficients()[0] / (end - begin);
  return {{EdgePolynomial(result[0]), EdgePolynomial(result[1])}};
}

/** Where u_N opens last between the points of the multiplier that press and those that do not: there it needs no correction. */
double JointTractions::end_of_contact(const unsigned int k) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[k];
  if (!face.condition->is_unilateral() || face.pressures.size() < 2)
    return -1.;
  std::vector<unsigned int> changes;
  for (unsigned int i = 0; i + 1 < face.pressures.size(); ++i)
    if ((solution.z[face.pressures[i]] > 0.) != (solution.z[face.pressures[i + 1]] > 0.))
      changes.push_back(i);
  if (changes.size() != 1)
    return -1.;
  double in = face.normal_points[changes[0]], out = face.normal_points[changes[0] + 1];
  if (!presses_first(face, solution))
    std::swap(in, out);
  const auto is_open = [&](const double s)
  {
    Tensor<1, 2> jump = displacement_at(solution, face.cell, face.face_no, s);
    if (!face.segments.empty())
    {
      const ContactSegment<2> &segment = face.segment(s);
      jump -= displacement_at(solution, segment.cell, segment.face_no, segment.opposite(s));
    }
    return jump * face.node_frame(s).normal < gap_on_face(face, s);
  };
  constexpr unsigned int n = 16;
  unsigned int i = 0;
  while (i < n && is_open(out + (in - out) * i / n))
    ++i;
  if (i == 0)
    return -1.;
  double open = out + (in - out) * (i - 1) / n, closed = out + (in - out) * i / n;
  for (unsigned int b = 0; i < n && b < 40; ++b)
  {
    const double s = (open + closed) / 2;
    (is_open(s) ? open : closed) = s;
  }
  return closed > 0.02 && closed < 0.98 ? closed : -1.;
}

/** Nearest to sigma(u_N), and not negative: between that and its mean. */
void JointTractions::set_pressure_before_end(const unsigned int k)
{
  const bool is_first = presses_first(solution.contact_space.faces()[k], solution);
  const EdgePolynomial nearest = wanted(k, is_first ? 0. : ends[k], is_first ? ends[k] : 1.)[0];
  std::vector<double> result = nearest.coefficients();
  const double mean = std::max(0., result[0]) / std::sqrt(2.);
  double least = mean;
  for (const double s : nearest.extremes())
    least = std::min(least, nearest(s));
  const double share = least < 0. ? mean / (mean - least) : 1.;
  for (unsigned int i = 1; i < result.size(); ++i)
    result[i] *= 0.999999 * share;
  result[0] = mean * std::sqrt(2.);
  parts[k][0] = EdgePolynomial(result);
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

/** int (z_N - tau) . [v] for each motion v. */
Vector<double> JointTractions::missing_work() const
{
  const Vector<double> forces = missing_forces();
  std::map<types::global_dof_index, std::pair<const JointEdge *, unsigned int>> nodes;
  for (const JointEdge &edge : all)
  {
    const unsigned int cell = edge.cell->active_cell_index();
    const auto dofs = solution.displacement_space.cell_dofs(cell);
    const auto &on_edge =
        solution.tables.numbering(solution.displacement_space.degrees()[cell]).edge[edge.face_no];
    for (unsigned int i = 0; i < on_edge.size(); ++i)
      nodes[dofs[on_edge[i]]] = {&edge, i};
  }
  Vector<double> result(motions.size());
  for (const auto &[dof, place] : nodes)
  {
    const auto &[edge, i] = place;
    const unsigned int n =
        solution.displacement_space.degrees()[edge->cell->active_cell_index()] + 1;
    const Point<2> x =
        map_of<2>(edge->cell)
            .point(point_on_face<2>(edge->face_no, solution.tables.gauss_lobatto(n).point(i % n)));
    const unsigned int body =
        solution.contact_space.faces()[edge->pieces[0].face].bodies[edge->is_slave ? 0 : 1];
    for (unsigned int m = 0; m < motions.size(); ++m)
      result[m] += forces[dof] * motions[m].at(x, body)[i / n];
  }
  return result;
}

/** Along the motions that no support resists. */
void JointTractions::balance_motions()
{
  const unsigned int n = motions.size();
  if (n == 0)
    return;
  unit = solution.z.linfty_norm();
  Vector<double> amounts(n);
  LAPACKFullMatrix<double> work(n, n); // of what is added, by motion
  const double little = 1e-6 / solution.scene.geometry.diameter();
  for (const JointEdge &edge : all)
    for (unsigned int k = 0; edge.is_slave && k < edge.pieces.size(); ++k)
    {
      const JointPiece &piece = edge.pieces[k];
      const ContactFace<2> &face = solution.contact_space.faces()[piece.face];
      const auto at = points(piece, piece.begin, piece.end, 4);
      std::vector<Tensor<1, 2>> before;
      added.reset();
      for (const auto &[s, weight] : at)
        before.push_back(value(piece.face, s));
      for (unsigned int m = 0; m < n; ++m)
      {
        amounts = 0.;
        amounts[m] = little;
        added = sum(motions, amounts);
        for (unsigned int q = 0; q < at.size(); ++q)
        {
          const auto &[s, weight] = at[q];
          const Tensor<1, 2> more =
              weight * measure(piece, s) / little * (value(piece.face, s) - before[q]);
          for (unsigned int l = 0; l < n; ++l)
            work(l, m) += more * motions[l].jump(face.point(s), face.bodies);
        }
      }
    }
  amounts = 0.;
  work.compute_inverse_svd(1e-8);
  for (unsigned int k = 0; k < 5; ++k) // shares meet each other
  {
    added = sum(motions, amounts);
    Vector<double> change(n);
    work.vmult(change, missing_work());
    amounts += change;
  }
  added = sum(motions, amounts);
  for (const ContactFace<2> &face : solution.contact_space.faces())
    for (const double s : {0., 0.5, 1.})
      if (!is_joint(face) && !(added->jump(face.point(s), face.bodies).norm() < 0.4))
      {
        added.reset(); // and the stress is out of balance
        return;
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
      for (const auto &[s, weight] : points(piece, piece.begin, piece.end, p))
      {
        const Tensor<1, 2> force = (edge.is_slave ? -weight : weight) * density(piece, s);
        const std::vector<double> phi = lagrange_basis(nodes, s);
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int j = 0; j < n; ++j)
            result[dofs[on_edge[c * n + j]]] += force[c] * phi[j];
      }
  }
  return result;
}
} // namespace hpvi
