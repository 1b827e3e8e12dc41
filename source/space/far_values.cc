// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/far_values.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

FarValues::FarValues(const IndexSet &owned, const std::vector<types::global_dof_index> &wanted,
                     MPI_Comm communicator)
    : wanted(wanted)
{
  IndexSet others(owned.size());
  others.add_indices(wanted.begin(), wanted.end());
  others.subtract_set(owned);
  others.compress();
  partitioner = std::make_shared<const Utilities::MPI::Partitioner>(owned, others, communicator);
  for (const auto unknown : wanted)
    places.push_back(partitioner->global_to_local(unknown));
}

unsigned int FarValues::place(const types::global_dof_index unknown) const
{
  return std::lower_bound(wanted.begin(), wanted.end(), unknown) - wanted.begin();
}

template <typename Number>
void FarValues::take(const Number *const owned, std::vector<Number> &values) const
{
  const unsigned int n = partitioner->locally_owned_size();
  std::vector<Number> others(partitioner->n_ghost_indices()), sent(partitioner->n_import_indices());
  std::vector<MPI_Request> requests;
  partitioner->export_to_ghosted_array_start<Number, MemorySpace::Host>(
      0, ArrayView<const Number>(owned, n), make_array_view(sent), make_array_view(others),
      requests);
  partitioner->export_to_ghosted_array_finish<Number, MemorySpace::Host>(make_array_view(others),
                                                                         requests);
  values.resize(places.size());
  for (unsigned int k = 0; k < places.size(); ++k)
    values[k] = places[k] < n ? owned[places[k]] : others[places[k] - n];
}

template <typename Number>
void FarValues::add(std::vector<Number> &values, Number *const owned) const
{
  const unsigned int n = partitioner->locally_owned_size();
  std::vector<Number> others(partitioner->n_ghost_indices()),
      received(partitioner->n_import_indices());
  for (unsigned int k = 0; k < places.size(); ++k)
    if (places[k] < n)
      owned[places[k]] += values[k];
    else
      others[places[k] - n] += values[k];
  std::vector<MPI_Request> requests;
  partitioner->import_from_ghosted_array_start<Number, MemorySpace::Host>(
      VectorOperation::add, 0, make_array_view(others), make_array_view(received), requests);
  partitioner->import_from_ghosted_array_finish<Number, MemorySpace::Host>(
      VectorOperation::add, ArrayView<const Number>(received.data(), received.size()),
      ArrayView<Number>(owned, n), make_array_view(others), requests);
}

template void FarValues::take(const double *, std::vector<double> &) const;
template void FarValues::take(const float *, std::vector<float> &) const;
template void FarValues::add(std::vector<double> &, double *) const;
template void FarValues::add(std::vector<float> &, float *) const;
} // namespace hpvi
