// SPDX-License-Identifier: LGPL-2.1-or-later

// The system $A$ and $f$ of (5.1) and (5.2), in unknowns that are all free. deal.II's way is to add
// local matrices to a global one and to resolve constraints as they come. Here cells are reduced to
// unknowns first, $T^TKT$, and added afterwards: cells that are congruent and constrained in the
// same way share the product, and of a mesh that has been bisected again and again many are.
#include <hpvi/algebra/supervariables.h>
#include <hpvi/plane/dissection.h>
#include <hpvi/plane/elastic_system.h>
#include <hpvi/plane/initial_stress.h>
#include <hpvi/plane/plates.h>
#include <hpvi/plane/springs.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Empty without initial strains. */
template <int dim>
Vector<double> strain_loads_of(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                               const ShapeTables<dim> &tables, const LoadRules<dim> &rules,
                               const Volume volume)
{
  return scene.has_initial_strain() ? initial_strain_loads(scene, space, tables, rules, volume)
                                    : Vector<double>();
}

template <int dim>
Vector<double> sum_of_loads(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                            const ShapeTables<dim> &tables, const LoadRules<dim> &rules,
                            const Vector<double> &strain_loads)
{
  Vector<double> load = applied_loads(scene, space, tables, rules);
  if (scene.has_plates())
    load += plate_loads(scene, space, tables);
  if (strain_loads.size() > 0)
    load += strain_loads;
  return load;
}
} // namespace

// @sect3{Assembly}
//
// Loads first, then cells. What a body force does inside a cell is condensed to its boundary
// together with the stiffness.
template <int dim>
ElasticSystem<dim>::ElasticSystem(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                                  const Unknowns<dim> &unknowns,
                                  const Condensation<dim> &condensation,
                                  const ShapeTables<dim> &tables, const LoadRules<dim> &rules,
                                  CondensedElements<dim> &elements)
    : f(unknowns.n()), of_strains(strain_loads_of(scene, space, tables, rules, elements.volume())),
      load(sum_of_loads(scene, space, tables, rules, of_strains))
{
  Vector<double> boundary_load(load);
  if (has_interior_loads(scene))
    condensation.eliminate(boundary_load);
  f = unknowns.collect(boundary_load);
  std::vector<Contribution> contributions;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const unsigned int index = cell->active_cell_index();
      contributions.push_back(
          reduce(index, condensation.element(index), space.cell_dofs(index), unknowns, elements));
    }
  std::vector<std::shared_ptr<const CondensedElement>> springs; // until they are summed up
  for (const SpringFace &face : spring_faces(scene, space, tables))
  {
    const auto element = std::make_shared<CondensedElement>();
    element->condensed = face.matrix;
    springs.push_back(element);
    contributions.push_back(reduce(face.cell, element, face.dofs, unknowns, elements));
  }
  set_hints(space.triangulation(), contributions);
  sum_up(contributions);
  elements.forget_unused();
}

// @sect3{One cell}
//
// Each row of $T$ says how a displacement on the boundary of the cell follows from unknowns:
// itself, for most; the nodes of a longer edge at a hanging one; moments at the contact. Where $T$
// is the identity the condensed matrix is used as it is.
/**
 * `T' K T` of one cell, where T expresses the displacements on its boundary by unknowns. Adds to f
 * what prescribed displacements h leave on the right, -T' K h.
 */
template <int dim>
typename ElasticSystem<dim>::Contribution
ElasticSystem<dim>::reduce(const unsigned int cell,
                           const std::shared_ptr<const CondensedElement> &element,
                           const ArrayView<const types::global_dof_index> dofs,
                           const Unknowns<dim> &unknowns, CondensedElements<dim> &elements)
{
  const FullMatrix<double> &K = element->condensed;
  const unsigned int n = K.m();
  Contribution result;
  result.cell = cell;
  std::vector<ConstraintEntry> T;
  T.reserve(n);
  result.targets.reserve(n);
  Vector<double> prescribed(n);
  bool is_identity = true, has_prescribed = false;
  for (unsigned int i = 0; i < n; ++i)
  {
    is_identity = is_identity && unknowns.is_plain(dofs[i]);
    for (const auto &[unknown, weight] : unknowns.terms(dofs[i]))
    {
      // An unknown of the cell may have been met before, where another one depends on it.
      const unsigned int target = is_identity ? i : result.add_target(unknown);
      if (is_identity)
        result.targets.push_back(unknown);
      T.push_back({i, target, weight});
    }
    prescribed[i] = unknowns.prescribed(dofs[i]);
    has_prescribed = has_prescribed || prescribed[i] != 0.;
  }
  result.values = &K(0, 0);
  if (!is_identity && !result.targets.empty())
  {
    constrained.push_back(elements.constrained(element, T, result.targets.size()));
    result.values = &(*constrained.back())(0, 0);
  }
  if (has_prescribed)
  {
    Vector<double> reaction(n);
    K.vmult(reaction, prescribed);
    for (const ConstraintEntry &part : T)
      f[result.targets[part.target]] -= part.weight * reaction[part.local];
  }
  return result;
}

