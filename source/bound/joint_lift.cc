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
constexpr double round_off = 1e-12; ///< of the largest displacement, and of the gap

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
  move();
  require_own_corners(movers, 1e-12 * size);
  by_face.resize(gaps.size());
  for (const Mover &mover : movers)
    for (const Piece &piece : mover.pieces)
      if (piece.is_joint)
      {
        add_gaps(mover, piece);
        const auto [begin, end] = std::minmax(piece.place.at_begin, piece.place.at_end);
        by_face[piece.place.face].push_back(
            {begin, end, piece.place, {{piece.left(0), piece.left(1)}}});
      }
  for (std::vector<OnFace> &pieces : by_face)
    std::sort(pieces.begin(), pieces.end(),
              [](const OnFace &a, const OnFace &b) { return a.begin < b.begin; });
}

void JointLift::move()
{
  set_vertices(NodeFreedom(solution, discretisation.unknowns));
  for (Mover &mover : movers)
  {
    set_ends(mover);
    set_changes(mover);
  }
  set_w();
  for (const Mover &mover : movers)
    add_rest(mover);
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
  const auto face = edge.cell->face(edge.face_no);
  Mover result{
      &edge, edge.is_slave ? 1. : -1., {{face->vertex_index(0), face->vertex_index(1)}}, {}, {}};
  const auto add_void = [&](const double begin, const double end)
  {
    if (end - begin > 1e-9)
      result.pieces.push_back(
          Piece({begin, end, edge.pieces[0].face, 0., 1., edge.cell, edge.face_no, 0., 1.,
                 /*has_other=*/false, edge.is_slave, nullptr},
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

/** Normal and tangent of the slave's face at t of a piece. */
std::array<Tensor<1, 2>, 2> JointLift::frame(const Piece &piece, const double t) const
{
  const double s = piece.place.begin + t * (piece.place.end - piece.place.begin);
  const ContactFrame<2> frame =
      solution.contact_space.faces()[piece.place.face].node_frame(piece.place.on_slave(s));
  return {{frame.normal, frame.tangent}};
}

/** Of polynomials that have what is of a degree along straight edges, and follow curves. */
unsigned int JointLift::points_along(const Piece &piece, const unsigned int degree) const
{
  const bool is_curved =
      piece.is_joint &&
      (piece.place.drawn || solution.contact_space.faces()[piece.place.face].map.is_curved());
  return degree + 1 + (is_curved ? n_of_curve / 2 : 0);
}

JointLift::Piece JointLift::piece(const JointPiece &place, const JointEdge &edge,
                                  const double sign) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[place.face];
  const BoundaryCondition<2> &law = *face.condition;
  Piece result(place, /*is_joint=*/true);
  result.is_unilateral = law.is_unilateral();
  if (law.is_unilateral())
    result.modes[0] = tractions.presses(place) ? exact : below;
  else if (law.contact != Contact::tangential)
    result.modes[0] = exact;
  if (law.is_tied() || (face.n_multipliers > 0 && slips[place.face].mode == Slip::nowhere))
    result.modes[1] = exact;
  unsigned int degree = solution.displacement_space.degrees()[edge.cell->active_cell_index()];
  if (place.has_other)
    degree =
        std::max(degree, solution.displacement_space.degrees()[place.other->active_cell_index()]);
  const unsigned int n = points_along(result, std::max(degree, face.degree));
  const bool is_straight = n == std::max(degree, face.degree) + 1;
  const LegendreTables legendre;
  const bool has_gap = law.is_unilateral() && law.gap;
  const EdgePolynomial at_nodes = has_gap && is_straight
                                      ? gap_at_nodes(face, solution.tables, legendre)
                                      : EdgePolynomial::constant(0.);
  const auto jump = [&](const double t, const unsigned int c)
  {
    const double s = place.begin + t * (place.end - place.begin);
    Tensor<1, 2> value = displacement_at(solution, edge.cell, edge.face_no, s);
    if (place.has_other)
      value -= displacement_at(solution, place.other, place.other_face, place.on_other(s));
    const double u_0 = c == 1 || !has_gap ? 0.
                       : is_straight      ? at_nodes(place.on_slave(s))
                                          : gap_on_face(face, place.on_slave(s));
    return sign * (value * frame(result, t)[c]) - u_0;
  };
  for (unsigned int c = 0; c < 2; ++c)
    result.jump[c] = polynomial(n, solution.tables, [&](const double t) { return jump(t, c); });
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
          wishes[vertex].push_back(
              {mover.sign * frame(piece, end)[c], -value, c == 0 && piece.is_unilateral});
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
    for (const Wish &wish : all) // which polynomials beside a vertex know to different digits
      if (const double more = wish.direction * d - wish.value;
          wish.is_most && more > 0. && only.norm_square() == 0.)
        d -= more * wish.direction;
  }
}

/** What the pieces beside a cut ask of [d] there: what is exact decides, and where contact may open the one that asks for more. */
double JointLift::at_cut(const std::array<const Piece *, 2> &pieces, const unsigned int c)
{
  double value = 0;
  bool is_exact = false, may_open = c == 0;
  for (const unsigned int side : {0, 1})
    if (const Piece &piece = *pieces[side]; piece.is_joint && piece.modes[c] == exact)
    {
      const double wanted = -piece.jump[c](1. - side);
      value = is_exact ? std::min(value, wanted) : wanted;
      is_exact = true;
      may_open = may_open && piece.is_unilateral;
    }
  for (const unsigned int side : {0, 1})
    if (const Piece &piece = *pieces[side]; piece.is_joint && piece.modes[c] == below && may_open)
      value = std::min(value, -piece.jump[c](1. - side));
  return value;
}

/** d at both ends of each piece: at vertices it is known, at cuts between pieces it is what these ask for. */
void JointLift::set_ends(Mover &mover) const
{
  std::vector<Piece> &pieces = mover.pieces;
  pieces.front().at_ends[0] = at_vertices.at(mover.vertices[0]);
  pieces.back().at_ends[1] = at_vertices.at(mover.vertices[1]);
  for (unsigned int k = 0; k + 1 < pieces.size(); ++k)
  {
    Tensor<1, 2> d;
    for (unsigned int c = 0; c < 2; ++c)
    {
      Tensor<1, 2> direction;
      for (const unsigned int side : {0, 1})
        if (const Piece &piece = pieces[k + side];
            piece.is_joint &&
            (piece.modes[c] == exact || (piece.modes[c] == below && direction.norm_square() == 0.)))
          direction = frame(piece, 1. - side)[c];
      const double value = at_cut({{&pieces[k], &pieces[k + 1]}}, c);
      d += mover.sign * value * direction;
    }
    pieces[k].at_ends[1] = pieces[k + 1].at_ends[0] = d;
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

/** [d] along each piece, and d. */
void JointLift::set_changes(Mover &mover)
{
  for (Piece &piece : mover.pieces)
  {
    for (unsigned int c = 0; piece.is_joint && c < 2; ++c)
      set_change(piece, mover.sign, c);
    const std::size_t n = std::max({std::size_t(2), piece.change[0].coefficients().size(),
                                    piece.change[1].coefficients().size()});
    for (unsigned int c = 0; c < 2; ++c)
      piece.d[c] = polynomial(
          points_along(piece, n - 1), solution.tables,
          [&](const double t)
          {
            if (!piece.is_joint)
              return piece.at_ends[0][c] + t * (piece.at_ends[1][c] - piece.at_ends[0][c]);
            const auto [normal, tangent] = frame(piece, t);
            return mover.sign * (piece.change[0](t) * normal[c] + piece.change[1](t) * tangent[c]);
          });
  }
}

void JointLift::set_change(Piece &piece, const double sign, const unsigned int c)
{
  const std::array<double, 2> ends{{sign * (piece.at_ends[0] * frame(piece, 0.)[c]),
                                    sign * (piece.at_ends[1] * frame(piece, 1.)[c])}};
  EdgePolynomial &change = piece.change[c];
  change = polynomial(2, solution.tables,
                      [&](const double t) { return ends[0] + t * (ends[1] - ends[0]); });
  if (piece.modes[c] == any)
    return;
  const EdgePolynomial left = piece.jump[c] + change;
  const bool may_open = c == 0 && piece.is_unilateral;
  for (const unsigned int end : {0, 1})
    if (const double by = piece.modes[c] == exact && !may_open ? std::abs(left(end)) : left(end);
        by > round_off * std::max(size, piece.jump[c].largest()))
      set_flaw(piece, by);
  if (piece.modes[c] == exact)
  {
    std::vector<double> minus = piece.jump[c].coefficients();
    for (double &value : minus)
      value = -value;
    change = EdgePolynomial(minus);
    if (may_open)
    {
      const double begin = std::min(0., left(0.)), end = std::min(0., left(1.));
      change = change + polynomial(2, solution.tables,
                                   [&](const double t) { return begin + t * (end - begin); });
    }
  }
  else if (const double height = height_over(left, {{true, true}}, 1e-14 * size, solution.tables);
           height > 0.)
    change =
        change + polynomial(3, solution.tables,
                            [&](const double t) { return -(1. + 1e-10) * height * t * (1. - t); });
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
      values[j] = at->d[c]((s - at->place.begin) / (at->place.end - at->place.begin));
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
  moved = unknowns.expand(w);
  discretisation.condensation.extend(moved);
  moved += solution.u;
  change =
      A.energy(w) / 2 - solution.z * solution.spaces->contact_operator.moments(unknowns.expand(w));
}

/** d - w at t of a piece. */
Tensor<1, 2> JointLift::rest(const Mover &mover, const Piece &piece, const double t) const
{
  const double s = piece.place.begin + t * (piece.place.end - piece.place.begin);
  return Tensor<1, 2>({piece.d[0](t) - mover.w[0](s), piece.d[1](t) - mover.w[1](s)});
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
    const std::array<EdgePolynomial, 2> slopes{{piece.d[0].derivative(), piece.d[1].derivative()}};
    const double length = piece.place.end - piece.place.begin;
    const unsigned int n =
        std::max({piece.d[0].coefficients().size(), piece.d[1].coefficients().size(),
                  mover.w[0].coefficients().size()}) +
        4;
    for (unsigned int q = 0; q < n; ++q)
    {
      const double t = solution.tables.gauss(n).point(q)[0], s = piece.place.begin + t * length;
      const Tensor<1, 2> slope(
          {slopes[0](t) / length - slopes_of_w[0](s), slopes[1](t) / length - slopes_of_w[1](s)});
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
  const double energy = lift_energy(map, mover.edge->face_no, points,
                                    solution.scene.material_of(iterator), solution.tables) +
                        spring_energy(solution.scene, condition, map, mover.edge->face_no, points);
  cells[iterator->active_cell_index()] += std::sqrt(std::max(0., energy));
}

void JointLift::add_gaps(const Mover &mover, const Piece &piece)
{
  const ContactFace<2> &face = solution.contact_space.faces()[piece.place.face];
  const JointPiece &place = piece.place;
  const double length = place.end - place.begin;
  const EdgePolynomial u_t = piece.jump[1], left = piece.jump[1] + piece.change[1],
                       open = piece.left(0);
  const unsigned int n = std::max(u_t.coefficients().size(), open.coefficients().size());
  std::set<double> cuts{0., 1.};
  const bool has_friction = !face.friction.vanishes();
  for (const EdgePolynomial *const f : {&u_t, &left})
    if (has_friction && f->largest() > 1e-13 * size)
      for (const double zero : f->zeros())
        cuts.insert(zero);
  for (auto cut = cuts.begin(); std::next(cut) != cuts.end(); ++cut)
  {
    for (const auto &[own, weight] : tractions.points(place, place.begin + *cut * length,
                                                      place.begin + *std::next(cut) * length, n))
    {
      const double t = (own - place.begin) / length, s = place.on_slave(own),
                   ds = weight * tractions.measure(place, own);
      const Tensor<1, 2> tau = tractions.value(place.face, s);
      work -= mover.sign * ds * (tau * rest(mover, piece, t));
      if (piece.is_unilateral)
        gaps[place.face] -= ds * tractions.pressure(place.face, s) * open(t);
      if (!has_friction)
        continue;
      const double g = tractions.limit(place.face, s), U_t = piece.modes[1] == exact ? 0. : left(t);
      gaps[place.face] += ds * (g * std::abs(U_t) - (tau * face.node_frame(s).tangent) * U_t);
      work += ds * g * (std::abs(U_t) - std::abs(u_t(t)));
    }
  }
}

// @sect3{For Coulomb's law}
//
const JointLift::OnFace *JointLift::on_face(const unsigned int face, const double s) const
{
  for (const OnFace &piece : by_face[face])
    if (s >= piece.begin && s <= piece.end)
      return &piece;
  return nullptr;
}

namespace
{
/** Of a piece, where the slave's coordinate is s. */
double share_of(const JointPiece &place, const double s)
{
  return std::max(0.,
                  std::min(1., (place.from_slave(s) - place.begin) / (place.end - place.begin)));
}
} // namespace

double JointLift::slip(const unsigned int face, const double s) const
{
  const OnFace *const piece = on_face(face, s);
  return piece ? piece->left[1](share_of(piece->place, s)) : 0.;
}

double JointLift::room(const unsigned int face, const double s) const
{
  const OnFace *const piece = on_face(face, s);
  return piece ? -piece->left[0](share_of(piece->place, s))
               : std::numeric_limits<double>::infinity();
}

double JointLift::largest_slip(const unsigned int face) const
{
  double result = 0;
  for (const OnFace &piece : by_face[face])
    result = std::max(result, piece.left[1].largest());
  return result;
}

double JointLift::pressure(const unsigned int face, const double s) const
{
  return tractions.pressure(face, s);
}

double JointLift::direction(const unsigned int face, const double s) const
{
  return tractions.direction(face, s);
}

std::vector<double> JointLift::kinks(const unsigned int face) const
{
  std::set<double> result{0., 1.};
  for (const OnFace &piece : by_face[face])
    result.insert({piece.begin, piece.end});
  return {result.begin(), result.end()};
}

std::vector<std::pair<double, double>> JointLift::points(const unsigned int face) const
{
  std::vector<std::pair<double, double>> result;
  for (const OnFace &piece : by_face[face])
  {
    const JointPiece &place = piece.place;
    const double length = place.end - place.begin;
    std::vector<double> cuts{0., 1.};
    if (piece.left[1].largest() > 1e-13 * size)
      for (const double zero : piece.left[1].zeros())
        cuts.insert(cuts.end() - 1, zero);
    for (unsigned int i = 0; i + 1 < cuts.size(); ++i)
      for (const auto &[own, weight] : tractions.points(
               place, place.begin + cuts[i] * length, place.begin + cuts[i + 1] * length,
               std::max(piece.left[0].coefficients().size(), piece.left[1].coefficients().size()) +
                   3))
        result.emplace_back(place.on_slave(own), weight * tractions.measure(place, own));
  }
  return result;
}

JointLift::JointLift(const JointLift &of_U, const std::vector<Bump> &bumps)
    : cells(of_U.cells.size()), solution(of_U.solution), discretisation(of_U.discretisation),
      tractions(of_U.tractions)
{
  const auto has_bump = [&](const Piece &piece)
  { return piece.is_joint && !bumps[piece.place.face].is_zero(); };
  std::set<unsigned int> vertices;
  for (const Bump &bump : bumps)
    size = std::max(size, bump.largest());
  for (const Mover &mover : of_U.movers)
    if (std::any_of(mover.pieces.begin(), mover.pieces.end(), has_bump))
      vertices.insert(mover.vertices.begin(), mover.vertices.end());
  for (const Mover &mover : of_U.movers)
    if (vertices.count(mover.vertices[0]) > 0 || vertices.count(mover.vertices[1]) > 0)
      movers.push_back(mover);
  for (Mover &mover : movers)
    for (Piece &piece : mover.pieces)
    {
      if (!piece.is_joint)
        continue;
      const ContactFace<2> &face = solution.contact_space.faces()[piece.place.face];
      piece.is_unilateral = false;
      piece.modes = {{exact, face.condition->friction || face.condition->is_tied() ? exact : any}};
      piece.jump = {{polynomial(points_along(piece, 2), solution.tables,
                                [&](const double t)
                                {
                                  const double s =
                                      piece.place.begin + t * (piece.place.end - piece.place.begin);
                                  return -bumps[piece.place.face](piece.place.on_slave(s));
                                }),
                     EdgePolynomial::constant(0.)}};
    }
  move();
  require_own_corners(of_U.movers, 0.);
}

/** At a corner the same vertex may be one that another contact does not move, whose traces nobody looks at. */
void JointLift::require_own_corners(const std::vector<Mover> &that_move, const double least)
{
  std::set<const JointEdge *> moving;
  for (const Mover &mover : that_move)
    moving.insert(mover.edge);
  for (const JointEdge &edge : tractions.edges())
    for (unsigned int end = 0; moving.count(&edge) == 0 && end < 2; ++end)
      if (const auto moved = at_vertices.find(edge.cell->face(edge.face_no)->vertex_index(end));
          moved != at_vertices.end() && moved->second.norm() > least && flaw.empty())
        flaw = "another contact holds a corner";
}

double JointLift::lift(const std::vector<Bump> &bumps) const
{
  const JointLift X(*this, bumps);
  if (!X.flaw.empty())
    return std::numeric_limits<double>::infinity();
  double square = 0;
  for (unsigned int cell = 0; cell < X.cells.size(); ++cell)
    square += std::pow(std::sqrt(std::max(0., X.energies[cell])) + X.cells[cell], 2);
  return std::sqrt(square);
}
} // namespace hpvi
