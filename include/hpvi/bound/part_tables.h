// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_part_tables_h
#define hpvi_part_tables_h

#include <hpvi/plane/shape_tables.h>

#include <deal.II/base/bounding_box.h>

#include <map>
#include <tuple>

namespace hpvi
{
/** Shape functions at Gauss points of parts of cells, each computed once: halves of halves repeat from cell to cell. Threads may ask together. */
class PartTables
{
public:
  /** With n_gauss points per direction in @p box of the unit cell; @p tables have those of whole cells. */
  const ShapeTable<2> &in(const dealii::BoundingBox<2> &box, unsigned int degree,
                          unsigned int n_gauss, const ShapeTables<2> &tables);

  void limit(); ///< forgets all if they have become many; not while one is in use

private:
  /** By degree, points, lower corner, size. */
  std::map<std::tuple<unsigned int, unsigned int, double, double, double>, ShapeTable<2>> known;
};
} // namespace hpvi

#endif
