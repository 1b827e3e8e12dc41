// SPDX-License-Identifier: LGPL-2.1-or-later
// What Python sees: classes and their documentation. Everything behind it knows nothing of Python but arrays.
#include <hpvi/base/input_error.h>
#include <hpvi/base/version.h>
#include <hpvi/python/given_arrays.h>
#include <hpvi/python/result.h>
#include <hpvi/python/result_class.h>
#include <hpvi/python/scene_text.h>
#include <hpvi/reader/gmsh/given_mesh.h>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <exception>
#include <map>

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
    if (!py::isinstance<py::str>(key))
      throw py::type_error("names of entries are texts, and " + py::repr(key).cast<std::string>() +
                           " is none");
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

using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/** Whole numbers of an array; fractions are none. */
Integers integers(const py::handle &values, const std::string &what)
{
  const py::array array = py::array::ensure(values);
  if (!array || (array.size() > 0 && array.dtype().kind() != 'i' && array.dtype().kind() != 'u'))
    throw py::type_error(what + ": give whole numbers");
  return Integers(array);
}

/** Of an array with as many columns, or of a list of rows of several lengths. */
GivenArrays::Rows rows_of(const py::handle &values, const std::string &what)
{
  GivenArrays::Rows rows;
  for (const py::handle &row : py::list(py::reinterpret_borrow<py::object>(values)))
  {
    const Integers one = integers(row, what);
    if (one.ndim() != 1)
      throw py::type_error(what + ": give a row of points for each");
    rows.emplace_back(one.data(), one.data() + one.size());
  }
  return rows;
}

std::shared_ptr<const GivenMesh> make_mesh(const py::object &points, const py::object &cells,
                                           const py::object &boundaries, const py::object &parts)
{
  if (points.is_none() || cells.is_none())
    throw py::value_error("points and cells: a mesh has both; give both, or a File");
  GivenArrays arrays;
  const auto coordinates =
      py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(points);
  if (!coordinates || coordinates.ndim() != 2)
    throw py::type_error("points: give an array with a row for each");
  arrays.dim = coordinates.shape(1);
  arrays.points.assign(coordinates.data(), coordinates.data() + coordinates.size());
  arrays.cells = rows_of(cells, "cells");
  if (!boundaries.is_none())
    for (const auto &[name, rows] : boundaries.cast<py::dict>())
      arrays.boundaries[py::str(name)] = rows_of(rows, "boundaries");
  if (!parts.is_none())
    for (const auto &[name, numbers] : parts.cast<py::dict>())
    {
      const Integers own = integers(numbers, "parts");
      arrays.parts[py::str(name)].assign(own.data(), own.data() + own.size());
    }
  return std::make_shared<const GivenMesh>(mesh_of_arrays(arrays));
}

/** The file, the entries or both, in either place: Scene(entries) reads as well as Scene(file, entries). */
SceneText make_scene(const py::object &file, const py::object &entries, const py::object &points,
                     const py::object &cells, const py::object &boundaries, const py::object &parts)
{
  SceneText scene;
  if (!(points.is_none() && cells.is_none() && boundaries.is_none() && parts.is_none()))
    scene.mesh = make_mesh(points, cells, boundaries, parts);
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

/** Drawn by hpvi.plot. */
py::object picture(const SceneText &scene)
{
  const auto json = py::module_::import("json").attr("loads")(scene.json());
  return py::module_::import("hpvi.plot").attr("scene_svg")(json);
}

/** Notebooks ask for it whenever a scene is shown, which may be in space or not whole yet. */
py::object picture_or_none(const SceneText &scene)
{
  try
  {
    return picture(scene);
  }
  catch (const InputError &)
  {
    return py::none();
  }
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
                            const py::object &output)
{
  const SceneText at_start = scene; // Python may change the other one meanwhile
  const std::string directory = output.is_none() ? "" : path_text(output);
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
asked or solved: InputError.

    Scene(entries, points=X, cells=C, boundaries={"left": edges}, parts={"steel": numbers})

A mesh of arrays, in the place of a file: X has a row of 2 coordinates for each point, or 3 in
space; C the points of each cell, counted from 0: 3 or 4 corners around it, or 6, 8 or 9 with
middles of edges; in space 4, 6 or 8. boundaries are edges by their ends, faces by their corners;
without them those between corners of the boundary have numbers. parts are surfaces, volumes in
space, by numbers of cells. Geometry is of this mesh, or each Body that names no File.)")
      .def(py::init(&make_scene), py::arg("file") = py::none(), py::arg("entries") = py::none(),
           py::kw_only(), py::arg("points") = py::none(), py::arg("cells") = py::none(),
           py::arg("boundaries") = py::none(), py::arg("parts") = py::none())
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
      .def("picture", &picture,
           "The scene as scalable vector graphics; notebooks show it by themselves.")
      .def("json", &SceneText::json, "What hpvi.plot.scene draws, as the text of scene.json.")
      .def("_repr_svg_", &picture_or_none)
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

} // namespace
} // namespace hpvi

PYBIND11_MODULE(_hpvi, module)
{
  module.doc() = "hp finite elements for elastic bodies in contact with friction.";
  module.attr("__version__") = hpvi::version();
  hpvi::add_exceptions(module);
  hpvi::add_scene(module);
  hpvi::add_result(module);
  for (const char *const name : {"Scene", "Result", "Mesh"}) // the package hands them out
    module.attr(name).attr("__module__") = "hpvi";
}
