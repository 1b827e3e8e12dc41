// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/bound/coulomb_coupling.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

namespace hpvi
{
using namespace dealii;

namespace
{
/** What spaces still miss of theta: a percent or two, as a rule. */
constexpr double margin = 1.05;

/** An edge of the boundary at one of its vertices. */
struct BoundaryEdge
{
  const BoundaryCondition<2> *condition;
  Tensor<1, 2> normal; ///< of the curve, or the direction that contact is along
  Point<2> vertex;
};

using EdgesAtVertices = std::map<unsigned int, std::vector<BoundaryEdge>>;

/** At ends of faces with friction that knows the pressure, and of what is opposite. */
EdgesAtVertices edges_at_vertices(const Solution<2> &solution)
{
  EdgesAtVertices result;
  const auto add_vertices = [&](const auto &cell, const unsigned int f)
  {
    for (unsigned int end = 0; end < 2; ++end)
      result[cell->face(f)->vertex_index(end)];
  };
  for (const ContactFace<2> &face : solution.contact_space.faces())
    if (face.condition->friction.knows_pressure())
    {
      add_vertices(face.cell, face.face_no);
      for (const ContactSegment<2> &segment : face.segments)
        add_vertices(segment.cell, segment.face_no);
    }
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->at_boundary(f) && cell->face(f)->boundary_id() < solution.scene.boundaries.size())
        for (unsigned int end = 0; end < 2; ++end)
          if (const auto found = result.find(cell->face(f)->vertex_index(end));
              found != result.end())
          {
            const BoundaryCondition<2> &condition =
                solution.scene.boundaries[cell->face(f)->boundary_id()];
            found->second.push_back({&condition,
                                     condition.held_direction(map_of<2>(cell).curve_normal(
                                         f, point_on_face<2>(f, Point<1>(end)))),
                                     cell->face(f)->vertex(end)});
          }
  return result;
}

/** Does an edge hold this component? A plate that moves in some way may do so along others. */
bool plate_holds(const RigidPlate<2> &plate, const unsigned int c, const bool of_X)
{
  const bool is_loose = plate.is_free(0) && plate.is_free(1) && plate.is_free(2);
  return of_X ? !is_loose : !plate.is_free(c) && !plate.is_free(2);
}

/**
 * Directions along which displacements vanish at an edge of the boundary: of v, or of the X with given traces. Another body holds nothing of
 * v, which may move with it.
 */
std::vector<Tensor<1, 2>> held_directions(const BoundaryEdge &edge, const bool of_X)
{
  const BoundaryCondition<2> &condition = *edge.condition;
  const Tensor<1, 2> tangent = -cross_product_2d(edge.normal);
  std::vector<Tensor<1, 2>> result;
  for (unsigned int c = 0; c < 2; ++c)
    if (condition.displacement[c] || (condition.plate && plate_holds(*condition.plate, c, of_X)))
      result.push_back(Point<2>::unit_vector(c));
  const bool follows_pressure = condition.is_unilateral() && condition.friction.knows_pressure(),
             is_symmetric = condition.holds_normal() && !condition.has_contact();
  if (is_symmetric || (of_X ? condition.has_contact() && !follows_pressure
                            : !condition.pair && condition.contact == Contact::bilateral))
    result.push_back(edge.normal);
  if (of_X && (condition.is_tied() || (condition.has_contact() && condition.friction)))
    result.push_back(tangent);
  return result;
}

/** Do v and X vanish at an edge of the boundary, or are they what a plate does there? */
bool is_clamped(const BoundaryEdge &edge)
{
  if (edge.condition->plate)
    return true;
  const std::vector<Tensor<1, 2>> held = held_directions(edge, false);
  return std::any_of(held.begin(), held.end(),
                     [&](const Tensor<1, 2> &direction)
                     { return std::abs(cross_product_2d(held.front()) * direction) > 1e-6; });
}

/** The angle of the body at those of the vertices where boundaries of two conditions meet. */
std::map<unsigned int, double> angles_at_vertices(const Solution<2> &solution,
                                                  const EdgesAtVertices &edges)
{
  std::map<unsigned int, double> result;
  for (const auto &[vertex, around] : edges)
    if (around.size() == 2 && around[0].condition != around[1].condition)
      result[vertex] = 0.;
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
    for (unsigned int v = 0; v < 4; ++v)
      if (const auto found = result.find(cell->vertex_index(v)); found != result.end())
      {
        const Tensor<2, 2> J =
            transpose(map_of<2>(cell).jacobian(GeometryInfo<2>::unit_cell_vertex(v)));
        const Tensor<1, 2> a = (v & 1U ? -1. : 1.) * J[0], b = (v & 2U ? -1. : 1.) * J[1];
        found->second += std::acos((a * b) / (a.norm() * b.norm()));
      }
  return result;
}
} // namespace

