// SPDX-License-Identifier: LGPL-2.1-or-later

// @sect3{Under Coulomb's law}
//
// Theorem (C) of doc/coulomb.md in space: chi, |chi| <= 1, is a vector along contact and M' >= mu_f (|U_t| - chi . U_t) - (u_0 - U_n). The proof is
// the same.
#include <hpvi/base/formatting.h>
#include <hpvi/base/numbers.h>
#include <hpvi/base/text.h>
#include <hpvi/bound/coulomb_bound.h>
#include <hpvi/bound/coulomb_coupling.h>
#include <hpvi/space/box_bound_stages.h>
#include <hpvi/space/friction_coupling.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double margin = 1.05;  ///< what is still missed of theta
constexpr double reserve = 1.1;  ///< of what the samples of a face miss between them
constexpr double no_slip = 1e-8; ///< of mu_f chi

/** So many equidistant points in [0,1], both ends with them. */
std::vector<double> equidistant(const unsigned int n)
{
  std::vector<double> result(n);
  for (unsigned int i = 0; i < n; ++i)
    result[i] = double(i) / (n - 1);
  return result;
}
} // namespace

/** Has friction on the face a pressure beside it? */
bool BoxBound::couples(const ContactDofFace<3> &face) const
{
  return face.has_friction() && face.has_pressure() &&
         space.condition(face.cell, face.face).friction.knows_pressure();
}

/**
 * chi has to be continuous along each side: a Bernstein coefficient that faces share becomes the mean of those of faces on which friction acts,
 * which is in the disc as these are. It is zero where a support holds it, and where nothing acts, but for what neighbours have.
 */
void BoxBound::join_directions()
{
  // By unknown and axis of the side: at an edge of two sides an unknown belongs to both, and is another component of chi.
  std::vector<double> sums(3 * space.dof_handler.n_dofs()), counts(sums.size());
  std::vector<std::vector<std::vector<types::global_dof_index>>> dofs;
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    const ContactDofFace<3> &face = space.faces[k];
    dofs.push_back(face_dofs(face));
    const bool acts = space.condition(face.cell, face.face).friction.bound ||
                      (face.has_pressure() && *std::max_element(contact[k].pressure.begin(),
                                                                contact[k].pressure.end()) > 0);
    if (!couples(face) || !acts)
      continue;
    const auto axes = tangents<3>(face.face);
    for (unsigned int t = 0; t < 2; ++t)
      for (unsigned int i = 0; i < contact[k].lambda[t].size(); ++i)
      {
        const auto place = 3 * dofs[k][axes[t]][i] + face.face / 2;
        sums[place] += contact[k].lambda[t][i];
        ++counts[place];
      }
  }
  DistributedVector chi = space.ghosted_vector();
  for (const unsigned int k : coarse_first())
    if (const unsigned int side = space.faces[k].face; couples(space.faces[k]))
      for (unsigned int t = 0; t < 2; ++t)
      {
        const auto &own = dofs[k][tangents<3>(side)[t]];
        for (unsigned int i = 0; i < own.size(); ++i)
        {
          const auto place = 3 * own[i] + side / 2;
          contact[k].lambda[t][i] =
              counts[place] > 0 && !is_supported(own[i]) ? sums[place] / counts[place] : 0.;
        }
        set_trace(own, 1., contact[k].lambda[t], chi);
      }
}

/** Is a displacement prescribed, or held on a plane? */
bool BoxBound::is_supported(const types::global_dof_index dof) const
{
  const auto *const entries = space.constraints.get_constraint_entries(dof);
  return entries && entries->empty();
}

/** By face: does it stick as all beside it do, without a rest of slip? */
std::vector<bool> BoxBound::zones() const
{
  const std::vector<bool> is_held = held();
  std::vector<bool> result;
  for (const ContactDofFace<3> &face : space.faces)
  {
    bool sticks = couples(face);
    const auto dofs = face_dofs(face);
    for (unsigned int t = 0; sticks && t < 2; ++t)
    {
      const auto &own = dofs[tangents<3>(face.face)[t]];
      const BoxModes slip = slip_trace(own), of_w = trace_of(w, own);
      for (unsigned int i = 0; i < own.size(); ++i)
        sticks =
            sticks && is_held[own[i]] && std::abs(slip[i] - of_w[i]) <= 1e-11 * u.linfty_norm();
    }
    result.push_back(sticks);
  }
  return result;
}

