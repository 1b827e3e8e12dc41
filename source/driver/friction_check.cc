// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/processes.h>
#include <hpvi/driver/friction_check.h>
#include <hpvi/reader/checks/rejection.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
void check_friction_by_pressure(const Field<dim> &field)
{
  const auto check_own = [&]()
  {
    for (const FieldFace<dim> &face : field.faces())
      if (face.condition->friction.by_pressure)
        for (const auto &[x, pressure] : field.pressures(face))
          if (const auto problem = face.condition->friction.problem(x, pressure))
            reject(field.scene, section_of(*face.condition), problem->entry,
                   "under the pressure of " + text(pressure, 4) + " that is there " +
                       problem->words);
  };
  collectively(field.communicator(), check_own);
}

template void check_friction_by_pressure(const Field<2> &);
template void check_friction_by_pressure(const Field<3> &);
} // namespace hpvi
