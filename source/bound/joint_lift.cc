// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/bound/contact_correction.h>
#include <hpvi/bound/correction_search.h>
#include <hpvi/bound/displacement_lift.h>
#include <hpvi/bound/joint_lift.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double round_off = 1e-12; ///< of the largest displacement

/** u_N at a point of an edge of a cell. */
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

/** A polynomial of degree below n by its values. */
template <class Function>
EdgePolynomial polynomial(const unsigned int n, const ShapeTables<2> &tables, const Function &value)
{
  std::vector<double> values;
  for (const Point<1> &point : tables.gauss(n).get_points())
    values.push_back(value(point[0]));
  return EdgePolynomial::through(values, tables.gauss(n));
}

} // namespace

JointLift::JointLift(const Solution<2> &solution, const Discretisation<2> &discretisation,
                     const JointTractions &tractions)
    : cells(solution.displacement_space.degrees().size()),
      gaps(solution.contact_space.faces().size()), solution(solution),
      discretisation(discretisation), tractions(tractions), slips(slips_of(solution)),
      size(solution.u.linfty_norm())
{
  choose_movers();
  set_vertices(NodeFreedom(solution, discretisation.unknowns));
  for (Mover &mover : movers)
  {
    set_ends(mover);
    set_changes(mover);
  }
  set_w();
  for (const Mover &mover : movers)
  {
    add_rest(mover);
    for (const Piece &piece : mover.pieces)
      if (piece.is_joint)
        add_gaps(mover, piece);
  }
}

/** Edges of the softer side of each contact. */
void JointLift::choose_movers()
{
  std::map<const BoundaryCondition<2> *, std::array<double, 2>> softest; // of slave and master
  for (const JointEdge &edge : tractions.edges())
    for (const JointPiece &piece : edge.pieces)
    {
      double &mu = softest
                       .try_emplace(solution.contact_space.faces()[piece.face].condition,
                                    std::array<double, 2>{{std::numeric_limits<double>::max(),
                                                           std::numeric_limits<double>::max()}})
                       .first->second[!edge.is_slave];
      mu = std::min(mu, stiffness(solution, edge.cell));
    }
  for (const JointEdge &edge : tractions.edges())
  {
    const auto &[slave, master] =
        softest.at(solution.contact_space.faces()[edge.pieces[0].face].condition);
    if (edge.is_slave == (slave <= master))
      movers.push_back(mover(edge));
  }
}

JointLift::Mover JointLift::mover(const JointEdge &edge) const
{
  const ContactFrame<2> frame = solution.contact_space.faces()[edge.pieces[0].face].frame(0.5);
  const auto face = edge.cell->face(edge.face_no);
  Mover result{&edge,
               edge.is_slave ? 1. : -1.,
               frame.normal,
               frame.tangent,
               {{face->vertex_index(0), face->vertex_index(1)}},
               {},
               {}};
  const auto add_void = [&](const double begin, const double end)
  {
    if (end - begin > 1e-9)
      result.pieces.push_back(
          Piece({begin, end, edge.pieces[0].face, 0., 1., edge.cell, edge.face_no, 0., 1., false},
                /*is_joint=*/false));
  };
  double end = 0;
  for (const JointPiece &place : edge.pieces)
  {
    add_void(end, place.begin);
    result.pieces.push_back(piece(place, edge, result.sign));
    end = place.end;
  }
  add_void(end, 1.);
  return result;
}

JointLift::Piece JointLift::piece(const JointPiece &place, const JointEdge &edge,
                                  const double sign) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[place.face];
  const BoundaryCondition<2> &law = *face.condition;
  Piece result(place, /*is_joint=*/true);
  if (law.is_unilateral())
    result.modes[0] = std::all_of(face.pressures.begin(), face.pressures.end(),
                                  [&](const unsigned int i) { return solution.z[i] > 0.; })
                          ? exact
                          : below;
  else if (law.contact != Contact::tangential)
    result.modes[0] = exact;
  if (law.is_tied() || (face.n_multipliers > 0 && slips[place.face].mode == Slip::nowhere))
    result.modes[1] = exact;
  unsigned int degree = solution.displacement_space.degrees()[edge.cell->active_cell_index()];
  if (place.has_other)
    degree =
        std::max(degree, solution.displacement_space.degrees()[place.other->active_cell_index()]);
  const ContactFrame<2> frame = face.frame(0.5);
  const LegendreTables legendre;
  const EdgePolynomial u_0 = law.is_unilateral() && law.gap
                                 ? gap_at_nodes(face, solution.tables, legendre)
                                 : EdgePolynomial::constant(0.);
  const auto jump = [&](const double t)
  {
    const double s = place.begin + t * (place.end - place.begin);
    Tensor<1, 2> value = displacement_at(solution, edge.cell, edge.face_no, s);
    if (place.has_other)
      value -= displacement_at(solution, place.other, place.other_face, place.on_other(s));
    return sign * value;
  };
  const unsigned int n = std::max(degree, face.degree) + 1;
  result.jump[0] = polynomial(n, solution.tables,
                              [&](const double t)
                              {
                                const double s = place.begin + t * (place.end - place.begin);
                                return jump(t) * frame.normal - u_0(place.on_slave(s));
                              });
  result.jump[1] =
      polynomial(n, solution.tables, [&](const double t) { return jump(t) * frame.tangent; });
  return result;
}