/** "bottom sticks on 12 faces between (0 0 0) and (1 0 1)", by boundaries. */
std::string BoxBound::in_words(const std::vector<bool> &zones) const
{
  std::map<types::boundary_id, std::pair<unsigned int, BoundingBox<3>>> places;
  for (unsigned int k = 0; k < zones.size(); ++k)
    if (zones[k])
    {
      const auto face = space.faces[k].cell->face(space.faces[k].face);
      auto &[n, box] =
          places.emplace(face->boundary_id(), std::pair(0U, face->bounding_box())).first->second;
      ++n;
      box.merge_with(face->bounding_box());
    }
  std::string result;
  for (const auto &[boundary, place] : places)
    result += (result.empty() ? "" : ", ") + printable(space.scene.boundaries[boundary].name) +
              " sticks on " + std::to_string(place.first) +
              (place.first == 1 ? " face" : " faces") + " between " +
              to_string(place.second.get_boundary_points().first) + " and " +
              to_string(place.second.get_boundary_points().second);
  return result;
}

/** mu_f chi at contact dofs of a space on the same mesh, but for @p zones. */
std::vector<ContactVector<3>> BoxBound::couplings(const PrimalSpace<3> &at,
                                                  const std::vector<bool> &zones) const
{
  std::vector<ContactVector<3>> result(at.contact.size());
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    const ContactDofFace<3> &face = at.faces[k];
    if (!couples(space.faces[k]) || zones[k])
      continue;
    const auto axes = tangents<3>(face.face);
    const Tensor<1, 3> size = PrimalSpace<3>::extent(face.cell);
    const Point<3> corner = map_of<3>(face.cell).point(Point<3>());
    for (unsigned int i = 0; i < at.tables.only().n_contact_dofs(); ++i)
    {
      const Point<3> x = at.contact[face.friction + i].x;
      const auto a = bernstein(p, (x - corner)[axes[0]] / size[axes[0]]),
                 b = bernstein(p, (x - corner)[axes[1]] / size[axes[1]]);
      Tensor<1, 3> chi;
      for (unsigned int t = 0; t < 2; ++t)
        for (unsigned int j = 0; j < contact[k].lambda[t].size(); ++j)
          chi[axes[t]] += a[j % (p + 1)] * b[j / (p + 1)] * contact[k].lambda[t][j];
      for (unsigned int s = 0; s < 2; ++s)
        result[face.friction + i][s] =
            at.condition(face.cell, face.face).friction.coefficient_at(x) *
            (chi * face.direction(face.tangential(s)));
    }
  }
  return result;
}

/** theta of chi beside @p zones, in the space of this degree on the mesh. */
double BoxBound::coupling_of(const unsigned int degree, const std::vector<bool> &zones)
{
  const auto found = [&](const PrimalSpace<3> &at, NewtonMatrix<3> &with)
  {
    std::vector<bool> sticks(at.contact.size());
    for (unsigned int k = 0; k < zones.size(); ++k)
      for (unsigned int i = 0; zones[k] && i < at.tables.only().n_contact_dofs(); ++i)
        sticks[at.faces[k].friction + i] = true;
    return friction_coupling(at, with, couplings(at, zones), sticks);
  };
  if (degree == p)
    return found(space, matrix);
  const DegreeTables<3> tables(degree);
  const PrimalSpace<3> other(
      space.scene,
      dynamic_cast<const PrimalSpace<3>::Mesh &>(space.dof_handler.get_triangulation()), tables);
  require_room(other);
  PrimalSystem<3> system(other);
  NewtonMatrix<3> of_degree(other, system, matrix.method);
  return found(other, of_degree);
}

/**
 * theta of the body: what one degree more adds is added once more, for those that are still to come. From degree 4 on, where products without
 * a matrix end, of the degree before.
 */
double BoxBound::coupling(const std::vector<bool> &zones)
{
  const unsigned int higher = p < 4 ? p + 1 : p;
  const double before = coupling_of(higher - 1, zones), value = coupling_of(higher, zones);
  return value + std::max(0., value - before);
}

