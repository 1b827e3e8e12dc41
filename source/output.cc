// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>
#include <hpvi/contact_state.h>
#include <hpvi/formatting.h>
#include <hpvi/mesh_picture.h>
#include <hpvi/output.h>
#include <hpvi/stress.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <numeric>
#include <regex>
#include <sstream>

namespace hpvi
{
using namespace dealii;
namespace fs = std::filesystem;

namespace
{
/** NAME-NN.SUFFIX; the number grows beyond two digits where it has to. */
std::string numbered(const std::string &name, const unsigned int step, const std::string &suffix)
{
  return name + (step < 10 ? "-0" : "-") + std::to_string(step) + suffix;
}

/** A field of a table: JSON knows neither empty fields nor infinity. */
std::string json_value(const std::string &field)
{
  if (field.empty() || field.find_first_of("infa") != std::string::npos)
    return "null";
  return field.find_first_of("/ ") != std::string::npos ? json_string(field) : field;
}

// ---------------------------------------------------------------- tables

using Record = std::vector<std::pair<std::string, std::string>>;

/** Comma-separated, with the names of the last record as head. */
std::string csv(const std::vector<Record> &records)
{
  std::string table;
  const auto add_line = [&table](const Record &record, const auto &field)
  {
    for (std::size_t i = 0; i < record.size(); ++i)
      table += (i > 0 ? "," : "") + field(record[i]);
    table += '\n';
  };
  if (!records.empty())
    add_line(records.back(), [](const auto &entry) { return entry.first; });
  for (const Record &record : records)
    add_line(record, [](const auto &entry) { return entry.second; });
  return table;
}

/** Square root of the sum of one of the squared contributions to the estimate. */
std::string root_of_sum(const std::vector<double> &squares)
{
  return text(std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.)));
}

Record stage_record(const StageTimes &times)
{
  Record record;
  for (const auto &[name, seconds] : times.named())
    record.emplace_back(name, text(seconds, 6));
  return record;
}

/** Where stick meets slip: points separated by blanks, coordinates by slashes. */
template <int dim>
std::string transition_list(const Solution<dim> &solution)
{
  std::string list;
  for (const Point<dim> &x : transitions(solution))
  {
    list += list.empty() ? "" : " ";
    for (unsigned int d = 0; d < dim; ++d)
      list += (d > 0 ? "/" : "") + text(x[d], 10);
  }
  return list;
}

/** The row of convergence.csv. */
template <int dim>
Record convergence_record(const Step<dim> &step, const unsigned int p_min, const unsigned int p_max)
{
  const DisplacementSpace<dim> &space = step.solution.displacement_space;
  const auto condition = [](const double value) { return value == 0 ? "" : text(value); };
  const auto known = [](const double value) { return std::isnan(value) ? "" : text(value); };
  Record record{{"step", text(step.number)},
                {"elements", text(space.triangulation().n_active_cells())},
                {"dofs", text(space.n_dofs())},
                {"dofs_free", text(space.n_free_dofs())},
                {"multipliers", text(step.solution.contact_space.n_multipliers())},
                {"p_min", text(p_min)},
                {"p_max", text(p_max)},
                {"estimate", text(step.estimate.total())},
                {"lagrangian", text(step.energies.lagrangian)},
                {"energy", text(step.energies.energy)},
                {"slack", text(step.energies.slack)},
                {"qp_multiplications", text(step.qp.multiplications)},
                {"seconds", text(step.seconds, 6)},
                {"estimate_volume", root_of_sum(step.estimate.volume)},
                {"estimate_jumps", root_of_sum(step.estimate.jumps)},
                {"estimate_neumann", root_of_sum(step.estimate.neumann)},
                {"estimate_contact", root_of_sum(step.estimate.contact)},
                {"qp_cg", text(step.qp.cg_steps)},
                {"qp_expansion", text(step.qp.expansion_steps)},
                {"qp_proportioning", text(step.qp.proportioning_steps)},
                {"qp_dense_solves", text(step.qp.dense_solves)},
                {"qp_fell_back", text(static_cast<unsigned int>(step.qp.fell_back))},
                {"qp_projected_gradient", text(step.qp.projected_gradient)},
                {"condition_raw", condition(step.condition_raw)},
                {"condition_scaled", condition(step.condition_scaled)},
                {"estimate_scaled", text(step.scaled_estimate)},
                {"estimate_relative", text(step.relative_estimate)},
                {"energy_norm", text(step.energies.norm)},
                {"friction_resultant", known(step.energies.resultant)},
                {"error_energy", known(step.errors.energy)},
                {"error_relative", known(step.errors.energy / step.errors.energy_norm)},
                {"error_l2", known(step.errors.l2)},
                {"error_multiplier", known(step.errors.multiplier_l2)},
                {"error_transition", known(step.errors.transition)},
                {"energy_difference", known(step.energies.energy - step.errors.reference_energy)},
                {"effectivity", known(step.scaled_estimate / step.errors.energy)},
                {"transitions", transition_list(step.solution)}};
  for (const auto &[stage, seconds] : stage_record(step.times))
    record.emplace_back("seconds_" + stage, seconds);
  return record;
}

