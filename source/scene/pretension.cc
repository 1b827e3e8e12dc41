// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/scene/bodies.h>
#include <hpvi/scene/pretension.h>
#include <hpvi/scene/scene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
using EdgeOfCells = std::array<unsigned int, 2>; ///< its vertices, ascending

/** The mean of its corners, as deal.II has the centre of a straight cell. */
template <int dim>
Point<dim> centre_of_cell(const Corners<dim> &corners)
{
  Point<dim> result;
  for (const Point<dim> &corner : corners)
    result += corner / double(corners.size());
  return result;
}

/** The coarse cells along a cut. */
class CutSearch
{
public:
  CutSearch(const Geometry<2> &geometry, const Pretension<2> &cut);

  /** Sets ends, normal, depth and layer of @p cut; returns what is wrong with it, or nothing. */
  std::string find(Pretension<2> &cut);

  std::vector<unsigned int> numbers; ///< of the cells of the layer

private:
  EdgeOfCells edge(unsigned int cell, unsigned int e) const;
  double lowest(unsigned int cell) const;
  double highest(unsigned int cell) const;
  bool is_on_cut(unsigned int vertex) const;
  std::string crossed_cell() const;
  std::string find_edges();
  std::string find_ends(Pretension<2> &cut) const;
  std::vector<unsigned int> cells_below(double depth) const;
  std::string find_layer(Pretension<2> &cut);

  const CoarseMesh mesh;
  const Geometry<2> &geometry;
  const double length, tolerance;
  std::vector<double> height, along; ///< of vertices, across and along the cut
  std::map<EdgeOfCells, std::vector<unsigned int>> cells_at;
  std::vector<EdgeOfCells> cut_edges; ///< between two cells
};

