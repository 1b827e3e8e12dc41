// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/bound/coulomb_coupling.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace hpvi
{
using namespace dealii;

namespace
{
/** What spaces still miss of theta: a percent or two, as a rule; degrees p + 1 on the mesh of the step up to 15 percent. */
constexpr double margin = 1.05, margin_between_bodies = 1.2;

/** An edge of the boundary at one of its vertices. */
struct BoundaryEdge
{
  const BoundaryCondition<2> *condition;
  Tensor<1, 2> normal; ///< of the curve, or the direction that contact is along
  Point<2> vertex;
};

using EdgesAtVertices = std::map<unsigned int, std::vector<BoundaryEdge>>;

EdgesAtVertices edges_at_vertices(const Solution<2> &solution)
{
  EdgesAtVertices result;
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary() &&
          cell->face(f)->boundary_id() < solution.scene.boundaries.size())
        for (unsigned int end = 0; end < 2; ++end)
        {
          const BoundaryCondition<2> &condition =
              solution.scene.boundaries[cell->face(f)->boundary_id()];
          result[cell->face(f)->vertex_index(end)].push_back(
              {&condition,
               condition.held_direction(
                   map_of<2>(cell).curve_normal(f, point_on_face<2>(f, Point<1>(end)))),
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

/** The angle of the body at a vertex. */
std::map<unsigned int, double> angles_at_vertices(const Solution<2> &solution)
{
  std::map<unsigned int, double> result;
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
    if (cell->at_boundary())
      for (unsigned int v = 0; v < 4; ++v)
      {
        const Tensor<2, 2> J =
            transpose(map_of<2>(cell).jacobian(GeometryInfo<2>::unit_cell_vertex(v)));
        const Tensor<1, 2> a = (v & 1U ? -1. : 1.) * J[0], b = (v & 2U ? -1. : 1.) * J[1];
        result[cell->vertex_index(v)] += std::acos((a * b) / (a.norm() * b.norm()));
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
    : solution(solution), spaces(spaces),
      boundary(new Boundary{edges_at_vertices(solution), angles_at_vertices(solution)}),
      raised(spaces.raised(solution))
{
}

CoulombCoupling::~CoulombCoupling() = default;

namespace
{
/** A face whose friction has no point in the space would be left out of the coupling. */
void require_all_seen(const ContactSpace<2> &space, const FrictionAlong &friction)
{
  for (const auto &[edge, x] : friction.acting())
    if (std::none_of(space.faces().begin(), space.faces().end(),
                     [&, edge = edge](const ContactFace<2> &face)
                     {
                       const EdgePart own(face.cell, face.face_no);
                       return face.n_multipliers > 0 &&
                              (own.has_middle_of(edge) || edge.has_middle_of(own));
                     }))
      throw NumericalFailure("friction at " + to_string(x) +
                             " has no point in the space of its coupling");
}
} // namespace

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
  const std::vector<ContactFace<2>> &known = solution.contact_space.faces();
  const auto is_same = [](const ContactFace<2> &one, const ContactFace<2> &other)
  {
    return one.cell->active_cell_index() == other.cell->active_cell_index() &&
           one.face_no == other.face_no;
  };
  if (raised && !std::equal(known.begin(), known.end(), space.faces().begin(), space.faces().end(),
                            is_same)) // the slave may be another one
    throw NumericalFailure("contact has other faces at higher degrees");
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
      const FrictionAlong::Value value =
          raised ? friction.on_face(k, s) : friction(edge, s, face.point(s));
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
  if (!raised)
    require_all_seen(space, friction);
  return result;
}

double CoulombCoupling::of_matrices(const SlipDirection &chi, const std::vector<bool> &sticks) const
{
  const FrictionAlong friction(solution.contact_space.faces(), chi, sticks);
  ContactCompliance &compliance = raised ? *raised : spaces.of(solution, friction);
  const Unknowns all = unknowns(compliance, friction);
  if (all.friction.empty())
    return 0.;
  return std::sqrt(std::max(0., compliance.matrices(all.friction, all.pressures, all.held)
                                    .largest_eigenvalue(Vector<double>(all.coefficients.begin(),
                                                                       all.coefficients.end()))));
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
      const auto found = edges.find(vertex);
      if (found == edges.end() || found->second.size() != 2)
        continue;
      const ContactFrame<2> side = contact_frame(faces[k].map, faces[k].face_no, Point<1>(end));
      const double inwards = (faces[k].point(0.5) - side.x) * side.tangent < 0. ? -1. : 1.,
                   angle = angles.at(vertex);
      const Tensor<1, 2> normal = faces[k].node_frame(end).normal;
      const double turn = std::atan2(inwards * (side.tangent * normal), side.normal * normal);
      for (const BoundaryEdge &edge : found->second)
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
/** A place at which mu_f jumps on a face, or between two that follow each other, seen from the inside of each; nothing: there is none. */
std::optional<Point<2>> jump_of_coefficient(const std::vector<ContactFace<2>> &faces,
                                            const SlipDirection &chi,
                                            const std::vector<bool> &sticks)
{
  constexpr double hair = 1e-7;
  struct End
  {
    Tensor<1, 2> normal;
    double mu;
  };
  std::map<unsigned int, End> at_vertices;
  double largest = 0;
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (const double s : {0., 0.5, 1.})
      if (chi[k])
        largest = std::max(largest,
                           faces[k].friction_coefficient(faces[k].point(s)) * std::abs(chi[k](s)));
  const auto differ = [&](const double a, const double b)
  { return std::abs(a - b) > 1e-3 * largest; };
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    if (!chi[k] || (!sticks.empty() && sticks[k]))
      continue;
    const auto mu = [&](const double s)
    { return faces[k].friction_coefficient(faces[k].point(s)) * chi[k](s); };
    for (const double cut : faces[k].coefficient.cuts)
      if (cut > hair && cut < 1 - hair && differ(mu(cut - hair), mu(cut + hair)))
        return faces[k].point(cut);
    for (unsigned int end = 0; end < 2; ++end)
    {
      const End own{faces[k].node_frame(end).normal, mu(end == 0 ? hair : 1 - hair)};
      const auto [known, is_new] =
          at_vertices.emplace(faces[k].cell->face(faces[k].face_no)->vertex_index(end), own);
      if (!is_new && (known->second.normal - own.normal).norm() < 1e-6 &&
          differ(known->second.mu, own.mu))
        return faces[k].point(end);
    }
  }
  return std::nullopt;
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
      // Next to all ends of faces are inside of contact, and none of them is bad.
      const unsigned int own = faces[k].cell->face(faces[k].face_no)->vertex_index(end);
      if (const auto found = edges.find(own); found != edges.end() && !is_bad(found->second))
        continue;
      bool is_here = false, all_are_bad = true;
      for (const auto &[vertex, around] : edges)
        if (around[0].vertex.distance(x) < near)
        {
          is_here = true;
          all_are_bad = all_are_bad && is_bad(around);
        }
      if (is_here && all_are_bad)
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
  return std::max((raised ? margin_between_bodies : margin) * of_matrices(chi, sticks),
                  closed_forms(chi, sticks));
}
} // namespace hpvi