/** Number of elements by degree; entry 0 stays empty. */
template <int dim>
std::vector<unsigned int> count_degrees(const DisplacementSpace<dim> &space)
{
  std::vector<unsigned int> count(1);
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const unsigned int degree = space.degrees()[cell->active_cell_index()];
      count.resize(std::max<std::size_t>(count.size(), degree + 1));
      ++count[degree];
    }
  return count;
}

std::string degree_table(const std::vector<std::vector<unsigned int>> &degrees)
{
  std::size_t n_columns = 0;
  for (const auto &count : degrees)
    n_columns = std::max(n_columns, count.size());
  std::vector<Record> records;
  for (const auto &count : degrees)
  {
    Record record{{"step", text(static_cast<unsigned int>(records.size() + 1))},
                  {"elements", text(std::accumulate(count.begin(), count.end(), 0U))}};
    for (unsigned int p = 1; p < n_columns; ++p)
      record.emplace_back("p" + text(p), text(p < count.size() ? count[p] : 0U));
    records.push_back(record);
  }
  return csv(records);
}

// ---------------------------------------------------------------- stress

/** `sqrt(3/2 s:s)` with the deviator s; plane strain holds sigma_zz as well. */
template <int dim>
double von_mises(const Material &material, const SymmetricTensor<2, dim> &sigma)
{
  SymmetricTensor<2, 3> full;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      full[i][j] = sigma[i][j];
  if (dim == 2 && material.plane == PlaneModel::strain)
    full[2][2] = material.poisson * trace(sigma);
  return std::sqrt(1.5) * deviator(full).norm();
}

/** von Mises' stress and the components of sigma as scalar fields. */
template <int dim>
class StressFields : public DataPostprocessor<dim>
{
public:
  explicit StressFields(const Material &material) : material(material)
  {
  }

  void evaluate_vector_field(const DataPostprocessorInputs::Vector<dim> &inputs,
                             std::vector<Vector<double>> &fields) const override
  {
    for (unsigned int q = 0; q < fields.size(); ++q)
    {
      Tensor<2, dim> gradient;
      for (unsigned int c = 0; c < dim; ++c)
        gradient[c] = inputs.solution_gradients[q][c];
      const SymmetricTensor<2, dim> sigma = stress(material, gradient);
      fields[q][0] = von_mises(material, sigma);
      for (unsigned int i = 0; i < sigma.n_independent_components; ++i)
        fields[q][1 + i] = sigma.access_raw_entry(i);
    }
  }

  std::vector<std::string> get_names() const override
  {
    std::vector<std::string> names{"von_mises"};
    for (unsigned int i = 0; i < SymmetricTensor<2, dim>::n_independent_components; ++i)
    {
      const auto index = SymmetricTensor<2, dim>::unrolled_to_component_indices(i);
      names.push_back(std::string("sigma_") + "xyz"[index[0]] + "xyz"[index[1]]);
    }
    return names;
  }

  std::vector<DataComponentInterpretation::DataComponentInterpretation>
  get_data_component_interpretation() const override
  {
    return std::vector<DataComponentInterpretation::DataComponentInterpretation>(
        get_names().size(), DataComponentInterpretation::component_is_scalar);
  }

  UpdateFlags get_needed_update_flags() const override
  {
    return update_gradients;
  }

private:
  const Material material;
};

// ---------------------------------------------------------------- the contact boundary

/** The rows of one face at the Gauss points of its multiplier. */
template <int dim>
void add_face(const ContactFace<dim> &face, const Solution<dim> &solution,
              const ShapeTables<dim> &tables, std::vector<Record> &records)
{
  const std::vector<ContactPoint<dim>> points = contact_points(face, solution);
  const ContactTraces<dim> traces(face, points.size(), solution, tables);
  for (const ContactPoint<dim> &point : points)
  {
    const Tensor<1, dim> u = traces.displacement(point.q);
    Record record;
    for (unsigned int d = 0; d < dim; ++d)
      record.emplace_back(std::string(1, "xyz"[d]), text(point.x[d]));
    record.emplace_back("normal_displacement", text(face.normal * u));
    record.emplace_back("tangential_displacement", text(face.tangent * u));
    record.emplace_back("multiplier", text(point.lambda));
    record.emplace_back("normal_traction", text(traces.normal_traction(point.q)));
    record.emplace_back("tangential_traction",
                        text(0. - point.friction_bound * point.lambda)); // never -0
    record.emplace_back("state", point.slips ? "slip" : "stick");
    records.push_back(record);
  }
}

