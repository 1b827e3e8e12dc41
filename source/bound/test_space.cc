// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/stress_work.h>
#include <hpvi/bound/test_space.h>
#include <hpvi/plane/elastic_system.h>
#include <hpvi/plane/element_matrices.h>
#include <hpvi/plane/initial_stress.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Least energies hang on corners of the body, where cells count and degrees do not. */
constexpr unsigned int least_degree = 2, few_cells = 15;

/** The coarse mesh, bisected until it has some cells, and further at @p points; that of u_N where edges are curved. */
std::shared_ptr<const Triangulation<2>> mesh_of_w(const Solution<2> &solution,
                                                  const std::vector<GradedPoint> &points)
{
  const Scene<2> &scene = solution.scene;
  if (scene.geometry.has_curves())
    return {solution.spaces, &solution.displacement_space.triangulation()};
  const auto mesh = std::make_shared<Triangulation<2>>();
  make_mesh(scene, *mesh);
  while (mesh->n_active_cells() < few_cells)
    mesh->refine_global(1);
  const double near = 1e-12 * scene.geometry.diameter();
  bool is_done = false;
  for (unsigned int level = 0; !is_done; ++level)
  {
    is_done = true;
    for (const GradedPoint &point : points)
      if (level < point.levels)
        for (const auto &cell : mesh->active_cell_iterators())
          for (const unsigned int v : cell->vertex_indices())
            if (cell->vertex(v).distance(point.x) < near)
            {
              cell->set_refine_flag();
              is_done = false;
            }
    mesh->execute_coarsening_and_refinement();
  }
  return mesh;
}

/** On a curved cell a rotation has the degree of the map. */
Degrees degrees_of_w(const Triangulation<2> &mesh)
{
  Degrees result;
  for (const auto &cell : mesh.active_cell_iterators())
    result.push_back(std::max(least_degree, map_degree(map_of<2>(cell))));
  return result;
}

/** A body that nothing holds. */
Scene<2> free_body(const Scene<2> &scene)
{
  Scene<2> result = scene;
  for (BoundaryCondition<2> &boundary : result.boundaries)
  {
    boundary.displacement = {};
    boundary.symmetry = false;
    boundary.contact = Contact::none;
    boundary.plate.reset();
  }
  return result;
}
} // namespace

TestSpace::TestSpace(const Solution<2> &solution, const std::vector<GradedPoint> &points,
                     std::shared_ptr<PartTables> tables)
    : scene(solution.scene), lender(solution.spaces), mesh(mesh_of_w(solution, points)),
      degrees(degrees_of_w(*mesh)),
      space(free_body(scene), *mesh, degrees, *lender->tables, lender->loads.get()),
      applied(body_loads(scene, space, *lender->tables, *lender->loads)),
      missed_strain(initial_stress_error(scene, space, *lender->loads, *lender->tables)),
      tables_in_parts(std::move(tables))
{
  find_nodes();
  assemble();
}

void TestSpace::find_nodes()
{
  std::map<types::global_dof_index, Node> found;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
    {
      if (!cell->at_boundary(f))
        continue;
      const CellMap<2> map = map_of<2>(cell);
      const unsigned int p = degrees[cell->active_cell_index()];
      const auto dofs = space.cell_dofs(cell->active_cell_index());
      const auto &on_edge = lender->tables->numbering(p).edge[f];
      edges.push_back(
          {cell->face(f)->boundary_id(), {{cell->face(f)->vertex(0), cell->face(f)->vertex(1)}}});
      for (unsigned int k = 0; k <= p; ++k)
      {
        Node &node = found[dofs[on_edge[k]]];
        node.dofs = {{dofs[on_edge[k]], dofs[on_edge[p + 1 + k]]}};
        node.x = map.point(point_on_face<2>(f, lender->tables->gauss_lobatto(p + 1).point(k)));
        node.boundaries.push_back(cell->face(f)->boundary_id());
      }
    }
  for (const auto &node : found)
    nodes.push_back(node.second);
}

// @sect3{Energy}
//
// The matrix of all unknowns gives energies and, without those that are held, the system.
void TestSpace::assemble()
{
  const auto each_cell = [&](const auto &act)
  {
    for (const auto &cell : space.dof_handler().active_cell_iterators())
    {
      const auto dofs = space.cell_dofs(cell->active_cell_index());
      act(cell, std::vector<types::global_dof_index>(dofs.begin(), dofs.end()));
    }
  };
  DynamicSparsityPattern entries(space.n_dofs());
  each_cell([&](const auto &, const auto &dofs)
            { space.constraints().add_entries_local_to_global(dofs, entries, true); });
  each_cell(
      [&](const auto &, const auto &dofs)
      {
        for (const auto dof : dofs)
          entries.add_entries(dof, dofs.begin(), dofs.end());
      });
  pattern.copy_from(entries);
  K.reinit(pattern);
  const ElementMatrices<2> matrices(scene, *lender->tables);
  std::map<ElementMatrices<2>::Class, std::shared_ptr<const FullMatrix<double>>> known;
  each_cell(
      [&](const auto &cell, const auto &dofs)
      {
        const CellMap<2> map = map_of<2>(cell);
        is_exact = is_exact && map.is_affine() && !scene.is_axisymmetric();
        const unsigned int p = degrees[cell->active_cell_index()];
        std::shared_ptr<const FullMatrix<double>> own;
        auto &matrix =
            map.is_affine() ? known[matrices.congruence_class(map, p, cell->material_id())] : own;
        if (!matrix)
          matrix = std::make_shared<const FullMatrix<double>>(
              matrices.stiffness(map, p, cell->material_id()));
        stiffness.push_back(matrix);
        K.add(dofs, *matrix);
      });
}

