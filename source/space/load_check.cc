// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/memo_table.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/load_quadrature.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/space/load_check.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int whole_cell = numbers::invalid_unsigned_int;

/** Calls @p take with each point of a face, or of a cell where there is none, and its weight. */
template <int dim>
void for_each_point(const CellMap<dim> &map, const unsigned int face, const unsigned int n_gauss,
                    const std::array<unsigned int, dim> &n_parts,
                    const std::function<void(const Point<dim> &, double)> &take)
{
  static std::map<std::pair<unsigned int, unsigned int>, Quadrature<1>> known; // dear beside a cell
  std::array<Quadrature<1>, dim> rules;
  for (unsigned int d = 0; d < dim; ++d)
    rules[d] = d == face / 2 ? Quadrature<1>(Point<1>(face % 2))
                             : memoised(known, {n_gauss, n_parts[d]},
                                        [&]() -> Quadrature<1>
                                        { return QIterated<1>(QGauss<1>(n_gauss), n_parts[d]); });
  std::array<unsigned int, dim> q{};
  for (bool ends = false; !ends;)
  {
    Point<dim> reference;
    double weight = 1;
    for (unsigned int d = 0; d < dim; ++d)
    {
      reference[d] = rules[d].point(q[d])[0];
      weight *= d == face / 2 ? 1. : rules[d].weight(q[d]);
    }
    weight *= face == whole_cell ? std::abs(determinant(map.jacobian(reference)))
                                 : map.face_measure(face, reference);
    take(map.point(reference), weight);
    unsigned int d = 0;
    while (d < dim && ++q[d] == rules[d].size())
      q[d++] = 0;
    ends = d == dim;
  }
}

template <int dim>
using Cell = typename Triangulation<dim>::cell_iterator;

template <int dim>
unsigned int degree_of(const Scene<dim> &scene, const Cell<dim> &cell)
{
  return scene.start_degree_of(body_of<dim>(scene.geometry, cell));
}

/** Rules on a cell or face: that of the run, with the same points, in one part and in many, at least four times as fine. */
template <int dim>
struct Parts
{
  /** @p varies: nothing else needs a finer one. */
  Parts(const Scene<dim> &scene, const unsigned int degree, const unsigned int face,
        const bool varies)
      : n_gauss(degree + 1)
  {
    const unsigned int samples = face == whole_cell ? 24 : 48; // along a side of the body
    once.fill(1);
    often.fill(1);
    for (unsigned int d = 0; d < dim && varies; ++d)
      often[d] = std::max(4U, samples / (n_gauss * scene.geometry.n_cells(d)));
  }

  unsigned int n_gauss;
  std::array<unsigned int, dim> once, often;
};

template <int dim>
bool varies(const Expression<dim> &function)
{
  return function && !is_constant<dim>(function);
}

template <int dim>
Point<dim> middle_of(const CellMap<dim> &map, const unsigned int face)
{
  Point<dim> reference;
  for (unsigned int d = 0; d < dim; ++d)
    reference[d] = d == face / 2 ? face % 2 : 0.5;
  return map.point(reference);
}

double moment(const Tensor<1, 2> &arm, const Tensor<1, 2> &force)
{
  return arm[0] * force[1] - arm[1] * force[0];
}

Tensor<1, 3> moment(const Tensor<1, 3> &arm, const Tensor<1, 3> &force)
{
  return cross_product_3d(arm, force);
}

std::string in_brackets(const double value)
{
  return text(value, 6);
}

template <int n>
std::string in_brackets(const Tensor<1, n> &x)
{
  std::string list;
  for (unsigned int d = 0; d < n; ++d)
    list += (d > 0 ? " " : "") + text(x[d], 6);
  return "(" + list + ")";
}

/** Without what is round-off beside @p scale. */
double clean(const double value, const double scale)
{
  return std::abs(value) < shown_as_zero * scale ? 0. : value;
}

template <int dim>
Tensor<1, dim> clean(Tensor<1, dim> x, const double scale)
{
  for (unsigned int d = 0; d < dim; ++d)
    x[d] = clean(x[d], scale);
  return x;
}

double size_of(const double value)
{
  return std::abs(value);
}

template <int dim>
double size_of(const Tensor<1, dim> &x)
{
  return x.norm();
}
} // namespace

