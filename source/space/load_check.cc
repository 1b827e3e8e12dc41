// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/space/load_check.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int whole_cell = numbers::invalid_unsigned_int;

/** Calls @p take with each point of a face, or of a cell where there is none, and its force. */
template <int dim>
void for_each_force(const Load<dim> &load, const CellMap<dim> &map, const unsigned int face,
                    const unsigned int n_gauss, const std::array<unsigned int, dim> &n_parts,
                    const std::function<void(const Tensor<1, dim> &, const Point<dim> &)> &take)
{
  std::array<Quadrature<1>, dim> rules;
  for (unsigned int d = 0; d < dim; ++d)
    rules[d] = d == face / 2 ? Quadrature<1>(Point<1>(face % 2))
                             : Quadrature<1>(QIterated<1>(QGauss<1>(n_gauss), n_parts[d]));
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
    const Point<dim> x = map.point(reference);
    Tensor<1, dim> force;
    for (unsigned int c = 0; c < dim; ++c)
      force[c] = load[c] ? weight * load[c]->value(x) : 0.;
    take(force, x);
    unsigned int d = 0;
    while (d < dim && ++q[d] == rules[d].size())
      q[d++] = 0;
    ends = d == dim;
  }
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

template <int dim>
std::string in_brackets(const Tensor<1, dim> &x)
{
  std::string list;
  for (unsigned int d = 0; d < dim; ++d)
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
  centre = scene.geometry.centre();
  thickness = scene.thickness;
  size = scene.geometry.diameter();
  Triangulation<dim> mesh;
  make_mesh(scene, mesh);
  const unsigned int n_gauss = scene.adaptivity.start_degree + 1;
  double largest = 0;
  const auto look = [&](const Load<dim> &load, const CellMap<dim> &map, const unsigned int face,
                        const std::string &name)
  {
    const bool varies = std::any_of(load.begin(), load.end(),
                                    [](const Expression<dim> &component)
                                    { return component && !is_constant<dim>(component); });
    std::array<unsigned int, dim> once, often;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const unsigned int samples = face == whole_cell ? 24 : 48; // along a side of the body
      once[d] = 1;
      often[d] = varies ? std::max(4U, samples / (n_gauss * scene.geometry.n_cells(d))) : 1;
    }
    Tensor<1, dim> coarse, fine;
    for_each_force<dim>(load, map, face, n_gauss, once,
                        [&](const Tensor<1, dim> &force, const Point<dim> &) { coarse += force; });
    for_each_force<dim>(load, map, face, n_gauss, often,
                        [&](const Tensor<1, dim> &force, const Point<dim> &x)
                        {
                          fine += force;
                          sum.moment += moment(x - centre, force);
                          for (unsigned int c = 0; c < dim; ++c)
                            absolute += std::abs(force[c]);
                        });
    sum.force += fine;
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
      look(scene.body_force_in(cell), map_of<dim>(cell), whole_cell, "Body force");
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face))
        if (const auto &condition = scene.boundaries[cell->face(face)->boundary_id()];
            condition.has_traction())
          look(condition.traction, map_of<dim>(cell), face, "Traction on " + condition.name);
  }
}

template <int dim>
std::string LoadCheck<dim>::in_words() const
{
  return "loads: force " + in_brackets(thickness * clean(sum.force, absolute)) + ", moment " +
         in_brackets(thickness * clean(sum.moment, absolute * size)) + " about " +
         in_brackets<dim>(centre) + "\n";
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

template struct LoadCheck<2>;
template struct LoadCheck<3>;
} // namespace hpvi