// In w'Kw a rigid motion leaves eps |K| |w|^2, of either sign, where strains leave its square. It matters where statics alone says a
// force: w differs from a rigid motion by what the solution of its system leaves then, and a(u - u_N, w) is all that F_w is off by.
double TestSpace::norm(const Vector<double> &w) const
{
  constexpr double nearly_rigid = 1e-6; // round-off of w'Kw is far below this
  Vector<double> Kw(w.size());          // matrix_scalar_product() sums as threads come
  K.vmult(Kw, w);
  double square = 0, scale = 0;
  for (types::global_dof_index i = 0; i < w.size(); ++i)
  {
    square += w[i] * Kw[i];
    scale += w[i] * K.diag_element(i) * w[i];
  }
  // where the rule of K is not exact, K is no more than near
  return std::sqrt(!is_exact || square < nearly_rigid * scale ? square_by_strains(w) : square);
}

double TestSpace::square_by_strains(const Vector<double> &w) const
{
  const std::vector<double> energies = largest_energies(scene, space, *lender->tables, w, rules);
  return std::accumulate(energies.begin(), energies.end(), 0.);
}

// @sect3{What is held}
//
// A body of which no traction asks for a motion may be moved by it without energy; it is held at some node then.
namespace
{
/** Is a rigid motion left that none of some conditions sees? Conditions are asked one by one. */
class SeenMotions
{
public:
  SeenMotions(const Scene<2> &scene)
      : centre(scene.geometry.centre()), size(scene.geometry.diameter()),
        is_axisymmetric(scene.is_axisymmetric())
  {
  }

  /** Does @p direction at @p x see a motion that those before have not? */
  bool sees_more(const Point<2> &x, const Tensor<1, 2> &direction)
  {
    const Tensor<1, 2> arm = (x - centre) / size;
    Tensor<1, 3> row;
    row[1] = direction[1];
    if (!is_axisymmetric) // strains around an axis resist all but the way along it
    {
      row[0] = direction[0];
      row[2] = arm[0] * direction[1] - arm[1] * direction[0];
    }
    for (const Tensor<1, 3> &q : basis)
      row -= (row * q) * q;
    if (basis.size() == 3 || row.norm() < 1e-6)
      return false;
    basis.push_back(row / row.norm());
    return true;
  }

private:
  const Point<2> centre;
  const double size;
  const bool is_axisymmetric;
  std::vector<Tensor<1, 3>> basis;
};
} // namespace

std::vector<SupportedNode<2>> TestSpace::held_nodes(const TestMotion &motion) const
{
  const std::vector<double> l = lengths(motion);
  std::vector<SupportedNode<2>> result;
  SeenMotions seen(scene);
  std::vector<const Node *> own;
  for (const Node &node : nodes)
  {
    SupportedNode<2> held;
    held.dofs = node.dofs;
    held.x = node.x;
    for (const unsigned int boundary : node.boundaries)
      for (const PointCondition<2> &condition : motion.conditions(boundary, node.x, l))
      {
        held.conditions.push_back(condition);
        seen.sees_more(node.x, condition.direction);
      }
    if (!held.conditions.empty())
      result.push_back(held);
    if (scene.geometry.body_of_side(scene.boundaries[node.boundaries.front()].side) ==
        motion.body_number())
      own.push_back(&node);
  }
  for (const Node *const node : own)
    for (unsigned int c = 0; c < 2; ++c)
      if (Tensor<1, 2> axis; axis[c] = 1, seen.sees_more(node->x, axis))
      {
        SupportedNode<2> held;
        held.dofs = node->dofs;
        held.x = node->x;
        held.conditions.push_back({axis, 0., node->boundaries.front()});
        result.push_back(held);
      }
  return result;
}

AffineConstraints<double> TestSpace::constraints(const TestMotion &motion) const
{
  AffineConstraints<double> result;
  result.merge(space.constraints());
  if (!scene.geometry.bodies.empty())
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (body_of<2>(scene.geometry, cell) != motion.body_number())
        for (const auto dof : space.cell_dofs(cell->active_cell_index()))
          if (!result.is_constrained(dof))
            result.add_line(dof);
  constrain_supports(held_nodes(motion), result);
  result.close();
  return result;
}

