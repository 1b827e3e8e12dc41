// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/input_error.h>
#include <hpvi/output/vtu_reader.h>

#include <deal.II/base/utilities.h>

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace hpvi
{
namespace
{
void require(const bool holds, const std::string &what)
{
  if (!holds)
    throw InputError(what);
}

/** The blocks behind their number, sizes and compressed sizes. */
std::string inflated(const std::string_view text)
{
  require(text.size() >= 8, "it has an array without content");
  const auto word = [](const std::string &bytes, const std::size_t k)
  {
    std::uint32_t result = 0;
    std::memcpy(&result, bytes.data() + 4 * k, 4);
    return result;
  };
  const std::size_t n = word(from_base64(text.substr(0, 8)), 0), head = (4 * (3 + n) + 2) / 3 * 4;
  require(n < 1000000 && head <= text.size(), "it has an array that is cut");
  const std::string sizes = from_base64(text.substr(0, head)),
                    content = from_base64(text.substr(head));
  std::string result;
  std::size_t at = 0;
  for (std::size_t k = 0; k < n; ++k)
  {
    uLongf size = k + 1 < n || word(sizes, 2) == 0 ? word(sizes, 1) : word(sizes, 2);
    const std::size_t compressed = word(sizes, 3 + k), begin = result.size();
    require(at + compressed <= content.size(), "it has an array that is cut");
    result.resize(begin + size);
    require(uncompress(reinterpret_cast<Bytef *>(&result[begin]), &size,
                       reinterpret_cast<const Bytef *>(content.data() + at), compressed) == Z_OK,
            "it has an array that cannot be uncompressed");
    at += compressed;
  }
  return result;
}

/** A file of text, whose arrays are found by what stands before them. */
class VtuText
{
public:
  explicit VtuText(const std::string_view text) : text(text)
  {
  }

  /** That behind @p words; empty where there is none. */
  template <class Number>
  std::vector<Number> array(const std::string &words, const std::string &type) const
  {
    const std::size_t found = text.find(words);
    if (found == std::string::npos)
      return {};
    const std::size_t tag = words[0] == '<' ? text.find("<DataArray", found)
                                            : text.rfind("<DataArray", found),
                      begin = text.find('>', found < tag ? tag : found),
                      end = text.find('<', begin);
    require(tag != std::string::npos && end != std::string::npos, "it is cut");
    const std::string_view head = text.substr(tag, begin - tag);
    require(head.find("type=\"" + type + '"') != head.npos &&
                head.find("format=\"binary\"") != head.npos,
            "its " + words + " is no binary " + type);
    std::size_t first = begin + 1, last = end;
    while (first < last && std::strchr(" \n\t\r", text[first]))
      ++first;
    while (last > first && std::strchr(" \n\t\r", text[last - 1]))
      --last;
    const std::string bytes = inflated(text.substr(first, last - first));
    std::vector<Number> result(bytes.size() / sizeof(Number));
    std::memcpy(result.data(), bytes.data(), result.size() * sizeof(Number));
    return result;
  }

  /** The part from @p words on. */
  VtuText from(const std::string &words) const
  {
    const std::size_t found = text.find(words);
    return VtuText(text.substr(std::min(found, text.size())));
  }

private:
  const std::string_view text;
};

/** Where VTK has the node (i, j) of a cell of order n: corners, edges one after the other, rows inside. */
unsigned int lagrange_node(const unsigned int i, const unsigned int j, const unsigned int n)
{
  if ((i == 0 || i == n) && (j == 0 || j == n))
    return i == 0 ? (j == 0 ? 0 : 3) : (j == 0 ? 1 : 2);
  if (j == 0 || j == n)
    return 4 + (j == 0 ? 0 : 2 * (n - 1)) + i - 1;
  if (i == 0 || i == n)
    return 4 + (i == n ? n - 1 : 3 * (n - 1)) + j - 1;
  return 4 * n + (i - 1) + (n - 1) * (j - 1);
}

/** The cells of a plane body, those of higher order as what their nodes span. */
void add_cells(SampledField &field, const std::int32_t *const nodes, const unsigned int n_nodes,
               const unsigned int first)
{
  const auto n = static_cast<unsigned int>(std::lround(std::sqrt(double(n_nodes)))) - 1;
  require(n > 0 && (n + 1) * (n + 1) == n_nodes, "it has cells that are no quadrilaterals");
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
    {
      const auto node = [&](const unsigned int k, const unsigned int l)
      { return first + nodes[lagrange_node(k, l, n)]; };
      field.quads.push_back({{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)}});
    }
}

constexpr unsigned int hexahedron_faces[6][4] = {{0, 3, 7, 4}, {1, 5, 6, 2}, {0, 4, 5, 1},
                                                 {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 7, 6, 5}};

/** Faces of a hexahedron around its patch: those inside have a point that eight cells share. */
void add_faces(SampledField &field, const std::int32_t *const nodes,
               const std::vector<unsigned char> &n_cells_at, const unsigned int first)
{
  for (const auto &face : hexahedron_faces)
  {
    std::array<unsigned int, 4> quad{};
    bool is_inside = false;
    for (unsigned int k = 0; k < 4; ++k)
    {
      quad[k] = first + nodes[face[k]];
      is_inside = is_inside || n_cells_at[nodes[face[k]]] >= 8;
    }
    if (!is_inside)
      field.quads.push_back(quad);
  }
}
} // namespace