/** What pieces beside a vertex ask of it; supports leave it one direction, or none. */
void JointLift::set_vertices(const NodeFreedom &freedom)
{
  std::map<unsigned int, std::vector<Wish>> wishes;
  std::map<unsigned int, NodeFreedom::Node> nodes;
  for (const Mover &mover : movers)
    for (const unsigned int end : {0, 1})
    {
      const Piece &piece = end == 0 ? mover.pieces.front() : mover.pieces.back();
      const unsigned int vertex = mover.vertices[end], cell = mover.edge->cell->active_cell_index(),
                         p = solution.displacement_space.degrees()[cell];
      const auto dofs = solution.displacement_space.cell_dofs(cell);
      const std::vector<unsigned int> &on_edge =
          solution.tables.numbering(p).edge[mover.edge->face_no];
      nodes[vertex] = {{dofs[on_edge[end * p]], dofs[on_edge[p + 1 + end * p]]}};
      wishes[vertex];
      for (unsigned int c = 0; piece.is_joint && c < 2; ++c)
      {
        const double value = piece.jump[c](end);
        if (piece.modes[c] == exact || (piece.modes[c] == below && value > 0.))
          wishes[vertex].push_back({mover.sign * (c == 0 ? mover.normal : mover.tangent), -value});
      }
    }
  for (const auto &[vertex, all] : wishes)
  {
    Tensor<1, 2> &d = at_vertices[vertex];
    const NodeFreedom::Node &node = nodes[vertex];
    const Tensor<1, 2> only = freedom.only_direction(node);
    const bool is_held =
        freedom.is_on_plate(node) || (freedom.is_held(node, Tensor<1, 2>({1., 0.})) &&
                                      freedom.is_held(node, Tensor<1, 2>({0., 1.})));
    Tensor<2, 2> M;
    Tensor<1, 2> r;
    for (const Wish &wish : all)
    {
      const Tensor<1, 2> a =
          only.norm_square() > 0. ? Tensor<1, 2>((wish.direction * only) * only) : wish.direction;
      M += outer_product(a, a);
      r += wish.value * a;
    }
    if (is_held || r.norm_square() == 0.)
      continue;
    const double trace = M[0][0] + M[1][1];
    d = determinant(M) > 1e-8 * trace * trace ? Tensor<1, 2>(invert(M) * r) : r / trace;
  }
}

/** Of [d] at both ends of each piece: at vertices by d there, at cuts between pieces what these ask for. */
void JointLift::set_ends(Mover &mover) const
{
  const std::array<Tensor<1, 2>, 2> directions{{mover.normal, mover.tangent}};
  std::vector<Piece> &pieces = mover.pieces;
  for (unsigned int c = 0; c < 2; ++c)
    for (const unsigned int end : {0, 1})
      (end == 0 ? pieces.front() : pieces.back()).at_ends[end][c] =
          mover.sign * (at_vertices.at(mover.vertices[end]) * directions[c]);
  for (unsigned int k = 0; k + 1 < pieces.size(); ++k)
    for (unsigned int c = 0; c < 2; ++c)
    {
      double value = 0;
      bool is_exact = false;
      for (const unsigned int side : {0, 1})
        if (const Piece &piece = pieces[k + side]; piece.is_joint && piece.modes[c] != any)
        {
          const double wanted = -piece.jump[c](1. - side);
          is_exact |= piece.modes[c] == exact;
          value = is_exact ? wanted : std::min(wanted, 0.);
          if (is_exact)
            break;
        }
      pieces[k].at_ends[1][c] = pieces[k + 1].at_ends[0][c] = value;
    }
}

void JointLift::set_flaw(const Piece &piece, const double by)
{
  if (flaw.empty())
    flaw = "two bodies part or pass through one another near " +
           to_string(solution.contact_space.faces()[piece.place.face].point(piece.place.at_begin)) +
           ", by " + hpvi::text(by / size, 2) +
           " of the largest displacement, and what holds the softer one there keeps it so";
}

