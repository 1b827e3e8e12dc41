// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/scene/boundary_parts.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr const char *coordinates[] = {"x", "y", "z"};

/** 1 over a unit. */
std::string per(const std::string &unit)
{
  const std::string name = unit_name(unit);
  return name.empty() ? "" : name.find('/') == std::string::npos ? "1/" + name : "1/(" + name + ")";
}

/** As in "N" of N/mm^2 and mm, or of MPa and mm; empty where the product has no name of its own. */
std::string short_name(const std::string &stress, const std::string &length)
{
  for (const std::string &square : {length + "^2", length + "2", length + "²"})
    if (const std::size_t n = square.size() + 1;
        stress.size() > n && stress.substr(stress.size() - n) == "/" + square)
      return stress.substr(0, stress.size() - n);
  struct Name
  {
    const char *stress, *length, *force;
  };
  for (const Name &name : {Name{"Pa", "m", "N"}, Name{"kPa", "m", "kN"}, Name{"MPa", "m", "MN"},
                           Name{"GPa", "m", "GN"}, Name{"MPa", "mm", "N"}, Name{"GPa", "mm", "kN"}})
    if (stress == name.stress && length == name.length)
      return name.force;
  return {};
}

std::string unit_of_load(const std::string &stress, const std::string &length, const bool is_moment)
{
  const std::string s = unit_name(stress), l = unit_name(length), name = short_name(s, l);
  if (s.empty() || l.empty())
    return {};
  return name.empty() ? s + " " + l + (is_moment ? "^3" : "^2") : name + (is_moment ? " " + l : "");
}
} // namespace

/** A label that says something: units of 1 are none. */
std::string unit_name(const std::string &unit)
{
  return unit == "1" ? "" : legible(unit);
}

template <int dim>
std::vector<double> values_at(const std::vector<Point<dim>> &points,
                              const std::function<double(const Point<dim> &)> &function)
{
  std::vector<double> values;
  for (const Point<dim> &x : points)
    values.push_back(function(x));
  return values;
}

template <int dim>
std::vector<double> values_at(const std::vector<Point<dim>> &points,
                              const Expression<dim> &function)
{
  return values_at<dim>(points,
                        [&](const Point<dim> &x) { return function ? function->value(x) : 0.; });
}

bool all_zero(const std::vector<double> &values)
{
  return std::all_of(values.begin(), values.end(), [](const double value) { return value == 0; });
}

std::string with_unit(const double value, const std::string &unit, const int digits)
{
  const std::string name = unit_name(unit);
  return text(value, digits) + (name.empty() ? "" : " " + name);
}

std::string range_in_words(const std::vector<double> &values, const std::string &unit)
{
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  const double round_off = unseen_in_picture * std::max(std::abs(*least), std::abs(*largest));
  const auto clean = [&](const double value) { return std::abs(value) <= round_off ? 0. : value; };
  if (*largest - *least <= round_off)
    return with_unit(clean(*largest), unit);
  const int digits = text(clean(*least), 4) == text(clean(*largest), 4) ? 8 : 4;
  return text(clean(*least), digits) + " to " + with_unit(clean(*largest), unit, digits);
}

std::string force_unit(const std::string &stress, const std::string &length)
{
  return unit_of_load(stress, length, false);
}

namespace
{
/** Points on the faces of @p boundary on @p mesh at which ranges are taken, vertices among them. */
template <int dim>
std::vector<Point<dim>> points_on(const Triangulation<dim> &mesh, const types::boundary_id boundary)
{
  std::vector<typename Triangulation<dim>::active_face_iterator> faces;
  for (const auto &cell : mesh.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face) && cell->face(face)->boundary_id() == boundary)
        faces.push_back(cell->face(face));
  // some 500 along a side as checks have, some 100 along one in space
  const double wanted = dim == 2 ? 500. / std::max<std::size_t>(1, faces.size())
                                 : 100. / std::sqrt(std::max<double>(1., faces.size()));
  const unsigned int n = std::max(2U, static_cast<unsigned int>(wanted));
  std::vector<Point<dim>> points;
  for (const auto &face : faces)
    for (unsigned int i = 0; i <= n; ++i)
      for (unsigned int j = 0; j <= (dim == 3 ? n : 0); ++j)
      {
        const double s = double(i) / n, t = double(j) / n;
        Point<dim> x;
        for (const unsigned int v : face->vertex_indices())
          x += (v % 2 == 0 ? 1 - s : s) * (dim == 2 ? 1 : v / 2 == 0 ? 1 - t : t) * face->vertex(v);
        points.push_back(x);
      }
  return points;
}

