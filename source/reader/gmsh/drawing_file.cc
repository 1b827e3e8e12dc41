// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/child_process.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/memo_table.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/deck/deck_mesh.h>
#include <hpvi/reader/gmsh/drawing_file.h>
#include <hpvi/reader/gmsh/drawing_kind.h>
#include <hpvi/reader/gmsh/given_mesh.h>
#include <hpvi/reader/gmsh/mesh_complaint.h>
#include <hpvi/reader/gmsh/polynomial_edge.h>
#include <hpvi/reader/gmsh/quadratic_edge.h>

#include <link.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <tuple>
#include <unordered_map>

namespace hpvi
{
using namespace dealii;

namespace
{
int take_library(dl_phdr_info *const info, std::size_t, void *const found)
{
  const std::string name = info->dlpi_name;
  if (name.find("libhpvi_cells.so") == std::string::npos)
    return 0;
  *static_cast<std::string *>(found) = name;
  return 1;
}

/** It stands beside the library, one or more directories above that for the processor at hand. */
std::string helper_path()
{
  std::string library;
  dl_iterate_phdr(take_library, &library);
  std::error_code error;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
  for (std::filesystem::path at : {std::filesystem::path(library).parent_path(), own.parent_path()})
    for (unsigned int above = 0; above < 3 && !at.empty(); ++above, at = at.parent_path())
      if (std::filesystem::exists(at / "hpvi_drawing", error))
        return at / "hpvi_drawing";
  return "hpvi_drawing";
}

/** What hpvi_drawing writes: lines of a word and what belongs to it, the last one `end`. */
class DrawingReader
{
public:
  DrawingReader(const std::string &output, const bool is_in_plane)
      : in(output), is_in_plane(is_in_plane)
  {
  }

  GmshFile read()
  {
    for (std::string word; in >> word && word != "end";)
      if (word == "name")
        read_name();
      else if (word == "node")
        read_node();
      else if (word == "element")
        read_element();
      else if (word == "edge")
        read_edge();
      else if (word == "curve")
        read_curve();
      else if (word == "remark")
        read_remark();
    return std::move(file);
  }

private:
  template <typename Number>
  Number next()
  {
    Number value{};
    in >> value;
    return value;
  }

  double real()
  {
    return std::strtod(next<std::string>().c_str(), nullptr); // faster than streams
  }

  unsigned int node()
  {
    const auto found = indices.find(next<std::int64_t>());
    AssertThrow(found != indices.end(), ExcMessage("A node is not there."));
    return found->second;
  }

  void read_name()
  {
    const unsigned int dim = next<unsigned int>();
    const std::int64_t tag = next<std::int64_t>();
    std::string name;
    std::getline(in >> std::ws, name);
    file.names[{dim, tag}] = name;
  }

  void read_node()
  {
    const std::int64_t tag = next<std::int64_t>();
    indices[tag] = file.nodes.size();
    const double x = real(), y = real(), z = real();
    file.nodes.push_back({tag, Point<3>(x, y, z)});
  }

  void read_element()
  {
    GmshFile::Element element;
    element.type = next<std::int64_t>();
    element.entity = next<std::int64_t>();
    element.group = next<std::int64_t>();
    element.number = next<std::size_t>();
    const ElementKind kind = element_kind(element.type);
    std::string rest;
    std::getline(in, rest);
    std::istringstream tags(rest);
    std::int64_t tag = 0;
    for (unsigned int k = 0; k < std::max(kind.n_nodes, kind.n_corners) && tags >> tag; ++k)
      element.nodes[k] = indices.at(tag);
    file.elements.push_back(element);
  }

  void read_remark()
  {
    std::string remark;
    std::getline(in >> std::ws, remark);
    file.remarks.push_back(remark);
  }

  /** Of an element of higher order. */
  void read_edge()
  {
    const unsigned int from = node(), to = node(), order = next<unsigned int>();
    std::vector<Point<2>> points;
    for (unsigned int k = 0; k <= order; ++k)
    {
      const double x = real(), y = real();
      points.emplace_back(x, y);
    }
    if (!is_in_plane)
      return;
    if (order == 2)
      return file.set_curve(
          from, to, {std::make_shared<QuadraticEdge>(points[0], points[1], points[2]), 0, 1});
    file.set_curve(
        from, to,
        {std::make_shared<PolynomialEdge>(equidistant_places(order),
                                          std::vector<PolynomialEdge::Panel>{{0., 1., points}}),
         0, 1});
  }

  /** Panels of Chebyshev's points. */
  void read_curve()
  {
    const unsigned int from = node(), to = node(), degree = next<unsigned int>(),
                       n_panels = next<unsigned int>();
    std::vector<PolynomialEdge::Panel> panels;
    for (unsigned int p = 0; p < n_panels; ++p)
    {
      PolynomialEdge::Panel panel;
      panel.begin = real();
      panel.end = real();
      for (unsigned int k = 0; k <= degree; ++k)
      {
        const double x = real(), y = real();
        panel.points.emplace_back(x, y);
      }
      panels.push_back(panel);
    }
    file.set_curve(from, to,
                   {std::make_shared<PolynomialEdge>(chebyshev_places(degree), panels), 0, 1});
  }

