// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/thread_pool.h>
#include <hpvi/bound/energy_rule.h>
#include <hpvi/bound/stress_work.h>
#include <hpvi/bound/test_motion.h>
#include <hpvi/plane/elastic_system.h>
#include <hpvi/plane/element_matrices.h>
#include <hpvi/plane/internal_forces.h>
#include <hpvi/plane/load_quadrature.h>
#include <hpvi/plane/springs.h>
#include <hpvi/results/common_refinement.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace hpvi
{
using namespace dealii;
using Cell = Triangulation<2>::cell_iterator;

namespace
{
WorkOnShapes stress_on_part(const Solution<2> &solution, const WorkOnPart &part,
                            const unsigned int degree, PartTables &tables)
{
  const Scene<2> &scene = solution.scene;
  const unsigned int cell = part.a->active_cell_index(),
                     p = solution.displacement_space.degrees()[cell];
  const CellMap<2> map = map_of<2>(part.a), other = map_of<2>(part.b);
  constexpr double enough = 1e-10; // of a number that may be known as well
  unsigned int n_gauss = (p + degree) / 2 + 1;
  if (!map.is_affine() || scene.is_axisymmetric())
    n_gauss = std::max(n_gauss, stiffness_points(scene, map, (p + degree) / 2));
  const EnergyRule rule(map, degrees_of_square(map, std::max(p, degree), scene.is_axisymmetric()),
                        n_gauss, enough);
  n_gauss = rule.n_gauss;
  const ShapeTable<2> &of_u = tables.in(part.in_a, p, n_gauss, solution.tables),
                      &of_w = tables.in(part.in_b, degree, n_gauss, solution.tables);
  const std::vector<double> derivatives = evaluate(of_u.derivatives, solution.coefficients(cell)),
                            values = scene.is_axisymmetric()
                                         ? evaluate(of_u.values, solution.coefficients(cell))
                                         : std::vector<double>();
  const HookesLaw<2> law(scene.material_of(part.a));
  WorkOnShapes work{std::vector<double>(2 * of_w.n_shapes), std::vector<double>(2 * of_w.n_shapes),
                    rule.missed()};
  for (unsigned int q = 0; q < of_u.points.size(); ++q)
  {
    const Tensor<2, 2> J = map.jacobian(of_u.points[q]);
    const Tensor<2, 2> gradient =
        physical_gradient<2>(derivatives, q * of_u.rows_per_point, of_u.derivatives.m(), invert(J));
    const Point<2> x = map.point(of_u.points[q]);
    const double weight = of_u.weights[q] * part.in_a.volume() * std::abs(determinant(J)) *
                          scene.circumference(x),
                 hoop = scene.is_axisymmetric() ? values[q] / x[0] : 0.;
    const Tensor<2, 2> pulled = weight * Tensor<2, 2>(law.stress(gradient, hoop)) *
                                transpose(invert(other.jacobian(of_w.points[q])));
    const auto add = [&](const unsigned int place, const double value)
    {
      work.sum[place] += value;
      work.absolute[place] += std::abs(value);
    };
    for (unsigned int i = 0; i < of_w.n_shapes; ++i)
    {
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int r = 0; r < 2; ++r)
          add(c * of_w.n_shapes + i,
              pulled[c][r] * of_w.derivatives(q * of_w.rows_per_point + r, i));
      if (scene.is_axisymmetric())
        add(i, weight * law.hoop_stress(gradient, hoop) / x[0] * of_w.values(q, i));
    }
  }
  return work;
}
} // namespace

std::vector<WorkOnPart> stress_on_parts(const Solution<2> &solution, const Triangulation<2> &mesh,
                                        const Degrees &degrees, PartTables &tables)
{
  tables.limit();
  std::vector<WorkOnPart> parts;
  for_each_common_part(
      solution.displacement_space.triangulation(), mesh,
      [&](const Cell &a, const BoundingBox<2> &in_a, const Cell &b, const BoundingBox<2> &in_b) {
        parts.push_back({a, in_a, b, in_b, {}});
      });
  parallel_for_each(parts.size(), 8,
                    [&](const unsigned int k)
                    {
                      parts[k].work = stress_on_part(
                          solution, parts[k], degrees[parts[k].b->active_cell_index()], tables);
                    });
  return parts;
}

namespace
{
constexpr unsigned int n_points_of_loads = 24; ///< on each piece of an edge
} // namespace

