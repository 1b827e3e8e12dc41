// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
// ---------------------------------------------------------------- the entries of a scene file

/** One entry of the scene file; the table of all of them is the only place that knows names. */
struct Entry
{
  std::string section; ///< empty: top level
  std::string name;
  std::string default_value;
  std::shared_ptr<const Patterns::PatternBase> pattern;
  std::string wanted; ///< completes "give ..." in an error message
  std::string documentation;

  std::string path() const
  {
    return section.empty() ? name : section + "/" + name;
  }
};

template <typename Pattern>
std::shared_ptr<const Patterns::PatternBase> matching(const Pattern &pattern)
{
  return std::make_shared<Pattern>(pattern);
}

const std::vector<std::string> boundary_names = {"left", "right", "bottom", "top", "front", "back"};

const std::string methods = "hup2|hup3|hup4|hap2|hap3|hap4|pu|hpa1|hpa2";

void add_problem_entries(std::vector<Entry> &entries)
{
  const auto text = matching(Patterns::Anything());
  const auto number = matching(Patterns::Double());
  const auto point = Patterns::List(Patterns::Double(), 2, 2, ",");
  const std::string point_wanted = "two finite numbers \"x, y\"";

  entries.insert(
      entries.end(),
      {{"", "Title", "", text, "one line of text", "One line for humans; empty: the file's name."},
       {"", "Dimension", "2", matching(Patterns::Integer(2, 3)), "2", "Space dimension."},
       {"Units", "Length", "mm", text, "a label", "Label of lengths; nothing is converted."},
       {"Units", "Stress", "kN/mm^2", text, "a label", "Label of stresses; nothing is converted."},
       {"Geometry", "Shape", "box", matching(Patterns::Selection("box|quadrilateral")),
        "box or quadrilateral",
        "box: given by Lower corner and Upper corner. quadrilateral: convex, given by Corners."},
       {"Geometry", "Lower corner", "0, 0", matching(point), point_wanted,
        "Corner of the box with the smallest coordinates, x, y [length]."},
       {"Geometry", "Upper corner", "1, 1", matching(point), point_wanted,
        "Corner of the box with the largest coordinates, x, y [length]."},
       {"Geometry", "Corners", "", matching(Patterns::List(point, 0, 4, ";")),
        "four points \"x, y; x, y; x, y; x, y\", or nothing",
        "Corners of the quadrilateral, counterclockwise from the bottom left: the edges between "
        "them are bottom, right, top, left."},
       {"Geometry", "Subdivisions", "1, 1",
        matching(Patterns::List(Patterns::Integer(1), 2, 2, ",")), "two positive integers",
        "Cells of the coarse mesh in each direction."},
       {"Geometry", "Graded towards", "",
        matching(Patterns::List(point, 0, Patterns::List::max_int_value, ";")),
        "points \"x, y; x, y; ...\" or nothing",
        "Points of the body towards which the coarse mesh is bisected."},
       {"Geometry", "Grading levels", "0", matching(Patterns::Integer(0, 40)),
        "an integer from 0 to 40", "How often the cells that touch such a point are bisected."},
       {"Material", "Young's modulus", "1",
        matching(Patterns::Double(std::numeric_limits<double>::min())), "a number E > 0 (a stress)",
        "E > 0 [stress]; constant E in expressions."},
       {"Material", "Poisson's ratio", "0.3", number, "a number nu with -1 < nu < 1/2",
        "nu in (-1, 1/2); constant nu in expressions, as is mu = E/(2(1+nu))."},
       {"Material", "Plane", "strain", matching(Patterns::Selection("stress|strain")),
        "stress or strain", "Plane stress or plane strain (thesis, Section 2.1.3)."},
       {"Body force", "Expression", "", text, "Fx; Fy or nothing",
        "Force per volume Fx; Fy as expressions of x and y [stress/length]; empty: none."}});
}

void add_boundary_entries(std::vector<Entry> &entries, const std::string &boundary)
{
  const auto text = matching(Patterns::Anything());
  const std::string section = "Boundary " + boundary;
  entries.insert(
      entries.end(),
      {{section, "Displacement", "", text, "ux; uy or nothing",
        "Prescribed displacement ux; uy as expressions of x and y [length]; `free` for a component "
        "that is not prescribed; empty: none is."},
       {section, "Traction", "", text, "Gx; Gy or nothing",
        "Traction Gx; Gy as expressions of x and y [stress]; empty: none."},
       {section, "Contact", "none", matching(Patterns::Selection("none|bilateral")),
        "none or bilateral", "bilateral: the boundary slides along itself, u_n = 0."},
       {section, "Friction bound", "", text, "one expression g >= 0 or nothing",
        "Tresca's bound g(x,y) >= 0 [stress], |T_t| <= g; empty or 0: no friction."}});
}