CutSearch::CutSearch(const Geometry<2> &geometry, const Pretension<2> &cut)
    : mesh(cells_of(geometry)), geometry(geometry), length(cut.from.distance(cut.to)),
      tolerance(same_place * geometry.diameter())
{
  const Tensor<1, 2> way = (cut.to - cut.from) / length, normal({-way[1], way[0]});
  for (const Point<2> &x : mesh.vertices)
  {
    height.push_back((x - cut.from) * normal);
    along.push_back((x - cut.from) * way);
  }
  for (unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
    for (unsigned int e = 0; e < 4; ++e)
      cells_at[edge(cell, e)].push_back(cell);
}

EdgeOfCells CutSearch::edge(const unsigned int cell, const unsigned int e) const
{
  const auto &vertices = mesh.cells[cell].vertices;
  return {
      {std::min(vertices[e], vertices[(e + 1) % 4]), std::max(vertices[e], vertices[(e + 1) % 4])}};
}

double CutSearch::lowest(const unsigned int cell) const
{
  double result = std::numeric_limits<double>::max();
  for (const unsigned int v : mesh.cells[cell].vertices)
    result = std::min(result, height[v]);
  return result;
}

double CutSearch::highest(const unsigned int cell) const
{
  double result = -std::numeric_limits<double>::max();
  for (const unsigned int v : mesh.cells[cell].vertices)
    result = std::max(result, height[v]);
  return result;
}

bool CutSearch::is_on_cut(const unsigned int vertex) const
{
  return std::abs(height[vertex]) <= tolerance && along[vertex] >= -tolerance &&
         along[vertex] <= length + tolerance;
}

/** What the cut goes through the inside of. */
std::string CutSearch::crossed_cell() const
{
  for (unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
  {
    if (lowest(cell) >= -tolerance || highest(cell) <= tolerance)
      continue;
    double begin = std::numeric_limits<double>::max(), end = -begin;
    for (unsigned int e = 0; e < 4; ++e)
    {
      const auto [a, b] = edge(cell, e);
      if ((height[a] > 0) == (height[b] > 0))
        continue;
      const double s = along[a] + (along[b] - along[a]) * height[a] / (height[a] - height[b]);
      begin = std::min(begin, s);
      end = std::max(end, s);
    }
    if (std::min(end, length) - std::max(begin, 0.) > tolerance)
      return "runs through the inside of a cell of the coarse mesh, with the centre " +
             to_string(centre_of_cell<2>({{mesh.vertices[mesh.cells[cell].vertices[0]],
                                           mesh.vertices[mesh.cells[cell].vertices[1]],
                                           mesh.vertices[mesh.cells[cell].vertices[2]],
                                           mesh.vertices[mesh.cells[cell].vertices[3]]}})) +
             "; draw it along edges of cells, in a box parallel to a side";
  }
  return {};
}

std::string CutSearch::find_edges()
{
  bool is_boundary = false;
  std::set<unsigned int> bodies;
  for (const auto &[edge, cells] : cells_at)
    if (is_on_cut(edge[0]) && is_on_cut(edge[1]))
    {
      is_boundary = is_boundary || cells.size() == 1;
      if (cells.size() < 2)
        continue;
      cut_edges.push_back(edge);
      bodies.insert(mesh.cells[cells[0]].body);
    }
  if (cut_edges.empty())
    return is_boundary ? "runs along the boundary of a body; draw it through the bolt"
                       : "crosses no body; give two points with a body between them";
  if (bodies.size() > 1)
  {
    std::vector<std::string> names;
    for (const unsigned int body : bodies)
      names.push_back(geometry.bodies[body].name);
    return "crosses " + listed(names, "and") + "; end it between them, a section for each";
  }
  return {};
}

std::string CutSearch::find_ends(Pretension<2> &cut) const
{
  std::map<unsigned int, unsigned int> n_edges;
  for (const EdgeOfCells &edge : cut_edges)
    for (const unsigned int v : edge)
      ++n_edges[v];
  std::vector<unsigned int> ends;
  for (const auto &[v, n] : n_edges)
    if (n == 1)
      ends.push_back(v);
  if (ends.size() != 2)
    return "crosses the body in several places; end it between them, a section for each";
  std::set<unsigned int> on_boundary;
  for (const auto &[edge, cells] : cells_at)
    if (cells.size() == 1)
      on_boundary.insert(edge.begin(), edge.end());
  for (const unsigned int v : ends)
    if (on_boundary.count(v) == 0)
      return "ends inside of the body, at " + to_string(mesh.vertices[v]) +
             "; draw it from boundary to boundary";
  if (along[ends[0]] > along[ends[1]])
    std::swap(ends[0], ends[1]);
  cut.from = mesh.vertices[ends[0]];
  cut.to = mesh.vertices[ends[1]];
  return {};
}

/** All that can be reached from the cut, on its positive side, without going deeper than @p depth. */
std::vector<unsigned int> CutSearch::cells_below(const double depth) const
{
  std::vector<unsigned int> result;
  std::vector<bool> is_known(mesh.cells.size());
  const auto add = [&](const unsigned int cell)
  {
    if (!is_known[cell])
      result.push_back(cell);
    is_known[cell] = true;
  };
  for (const EdgeOfCells &edge : cut_edges)
    for (const unsigned int cell : cells_at.at(edge))
      if (highest(cell) > tolerance)
        add(cell);
  for (unsigned int k = 0; k < result.size(); ++k)
    for (unsigned int e = 0; e < 4; ++e)
    {
      const EdgeOfCells between = edge(result[k], e);
      if (std::find(cut_edges.begin(), cut_edges.end(), between) == cut_edges.end())
        for (const unsigned int cell : cells_at.at(between))
          if (lowest(cell) < depth - tolerance)
            add(cell);
    }
  return result;
}

/** As few cells as end on one line parallel to the cut. */
std::string CutSearch::find_layer(Pretension<2> &cut)
{
  for (double next = 2 * tolerance; next > cut.depth + tolerance;)
  {
    cut.depth = next;
    numbers = cells_below(cut.depth);
    for (const unsigned int cell : numbers)
    {
      if (lowest(cell) < -tolerance)
        return "has no layer of cells beside it, on its left on the way from the first point to "
               "the second; draw a line parallel to it where cells end, or swap the points";
      next = std::max(next, highest(cell));
    }
  }
  const EdgeCurves curves(mesh);
  for (const unsigned int cell : numbers)
  {
    Corners<2> corners;
    for (unsigned int v = 0; v < 4; ++v)
    {
      corners[v] = mesh.vertices[mesh.cells[cell].vertices[v]];
      if (curves(mesh.cells[cell].vertices[v], mesh.cells[cell].vertices[(v + 1) % 4]))
        return "has a cell with a curved edge beside it, at " + to_string(corners[v]) +
               "; move it, draw a line parallel to it where cells end, or swap its points to take "
               "the cells on the other side";
    }
    cut.layer.push_back({corners, 0});
  }
  return {};
}

std::string CutSearch::find(Pretension<2> &cut)
{
  if (const std::string flaw = crossed_cell(); !flaw.empty())
    return flaw;
  if (const std::string flaw = find_edges(); !flaw.empty())
    return flaw;
  if (const std::string flaw = find_ends(cut); !flaw.empty())
    return flaw;
  const Tensor<1, 2> way = (cut.to - cut.from) / cut.from.distance(cut.to);
  cut.normal = Tensor<1, 2>({-way[1], way[0]});
  return find_layer(cut);
}
} // namespace

template <int dim>
const typename Pretension<dim>::Cell *Pretension<dim>::cell(const Point<dim> &centre) const
{
  for (const Cell &one : layer)
    if (centre_of_cell<dim>(one.corners).distance(centre) <= same_on_edge * depth)
      return &one;
  return nullptr;
}

PlaneStrain unit_shortening(const Pretension<2> &cut)
{
  const Tensor<1, 2> &n = cut.normal;
  return {{n[0] * n[0] / cut.depth, n[1] * n[1] / cut.depth, n[0] * n[1] / cut.depth, 0.}};
}

std::string add_pretension(Scene<2> &scene, Pretension<2> cut)
{
  if (!(cut.from.distance(cut.to) > same_place * scene.geometry.diameter()))
    return "has no length; give two points with a body between them";
  CutSearch search(scene.geometry, cut);
  if (const std::string flaw = search.find(cut); !flaw.empty())
    return flaw;
  if (scene.is_axisymmetric() && std::abs(cut.normal[0]) > same_normal)
    return "is not across the axis, and the bolt is of revolution; give both points the same y";
  for (unsigned int k = 0; k < cut.layer.size(); ++k)
  {
    const Point<2> centre = centre_of_cell<2>(cut.layer[k].corners);
    for (const Pretension<2> &other : scene.pretensions)
      if (other.cell(centre))
        return "has the cells beside it from Pretension " + other.name +
               ", on the left of each on the way from the first point to the second; move one of "
               "them, or swap its points";
    const types::material_id beside = scene.material_of_coarse_cell(centre, search.numbers[k]);
    if (cut.materials.emplace(beside, scene.materials.size()).second)
    {
      scene.materials.push_back(Material(scene.materials[beside]));
      if (!scene.body_force_of_material.empty())
        scene.body_force_of_material.push_back(Load<2>(scene.body_force_of_material[beside]));
      if (!scene.initial_strains.empty())
        scene.initial_strains.push_back(InitialStrain<2>(scene.initial_strains[beside]));
    }
    cut.layer[k].material = cut.materials.at(beside);
  }
  scene.pretensions.push_back(std::move(cut));
  return {};
}

void set_shortening(Scene<2> &scene, const unsigned int k, const double shortening)
{
  Pretension<2> &cut = scene.pretensions[k];
  cut.shortening = shortening;
  scene.initial_strains.resize(scene.materials.size());
  PlaneStrain strain = unit_shortening(cut);
  for (double &component : strain)
    component *= -shortening;
  for (const auto &[beside, own] : cut.materials)
    scene.initial_strains[own].shortening = strain;
}

Scene<2> without_shortenings(const Scene<2> &scene)
{
  Scene<2> result = scene;
  for (InitialStrain<2> &strain : result.initial_strains)
    strain.shortening.reset();
  return result;
}

double section_of_cut(const Scene<2> &scene, const Pretension<2> &cut)
{
  return cut.from.distance(cut.to) * scene.circumference(cut.from + (cut.to - cut.from) / 2.);
}

double layer_stiffness(const Scene<2> &scene, const Pretension<2> &cut)
{
  const PlaneStrain unit = unit_shortening(cut);
  double stiffness = 0;
  for (const auto &[corners, own] : cut.layer)
  {
    const double density = HookesLaw<2>(scene.materials[own])
                               .energy_product(Tensor<2, 2>(scene.materials[own].in_plane(unit)));
    for (unsigned int v = 2; v < 4; ++v) // two triangles
    {
      const Tensor<1, 2> a = corners[v - 1] - corners[0], b = corners[v] - corners[0];
      const Point<2> centre = corners[0] + (a + b) / 3.;
      stiffness += density * (a[0] * b[1] - a[1] * b[0]) / 2 * scene.circumference(centre);
    }
  }
  return stiffness;
}

template <int dim>
types::material_id material_beside(const Scene<dim> &scene, const types::material_id material)
{
  for (const Pretension<dim> &cut : scene.pretensions)
    for (const auto &[beside, own] : cut.materials)
      if (own == material)
        return beside;
  return material;
}

template struct Pretension<2>;
template struct Pretension<3>;
template types::material_id material_beside(const Scene<2> &, types::material_id);
template types::material_id material_beside(const Scene<3> &, types::material_id);
} // namespace hpvi
