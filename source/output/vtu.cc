// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>
#include <hpvi/base/formatting.h>
#include <hpvi/output/vtu.h>
#include <hpvi/peaks/stress_peak.h>

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
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
      const SymmetricTensor<2, dim> sigma = HookesLaw<dim>(material).stress(gradient);
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
template <int dim>
DataOutBase::VtkFlags vtk_flags(const Scene<dim> &scene, const StressFields<dim> &stress_fields,
                                const unsigned int step)
{
  DataOutBase::VtkFlags flags;
  flags.time = step;
  flags.cycle = step;
  flags.print_date_and_time = false; // equal runs write equal files
  flags.compression_level = DataOutBase::VtkFlags::best_speed;
  if (!scene.length_unit.empty())
    flags.physical_units["displacement"] = xml_text(scene.length_unit);
  for (const std::string &field : stress_fields.get_names())
    if (!scene.stress_unit.empty())
      flags.physical_units[field] = xml_text(scene.stress_unit);
  return flags;
}
} // namespace

template <int dim>
std::string vtu(const StepReport<dim> &step)
{
  const Scene<dim> &scene = step.solution.scene;
  const DisplacementSpace<dim> &space = step.solution.displacement_space;
  Vector<float> degree(space.degrees().size()), estimate(space.degrees().size());
  for (unsigned int k = 0; k < degree.size(); ++k)
  {
    degree[k] = space.degrees()[k];
    estimate[k] = step.estimate.indicator(k);
  }
  const StressFields<dim> stress_fields(scene);
  PreciseDataOut<dim> data_out;
  data_out.set_flags(vtk_flags(scene, stress_fields, step.number));
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
  return data_out.vtu();
}

template <int dim>
PrimalVtu vtu(const PrimalReport<dim> &step, const std::vector<std::string> &pieces)
{
  const MomentSpace<dim> &space = step.space;
  const unsigned int n_cells = space.dof_handler.get_triangulation().n_active_cells();
  Vector<float> estimate(n_cells), process(n_cells);
  for (unsigned int k = 0; k < n_cells; ++k)
    estimate[k] = step.estimate.indicator(k);
  process = Utilities::MPI::this_mpi_process(space.communicator());
  const StressFields<dim> stress_fields(space.scene);
  DataOut<dim> data_out;
  data_out.set_flags(vtk_flags(space.scene, stress_fields, step.number));
  data_out.attach_dof_handler(space.dof_handler);
  data_out.add_data_vector(space.dof_handler, step.u, std::vector<std::string>(dim, "displacement"),
                           std::vector<DataComponentInterpretation::DataComponentInterpretation>(
                               dim, DataComponentInterpretation::component_is_part_of_vector));
  data_out.add_data_vector(space.dof_handler, step.u, stress_fields);
  data_out.add_data_vector(estimate, "estimate", DataOut<dim>::type_cell_data);
  data_out.add_data_vector(process, "process", DataOut<dim>::type_cell_data);
  data_out.build_patches(space.tables.degree);
  std::ostringstream piece, index;
  data_out.write_vtu(piece);
  data_out.write_pvtu_record(index, pieces);
  return {piece.str(), index.str()};
}

void add_to_pvd(GrowingText &pvd, const double time, const std::string &file)
{
  const std::string head = "<?xml version=\"1.0\"?>\n"
                           "<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n",
                    end = "  </Collection>\n</VTKFile>\n";
  pvd.same = pvd.text.empty() ? 0 : pvd.text.size() - end.size();
  pvd.text.resize(pvd.same);
  pvd.text += (pvd.same == 0 ? head : "") + "    <DataSet timestep=\"" + text(time) +
              "\" part=\"0\" file=\"" + file + "\"/>\n" + end;
}

template std::string vtu(const StepReport<2> &);
template PrimalVtu vtu(const PrimalReport<2> &, const std::vector<std::string> &);
template PrimalVtu vtu(const PrimalReport<3> &, const std::vector<std::string> &);
} // namespace hpvi
