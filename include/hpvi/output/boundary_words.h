// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_boundary_words_h
#define hpvi_boundary_words_h

#include <hpvi/scene/scene.h>

#include <deal.II/grid/tria.h>

#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/** A label that says something: units of 1 are none. */
std::string unit_name(const std::string &unit);

/** Of @p function, which may be null: zero then. */
template <int dim>
std::vector<double> values_at(const std::vector<dealii::Point<dim>> &points,
                              const Expression<dim> &function);

bool all_zero(const std::vector<double> &values);

/** A number of so many @p digits with its unit, unless that is 1. */
std::string with_unit(double value, const std::string &unit, int digits = 6);

/**
 * "N" where stresses are in N/mm^2 or MPa and lengths in mm, else as in "bar mm^2", the product of both. Empty where one of
 * them has no name.
 */
std::string force_unit(const std::string &stress, const std::string &length);

/** The least and the largest of @p values, as in "0.3 mm" or, where they differ, "0 to 0.3 mm". */
std::string range_in_words(const std::vector<double> &values, const std::string &unit);

/** What is said of a boundary, phrase by phrase. */
struct BoundaryPhrases
{
  std::vector<std::string> supports, ///< as in "clamped" or "ux = -0.1 mm", "uy free"
      contacts, ///< as in "unilateral contact", "gap 0 to 0.2 mm", "friction coefficient 0.3"
      loads;    ///< as in "traction x: 1.5 to 7.5 MPa", "y: -1 MPa"
};

/** Of @p boundary, whose values are those at some points of its faces on @p mesh; nothing where it has none. */
template <int dim>
std::optional<BoundaryPhrases> phrases_of(const Scene<dim> &scene,
                                          const BoundaryCondition<dim> &boundary,
                                          const dealii::Triangulation<dim> &mesh);

/** As in "support left", "symmetry left", "spring bottom". */
template <int dim>
std::string kind_of_support(const Scene<dim> &scene, const std::string &boundary);

} // namespace hpvi

#endif
