// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/program/command_line.h>
#include <hpvi/scene/scene.h>

#include <boost/program_options.hpp>

#include <filesystem>
#include <sstream>

namespace hpvi
{
namespace
{
namespace po = boost::program_options;

po::options_description visible_options()
{
  po::options_description options("Options", 90);
  auto add = options.add_options();
  add("output", po::value<std::string>()->value_name("DIR"),
      "directory of the results (default: output/<scene>)");
  add("set", po::value<std::vector<std::string>>()->composing()->value_name("ENTRY=VALUE"),
      "override one entry of the scene, as in --set \"Material/Poisson's ratio=0.3\"; may be "
      "repeated");
  add("sweep", po::value<std::vector<std::string>>()->composing()->value_name("ENTRY=VALUES"),
      "solve the scene for each of several values, a, b, c or a | b | c, on all cores, into "
      "DIR/ENTRY=VALUE, and tell of all in DIR/sweep.csv; repeated: for all combinations; what is "
      "done there already is not done again");
  add("resume", po::value<std::string>()->value_name("DIR"),
      "go on with the run whose results are in DIR after its last finished step; --set may change "
      "limits of Adaptivity alone");
  add("report", po::value<std::string>()->value_name("DIR"),
      "write report.html into DIR, a page that tells of the run whose results are there, and solve "
      "nothing; python3-hpvi draws its pictures");
  add("pdf", "with --report: write report.pdf, too");
  add("import", po::value<std::string>()->value_name("DECK.inp"),
      "write a deck of CalculiX or Abaqus, of the plane or of revolution, as scene.prm and "
      "mesh.msh "
      "into DIR (default: output/<deck>), list what is left out, and solve nothing");
  add("inf-sup", "measure the discrete inf-sup constant beta of each step, in [0,1] and better not "
                 "small, and write no file");
  add("validate", "check the scene, say in words what it says, and write nothing");
  add("picture",
      "draw the scene with its supports, loads and contact into scene.svg, by scene.json, "
      "which says it in numbers, and solve nothing");
  add("print-parameters", "print all entries of the scene with their values; without a scene: the "
                          "defaults, documented");
  add("help,h", "print this text");
  add("version", "print the version");
  return options;
}

po::variables_map parse_options(const int argc, const char *const argv[])
{
  po::options_description options = visible_options();
  options.add_options()("scene", po::value<std::string>());
  po::positional_options_description positional;
  positional.add("scene", 1);
  // An abbreviated option would change its meaning with the next option that starts alike.
  const int style = po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv)
                .options(options)
                .positional(positional)
                .style(style)
                .run(),
            values);
  return values;
}

std::pair<std::string, std::string> split_override(const std::string &text)
{
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw InputError("hpvi: --set " + printable(text) +
                     ": has no '='; write --set \"Section/Entry=value\" with quotes around it");
  return {text.substr(0, equals), text.substr(equals + 1)};
}
/** Tolerance and the largest number of steps, unknowns and seconds. */
bool is_limit(const std::string &entry)
{
  const std::string name = single_spaced(entry);
  return name == "Adaptivity/Maximum steps" || name == "Adaptivity/Maximum unknowns" ||
         name == "Adaptivity/Maximum seconds" || name == "Adaptivity/Tolerance" ||
         name == "Adaptivity/Tolerance on";
}

void take_resume(const std::string &directory, CommandLine &line)
{
  const std::string begin = "hpvi: --resume " + printable(directory, 400) + ": ";
  if (!line.scene_file.empty() || !line.output_directory.empty())
    throw InputError(begin + "goes on with the scene that is there, and writes there; remove " +
                     (line.scene_file.empty() ? "--output" : printable(line.scene_file, 400)));
  if (!line.sweeps.empty())
    throw InputError(begin + "goes on with one scene; remove --sweep, which goes on by itself with "
                             "the scenes that are not done");
  if (line.validate || line.picture || line.inf_sup || line.print_parameters)
    throw InputError(begin + "goes on with a run; remove the other command");
  for (const auto &[entry, value] : line.overrides)
    if (!is_limit(entry))
      throw InputError(begin + "--set " + printable(entry) +
                       " would make another run of it; limits alone may change: Maximum steps, "
                       "Maximum unknowns, Maximum seconds and Tolerance of Adaptivity");
  if (!std::filesystem::is_regular_file(std::filesystem::path(directory) / "scene.prm"))
    throw InputError(begin + "has no scene.prm of a run; name the directory of its results");
  line.resume = true;
  line.output_directory = directory;
  line.scene_file = directory + "/scene.prm";
}

void take_report(const std::string &directory, CommandLine &line)
{
  const std::string begin = "hpvi: --report " + printable(directory, 400) + ": ";
  if (!line.scene_file.empty() || !line.output_directory.empty() || !line.overrides.empty())
    throw InputError(begin + "tells of the run that is there, and writes there; remove " +
                     (!line.scene_file.empty()        ? printable(line.scene_file, 400)
                      : line.output_directory.empty() ? "--set"
                                                      : "--output"));
  if (line.validate || line.picture || line.inf_sup || line.print_parameters ||
      !line.sweeps.empty())
    throw InputError(begin + "solves nothing; remove the other command");
  for (const char *const file : {"summary.json", "scene.prm"})
    if (!std::filesystem::is_regular_file(std::filesystem::path(directory) / file))
      throw InputError(begin + "has no " + file + " of a run; name the directory of its results");
  line.report = directory;
}