void add_vtu(SampledField &field, const std::string &content, const unsigned int dim)
{
  const VtuText text(content), of_cells(text.from("<CellData"));
  const std::vector<double> points = text.array<double>("<Points>", "Float64");
  const auto displacement = text.array<float>("Name=\"displacement\"", "Float32");
  const auto von_mises = text.array<float>("Name=\"von_mises\"", "Float32");
  const auto nodes = text.array<std::int32_t>("Name=\"connectivity\"", "Int32");
  const auto ends = text.array<std::int32_t>("Name=\"offsets\"", "Int32");
  const auto degree = of_cells.array<float>("Name=\"degree\"", "Float32");
  const unsigned int first = field.points.size(), n = points.size() / 3;
  require(n > 0 && displacement.size() == 3 * n && von_mises.size() == n &&
              degree.size() == ends.size(),
          "its arrays are not those of one solution");
  for (const std::int32_t node : nodes)
    require(node >= 0 && unsigned(node) < n, "it has cells without points");
  for (unsigned int k = 0; k < n; ++k)
  {
    field.points.push_back({{points[3 * k], points[3 * k + 1], points[3 * k + 2]}});
    field.displacements.push_back(
        {{displacement[3 * k], displacement[3 * k + 1], displacement[3 * k + 2]}});
  }
  field.von_mises.insert(field.von_mises.end(), von_mises.begin(), von_mises.end());
  std::vector<unsigned char> n_cells_at(dim == 3 ? n : 0);
  const auto for_each_cell = [&](const auto &work)
  {
    std::int32_t begin = 0;
    for (unsigned int cell = 0; cell < ends.size(); begin = ends[cell++])
    {
      require(begin >= 0 && ends[cell] >= begin + (1 << dim) &&
                  std::size_t(ends[cell]) <= nodes.size(),
              "it has cells without points");
      work(nodes.data() + begin, ends[cell] - begin);
      field.degrees.resize(field.quads.size(), degree[cell]);
    }
  };
  if (dim == 3)
    for_each_cell(
        [&](const std::int32_t *const corners, unsigned int)
        {
          for (unsigned int k = 0; k < 8; ++k)
            ++n_cells_at[corners[k]];
        });
  for_each_cell(
      [&](const std::int32_t *const own, const unsigned int n_nodes)
      {
        if (dim == 2)
          add_cells(field, own, n_nodes, first);
        else
          add_faces(field, own, n_cells_at, first);
      });
}
} // namespace hpvi
