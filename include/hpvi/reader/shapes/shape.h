// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_shape_h
#define hpvi_shape_h

#include <hpvi/reader/input/parameters.h>
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

/**
 * The value of an entry of the section `Geometry`, before it is checked; of "Curves of all" those that boundaries name, as in
 * "left=1, 2;right=3;".
 */
using GeometryText = std::function<std::string(const std::string &entry)>;

/** Names that say what sections of boundaries there may be. */
struct SideNames
{
  std::vector<std::string> sides;           ///< by boundary id; an empty one has no section
  std::vector<std::string> interfaces = {}; ///< of a mesh file
  bool is_from_file = false;
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
  /** Sets corners or a mesh; subdivisions are there. */
  std::function<void(const Parameters &, Geometry<dim> &)> read;
  std::function<std::optional<ShapeFlaw>(const Corners<dim> &)>
      flaw; ///< of a grid; null: of a mesh
  /** Names of its sides by id; null: those of a grid. */
  std::function<SideNames(const GeometryText &)> boundaries = nullptr;
  bool takes_subdivisions = true;
};

/** All that a body in so many dimensions may have: the one list of them. */
template <int dim>
const std::vector<ShapeKind<dim>> &shapes();

/** Null where @p shape is not offered. */
template <int dim>
const ShapeKind<dim> *find_shape(Shape shape);

/** Of a shape without name "shape". */
template <int dim>
std::string name_of_shape(Shape shape);

/** A body with a mesh of its own, for scenes by code: call Scene::name_boundaries() after that. */
Geometry<2> geometry_of(Shape shape, const CoarseMesh &mesh);

/** Moves vertices that are nearer to x = 0 than 1e-10 of the size onto it: a drawing has its poles at x = -1.8e-15. */
void lay_on_axis(Geometry<2> &geometry);

/** "two" numbers and "x, y", in space "three" and "x, y, z". */
template <int dim>
struct PointWords
{
  const std::string number = dim == 2 ? "two" : "three", axes = dim == 2 ? "x, y" : "x, y, z";
};

/** Pairs of numbers, in space triples. */
template <int dim>
std::shared_ptr<const dealii::Patterns::PatternBase> point_pattern();

inline const std::string too_many_cells =
    "makes more than a million cells; start coarse and let the mesh adapt";

/** Entries that shapes share. */
Entry centre_entry();
Entry radius_entry();
template <int dim>
Entry lower_corner_entry();
template <int dim>
Entry upper_corner_entry();

/** The section `Geometry`. */
template <int dim>
std::vector<Entry> geometry_entries();

/** Those of the body that @p section of @p file describes, of which only what says so is looked at. */
template <int dim>
SideNames names_of_sides(const ParameterFile &file, const std::string &section = "Geometry");

/** What it says, but for the levels of grading, which are a number as others. */
template <int dim>
Geometry<dim> read_geometry(const Parameters &parameters);
} // namespace hpvi

#endif