/** Unknowns at which X has no value: along friction, and across other contact that has a pressure. */
std::set<types::global_dof_index> BoxBound::without_lift() const
{
  std::set<types::global_dof_index> result;
  for (const ContactDofFace<3> &face : space.faces)
  {
    const auto dofs = face_dofs(face);
    for (unsigned int c = 0; c < 3; ++c)
      if (c == face.face / 2 ? face.has_pressure() && !couples(face) : face.has_friction())
        result.insert(dofs[c].begin(), dofs[c].end());
  }
  return result;
}

/** A place at which mu_f jumps on a face, or between two of them, seen from the inside of each; nothing: there is none. */
std::optional<Point<3>> BoxBound::jump_of_coefficient(const std::vector<bool> &zones) const
{
  constexpr unsigned int n = 33;
  constexpr double hair = 1e-7;
  std::map<types::global_dof_index, double> at_nodes;
  for (unsigned int number = 0; number < space.faces.size(); ++number)
  {
    const ContactDofFace<3> &face = space.faces[number];
    if (!couples(face) || zones[number])
      continue;
    const CellMap<3> map = map_of<3>(face.cell);
    const FrictionLaw<3> &friction = space.condition(face.cell, face.face).friction;
    const auto point = [&](const double s, const double t) {
      return map.point(on_cell_face(face.face, {{s, t, 0.}}));
    };
    const auto mu = [&](const double s, const double t)
    {
      return friction.coefficient_at(
          point(std::clamp(s, hair, 1 - hair), std::clamp(t, hair, 1 - hair)));
    };
    const auto dofs = face_dofs(face)[face.face / 2];
    double largest = 0;
    const auto differ = [&](const double a, const double b)
    { return std::abs(a - b) > 1e-3 * largest; };
    for (unsigned int i = 0; i < dofs.size(); ++i)
      largest = std::max(largest, mu(of.nodes[i % (p + 1)], of.nodes[i / (p + 1)]));
    for (unsigned int i = 0; i < dofs.size(); ++i)
    {
      const double s = of.nodes[i % (p + 1)], t = of.nodes[i / (p + 1)];
      const auto [known, is_new] = at_nodes.emplace(dofs[i], mu(s, t));
      if (!is_new && differ(known->second, mu(s, t)))
        return point(s, t);
    }
    for (const double across : of.nodes)
      for (const bool is_first : {true, false})
      {
        const auto along = [&](const double x) { return is_first ? mu(x, across) : mu(across, x); };
        for (unsigned int k = 0; k + 1 < n; ++k)
        {
          double a = double(k) / (n - 1), b = double(k + 1) / (n - 1);
          for (unsigned int halves = 0; halves < 20 && differ(along(a), along(b)); ++halves)
          {
            const double middle = (a + b) / 2;
            (std::abs(along(a) - along(middle)) > std::abs(along(b) - along(middle)) ? b : a) =
                middle;
          }
          if (differ(along(a), along(b)))
            return is_first ? point(a, across) : point(across, a);
        }
      }
  }
  return std::nullopt;
}

/** Where no coupling is finite: something holds the normal displacement at an edge of contact and leaves what slips, or mu_f jumps. Empty: nowhere. */
std::string BoxBound::unbounded(const std::vector<bool> &zones) const
{
  std::vector<bool> is_held(space.dof_handler.n_dofs());
  for (const auto dof : space.owned)
    is_held[dof] = is_supported(dof);
  for (const auto dof : without_lift())
    is_held[dof] = true;
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    const ContactDofFace<3> &face = space.faces[k];
    if (!couples(face) || zones[k])
      continue;
    const auto dofs = face_dofs(face);
    const CellMap<3> map = map_of<3>(face.cell);
    for (unsigned int i = 0; i < dofs[0].size(); ++i)
      for (unsigned int t = 0; t < 2; ++t)
      {
        const Point<3> x = map.point(
            on_cell_face(face.face, {{of.nodes[i % (p + 1)], of.nodes[i / (p + 1)], 0.}}));
        if (is_held[dofs[face.face / 2][i]] && !is_supported(dofs[tangents<3>(face.face)[t]][i]) &&
            std::abs(contact[k].lambda[t][i]) *
                    space.condition(face.cell, face.face).friction.coefficient_at(x) >
                no_slip)
          return "contact with friction ends at " + to_string(x) +
                 ", where the body can slide but not lift, and no coupling is finite";
      }
  }
  if (const auto x = jump_of_coefficient(zones))
    return "the coefficient of friction jumps at " + to_string(*x) + ", and no coupling is finite";
  return {};
}