void add_method_entries(std::vector<Entry> &entries)
{
  const auto fraction = matching(Patterns::Double(std::numeric_limits<double>::min(), 1));
  const auto positive = matching(Patterns::Integer(1));
  const auto degree = matching(Patterns::Integer(1, 20));
  const std::string section = "Adaptivity";
  std::string method_list = methods;
  std::replace(method_list.begin(), method_list.end(), '|', ' ');

  entries.insert(
      entries.end(),
      {{section, "Method", "hpa2", matching(Patterns::Selection(methods)), "one of " + method_list,
        "hup2, hup3, hup4: bisect every cell, p = 2, 3, 4. hap2, hap3, hap4: bisect cells with "
        "large indicator. pu: raise p everywhere. hpa1: bisect the first cells by indicator, raise "
        "p on the next. hpa2: bisect or raise p by the decay of Legendre coefficients."},
       {section, "Smoothness reading", "joint", matching(Patterns::Selection("plain|joint")),
        "plain or joint",
        "How hpa2 reads the decay rate (4.81): plain: one fit per displacement component, the "
        "smaller slope; joint: one fit of the scaled Euclidean norm over the components."},
       {section, "Start degree", "0", matching(Patterns::Integer(0, 20)), "an integer from 0 to 20",
        "Degree of every cell of the coarse mesh; 0: the method's own (hupN, hapN: N; pu, hpa1: 2; "
        "hpa2: 3)."},
       {section, "Maximum degree", "12", degree, "an integer from 1 to 20",
        "Cells of this degree are bisected where p would rise."},
       {section, "hap threshold", "0.5", fraction, "a number in (0, 1]",
        "hap: bisect where eta_K > threshold * mean(eta_K)."},
       {section, "hpa1 bisected fraction", "0.1", fraction, "a number in (0, 1]",
        "hpa1: fraction of cells bisected."},
       {section, "hpa1 raised fraction", "0.1", fraction, "a number in (0, 1]",
        "hpa1: fraction of cells, next in order, whose degree is raised."},
       {section, "hpa2 marked fraction", "0.2", fraction, "a number in (0, 1]",
        "hpa2: fraction of cells refined."},
       {section, "hpa2 decay threshold", "1", matching(Patterns::Double(0)), "a number >= 0",
        "hpa2: raise p where the decay rate b exceeds this, bisect elsewhere."},
       {section, "Maximum steps", "16", positive, "a positive integer",
        "Number of adaptive steps, the first on the coarse mesh."},
       {section, "Maximum unknowns", "1000000", positive, "a positive integer",
        "No step is started after one with more free displacement unknowns."}});
}

void add_program_entries(std::vector<Entry> &entries)
{
  const auto boolean = matching(Patterns::Bool());
  const std::string yes_no = "true or false";
  entries.insert(
      entries.end(),
      {{"Solver", "QP tolerance", "1e-9",
        matching(Patterns::Double(std::numeric_limits<double>::min(), 1)), "a number in (0, 1]",
        "Stop where the projected gradient is below this, relative to the right-hand side."},
       {"Solver", "QP maximum multiplications", "100000", matching(Patterns::Integer(1)),
        "a positive integer", "Products with S before the solver gives up (exit status 2)."},
       {"Solver", "Diagonal scaling", "true", boolean, yes_no, "Scale S by its diagonal."},
       {"Solver", "Condition number", "false", boolean, yes_no,
        "Report the condition number of S, raw and scaled; costs an eigenvalue computation."},
       {"Output", "VTU", "true", boolean, yes_no, "Write solution-NN.vtu and a .pvd."},
       {"Output", "Mesh picture", "true", boolean, yes_no, "Write mesh-NN.svg."},
       {"Output", "Contact tables", "true", boolean, yes_no, "Write contact-NN.csv."}});
}

/** All entries, in the order in which they are printed. */
std::vector<Entry> all_entries(const int dim)
{
  std::vector<Entry> entries;
  add_problem_entries(entries);
  for (int b = 0; b < 2 * dim; ++b)
    add_boundary_entries(entries, boundary_names[b]);
  add_method_entries(entries);
  add_program_entries(entries);
  return entries;
}

// ---------------------------------------------------------------- text

/** @p text fit for one line of a message: no control characters, not endless. */
std::string printable(std::string text)
{
  std::replace_if(
      text.begin(), text.end(),
      [](const char c) { return std::iscntrl(static_cast<unsigned char>(c)); }, '?');
  const std::size_t limit = 120;
  return text.size() <= limit ? text : text.substr(0, limit) + "...";
}

std::string lower_case(std::string text)
{
  for (char &c : text)
    c = std::tolower(static_cast<unsigned char>(c));
  return text;
}

/** Trim, and make every run of white space one blank, as in names of entries. */
std::string single_spaced(const std::string &text)
{
  std::istringstream words(text);
  std::string word, result;
  while (words >> word)
    result += (result.empty() ? "" : " ") + word;
  return result;
}

/** The parts of @p text between semicolons, trimmed; empty parts are kept. */
std::vector<std::string> split_components(const std::string &text)
{
  std::vector<std::string> parts;
  std::istringstream stream(text + ";");
  for (std::string part; std::getline(stream, part, ';');)
    parts.push_back(Utilities::trim(part));
  return parts;
}

