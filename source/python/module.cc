// SPDX-License-Identifier: LGPL-2.1-or-later
// What Python sees: classes and their documentation. Everything behind it knows nothing of Python but arrays.
#include <hpvi/base/version.h>
#include <hpvi/python/arrays.h>
#include <hpvi/python/result.h>
#include <hpvi/python/scene_text.h>

#include <plot_text.h>
#include <pybind11/stl.h>

#include <exception>
#include <map>
#include <optional>

namespace py = pybind11;

namespace hpvi
{
namespace
{
// ---------------------------------------------------------------- scenes

/** A value as a file has it: tuples are components or coordinates, tuples of these lists of points. */
std::string text_of(const py::handle &value, const std::string &path, const bool is_inner = false)
{
  if (py::isinstance<py::str>(value))
    return value.cast<std::string>();
  if (py::isinstance<py::bool_>(value))
    return value.cast<bool>() ? "true" : "false";
  if (PyIndex_Check(value.ptr()) && !py::isinstance<py::sequence>(value))
    return py::str(py::int_(py::reinterpret_borrow<py::object>(value)));
  if (py::hasattr(value, "__float__") && !py::isinstance<py::sequence>(value))
    return py::repr(py::float_(py::reinterpret_borrow<py::object>(value)));
  if (!py::isinstance<py::sequence>(value) && !py::hasattr(value, "__array__"))
    throw py::type_error(path + " = " + py::repr(value).cast<std::string>() +
                         ": give a text, a number, True or False, or a tuple of these");
  std::vector<std::string> parts;
  bool has_tuples = false;
  for (const py::handle &part : py::list(py::reinterpret_borrow<py::object>(value)))
  {
    has_tuples =
        has_tuples || (!py::isinstance<py::str>(part) && py::isinstance<py::sequence>(part));
    parts.push_back(text_of(part, path, true));
  }
  const auto joined = [&](const std::string &between)
  {
    std::string text;
    for (const std::string &part : parts)
      text += (&part == &parts.front() ? "" : between) + part;
    return text;
  };
  const bool is_list = has_tuples || (!is_inner && has_components(path, joined("; ")));
  return joined(is_list ? "; " : ", ");
}

/** {"Section/Entry": value}, or {"Section": {"Entry": value}}. */
void set_all(SceneText &scene, const py::dict &entries, const std::string &section)
{
  for (const auto &[key, value] : entries)
  {
    const std::string path = section + key.cast<std::string>();
    if (py::isinstance<py::dict>(value))
      set_all(scene, py::reinterpret_borrow<py::dict>(value), path + "/");
    else
      scene.set(path, text_of(value, path));
  }
}

std::string path_text(const py::object &path)
{
  return py::module_::import("os").attr("fspath")(path).cast<std::string>();
}

/** The file, the entries or both, in either place: Scene(entries) reads as well as Scene(file, entries). */
SceneText make_scene(const py::object &file, const py::object &entries)
{
  SceneText scene;
  const bool has_no_file = py::isinstance<py::dict>(file);
  if (!has_no_file && !file.is_none())
    scene.file = path_text(file);
  if (!has_no_file && !file.is_none() && scene.file.empty())
    throw py::value_error("file: the name is empty; leave it out for a scene of entries alone");
  for (const py::object &some : {has_no_file ? file : py::none(), entries})
    if (!some.is_none())
      set_all(scene, some.cast<py::dict>(), "");
  return scene;
}

// ---------------------------------------------------------------- runs

/** Calls back into Python from a run, which has let go of the interpreter. */
struct Caller
{
  const py::object callback;
  std::exception_ptr raised{}; ///< what Python has raised meanwhile