/** As in "rigid plate, uy = -0.01 mm, Fx = 5 N, rotation free"; in space "rotation x". */
template <int dim>
void add_plate(const Scene<dim> &scene, const RigidPlate<dim> &plate,
               std::vector<std::string> &phrases)
{
  const auto names = [](const unsigned int m) -> std::array<std::string, 2>
  {
    if (m >= dim && dim == 2)
      return {{"rotation", "moment"}};
    if (m >= dim)
      return {{std::string("rotation ") + coordinates[m - dim],
               std::string("M") + coordinates[m - dim]}};
    return {{std::string("u") + coordinates[m], std::string("F") + coordinates[m]}};
  };
  phrases.push_back("rigid plate");
  for (unsigned int m = 0; m < plate.n_motions; ++m)
    if (plate.displacement[m])
      phrases.push_back(names(m)[0] + " = " +
                        with_unit(*plate.displacement[m], m < dim ? scene.length_unit : "rad"));
    else if (plate.force[m] != 0)
      phrases.push_back(names(m)[1] + " = " +
                        with_unit(scene.thickness * plate.force[m],
                                  unit_of_load(scene.stress_unit, scene.length_unit, m >= dim)));
    else
      phrases.push_back(names(m)[0] + " free");
}

/** Around which the body turns. */
template <int dim>
bool is_axis(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary)
{
  return scene.is_axisymmetric() && lies_on_axis(sides_of(scene)[boundary.id]);
}

template <int dim>
std::vector<std::string> support_phrases(const Scene<dim> &scene,
                                         const BoundaryCondition<dim> &boundary,
                                         const std::vector<Point<dim>> &points)
{
  std::vector<std::string> phrases;
  if (boundary.symmetry)
    phrases.push_back(is_axis(scene, boundary) ? "axis" : "symmetry");
  const std::string stiffness = unit_name(scene.stress_unit) + "/" + unit_name(scene.length_unit);
  for (const auto &[k, name] :
       {std::pair{boundary.spring.normal, "k_n"}, {boundary.spring.tangential, "k_t"}})
    if (k)
      phrases.push_back(
          std::string("spring ") + name + " = " +
          range_in_words(values_at<dim>(points, k),
                         stiffness.front() == '/' || stiffness.back() == '/' ? "" : stiffness));
  if (boundary.plate)
    add_plate(scene, *boundary.plate, phrases);
  if (!boundary.has_displacement())
    return phrases;
  bool is_clamp = true;
  for (unsigned int c = 0; c < dim; ++c)
  {
    const std::string component = std::string("u") + coordinates[c];
    if (!boundary.displacement[c])
    {
      phrases.push_back(component + " free");
      is_clamp = false;
      continue;
    }
    const std::vector<double> values = values_at<dim>(points, boundary.displacement[c]);
    is_clamp = is_clamp && all_zero(values);
    phrases.push_back(component + " = " +
                      (all_zero(values) ? "0" : range_in_words(values, scene.length_unit)));
  }
  return is_clamp && !boundary.spring ? std::vector<std::string>{"clamped"} : phrases;
}

/** As in "friction bound 4.5 MPa"; of a law with both "friction at most 0.3 times the pressure and 2 MPa". */
template <int dim>
std::string friction_in_words(const Scene<dim> &scene, const FrictionLaw<dim> &friction,
                              const std::vector<Point<dim>> &points)
{
  const std::string bound =
      range_in_words(values_at<dim>(points, [&](const auto &x) { return friction.bound_at(x); }),
                     scene.stress_unit);
  const std::string coefficient =
      range_in_words(
          values_at<dim>(points, [&](const auto &x) { return friction.coefficient_at(x); }), "") +
      (friction.by_pressure ? " (less under pressure)" : "");
  if (!friction.coefficient)
    return "friction bound " + bound;
  if (!friction.bound)
    return "friction coefficient " + coefficient;
  return friction.form == FrictionForm::limited
             ? "friction " + coefficient + " times the pressure, at most " + bound
             : "friction " + bound + " and " + coefficient + " times the pressure";
}

/** Of a pair the other side. */
template <int dim>
std::string opposite_name(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary)
{
  const auto &parts = scene.pairs[*boundary.pair].parts;
  const types::boundary_id other = boundary.id == parts[0] ? parts[1] : parts[0];
  return scene.boundaries[scene.boundaries[other].side].name;
}

