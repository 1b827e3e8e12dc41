// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/processes.h>
#include <hpvi/results/probe_rule.h>
#include <hpvi/results/probe_value.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_q.h>

#include <cmath>
#include <map>
#include <utility>

namespace hpvi
{
using namespace dealii;

double von_mises(const FullStress &stress)
{
  return std::sqrt(1.5) * deviator(stress).norm();
}

std::array<double, 2> principal_values(const SymmetricTensor<2, 2> &tensor)
{
  const double m = (tensor[0][0] + tensor[1][1]) / 2,
               r = std::hypot((tensor[0][0] - tensor[1][1]) / 2, tensor[0][1]);
  return {{m + r, m - r}};
}

template <int dim>
std::array<double, 3> principal_stresses(const FullStress &stress)
{
  if constexpr (dim == 3)
    return eigenvalues(stress);
  SymmetricTensor<2, 2> in_plane;
  for (unsigned int i = 0; i < 2; ++i)
    for (unsigned int j = i; j < 2; ++j)
      in_plane[i][j] = stress[i][j];
  const std::array<double, 2> both = principal_values(in_plane);
  return {{both[0], both[1], stress[2][2]}};
}

namespace
{
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/** Sums of displacements and stresses, with the sum of their weights. */
template <int dim>
struct Sum
{
  static constexpr unsigned int n = dim + FullStress::n_independent_components + 1;

  std::vector<double> numbers = std::vector<double>(n, 0.);

  void add(const double weight, const PointValue<dim> &value)
  {
    for (unsigned int d = 0; d < dim; ++d)
      numbers[d] += weight * value.displacement[d];
    FullStress stress;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        stress[i][j] = value.stress[i][j];
    if (dim == 2)
      stress[2][2] = value.across;
    for (unsigned int k = 0; k < FullStress::n_independent_components; ++k)
      numbers[dim + k] += weight * stress.access_raw_entry(k);
    numbers.back() += weight;
  }

  /** Over all processes: the mean by weight; NaN where there is none. */
  LinePoint<dim> mean(const Point<dim> &x) const
  {
    LinePoint<dim> result;
    result.x = x;
    const double whole = numbers.back() > 0 ? numbers.back() : no_number;
    for (unsigned int d = 0; d < dim; ++d)
      result.displacement[d] = numbers[d] / whole;
    for (unsigned int k = 0; k < FullStress::n_independent_components; ++k)
      result.stress.access_raw_entry(k) = numbers[dim + k] / whole;
    return result;
  }
};

template <int dim>
ProbeValue<dim> value_of(const unsigned int number, const Field<dim> &field)
{
  const Probe<dim> &probe = field.scene.probes[number];
  const ProbeRule<dim> rule = probe_rule(probe, field.scene, field.dof_handler, field.tables);
  Sum<dim> sum;
  collectively(field.communicator(),
               [&]()
               {
                 for (const WeightedPoints<dim> &part : rule)
                 {
                   const auto values = field.values(part.cell, part.points);
                   for (unsigned int q = 0; q < values.size(); ++q)
                     sum.add(part.weights[q], values[q]);
                 }
               });
  Utilities::MPI::sum(sum.numbers, field.communicator(), sum.numbers);
  const LinePoint<dim> mean = sum.mean(probe.at);
  ProbeValue<dim> result;
  result.probe = number;
  for (unsigned int d = 0; d < dim; ++d)
    result.displacement[d].value = mean.displacement[d];
  result.stress = mean.stress;
  return result;
}

/** Cell by cell, each with the points that it has. */
template <int dim>
ProbeLine<dim> line_of(const unsigned int number, const Field<dim> &field)
{
  const Probe<dim> &probe = field.scene.probes[number];
  std::vector<Sum<dim>> sums(probe.n_points);
  const auto add_cells = [&]()
  {
    for (const auto &cell : field.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      std::vector<Point<dim>> references;
      std::vector<unsigned int> which;
      for (unsigned int k = 0; k < probe.n_points; ++k)
        if (const auto reference = reference_of<dim>(cell, probe.point(k)))
        {
          references.push_back(*reference);
          which.push_back(k);
        }
      if (references.empty())
        continue;
      const auto values = field.values(cell, references);
      for (unsigned int q = 0; q < which.size(); ++q)
        sums[which[q]].add(1., values[q]);
    }
  };
  collectively(field.communicator(), add_cells);
  ProbeLine<dim> result;
  result.probe = number;
  for (unsigned int k = 0; k < probe.n_points; ++k)
  {
    Utilities::MPI::sum(sums[k].numbers, field.communicator(), sums[k].numbers);
    result.points.push_back(sums[k].mean(probe.point(k)));
  }
  return result;
}
} // namespace

template <int dim>
std::vector<ProbeValue<dim>> probe_values(const Field<dim> &field)
{
  std::vector<ProbeValue<dim>> result;
  for (unsigned int k = 0; k < field.scene.probes.size(); ++k)
    if (field.scene.probes[k].kind != ProbeKind::line)
      result.push_back(value_of(k, field));
  return result;
}

template <int dim>
std::vector<ProbeLine<dim>> probe_lines(const Field<dim> &field)
{
  std::vector<ProbeLine<dim>> result;
  for (unsigned int k = 0; k < field.scene.probes.size(); ++k)
    if (field.scene.probes[k].kind == ProbeKind::line)
      result.push_back(line_of(k, field));
  return result;
}

template <int dim>
PlacedValue<dim> largest_displacement(const Field<dim> &field)
{
  PlacedValue<dim> largest{-1., {}};
  std::map<unsigned int, std::vector<Point<dim>>> nodes; // by degree
  for (const auto &cell : field.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    std::vector<Point<dim>> &own = nodes[field.degree(cell)];
    if (own.empty())
      own = FE_Q<dim>(field.degree(cell)).get_unit_support_points();
    const std::vector<double> u = field.coefficients(cell);
    for (unsigned int i = 0; i < own.size(); ++i)
    {
      double square = 0;
      for (unsigned int c = 0; c < dim; ++c)
        square += u[c * own.size() + i] * u[c * own.size() + i];
      if (std::sqrt(square) > largest.value)
        largest = {std::sqrt(square), map_of<dim>(cell).point(own[i])};
    }
  }
  for (const auto &[value, where] : Utilities::MPI::all_gather(
           field.communicator(), std::make_pair(largest.value, largest.where)))
    if (value > largest.value)
      largest = {value, where};
  return largest;
}

template std::array<double, 3> principal_stresses<2>(const FullStress &);
template std::array<double, 3> principal_stresses<3>(const FullStress &);
template std::vector<ProbeValue<2>> probe_values(const Field<2> &);
template std::vector<ProbeValue<3>> probe_values(const Field<3> &);
template std::vector<ProbeLine<2>> probe_lines(const Field<2> &);
template std::vector<ProbeLine<3>> probe_lines(const Field<3> &);
template PlacedValue<2> largest_displacement(const Field<2> &);
template PlacedValue<3> largest_displacement(const Field<3> &);
} // namespace hpvi
