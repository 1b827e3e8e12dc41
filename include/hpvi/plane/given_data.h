// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_given_data_h
#define hpvi_given_data_h

#include <hpvi/plane/coarse_cuts.h>
#include <hpvi/plane/shape_tables.h>

#include <functional>
#include <string>
#include <vector>

namespace hpvi
{
/** What a scene gives as functions of a point that are integrated: by rules of LoadRules alone. */
enum class Datum
{
  load,           ///< a body force in a cell [stress/length], a traction on an edge [stress]
  initial_strain, ///< its stress C eps_0 in a cell [stress]
  spring,         ///< stiffness k_n, k_t on an edge [stress/length]
  friction_bound ///< g on an edge of a foundation [stress]; FrictionRule integrates it, and its sum is compared
};

constexpr unsigned int inside = dealii::numbers::invalid_unsigned_int; ///< in the place of a face

/** Components of a force; xx, yy, xy and that around an axis of a stress; k_n, k_t; g. */
using DatumValue = dealii::Tensor<1, 4>;

/** One datum in a cell or on a face of it. The scene must outlive this. */
struct GivenData
{
  std::string name;                     ///< as in "Traction on top", "Body force"
  std::vector<Expression<2>> functions; ///< those that are given, not null
  std::function<DatumValue(const dealii::Point<2> &)> value; ///< of all of them

  bool varies() const; ///< is any of the functions no constant?
};
GivenData given_data(const Scene<2> &scene, const coarse_cuts::Cell &cell, unsigned int face,
                     Datum datum);

/** Where a datum is cut on an edge or in a cell, and its integral by two rules. */
struct DataPieces
{
  std::vector<double> cuts;                  ///< of an edge: 0, where pieces meet, 1
  std::vector<dealii::BoundingBox<2>> boxes; ///< of a cell; all of it
  DatumValue integral, finer;                ///< by a Gauss rule on each piece, by finer ones
  double deviation = 0;   ///< of integrals and, with a lever of half the edge or cell, moments
  dealii::Point<2> worst; ///< in reference coordinates
};

/**
 * An edge or cell, coarse or refined, as LoadRules looks at it; @p finer: with so many times as many samples.
 */
DataPieces cut_data(const Scene<2> &scene, const coarse_cuts::Cell &cell, unsigned int face,
                    Datum datum, const ShapeTables<2> &tables, unsigned int finer);
} // namespace hpvi

#endif