double half_plane_coupling(const Material &material)
{
  if (material.orthotropy)
    return 1.;
  const double kappa = material.kolosov(), beta = (kappa - 1) / (kappa + 1);
  return 1. / std::sqrt(1. - beta * beta);
}

namespace
{
/** d'Md/(det M)^{1/2} for the unit vector d with @p along the first axis. */
double share_along(const double along, const double across, const double tt, const double nn,
                   const double tn)
{
  return (along * along * tt + across * across * nn + 2 * along * across * tn) /
         std::sqrt(tt * nn - tn * tn);
}
} // namespace

double free_wedge_coupling(const double angle, const double turn)
{
  const double tt = angle / 2 + std::sin(2 * angle) / 4, nn = angle / 2 - std::sin(2 * angle) / 4,
               tn = std::pow(std::sin(angle), 2) / 2;
  return share_along(std::sin(turn), -std::cos(turn), tt, nn, tn);
}

double clamped_wedge_coupling(const double angle, const Material &material, const double turn)
{
  if (material.orthotropy)
    return 1.;
  const double kappa = material.kolosov(), ratio = (kappa - 1) / (kappa + 1), // mu/(lambda + 2 mu)
      half = angle / 2, wave = std::sin(2 * angle) / 4, tt = ratio * (half - wave) + half + wave,
               nn = ratio * (half + wave) + half - wave,
               tn = (1 - ratio) * std::pow(std::sin(angle), 2) / 2;
  return share_along(std::cos(turn), std::sin(turn), tt, nn, tn);
}

/** What meets at the vertices of the boundary. */
struct CoulombCoupling::Boundary
{
  EdgesAtVertices edges;
  std::map<unsigned int, double> angles;
};

CoulombCoupling::CoulombCoupling(const Solution<2> &solution, CouplingSpaces &spaces)
    : solution(solution), spaces(spaces), boundary(new Boundary{edges_at_vertices(solution), {}})
{
  boundary->angles = angles_at_vertices(solution, boundary->edges);
}

CoulombCoupling::~CoulombCoupling() = default;

/** Multipliers by what v and X have of them. */
struct CoulombCoupling::Unknowns
{
  std::vector<unsigned int> friction, pressures; ///< of the same points
  std::vector<double> coefficients;              ///< mu_f chi there
  std::vector<unsigned int> held;                ///< v has no trace there
};

CoulombCoupling::Unknowns CoulombCoupling::unknowns(const ContactCompliance &compliance,
                                                    const FrictionAlong &friction) const
{
  const ContactSpace<2> &space = compliance.spaces->contact_space;
  const std::vector<ContactMultiplier<2>> &multipliers = space.multipliers();
  Unknowns result;
  std::vector<bool> is_taken(multipliers.size());
  for (unsigned int k = 0; k < space.faces().size(); ++k)
  {
    const ContactFace<2> &face = space.faces()[k];
    if (!face.condition->friction.knows_pressure())
      continue;
    const QGauss<1> &gauss = compliance.spaces->tables->gauss(std::max(1U, face.n_multipliers));
    const EdgePart edge(face.cell, face.face_no);
    for (unsigned int i = 0; i < face.n_multipliers; ++i)
    {
      const unsigned int t = face.first_multiplier + i, n = multipliers[t].partner;
      const double s = gauss.point(i)[0];
      const FrictionAlong::Value value = friction(edge, s, face.point(s));
      if (value.sticks)
        result.held.push_back(t);
      else if (n == numbers::invalid_unsigned_int)
        continue;
      else
      {
        result.friction.push_back(t);
        result.pressures.push_back(n);
        result.coefficients.push_back(value.coefficient);
      }
      is_taken[t] = true;
    }
  }
  for (unsigned int i = 0; i < multipliers.size(); ++i)
    if (multipliers[i].is_bilateral && !is_taken[i])
      result.held.push_back(i);
  if (const auto missed = friction.missed_by(space.faces()))
    throw NumericalFailure("friction at " + to_string(*missed) +
                           " has no point in the space of its coupling");
  return result;
}

