// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/python/arrays.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

namespace py = pybind11;

namespace hpvi
{
namespace
{
const std::set<std::string> counts = {"step",        "elements", "dofs",  "dofs_free",
                                      "multipliers", "p_min",    "p_max", "load_step"},
                            names = {"transitions", "coulomb_method", "state",
                                     "boundary",    "contact",        "master",
                                     "name",        "kind",           "stopped_by"};

double number(const std::string &text)
{
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

template <class T>
py::array_t<T> copy(const std::vector<T> &values, const std::vector<py::ssize_t> &shape)
{
  py::array_t<T> result(shape);
  std::copy(values.begin(), values.end(), result.mutable_data());
  return result;
}

/** Of a column that all rows have. */
py::object column(const Rows &rows, const std::size_t number_of_column)
{
  const std::string &name = rows.front()[number_of_column].first;
  bool has_empty = false;
  py::list fields;
  for (const auto &row : rows)
  {
    const std::string &text = row[number_of_column].second;
    has_empty = has_empty || text.empty();
    fields.append(field(name, text));
  }
  const bool is_count = counts.count(name) && !has_empty;
  const char *const type = is_count ? "int64" : names.count(name) ? "str" : "float64";
  return py::module_::import("numpy").attr("array")(fields, type);
}
} // namespace

py::dict columns(const Rows &rows)
{
  py::dict result;
  for (std::size_t k = 0; !rows.empty() && k < rows.front().size(); ++k)
    result[py::str(rows.front()[k].first)] = column(rows, k);
  return result;
}

py::object field(const std::string &column, const std::string &text)
{
  if (names.count(column))
    return py::str(text);
  if (counts.count(column) && !text.empty())
    return py::int_(static_cast<long>(number(text)));
  return py::float_(number(text));
}

py::array_t<double> array(const std::vector<double> &values, const std::vector<py::ssize_t> &shape)
{
  return copy(values, shape);
}

py::array_t<long> array(const std::vector<long> &values, const std::vector<py::ssize_t> &shape)
{
  return copy(values, shape);
}
} // namespace hpvi
