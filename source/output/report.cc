// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/input_error.h>
#include <hpvi/output/field_picture.h>
#include <hpvi/output/html.h>
#include <hpvi/output/report.h>
#include <hpvi/output/report_plots.h>
#include <hpvi/output/report_tables.h>
#include <hpvi/output/report_words.h>
#include <hpvi/output/result_directory.h>
#include <hpvi/output/scene_picture.h>
#include <hpvi/output/scene_words.h>
#include <hpvi/reader/bodies_reader.h>
#include <hpvi/reader/probe_reader.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/reader/scene_reader.h>

#include <algorithm>
#include <functional>
#include <map>
#include <sstream>
#include <utility>

namespace hpvi
{
namespace
{
/** By kind of section and name of entry: a Boundary has the same wherever it is. */
using Defaults = std::map<std::pair<std::string, std::string>, std::string>;

std::string kind_of(const std::string &section)
{
  return section == "Body force" ? section : section.substr(0, section.find(' '));
}

Defaults defaults_of(const int dim)
{
  Defaults defaults;
  std::vector<Entry> entries = scene_entries(dim, {{"NAME"}, {}});
  for (const auto &some : {body_entries("NAME"), pair_entries("NAME"), probe_entries(dim, "NAME")})
    entries.insert(entries.end(), some.begin(), some.end());
  for (const Entry &entry : entries)
    defaults[{kind_of(entry.section), entry.name}] = entry.default_value;
  return defaults;
}

std::string trimmed(const std::string &text)
{
  const std::size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

bool is_default(const Defaults &defaults, const std::string &section, const std::string &line)
{
  const std::size_t set = line.find("set "), equals = line.find('=');
  if (set == std::string::npos || equals == std::string::npos)
    return false;
  const std::string value = trimmed(line.substr(equals + 1));
  const auto found =
      defaults.find({kind_of(section), trimmed(line.substr(set + 4, equals - set - 4))});
  // What a further material leaves open is that of elsewhere.
  return value.empty() || (found != defaults.end() && found->second == value);
}

/**
 * The text of scene.prm as HTML, whole; what stands at its default has the class `default`, by which a printer
 * can leave it out.
 */
std::string scene_listing(const std::string &scene_prm, const int dim)
{
  const Defaults defaults = defaults_of(dim);
  std::string listing, lines, section, line;
  bool says_nothing = true;
  const auto marked = [](const std::string &text, const bool is_at_default)
  { return is_at_default ? "<span class=\"default\">" + text + "</span>" : text; };
  std::istringstream in(scene_prm);
  while (std::getline(in, line))
  {
    const bool opens = line.rfind("subsection ", 0) == 0, closes = line == "end";
    if (opens)
    {
      section = line.substr(11);
      says_nothing = true;
    }
    const bool is_at_default = is_default(defaults, section, line);
    if (!opens && !closes)
      says_nothing = says_nothing && is_at_default;
    lines += marked(xml_text(line) + "\n", is_at_default);
    if (section.empty() || closes)
    {
      listing += says_nothing && closes ? marked(lines, true) : lines;
      lines.clear();
      section.clear();
    }
  }
  return "<pre>" + listing + lines + "</pre>\n";
}

constexpr const char *style = R"(
@page { size: A4; margin: 11mm 12mm; }
body { font: 14px/1.4 "DejaVu Sans", Verdana, Arial, Helvetica, sans-serif; color: #111; background: #fff;
  max-width: 1120px; margin: 1.2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; margin: 0 0 0.1em; }
h2 { font-size: 1.12em; margin: 1.1em 0 0.3em; border-bottom: 1px solid #888; }
p, ul { margin: 0.3em 0; }
ul { padding-left: 1.3em; }
.about, .missing, .times, figcaption { color: #444; font-size: 0.86em; }
.missing { font-style: italic; }
.ending { font-weight: bold; }
.failed { font-weight: bold; border: 3px solid #c4161c; padding: 0.5em 0.7em; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 0.4em 1.6em; align-items: start; }
.words p { margin: 0.15em 0; }
figure { margin: 0.4em 0; break-inside: avoid; }
svg { max-width: 100%; height: auto; }
table { border-collapse: collapse; font-size: 0.82em; font-variant-numeric: tabular-nums; margin: 0.3em 0; }
th, td { padding: 0.08em 0.6em; text-align: right; border-bottom: 1px solid #ddd; }
th:first-child, td:first-child { text-align: left; }
th { font-weight: bold; vertical-align: bottom; border-bottom: 1px solid #555; }
pre { font: 12px/1.3 "DejaVu Sans Mono", Consolas, monospace; white-space: pre-wrap; overflow-wrap: anywhere; }
.listing pre { columns: 3; column-gap: 1.5em; }
.default { color: #666; }
.print-only { display: none; }
@media screen and (max-width: 760px) {
  .pair { grid-template-columns: 1fr; }
  .listing pre { columns: 1; }
  table { display: block; overflow-x: auto; }
}
@media print {
  body { font-size: 7.4pt; line-height: 1.22; margin: 0; padding: 0; max-width: none; }
  h2 { margin: 0.5em 0 0.1em; break-after: avoid; }
  p, ul { margin: 0.1em 0; }
  .words p { margin: 0; }
  .pair { gap: 0 1.2em; }
  figure { margin: 0.1em 0; }
  section > p { break-after: avoid; }
  figure svg { max-height: 64mm; width: auto; }
  .many .charts svg { max-height: 46mm; }
  .many .charts { grid-template-columns: 1fr 1fr 1fr; }
  th, td { padding: 0.1em 0.5em; }
  pre { font-size: 5.3pt; line-height: 1.12; margin: 0.2em 0; }
  .listing pre { columns: 4; }
  .listing .default { display: none; }
  .print-only { display: block; }
  tr { break-inside: avoid; }
}
)";

/** @p make, or why it could not. */
std::string tried(const std::function<std::string()> &make, const std::string &what)
{
  try
  {
    return make();
  }
  catch (const InputError &error)
  {
    return missing(what + ": " + error.what());
  }
}

std::string section(const std::string &title, const std::string &content)
{
  return content.empty() ? ""
                         : "<section>\n" + element("h2", title) + "\n" + content + "</section>\n";
}

std::string pair(const std::string &left, const std::string &right)
{
  return "<div class=\"pair\">\n<div>\n" + left + "</div>\n<div>\n" + right + "</div>\n</div>\n";
}

// ---------------------------------------------------------------- the parts

/** One paragraph for each line. */
std::string paragraphs(const std::string &lines)
{
  std::string text, line;
  std::istringstream in(lines);
  while (std::getline(in, line))
    if (!line.empty())
      text += element("p", line) + "\n";
  return "<div class=\"words\">\n" + text + "</div>\n";
}

std::string picture_of(const Scene<2> &scene)
{
  return figure(scene_picture(scene), "What the scene says.");
}

std::string picture_of(const Scene<3> &)
{
  return missing("Of scenes in space there is no picture.");
}

template <int dim>
std::string scene_part(const Scene<dim> &scene, const Scene<dim> &last)
{
  const std::string history =
      scene.has_load_history()
          ? element("p", "A load history of " + history_in_words(scene.loading) +
                             "; what follows and the picture are at its end, t = 1.") +
                "\n"
          : "";
  return pair(history + tried([&]() { return paragraphs(scene_in_words(last)); },
                              "The scene cannot be said in words"),
              tried([&]() { return picture_of(last); }, "The scene cannot be drawn"));
}

/** The large ones are those that a page has no room for as lines. */
constexpr std::size_t largest_mesh = 250000; // bytes

std::string mesh_part(const RunFiles &files, const unsigned int dim)
{
  const std::string words = "The mesh of the last step with the polynomial degrees of its cells.";
  if (!files.mesh.empty() && files.mesh.size() <= largest_mesh)
    return figure(files.mesh, words);
  if (dim == 2 && !files.field.quads.empty())
    return figure(degree_picture(files.field), words);
  return missing(dim == 3 ? "Of meshes in space there is no picture; ParaView shows degree in "
                            "solution-NN.vtu."
                          : "No picture of the mesh: there is no mesh-NN.svg of the last step; set "
                            "Output/Mesh picture = true to have it.");
}

std::string convergence_part(const RunFiles &files, const unsigned int dim)
{
  return files.steps.empty() ? missing("No step was finished.")
                             : convergence_plot(files) + mesh_part(files, dim);
}

/** Too many for paper in their full size: there they are small, and three beside each other. */
bool are_many(const std::string &charts)
{
  unsigned int n = 0;
  for (std::size_t at = 0; (at = charts.find("<figure>", at)) != std::string::npos; ++at)
    ++n;
  return n > 4;
}

/** Begins with a capital. */
template <int dim>
std::string charts_title(const Scene<dim> &scene)
{
  return scene.has_contact()
             ? std::string("Contact, ") + (scene.has_load_history() ? "load history, " : "") +
                   "convergence and mesh"
             : "Convergence and mesh";
}

template <int dim>
std::string field_part(const Scene<dim> &scene, const RunFiles &files)
{
  if (files.field.quads.empty())
    return missing("No picture of stress and displacement: " + files.no_field + ".");
  const FieldPicture picture = stress_picture(scene, files.field, files.contact);
  return figure(picture.svg, picture.caption + ".");
}

template <int dim>
std::string source_part(const Scene<dim> &scene, const JsonTree &summary)
{
  const std::string file = effective_parameters(scene), processes = words_of(summary, "processes");
  if (file.empty())
    return element("p", "The scene was built by a program: there is no file of it.") + "\n";
  const std::string first = words_of(summary, "scene_file");
  return element("p", "The scene with all its entries, as scene.prm holds it beside this page" +
                          (first.empty() ? "" : "; it was read from " + first) +
                          ". This repeats the run there:") +
         "\n" +
         element("pre", (processes == "1" ? "" : "mpirun -np " + processes + " ") +
                            "hpvi --output again scene.prm") +
         "\n" +
         element("p", "Entries at their defaults are not printed; the page on a screen has them.",
                 "print-only missing") +
         "\n<div class=\"listing\">\n" + scene_listing(file, dim) + "</div>\n";
}

std::string about(const JsonTree &summary)
{
  const std::string processes = words_of(summary, "processes");
  return element("p",
                 "Scene " + words_of(summary, "scene") + ", computed by " +
                     words_of(summary, "program") + " (" + words_of(summary, "build") +
                     " build), deal.II " + words_of(summary, "deal.II") +
                     (processes == "1" ? "" : ", " + processes + " processes"),
                 "about") +
         "\n";
}
} // namespace

template <int dim>
std::string report(const Scene<dim> &scene, const std::string &directory,
                   const std::string &summary)
{
  const RunFiles files = read_run(directory, summary, dim);
  const std::string title = scene.title.empty() ? scene.name : scene.title,
                    charts = contact_plots(scene, files) + loading_plots(scene, files) +
                             convergence_part(files, dim);
  return "<!-- " + results::report_head +
         " -->\n<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
         element("title", title) + "\n<style>" + style + "</style>\n</head>\n<body" +
         (are_many(charts) ? " class=\"many\"" : "") + ">\n" + element("h1", title) + "\n" +
         about(files.summary) + ending_words(files.summary, scene.adaptivity) +
         section("The answer", pair(answer_words(scene, files), field_part(scene, files))) +
         section("The scene", tried([&]() { return scene_part(scene, at_the_end(scene)); },
                                    "The scene cannot be said in words")) +
         section(charts_title(scene), "<div class=\"pair charts\">\n" + charts + "</div>\n") +
         section("Forces", forces_words(scene, files)) + section("Steps", steps_table(files)) +
         section("Warnings", warnings_list(files.summary)) +
         section("Times", times_line(files.summary)) +
         section("To repeat it", source_part(scene, files.summary)) + "</body>\n</html>\n";
}

template std::string report(const Scene<2> &, const std::string &, const std::string &);
template std::string report(const Scene<3> &, const std::string &, const std::string &);
} // namespace hpvi