template <int dim>
LoadCheck<dim>::LoadCheck(const Scene<dim> &scene)
{
  Triangulation<dim> mesh;
  make_mesh(scene, mesh);
  *this = LoadCheck(scene, mesh);
}

template <int dim>
LoadCheck<dim>::LoadCheck(const Scene<dim> &scene, const Triangulation<dim> &mesh)
{
  centre = scene.geometry.centre();
  thickness = scene.thickness;
  has_plates = scene.has_plates();
  size = scene.geometry.diameter();
  double largest = 0;
  const auto look = [&](const Load<dim> &load, const Cell<dim> &cell, const unsigned int face,
                        const std::string &name)
  {
    const CellMap<dim> map = map_of<dim>(cell);
    const Parts<dim> parts(scene, degree_of(scene, cell), face,
                           map.is_curved() ||
                               std::any_of(load.begin(), load.end(), varies<dim>)); // ds may vary
    Tensor<1, dim> coarse, fine;
    if (parts.once != parts.often)
      for_each_point<dim>(map, face, parts.n_gauss, parts.once,
                          [&](const Point<dim> &x, const double weight)
                          { coarse += weight * load_at<dim>(load, x); });
    for_each_point<dim>(map, face, parts.n_gauss, parts.often,
                        [&](const Point<dim> &x, const double weight)
                        {
                          const Tensor<1, dim> force = weight * load_at<dim>(load, x);
                          fine += force;
                          sum.moment += moment(x - centre, force);
                          for (unsigned int c = 0; c < dim; ++c)
                            absolute += std::abs(force[c]);
                        });
    sum.force += fine;
    if (parts.once == parts.often)
      coarse = fine;
    if ((coarse - fine).norm() <= largest)
      return;
    largest = (coarse - fine).norm();
    worst = name;
    where = middle_of(map, face);
    force = coarse;
    finer = fine;
  };
  for (const auto &cell : mesh.cell_iterators_on_level(0))
  {
    if (scene.has_body_force())
      look(scene.body_force_in(cell), cell, whole_cell, "Body force");
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face))
        if (const auto &condition = scene.boundaries[cell->face(face)->boundary_id()];
            condition.has_traction())
          look(condition.traction, cell, face, "Traction on " + condition.name);
  }
}

template <int dim>
std::string LoadCheck<dim>::in_words() const
{
  return "loads: force " + in_brackets(thickness * clean(sum.force, absolute)) + ", moment " +
         in_brackets(thickness * clean(sum.moment, absolute * size)) + " about " +
         in_brackets<dim>(centre) + (has_plates ? ", without those on rigid plates" : "") + "\n";
}

template <int dim>
std::string LoadCheck<dim>::warning(const BoundaryForce<dim> &loads) const
{
  if ((loads.force - sum.force).norm() <= 1e-3 * absolute &&
      size_of(loads.moment - sum.moment) <= 1e-3 * absolute * centre.distance(where))
    return {};
  return worst + " is not resolved near " + in_brackets<dim>(where) +
         ": there its force on a coarse cell is " + in_brackets(force) +
         " by the rule of the run and " + in_brackets(finer) + " by a finer one; all loads are " +
         in_brackets(loads.force) + " in the discrete problem, " + in_brackets(sum.force) +
         " by the finer rule; take more Geometry/Subdivisions";
}

// @sect3{Initial strains and springs}
//
namespace
{
/** Of something that is integrated over coarse cells or faces: by the rule of the run, and by a finer one. */
template <int dim, int n>
class Comparison
{
public:
  using Value = Tensor<1, n>;

  Comparison(const Scene<dim> &scene) : scene(scene)
  {
  }

  /** At one cell, or its @p face. */
  void look(const Cell<dim> &cell, const unsigned int face, const bool is_varying,
            const std::string &name, const std::function<Value(const Point<dim> &)> &value)
  {
    const CellMap<dim> map = map_of<dim>(cell);
    const Parts<dim> parts(scene, degree_of(scene, cell), face, is_varying);
    Value coarse, fine;
    for_each_point<dim>(map, face, parts.n_gauss, parts.once,
                        [&](const Point<dim> &x, const double weight)
                        { coarse += weight * value(x); });
    for_each_point<dim>(map, face, parts.n_gauss, parts.often,
                        [&](const Point<dim> &x, const double weight)
                        {
                          const Value part = weight * value(x);
                          fine += part;
                          absolute += part.norm();
                        });
    sum += fine;
    if (!worst.empty() && (coarse - fine).norm() <= (here - finer).norm())
      return;
    worst = name;
    where = middle_of(map, face);
    here = coarse;
    finer = fine;
  }