template <int dim>
unsigned int ElasticSystem<dim>::Contribution::add_target(const unsigned int unknown)
{
  const auto found = std::find(targets.begin(), targets.end(), unknown);
  const unsigned int target = found - targets.begin();
  if (found == targets.end())
    targets.push_back(unknown);
  return target;
}

/** Unknowns of the same cells have entries in the same places. */
template <int dim>
void ElasticSystem<dim>::set_hints(const Triangulation<dim> &triangulation,
                                   const std::vector<Contribution> &contributions)
{
  Supervariables supervariables(std::vector<unsigned int>(f.size(), 0));
  Dissection dissection(triangulation, f.size());
  for (const Contribution &contribution : contributions)
  {
    supervariables.split(contribution.targets);
    dissection.add(contribution.cell, contribution.targets);
  }
  hints = {supervariables.numbers(), dissection.stages()};
}

// @sect3{The sum}
//
// The factorisation wants the upper triangle by compressed columns. It is made directly: for each
// column all cells that know it are visited, and an array remembers where each row of the column
// has gone. There is no sparsity pattern, no search in rows, and no entry that is zero.
namespace
{
/** Where unknowns stand in what cells add: small, as there is one for each unknown of each cell. */
struct Place
{
  unsigned int contribution, target;
};

/** Places by unknown, one after the other. */
template <class Contribution>
struct Places
{
  const std::vector<Contribution> &contributions;
  std::vector<unsigned int> first;
  std::vector<Place> all;
  std::size_t most_targets;
};

/** Column by column, so that one marker array finds equal entries of neighbouring cells. */
template <class Contribution>
void add_columns(const Places<Contribution> &places, SymmetricMatrix &A)
{
  const unsigned int n = places.first.size() - 1;
  std::vector<int> position(n, -1);
  std::vector<unsigned int> upper(places.most_targets + 1); // which targets are rows of the column
  for (unsigned int column = 0; column < n; ++column)
  {
    const int start = A.row.size();
    for (unsigned int place = places.first[column]; place < places.first[column + 1]; ++place)
    {
      const auto [contribution, target] = places.all[place];
      const unsigned int *const targets = places.contributions[contribution].targets.data();
      const unsigned int n_targets = places.contributions[contribution].targets.size();
      const double *const values =
          places.contributions[contribution].values + std::size_t(target) * n_targets;
      // Half of all targets are, in no order that a processor could guess: they are selected without a branch.
      unsigned int n_upper = 0;
      for (unsigned int i = 0; i < n_targets; ++i)
      {
        upper[n_upper] = i;
        n_upper += targets[i] <= column;
      }
      for (unsigned int k = 0; k < n_upper; ++k)
      {
        const unsigned int i = upper[k], row = targets[i];
        if (position[row] < start)
        {
          position[row] = A.row.size();
          A.row.push_back(row);
          A.value.push_back(0.);
        }
        A.value[position[row]] += values[i];
      }
    }
    A.column_start.push_back(A.row.size());
  }
}
} // namespace

template <int dim>
void ElasticSystem<dim>::sum_up(const std::vector<Contribution> &contributions)
{
  const unsigned int n = f.size();
  Places<Contribution> places{contributions, std::vector<unsigned int>(n + 1, 0), {}, 0};
  std::size_t n_entries = 0;
  for (const Contribution &contribution : contributions)
  {
    places.most_targets = std::max(places.most_targets, contribution.targets.size());
    for (const unsigned int target : contribution.targets)
      ++places.first[target + 1];
    n_entries += contribution.targets.size() * (contribution.targets.size() + 1) / 2;
  }
  std::partial_sum(places.first.begin(), places.first.end(), places.first.begin());
  places.all.resize(places.first.back());
  std::vector<unsigned int> next(places.first);
  for (unsigned int c = 0; c < contributions.size(); ++c)
    for (unsigned int i = 0; i < contributions[c].targets.size(); ++i)
      places.all[next[contributions[c].targets[i]]++] = {c, i};
  A.reserve(n_entries); // more than there will be: what no entry touches costs nothing
  A.column_start.reserve(n + 1);
  add_columns(places, A);
}