const TestSpace::System &TestSpace::system(const TestMotion &motion)
{
  std::unique_ptr<System> &result = systems[motion.body_number()];
  if (result)
    return *result;
  result = std::make_unique<System>();
  AffineConstraints<double> &held = result->homogeneous;
  held.copy_from(constraints(motion));
  for (types::global_dof_index dof = 0; dof < space.n_dofs(); ++dof)
    if (held.is_constrained(dof))
      held.set_inhomogeneity(dof, 0.);
  DynamicSparsityPattern entries(pattern.n_rows());
  for (const auto &cell : space.dof_handler().active_cell_iterators())
  {
    const auto dofs = space.cell_dofs(cell->active_cell_index());
    held.add_entries_local_to_global(std::vector<types::global_dof_index>(dofs.begin(), dofs.end()),
                                     entries, true);
  }
  SparsityPattern places;
  places.copy_from(entries);
  SparseMatrix<double> A(places);
  for (const auto &cell : space.dof_handler().active_cell_iterators())
  {
    const auto dofs = space.cell_dofs(cell->active_cell_index());
    held.distribute_local_to_global(*stiffness[cell->active_cell_index()],
                                    std::vector<types::global_dof_index>(dofs.begin(), dofs.end()),
                                    A);
  }
  factorise(A, *result);
  return *result;
}

/** The rows that are not held. */
void TestSpace::factorise(const SparseMatrix<double> &A, System &of)
{
  of.place.assign(A.m(), numbers::invalid_unsigned_int);
  unsigned int n = 0;
  for (types::global_dof_index dof = 0; dof < A.m(); ++dof)
    if (!of.homogeneous.is_constrained(dof))
      of.place[dof] = n++;
  SymmetricMatrix rows;
  for (types::global_dof_index dof = 0; dof < A.m(); ++dof)
  {
    if (of.homogeneous.is_constrained(dof))
      continue;
    for (auto entry = A.begin(dof); entry != A.end(dof); ++entry)
      if (const unsigned int row = of.place[entry->column()]; row <= of.place[dof])
      {
        rows.row.push_back(row);
        rows.value.push_back(entry->value());
      }
    rows.column_start.push_back(rows.row.size());
  }
  of.factor = std::make_unique<const LinearSolver>(rows, std::vector<unsigned int>());
}

// w = h + x, h of the values that are held and x of the others, which leave no force on them.
Vector<double> TestSpace::solve(const TestMotion &motion)
{
  const System &with = system(motion);
  Vector<double> w(space.n_dofs()), forces(w), x(w);
  constraints(motion).distribute(w);
  K.vmult(forces, w);
  with.homogeneous.condense(forces);
  Vector<double> free(std::count_if(with.place.begin(), with.place.end(),
                                    [](const unsigned int row)
                                    { return row != numbers::invalid_unsigned_int; }));
  for (types::global_dof_index dof = 0; dof < w.size(); ++dof)
    if (with.place[dof] != numbers::invalid_unsigned_int)
      free[with.place[dof]] = -forces[dof];
  free = with.factor->solve(free);
  for (types::global_dof_index dof = 0; dof < w.size(); ++dof)
    if (with.place[dof] != numbers::invalid_unsigned_int)
      x[dof] = free[with.place[dof]];
  with.homogeneous.distribute(x);
  w += x;
  return w;
}

std::vector<double> TestSpace::lengths(const TestMotion &motion) const
{
  std::vector<double> result;
  for (const TestMotion::Fall &fall : motion.falls())
  {
    double nearest = scene.geometry.diameter();
    for (const Edge &edge : edges)
      for (const unsigned int end : {0, 1})
        if (edge.boundary == fall.boundary &&
            edge.ends[end].distance(fall.from) < edge.ends[1 - end].distance(fall.from))
          nearest = std::min(nearest, edge.ends[1 - end].distance(fall.from));
    result.push_back(nearest);
  }
  return result;
}

// @sect3{What u_N does on w}
//
// Where cells of both meshes overlap, the smaller one is integrated over.
TestSpace::Residual TestSpace::residual(const Solution<2> &solution) const
{
  Residual result{Vector<double>(space.n_dofs()), Vector<double>(space.n_dofs())};
  for (const WorkOnPart &part : stress_on_parts(solution, *mesh, degrees, *tables_in_parts))
  {
    const unsigned int cell = part.b->active_cell_index();
    const LocalNumbering &numbering = solution.tables.numbering(degrees[cell]);
    const auto dofs = space.cell_dofs(cell);
    const unsigned int n_shapes = dofs.size() / 2;
    for (unsigned int i = 0; i < dofs.size(); ++i)
    {
      const unsigned int shape = numbering.component[i] * n_shapes + numbering.shape[i];
      result.sum[dofs[i]] += part.work.sum[shape];
      result.absolute[dofs[i]] += part.work.absolute[shape];
    }
    result.rule = std::max(result.rule, part.work.rule);
  }
  for (types::global_dof_index i = 0; i < applied.size(); ++i)
  {
    result.sum[i] -= applied[i];
    result.absolute[i] += std::abs(applied[i]);
  }
  return result;
}
} // namespace hpvi
