// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>
#include <hpvi/base/formatting.h>
#include <hpvi/evaluation/contact_state.h>
#include <hpvi/evaluation/contact_traces.h>
#include <hpvi/output/mesh_picture.h>
#include <hpvi/output/output.h>
#include <hpvi/scene/parameters.h>

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <regex>
#include <sstream>

namespace hpvi
{
using namespace dealii;

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
  const auto known = [](const double value) { return std::isfinite(value) ? text(value) : ""; };
  const auto condition = [&](const double value) { return value == 0 ? "" : known(value); };
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
                {"estimate_relative", known(step.relative_estimate)},
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

// ---------------------------------------------------------------- forces

template <int dim>
std::string json_point(const Tensor<1, dim> &x)
{
  std::string list;
  for (unsigned int d = 0; d < dim; ++d)
    list += (d > 0 ? ", " : "") + text(x[d]);
  return "[" + list + "]";
}

template <int dim>
std::string json_force(const BoundaryForce<dim> &force)
{
  return json_string(force.boundary) + ": {\"force\": " + json_point(force.force) +
         ", \"moment\": " + text(force.moment) + "}";
}

/** Two members of summary.json: forces by boundary, and how well they balance. */
template <int dim>
std::string json_equilibrium(const Equilibrium<dim> &equilibrium)
{
  std::string forces = "\n    " + json_force(equilibrium.loads);
  for (const BoundaryForce<dim> &reaction : equilibrium.reactions)
    forces += ",\n    " + json_force(reaction);
  return "  \"forces\": {" + forces +
         "\n  },\n  \"balance\": {\n    \"force\": " + text(equilibrium.force_imbalance) +
         ",\n    \"moment\": " + text(equilibrium.moment_imbalance) +
         ",\n    \"moments_about\": " + json_point<dim>(equilibrium.centre) + "\n  },\n";
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
  explicit StressFields(const Scene<dim> &scene) : scene(scene)
  {
  }

  void evaluate_vector_field(const DataPostprocessorInputs::Vector<dim> &inputs,
                             std::vector<Vector<double>> &fields) const override
  {
    const Material &material = scene.material_of(inputs.template get_cell<dim>());
    for (unsigned int q = 0; q < fields.size(); ++q)
    {
      Tensor<2, dim> gradient;
      for (unsigned int c = 0; c < dim; ++c)
        gradient[c] = inputs.solution_gradients[q][c];
      const SymmetricTensor<2, dim> sigma = material.stress(gradient);
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
  const Scene<dim> &scene;
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

// ---------------------------------------------------------------- VTU

/** As VTK reads it: one block that zlib has compressed, in base64 behind its sizes. */
std::string encoded(const std::vector<double> &numbers)
{
  const uLong size = numbers.size() * sizeof(double);
  uLongf compressed_size = compressBound(size);
  std::vector<unsigned char> compressed(compressed_size);
  const int status = compress2(compressed.data(), &compressed_size,
                               reinterpret_cast<const Bytef *>(numbers.data()), size, Z_BEST_SPEED);
  AssertThrow(status == Z_OK, ExcInternalError());
  compressed.resize(compressed_size);
  const std::uint32_t sizes[] = {1, std::uint32_t(size), std::uint32_t(size),
                                 std::uint32_t(compressed_size)};
  const auto *const head = reinterpret_cast<const unsigned char *>(sizes);
  return Utilities::encode_base64({head, head + sizeof sizes}) +
         Utilities::encode_base64(compressed);
}

/**
 * deal.II rounds coordinates to seven digits: far from the origin, or close to a transition, cells
 * would have no size. These have all digits.
 */
template <int dim>
class PreciseDataOut : public DataOut<dim>
{
public:
  std::string vtu() const
  {
    std::ostringstream file;
    this->write_vtu(file);
    const std::string text = file.str(), opening = "<Points>", closing = "</Points>";
    const std::size_t start = text.find(opening), end = text.find(closing);
    AssertThrow(start < end && end != std::string::npos, ExcInternalError());
    return text.substr(0, start + opening.size()) +
           "\n    <DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"binary\">\n" +
           encoded(coordinates()) + "\n    </DataArray>\n  " + text.substr(end);
  }

private:
  /** x, y, z of the points in deal.II's order: patch by patch, x runs fastest. */
  std::vector<double> coordinates() const
  {
    static_assert(dim == 2, "patches are quadrilaterals");
    std::vector<double> result;
    for (const auto &patch : this->get_patches())
      for (unsigned int j = 0; j <= patch.n_subdivisions; ++j)
        for (unsigned int i = 0; i <= patch.n_subdivisions; ++i)
        {
          const Point<2> unit(double(i) / patch.n_subdivisions, double(j) / patch.n_subdivisions);
          Point<2> x;
          for (unsigned int v = 0; v < GeometryInfo<2>::vertices_per_cell; ++v)
            x += GeometryInfo<2>::d_linear_shape_function(unit, v) * patch.vertices[v];
          result.insert(result.end(), {x[0], x[1], 0.});
        }
    return result;
  }
};
} // namespace

// ---------------------------------------------------------------- Output

template <int dim>
Output<dim>::Output(const Scene<dim> &scene, const std::string &path)
    : scene(scene),
      directory(path, [this](const std::string &name) { return writes(name); },
                {scene.parameters ? scene.parameters->file_name() : "", scene.reference_solution})
{
  try
  {
    write_summary("running", ""); // names the files of earlier runs as long as there are any
    directory.remove_earlier();
    if (scene.parameters)
      write("scene.prm", scene.parameters->print(false));
  }
  catch (const InputError &error)
  {
    give_up("failed", error.what());
    throw;
  }
  is_usable = true;
}

template <int dim>
bool Output<dim>::writes(const std::string &name) const
{
  const auto matches = [&name](const char *pattern)
  { return std::regex_match(name, std::regex(pattern)); };
  return matches("scene\\.prm|convergence\\.csv|degrees\\.csv|summary\\.json") ||
         (scene.output.contact && scene.has_contact() && matches("contact-[0-9]{2,}\\.csv")) ||
         (scene.output.mesh_picture && matches("mesh-[0-9]{2,}\\.svg")) ||
         (scene.output.vtu && matches("solution(-[0-9]{2,}\\.vtu|\\.pvd)")) ||
         (scene.output.reference && matches("reference\\.dat"));
}

template <int dim>
void Output<dim>::write(const std::string &name, const std::string &content)
{
  if (directory.add(name))
    write_summary("running", "");
  replace(name, content);
}

template <int dim>
void Output<dim>::replace(const std::string &name, const std::string &content) const
{
  const std::error_code error = directory.write(name, content);
  if (!error)
    return;
  const std::string reason = name + " cannot be written: " + error.message();
  if (!is_usable)
    directory.reject(reason);
  throw OutputFailure(directory.name() + ": " + reason + "; " + safe_steps());
}

template <int dim>
std::string Output<dim>::safe_steps() const
{
  if (finished_steps == 0)
    return "no step is finished";
  const bool one = finished_steps == 1;
  return (one ? "step 1" : "steps 1 to " + std::to_string(finished_steps)) +
         (directory.is_gone() ? (one ? " has" : " have") + std::string(" vanished with it")
                              : (one ? " is" : " are") + std::string(" safe"));
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
  add_rows(step); // last: the tables name no step whose files are missing
  write_tables();
  ++finished_steps;
  stopped_by = step.stopped_by;
  warnings = step.warnings;
  equilibrium = step.equilibrium;
  write_summary("running", "");
}

template <int dim>
void Output<dim>::finish()
{
  write_summary("done", "");
}

template <int dim>
void Output<dim>::give_up(const std::string &status, const std::string &message)
{
  convergence.resize(finished_steps);
  try
  {
    write_summary(status, message);
  }
  catch (const std::runtime_error &)
  {
    // the message itself is what the user has to hear of
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
void Output<dim>::write_tables()
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
  const auto list = [](const auto &lines) -> std::string
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
          ",\n  \"final\": " + (convergence.empty() ? "null" : object(convergence.back())) + ",\n" +
          (stopped_by.empty() ? "" : json_equilibrium(equilibrium)) +
          "  \"seconds\": " + object(stage_record(times)) + ",\n  \"warnings\": [" +
          list(warnings) + "],\n  \"files\": [" + list(directory.files()) + "]\n}\n";
  replace("summary.json", json);
}

/** Linear cells, subdivided as finely as the highest degree asks for, up to a readable file. */
template <int dim>
void Output<dim>::write_vtu(const Step<dim> &step, const std::string &name)
{
  const DisplacementSpace<dim> &space = step.solution.displacement_space;
  Vector<float> degree(space.degrees().size()), estimate(space.degrees().size());
  for (unsigned int k = 0; k < degree.size(); ++k)
  {
    degree[k] = space.degrees()[k];
    estimate[k] = step.estimate.indicator(k);
  }
  const StressFields<dim> stress_fields(scene);
  PreciseDataOut<dim> data_out;
  DataOutBase::VtkFlags flags;
  flags.time = step.number;
  flags.cycle = step.number;
  flags.print_date_and_time = false; // equal runs write equal files
  flags.compression_level = DataOutBase::VtkFlags::best_speed;
  if (!scene.length_unit.empty())
    flags.physical_units["displacement"] = xml_text(scene.length_unit);
  for (const std::string &field : stress_fields.get_names())
    if (!scene.stress_unit.empty())
      flags.physical_units[field] = xml_text(scene.stress_unit);
  data_out.set_flags(flags);
  data_out.attach_dof_handler(space.dof_handler());
  data_out.add_data_vector(space.dof_handler(), step.solution.u,
                           std::vector<std::string>(dim, "displacement"),
                           std::vector<DataComponentInterpretation::DataComponentInterpretation>(
                               dim, DataComponentInterpretation::component_is_part_of_vector));
  data_out.add_data_vector(space.dof_handler(), step.solution.u, stress_fields);
  data_out.add_data_vector(degree, "degree", DataOut<dim>::type_cell_data);
  data_out.add_data_vector(estimate, "estimate", DataOut<dim>::type_cell_data);
  const unsigned int p_max = *std::max_element(space.degrees().begin(), space.degrees().end());
  data_out.build_patches(std::min(p_max, 8U));
  write(name, data_out.vtu());
}

template class Output<2>;
} // namespace hpvi
