// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stop_reason_h
#define hpvi_stop_reason_h

#include <hpvi/driver/stop.h>
#include <hpvi/scene/scene.h>

#include <string>

namespace hpvi
{
/** Why a run is over: @p stopped_by as in StepReport, after a step with a bound of its error or without; @p by_coupling: one of Coulomb's law. */
std::string stop_reason(const StopReason &stopped_by, const Adaptivity &adaptivity, bool has_bound,
                        bool by_coupling);
} // namespace hpvi

#endif
