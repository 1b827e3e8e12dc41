// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_sheet_h
#define hpvi_scene_sheet_h

#include <hpvi/output/drawing.h>
#include <hpvi/output/outline_part.h>
#include <hpvi/scene/scene.h>

#include <deal.II/base/bounding_box.h>

#include <string>
#include <vector>

namespace hpvi
{
/** Colours of marks, those of the key. */
namespace mark_colours
{
constexpr const char *load = "#1f5fa8", *displacement = "#7b3294", *contact = "#c4161c",
                     *ground = "#333", *probe = "#00796b";
}

/** Attributes of a line. */
std::string stroke(const std::string &colour, double width);

/** A place along a part of a boundary, on the page: the outer normal and the direction across it have length 1. */
struct Station
{
  dealii::Point<2> x;
  PagePoint at;
  PageVector normal, along;
};

/** What all marks of a picture share: where the body is on the page, and how long arrows are. */
class SceneSheet
{
public:
  SceneSheet(const Scene<2> &scene, const dealii::BoundingBox<2> &body);

  static constexpr double longest = 480.; ///< side of the body [pixels]

  PagePoint page(const dealii::Point<2> &x) const;
  PageVector direction(const dealii::Tensor<1, 2> &vector) const; ///< of the same length
  double length(const OutlinePart &part) const;                   ///< [pixels]

  /** At a share in [0,1] of its length. */
  Station station(const OutlinePart &part, double share) const;

  /** Equidistant, @p spacing pixels or so from each other; @p with_ends: at both ends, else half as far from them. */
  std::vector<Station> stations(const OutlinePart &part, double spacing, bool with_ends) const;

  /** So many that nothing narrow is missed. */
  std::vector<Station> sample(const OutlinePart &part) const;

  const Scene<2> &scene;
  const dealii::BoundingBox<2> body;
  const double scale;              ///< pixels per length
  double largest_traction = 0;     ///< of all boundaries [stress]
  double largest_displacement = 0; ///< prescribed on any [length]
  Drawing drawing;
};

/** A part of a boundary, with what the scene says of it. */
struct MarkedPart
{
  const OutlinePart &part;
  const BoundaryCondition<2> &condition;
  bool has_words;                          ///< the longest part of its boundary, where sizes stand
  std::vector<const OutlinePart *> pieces; ///< all parts of its boundary: what words are about
};

/** A vector of functions at a point, where null is 0. */
dealii::Tensor<1, 2> value_of(const std::array<Expression<2>, 2> &components,
                              const dealii::Point<2> &x);
} // namespace hpvi

#endif
