// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/supervariables.h>

#include <algorithm>
#include <utility>

namespace hpvi
{
Supervariables::Supervariables(std::vector<unsigned int> numbers)
    : of(std::move(numbers)),
      last_split(of.empty() ? 0 : 1 + *std::max_element(of.begin(), of.end()), 0), moved(last_split)
{
}

void Supervariables::split(const std::vector<unsigned int> &some)
{
  ++n_splits;
  for (const unsigned int unknown : some)
  {
    unsigned int &number = of[unknown];
    if (last_split[number] != n_splits)
    {
      last_split[number] = n_splits;
      moved[number] = moved.size();
      moved.push_back(0);
      last_split.push_back(0);
    }
    number = moved[number];
  }
}

std::vector<unsigned int> Supervariables::numbers() const
{
  constexpr unsigned int none = -1;
  std::vector<unsigned int> of_number(moved.size(), none), result;
  unsigned int n = 0;
  for (const unsigned int number : of)
  {
    if (of_number[number] == none)
      of_number[number] = n++;
    result.push_back(of_number[number]);
  }
  return result;
}
} // namespace hpvi