void take_import(const std::string &deck, CommandLine &line)
{
  const std::string begin = "hpvi: --import " + printable(deck, 400) + ": ";
  if (!line.scene_file.empty() || !line.overrides.empty())
    throw InputError(begin + "makes a scene of a deck; remove " +
                     (line.scene_file.empty() ? "--set" : printable(line.scene_file, 400)));
  if (line.validate || line.picture || line.inf_sup || line.print_parameters ||
      !line.sweeps.empty() || line.resume || !line.report.empty())
    throw InputError(begin + "solves nothing; remove the other command");
  line.import = deck;
  if (line.output_directory.empty())
    line.output_directory = "output/" + std::filesystem::path(deck).stem().string();
}

void check_sweeps(const CommandLine &line)
{
  const std::vector<SweptScene> scenes = swept_scenes(line.sweeps);
  const std::string begin = "hpvi: --sweep " + printable(line.sweeps.front().path) + ": ";
  if (line.picture || line.inf_sup)
    throw InputError(begin + "solves many scenes, and " +
                     (line.picture ? "--picture" : "--inf-sup") +
                     " is of one; give its value by --set");
  for (const auto &[entry, value] : scenes.front().overrides)
    for (const auto &[other, its_value] : line.overrides)
      if (is_same_entry(entry, other))
        throw InputError("hpvi: --sweep " + printable(entry) + ": --set gives it the value " +
                         printable(its_value) + "; remove one of the two");
}
} // namespace

CommandLine parse(const int argc, const char *const argv[])
{
  po::variables_map values;
  try
  {
    values = parse_options(argc, argv);
  }
  catch (const po::error &error)
  {
    throw InputError("hpvi: " + printable(error.what()) + "; see hpvi --help");
  }

  CommandLine result;
  if (values.count("scene"))
    result.scene_file = values["scene"].as<std::string>();
  if (values.count("output"))
    result.output_directory = values["output"].as<std::string>();
  if (values.count("set"))
    for (const std::string &text : values["set"].as<std::vector<std::string>>())
      result.overrides.push_back(split_override(text));
  if (values.count("sweep"))
    for (const std::string &text : values["sweep"].as<std::vector<std::string>>())
      result.sweeps.push_back(swept_entry(text));
  result.validate = values.count("validate");
  result.picture = values.count("picture");
  result.pdf = values.count("pdf");
  result.inf_sup = values.count("inf-sup");
  result.print_parameters = values.count("print-parameters");
  result.help = values.count("help");
  result.version = values.count("version");

  if (values.count("report") && values.count("resume"))
    throw InputError(
        "hpvi: --report tells of a run, and --resume goes on with one; remove one of the two");
  if (result.pdf && !values.count("report"))
    throw InputError("hpvi: --pdf belongs to --report DIR; name the directory of results");
  if (values.count("report"))
    take_report(values["report"].as<std::string>(), result);
  if (values.count("resume"))
    take_resume(values["resume"].as<std::string>(), result);
  if (values.count("import"))
    take_import(values["import"].as<std::string>(), result);
  if (!result.sweeps.empty())
    check_sweeps(result);

  for (const auto &[option, is_named] : {std::make_pair("--inf-sup", result.inf_sup),
                                         {"--validate", result.validate},
                                         {"--print-parameters", result.print_parameters}})
    if (result.picture && is_named)
      throw InputError(std::string("hpvi: --picture draws the scene into a file, and ") + option +
                       " writes none; remove one of the two");
  if (result.inf_sup && !result.output_directory.empty())
    throw InputError("hpvi: --output " + printable(result.output_directory, 400) +
                     ": --inf-sup writes no file; remove one of the two");
  const bool defaults = result.print_parameters && !result.validate && result.overrides.empty() &&
                        result.sweeps.empty();
  if (result.scene_file.empty() && !result.help && !result.version && !defaults &&
      result.report.empty() && result.import.empty())
    throw InputError("hpvi: no scene; name a parameter file, as in hpvi prm/han-6-12.prm, or see "
                     "hpvi --help");
  return result;
}

std::string usage()
{
  std::ostringstream text;
  text << "Usage: hpvi [options] SCENE.prm\n\n"
          "Solves the scene with adaptive hp finite elements: elastic bodies in contact, with\n"
          "friction. Prints one row per adaptive step and writes tables and fields.\n"
          "Exit status: 0 done, 1 bad input, 2 the numerics gave up or something could not be\n"
          "written, 128 + n ended by signal n; what is finished stays in the output directory.\n\n"
       << visible_options();
  return text.str();
}
} // namespace hpvi