template <int dim>
std::string contact_table(const Solution<dim> &solution, const ShapeTables<dim> &tables)
{
  std::vector<Record> records;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
    add_face(face, solution, tables, records);
  return csv(records);
}

// ---------------------------------------------------------------- the directory

[[noreturn]] void reject_directory(const fs::path &directory, const std::string &reason)
{
  throw InputError("output directory '" + directory.string() + "' cannot be used: " + reason +
                   "; choose another one with --output");
}

/** With all its parents, or none of them. */
void create(const fs::path &directory)
{
  std::error_code error, ignored;
  std::vector<fs::path> missing;
  for (fs::path path = fs::absolute(directory).lexically_normal();
       path.has_relative_path() && !fs::exists(fs::symlink_status(path, ignored));
       path = path.parent_path())
    missing.push_back(path);
  fs::create_directories(directory, error);
  if (!error && fs::is_directory(directory, ignored))
    return;
  for (const fs::path &path : missing)
    fs::remove(path, ignored);
  reject_directory(directory, error ? error.message() : "it is not a directory");
}

/** Is this the name of a file that belongs to single steps or to a whole earlier run? */
bool is_result(const std::string &name)
{
  static const std::regex pattern(
      "(contact-[0-9]{2,}\\.csv|solution-[0-9]{2,}\\.vtu|"
      "mesh-[0-9]{2,}\\.svg|solution\\.pvd|convergence\\.csv|"
      "degrees\\.csv|reference\\.dat|summary\\.json|scene\\.prm)(\\.tmp)?");
  return std::regex_match(name, pattern);
}
} // namespace

// ---------------------------------------------------------------- Output

template <int dim>
Output<dim>::Output(const Scene<dim> &scene, const std::string &directory)
    : scene(scene), directory(directory)
{
  prepare_directory();
}

template <int dim>
void Output<dim>::prepare_directory() const
{
  create(directory);
  std::error_code error;
  if (fs::equivalent(scene.file, directory / "scene.prm", error))
    reject_directory(directory, "its scene.prm is the scene itself and would be overwritten");
  write("scene.prm", scene.effective_parameters);
  std::vector<fs::path> stale;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error))
    if (is_result(entry->path().filename()) && entry->path().filename() != "scene.prm")
      stale.push_back(entry->path());
  for (std::size_t i = 0; !error && i < stale.size(); ++i)
    fs::remove(stale[i], error);
  if (error)
    reject_directory(directory, "earlier results cannot be removed: " + error.message());
}

/** The file appears under its name only when it is whole. */
template <int dim>
void Output<dim>::write(const std::string &name, const std::string &content) const
{
  const fs::path partial = directory / (name + ".tmp");
  errno = 0;
  std::ofstream file(partial, std::ios::binary);
  file << content;
  file.close();
  std::error_code error(file ? 0 : (errno != 0 ? errno : EIO), std::generic_category());
  if (!error)
    fs::rename(partial, directory / name, error);
  if (error)
  {
    std::error_code ignored;
    fs::remove(partial, ignored);
    reject_directory(directory, name + " cannot be written: " + error.message());
  }
}

template <int dim>
void Output<dim>::write_step(const Step<dim> &step)
{
  if (scene.output.contact && scene.has_contact())
    write(numbered("contact", step.number, ".csv"), contact_table(step.solution, tables));
  if constexpr (dim == 2)
    if (scene.output.mesh_picture)
      write(numbered("mesh", step.number, ".svg"), mesh_picture(step));
  if (scene.output.vtu)
  {
    const std::string name = numbered("solution", step.number, ".vtu");
    write_vtu(step, name);
    vtu_files.emplace_back(step.number, name);
    std::ostringstream record;
    DataOutBase::write_pvd_record(record, vtu_files);
    write("solution.pvd", record.str());
  }
  if (scene.output.reference && !step.stopped_by.empty())
  {
    std::ostringstream file;
    StoredSolution<dim>(step.solution, tables, step.energies.energy).write(file);
    write("reference.dat", file.str());
  }
  stopped_by = step.stopped_by;
  warnings = step.warnings;
  add_rows(step); // last: the tables name no step whose files are missing
  write_tables();
  write_summary("running", "");
}