// @sect3{Loads}
//
// Tractions and body forces are expressions of a user, and may be anything. Where they jump or bend,
// edges and cells are cut; the number of Gauss points follows from the expression, up to where its
// integral does not change any more: an error of quadrature would be a load that the bound of the
// error does not know.
namespace
{
/** local_i += sum_q weight_q phi_i(x_q) . force(x_q) */
template <int dim, class Force>
void integrate_load(const ShapeTable<dim> &table, const LocalNumbering &numbering,
                    const CellMap<dim> &map, const Force &force_times_measure,
                    Vector<double> &local)
{
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Tensor<1, dim> force =
        table.weights[q] * force_times_measure(table.points[q], map.point(table.points[q]));
    for (unsigned int i = 0; i < local.size(); ++i)
      local[i] += table.values(q, numbering.shape[i]) * force[numbering.component[i]];
  }
}
} // namespace

template <int dim>
Vector<double> load_vector(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                           const ShapeTables<dim> &tables, const LoadRules<dim> &rules)
{
  return sum_of_loads(scene, space, tables, rules,
                      strain_loads_of(scene, space, tables, rules, Volume::full));
}

template <int dim>
Vector<double> applied_loads(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                             const ShapeTables<dim> &tables, const LoadRules<dim> &rules)
{
  Vector<double> load(space.n_dofs());
  const bool interior_loads = scene.has_body_force();
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned() && (interior_loads || cell->at_boundary()))
    {
      const unsigned int degree = space.degrees()[cell->active_cell_index()];
      const LocalNumbering &numbering = tables.numbering(degree);
      const CellMap<dim> map = map_of<dim>(cell);
      Vector<double> local(numbering.shape.size());
      if (interior_loads)
      {
        const auto force = [&](const Point<dim> &reference, const Point<dim> &x)
        {
          return std::abs(determinant(map.jacobian(reference))) * scene.circumference(x) *
                 load_at<dim>(scene.body_force_in(cell), x);
        };
        integrate_load(ShapesOfRule(rules.body_force(cell, degree), degree, tables).table,
                       numbering, map, force, local);
      }
      for (const unsigned int face : cell->face_indices())
        if (cell->face(face)->at_boundary())
        {
          const auto &condition = scene.boundaries[cell->face(face)->boundary_id()];
          if (!condition.has_traction())
            continue;
          const auto force = [&](const Point<dim> &reference, const Point<dim> &x)
          {
            return map.face_measure(face, reference) * scene.circumference(x) *
                   load_at<dim>(condition.traction, x);
          };
          integrate_load(
              ShapesOfRule(rules.traction(cell, face, degree), face, degree, tables).table,
              numbering, map, force, local);
        }
      const auto dofs = space.cell_dofs(cell->active_cell_index());
      for (unsigned int i = 0; i < local.size(); ++i)
        load[dofs[i]] += local[i];
    }
  return load;
}

template <int dim>
Vector<double> body_loads(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                          const ShapeTables<dim> &tables, const LoadRules<dim> &rules)
{
  Vector<double> load = applied_loads(scene, space, tables, rules);
  if (scene.has_initial_strain())
    load += initial_strain_loads(scene, space, tables, rules);
  return load;
}

template <int dim>
Vector<double> plate_loads(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                           const ShapeTables<dim> &tables)
{
  Vector<double> load(space.n_dofs());
  for (const Plate &plate : plates_of(scene, supported_nodes(scene, space.numbering(), tables)))
    plate.add_load(load);
  return load;
}

template <int dim>
double ElasticSystem<dim>::work(const Vector<double> &u) const
{
  // deal.II's product would split the sum by threads; a result must not depend on their number.
  return std::inner_product(load.begin(), load.end(), u.begin(), 0.);
}

template <int dim>
const Vector<double> &ElasticSystem<dim>::loads() const
{
  return load;
}

template <int dim>
const Vector<double> &ElasticSystem<dim>::strain_loads() const
{
  return of_strains;
}

template class ElasticSystem<2>;
template Vector<double> load_vector(const Scene<2> &, const DisplacementSpace<2> &,
                                    const ShapeTables<2> &, const LoadRules<2> &);
template Vector<double> applied_loads(const Scene<2> &, const DisplacementSpace<2> &,
                                      const ShapeTables<2> &, const LoadRules<2> &);
template Vector<double> body_loads(const Scene<2> &, const DisplacementSpace<2> &,
                                   const ShapeTables<2> &, const LoadRules<2> &);
template Vector<double> plate_loads(const Scene<2> &, const DisplacementSpace<2> &,
                                    const ShapeTables<2> &);
} // namespace hpvi