/** [d] along each piece. */
void JointLift::set_changes(Mover &mover)
{
  for (Piece &piece : mover.pieces)
    for (unsigned int c = 0; c < 2; ++c)
    {
      const std::array<double, 2> ends{{piece.at_ends[0][c], piece.at_ends[1][c]}};
      EdgePolynomial &change = piece.change[c];
      change = polynomial(2, solution.tables,
                          [&](const double t) { return ends[0] + t * (ends[1] - ends[0]); });
      if (!piece.is_joint || piece.modes[c] == any)
        continue;
      const EdgePolynomial left = piece.jump[c] + change;
      for (const unsigned int end : {0, 1})
        if (const double by = piece.modes[c] == exact ? std::abs(left(end)) : left(end);
            by > round_off * size)
          set_flaw(piece, by);
      if (piece.modes[c] == exact)
      {
        std::vector<double> minus = piece.jump[c].coefficients();
        for (double &value : minus)
          value = -value;
        change = EdgePolynomial(minus);
      }
      else if (const double height =
                   height_over(left, {{true, true}}, 1e-14 * size, solution.tables);
               height > 0.)
        change = change + polynomial(3, solution.tables,
                                     [&](const double t)
                                     { return -(1. + 1e-10) * height * t * (1. - t); });
    }
}

/** d at the nodes of an edge. */
void JointLift::set_nodes(Mover &mover, Vector<double> &u) const
{
  const unsigned int cell = mover.edge->cell->active_cell_index(),
                     p = solution.displacement_space.degrees()[cell];
  const auto dofs = solution.displacement_space.cell_dofs(cell);
  const std::vector<unsigned int> &on_edge = solution.tables.numbering(p).edge[mover.edge->face_no];
  const QGaussLobatto<1> &nodes = solution.tables.gauss_lobatto(p + 1);
  const LegendreTables legendre;
  Vector<double> values(p + 1), coefficients(p + 1);
  for (unsigned int c = 0; c < 2; ++c)
  {
    for (unsigned int j = 0; j <= p; ++j)
    {
      const double s = nodes.point(j)[0];
      const auto at = std::find_if(mover.pieces.begin(), mover.pieces.end() - 1,
                                   [s](const Piece &piece) { return s <= piece.place.end; });
      const double t = (s - at->place.begin) / (at->place.end - at->place.begin);
      values[j] =
          mover.sign * (at->change[0](t) * mover.normal[c] + at->change[1](t) * mover.tangent[c]);
      u[dofs[on_edge[c * (p + 1) + j]]] = values[j];
    }
    legendre.from_nodes(p).vmult(coefficients, values);
    mover.w[c] = EdgePolynomial({coefficients.begin(), coefficients.end()});
  }
}

/** w: d at the nodes of the edges that move, no change at those opposite, the least energy in cells that touch them. */
void JointLift::set_w()
{
  const DisplacementSpace<2> &space = solution.displacement_space;
  const Unknowns<2> &unknowns = discretisation.unknowns;
  Vector<double> u(solution.u.size());
  std::set<unsigned int> vertices;
  for (Mover &mover : movers)
  {
    set_nodes(mover, u);
    vertices.insert(mover.vertices.begin(), mover.vertices.end());
  }
  std::vector<bool> is_free(discretisation.system.A.n()), is_fixed(is_free);
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (std::any_of(cell->vertex_indices().begin(), cell->vertex_indices().end(),
                    [&](const unsigned int v)
                    { return vertices.count(cell->vertex_index(v)) > 0; }))
      for (const auto dof : space.cell_dofs(cell->active_cell_index()))
        for (const auto &[unknown, weight] : unknowns.terms(dof))
          is_free[unknown] = true;
  for (const JointEdge &edge : tractions.edges())
  {
    const unsigned int cell = edge.cell->active_cell_index();
    for (const unsigned int i : solution.tables.numbering(space.degrees()[cell]).edge[edge.face_no])
      for (const auto &[unknown, weight] : unknowns.terms(space.cell_dofs(cell)[i]))
        is_fixed[unknown] = true;
  }
  Vector<double> fixed = unknowns.coordinates(u);
  for (unsigned int i = 0; i < is_free.size(); ++i)
  {
    is_free[i] = is_free[i] && !is_fixed[i];
    if (!is_fixed[i])
      fixed[i] = 0.;
  }
  const BorderedMatrix A{discretisation.system.A, {}};
  const Vector<double> w = RestrictedEnergy(A, is_free, fixed, {}).minimiser();
  energies = energies_by_cell(solution, discretisation, w);
  change =
      A.energy(w) / 2 - solution.z * solution.spaces->contact_operator.moments(unknowns.expand(w));
}