double CoulombCoupling::of_matrices(const SlipDirection &chi, const std::vector<bool> &sticks) const
{
  const FrictionAlong friction(solution.contact_space.faces(), chi, sticks);
  ContactCompliance &compliance = spaces.of(solution, friction);
  const Unknowns all = unknowns(compliance, friction);
  if (all.friction.empty())
    return 0.;
  return std::sqrt(std::max(0., compliance.matrices(all.friction, all.pressures, all.held)
                                    .largest_eigenvalue(Vector<double>(all.coefficients.begin(),
                                                                       all.coefficients.end()))));
}

/**
 * The displacements whose products with v are its moments and those of T v, in coordinates in which |v| is Euclid's norm: three kinds of v,
 * nine of T v, in units of their own; the longest of each counts alike.
 */
FullMatrix<double> CoulombCoupling::moment_columns(ContactCompliance &compliance,
                                                   const Unknowns &all,
                                                   const CouplingMatrices &matrices,
                                                   const Vector<double> &D,
                                                   const std::vector<std::vector<double>> &rows)
{
  const unsigned int n = all.friction.size(), n_moments = rows[0].size(),
                     n_cells = n_moments / StripMoments::n_kinds;
  FullMatrix<double> R(rows.size(), n_moments), E(rows.size(), n);
  for (unsigned int i = 0; i < rows.size(); ++i)
    std::copy(rows[i].begin(), rows[i].end(), R.begin(i));
  for (unsigned int j = 0; j < n; ++j)
    E(all.pressures[j], j) = 1.;
  std::vector<unsigned int> every(n_moments);
  std::iota(every.begin(), every.end(), 0U);
  const FullMatrix<double> &S = compliance.matrix();
  FullMatrix<double> of_v = part(R, all.friction, every);
  if (!all.held.empty())
    of_v.add(-1., reduced(part(S, all.held, all.held), part(S, all.held, all.friction),
                          part(R, all.held, every)));
  FullMatrix<double> of_X = reduced(S, E, R);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n_moments; ++j)
      of_X(i, j) *= D[i];
  FullMatrix<double> W(n, 3 * n_cells + n_moments);
  W.fill(matrices.by_factor(of_v), 0, 0, 0, 0); // whose moments of a kind stand together
  W.fill(matrices.times_factor(of_X), 0, 3 * n_cells, 0, 0);
  for (unsigned int first = 0; first < W.n(); first += n_cells)
  {
    double longest = 0;
    for (unsigned int j = first; j < first + n_cells; ++j)
    {
      double square = 0;
      for (unsigned int i = 0; i < n; ++i)
        square += W(i, j) * W(i, j);
      longest = std::max(longest, std::sqrt(square));
    }
    for (unsigned int i = 0; longest > 0. && i < n; ++i)
      for (unsigned int j = first; j < first + n_cells; ++j)
        W(i, j) /= longest;
  }
  return W;
}