void TractionWork::add(const EdgeTraction &edge, const Solution<2> &solution,
                       std::vector<double> cuts, const unsigned int n_points,
                       const std::function<Tensor<1, 2>(double, const Point<2> &)> &w)
{
  const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
  if (condition.has_traction())
    for (const double s : solution.spaces->loads->traction(edge.cell, edge.face, 1).cuts)
      if (s > cuts.front() && s < cuts.back())
        cuts.push_back(s);
  std::sort(cuts.begin(), cuts.end());
  const QGauss<1> &gauss =
      solution.tables.gauss(condition.has_traction() ? n_points_of_loads : n_points);
  const double length = edge.begin.distance(edge.end);
  for (unsigned int piece = 0; piece + 1 < cuts.size(); ++piece)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double part = cuts[piece + 1] - cuts[piece], s = cuts[piece] + part * gauss.point(q)[0];
      const Point<2> x = edge.point(s);
      Tensor<1, 2> T = edge.value(s);
      if (condition.has_traction())
        T -= solution.scene.circumference(x) * load_at<2>(condition.traction, x);
      const Tensor<1, 2> at_x = w(s, x);
      sum += gauss.weight(q) * part * length * (T * at_x);
      absolute += gauss.weight(q) * part * length * T.norm() * at_x.norm();
    }
}

namespace
{
/** The part of an edge of a that @p in_a and @p in_b are, and z on it. */
class EdgePart
{
public:
  EdgePart(const EdgeTraction &edge, const Scene<2> &scene, const Cell &a,
           const BoundingBox<2> &in_a, const Cell &b, const BoundingBox<2> &in_b)
      : edge(edge), in_b(in_b), cell(b->active_cell_index())
  {
    const CellMap<2> map = map_of<2>(a);
    for (unsigned int end = 0; end < 2; ++end)
    {
      const Point<2> x =
          map.point(in_a.unit_to_real(point_on_face<2>(edge.face, Point<1>(double(end)))));
      const Tensor<1, 2> along = edge.end - edge.begin;
      ends[end] = ((x - edge.begin) * along) / along.norm_square();
    }
    const Tensor<1, 2> t = (edge.end - edge.begin) / edge.begin.distance(edge.end);
    for (const TractionAlong &traction :
         tractions_of(scene.boundaries[edge.boundary], Point<2>(t[1], -t[0])))
      if (traction.kind != TractionKind::given)
        directions.push_back(traction.direction);
  }

  void add_to(TractionWork &work, const Solution<2> &solution, const Solution<2> &z) const
  {
    const double begin = std::max(0., std::min(ends[0], ends[1])),
                 end = std::min(1., std::max(ends[0], ends[1]));
    if (directions.empty() || begin >= end)
      return;
    const unsigned int p = z.displacement_space.degrees()[cell];
    const std::vector<double> coefficients = z.coefficients(cell);
    const auto at = [&](const double s, const Point<2> &)
    {
      const double local = (s - ends[0]) / (ends[1] - ends[0]);
      const ShapeTable<2> table = tabulate<2>(
          p, {in_b.unit_to_real(point_on_face<2>(edge.face, Point<1>(local)))}, {1.}, false);
      const std::vector<double> value = evaluate(table.values, coefficients);
      Tensor<1, 2> result;
      for (const Tensor<1, 2> &direction : directions)
        result += (direction[0] * value[0] + direction[1] * value[1]) * direction;
      return result;
    };
    work.add(edge, solution, {begin, end}, (edge.n_coefficients() + p) / 2 + 1, at);
  }

private:
  const EdgeTraction &edge;
  const BoundingBox<2> in_b;
  const unsigned int cell;
  std::array<double, 2> ends;           ///< of the part, on the edge
  std::vector<Tensor<1, 2>> directions; ///< in which the traction is not given
};

/** Is the face @p face of the unit cell partly one of @p box? */
bool touches(const BoundingBox<2> &box, const unsigned int face)
{
  const auto &ends = box.get_boundary_points();
  return face % 2 == 0 ? ends.first[face / 2] == 0. : ends.second[face / 2] == 1.;
}
} // namespace

StressWork work_of_difference(const Solution<2> &solution, const ErrorBound &bound,
                              const Solution<2> &z, PartTables &tables)
{
  std::map<std::pair<unsigned int, unsigned int>, std::vector<const EdgeTraction *>> edges;
  for (const EdgeTraction &edge : bound.tractions)
    edges[{edge.cell->active_cell_index(), edge.face}].push_back(&edge);
  TractionWork tractions;
  double energy = 0, absolute = 0, rule = 0;
  for (const auto &[a, in_a, b, in_b, work] : stress_on_parts(
           solution, z.displacement_space.triangulation(), z.displacement_space.degrees(), tables))
  {
    const std::vector<double> coefficients = z.coefficients(b->active_cell_index());
    rule = std::max(rule, work.rule);
    for (unsigned int i = 0; i < coefficients.size(); ++i)
    {
      energy += work.sum[i] * coefficients[i];
      absolute += work.absolute[i] * std::abs(coefficients[i]);
    }
    for (const unsigned int face : a->face_indices())
      if (a->at_boundary(face) && touches(in_a, face))
        for (const EdgeTraction *const edge : edges.at({a->active_cell_index(), face}))
          EdgePart(*edge, solution.scene, a, in_a, b, in_b).add_to(tractions, solution, z);
  }
  const Vector<double> loads =
      body_loads(solution.scene, z.displacement_space, solution.tables, *solution.spaces->loads);
  double work = 0;
  for (types::global_dof_index i = 0; i < loads.size(); ++i)
  {
    work += loads[i] * z.u[i];
    absolute += std::abs(loads[i] * z.u[i]);
  }
  const auto norm = [](const Solution<2> &of)
  {
    return std::sqrt(
        internal_forces(of.scene, of.displacement_space, of.tables, of.u).energy_product);
  };
  const double missed = rule > 0 ? rule * norm(solution) * norm(z) : 0.;
  return {work + tractions.sum - energy,
          missed + 1e-14 * absolute + tractions.defect(bound.imbalance)};
}