template <int dim>
std::string gap_in_words(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary,
                         const std::vector<Point<dim>> &points)
{
  const std::vector<double> gaps =
      values_at<dim>(points, [&](const auto &x) { return boundary.gap_at(x); });
  if (all_zero(gaps))
    return "no gap";
  const bool has_interference =
      std::any_of(gaps.begin(), gaps.end(), [](const double gap) { return gap < 0; });
  return "gap " + range_in_words(gaps, scene.length_unit) +
         (has_interference ? " (interference)" : "");
}

template <int dim>
std::vector<std::string> contact_phrases(const Scene<dim> &scene,
                                         const BoundaryCondition<dim> &boundary,
                                         const std::vector<Point<dim>> &points)
{
  std::vector<std::string> phrases;
  if (!boundary.has_contact())
    return phrases;
  if (boundary.is_tied())
    return {"tied to " + opposite_name(scene, boundary)};
  const std::string with = boundary.pair ? " with " + opposite_name(scene, boundary) : "";
  if (boundary.is_unilateral())
    phrases = {"unilateral contact" + with, gap_in_words(scene, boundary, points)};
  else
    phrases = {
        (boundary.contact == Contact::bilateral ? "bilateral contact" : "tangential contact") +
        with};
  if (const auto &d = boundary.contact_direction)
  {
    std::string components;
    for (unsigned int c = 0; c < dim; ++c)
      components += (c > 0 ? " " : "") + text((*d)[c], 4);
    phrases.push_back("contact along (" + components + ")");
  }
  phrases.push_back(boundary.friction ? friction_in_words(scene, boundary.friction, points)
                                      : "no friction");
  if (boundary.wear > 0)
    phrases.push_back("wear coefficient " +
                      with_unit(boundary.wear, per(scene.stress_unit), shown_digits));
  return phrases;
}

template <int dim>
std::vector<std::string> traction_phrases(const Scene<dim> &scene,
                                          const BoundaryCondition<dim> &boundary,
                                          const std::vector<Point<dim>> &points)
{
  std::vector<std::string> phrases;
  for (unsigned int c = 0; c < dim; ++c)
  {
    const std::vector<double> values = values_at<dim>(points, boundary.traction[c]);
    if (!all_zero(values))
      phrases.push_back(std::string(phrases.empty() ? "traction " : "") + coordinates[c] + ": " +
                        range_in_words(values, scene.stress_unit));
  }
  return phrases;
}
} // namespace

template <int dim>
std::optional<BoundaryPhrases> phrases_of(const Scene<dim> &scene,
                                          const BoundaryCondition<dim> &boundary,
                                          const Triangulation<dim> &mesh)
{
  const std::vector<Point<dim>> points = points_on(mesh, boundary.id);
  if (points.empty())
    return std::nullopt;
  return BoundaryPhrases{support_phrases(scene, boundary, points),
                         contact_phrases(scene, boundary, points),
                         traction_phrases(scene, boundary, points)};
}

template <int dim>
std::string kind_of_support(const Scene<dim> &scene, const std::string &boundary)
{
  const auto found =
      std::find_if(scene.boundaries.begin(), scene.boundaries.end(),
                   [&](const BoundaryCondition<dim> &one) { return one.name == boundary; });
  if (std::any_of(found, scene.boundaries.end(),
                  [&](const BoundaryCondition<dim> &one)
                  { return one.pair && one.name == boundary; }))
    return "contact " + boundary;
  const std::string kind = found->plate                                  ? "plate "
                           : is_axis(scene, *found)                      ? "axis "
                           : found->symmetry                             ? "symmetry "
                           : found->spring && !found->has_displacement() ? "spring "
                                                                         : "support ";
  return kind + boundary;
}

template std::vector<double> values_at(const std::vector<Point<2>> &, const Expression<2> &);
template std::vector<double> values_at(const std::vector<Point<3>> &, const Expression<3> &);
template std::optional<BoundaryPhrases> phrases_of(const Scene<2> &, const BoundaryCondition<2> &,
                                                   const Triangulation<2> &);
template std::optional<BoundaryPhrases> phrases_of(const Scene<3> &, const BoundaryCondition<3> &,
                                                   const Triangulation<3> &);
template std::string kind_of_support(const Scene<2> &, const std::string &);
template std::string kind_of_support(const Scene<3> &, const std::string &);
} // namespace hpvi