/** Number of insertions, deletions and replacements between two words, case ignored. */
unsigned int edit_distance(const std::string &left, const std::string &right)
{
  const std::string a = lower_case(left), b = lower_case(right);
  std::vector<unsigned int> row(b.size() + 1);
  for (unsigned int j = 0; j <= b.size(); ++j)
    row[j] = j;
  for (unsigned int i = 1; i <= a.size(); ++i)
  {
    unsigned int diagonal = row[0];
    row[0] = i;
    for (unsigned int j = 1; j <= b.size(); ++j)
    {
      const unsigned int replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

template <int dim>
std::string to_string(const Point<dim> &x)
{
  std::ostringstream out;
  out << "(";
  for (unsigned int d = 0; d < dim; ++d)
    out << (d > 0 ? ", " : "") << (std::abs(x[d]) < 1e-300 ? 0. : x[d]);
  out << ")";
  return out.str();
}

std::string to_string(const double value)
{
  std::ostringstream out;
  out << value;
  return out.str();
}

/** What a library's exception says, on one line: deal.II's what() fills a page. */
std::string one_line(const std::exception &error)
{
  std::ostringstream text;
  if (const auto *dealii_error = dynamic_cast<const ExceptionBase *>(&error))
    dealii_error->print_info(text);
  else
    text << error.what();
  return single_spaced(text.str());
}

// ---------------------------------------------------------------- reading the file

/** `set name = value` with the section it stands in and the place that messages name. */
struct Assignment
{
  std::string section, name, value;
  std::string where; ///< FILE:LINE, or FILE (--set)
};

[[noreturn]] void fail(const std::string &where, const std::string &what,
                       const std::string &problem_and_remedy)
{
  throw InputError(where + ": " + printable(what) + ": " + problem_and_remedy);
}

/**
 * Splits a file in deal.II's parameter syntax into assignments. ParameterHandler could read the
 * same text, but it neither tells the line of a wrong value nor misses an `end` where it is due.
 */
class FileScanner
{
public:
  explicit FileScanner(const std::string &file) : file(file)
  {
  }

  std::vector<Assignment> scan()
  {
    if (std::filesystem::is_directory(file))
      throw InputError(file + ": is a directory; name a scene file (.prm)");
    std::ifstream stream(file);
    if (!stream)
      throw InputError(file + ": cannot be read; check the name and the permissions of the file");
    for (std::string line; next_line(stream, line);)
      if (!line.empty())
        read_statement(line);
    if (!section.empty())
      fail(section_start, "subsection " + section, "is never closed; add the line \"end\"");
    return std::move(assignments);
  }

private:
  /** Without comment and surrounding blanks; lines that end in a backslash are joined. */
  bool next_line(std::istream &stream, std::string &line)
  {
    line.clear();
    bool continued = true, any = false;
    for (std::string part; continued && std::getline(stream, part); any = true)
    {
      ++line_number;
      if (line_number == 1 && part.compare(0, 3, "\xEF\xBB\xBF") == 0) // byte order mark
        part.erase(0, 3);
      part = Utilities::trim(part.substr(0, part.find('#')));
      continued = !part.empty() && part.back() == '\\';
      if (continued)
        part.pop_back();
      line += part;
    }
    line = Utilities::trim(line);
    return any;
  }

  void read_statement(const std::string &line)
  {
    const std::string where = file + ":" + std::to_string(line_number);
    const std::size_t gap = std::min(line.find_first_of(" \t"), line.size());
    const std::string keyword = lower_case(line.substr(0, gap));
    const std::string rest = Utilities::trim(line.substr(gap));
    if (keyword == "set" && rest.find('=') != std::string::npos)
      assignments.push_back({section, single_spaced(rest.substr(0, rest.find('='))),
                             Utilities::trim(rest.substr(rest.find('=') + 1)), where});
    else if (keyword == "subsection" && !rest.empty())
      open_section(single_spaced(rest), where);
    else if (keyword == "end" && rest.empty())
      close_section(where);
    else if (keyword == "include")
      fail(where, line, "include is not supported; write all entries into one file");
    else
      fail(where, line,
           "is not a statement; write \"set Entry = value\", \"subsection Name\" or \"end\"");
  }

  void open_section(const std::string &name, const std::string &where)
  {
    if (!section.empty())
      fail(where, "subsection " + name,
           "stands inside subsection " + section + " of " + section_start +
               "; close that one with \"end\" first");
    section = name;
    section_start = where;
    assignments.push_back({section, "", "", where}); // lets an empty section be checked by name
  }

  void close_section(const std::string &where)
  {
    if (section.empty())
      fail(where, "end", "no subsection is open here; remove this line");
    section.clear();
  }

  const std::string file;
  unsigned int line_number = 0;
  std::string section, section_start;
  std::vector<Assignment> assignments;
};

/** The values of all entries, and where each was set. */
class Parameters
{
public:
  Parameters(const int dim, const std::string &file) : entries(all_entries(dim)), file(file)
  {
    for (const Entry &entry : entries)
      in_section(entry.section,
                 [&]() {
                   prm.declare_entry(entry.name, entry.default_value, *entry.pattern,
                                     entry.documentation);
                 });
  }

  /** Checks name and form. */
  void assign(const Assignment &assignment)
  {
    const Entry *entry = known_entry(assignment);
    if (entry == nullptr)
      return;
    if (!entry->pattern->match(assignment.value))
      fail(assignment.where, entry->path() + " = " + assignment.value,
           "is not accepted here; give " + entry->wanted);
    origins[entry->path()] = assignment.where;
    set(entry->section, entry->name, assignment.value);
  }

  void assign(const std::pair<std::string, std::string> &override)
  {
    const std::string where = file + " (--set)";
    const std::string value = Utilities::trim(override.second);
    const std::size_t slash = override.first.rfind('/');
    const bool top = slash == std::string::npos;
    // The value must survive a round trip through a parameter file.
    if (value.find_first_of("#\n\r") != std::string::npos ||
        (!value.empty() && value.back() == '\\'))
      fail(where, override.first + " = " + value,
           "holds a character that no parameter file can; remove '#', '\\' and line breaks");
    const std::string name = single_spaced(top ? override.first : override.first.substr(slash + 1));
    if (name.empty())
      fail(where, override.first + " = " + value, "names no entry; write Section/Entry=value");
    assign(
        Assignment{top ? "" : single_spaced(override.first.substr(0, slash)), name, value, where});
  }

  /** Give an entry its final value where the file leaves it to the program. */
  void set(const std::string &section, const std::string &name, const std::string &value)
  {
    in_section(section, [&]() { prm.set(name, value); });
  }

  std::string text(const std::string &section, const std::string &name) const
  {
    return section.empty() ? prm.get(name) : prm.get({section}, name);
  }

  double number(const std::string &section, const std::string &name) const
  {
    return prm.get_double({section}, name);
  }

  unsigned int integer(const std::string &section, const std::string &name) const
  {
    return prm.get_integer({section}, name);
  }

  bool boolean(const std::string &section, const std::string &name) const
  {
    return prm.get_bool({section}, name);
  }

  /** Points "x, y; x, y; ..." */
  template <int dim>
  std::vector<Point<dim>> points(const std::string &section, const std::string &name) const
  {
    std::vector<Point<dim>> result;
    for (const std::string &point : Utilities::split_string_list(text(section, name), ';'))
    {
      const std::vector<double> x =
          Utilities::string_to_double(Utilities::split_string_list(point, ','));
      result.emplace_back();
      std::copy(x.begin(), x.end(), result.back().begin_raw());
    }
    return result;
  }

  /** The one line about an entry whose value is wrong. */
  [[noreturn]] void reject(const std::string &section, const std::string &name,
                           const std::string &problem) const
  {
    const std::string path = section.empty() ? name : section + "/" + name;
    const auto origin = origins.find(path);
    fail(origin == origins.end() ? file : origin->second, path + " = " + text(section, name),
         problem);
  }

  std::string print(const ParameterHandler::OutputStyle style) const
  {
    std::ostringstream out;
    prm.print_parameters(
        out, ParameterHandler::OutputStyle(style | ParameterHandler::KeepDeclarationOrder));
    return out.str();
  }

private:
  template <typename Action>
  void in_section(const std::string &section, const Action &action)
  {
    if (!section.empty())
      prm.enter_subsection(section);
    action();
    if (!section.empty())
      prm.leave_subsection();
  }

  /** Null for the opening line of a known subsection. Throws where the name is unknown. */
  const Entry *known_entry(const Assignment &assignment) const
  {
    const bool section_known =
        std::any_of(entries.begin(), entries.end(),
                    [&](const Entry &e) { return e.section == assignment.section; });
    if (!section_known)
      fail(assignment.where, assignment.section,
           "is an unknown subsection; the nearest known one is \"" +
               nearest_section(assignment.section) + "\"");
    if (assignment.name.empty())
      return nullptr;
    for (const Entry &entry : entries)
      if (entry.section == assignment.section && entry.name == assignment.name)
        return &entry;
    const Entry written{assignment.section, assignment.name, "", nullptr, "", ""};
    fail(assignment.where, written.path() + " = " + assignment.value,
         "is an unknown entry; the nearest known one is \"" + nearest_entry(written) + "\"");
  }

  std::string nearest_section(const std::string &section) const
  {
    const auto cost = [&](const Entry &entry)
    { return entry.section.empty() ? 1000 : edit_distance(entry.section, section); };
    return std::min_element(entries.begin(), entries.end(),
                            [&](const Entry &a, const Entry &b) { return cost(a) < cost(b); })
        ->section;
  }

  /** A name that stands in the wrong section costs no more than one more letter. */
  std::string nearest_entry(const Entry &written) const
  {
    const auto cost = [&](const Entry &entry)
    {
      return 2 * edit_distance(entry.name, written.name) +
             (entry.section == written.section ? 0 : 1);
    };
    return std::min_element(entries.begin(), entries.end(),
                            [&](const Entry &a, const Entry &b) { return cost(a) < cost(b); })
        ->path();
  }

  const std::vector<Entry> entries;
  const std::string file;
  ParameterHandler prm;
  std::map<std::string, std::string> origins;
};

// ---------------------------------------------------------------- geometry

template <int dim>
std::array<Point<dim>, GeometryInfo<dim>::vertices_per_cell> read_box(const Parameters &parameters)
{
  const Point<dim> lower = parameters.points<dim>("Geometry", "Lower corner")[0];
  const Point<dim> upper = parameters.points<dim>("Geometry", "Upper corner")[0];
  std::array<Point<dim>, GeometryInfo<dim>::vertices_per_cell> corners;
  for (unsigned int d = 0; d < dim; ++d)
  {
    if (!(lower[d] < upper[d]) || !std::isfinite(upper[d] - lower[d]))
      parameters.reject("Geometry", "Upper corner",
                        "is not above and right of the lower corner " + to_string(lower) +
                            "; enlarge every coordinate beyond it");
    for (unsigned int v = 0; v < corners.size(); ++v)
      corners[v][d] = ((v >> d) & 1u) ? upper[d] : lower[d];
  }
  if (!parameters.text("Geometry", "Corners").empty())
    parameters.reject("Geometry", "Corners",
                      "has no meaning for a box; set Shape = quadrilateral or remove it");
  return corners;
}

/** Turned into deal.II's order; each corner must turn left by an angle well below pi. */
std::array<Point<2>, 4> read_quadrilateral(const Parameters &parameters)
{
  const std::vector<Point<2>> around = parameters.points<2>("Geometry", "Corners");
  if (around.size() != 4)
    parameters.reject("Geometry", "Corners",
                      "does not give four corners; a quadrilateral needs \"x, y; x, y; x, y; "
                      "x, y\", counterclockwise from the bottom left");
  for (unsigned int c = 0; c < 4; ++c)
  {
    const Tensor<1, 2> in = around[c] - around[(c + 3) % 4], out = around[(c + 1) % 4] - around[c];
    const double sine = (in[0] * out[1] - in[1] * out[0]) / (in.norm() * out.norm());
    if (!(sine > 1e-6))
      parameters.reject("Geometry", "Corners",
                        "is degenerate, clockwise or not convex at " + to_string(around[c]) +
                            "; give the corners of a convex quadrilateral counterclockwise from "
                            "the bottom left");
  }
  return {{around[0], around[1], around[3], around[2]}};
}

/** The straight edges of a plane body, by boundary id. */
struct Edge
{
  std::array<unsigned int, 2> corners; ///< indices into Geometry::corners
  std::array<Point<2>, 2> ends;
  Tensor<1, 2> normal; ///< outer unit normal

  /** Equidistant points from end to end. */
  std::vector<Point<2>> sample() const
  {
    const unsigned int n = 32;
    std::vector<Point<2>> points;
    for (unsigned int i = 0; i < n; ++i)
      points.push_back(ends[0] + (double(i) / n) * (ends[1] - ends[0]));
    points.push_back(ends[1]); // exactly, for conditions at corners
    return points;
  }
};

std::vector<Edge> edges_of(const Geometry<2> &geometry)
{
  Point<2> centre;
  for (const Point<2> &corner : geometry.corners)
    centre += corner / 4.;
  std::vector<Edge> edges(GeometryInfo<2>::faces_per_cell);
  for (unsigned int f = 0; f < edges.size(); ++f)
  {
    Edge &edge = edges[f];
    for (unsigned int v = 0; v < 2; ++v)
    {
      edge.corners[v] = GeometryInfo<2>::face_to_cell_vertices(f, v);
      edge.ends[v] = geometry.corners[edge.corners[v]];
    }
    const Tensor<1, 2> along = edge.ends[1] - edge.ends[0];
    edge.normal[0] = along[1] / along.norm();
    edge.normal[1] = -along[0] / along.norm();
    if (edge.normal * (edge.ends[0] - centre) < 0)
      edge.normal *= -1.;
  }
  return edges;
}

void check_grading(const Parameters &parameters, const Geometry<2> &geometry)
{
  if (geometry.grading_levels > 0 && geometry.graded_towards.empty())
    parameters.reject("Geometry", "Grading levels",
                      "has no point to grade to; set Graded towards = x, y or remove it");
  const double diameter = std::max(geometry.corners[0].distance(geometry.corners[3]),
                                   geometry.corners[1].distance(geometry.corners[2]));
  for (const Point<2> &point : geometry.graded_towards)
    for (const Edge &edge : edges_of(geometry))
      if (!(edge.normal * (point - edge.ends[0]) <= 1e-10 * diameter))
        parameters.reject("Geometry", "Graded towards",
                          "has the point " + to_string(point) +
                              " outside the body; name points of the body");
}

template <int dim>
Geometry<dim> read_geometry(const Parameters &parameters)
{
  Geometry<dim> geometry;
  const bool box = parameters.text("Geometry", "Shape") == "box";
  geometry.shape = box ? Shape::box : Shape::quadrilateral;
  geometry.corners = box ? read_box<dim>(parameters) : read_quadrilateral(parameters);

  const std::vector<int> subdivisions = Utilities::string_to_int(
      Utilities::split_string_list(parameters.text("Geometry", "Subdivisions"), ','));
  double cells = 1;
  for (unsigned int d = 0; d < dim; ++d)
    cells *= geometry.subdivisions[d] = subdivisions[d];
  if (cells > 1e6)
    parameters.reject("Geometry", "Subdivisions",
                      "makes more than a million cells; start coarse and let the mesh adapt");

  geometry.graded_towards = parameters.points<dim>("Geometry", "Graded towards");
  geometry.grading_levels = parameters.integer("Geometry", "Grading levels");
  check_grading(parameters, geometry);
  return geometry;
}

Material read_material(const Parameters &parameters)
{
  Material material;
  material.young = parameters.number("Material", "Young's modulus");
  material.poisson = parameters.number("Material", "Poisson's ratio");
  material.plane =
      parameters.text("Material", "Plane") == "stress" ? PlaneModel::stress : PlaneModel::strain;
  if (!(material.poisson > -1 && material.poisson < 0.5))
    parameters.reject("Material", "Poisson's ratio",
                      "is outside (-1, 1/2); an elastic material has -1 < nu < 1/2");
  return material;
}

// ---------------------------------------------------------------- expressions

/** The parser's own words; the column that deal.II puts before them is an error code. */
std::string parser_message(const std::exception &error)
{
  const std::string text = one_line(error), mark = "The parser said: ";
  const std::size_t start = text.find(mark);
  return start == std::string::npos ? text : text.substr(start + mark.size());
}

/** deal.II's parser prints five lines to stderr before it throws; the message is one line. */
class SilentStderr
{
public:
  SilentStderr() : original(std::cerr.rdbuf(nullptr))
  {
  }

  ~SilentStderr()
  {
    std::cerr.rdbuf(original); // also clears the error state of the muted stream
  }

  SilentStderr(const SilentStderr &) = delete;
  SilentStderr &operator=(const SilentStderr &) = delete;

private:
  std::streambuf *const original;
};

/** Turns the text of an entry into functions and tries each of them where it will be used. */
template <int dim>
class ExpressionReader
{
public:
  using Expression = std::shared_ptr<const Function<dim>>;

  ExpressionReader(const Parameters &parameters, const Material &material)
      : parameters(parameters), constants({{"pi", numbers::PI},
                                           {"E", material.young},
                                           {"nu", material.poisson},
                                           {"mu", material.mu()}})
  {
  }

  /**
   * One function per component; null where the text is @p absent (`free`, or a zero that needs
   * no integration) and everywhere if the entry is empty.
   */
  template <std::size_t n_components>
  std::array<Expression, n_components> read(const std::string &section, const std::string &name,
                                            const std::string &absent,
                                            const std::vector<Point<dim>> &points) const
  {
    std::array<Expression, n_components> result;
    if (parameters.text(section, name).empty())
      return result;
    const std::vector<std::string> parts = split_components(parameters.text(section, name));
    if (parts.size() != n_components)
      parameters.reject(section, name,
                        "has " + std::to_string(parts.size()) + " component(s) instead of " +
                            std::to_string(n_components) + "; separate components by ';'");
    for (unsigned int c = 0; c < n_components; ++c)
      if (!is_absent(parts[c], absent))
        result[c] = make_function(section, name, parts[c], points);
    return result;
  }

private:
  static bool is_number(const std::string &text, double &value)
  {
    char *end = nullptr;
    value = std::strtod(text.c_str(), &end);
    return !text.empty() && *end == '\0' && std::isfinite(value);
  }

  static bool is_absent(const std::string &text, const std::string &absent)
  {
    double value;
    return absent == "0" ? is_number(text, value) && value == 0. : lower_case(text) == absent;
  }

  Expression make_function(const std::string &section, const std::string &name,
                           const std::string &text, const std::vector<Point<dim>> &points) const
  {
    double value;
    if (is_number(text, value))
      return std::make_shared<Functions::ConstantFunction<dim>>(value);
    check_misreadings(section, name, text);
    const auto function = std::make_shared<FunctionParser<dim>>(1);
    try
    {
      const SilentStderr silence;
      function->initialize(FunctionParser<dim>::default_variable_names(), text, constants);
      function->value(points[0]); // only now does the parser look at the text
    }
    catch (const std::exception &error)
    {
      parameters.reject(section, name,
                        "\"" + printable(text) + "\" is not an expression of x and y (" +
                            parser_message(error) + "); mend it, constants are pi, E, nu, mu");
    }
    for (const Point<dim> &point : points)
      if (!std::isfinite(function->value(point)))
        parameters.reject(section, name,
                          "\"" + text + "\" is not finite at " + to_string(point) +
                              "; give an expression that is finite everywhere it applies");
    return function;
  }

  /** What the parser takes without complaint, but not as it is meant. */
  void check_misreadings(const std::string &section, const std::string &name,
                         const std::string &text) const
  {
    if (text.empty())
      parameters.reject(section, name, "has an empty component; write 0 for zero");
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
      depth += (text[i] == '(') - (text[i] == ')');
      if (text[i] == ',' && depth == 0) // "4,5" would be two numbers, of which the last counts
        parameters.reject(section, name,
                          "\"" + text +
                              "\" has a comma outside a function's arguments; write decimals with "
                              "'.' and separate components by ';'");
      const bool comparison = (i > 0 && std::strchr("=<>!", text[i - 1]) != nullptr) ||
                              (i + 1 < text.size() && text[i + 1] == '=');
      if (text[i] == '=' && !comparison) // "x=3" would change x
        parameters.reject(section, name,
                          "\"" + text +
                              "\" assigns a value; write the expression alone, and == "
                              "to compare");
    }
  }

  const Parameters &parameters;
  const std::map<std::string, double> constants;
};

/** Points all over the body, its boundary included. */
std::vector<Point<2>> sample_body(const Geometry<2> &geometry)
{
  const unsigned int n = 16;
  std::vector<Point<2>> points;
  for (unsigned int i = 0; i <= n; ++i)
    for (unsigned int j = 0; j <= n; ++j)
    {
      const Point<2> unit(double(i) / n, double(j) / n);
      Point<2> x;
      for (unsigned int v = 0; v < 4; ++v)
        x += geometry.corners[v] * GeometryInfo<2>::d_linear_shape_function(unit, v);
      points.push_back(x);
    }
  return points;
}

// ---------------------------------------------------------------- boundary conditions

/** What contact excludes on the same boundary. */
template <int dim>
void check_contact(const Parameters &parameters, const std::string &section,
                   const BoundaryCondition<dim> &boundary, const std::vector<Point<dim>> &points)
{
  if (!boundary.bilateral_contact)
  {
    if (!parameters.text(section, "Friction bound").empty())
      parameters.reject(section, "Friction bound",
                        "needs contact; set Contact = bilateral or remove it");
    return;
  }
  if (boundary.has_displacement())
    parameters.reject(section, "Displacement",
                      "stands beside Contact = bilateral; keep only one of the two");
  if (boundary.has_traction())
    parameters.reject(section, "Traction",
                      "stands beside Contact = bilateral; keep only one of the two");
  if (boundary.friction_bound == nullptr)
    return;

  double largest = 0;
  for (const Point<dim> &point : points)
    largest = std::max(largest, std::abs(boundary.friction_bound->value(point)));
  for (const Point<dim> &point : points) // round-off, as in sin(2*pi), is no sign
    if (boundary.friction_bound->value(point) < -1e-12 * largest)
      parameters.reject(section, "Friction bound",
                        "is negative at " + to_string(point) + "; Tresca's bound needs g >= 0");
}

template <int dim>
BoundaryCondition<dim>
read_boundary(const Parameters &parameters, const ExpressionReader<dim> &expressions,
              const types::boundary_id id, const std::vector<Point<dim>> &points)
{
  BoundaryCondition<dim> boundary;
  boundary.id = id;
  boundary.name = boundary_names[id];
  const std::string section = "Boundary " + boundary.name;
  boundary.displacement = expressions.template read<dim>(section, "Displacement", "free", points);
  boundary.traction = expressions.template read<dim>(section, "Traction", "0", points);
  boundary.bilateral_contact = parameters.text(section, "Contact") == "bilateral";
  boundary.friction_bound = expressions.template read<1>(section, "Friction bound", "0", points)[0];
  for (unsigned int d = 0; d < dim; ++d)
    if (boundary.traction[d] != nullptr && boundary.displacement[d] != nullptr)
      parameters.reject(section, "Traction",
                        std::string("acts on the component ") + "xyz"[d] +
                            " that Displacement prescribes; make that component 0 here or free "
                            "there");
  check_contact(parameters, section, boundary, points);
  return boundary;
}

/** `direction . u = value` at one point, said by one boundary. */
struct PointCondition
{
  Tensor<1, 2> direction;
  double value;
  unsigned int boundary;
};

std::vector<PointCondition> conditions_at(const BoundaryCondition<2> &boundary, const Edge &edge,
                                          const Point<2> &point)
{
  std::vector<PointCondition> conditions;
  for (unsigned int d = 0; d < 2; ++d)
    if (boundary.displacement[d] != nullptr)
    {
      Tensor<1, 2> direction;
      direction[d] = 1.;
      conditions.push_back({direction, boundary.displacement[d]->value(point), boundary.id});
    }
  if (boundary.bilateral_contact)
    conditions.push_back({edge.normal, 0., boundary.id});
  return conditions;
}

/** The entry that says what happens to the displacement of a boundary. */
std::string support_entry(const BoundaryCondition<2> &boundary)
{
  return boundary.bilateral_contact ? "Contact" : "Displacement";
}

[[noreturn]] void reject_corner(const Parameters &parameters, const BoundaryCondition<2> &one,
                                const BoundaryCondition<2> &two, const Point<2> &corner,
                                const double contradiction)
{
  // The message stands at the boundary whose value can be changed.
  const BoundaryCondition<2> &changeable = one.bilateral_contact ? two : one;
  const BoundaryCondition<2> &other = one.bilateral_contact ? one : two;
  const std::string section = "Boundary " + other.name;
  parameters.reject("Boundary " + changeable.name, support_entry(changeable),
                    "contradicts " + section + "/" + support_entry(other) + " = " +
                        parameters.text(section, support_entry(other)) + " at their corner " +
                        to_string(corner) + " by " + to_string(std::abs(contradiction)) +
                        "; make both agree there or free one component");
}

/** The largest displacement that any boundary prescribes. */
double largest_displacement(const Scene<2> &scene, const std::vector<Edge> &edges)
{
  double largest = 0;
  for (unsigned int f = 0; f < edges.size(); ++f)
    for (const Point<2> &point : edges[f].sample())
      for (const PointCondition &condition : conditions_at(scene.boundaries[f], edges[f], point))
        largest = std::max(largest, std::abs(condition.value));
  return largest;
}

/** Can all @p conditions at one corner hold together? */
void check_corner(const Parameters &parameters, const Scene<2> &scene, const Point<2> &corner,
                  const std::vector<PointCondition> &conditions, const double scale)
{
  std::vector<PointCondition> basis; // orthonormal directions, by Gram and Schmidt
  for (PointCondition rest : conditions)
  {
    for (const PointCondition &q : basis)
    {
      const double product = rest.direction * q.direction;
      rest.direction -= product * q.direction;
      rest.value -= product * q.value;
    }
    const double norm = rest.direction.norm();
    if (norm > 1e-6)
      basis.push_back({rest.direction / norm, rest.value / norm, rest.boundary});
    else if (std::abs(rest.value) > 1e-10 * scale)
      reject_corner(parameters, scene.boundaries[basis.front().boundary],
                    scene.boundaries[rest.boundary], corner, rest.value);
  }
}

void check_corners(const Parameters &parameters, const Scene<2> &scene)
{
  const std::vector<Edge> edges = edges_of(scene.geometry);
  const double scale = largest_displacement(scene, edges);
  for (unsigned int c = 0; c < scene.geometry.corners.size(); ++c)
  {
    const Point<2> &corner = scene.geometry.corners[c];
    std::vector<PointCondition> conditions;
    for (unsigned int f = 0; f < edges.size(); ++f)
      if (edges[f].corners[0] == c || edges[f].corners[1] == c)
        for (const PointCondition &condition : conditions_at(scene.boundaries[f], edges[f], corner))
          conditions.push_back(condition);
    check_corner(parameters, scene, corner, conditions, scale);
  }
}

/**
 * The rigid-body motion `(a - c (y - y_0)/length, b + c (x - x_0)/length)` in words; of a, b, c
 * those behind @p last vanish, and that one is 1.
 */
std::string describe_motion(const std::array<double, 3> &motion, const unsigned int last,
                            const Point<2> &centre, const double length)
{
  if (last == 0)
    return "translation in x";
  if (last == 1 && std::abs(motion[0]) < 1e-8)
    return "translation in y";
  if (last == 1)
    return "translation along " + to_string(Point<2>(motion[0], motion[1]));
  return "rotation about " + to_string(centre + length * Point<2>(-motion[1], motion[0]));
}

/**
 * A rigid-body motion of which the supports say nothing, in words; empty if there is none. Each of
 * @p rows is a condition on (a, b, c) above.
 */
std::string free_motion(std::vector<std::array<double, 3>> rows, const Point<2> &centre,
                        const double length)
{
  // Gauss and Jordan: the first column without pivot is a motion that earlier columns can balance.
  for (unsigned int column = 0; column < 3; ++column)
  {
    const auto pivot = std::max_element(rows.begin() + column, rows.end(),
                                        [column](const auto &a, const auto &b)
                                        { return std::abs(a[column]) < std::abs(b[column]); });
    if (pivot == rows.end() || std::abs((*pivot)[column]) < 1e-8)
    {
      std::array<double, 3> motion = {{0, 0, 0}};
      motion[column] = 1;
      for (unsigned int c = 0; c < column; ++c)
        motion[c] = -rows[c][column] / rows[c][c];
      return describe_motion(motion, column, centre, length);
    }
    std::swap(*pivot, rows[column]);
    for (unsigned int r = 0; r < rows.size(); ++r)
    {
      const double factor = r == column ? 0. : rows[r][column] / rows[column][column];
      for (unsigned int c = 0; c < 3; ++c)
        rows[r][c] -= factor * rows[column][c];
    }
  }
  return "";
}

/** Without enough supports the stiffness matrix is singular. */
void check_supports(const Scene<2> &scene)
{
  const std::vector<Edge> edges = edges_of(scene.geometry);
  Point<2> centre;
  for (const Point<2> &corner : scene.geometry.corners)
    centre += corner / 4.;
  double length = 0;
  for (const Point<2> &corner : scene.geometry.corners)
    length = std::max(length, corner.distance(centre));

  std::vector<std::array<double, 3>> rows;
  for (unsigned int f = 0; f < edges.size(); ++f)
    for (const Point<2> &end : edges[f].ends) // rigid-body motions are linear along an edge
      for (const PointCondition &condition : conditions_at(scene.boundaries[f], edges[f], end))
      {
        const Tensor<1, 2> &n = condition.direction, arm = (end - centre) / length;
        rows.push_back({{n[0], n[1], n[1] * arm[0] - n[0] * arm[1]}});
      }
  const std::string motion = free_motion(rows, centre, length);
  if (!motion.empty())
    throw InputError(scene.file +
                     ": Boundary left, right, bottom, top/Displacement: the supports " +
                     "leave a rigid-body motion free, " + motion +
                     "; prescribe a displacement component or contact that stops it (friction "
                     "alone does not count)");
}

// ---------------------------------------------------------------- method, solver, output

unsigned int own_start_degree(const Method method)
{
  switch (method)
  {
  case Method::hup2:
  case Method::hap2:
  case Method::pu:
  case Method::hpa1:
    return 2;
  case Method::hup3:
  case Method::hap3:
  case Method::hpa2:
    return 3;
  case Method::hup4:
  case Method::hap4:
    return 4;
  }
  return 2;
}

Method read_method(const Parameters &parameters)
{
  const std::vector<std::string> names = Utilities::split_string_list(methods, '|');
  const auto found = std::find(names.begin(), names.end(), parameters.text("Adaptivity", "Method"));
  return static_cast<Method>(found - names.begin()); // the enumerators stand in the same order
}

/** Resolves `Start degree = 0`, also in @p parameters. */
Adaptivity read_adaptivity(Parameters &parameters, const bool has_contact)
{
  const std::string section = "Adaptivity";
  Adaptivity adaptivity;
  adaptivity.method = read_method(parameters);
  adaptivity.reading = parameters.text(section, "Smoothness reading") == "plain"
                           ? SmoothnessReading::plain
                           : SmoothnessReading::joint;
  adaptivity.start_degree = parameters.integer(section, "Start degree");
  if (adaptivity.start_degree == 0)
    adaptivity.start_degree = own_start_degree(adaptivity.method);
  parameters.set(section, "Start degree", std::to_string(adaptivity.start_degree));
  adaptivity.maximum_degree = parameters.integer(section, "Maximum degree");
  adaptivity.hap_threshold = parameters.number(section, "hap threshold");
  adaptivity.hpa1_bisected = parameters.number(section, "hpa1 bisected fraction");
  adaptivity.hpa1_raised = parameters.number(section, "hpa1 raised fraction");
  adaptivity.hpa2_marked = parameters.number(section, "hpa2 marked fraction");
  adaptivity.hpa2_decay = parameters.number(section, "hpa2 decay threshold");
  adaptivity.maximum_steps = parameters.integer(section, "Maximum steps");
  adaptivity.maximum_unknowns = parameters.integer(section, "Maximum unknowns");

  if (has_contact && adaptivity.start_degree < 2)
    parameters.reject(section, "Start degree",
                      "is too low for contact: the multiplier has degree p - 2; give at least 2");
  if (adaptivity.start_degree > adaptivity.maximum_degree)
    parameters.reject(section, "Start degree",
                      "exceeds Maximum degree = " + std::to_string(adaptivity.maximum_degree) +
                          "; lower the one or raise the other");
  if (adaptivity.hpa1_bisected + adaptivity.hpa1_raised > 1 + 1e-12)
    parameters.reject(section, "hpa1 raised fraction",
                      "makes more than all cells with hpa1 bisected fraction = " +
                          parameters.text(section, "hpa1 bisected fraction") +
                          "; let the two sum to at most 1");
  return adaptivity;
}

SolverSettings read_solver(const Parameters &parameters)
{
  SolverSettings solver;
  solver.qp_tolerance = parameters.number("Solver", "QP tolerance");
  solver.qp_maximum_multiplications = parameters.integer("Solver", "QP maximum multiplications");
  solver.diagonal_scaling = parameters.boolean("Solver", "Diagonal scaling");
  solver.condition_number = parameters.boolean("Solver", "Condition number");
  return solver;
}

OutputSettings read_output(const Parameters &parameters)
{
  OutputSettings output;
  output.vtu = parameters.boolean("Output", "VTU");
  output.mesh_picture = parameters.boolean("Output", "Mesh picture");
  output.contact = parameters.boolean("Output", "Contact tables");
  return output;
}

/** File first, then command line: the later assignment wins. */
void fill(Parameters &parameters, const std::string &file,
          const std::vector<std::pair<std::string, std::string>> &overrides)
{
  for (const Assignment &assignment : FileScanner(file).scan())
    parameters.assign(assignment);
  for (const auto &override : overrides)
    parameters.assign(override);
}
} // namespace

// ---------------------------------------------------------------- the interface

template <int dim>
bool BoundaryCondition<dim>::has_displacement() const
{
  return std::any_of(displacement.begin(), displacement.end(),
                     [](const Expression &e) { return e != nullptr; });
}

template <int dim>
bool BoundaryCondition<dim>::has_traction() const
{
  return std::any_of(traction.begin(), traction.end(),
                     [](const Expression &e) { return e != nullptr; });
}

template <int dim>
bool Scene<dim>::has_body_force() const
{
  return std::any_of(body_force.begin(), body_force.end(),
                     [](const Expression &e) { return e != nullptr; });
}

template <int dim>
bool Scene<dim>::has_contact() const
{
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [](const BoundaryCondition<dim> &b) { return b.bilateral_contact; });
}