  /** Throws BrokenOff in the place of what Python raises, which the run does not know. */
  template <class Call>
  auto call(const Call &python)
  {
    const py::gil_scoped_acquire gil;
    try
    {
      return python();
    }
    catch (const py::error_already_set &error)
    {
      raised = std::current_exception();
      const auto name = error.type().attr("__name__").cast<std::string>();
      throw BrokenOff("hpvi: interrupted by " + name);
    }
  }
};

std::shared_ptr<Result> run(const SceneText &scene, const py::object &callback,
                            const std::optional<py::object> &output)
{
  const SceneText at_start = scene; // Python may change the other one meanwhile
  const std::string directory = output && !output->is_none() ? path_text(*output) : "";
  Caller caller{callback};
  const auto between = [&]()
  {
    caller.call(
        []()
        {
          if (PyErr_CheckSignals() != 0)
            throw py::error_already_set();
        });
  };
  const auto finished = [&](const std::shared_ptr<Result> &result)
  {
    return caller.call(
        [&]()
        {
          if (PyErr_CheckSignals() != 0)
            throw py::error_already_set();
          return callback.is_none() || !callback(result).is(py::bool_(false));
        });
  };
  try
  {
    const py::gil_scoped_release release;
    return solve(at_start, directory, {between, finished});
  }
  catch (const BrokenOff &)
  {
    std::rethrow_exception(caller.raised);
  }
}

// ---------------------------------------------------------------- results

using Size = py::ssize_t;

struct Mesh
{
  py::array_t<double> vertices;
  py::array_t<long> cells, degrees;
};

Mesh mesh_of(const Result &result)
{
  const MeshArrays mesh = result.mesh();
  const Size dim = result.dimension(), n = mesh.degrees.size();
  return {array(mesh.vertices, {static_cast<Size>(mesh.vertices.size()) / dim, dim}),
          array(mesh.cells, {n, Size(1) << dim}), array(mesh.degrees, {n})};
}

/** One value of each point: those of the points, of which the last axis has the coordinates, and @p tail. */
py::array_t<double>
at_points(const Result &result,
          const py::array_t<double, py::array::c_style | py::array::forcecast> &x,
          const std::vector<double> PointArrays::*what, const std::vector<Size> &tail)
{
  const Size dim = result.dimension();
  if (x.ndim() == 0 || x.shape(x.ndim() - 1) != dim)
    throw py::value_error("points: the last axis has the coordinates, " + std::to_string(dim) +
                          " of them");
  const PointArrays values = result.at({x.data(), x.data() + x.size()});
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
    for (const auto &[name, text] : result.steps.back())
      if (name == column)
        return field(name, text);
  throw py::key_error(column + ": is no column of convergence.csv; steps has them all");
}

/** plot() of plot.py, which the module has within. */
py::object plotter()
{
  py::module_ module = py::module_::import("hpvi");
  if (!py::hasattr(module, "_plot"))
  {
    const auto plot = py::module_::import("types").attr("ModuleType")("hpvi._plot");
    const auto code =
        py::module_::import("builtins").attr("compile")(plot_text, "hpvi/plot.py", "exec");
    py::module_::import("builtins").attr("exec")(code, plot.attr("__dict__"));
    module.attr("_plot") = plot;
  }
  return module.attr("_plot").attr("plot");
}

// ---------------------------------------------------------------- the module

/** Python's classes of the exceptions of the library, by name. */
std::map<std::string, py::object> &exceptions()
{
  static auto *const all = new std::map<std::string, py::object>; // outlives the interpreter
  return *all;
}

void translate(const std::exception_ptr error)
{
  try
  {
    std::rethrow_exception(error);
  }
  catch (const py::error_already_set &)
  {
    throw;
  }
  catch (const py::builtin_exception &)
  {
    throw;
  }
  catch (const NotAtHand &failure)
  {
    PyErr_SetString(PyExc_RuntimeError, failure.what());
  }
  catch (const std::exception &failure)
  {
    PyErr_SetString(exceptions().at(exception_name(failure)).ptr(), line_of(failure).c_str());
  }
}

void add_exceptions(py::module_ &module)
{
  const auto add = [&](const char *const name, PyObject *const base, const char *const doc)
  {
    const py::object type = py::reinterpret_steal<py::object>(
        PyErr_NewExceptionWithDoc((std::string("hpvi.") + name).c_str(), doc, base, nullptr));
    module.attr(name) = type;
    exceptions()[name] = type;
  };
  add("InputError", PyExc_ValueError,
      "Bad input: one line with file, entry, value and remedy, as the program's on stderr.");
  add("NumericalFailure", PyExc_ArithmeticError,
      "The numerics gave up: one line that says where and why.");
  add("OutputFailure", PyExc_OSError, "Results cannot be written.");
  exceptions()["MemoryError"] = py::reinterpret_borrow<py::object>(PyExc_MemoryError);
  exceptions()["RuntimeError"] = py::reinterpret_borrow<py::object>(PyExc_RuntimeError);
  py::register_exception_translator(&translate);
}

void add_scene(py::module_ &module)
{
  py::class_<SceneText>(module, "Scene", R"(A scene, from a file, from entries, or both.

    Scene("prm/han-6-12.prm", {"Boundary bottom/Friction bound": 0.3})
    Scene({"Geometry": {"Upper corner": (2, 1)}, "Boundary left": {"Traction": (0.3, 0)}})

Entries are those of a scene file, and so are their names and defaults. Values are texts, numbers,
True or False, and tuples: components and points, or tuples of these. A scene is checked when it is
asked or solved: InputError.)")
      .def(py::init(&make_scene), py::arg("file") = py::none(), py::arg("entries") = py::none())
      .def(
          "__setitem__",
          [](SceneText &scene, const std::string &path, const py::object &value)
          { set_all(scene, py::dict(py::arg(path.c_str()) = value), ""); },
          "scene[\"Section/Entry\"] = value")
      .def("__getitem__", &SceneText::value,
           "The text of an entry, its default where it is not set.")
      .def(
          "copy", [](const SceneText &scene) { return scene; },
          "Another scene with the same entries.")
      .def_property_readonly("title", &SceneText::title)
      .def("describe", &SceneText::words, "What the scene says, in words: as hpvi --validate.")
      .def("print", &SceneText::print, "All entries with their values, as a scene file.")
      .def("picture", &SceneText::picture,
           "The scene as scalable vector graphics; notebooks show it by themselves.")
      .def("_repr_svg_", &SceneText::picture)
      .def("__repr__",
           [](const SceneText &scene)
           {
             return "hpvi.Scene(" + (scene.file.empty() ? "" : "\"" + scene.file + "\"") +
                    (scene.file.empty() || scene.entries.empty() ? "" : ", ") +
                    (scene.entries.empty()
                         ? ""
                         : std::to_string(scene.entries.size()) + " entries set") +
                    ")";
           })
      .def("solve", &run, py::arg("callback") = py::none(), py::kw_only(),
           py::arg("output") = py::none(), R"(Solve, on one process, and return a Result.

callback(result) is called after each step, with what there is so far; where it returns False the
run ends with this step, and what it raises ends the run. output=DIR writes the files of the
program; without it none is written. Raises InputError, NumericalFailure, OutputFailure.)");
}

void add_result(py::module_ &module)
{
  py::class_<Mesh>(module, "Mesh", "The cells of a step.")
      .def_readonly("vertices", &Mesh::vertices, "Coordinates, a row each.")
      .def_readonly("cells", &Mesh::cells,
                    "Vertices of each cell, counterclockwise; in space as VTK counts.")
      .def_readonly("degrees", &Mesh::degrees, "Polynomial degree of each cell.");
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
             const py::object &scale) { return plotter()(result, what, axes, scale); },
          py::arg("what") = py::none(), py::arg("axes") = py::none(), py::arg("scale") = py::none(),
          R"(Draw "body", "contact" or "convergence", without a name all of them, and return the figure.

axes: matplotlib's, to draw into; scale: how many times displacements are shown.)")
      .def(
          "u",
          [](const Result &result, const py::array_t<double> &points)
          { return at_points(result, points, &PointArrays::u, {result.dimension()}); },
          py::arg("points"), "The displacement at points, (..., dim); NaN outside the body.")
      .def(
          "stress",
          [tensor](const Result &result, const py::array_t<double> &points)
          { return at_points(result, points, &PointArrays::stress, tensor); },
          py::arg("points"),
          "The stress at points, (..., 3, 3), in the plane with sigma_zz; NaN outside the body.")
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
} // namespace
} // namespace hpvi

PYBIND11_MODULE(hpvi, module)
{
  module.doc() = "hp finite elements for elastic bodies in contact with friction.";
  module.attr("__version__") = hpvi::version();
  hpvi::add_exceptions(module);
  hpvi::add_scene(module);
  hpvi::add_result(module);
  Py_AtExit(&hpvi::end_mpi);
}