/** (mu_f (|U_t| - chi . U_t) - (u_0 - U_n))_+ at tensor products of @p points on a face of the space. */
std::vector<double> BoxBound::against(const unsigned int number,
                                      const std::vector<double> &points) const
{
  const ContactDofFace<3> &face = space.faces[number];
  const BoundaryCondition<3> &condition = space.condition(face.cell, face.face);
  const auto axes = tangents<3>(face.face);
  const unsigned int axis = face.face / 2, n = points.size();
  const double sign = face.face % 2 ? 1. : -1.;
  const CellMap<3> map = map_of<3>(face.cell);
  const FullMatrix<double> values = bernstein_at(points, p);
  std::array<BoxModes, 3> U;
  const auto dofs = face_dofs(face);
  for (unsigned int c = 0; c < 3; ++c)
  {
    U[c] = at(values, c == axis ? trace_of(u, dofs[c]) : slip_trace(dofs[c]));
    const BoxModes of_w = at(values, trace_of(w, dofs[c]));
    for (unsigned int q = 0; q < of_w.size(); ++q)
      U[c][q] -= of_w[q];
  }
  const std::array<BoxModes, 2> chi{
      {at(values, contact[number].lambda[0]), at(values, contact[number].lambda[1])}};
  std::vector<double> result(n * n);
  for (unsigned int q = 0; q < result.size(); ++q)
  {
    const Point<3> x = map.point(on_cell_face(face.face, {{points[q % n], points[q / n], 0.}}));
    const Tensor<1, 2> slip({U[axes[0]][q], U[axes[1]][q]}), own({chi[0][q], chi[1][q]});
    const double room = (condition.gap ? condition.gap->value(x) : 0.) - sign * U[axis][q],
                 value = condition.friction.coefficient_at(x) * (slip.norm() - own * slip) -
                         std::max(0., room);
    result[q] = value > same_gap * u.linfty_norm() ? value : 0.;
  }
  return result;
}

/**
 * Bernstein coefficients of M' by face, and X with X_n = M', all other nodal values zero; nothing: what holds the body is in the way. A
 * coefficient is the largest value that M' has to have near its place; all of them are enlarged until samples are below.
 */
std::optional<std::vector<BoxModes>> BoxBound::bumps(DistributedVector &X) const
{
  const unsigned int per_part = 4, n_points = per_part * p + 1;
  const std::vector<double> points = equidistant(n_points);
  std::vector<std::vector<double>> needed(contact.size());
  for (unsigned int k = 0; k < contact.size(); ++k)
    if (couples(space.faces[k]))
      needed[k] = against(k, points);
  const std::vector<double> heights = heights_of(needed, n_points);
  for (const auto dof : without_lift())
    if (heights[dof] > 0)
      return std::nullopt;
  std::vector<BoxModes> result(contact.size());
  const FullMatrix<double> values = bernstein_at(points, p);
  double factor = 1;
  for (const unsigned int k : coarse_first())
  {
    const ContactDofFace<3> &face = space.faces[k];
    if (!couples(face))
      continue;
    const auto dofs = face_dofs(face)[face.face / 2];
    for (const auto dof : dofs)
      result[k].push_back(heights[dof]);
    set_trace(dofs, face.face % 2 ? 1. : -1., result[k], X);
    const BoxModes bump = at(values, result[k]);
    for (unsigned int q = 0; q < bump.size(); ++q)
      if (needed[k][q] > 0 && !(bump[q] > 0))
        return std::nullopt;
      else if (needed[k][q] > 0)
        factor = std::max(factor, needed[k][q] / bump[q]);
  }
  factor *= reserve;
  set_constrained(X);
  X *= factor;
  for (unsigned int k = 0; k < result.size(); ++k)
  {
    for (double &coefficient : result[k])
      coefficient *= factor;
    if (result[k].empty())
      continue;
    const ContactDofFace<3> &face = space.faces[k];
    const BoxModes of_X = trace_of(X, face_dofs(face)[face.face / 2]);
    for (unsigned int i = 0; i < of_X.size(); ++i)
      if (std::abs(of_X[i] - (face.face % 2 ? 1. : -1.) * result[k][i]) > 1e-9 * u.linfty_norm())
        return std::nullopt;
  }
  return result;
}