/** d - w at t of a piece. */
Tensor<1, 2> JointLift::rest(const Mover &mover, const Piece &piece, const double t) const
{
  const double s = piece.place.begin + t * (piece.place.end - piece.place.begin);
  return mover.sign * (piece.change[0](t) * mover.normal + piece.change[1](t) * mover.tangent) -
         Tensor<1, 2>({mover.w[0](s), mover.w[1](s)});
}

/** What w leaves of d along an edge, in its cell. */
void JointLift::add_rest(const Mover &mover)
{
  std::vector<EdgePoint> points;
  double largest = 0;
  const std::array<EdgePolynomial, 2> slopes_of_w{
      {mover.w[0].derivative(), mover.w[1].derivative()}};
  for (const Piece &piece : mover.pieces)
  {
    const std::array<EdgePolynomial, 2> slopes{
        {piece.change[0].derivative(), piece.change[1].derivative()}};
    const double length = piece.place.end - piece.place.begin;
    const unsigned int n =
        std::max({piece.change[0].coefficients().size(), piece.change[1].coefficients().size(),
                  mover.w[0].coefficients().size()}) +
        4;
    for (unsigned int q = 0; q < n; ++q)
    {
      const double t = solution.tables.gauss(n).point(q)[0], s = piece.place.begin + t * length;
      const Tensor<1, 2> slope =
          mover.sign / length * (slopes[0](t) * mover.normal + slopes[1](t) * mover.tangent) -
          Tensor<1, 2>({slopes_of_w[0](s), slopes_of_w[1](s)});
      points.push_back(
          {s, length * solution.tables.gauss(n).weight(q), rest(mover, piece, t), slope});
      largest = std::max(largest, points.back().value.norm());
    }
  }
  if (largest <= 1e-15 * size)
    return;
  const auto &iterator = mover.edge->cell;
  const CellMap<2> map = map_of<2>(iterator);
  const BoundaryCondition<2> &condition =
      solution.scene.boundaries[iterator->face(mover.edge->face_no)->boundary_id()];
  const double energy =
      lift_energy(map, mover.edge->face_no, points,
                  HookesLaw<2>(solution.scene.material_of(iterator)), solution.tables) +
      spring_energy(condition, map, mover.edge->face_no, points);
  cells[iterator->active_cell_index()] += std::sqrt(std::max(0., energy));
}

void JointLift::add_gaps(const Mover &mover, const Piece &piece)
{
  const ContactFace<2> &face = solution.contact_space.faces()[piece.place.face];
  const double length = std::abs(piece.place.at_end - piece.place.at_begin);
  const EdgePolynomial u_t = piece.jump[1], left = piece.jump[1] + piece.change[1],
                       open = piece.jump[0] + piece.change[0];
  const unsigned int n = std::max(u_t.coefficients().size(), open.coefficients().size());
  std::set<double> cuts{0., 1.};
  const bool has_friction = !face.friction.vanishes();
  for (const EdgePolynomial *const f : {&u_t, &left})
    if (has_friction && f->largest() > 1e-13 * size)
      for (const double zero : f->zeros())
        cuts.insert(zero);
  for (auto cut = cuts.begin(); std::next(cut) != cuts.end(); ++cut)
  {
    JointPiece part = piece.place;
    const double begin = *cut, width = *std::next(cut) - begin;
    part.begin = begin;
    part.end = begin + width;
    part.at_begin = piece.place.at_begin + begin * (piece.place.at_end - piece.place.at_begin);
    part.at_end = part.at_begin + width * (piece.place.at_end - piece.place.at_begin);
    for (const auto &[t, weight] : tractions.points(part, n))
    {
      const double s = part.on_slave(t), ds = length * width * weight * face.frame(s).measure;
      const Tensor<1, 2> tau = tractions.value(piece.place.face, s);
      work -= mover.sign * ds * (tau * rest(mover, piece, t));
      if (piece.modes[0] == below)
        gaps[piece.place.face] -= ds * tractions.pressure(piece.place.face, s) * open(t);
      if (!has_friction)
        continue;
      const double g = face.friction_bound(face.point(s)),
                   U_t = piece.modes[1] == exact ? 0. : left(t);
      gaps[piece.place.face] += ds * (g * std::abs(U_t) - (tau * mover.tangent) * U_t);
      work += ds * g * (std::abs(U_t) - std::abs(u_t(t)));
    }
  }
}
} // namespace hpvi
