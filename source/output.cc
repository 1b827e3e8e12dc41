// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>
#include <hpvi/output.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
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
// ---------------------------------------------------------------- numbers and texts

/** The shortest decimal that reads back as the same number; the locale has no say. */
std::string text(const double value)
{
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

/** Rounded, for pictures and times. */
std::string text(const double value, const int digits)
{
  char buffer[64];
  return {
      buffer,
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr};
}

std::string text(const unsigned int value)
{
  return std::to_string(value);
}

/** NAME-NN.SUFFIX; the number grows beyond two digits where it has to. */
std::string numbered(const std::string &name, const unsigned int step, const std::string &suffix)
{
  return name + (step < 10 ? "-0" : "-") + std::to_string(step) + suffix;
}

std::string json_string(const std::string &content)
{
  std::string result = "\"";
  for (const char c : content)
    if (c == '"' || c == '\\')
      result += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
    {
      const char digits[] = "0123456789abcdef";
      result += std::string("\\u00") + digits[c / 16] + digits[c % 16];
    }
    else
      result += c;
  return result + '"';
}

/** A field of a table: JSON knows neither empty fields nor infinity. */
std::string json_value(const std::string &field)
{
  if (field.empty() || field.find_first_of("infa") != std::string::npos)
    return "null";
  return field.find_first_of("/ ") != std::string::npos ? json_string(field) : field;
}

std::string xml_text(const std::string &content)
{
  std::string result;
  for (const char c : content)
    switch (c)
    {
    case '&':
      result += "&amp;";
      break;
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '"':
      result += "&quot;";
      break;
    default:
      result += c;
    }
  return result;
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
                {"qp_projected_gradient", text(step.qp.projected_gradient)},
                {"condition_raw", condition(step.condition_raw)},
                {"condition_scaled", condition(step.condition_scaled)},
                {"estimate_scaled", text(step.scaled_estimate)},
                {"estimate_relative", text(step.relative_estimate)},
                {"energy_norm", text(step.energies.norm)},
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

/** Hooke's law `sigma = lambda tr(eps) I + 2 mu eps`; row c of @p gradient belongs to u_c. */
template <int dim>
SymmetricTensor<2, dim> stress(const Material &material, const Tensor<2, dim> &gradient)
{
  const SymmetricTensor<2, dim> strain = symmetrize(gradient);
  return material.lambda(dim) * trace(strain) * unit_symmetric_tensor<dim>() +
         2 * material.mu() * strain;
}

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

/** u_N and sigma(u_N) at the points of one contact face. */
template <int dim>
class ContactTraces
{
public:
  ContactTraces(const ContactFace<dim> &face, const unsigned int n_gauss,
                const Solution<dim> &solution, const ShapeTables<dim> &tables)
      : material(solution.scene.material), map(map_of<dim>(face.cell)),
        table(tables.face(face.degree, face.face_no, n_gauss))
  {
    const std::vector<double> coefficients =
        solution.coefficients(face.cell->active_cell_index(), tables.numbering(face.degree));
    values = evaluate(table.values, coefficients);
    derivatives = evaluate(table.derivatives, coefficients);
  }

  Tensor<1, dim> displacement(const unsigned int q) const
  {
    Tensor<1, dim> u;
    for (unsigned int c = 0; c < dim; ++c)
      u[c] = values[c * table.points.size() + q];
    return u;
  }

  SymmetricTensor<2, dim> sigma(const unsigned int q) const
  {
    Tensor<2, dim> reference;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int j = 0; j < dim; ++j)
        reference[c][j] = derivatives[c * table.derivatives.m() + q * table.rows_per_point + j];
    return stress(material, reference * invert(map.jacobian(table.points[q])));
  }

private:
  const Material &material;
  const CellMap<dim> map;
  const ShapeTable<dim> &table;
  std::vector<double> values, derivatives; ///< component by component
};

/** How near to 1 |lambda| counts as slip: the QP puts what slips on the wall up to round-off. */
constexpr double slip_tolerance = 1e-8;

/** The rows of one face at its p - 1 Gauss points (one point for p = 1). */
template <int dim>
void add_face(const ContactFace<dim> &face, const Solution<dim> &solution,
              const ShapeTables<dim> &tables, std::vector<Record> &records)
{
  const unsigned int n = std::max(face.degree, 2U) - 1;
  const QGauss<1> gauss(n);
  const ContactTraces<dim> traces(face, n, solution, tables);
  const bool along_tangent = face.tangent * (face.point(1.) - face.point(0.)) > 0;
  for (unsigned int k = 0; k < n; ++k)
  {
    const unsigned int q = along_tangent ? k : n - 1 - k;
    const Point<dim> x = face.point(gauss.point(q)[0]);
    const Tensor<1, dim> u = traces.displacement(q);
    const double lambda = face.n_multipliers > 0 ? solution.lambda[face.first_multiplier + q] : 0.;
    const double g = face.n_multipliers > 0 ? face.friction_bound(x) : 0.;
    Record record;
    for (unsigned int d = 0; d < dim; ++d)
      record.emplace_back(std::string(1, "xyz"[d]), text(x[d]));
    record.emplace_back("normal_displacement", text(face.normal * u));
    record.emplace_back("tangential_displacement", text(face.tangent * u));
    record.emplace_back("multiplier", text(lambda));
    record.emplace_back("normal_traction", text(face.normal * (traces.sigma(q) * face.normal)));
    record.emplace_back("tangential_traction", text(0. - g * lambda)); // never -0
    record.emplace_back("state",
                        g == 0. || std::abs(lambda) >= 1. - slip_tolerance ? "slip" : "stick");
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

// ---------------------------------------------------------------- the mesh picture

/** Light for low degrees, dark for high ones; the same in every picture, so that steps compare. */
const char *colour(const unsigned int degree)
{
  static const char *const colours[] = {"#fffde0", "#fdf3a0", "#e6e66a", "#b4d857",
                                        "#78c664", "#3fab78", "#1f8c86", "#276f8e",
                                        "#33538f", "#443a85", "#471b6d", "#2d0a44"};
  return colours[std::clamp(degree, 1U, 12U) - 1];
}

const char *text_colour(const unsigned int degree)
{
  return degree < 7 ? "#000" : "#fff";
}

/** Marks at multiples of 1, 2 or 5 times a power of ten, at most @p maximum of them or so. */
std::vector<double> tick_marks(const double lower, const double upper, const double maximum)
{
  const double wanted = (upper - lower) / maximum;
  const double decade = std::pow(10., std::floor(std::log10(wanted)));
  double spacing = 10 * decade;
  for (const double factor : {5., 2., 1.})
    if (factor * decade >= wanted)
      spacing = factor * decade;
  std::vector<double> marks;
  const double slack = 1e-9 * (upper - lower);
  for (double k = std::ceil((lower - slack) / spacing); k * spacing <= upper + slack; ++k)
    marks.push_back(k * spacing + 0.); // never -0
  return marks;
}

/**
 * The mesh as scalable vector graphics. Digits and lines shrink with the cells, so that zooming in
 * shows a graded corner as clearly as the rest. Lengths on the page are pixels.
 */
class MeshPicture
{
public:
  MeshPicture(const Step<2> &step);
  std::string svg();

private:
  using Cell = DoFHandler<2>::active_cell_iterator;

  Point<2> page(const Point<2> &x) const; ///< from the plane to the page
  std::string coordinates(const Point<2> &x) const;
  void draw_label(double x, double y, const std::string &label, const std::string &style = "");
  void draw_line(double x1, double y1, double x2, double y2);
  void draw_cells();
  void draw_cell(const Cell &cell, double size);
  void draw_contact();
  void draw_axes();
  void draw_legend();

  const Step<2> &step;
  const DisplacementSpace<2> &space;
  const BoundingBox<2> box;
  const double scale; ///< pixels per length
  const double width, height, bottom;
  unsigned int p_min, p_max;
  std::ostringstream out;

  static constexpr double longest = 800., left = 80., top = 64., right = 30., below = 112.;
  static constexpr double swatch = 30.;
};

MeshPicture::MeshPicture(const Step<2> &step)
    : step(step), space(step.solution.displacement_space),
      box(GridTools::compute_bounding_box(space.triangulation())),
      scale(longest / std::max(box.side_length(0), box.side_length(1))),
      width(scale * box.side_length(0)), height(scale * box.side_length(1)), bottom(top + height)
{
  const auto extremes = std::minmax_element(space.degrees().begin(), space.degrees().end());
  p_min = *extremes.first;
  p_max = *extremes.second;
}

Point<2> MeshPicture::page(const Point<2> &x) const
{
  return {left + scale * (x[0] - box.lower_bound(0)), bottom - scale * (x[1] - box.lower_bound(1))};
}

std::string MeshPicture::coordinates(const Point<2> &x) const
{
  return text(x[0], 10) + ' ' + text(x[1], 10);
}

void MeshPicture::draw_label(const double x, const double y, const std::string &label,
                             const std::string &style)
{
  out << "<text x=\"" << text(x, 6) << "\" y=\"" << text(y, 6) << '"' << style << '>'
      << xml_text(label) << "</text>\n";
}

void MeshPicture::draw_line(const double x1, const double y1, const double x2, const double y2)
{
  out << "<path d=\"M" << text(x1, 6) << ' ' << text(y1, 6) << 'L' << text(x2, 6) << ' '
      << text(y2, 6) << "\" stroke=\"#000\"/>\n";
}

/** A cell in its colour and its degree in the middle; @p size is the shorter side on the page. */
void MeshPicture::draw_cell(const Cell &cell, const double size)
{
  const unsigned int degree = space.degrees()[cell->active_cell_index()];
  out << "<path d=\"M";
  for (const unsigned int v : {0, 1, 3, 2})
    out << (v > 0 ? "L" : "") << coordinates(page(cell->vertex(v)));
  out << "Z\" fill=\"" << colour(degree) << "\" stroke-width=\""
      << text(std::min(0.8, 0.03 * size), 4) << "\"/>\n";
  // a scaled text of ordinary size: renderers round tiny font sizes
  out << "<text y=\"3.5\" transform=\"translate(" << coordinates(page(cell->center())) << ") scale("
      << text(0.05 * std::min(size, 80.), 4) << ")\" fill=\"" << text_colour(degree)
      << "\" stroke=\"none\">" << degree << "</text>\n";
}

/** Large cells first, so that their thicker lines do not cover small neighbours. */
void MeshPicture::draw_cells()
{
  std::vector<std::pair<double, Cell>> cells;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
    {
      double longest_side = 0;
      for (const unsigned int line : cell->line_indices())
        longest_side = std::max(longest_side, cell->line(line)->diameter());
      cells.emplace_back(scale * cell->measure() / longest_side, cell);
    }
  std::stable_sort(cells.begin(), cells.end(),
                   [](const auto &a, const auto &b) { return a.first > b.first; });
  out << "<g stroke=\"#333\" stroke-linejoin=\"round\" font-size=\"10\" text-anchor=\"middle\">\n";
  for (const auto &[size, cell] : cells)
    draw_cell(cell, size);
  out << "</g>\n";
}

/** A thick line beside the boundary, where it hides no cell. */
void MeshPicture::draw_contact()
{
  std::string path;
  for (const auto &face : step.solution.contact_space.faces())
  {
    const Tensor<1, 2> outward = 4. / scale * face.normal;
    path += 'M' + coordinates(page(face.point(0.) + outward)) + 'L' +
            coordinates(page(face.point(1.) + outward));
  }
  if (!path.empty())
    out << "<path d=\"" << path << "\" stroke=\"#c4161c\" stroke-width=\"4\" fill=\"none\"/>\n";
}

/** Axes a little off the mesh with round numbers; the label names the unit. */
void MeshPicture::draw_axes()
{
  constexpr double gap = 14., tick = 5.;
  const std::string unit = step.solution.scene.length_unit;
  const std::string suffix = unit.empty() ? "" : " [" + unit + "]";
  draw_line(left, bottom + gap, left + width, bottom + gap);
  for (const double x : tick_marks(box.lower_bound(0), box.upper_bound(0), width / 60.))
  {
    const double at = page({x, 0})[0];
    draw_line(at, bottom + gap, at, bottom + gap + tick);
    draw_label(at, bottom + gap + 18, text(x, 6), " text-anchor=\"middle\"");
  }
  draw_label(left + width / 2, bottom + gap + 36, "x" + suffix, " text-anchor=\"middle\"");
  draw_line(left - gap, top, left - gap, bottom);
  for (const double y : tick_marks(box.lower_bound(1), box.upper_bound(1), height / 60.))
  {
    const double at = page({0, y})[1];
    draw_line(left - gap, at, left - gap - tick, at);
    draw_label(left - gap - tick - 3, at + 4, text(y, 6), " text-anchor=\"end\"");
  }
  const std::string place = text(top + height / 2, 6);
  draw_label(18, top + height / 2, "y" + suffix,
             " text-anchor=\"middle\" transform=\"rotate(-90 18 " + place + ")\"");
}

/** One swatch per degree of this mesh in a row, then the line of the contact boundary. */
void MeshPicture::draw_legend()
{
  const double y = bottom + 72;
  double x = left;
  draw_label(x, y + 15, "degree");
  x += 56;
  for (unsigned int p = p_min; p <= p_max; ++p, x += swatch)
  {
    out << "<rect x=\"" << text(x, 6) << "\" y=\"" << text(y, 6) << "\" width=\"" << swatch
        << "\" height=\"22\" fill=\"" << colour(p) << "\" stroke=\"#333\" stroke-width=\"0.8\"/>\n";
    draw_label(x + swatch / 2, y + 15, text(p),
               std::string(" text-anchor=\"middle\" fill=\"") + text_colour(p) + '"');
  }
  if (!step.solution.contact_space.faces().empty())
  {
    out << "<path d=\"M" << text(x + 24, 6) << ' ' << text(y + 11, 6)
        << "h30\" stroke=\"#c4161c\" stroke-width=\"4\"/>\n";
    draw_label(x + 62, y + 15, "contact boundary");
  }
}

std::string MeshPicture::svg()
{
  const std::string title = step.solution.scene.title;
  // as wide as its widest line: a bold letter of this size takes about 9 pixels
  const double legend = 56 + swatch * (p_max - p_min + 1) + 190;
  const double page_width = left + std::max({width, legend, 9. * title.size(), 7. * 50}) + right;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << text(page_width, 6)
      << "\" height=\"" << text(bottom + below, 6) << "\" viewBox=\"0 0 " << text(page_width, 6)
      << ' ' << text(bottom + below, 6) << "\" font-family=\"sans-serif\" font-size=\"13\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  draw_label(left, 24, title, " font-size=\"15\" font-weight=\"bold\"");
  draw_label(left, 44,
             "step " + text(step.number) + ": " + text(space.triangulation().n_active_cells()) +
                 " elements, " + text(space.n_free_dofs()) + " free unknowns");
  draw_cells();
  draw_contact();
  draw_axes();
  draw_legend();
  out << "</svg>\n";
  return out.str();
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
      write(numbered("mesh", step.number, ".svg"), MeshPicture(step).svg());
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
          ",\n  \"seconds\": " + object(stage_record(times)) + ",\n  \"warnings\": []\n}\n";
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
