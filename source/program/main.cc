// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/text.h>
#include <hpvi/driver/backend.h>
#include <hpvi/output/output.h>
#include <hpvi/output/result_directory.h>
#include <hpvi/output/scene_json.h>
#include <hpvi/output/scene_words.h>
#include <hpvi/program/command_line.h>
#include <hpvi/program/failure.h>
#include <hpvi/program/import_run.h>
#include <hpvi/program/inf_sup_run.h>
#include <hpvi/program/interruption.h>
#include <hpvi/program/python_call.h>
#include <hpvi/program/run.h>
#include <hpvi/program/started_processes.h>
#include <hpvi/program/sweep_run.h>
#include <hpvi/program/terminal.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/scene_reader.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>

// Present where OpenBLAS is the BLAS in use.
extern "C" int openblas_get_num_threads() __attribute__((weak));

namespace
{
using namespace hpvi;

/**
 * A standard stream that is closed gets a descriptor that cannot be written: else the first file of
 * results would take its number, and the text meant for the stream.
 */
void occupy_standard_streams()
{
  int descriptor;
  do
    descriptor = open("/dev/null", O_RDONLY | O_CLOEXEC);
  while (descriptor >= 0 && descriptor <= STDERR_FILENO);
  if (descriptor > STDERR_FILENO)
    close(descriptor);
}

void measure(const Scene<2> &scene)
{
  print_inf_sup(scene);
}

void measure(const Scene<3> &) // refused when it was read
{
}

/** Another run may be writing there, and files of these names may be another's. */
std::unique_ptr<ResultDirectory> opened(const std::string &directory, const std::string &writes)
{
  try
  {
    return std::make_unique<ResultDirectory>(directory, writes, std::vector<std::string>());
  }
  catch (const InputError &error)
  {
    const std::string what = error.what();
    throw InputError(what.substr(0, what.rfind("; ")) +
                     "; wait until that run is over, or move that file away");
  }
}

/** scene.json into @p results: it stays, whatever becomes of what is drawn of it. */
void write_scene(const ResultDirectory &results, const std::string &json)
{
  if (const std::error_code error = results.write("scene.json", json))
    throw OutputFailure(results.name() + ": scene.json cannot be written: " + error.message());
}

/** `hpvi --picture`: scene.json and scene.svg into @p directory. Throws InputError or OutputFailure. */
template <int dim>
void draw(const Scene<dim> &scene, const std::string &directory)
{
  in_all_processes(
      [&]()
      {
        if (!is_first_process())
          return;
        const std::string json = scene_json(scene); // first: it may be refused
        write_scene({directory, results::picture + "|scene\\.json", {scene.file}}, json);
        call_python("picture", {"picture", directory + "/scene.json", directory + "/scene.svg"});
        std::cout << "picture in " << printable(directory, 400) << "/scene.svg" << std::endl;
      });
}

/** `hpvi --report`: scene.json and report.html into @p directory. Throws InputError or OutputFailure. */
void tell_of_run(const std::string &directory, const bool with_pdf)
{
  const std::unique_ptr<ResultDirectory> results =
      opened(directory, results::report + (with_pdf ? "|" + results::pdf : ""));
  const ParameterFile file(directory + "/scene.prm");
  write_scene(*results, scene_dimension(file) == 3 ? scene_json(read_scene<3>(file))
                                                   : scene_json(read_scene<2>(file)));
  std::vector<std::string> words{"report", directory};
  if (with_pdf)
    words.emplace_back("--pdf");
  call_python("report", words);
  std::cout << "report in " << printable(directory, 400) << "/report.html"
            << (with_pdf ? " and report.pdf" : "") << std::endl;
}

/** @p start_mpi is called where several processes may share the work, and nowhere else: it takes its time. */
template <int dimension>
void obey_scene(const CommandLine &command_line, const ParameterFile &file,
                const std::function<void()> &start_mpi)
{
  std::optional<Scene<dimension>> read;
  in_all_processes(
      [&]()
      {
        read.emplace(
            read_scene<dimension>(file, command_line.inf_sup ? SceneUse::measure : SceneUse::solve,
                                  n_started_processes()));
      });
  const Scene<dimension> &scene = *read;
  const std::string directory = command_line.output_directory.empty()
                                    ? "output/" + scene.name
                                    : command_line.output_directory;
  if (command_line.print_parameters)
    std::cout << scene.parameters->print(false);
  else if (command_line.validate)
  {
    const std::string words = scene_in_words(scene);
    std::cout << scene.origin() << ": valid: " << legible(scene.title) << '\n' << words;
  }
  else if (command_line.picture)
    draw(scene, directory);
  else if (command_line.inf_sup)
    measure(scene);
  else
  {
    if (takes_primal_path(scene, n_started_processes()))
      start_mpi();
    if (command_line.resume)
      resume(scene, directory);
    else
      run(scene, directory);
  }
}

void obey_scene(const CommandLine &command_line, const std::function<void()> &start_mpi)
{
  std::optional<ParameterFile> file;
  in_all_processes([&]() { file.emplace(command_line.scene_file, command_line.overrides); });
  const bool is_in_space = scene_dimension(*file) == 3;
  if (!command_line.sweeps.empty())
    (is_in_space ? sweep<3> : sweep<2>)(command_line, start_mpi);
  else
    (is_in_space ? obey_scene<3> : obey_scene<2>)(command_line, *file, start_mpi);
}

void obey(const CommandLine &command_line, const std::function<void()> &start_mpi)
{
  if (command_line.help)
    std::cout << usage();
  else if (command_line.version)
    std::cout << version_line() << std::endl;
  else if (!command_line.report.empty())
    in_all_processes(
        [&]()
        {
          if (is_first_process())
            tell_of_run(command_line.report, command_line.pdf);
        });
  else if (!command_line.import.empty())
    in_all_processes(
        [&]()
        {
          if (is_first_process())
            import_deck_into(command_line.import, command_line.output_directory);
        });
  else if (command_line.scene_file.empty())
    std::cout << default_parameters();
  else
    obey_scene(command_line, start_mpi);
}

/**
 * OpenBLAS starts its threads when it is loaded. Each takes a buffer of 128 MB, tries for ever where
 * it gets none, and is waited for at the end. A run uses one thread alone: where memory is limited
 * the program begins again without the others.
 */
void do_without_threads_of_openblas(char *argv[])
{
  const std::string variable = "OPENBLAS_NUM_THREADS", none = "1";
  const char *const value = std::getenv(variable.c_str());
  if (!mapping_is_limited() || !openblas_get_num_threads || openblas_get_num_threads() == 1 ||
      (value && value == none))
    return;
  setenv(variable.c_str(), none.c_str(), 1);
  execv("/proc/self/exe", argv); // comes back only where it fails
}
/** One of several processes speaks for all. */
void be_silent()
{
  static std::ofstream nowhere("/dev/null");
  for (std::ostream *const stream : {&std::cout, &std::cerr})
    stream->rdbuf(nowhere.rdbuf());
}

/** What befalls one process alone leaves the others waiting for it: it ends them. */
void end_others(const std::exception &error)
{
  if (n_started_processes() == 1 || is_foreseen(error))
    return;
  std::fprintf(stderr, "%s\n", failure_line(error).c_str());
  MPI_Abort(MPI_COMM_WORLD, exit_status(error));
}
} // namespace

int main(int argc, char *argv[])
{
  do_without_threads_of_openblas(argv);
  reserve_heap();
  occupy_standard_streams();
  survive_failed_writes();
  std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> mpi;
  const auto start_mpi = [&]()
  {
    if (!mpi)
      mpi = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(argc, argv, 1);
  };
  if (may_have_company())
    start_mpi();
  if (!is_first_process())
    be_silent();
  try
  {
    obey(parse(argc, argv), start_mpi);
    check_standard_output("");
    return 0;
  }
  catch (const std::exception &error)
  {
    end_others(error);
    std::cerr << failure_line(error) << std::endl;
    return exit_status(error);
  }
}