EnergyRule displacement_rule(const Triangulation<2>::cell_iterator &cell, const Scene<2> &scene,
                             const unsigned int p, const double enough)
{
  constexpr unsigned int least = 8;
  const CellMap<2> map = map_of<2>(cell);
  return EnergyRule(map, degrees_of_square(map, p, scene.is_axisymmetric()), least, enough);
}

EnergyRange energy_range(const DoFHandler<2>::active_cell_iterator &cell, const Scene<2> &scene,
                         const DisplacementSpace<2> &space, const ShapeTables<2> &tables,
                         const Vector<double> &v, const EnergyRule &rule)
{
  const CellMap<2> map = map_of<2>(cell);
  const unsigned int p = space.degrees()[cell->active_cell_index()];
  const LocalNumbering &numbering = tables.numbering(p);
  const ShapeTable<2> &table = tables.gradients(p, rule.n_gauss);
  const auto dofs = space.cell_dofs(cell->active_cell_index());
  std::vector<double> local(dofs.size());
  for (unsigned int i = 0; i < dofs.size(); ++i)
    local[numbering.component[i] * table.n_shapes + numbering.shape[i]] = v[dofs[i]];
  const std::vector<double> derivatives = evaluate(table.derivatives, local),
                            values = scene.is_axisymmetric() ? evaluate(table.values, local)
                                                             : std::vector<double>();
  const HookesLaw<2> law(scene.material_of(cell));
  double result = 0;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Tensor<2, 2> J = map.jacobian(table.points[q]);
    const SymmetricTensor<2, 2> strain = symmetrize(physical_gradient<2>(
        derivatives, q * table.rows_per_point, table.derivatives.m(), invert(J)));
    const Point<2> x = map.point(table.points[q]);
    result +=
        table.weights[q] * std::abs(determinant(J)) * scene.circumference(x) *
        law.energy_product(Tensor<2, 2>(strain), scene.is_axisymmetric() ? values[q] / x[0] : 0.);
  }
  return {result / rule.factor, result > 0. ? result * rule.factor : 0.};
}

double missed_energy(const Solution<2> &solution, const Vector<double> &v)
{
  constexpr double enough = 1e-13;
  const Scene<2> &scene = solution.scene;
  const DisplacementSpace<2> &space = solution.displacement_space;
  EnergyRange sum;
  bool is_exact = !scene.is_axisymmetric();
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    is_exact = is_exact && map_of<2>(cell).is_affine();
  if (is_exact)
    return 0.;
  std::vector<EnergyRange> ranges(space.degrees().size());
  std::vector<DoFHandler<2>::active_cell_iterator> cells;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    cells.push_back(cell);
  parallel_for_each(cells.size(), 8,
                    [&](const unsigned int k)
                    {
                      ranges[k] = energy_range(
                          cells[k], scene, space, solution.tables, v,
                          displacement_rule(cells[k], scene, space.degrees()[k], enough));
                    });
  for (const EnergyRange &range : ranges)
  {
    sum.low += range.low;
    sum.high += range.high;
  }
  Vector<double> forces(v.size());
  const double known = internal_forces(scene, space, solution.tables, v).energy_product -
                       add_spring_forces(spring_faces(scene, space, solution.tables), v, forces);
  return std::max(sum.high - known, known - sum.low);
}

std::vector<double> largest_energies(const Scene<2> &scene, const DisplacementSpace<2> &space,
                                     const ShapeTables<2> &tables, const Vector<double> &v,
                                     std::vector<EnergyRule> &rules)
{
  std::vector<double> result;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
  {
    const unsigned int k = cell->active_cell_index();
    if (rules.size() == k)
      rules.push_back(displacement_rule(cell, scene, space.degrees()[k]));
    result.push_back(energy_range(cell, scene, space, tables, v, rules[k]).high);
  }
  return result;
}
} // namespace hpvi