  std::istringstream in;
  const bool is_in_plane;
  GmshFile file;
  std::unordered_map<std::int64_t, unsigned int> indices; ///< of nodes, by tag
};

bool ends(const std::string &text, const std::string &end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/** The complaint of the process itself; empty: it has none. */
std::string own_words(const ChildEnd &end)
{
  const std::string start = "\nerror ";
  const std::size_t at = end.output.rfind(start);
  if (end.signal != 0 || at == std::string::npos)
    return "";
  const std::size_t begin = at + start.size();
  return printable(end.output.substr(begin, end.output.find('\n', begin) - begin), 400);
}

void check_end(const ChildEnd &end, const DrawingLimits &limits, const MeshComplaint &complain)
{
  if (end.is_late || end.signal == SIGXCPU)
    complain("took longer than " + text(limits.seconds, 6) +
             " s to read and to mesh; set a larger Mesh size, or name a mesh (.msh)");
  if (const std::string words = own_words(end); !words.empty())
    complain(words);
  if (end.signal != 0)
    complain("makes the reader of drawings die of signal " + std::to_string(end.signal) + " (" +
             strsignal(end.signal) +
             "); set another Mesh size, or mesh it with gmsh and name that mesh (.msh)");
  if (end.status != 0 || !ends(end.output, "end\n"))
    complain("makes the reader of drawings end with status " + std::to_string(end.status) +
             " before it has read all; open the drawing with gmsh, and save it anew");
}

/** Gmsh chooses its own loader by the ending of the name for what is no CAD. */
void check_ending(const std::string &path, const DrawingKind &kind, const MeshComplaint &complain)
{
  const std::string ending = std::filesystem::path(path).extension().string();
  if (!kind.is_cad() && ending != "." + kind.name)
    complain("is " + kind.words + ", and its name does not end with ." + kind.name +
             "; give it such a name");
}

/** In millimetres; 0: lengths are those of the file. */
double wanted_unit(const DrawingKind &kind, const DrawingRequest &request,
                   const MeshComplaint &complain)
{
  if (request.unit.empty())
    return kind.unit;
  const double unit = millimetres(request.unit);
  if (unit == 0)
    complain("Length unit = " + printable(request.unit) + " is unknown; give " + length_units);
  if (kind.unit == 0)
    complain("is " + kind.words +
             ", which has no unit of its own that Length unit could turn into another; remove "
             "Length unit");
  return unit;
}

/** Whatever is no drawing and no mesh. */
[[noreturn]] void refuse_unknown(const std::string &path, const MeshComplaint &complain)
{
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    complain("is a directory; name a drawing or a mesh");
  if (!std::filesystem::is_regular_file(path, error) || !std::ifstream(path))
    complain("cannot be read; check the name and the permissions of the file");
  if (std::filesystem::file_size(path, error) == 0)
    complain("is empty; write it anew");
  complain("is no drawing (.step, .iges, .brep, .geo) and no mesh (.msh, .unv, .bdf, .vtk, .inp), "
           "as it does not begin like one; name such a file");
}

std::string number(const double x)
{
  std::ostringstream words;
  words.precision(17);
  words << x;
  return words.str();
}

GmshFile from_helper(const std::string &path, const unsigned int dim, const DrawingRequest &request,
                     const DrawingKind &kind, const DrawingLimits &limits)
{
  const MeshComplaint complain(path);
  check_ending(path, kind, complain);
  const double unit = wanted_unit(kind, request, complain);
  // Gmsh 4.8 cannot tell OpenCASCADE the unit of an IGES file before it has read one: it comes in mm.
  const bool is_in_mm = kind.name == "iges";
  const double own = is_in_mm ? 1 : kind.unit;
  const ChildEnd end =
      run_child({helper_path(), kind.name, path, std::to_string(dim), number(request.size),
                 number(request.curvature), number(unit > 0 ? own / unit : 1.),
                 kind.unit > 0 && !is_in_mm ? kind.occ_unit() : "-",
                 number(std::ceil(limits.seconds)), number(limits.megabytes)},
                limits.seconds);
  check_end(end, limits, complain);
  GmshFile file = DrawingReader(end.output, dim == 2).read();
  if (kind.name == "vtk") // its lines are one curve, whatever they were
    file.elements.erase(std::remove_if(file.elements.begin(), file.elements.end(),
                                       [](const GmshFile::Element &element)
                                       { return element_kind(element.type).dim == 1; }),
                        file.elements.end());
  file.is_drawing = !kind.has_cells();
  file.origin = kind.origin(request.unit);
  return file;
}

/** A name is asked for in several places, each of which reads the file: what was read of one that has not changed is kept. */
using Key = std::tuple<std::string, std::filesystem::file_time_type, std::uintmax_t, unsigned int,
                       double, double, std::string>;
} // namespace

std::vector<std::string> names_of_curves(const DrawingRequest &request)
{
  std::vector<std::string> names;
  for (const auto &[curve, name] : request.curves)
    names.push_back(name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

GmshFile read_drawing(const std::string &path, const unsigned int dim,
                      const DrawingRequest &request, const DrawingLimits &limits)
{
  if (const std::optional<GmshFile> given = given_mesh(path))
    return *given;
  const DrawingKind kind = kind_of_drawing(path);
  const MeshComplaint complain(path);
  if (kind.name.empty())
    refuse_unknown(path, complain);
  if (kind.has_cells() && request.size > 0)
    complain("is a mesh, of which Mesh size changes nothing; remove it");
  if (kind.name == "inp")
  {
    wanted_unit(kind, request, complain);
    if (dim == 3)
      complain("is a deck, of which meshes in the plane are read; save a mesh of Gmsh (.msh), as "
               "with gmsh -0 -format msh41");
    return read_deck_mesh(path);
  }
  static std::map<Key, GmshFile> known;
  const Key key(std::filesystem::absolute(path).string(), std::filesystem::last_write_time(path),
                std::filesystem::file_size(path), dim, request.size, request.curvature,
                request.unit);
  return memoised(known, key, [&]() { return from_helper(path, dim, request, kind, limits); });
}
} // namespace hpvi
