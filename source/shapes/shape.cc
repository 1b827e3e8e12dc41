// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/shapes/box.h>
#include <hpvi/shapes/quadrilateral.h>
#include <hpvi/shapes/shape.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

template <int dim>
const std::vector<ShapeKind<dim>> &shapes()
{
  static const std::vector<ShapeKind<dim>> all = []()
  {
    std::vector<ShapeKind<dim>> kinds{box_shape<dim>()};
    if constexpr (dim == 2)
      kinds.push_back(quadrilateral_shape());
    return kinds;
  }();
  return all;
}

template <int dim>
const ShapeKind<dim> *find_shape(const Shape shape)
{
  for (const ShapeKind<dim> &kind : shapes<dim>())
    if (kind.shape == shape)
      return &kind;
  return nullptr;
}

template <int dim>
std::vector<Entry> geometry_entries()
{
  const PointWords<dim> words;
  std::vector<std::string> names;
  std::string pattern, documentation;
  std::vector<Entry> own;
  for (const ShapeKind<dim> &kind : shapes<dim>())
  {
    names.push_back(kind.name);
    pattern += (pattern.empty() ? "" : "|") + kind.name;
    documentation += (documentation.empty() ? "" : " ") + kind.documentation;
    own.insert(own.end(), kind.entries.begin(), kind.entries.end());
  }
  const Patterns::List point(Patterns::Double(), dim, dim, ",");
  std::vector<Entry> entries{
      {"Geometry", "Shape", names.front(), std::make_shared<Patterns::Selection>(pattern),
       listed(names, "or") + (dim == 2 ? "" : ": space has no other shape"), documentation}};
  entries.insert(entries.end(), own.begin(), own.end());
  entries.insert(
      entries.end(),
      {{"Geometry", "Subdivisions", dim == 2 ? "1, 1" : "1, 1, 1",
        std::make_shared<Patterns::List>(Patterns::Integer(1), dim, dim, ","),
        words.number + " positive integers", "Cells of the coarse mesh in each direction."},
       {"Geometry", "Graded towards", "",
        std::make_shared<Patterns::List>(point, 0, Patterns::List::max_int_value, ";"),
        "points \"" + words.axes + "; " + words.axes + "; ...\" or nothing",
        "Points of the body towards which the coarse mesh is bisected."},
       {"Geometry", "Grading levels", "0", std::make_shared<Patterns::Integer>(0, 40),
        "an integer from 0 to 40", "How often the cells that touch such a point are bisected."}});
  return entries;
}

namespace
{
/** What another shape has and this one does not: its own entries stand there empty. */
template <int dim>
void reject_others(const Parameters &parameters, const ShapeKind<dim> &kind)
{
  for (const ShapeKind<dim> &other : shapes<dim>())
    for (const Entry &entry : other.entries)
      if (other.shape != kind.shape && entry.default_value.empty() &&
          !parameters.text(entry.section, entry.name).empty())
        parameters.reject(entry.section, entry.name,
                          "has no meaning for a " + kind.name + "; set Shape = " + other.name +
                              " or remove it");
}
} // namespace

template <int dim>
Geometry<dim> read_geometry(const Parameters &parameters)
{
  const auto kind = std::find_if(shapes<dim>().begin(), shapes<dim>().end(),
                                 [&](const ShapeKind<dim> &one)
                                 { return one.name == parameters.text("Geometry", "Shape"); });
  Geometry<dim> geometry;
  geometry.shape = kind->shape;
  geometry.corners = kind->read(parameters);
  reject_others(parameters, *kind);
  const std::vector<int> subdivisions = Utilities::string_to_int(
      Utilities::split_string_list(parameters.text("Geometry", "Subdivisions"), ','));
  std::copy(subdivisions.begin(), subdivisions.end(), geometry.subdivisions.begin());
  geometry.graded_towards = parameters.points<dim>("Geometry", "Graded towards");
  return geometry;
}

template const std::vector<ShapeKind<2>> &shapes<2>();
template const std::vector<ShapeKind<3>> &shapes<3>();
template const ShapeKind<2> *find_shape(Shape);
template const ShapeKind<3> *find_shape(Shape);
template std::vector<Entry> geometry_entries<2>();
template std::vector<Entry> geometry_entries<3>();
template Geometry<2> read_geometry(const Parameters &);
template Geometry<3> read_geometry(const Parameters &);
} // namespace hpvi