/** By unknown, the largest of what M' needs at samples near its node; zero where supports are. */
std::vector<double> BoxBound::heights_of(const std::vector<std::vector<double>> &needed,
                                         const unsigned int n_points) const
{
  const unsigned int n = p + 1, per_part = (n_points - 1) / p;
  std::vector<double> result(space.dof_handler.n_dofs());
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    const auto dofs = face_dofs(space.faces[k])[space.faces[k].face / 2];
    for (unsigned int q = 0; q < needed[k].size(); ++q)
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (std::abs(int(q % n_points) - int(per_part * (i % n))) <= int(per_part) &&
            std::abs(int(q / n_points) - int(per_part * (i / n))) <= int(per_part))
          result[dofs[i]] = std::max(result[dofs[i]], needed[k][q]);
  }
  for (const auto dof : space.owned) // halves of an edge take over what its whole has
    if (const auto *const entries = space.constraints.get_constraint_entries(dof))
      for (const auto &[other, weight] : *entries)
        result[other] = std::max(result[other], result[dof]);
  for (const auto dof : space.owned)
    if (is_supported(dof))
      result[dof] = 0;
  return result;
}

/** |v|_a of nodal values. */
double BoxBound::energy_norm(const DistributedVector &of_vector) const
{
  Vector<double> local(space.tables.only().fe.dofs_per_cell), internal(local);
  double square = 0;
  for (const Cell &cell : cells)
  {
    cell->get_dof_values(of_vector, local);
    if (local.linfty_norm() == 0)
      continue;
    stiffness.multiply(cell, internal, local);
    square += internal * local;
  }
  return std::sqrt(std::max(0., square));
}

/** int pi (u_0 - U_n + M') over friction that couples, int g (|U_t| - chi . U_t) of what it has without pressure, and the gap of other contact. */
double BoxBound::coulomb_gap(const std::vector<BoxModes> &bumps) const
{
  double result = 0;
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    const ContactDofFace<3> &face = space.faces[k];
    if (!couples(face))
    {
      result += face_gaps[k];
      continue;
    }
    const auto axes = tangents<3>(face.face);
    const unsigned int axis = face.face / 2;
    const double sign = face.face % 2 ? 1. : -1.;
    const Tensor<1, 3> size = PrimalSpace<3>::extent(face.cell);
    const CellMap<3> map = map_of<3>(face.cell);
    const Expression<3> &gap = space.condition(face.cell, face.face).gap;
    const FrictionLaw<3> &friction = space.condition(face.cell, face.face).friction;
    BoxModes U_n = trace_of(u, face_dofs(face)[axis]);
    const BoxModes w_n = trace_of(w, face_dofs(face)[axis]);
    for (unsigned int i = 0; i < U_n.size(); ++i)
      U_n[i] = sign * (U_n[i] - w_n[i]);
    std::array<double, 2> by_rule{};
    for (const bool is_finer : {false, true})
    {
      const FullMatrix<double> &values = is_finer ? of.to_finer : of.to_fine;
      const BoxModes normal = at(values, U_n), bump = at(values, bumps[k]),
                     pressure = at(values, contact[k].pressure);
      std::array<BoxModes, 2> slip, chi;
      for (unsigned int t = 0; t < 2; ++t)
      {
        const auto dofs = face_dofs(face)[axes[t]];
        slip[t] = at(values, slip_trace(dofs));
        const BoxModes of_w = at(values, trace_of(w, dofs));
        for (unsigned int q = 0; q < of_w.size(); ++q)
          slip[t][q] -= of_w[q];
        chi[t] = at(values, contact[k].lambda[t]);
      }
      at_points(is_finer ? of.finer : of.fine, 2,
                [&](const unsigned int q, const std::array<double, 3> &x, const double weight)
                {
                  const Point<3> place = map.point(on_cell_face(face.face, x));
                  const double u_0 = gap ? gap->value(place) : 0.,
                               lost = std::hypot(slip[0][q], slip[1][q]) - chi[0][q] * slip[0][q] -
                                      chi[1][q] * slip[1][q];
                  by_rule[is_finer] +=
                      weight * size[axes[0]] * size[axes[1]] *
                      (pressure[q] * (u_0 - normal[q] + bump[q]) + friction.bound_at(place) * lost);
                });
    }
    result += std::max(0., by_rule[1]) + std::abs(by_rule[1] - by_rule[0]);
  }
  return result;
}

