// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_shape_h
#define hpvi_shape_h

#include <hpvi/input/parameters.h>
#include <hpvi/scene/geometry.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/** Why no body has these corners: the entry that gives them, what is wrong, and a value that code has set. */
struct ShapeFlaw
{
  std::string entry, problem, value;
};

/** One value of `Geometry/Shape`. */
template <int dim>
struct ShapeKind
{
  Shape shape;
  std::string name;
  std::string documentation; ///< a sentence for the entry, which begins with the name
  std::vector<Entry> entries;
  std::string size_entry; ///< of these the one to change where lengths are wrong
  std::function<Corners<dim>(const Parameters &)> read;
  std::function<std::optional<ShapeFlaw>(const Corners<dim> &)> flaw;
};

/** All that a body in so many dimensions may have: the one list of them. */
template <int dim>
const std::vector<ShapeKind<dim>> &shapes();

/** Null where @p shape is not offered. */
template <int dim>
const ShapeKind<dim> *find_shape(Shape shape);

/** "two" numbers and "x, y", in space "three" and "x, y, z". */
template <int dim>
struct PointWords
{
  const std::string number = dim == 2 ? "two" : "three", axes = dim == 2 ? "x, y" : "x, y, z";
};

/** The section `Geometry`. */
template <int dim>
std::vector<Entry> geometry_entries();

/** What it says, but for the levels of grading, which are a number as others. */
template <int dim>
Geometry<dim> read_geometry(const Parameters &parameters);
} // namespace hpvi

#endif
