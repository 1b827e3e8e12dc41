// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/processes.h>
#include <hpvi/discretisation/initial_stress.h>
#include <hpvi/evaluation/contact_traces.h>
#include <hpvi/output/vtu.h>
#include <hpvi/peaks/stress_peak.h>

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <utility>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** d u_c / d x_j at a point. */
template <int dim>
Tensor<2, dim> gradient(const DataPostprocessorInputs::Vector<dim> &inputs, const unsigned int q)
{
  Tensor<2, dim> result;
  for (unsigned int c = 0; c < dim; ++c)
    result[c] = inputs.solution_gradients[q][c];
  return result;
}

/** Places count where there is an initial strain. */
template <int dim>
UpdateFlags flags_for(const Scene<dim> &scene)
{
  if (scene.is_axisymmetric())
    return update_values | update_gradients | update_quadrature_points;
  return scene.has_initial_strain() ? update_gradients | update_quadrature_points
                                    : update_gradients;
}

/** The elastic strain around the axis. */
template <int dim>
double hoop_at(const Scene<dim> &scene, const DataPostprocessorInputs::Vector<dim> &inputs,
               const unsigned int q)
{
  Tensor<1, dim> u;
  for (unsigned int c = 0; c < dim; ++c)
    u[c] = inputs.solution_values[q][c];
  return scene.hoop_strain(inputs.template get_cell<dim>()->material_id(), u,
                           gradient<dim>(inputs, q), inputs.evaluation_points[q]);
}

template <int dim>
SymmetricTensor<2, dim> stress_at(const Scene<dim> &scene, const HookesLaw<dim> &law,
                                  const DataPostprocessorInputs::Vector<dim> &inputs,
                                  const unsigned int q)
{
  Tensor<2, dim> strain = gradient<dim>(inputs, q);
  const double hoop = scene.is_axisymmetric() ? hoop_at(scene, inputs, q) : 0.;
  if (scene.has_initial_strain())
    strain -= scene.initial_strain_in(inputs.template get_cell<dim>(), inputs.evaluation_points[q]);
  return law.stress(strain, hoop);
}

/** The initial strain e33, of an axisymmetric body without the hoop strain. */
template <int dim>
double across_at(const Scene<dim> &scene, const DataPostprocessorInputs::Vector<dim> &inputs,
                 const unsigned int q)
{
  if (scene.is_axisymmetric())
    return -hoop_at(scene, inputs, q);
  return scene.has_initial_strain() ? initial_strain_across(scene, inputs.template get_cell<dim>(),
                                                            inputs.evaluation_points[q])
                                    : 0.;
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
    const auto cell = inputs.template get_cell<dim>();
    const Material &material = scene.material_of(cell);
    const HookesLaw<dim> law(material);
    for (unsigned int q = 0; q < fields.size(); ++q)
    {
      const SymmetricTensor<2, dim> sigma = stress_at(scene, law, inputs, q);
      fields[q][0] = von_mises(material, sigma, across_at(scene, inputs, q));
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
    return flags_for(scene);
  }

private:
  const Scene<dim> &scene;
};

/** sigma_zz in the plane, a scalar field of its own: 0 in plane stress. */
template <int dim>
class TransverseStress : public DataPostprocessorScalar<dim>
{
public:
  explicit TransverseStress(const Scene<dim> &scene)
      : DataPostprocessorScalar<dim>("sigma_zz", flags_for(scene)), scene(scene)
  {
  }

  void evaluate_vector_field(const DataPostprocessorInputs::Vector<dim> &inputs,
                             std::vector<Vector<double>> &fields) const override
  {
    const Material &material = scene.material_of(inputs.template get_cell<dim>());
    const HookesLaw<dim> law(material);
    for (unsigned int q = 0; q < fields.size(); ++q)
      if constexpr (dim == 2)
        fields[q][0] = material.transverse_stress(stress_at(scene, law, inputs, q),
                                                  across_at(scene, inputs, q));
  }

private:
  const Scene<dim> &scene;
};