CoulombCoupling::Localised CoulombCoupling::localised(const ContactStrip &strip,
                                                      const SlipDirection &chi,
                                                      const std::vector<bool> &sticks) const
{
  Localised result;
  result.above = (*this)(chi, sticks);
  if (!(result.above <= largest_coupling))
    return result;
  const FrictionAlong friction(solution.contact_space.faces(), chi, sticks);
  const FrictionOnStrip on_strip(strip, solution.contact_space.faces(), friction);
  const StripCells cells(solution.scene, strip, on_strip);
  result.kappa = cells.kappa;
  result.n_cells = cells.n_cells;
  result.above = std::max(result.above, cells.kappa);
  if (!(result.above <= largest_coupling))
    return result;
  std::optional<StripMoments> moments;
  std::vector<std::vector<double>> rows; // of moments, by multiplier
  ContactCompliance compliance = spaces.on(
      cells.mesh, solution, friction,
      [&](const Spaces<2> &of_cells)
      {
        moments.emplace(strip, cells, of_cells, solution.scene.materials.front());
        return [&](const Solution<2> &response) { rows.push_back(moments->of(response)); };
      });
  const Unknowns all = unknowns(compliance, friction);
  if (all.friction.empty())
    return result;
  const Vector<double> D(all.coefficients.begin(), all.coefficients.end());
  const CouplingMatrices &matrices = compliance.matrices(all.friction, all.pressures, all.held);
  const FullMatrix<double> W = moment_columns(compliance, all, matrices, D, rows);
  const auto [largest, on_complement] =
      with_complement(matrices.symmetric(D), W, cells.kappa * cells.kappa);
  result.above = std::max(result.above, std::sqrt(largest));
  result.on_complement = std::sqrt(std::max(0., on_complement));
  return result;
}

double CoulombCoupling::closed_forms(const SlipDirection &chi,
                                     const std::vector<bool> &sticks) const
{
  const std::vector<ContactFace<2>> &faces = solution.contact_space.faces();
  const auto &[edges, angles] = *boundary;
  double result = 0;
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    if (!chi[k] || (!sticks.empty() && sticks[k]))
      continue;
    const auto at = [&](const double s)
    { return std::abs(chi[k](s)) * faces[k].friction_coefficient(faces[k].point(s)); };
    const bool is_pair =
        !faces[k].segments.empty(); // between like bodies theta is 1, else less than each
    const double half_plane =
        is_pair ? 1. : half_plane_coupling(solution.scene.material_of(faces[k].cell));
    for (unsigned int i = 0; i <= 8; ++i)
      result = std::max(result, half_plane * at(i / 8.));
    for (unsigned int end = 0; end < 2 && !is_pair; ++end)
    {
      const unsigned int vertex = faces[k].cell->face(faces[k].face_no)->vertex_index(end);
      const auto found = angles.find(vertex);
      if (found == angles.end())
        continue;
      const double angle = found->second;
      const ContactFrame<2> side = contact_frame(faces[k].map, faces[k].face_no, Point<1>(end));
      const double inwards = (faces[k].point(0.5) - side.x) * side.tangent < 0. ? -1. : 1.;
      const Tensor<1, 2> normal = faces[k].node_frame(end).normal;
      const double turn = std::atan2(inwards * (side.tangent * normal), side.normal * normal);
      for (const BoundaryEdge &edge : edges.at(vertex))
        if (edge.condition == faces[k].condition)
          continue;
        else if (is_clamped(edge))
          result = std::max(result,
                            at(end) * clamped_wedge_coupling(
                                          angle, solution.scene.material_of(faces[k].cell), turn));
        else if (held_directions(edge, true).empty())
          result = std::max(result, at(end) * free_wedge_coupling(angle, turn));
    }
  }
  return result;
}

