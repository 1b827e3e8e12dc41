// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/python/result.h>
#include <hpvi/python/result_class.h>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace py = pybind11;

namespace hpvi
{
namespace
{
template <class T>
py::array_t<T> copy(const std::vector<T> &values, const std::vector<py::ssize_t> &shape)
{
  py::array_t<T> result(shape);
  std::copy(values.begin(), values.end(), result.mutable_data());
  return result;
}

py::object field(const Value &value)
{
  if (const std::string *const words = std::get_if<std::string>(&value))
    return py::str(*words);
  if (const std::uint64_t *const count = std::get_if<std::uint64_t>(&value))
    return py::int_(*count);
  return py::float_(number(value).value_or(std::numeric_limits<double>::quiet_NaN()));
}

/** Of a column that all rows have. */
py::object column(const std::vector<Record> &rows, const std::size_t number_of_column)
{
  std::array<bool, std::variant_size_v<Value>> has{};
  py::list fields;
  for (const Record &row : rows)
  {
    const Value &value = row[number_of_column].second;
    has[value.index()] = true;
    fields.append(field(value));
  }
  const char *const type = has[3] ? "str" : has[2] || has[0] ? "float64" : "int64";
  return py::module_::import("numpy").attr("array")(fields, type);
}

/**
 * The columns of a table by name: counts are whole numbers, words are texts, all else is float with NaN where a field is
 * empty.
 */
py::dict columns(const std::vector<Record> &rows)
{
  py::dict result;
  for (std::size_t k = 0; !rows.empty() && k < rows.front().size(); ++k)
    result[py::str(rows.front()[k].first)] = column(rows, k);
  return result;
}

/** A copy, as an array of this shape. */
py::array_t<double> array(const std::vector<double> &values, const std::vector<py::ssize_t> &shape)
{
  return copy(values, shape);
}

py::array_t<long> array(const std::vector<long> &values, const std::vector<py::ssize_t> &shape)
{
  return copy(values, shape);
}

using Size = py::ssize_t;

struct Mesh
{
  py::array_t<double> vertices;
  py::array_t<long> cells, degrees, bodies;
};

Mesh mesh_of(const Result &result)
{
  const MeshArrays mesh = result.mesh();
  const Size dim = result.dimension(), n = mesh.degrees.size();
  return {array(mesh.vertices, {static_cast<Size>(mesh.vertices.size()) / dim, dim}),
          array(mesh.cells, {n, Size(1) << dim}), array(mesh.degrees, {n}),
          array(mesh.bodies, {n})};
}

/** The values of points, or a ValueError that says which bodies there are. */
PointArrays values_at(const Result &result, const std::vector<double> &x, const std::string &body)
{
  try
  {
    return result.at(x, body);
  }
  catch (const std::invalid_argument &error)
  {
    throw py::value_error(error.what());
  }
}

/** One value of each point: those of the points, of which the last axis has the coordinates, and @p tail. */
py::array_t<double>
at_points(const Result &result,
          const py::array_t<double, py::array::c_style | py::array::forcecast> &x,
          const std::string &body, const std::vector<double> PointArrays::*what,
          const std::vector<Size> &tail)
{
  const Size dim = result.dimension();
  if (x.ndim() == 0 || x.shape(x.ndim() - 1) != dim)
    throw py::value_error("points: the last axis has the coordinates, " + std::to_string(dim) +
                          " of them");
  const PointArrays values = values_at(result, {x.data(), x.data() + x.size()}, body);
  std::vector<Size> shape(x.shape(), x.shape() + x.ndim() - 1);
  shape.insert(shape.end(), tail.begin(), tail.end());
  return array(values.*what, shape);
}

py::dict grid_of(const Result &result, const unsigned int n)
{
  const PointArrays values = result.grid(n);
  const Size dim = result.dimension();
  std::vector<Size> shape{-1};
  Size n_points = 1;
  for (Size d = 0; d < dim; ++d, n_points *= n)
    shape.push_back(n);
  shape[0] = values.x.size() / (n_points * dim);
  std::vector<Size> vectors = shape, tensors = shape;
  vectors.push_back(dim);
  tensors.insert(tensors.end(), {3, 3});
  py::dict arrays;
  arrays["x"] = array(values.x, vectors);
  arrays["u"] = array(values.u, vectors);
  arrays["stress"] = array(values.stress, tensors);
  return arrays;
}

py::object by_cell(const std::vector<double> &values)
{
  if (values.empty())
    return py::none();
  return array(values, {static_cast<Size>(values.size())});
}

py::object last_value(const Result &result, const std::string &column)
{
  if (!result.steps.empty())
    for (const auto &[name, value] : result.steps.back())
      if (name == column)
        return field(value);
  throw py::key_error(column + ": is no column of convergence.csv; steps has them all");
}
} // namespace

void add_result(py::module_ &module)
{
  py::class_<Mesh>(module, "Mesh", "The cells of a step.")
      .def_readonly("vertices", &Mesh::vertices, "Coordinates, a row each.")
      .def_readonly("cells", &Mesh::cells,
                    "Vertices of each cell, counterclockwise; in space as VTK counts.")
      .def_readonly("degrees", &Mesh::degrees, "Polynomial degree of each cell.")
      .def_readonly("bodies", &Mesh::bodies, "Number of the body of each cell, 0 the first.");
  const std::vector<Size> tensor{3, 3};
  py::class_<Result, std::shared_ptr<Result>>(module, "Result",
                                              "The steps of a run, and the solution of the last "
                                              "one. result[\"column\"] is its value there.")
      .def("__getitem__", &last_value)
      .def("__len__", [](const Result &result) { return result.steps.size(); })
      .def_property_readonly(
          "steps", [](const Result &result) { return columns(result.steps); },
          "The columns of convergence.csv by name, a value a step.")
      .def_property_readonly(
          "contact", [](const Result &result) { return columns(result.contact()); },
          "The columns of contact-NN.csv of the last step, a value a point.")
      .def_property_readonly(
          "forces", [](const Result &result) { return columns(result.forces()); },
          "The columns of forces.csv of the last step, a value a boundary.")
      .def_property_readonly(
          "loading", [](const Result &result) { return columns(result.loading()); },
          "The columns of loading.csv, a value a load step; empty without a load history.")
      .def_property_readonly(
          "contact_history", [](const Result &result) { return columns(result.contact_history()); },
          "The columns of contact-history.csv, a value a point; empty without a load history.")
      .def_property_readonly(
          "cycles", [](const Result &result) { return columns(result.cycles()); },
          "The columns of cycles.csv, a value a cycle; empty without Loading/Until steady.")
      .def_property_readonly(
          "probe_lines",
          [](const Result &result)
          {
            py::dict lines;
            for (const auto &[name, rows] : result.probe_lines())
              lines[py::str(name)] = columns(rows);
            return lines;
          },
          "Of each probe along a line the columns of probe-NAME-NN.csv.")
      .def_property_readonly("mesh", &mesh_of)
      .def_property_readonly("dimension", &Result::dimension, "2 or 3.")
      .def_readonly("length_unit", &Result::length_unit)
      .def_readonly("stress_unit", &Result::stress_unit)
      .def(
          "plot",
          [](const py::object &result, const py::object &what, const py::object &axes,
             const py::object &scale)
          { return py::module_::import("hpvi.plot").attr("plot")(result, what, axes, scale); },
          py::arg("what") = py::none(), py::arg("axes") = py::none(), py::arg("scale") = py::none(),
          R"(Draw "body", "contact" or "convergence", without a name all of them, and return the figure.

axes: matplotlib's, to draw into; scale: how many times displacements are shown.)")
      .def(
          "vtk",
          [](const py::object &result, const unsigned int n)
          { return py::module_::import("hpvi.results").attr("vtk")(result, n); },
          py::arg("n") = 5,
          "A vtkUnstructuredGrid of python3-vtk9, with n points a direction of each cell.")
      .def(
          "u",
          [](const Result &result, const py::array_t<double> &points, const std::string &body)
          { return at_points(result, points, body, &PointArrays::u, {result.dimension()}); },
          py::arg("points"), py::arg("body") = "",
          "The displacement at points, (..., dim), of several bodies that of the one called body; "
          "NaN outside of it.")
      .def(
          "stress",
          [tensor](const Result &result, const py::array_t<double> &points, const std::string &body)
          { return at_points(result, points, body, &PointArrays::stress, tensor); },
          py::arg("points"), py::arg("body") = "",
          "The stress at points, (..., 3, 3), in the plane with sigma_zz, of several bodies that "
          "of "
          "the one called body; NaN outside of it.")
      .def("grid", &grid_of, py::arg("n") = 5,
           "x, u and stress at n points a direction of each cell, ends included.")
      .def_property_readonly(
          "bound_by_cell", [](const Result &result) { return by_cell(result.bound_by_cell()); },
          "What each cell adds to the guaranteed bound, the roots of squares; None without a "
          "bound.")
      .def_property_readonly("indicator_by_cell", [](const Result &result)
                             { return by_cell(result.indicator_by_cell()); })
      .def_property_readonly("no_bound", &Result::no_bound, "Why there is no bound; else empty.")
      .def_readonly(
          "stopped_by", &Result::stopped_by,
          "What made the last step the last: an entry of Adaptivity, round-off, callback.")
      .def_readonly("warnings", &Result::warnings, "What asks for care, a line each.");
}
} // namespace hpvi