  /** Empty where the discrete problem has seen the same @p all, to 1e-3 of all absolute values. */
  std::string warning(const Value &all, const std::string &what) const
  {
    if ((all - sum).norm() <= 1e-3 * absolute)
      return {};
    return worst + " is not resolved near " + in_brackets<dim>(where) + ": there its " + what +
           " is " + in_brackets(here) + " by the rule of the run and " + in_brackets(finer) +
           " by a finer one; in all it is " + in_brackets(all) + " in the discrete problem, " +
           in_brackets(sum) + " by the finer rule; take more Geometry/Subdivisions";
  }

private:
  const Scene<dim> &scene;
  Value sum;
  double absolute = 0;
  std::string worst; ///< where the rules differ most
  Point<dim> where;  ///< the middle there
  Value here, finer; ///< by both rules
};

/** xx, yy, zz, xy, xz, yz of a stress; of the plane xx, yy, xy. */
template <int dim>
Tensor<1, dim *(dim + 1) / 2> components(const Tensor<2, dim> &stress)
{
  Tensor<1, dim *(dim + 1) / 2> result;
  unsigned int k = 0;
  for (unsigned int d = 0; d < dim; ++d)
    result[k++] = stress[d][d];
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int d = c + 1; d < dim; ++d)
      result[k++] = stress[c][d];
  return result;
}
} // namespace

template <int dim>
std::string strain_warning(const Scene<dim> &scene, const Triangulation<dim> &mesh,
                           const Tensor<2, dim> &stresses)
{
  if (!scene.has_initial_strain())
    return {};
  Comparison<dim, dim *(dim + 1) / 2> comparison(scene);
  for (const auto &cell : mesh.cell_iterators_on_level(0))
  {
    const types::material_id material = cell->material_id();
    const InitialStrain<dim> &initial = scene.initial_strains[material];
    if (!initial)
      continue;
    const bool own = std::any_of(initial.components.begin(), initial.components.end(), varies<dim>);
    comparison.look(
        cell, whole_cell, own || (initial.expansion != 0. && varies<dim>(initial.temperature)),
        own ? "Initial strain" : "Temperature",
        [&, law = HookesLaw<dim>(scene.materials[material])](const Point<dim> &x)
        { return components<dim>(Tensor<2, dim>(law.stress(scene.initial_strain(material, x)))); });
  }
  return comparison.warning(components<dim>(stresses), "stress over a coarse cell");
}

template <int dim>
std::string spring_warning(const Scene<dim> &scene, const Triangulation<dim> &mesh,
                           const Tensor<1, 2> &stiffness)
{
  if (!scene.has_springs())
    return {};
  Comparison<dim, 2> comparison(scene);
  for (const auto &cell : mesh.cell_iterators_on_level(0))
    for (const unsigned int face : cell->face_indices())
    {
      if (!cell->at_boundary(face))
        continue;
      const BoundaryCondition<dim> &condition = scene.boundaries[cell->face(face)->boundary_id()];
      if (condition.spring)
        comparison.look(cell, face, condition.spring.varies(), "Spring on " + condition.name,
                        [&](const Point<dim> &x)
                        {
                          const auto [k_n, k_t] = condition.spring.at(x);
                          return Tensor<1, 2>({k_n, k_t});
                        });
    }
  return comparison.warning(stiffness, "stiffness on a coarse face");
}

template struct LoadCheck<2>;
template struct LoadCheck<3>;
template std::string strain_warning(const Scene<2> &, const Triangulation<2> &,
                                    const Tensor<2, 2> &);
template std::string strain_warning(const Scene<3> &, const Triangulation<3> &,
                                    const Tensor<2, 3> &);
template std::string spring_warning(const Scene<2> &, const Triangulation<2> &,
                                    const Tensor<1, 2> &);
template std::string spring_warning(const Scene<3> &, const Triangulation<3> &,
                                    const Tensor<1, 2> &);
} // namespace hpvi