template <int dim>
void Output<dim>::finish(const std::string &status)
{
  if (status == "done")
    return write_summary("done", "");
  try
  {
    write_summary("failed", status);
  }
  catch (const InputError &)
  {
    // the failure itself is what the user has to hear of
  }
}

template <int dim>
void Output<dim>::add_rows(const Step<dim> &step)
{
  const Degrees &p = step.solution.displacement_space.degrees();
  const auto [p_min, p_max] = std::minmax_element(p.begin(), p.end());
  convergence.push_back(convergence_record(step, *p_min, *p_max));
  degrees.push_back(count_degrees(step.solution.displacement_space));
  times += step.times;
}

template <int dim>
void Output<dim>::write_tables() const
{
  write("convergence.csv", csv(convergence));
  write("degrees.csv", degree_table(degrees));
}

template <int dim>
void Output<dim>::write_summary(const std::string &status, const std::string &message) const
{
#ifdef DEBUG
  const std::string build = "Debug";
#else
  const std::string build = "Release";
#endif
  const auto object = [](const Record &record)
  {
    std::string list;
    for (const auto &[name, value] : record)
      list += (list.empty() ? "\n    " : ",\n    ") + json_string(name) + ": " + json_value(value);
    return "{" + list + "\n  }";
  };
  const auto list = [](const std::vector<std::string> &lines) -> std::string
  {
    std::string result;
    for (const std::string &line : lines)
      result += (result.empty() ? "\n    " : ",\n    ") + json_string(line);
    return result.empty() ? "" : result + "\n  ";
  };
  std::string json = "{\n  \"status\": " + json_string(status) + ",\n";
  if (!stopped_by.empty())
    json += "  \"stopped_by\": " + json_string(stopped_by) + ",\n";
  if (!message.empty())
    json += "  \"message\": " + json_string(message) + ",\n";
  json += "  \"scene\": " + json_string(scene.name) +
          ",\n  \"title\": " + json_string(scene.title) +
          ",\n  \"program\": " + json_string("hpvi " HPVI_VERSION) +
          ",\n  \"build\": " + json_string(build) +
          ",\n  \"deal.II\": " + json_string(DEAL_II_PACKAGE_VERSION) +
          ",\n  \"units\": {\n    \"length\": " + json_string(scene.length_unit) +
          ",\n    \"stress\": " + json_string(scene.stress_unit) +
          "\n  },\n  \"steps\": " + std::to_string(convergence.size()) +
          ",\n  \"final\": " + (convergence.empty() ? "null" : object(convergence.back())) +
          ",\n  \"seconds\": " + object(stage_record(times)) + ",\n  \"warnings\": [" +
          list(warnings) + "]\n}\n";
  write("summary.json", json);
}

/** Linear cells, subdivided as finely as the highest degree asks for, up to a readable file. */
template <int dim>
void Output<dim>::write_vtu(const Step<dim> &step, const std::string &name) const
{
  const DisplacementSpace<dim> &space = step.solution.displacement_space;
  Vector<float> degree(space.degrees().size()), estimate(space.degrees().size());
  for (unsigned int k = 0; k < degree.size(); ++k)
  {
    degree[k] = space.degrees()[k];
    estimate[k] = step.estimate.indicator(k);
  }
  const StressFields<dim> stress_fields(scene.material);
  DataOut<dim> data_out;
  const std::string length = xml_text(scene.length_unit), pressure = xml_text(scene.stress_unit);
  DataOutBase::VtkFlags flags;
  flags.time = step.number;
  flags.cycle = step.number;
  flags.print_date_and_time = false; // equal runs write equal files
  flags.compression_level = DataOutBase::VtkFlags::best_speed;
  flags.physical_units["displacement"] = length;
  for (const std::string &field : stress_fields.get_names())
    flags.physical_units[field] = pressure;
  data_out.set_flags(flags);
  data_out.add_data_vector(space.dof_handler(), step.solution.u,
                           std::vector<std::string>(dim, "displacement"),
                           std::vector<DataComponentInterpretation::DataComponentInterpretation>(
                               dim, DataComponentInterpretation::component_is_part_of_vector));
  data_out.add_data_vector(space.dof_handler(), step.solution.u, stress_fields);
  data_out.attach_dof_handler(space.dof_handler());
  data_out.add_data_vector(degree, "degree", DataOut<dim>::type_cell_data);
  data_out.add_data_vector(estimate, "estimate", DataOut<dim>::type_cell_data);
  const unsigned int p_max = *std::max_element(space.degrees().begin(), space.degrees().end());
  data_out.build_patches(std::min(p_max, 8U));
  std::ostringstream file;
  data_out.write_vtu(file);
  write(name, file.str());
}

template class Output<2>;
} // namespace hpvi
