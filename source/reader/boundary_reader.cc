// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/body_reader.h>
#include <hpvi/reader/boundary_reader.h>
#include <hpvi/reader/input/expressions.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/plate_reader.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/side_normals.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <regex>

namespace hpvi
{
using namespace dealii;

std::vector<Entry> part_entries(const std::string &part, const std::vector<std::string> &sides)
{
  const auto text = std::make_shared<Patterns::Anything>();
  return {{"Boundary " + part, "On", "", text, listed(sides, "or"),
           "The side of which this boundary is a part: it takes its faces out of it and inherits "
           "nothing."},
          {"Boundary " + part, "Where", "", text, "one expression of x and y",
           "Positive on the part, at the centre of each face of the coarse mesh. A box gets a grid "
           "line where the part ends between two."}};
}

Entry wear_entry(const std::string &section)
{
  return {
      section,
      "Wear coefficient",
      "0",
      std::make_shared<Patterns::Double>(0),
      "a number of 0 or more",
      "Archard's coefficient k [1/stress] in a load history: contact-history.csv has the depth "
      "k int p |ds| that is worn off, p the pressure and s the slip. It is reckoned afterwards: "
      "neither gaps nor pressures change with it; 0: none."};
}

std::vector<Entry> boundary_entries(const std::string &boundary)
{
  const auto text = std::make_shared<Patterns::Anything>();
  const std::string section = "Boundary " + boundary;
  return {
      {section, "Displacement", "", text, "ux; uy or nothing",
       "Prescribed displacement ux; uy as expressions of x and y [length]; `free` for a component "
       "that is not prescribed, `exact` for one or all of the exact solution; empty: none is."},
      {section, "Traction", "", text, "Gx; Gy or nothing",
       "Traction Gx; Gy as expressions of x and y [stress], or `exact`; empty: none."},
      {section, "Pressure", "", text, "one expression p or nothing",
       "Pressure p(x,y) [stress]: adds -p n to Traction, n the outer normal; it presses where it "
       "is "
       "positive; empty: none."},
      {section, "Shear", "", text, "one expression s or nothing",
       "Shear s(x,y) [stress]: adds s t to Traction, t = (-n_y, n_x) the tangent; empty: none."},
      {section, "Symmetry", "false", std::make_shared<Patterns::Bool>(), "true or false",
       "true: a plane of symmetry, u_n = 0 without friction; it may stand alone only."},
      {section, "Spring", "", text, "kn; kt or nothing",
       "Elastic foundation that is glued to the body, k_n(x,y); k_t(x,y) >= 0 [stress/length]: "
       "the "
       "traction -k_n u_n n - k_t u_t t, whichever way the body moves. It may stand beside a load "
       "or a prescribed displacement, not beside contact; empty: none."},
      {section, "Rigid", "false", std::make_shared<Patterns::Bool>(), "true or false",
       "true: the boundary is glued to a rigid plate, as of a testing machine. Displacement is "
       "that "
       "of the plate at the mean point of the boundary then, numbers or functions of t; what "
       "neither it nor Force, Rotation or Moment names is free. It stands without contact, "
       "symmetry, springs and tractions."},
      {section, "Force", "", text, "Fx; Fy or nothing",
       "Force on a rigid plate in all, at the mean point of the boundary [stress length^2, per "
       "thickness stress length], numbers or functions of t; `free` for a component that is moved "
       "by Displacement or not loaded; empty: none."},
      {section, "Rotation", "", text, "one number or nothing",
       "Small rotation of a rigid plate about that point, counterclockwise [radians]; empty: "
       "free."},
      {section, "Moment", "", text, "one number or nothing",
       "Moment on a rigid plate about that point, counterclockwise [stress length^3, per "
       "thickness "
       "stress length^2]; empty: none."},
      {section, "Contact", "none", one_of(contact_names),
       "none, bilateral, unilateral or tangential",
       "bilateral: the boundary slides along itself, u_n = 0. unilateral: it may leave the "
       "obstacle, u_n <= u_0, and pull nowhere, T_n <= 0. tangential: nothing in the normal "
       "direction, friction alone acts. Friction bound may stand beside all three."},
      {section, "Gap", "", text, "one expression u_0 or nothing",
       "Distance u_0(x,y) of the obstacle along the outer normal, or Contact direction, before "
       "any displacement [length], negative: interference; of Contact = unilateral; empty or 0: "
       "the body touches it."},
      {section, "Contact direction", "", text, "dx; dy or nothing",
       "Direction dx; dy of contact, numbers, out of the body, of whatever length: u_n, T_n and "
       "Gap are those along it and u_t, T_t those along (-dy, dx), per length of the boundary, as "
       "of an obstacle with another normal than the body's; empty: the outer normal."},
      {section, "Friction bound", "", text, "one expression g >= 0 or nothing",
       "Tresca's bound g(x,y) >= 0 [stress], |T_t| <= g, where unilateral contact is open also; "
       "empty or 0: no friction."},
      {section, "Friction coefficient", "", text, "one expression mu_f >= 0 or nothing",
       "Coulomb's coefficient mu_f(x,y) >= 0, |T_t| <= mu_f p, p = max(0, -T_n), instead of a "
       "bound "
       "or, by Friction law, with one; of unilateral or bilateral contact. It may use the pressure "
       "p, as in 0.5/(1 + p), if friction mu_f p grows with p and is concave. Empty or 0: "
       "no friction."},
      {section, "Friction law", "automatic", one_of(friction_law_names),
       "automatic, limited or cohesive",
       "What Friction bound g and Friction coefficient mu_f make together, with p = max(0, -T_n). "
       "limited: |T_t| <= min(mu_f p, g), Coulomb's friction until the material shears. cohesive: "
       "|T_t| <= g + mu_f p, where unilateral contact is open also. automatic: the law of the one "
       "that is given, Tresca's or Coulomb's."},
      wear_entry(section)};
}

namespace
{
/** What `exact` stands for on @p boundary. */
template <int dim>
std::array<typename ExpressionReader<dim>::ExactField, 2>
exact_displacement_and_traction(const Scene<dim> &scene, const unsigned int boundary)
{
  if (scene.exact_solution != nullptr)
    return {{[&scene](const unsigned int c)
             { return std::make_shared<ExactDisplacement<dim>>(scene.exact_solution, c); },
             [&scene, boundary](const unsigned int c)
             {
               return std::make_shared<ExactTraction<dim>>(scene.exact_solution, scene.materials[0],
                                                           sides_of(scene.geometry)[boundary], c);
             }}};
  const auto none = [](const unsigned int) { return nullptr; };
  return {{none, none}};
}

/** E, nu and mu are those of the cells along @p boundary, where these have one material. */
template <int dim>
ExpressionReader<dim> reader_along(const Parameters &parameters, const Scene<dim> &scene,
                                   const BoundaryCondition<dim> &boundary,
                                   const std::optional<double> t)
{
  const std::vector<unsigned int> materials = materials_along(scene, boundary);
  const bool differ = materials.size() > 1;
  auto constants = constants_of(scene.materials[materials.empty() ? 0 : materials.front()], t);
  for (const char *const name : {"E", "nu", "mu"})
    if (differ)
      constants.erase(name);
  std::string remark;
  for (const unsigned int m : materials)
    if (remark.empty())
      remark = remark_on_constants(scene.materials[m]);
  if (differ && remark.empty())
    remark = "; the materials along this boundary differ in E, nu and mu";
  return ExpressionReader<dim>(parameters, constants, remark);
}

/** A component of a load along a direction that turns with the side. */
template <int dim>
class TurningLoad : public Function<dim>
{
public:
  using Direction = std::function<Tensor<1, dim>(const Point<dim> &)>;