/** theta of closed forms, of the faces beside @p zones. */
double BoxBound::closed_forms(const std::vector<bool> &zones) const
{
  double result = 0;
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    const ContactDofFace<3> &face = space.faces[k];
    if (!couples(face) || zones[k])
      continue;
    const double of_material = std::max(half_plane_coupling(space.scene.material_of(face.cell)),
                                        free_wedge_coupling(numbers::PI / 2));
    const CellMap<3> map = map_of<3>(face.cell);
    for (unsigned int i = 0; i < contact[k].lambda[0].size(); ++i)
    {
      const Point<3> x = map.point(
          on_cell_face(face.face, {{double(i % (p + 1)) / p, double(i / (p + 1)) / p, 0.}}));
      result = std::max(
          result, of_material * space.condition(face.cell, face.face).friction.coefficient_at(x) *
                      std::hypot(contact[k].lambda[0][i], contact[k].lambda[1][i]));
    }
  }
  return result;
}

/** (C) with the coupling beside @p zones, which it sets; infinite where that is too strong, or something is in the way, which `why` says. */
double BoxBound::coupled_bound(ErrorBound &result, const std::vector<bool> &zones, const double A,
                               const double b)
{
  result.why = unbounded(zones);
  if (!result.why.empty())
    return infinity;
  result.coupling = std::max(closed_forms(zones), margin * coupling(zones));
  if (result.coupling > largest_coupling)
  {
    result.why = "the coupling of friction, " + text(result.coupling, 3) +
                 ", is too strong for a bound of the error";
    return infinity;
  }
  DistributedVector X = space.ghosted_vector();
  const auto of_slip = bumps(X);
  if (!of_slip)
  {
    result.why = "a support is in the way of what friction against the slip costs";
    return infinity;
  }
  return coulomb_bound(result.coupling, {A, coulomb_gap(*of_slip), b, energy_norm(X)});
}

/**
 * A bound for every solution if the coupling of chi allows it; if not, of those that stick where u_N does, with all that is beside; else
 * Tresca's for the same stress is an estimate.
 */
void BoxBound::set_coulomb(ErrorBound &result, const double A, const double b)
{
  result.kind = BoundKind::estimate;
  for (const ContactDofFace<3> &face : space.faces)
    if (const FrictionLaw<3> &friction = space.condition(face.cell, face.face).friction;
        couples(face) && !friction.is_proportional())
    {
      result.why = friction.name() +
                   " has no bound of the error, whatever the coupling: its limit follows the "
                   "pressure " +
                   (friction.by_pressure ? "by a curve" : "up to a bound alone");
      return;
    }
  std::vector<bool> assumed(space.faces.size());
  for (const BoundKind kind : {BoundKind::coupling, BoundKind::zones})
  {
    ErrorBound tried = result;
    const double total = coupled_bound(tried, assumed, A, b);
    if (std::isfinite(total))
    {
      result = tried;
      result.total = result.radius = total;
      result.theta = 0;
      result.kind = kind;
      result.zones = kind == BoundKind::zones ? in_words(assumed) : "";
      result.why.clear();
      return;
    }
    if (kind == BoundKind::coupling)
      result = tried; // what it says of all solutions stays
    assumed = zones();
    if (std::count(assumed.begin(), assumed.end(), true) == 0)
      return;
  }
}
} // namespace hpvi
