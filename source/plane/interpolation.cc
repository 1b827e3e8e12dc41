// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/interpolation.h>
#include <hpvi/plane/multiplier_trace.h>

#include <array>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int whole_cell = numbers::invalid_unsigned_int;

/** Carries polynomials from the cells of one mesh to those of a finer one. */
template <int dim>
class Interpolation
{
public:
  Interpolation(const Solution<dim> &coarse, const DisplacementSpace<dim> &finer)
      : coarse(coarse), finer(finer), result(finer.n_dofs())
  {
  }

  Vector<double> run()
  {
    auto fine = finer.triangulation().begin(0);
    for (const auto &cell : coarse.displacement_space.triangulation().cell_iterators_on_level(0))
      descend(cell, fine++);
    return std::move(result);
  }

private:
  using Cell = typename Triangulation<dim>::cell_iterator;

  /** The values of FE_Q(@p from) at the nodes of FE_Q(@p to) on a cell or on one of its children. */
  const FullMatrix<double> &matrix(const unsigned int from, const unsigned int to,
                                   const unsigned int child)
  {
    FullMatrix<double> &known = matrices[{{from, to, child}}];
    if (known.empty())
    {
      std::vector<Point<dim>> nodes =
          coarse.tables.elements(to)[to - 1].base_element(0).get_unit_support_points();
      if (child != whole_cell)
        for (Point<dim> &node : nodes)
          node = GeometryInfo<dim>::child_to_cell_coordinates(node, child);
      known =
          tabulate<dim>(from, nodes, std::vector<double>(nodes.size()), /*second=*/false).values;
    }
    return known;
  }

  void descend(const Cell &from, const Cell &to)
  {
    if (from->is_active())
      hand_on(coarse.displacement_space.degrees()[from->active_cell_index()],
              coarse.coefficients(from->active_cell_index()), to);
    else
      for (unsigned int c = 0; c < from->n_children(); ++c)
        descend(from->child(c), to->child(c));
  }

  void hand_on(const unsigned int degree, const std::vector<double> &coefficients, const Cell &to)
  {
    if (to->is_active())
      take(degree, coefficients, to->active_cell_index());
    else
      for (unsigned int c = 0; c < to->n_children(); ++c)
        hand_on(degree, evaluate(matrix(degree, degree, c), coefficients), to->child(c));
  }

  void take(const unsigned int degree, const std::vector<double> &coefficients,
            const unsigned int cell)
  {
    const unsigned int own = finer.degrees()[cell];
    const std::vector<double> values =
        own == degree ? coefficients : evaluate(matrix(degree, own, whole_cell), coefficients);
    const LocalNumbering &numbering = coarse.tables.numbering(own);
    const auto dofs = finer.cell_dofs(cell);
    const unsigned int n_shapes = dofs.size() / dim;
    for (unsigned int i = 0; i < dofs.size(); ++i)
      result[dofs[i]] = values[numbering.component[i] * n_shapes + numbering.shape[i]];
  }

  const Solution<dim> &coarse;
  const DisplacementSpace<dim> &finer;
  Vector<double> result;
  std::map<std::array<unsigned int, 3>, FullMatrix<double>> matrices;
};
} // namespace

template <int dim>
Vector<double> interpolate(const Solution<dim> &coarse, const DisplacementSpace<dim> &finer)
{
  return Interpolation<dim>(coarse, finer).run();
}

template <int dim>
Solution<dim> interpolate(const Solution<dim> &coarse, const Spaces<dim> &finer)
{
  const Degrees &degrees = finer.displacement_space.degrees();
  if (finer.mesh == coarse.spaces->mesh && degrees == coarse.displacement_space.degrees())
    return coarse;
  const auto spaces = std::make_shared<const Spaces<dim>>(
      coarse.scene, finer.mesh, degrees, finer.tables, coarse.spaces->loads, coarse.spaces->past);
  return {coarse.scene, spaces, interpolate(coarse, spaces->displacement_space),
          MultiplierTrace<dim>(coarse.contact_space, coarse.z)
              .values(spaces->contact_space, *finer.tables)};
}

template Solution<2> interpolate(const Solution<2> &, const Spaces<2> &);
template Vector<double> interpolate(const Solution<2> &, const DisplacementSpace<2> &);
} // namespace hpvi