/** As VTK reads it: one block that zlib has compressed, in base64 behind its sizes. */
template <class Number>
std::string encoded(const std::vector<Number> &numbers)
{
  const uLong size = numbers.size() * sizeof(Number);
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

/** Numbers that belong to cells, by active cell index. */
using CellData = std::vector<std::pair<std::string, Vector<float>>>;

/**
 * deal.II rounds coordinates to seven digits: far from the origin, or close to a transition, cells
 * would have no size. These have all digits. It also writes at points what belongs to cells.
 */
template <int dim>
class PreciseDataOut : public DataOut<dim>
{
public:
  std::string vtu(const CellData &cell_data) const
  {
    std::ostringstream file;
    this->write_vtu(file);
    std::string text = file.str();
    text.insert(text.find("</Piece>"), of_cells(cell_data));
    const std::string opening = "<Points>", closing = "</Points>";
    const std::size_t start = text.find(opening), end = text.find(closing);
    AssertThrow(start < end && end != std::string::npos, ExcInternalError());
    return text.substr(0, start + opening.size()) +
           "\n    <DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"binary\">\n" +
           encoded(coordinates()) + "\n    </DataArray>\n  " + text.substr(end);
  }

  /** Which names @p pieces. */
  std::string pvtu(const CellData &cell_data, const std::vector<std::string> &pieces) const
  {
    std::ostringstream file;
    this->write_pvtu_record(file, pieces);
    std::string text = file.str();
    text.erase(text.find("<!--"), text.find("-->") + 4 - text.find("<!--")); // it has a date
    const std::string rounded = "\"Float32\" NumberOfComponents=\"3\"/>\n    </PPoints>";
    const std::size_t place = text.find(rounded);
    AssertThrow(place != std::string::npos, ExcInternalError());
    text.replace(place, 9, "\"Float64\"");
    std::string cells = "    <PCellData>\n";
    for (const auto &[name, values] : cell_data)
      cells += "    <PDataArray type=\"Float32\" Name=\"" + name + "\"/>\n";
    return text.insert(text.find("    <PPoints>"), cells + "    </PCellData>\n");
  }

private:
  /** Each patch is cut into cells that share its numbers. */
  std::string of_cells(const CellData &cell_data) const
  {
    std::string text = "  <CellData>\n";
    for (const auto &[name, values] : cell_data)
    {
      std::vector<float> of_parts;
      auto patch = this->get_patches().begin();
      for (const auto &cell : this->triangulation->active_cell_iterators())
        if (cell->is_locally_owned())
          of_parts.insert(of_parts.end(), std::lround(std::pow((patch++)->n_subdivisions, dim)),
                          values[cell->active_cell_index()]);
      text += "    <DataArray type=\"Float32\" Name=\"" + name + "\" format=\"binary\">\n" +
              encoded(of_parts) + "\n    </DataArray>\n";
    }
    return text + "  </CellData>\n ";
  }

  /** x, y, z of the points in deal.II's order: patch by patch, x runs fastest. */
  std::vector<double> coordinates() const
  {
    std::vector<double> result;
    auto cell = this->triangulation->begin_active();
    for (const auto &patch : this->get_patches())
    {
      const unsigned int n = patch.n_subdivisions + 1;
      while (!cell->is_locally_owned())
        ++cell;
      const CellMap<dim> map = map_of<dim>(cell++);
      for (unsigned int k = 0; k < std::pow(n, dim); ++k)
      {
        Point<dim> unit, x;
        for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= n)
          unit[d] = double(rest % n) / patch.n_subdivisions;
        if (map.is_curved())
          x = map.point(unit);
        for (unsigned int v = 0; v < GeometryInfo<dim>::vertices_per_cell && !map.is_curved(); ++v)
          x += GeometryInfo<dim>::d_linear_shape_function(unit, v) * patch.vertices[v];
        for (unsigned int d = 0; d < 3; ++d)
          result.push_back(d < dim ? x[d] : 0.);
      }
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

namespace
{
/** Degree and indicator, the index of the material where there are several; where there is contact the means of pressure -T_n and friction |T_t| over the faces of a cell. */
template <int dim>
CellData cell_data(const StepReport<dim> &step, const bool is_shared)
{
  const Field<dim> &field = step.field;
  const unsigned int n = field.dof_handler.get_triangulation().n_active_cells();
  Vector<float> degree(n), estimate(n), process(n), material(n), area(n), pressure(n), friction(n);
  process = rank_of(field.communicator());
  for (const auto &cell : field.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      degree[cell->active_cell_index()] = field.degree(cell);
      estimate[cell->active_cell_index()] =
          std::sqrt(step.scene.thickness) * step.estimate.indicator(cell->active_cell_index());
      material[cell->active_cell_index()] = cell->material_id();
    }
  for (const FieldFace<dim> &face : field.faces())
  {
    const unsigned int cell = face.cell->active_cell_index();
    area[cell] += face.area();
    for (const PressurePoint<dim> &point : pressure_points(face, field))
      pressure[cell] += point.weight * point.pressure;
    for (const MultiplierPoint<dim> &point : field.multiplier_points(face, 0.))
      friction[cell] += point.area * point.traction.friction.norm();
  }
  for (unsigned int cell = 0; cell < n; ++cell)
    for (Vector<float> *const sum : {&pressure, &friction})
      (*sum)[cell] = area[cell] > 0 ? (*sum)[cell] / area[cell] : 0.F;
  CellData result{{"degree", degree}, {"estimate", estimate}};
  if (is_shared)
    result.emplace_back("process", process);
  if (step.scene.materials.size() > 1)
    result.emplace_back("material", material);
  if (step.scene.has_contact())
  {
    result.emplace_back("contact_pressure", pressure);
    result.emplace_back("contact_friction", friction);
  }
  return result;
}

/** That of cells with curved edges, for derivatives of fields: of degree @p degree it is one of these itself. */
template <int dim>
std::unique_ptr<Mapping<dim>> curved_mapping(const Triangulation<dim> &mesh,
                                             const unsigned int degree)
{
  auto mapping = std::make_unique<MappingQCache<dim>>(degree);
  const std::vector<Point<dim>> nodes = FE_Q<dim>(degree).get_unit_support_points();
  mapping->initialize(mesh,
                      [&](const typename Triangulation<dim>::cell_iterator &cell)
                      {
                        const CellMap<dim> map = map_of<dim>(cell);
                        std::vector<Point<dim>> result;
                        for (const Point<dim> &node : nodes)
                          result.push_back(map.point(node));
                        return result;
                      });
  return mapping;
}
} // namespace

template <int dim>
Vtu vtu(const StepReport<dim> &step, const std::vector<std::string> &pieces)
{
  const bool is_shared = pieces.size() > 1;
  const CellData cells = cell_data(step, is_shared);
  const StressFields<dim> stress_fields(step.scene);
  const TransverseStress<dim> transverse_stress(step.scene);
  PreciseDataOut<dim> data_out;
  data_out.set_flags(vtk_flags(step.scene, stress_fields, step.number));
  data_out.attach_dof_handler(step.field.dof_handler);
  step.field.attach(data_out);
  step.field.attach(data_out, stress_fields);
  if (dim == 2)
  {
    step.field.attach(data_out, transverse_stress);
    for (unsigned int k = 0; k < 2; ++k) // where they have always stood, beside CellData
      data_out.add_data_vector(cells[k].second, cells[k].first, DataOut<dim>::type_cell_data);
  }
  const unsigned int n_subdivisions = std::min(step.size.p_max(), 8U);
  if (step.scene.geometry.has_curves())
  {
    const auto mapping =
        curved_mapping(step.field.dof_handler.get_triangulation(), step.size.p_max());
    data_out.build_patches(*mapping, n_subdivisions, DataOut<dim>::no_curved_cells);
  }
  else
    data_out.build_patches(n_subdivisions);
  return {data_out.vtu(cells), is_shared ? data_out.pvtu(cells, pieces) : ""};
}

template Vtu vtu(const StepReport<2> &, const std::vector<std::string> &);
template Vtu vtu(const StepReport<3> &, const std::vector<std::string> &);
} // namespace hpvi