  TurningLoad(const Expression<dim> &load, const Direction &direction, const unsigned int component)
      : load(load), direction(direction), component(component)
  {
  }

  double value(const Point<dim> &x, const unsigned int = 0) const override
  {
    return load->value(x) * direction(x)[component];
  }

private:
  const Expression<dim> load;
  const Direction direction;
  const unsigned int component;
};

/** Traction, pressure and shear as one load. */
template <int dim>
void read_loads(const ExpressionReader<dim> &expressions, const std::string &section,
                const Side<dim> &side, const typename ExpressionReader<dim>::ExactField &exact,
                BoundaryCondition<dim> &boundary)
{
  using Direction = typename TurningLoad<dim>::Direction;
  const std::vector<Point<dim>> points = side.sample();
  boundary.traction = expressions.template read<dim>(section, "Traction", "0", points, exact);
  const bool has_one_normal = common_normal(side).norm() > 0; // also as edges of a mesh
  const auto add = [&](const std::string &entry, const double sign, const Direction &direction)
  {
    const Expression<dim> load = expressions.template read<1>(section, entry, "0", points)[0];
    for (unsigned int c = 0; c < dim; ++c)
      boundary.traction[c] =
          has_one_normal ? sum<dim>(boundary.traction[c], sign * direction(points.front())[c], load)
                         : sum<dim>(boundary.traction[c], sign,
                                    load ? std::make_shared<TurningLoad<dim>>(load, direction, c)
                                         : Expression<dim>());
  };
  if (points.empty()) // parts have taken it all
    return;
  Direction normal = [normal = std::make_shared<const SideNormals<dim>>(side)](const Point<dim> &x)
  { return (*normal)(x); };
  if (has_one_normal)
    normal = [n = common_normal(side)](const Point<dim> &) { return n; };
  add("Pressure", -1, normal);
  if constexpr (dim == 2)
    add("Shear", 1, [normal](const Point<dim> &x) { return -cross_product_2d(normal(x)); });
}

/** Glued on before anything happens: springs know no time. */
template <int dim>
void read_spring(const Parameters &parameters, const ExpressionReader<dim> &expressions,
                 const std::string &section, const std::vector<Point<dim>> &points,
                 BoundaryCondition<dim> &boundary)
{
  static const std::regex t("\\bt\\b");
  if (std::regex_search(parameters.text(section, "Spring"), t))
    parameters.reject(section, "Spring",
                      "uses t, and springs stay; write functions of " +
                          std::string(dim == 2 ? "x and y" : "x, y and z"));
  const auto k = expressions.template read<2>(section, "Spring", "0", points);
  for (const Expression<dim> &component : k)
    for (const Point<dim> &x : points)
      if (component && component->value(x) < 0)
        parameters.reject(section, "Spring",
                          "is negative at " + to_string(x) +
                              "; a spring that helps the body move has no equilibrium");
  boundary.spring = {k[0], k[1]};
}

/** Numbers, which may be written as expressions, to a unit vector. */
template <int dim>
void read_direction(const Parameters &parameters, const ExpressionReader<dim> &expressions,
                    const std::string &section, BoundaryCondition<dim> &boundary)
{
  const std::string entry = "Contact direction", value = parameters.text(section, entry);
  if (value.empty())
    return;
  if (!boundary.has_contact())
    parameters.reject(section, entry, direction_needs_contact);
  static const std::regex variables(dim == 2 ? "\\b[xyt]\\b" : "\\b[xyzt]\\b");
  if (std::regex_search(value, variables))
    parameters.reject(section, entry,
                      std::string("uses ") + (dim == 2 ? "x, y or t" : "x, y, z or t") +
                          ", and a direction is the same everywhere; write numbers, or give each "
                          "part of the side its own");
  const auto d = expressions.template read<dim>(section, entry, "0", {Point<dim>()});
  Tensor<1, dim> direction;
  double largest = 0;
  for (unsigned int c = 0; c < dim; ++c)
  {
    direction[c] = d[c] ? d[c]->value(Point<dim>()) : 0.;
    largest = std::max(largest, std::abs(direction[c]));
  }
  if (largest == 0)
    parameters.reject(section, entry, "has no direction; write a vector out of the body");
  direction /= largest; // squares of the numbers may be none
  boundary.contact_direction = direction / direction.norm();
}

} // namespace

bool says_something(const Parameters &parameters, const std::string &section,
                    const std::string &entry)
{
  if (!parameters.is_named(section, entry))
    return false;
  const std::string value = parameters.text(section, entry);
  return !value.empty() && value != "false" && value != "none";
}

namespace
{
/** u_x = 0, and nothing else can act there. */
void read_axis(const Parameters &parameters, const std::string &section)
{
  for (const char *const entry :
       {"Displacement", "Traction", "Pressure", "Shear", "Symmetry", "Spring", "Rigid", "Contact"})
    if (says_something(parameters, section, entry))
      parameters.reject(section, entry,
                        "is on the axis x = 0 of an axisymmetric body, where u_x = 0 by itself and "
                        "nothing else acts; remove it");
}
} // namespace

double read_wear(const Parameters &parameters, const std::string &section, const bool slides)
{
  const char *const entry = "Wear coefficient";
  const double wear = parameters.number(section, entry);
  if (wear > 0 && !slides)
    parameters.reject(section, entry, "wears off what slides, and nothing does here; remove it");
  if (wear > 0 && parameters.text("Loading", "Steps").empty())
    parameters.reject(section, entry,
                      "is of slip in a load history, and the scene has none; set Loading/Steps or "
                      "remove it");
  return wear;
}

template <int dim>
void read_boundary(const Parameters &parameters, const std::optional<double> t,
                   const Scene<dim> &scene, BoundaryCondition<dim> &boundary)
{
  const ExpressionReader<dim> expressions = reader_along(parameters, scene, boundary, t);
  const Side<dim> side = sides_of(scene)[boundary.id];
  const std::vector<Point<dim>> points = side.sample();
  const auto [exact_displacement, exact_traction] =
      exact_displacement_and_traction(scene, boundary.side);

  const std::string section = "Boundary " + boundary.name;
  if (scene.is_axisymmetric() && lies_on_axis(side))
  {
    read_axis(parameters, section);
    boundary.symmetry = true;
    return;
  }
  boundary.displacement =
      expressions.template read<dim>(section, "Displacement", "free", points, exact_displacement);
  read_loads<dim>(expressions, section, side, exact_traction, boundary);
  boundary.symmetry = parameters.boolean(section, "Symmetry");
  read_spring(parameters, expressions, section, points, boundary);
  read_plate(parameters, expressions, section, points, scene.thickness, scene.is_axisymmetric(),
             boundary);
  boundary.contact = read_choice<Contact>(parameters, section, "Contact", contact_names);
  read_direction(parameters, expressions, section, boundary);
  boundary.gap = expressions.template read<1>(section, "Gap", "0", points)[0];
  boundary.friction = expressions.read_friction(section, points);
  boundary.friction.form =
      read_choice<FrictionForm>(parameters, section, "Friction law", friction_law_names);
  boundary.wear = read_wear(parameters, section, boundary.has_contact());
  // Even a zero is one too many.
  if (!boundary.is_unilateral() && !parameters.text(section, "Gap").empty())
    parameters.reject(section, "Gap", gap_needs_contact);
  if (!boundary.has_contact() && !parameters.text(section, "Friction bound").empty())
    parameters.reject(section, "Friction bound", friction_needs_contact);
  if (!boundary.has_contact() && !parameters.text(section, "Friction coefficient").empty())
    parameters.reject(section, "Friction coefficient", friction_needs_contact);
}

template void read_boundary(const Parameters &, std::optional<double>, const Scene<2> &,
                            BoundaryCondition<2> &);
template void read_boundary(const Parameters &, std::optional<double>, const Scene<3> &,
                            BoundaryCondition<3> &);
} // namespace hpvi