namespace
{
/** A place at which mu_f chi jumps on a face, or between two that follow each other, seen from the inside of each; nothing: there is none. */
std::optional<Point<2>> jump_of_coefficient(const std::vector<ContactFace<2>> &faces,
                                            const SlipDirection &chi,
                                            const std::vector<bool> &sticks)
{
  // Where mu_f has a root in it, its values near a vertex differ, and by less the nearer they are.
  constexpr double hairs[] = {1e-7, 1e-11}, round_off = 1e-9;
  struct End
  {
    Tensor<1, 2> normal;
    std::array<double, 2> values; ///< by each hair, of a straight line through two values
  };
  std::map<unsigned int, End> at_vertices;
  double largest = 0;
  const auto value = [&](const unsigned int k, const double s)
  { return faces[k].friction_coefficient(faces[k].point(s)) * chi[k](s); };
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (const double s : {0., 0.5, 1.})
      if (chi[k])
        largest = std::max(largest, std::abs(value(k, s)));
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    if (!chi[k] || (!sticks.empty() && sticks[k]))
      continue;
    for (const CutRule::Jump &jump : faces[k].coefficient.jumps)
      if (std::abs(jump.height * chi[k](jump.s)) > round_off * largest)
        return faces[k].point(jump.s);
    for (unsigned int end = 0; end < 2; ++end)
    {
      End own{faces[k].node_frame(end).normal, {}};
      for (unsigned int i = 0; i < 2; ++i)
      {
        const double inwards = end == 0 ? hairs[i] : -hairs[i];
        own.values[i] = 2 * value(k, end + inwards) - value(k, end + 2 * inwards);
      }
      const auto [known, is_new] =
          at_vertices.emplace(faces[k].cell->face(faces[k].face_no)->vertex_index(end), own);
      const double far = std::abs(known->second.values[0] - own.values[0]),
                   near = std::abs(known->second.values[1] - own.values[1]);
      if (!is_new && (known->second.normal - own.normal).norm() < 1e-6 &&
          near > std::max(round_off * largest, 0.5 * far))
        return faces[k].point(end);
    }
  }
  return std::nullopt;
}

bool is_of_pair(const std::vector<BoundaryEdge> &around, const BoundaryCondition<2> &side)
{
  return std::any_of(around.begin(), around.end(),
                     [&](const BoundaryEdge &edge) { return edge.condition->pair == side.pair; });
}
} // namespace

std::string CoulombCoupling::unbounded_at(const SlipDirection &chi,
                                          const std::vector<bool> &sticks) const
{
  const std::vector<ContactFace<2>> &faces = solution.contact_space.faces();
  const EdgesAtVertices &edges = boundary->edges;
  const double near = 1e-9 * solution.scene.geometry.diameter();
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    if (!chi[k] || (!sticks.empty() && sticks[k]))
      continue;
    for (unsigned int end = 0; end < 2; ++end)
    {
      const Point<2> x = faces[k].point(end);
      if (std::abs(chi[k](end)) * faces[k].friction_coefficient(x) < 1e-8)
        continue;
      const ContactFrame<2> frame = faces[k].node_frame(end);
      const auto is_bad = [&](const std::vector<BoundaryEdge> &around)
      {
        if (around.size() == 2 && around[0].condition == around[1].condition &&
            around[0].normal * around[1].normal > 1. - 1e-12)
          return false; // inside of contact
        bool X_vanishes = false;
        Tensor<1, 2> first;
        bool v_vanishes = false;
        for (const BoundaryEdge &edge : around)
        {
          for (const Tensor<1, 2> &direction : held_directions(edge, true))
            X_vanishes = X_vanishes || std::abs(direction * frame.normal) > 1e-6;
          for (const Tensor<1, 2> &direction : held_directions(edge, false))
          {
            v_vanishes =
                v_vanishes || std::abs(direction * frame.normal) < 1e-6 ||
                (first.norm() > 0. && std::abs(cross_product_2d(first) * direction) > 1e-6);
            first = direction;
          }
        }
        return X_vanishes && !v_vanishes;
      };
      // Of two bodies either may lift.
      bool all_are_bad = is_bad(edges.at(faces[k].cell->face(faces[k].face_no)->vertex_index(end)));
      if (all_are_bad && !faces[k].segments.empty())
        for (const auto &[vertex, around] : edges)
          all_are_bad = all_are_bad && (around[0].vertex.distance(x) >= near ||
                                        !is_of_pair(around, *faces[k].condition) || is_bad(around));
      if (all_are_bad)
        return "contact with friction ends at " + to_string(x) +
               ", where the body can slide but not lift, and no coupling is finite";
    }
  }
  if (const auto x = jump_of_coefficient(faces, chi, sticks))
    return "mu_f, or the share of it that friction has, jumps at " + to_string(*x) +
           ", and no coupling is finite";
  return {};
}

double CoulombCoupling::operator()(const SlipDirection &chi, const std::vector<bool> &sticks) const
{
  return std::max(margin * of_matrices(chi, sticks), closed_forms(chi, sticks));
}
} // namespace hpvi
