// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_far_values_h
#define hpvi_far_values_h

#include <deal.II/base/index_set.h>
#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace hpvi
{
/** Values of vectors at unknowns that may lie on any process: what is opposite to a contact face lies beside no cell of it. */
class FarValues
{
public:
  /** @p wanted: by this process, ascending and each once. Collective. */
  FarValues(const dealii::IndexSet &owned,
            const std::vector<dealii::types::global_dof_index> &wanted, MPI_Comm communicator);

  unsigned int size() const ///< of #wanted
  {
    return places.size();
  }

  /** The place of an unknown among what is wanted. */
  unsigned int place(dealii::types::global_dof_index unknown) const;

  /** The values that are wanted of a vector whose entries on this process begin at @p owned. Collective. */
  template <typename Number>
  void take(const Number *owned, std::vector<Number> &values) const;

  /** Adds @p values of all processes where they belong; they are lost. Collective. */
  template <typename Number>
  void add(std::vector<Number> &values, Number *owned) const;

private:
  std::vector<dealii::types::global_dof_index> wanted;
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
  std::vector<unsigned int> places; ///< of each: local number, those of this process first
};
} // namespace hpvi

#endif
