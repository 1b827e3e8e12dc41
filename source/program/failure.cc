// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/output/output.h>
#include <hpvi/program/failure.h>
#include <hpvi/program/interruption.h>

#include <new>

namespace hpvi
{
bool is_foreseen(const std::exception &error)
{
  return dynamic_cast<const InputError *>(&error) ||
         dynamic_cast<const NumericalFailure *>(&error) ||
         dynamic_cast<const OutputFailure *>(&error) || dynamic_cast<const Interruption *>(&error);
}

namespace
{
/** Found too late for a line with numbers. */
bool is_failed_allocation(const std::exception &error)
{
  return dynamic_cast<const std::bad_alloc *>(&error) ||
         dynamic_cast<const dealii::StandardExceptions::ExcOutOfMemory *>(&error);
}
} // namespace

bool is_out_of_memory(const std::exception &error)
{
  return is_failed_allocation(error) || dynamic_cast<const MemoryFailure *>(&error);
}

std::string failure_line(const std::exception &error)
{
  if (is_failed_allocation(error))
    return "hpvi: out of memory; lower Adaptivity/Maximum unknowns, take fewer "
           "Geometry/Subdivisions or allow more memory";
  return (is_foreseen(error) ? "" : "hpvi: internal error: ") + one_line(error);
}

int exit_status(const std::exception &error)
{
  if (const auto *interruption = dynamic_cast<const Interruption *>(&error))
    return 128 + interruption->signal;
  return dynamic_cast<const InputError *>(&error) ? 1 : 2;
}

} // namespace hpvi
