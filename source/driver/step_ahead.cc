// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/team.h>
#include <hpvi/driver/step_ahead.h>

#include <utility>

namespace hpvi
{
using namespace dealii;

template <int dim>
StepAhead<dim>::StepAhead(std::unique_ptr<Backend<dim>> next_step, Backend<dim> &here,
                          const std::function<void()> &tell)
    : next(std::move(next_step))
{
  const auto about_to = std::exchange(here.about_to, nullptr);
  const StageTimes before = std::exchange(here.times, {});
  double both = 0;
  {
    StageTimer timer(both);
    for_all(2, 1,
            [&](const unsigned int part)
            {
              if (part == 1)
                return tell();
              try
              {
                next->discretise();
                next->solve();
              }
              catch (...)
              {
                failure = std::current_exception();
              }
            });
  }
  const double share = both / (next->times.total() + here.times.total());
  next->times *= share;
  here.times *= share;
  here.times += before;
  here.about_to = about_to;
}

template <int dim>
std::unique_ptr<Backend<dim>> StepAhead<dim>::take()
{
  if (failure)
    std::rethrow_exception(failure);
  return std::move(next);
}

template class StepAhead<2>;
template class StepAhead<3>;
} // namespace hpvi
