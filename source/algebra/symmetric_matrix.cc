// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/symmetric_matrix.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>

#include <limits>
#include <string>

namespace hpvi
{
namespace
{
template <class Number>
void reserve_in_large_pages(std::vector<Number> &numbers, const std::size_t n)
{
  if (n <= numbers.capacity())
    return;
  numbers.reserve(n);
  want_large_pages(numbers.data() + numbers.size(), (n - numbers.size()) * sizeof(Number));
}
} // namespace

void SymmetricMatrix::reserve(const std::size_t n_entries)
{
  constexpr std::size_t highest = std::numeric_limits<int>::max();
  if (n_entries > highest)
    throw NumericalFailure("the stiffness matrix has " + std::to_string(n_entries) +
                           " entries, its indices count to " + std::to_string(highest) +
                           "; lower Adaptivity/Maximum unknowns or take fewer "
                           "Geometry/Subdivisions");
  if (n_entries > row.size())
    require_memory(n_entries * double(sizeof(int) + sizeof(double)), "the stiffness matrix");
  reserve_in_large_pages(row, n_entries);
  reserve_in_large_pages(value, n_entries);
}

void SymmetricMatrix::resize(const std::size_t n_entries)
{
  reserve(n_entries);
  row.resize(n_entries);
  value.resize(n_entries);
}
} // namespace hpvi