template <int dim>
bool Scene<dim>::has_friction() const
{
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [](const BoundaryCondition<dim> &b)
                     { return b.bilateral_contact && b.friction_bound != nullptr; });
}

template <int dim>
Scene<dim> Scene<dim>::read(const std::string &file,
                            const std::vector<std::pair<std::string, std::string>> &overrides)
{
  Parameters parameters(dim, file);
  fill(parameters, file, overrides);
  if (parameters.text("", "Dimension") != std::to_string(dim))
    parameters.reject("", "Dimension", "is not available yet; set Dimension = 2");
  Scene scene;
  scene.file = file;
  scene.name = std::filesystem::path(file).stem().string();
  if (parameters.text("", "Title").empty())
    parameters.set("", "Title", scene.name);
  scene.title = parameters.text("", "Title");
  scene.length_unit = parameters.text("Units", "Length");
  scene.stress_unit = parameters.text("Units", "Stress");

  scene.geometry = read_geometry<dim>(parameters);
  scene.material = read_material(parameters);
  const ExpressionReader<dim> expressions(parameters, scene.material);
  scene.body_force =
      expressions.template read<dim>("Body force", "Expression", "0", sample_body(scene.geometry));
  for (const Edge &edge : edges_of(scene.geometry))
    scene.boundaries.push_back(
        read_boundary<dim>(parameters, expressions, scene.boundaries.size(), edge.sample()));
  check_corners(parameters, scene);
  check_supports(scene);

  scene.adaptivity = read_adaptivity(parameters, scene.has_contact());
  scene.solver = read_solver(parameters);
  scene.output = read_output(parameters);
  scene.effective_parameters = parameters.print(ParameterHandler::ShortPRM);
  return scene;
}

template <int dim>
std::string Scene<dim>::default_parameters()
{
  return Parameters(dim, "").print(ParameterHandler::PRM);
}

template struct BoundaryCondition<2>;
template struct Scene<2>;
} // namespace hpvi
