// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_arrays_h
#define hpvi_arrays_h

#include <hpvi/python/result.h>

#include <pybind11/numpy.h>

#include <vector>

namespace hpvi
{
/**
 * The columns of a table by name: counts are whole numbers, names are texts, all else is float with NaN where a field is
 * empty.
 */
pybind11::dict columns(const Rows &rows);

/** One field of such a column. */
pybind11::object field(const std::string &column, const std::string &text);

/** A copy, as an array of this shape. */
pybind11::array_t<double> array(const std::vector<double> &values,
                                const std::vector<pybind11::ssize_t> &shape);
pybind11::array_t<long> array(const std::vector<long> &values,
                              const std::vector<pybind11::ssize_t> &shape);
} // namespace hpvi

#endif
