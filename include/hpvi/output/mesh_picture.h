// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mesh_picture_h
#define hpvi_mesh_picture_h

#include <hpvi/driver/step_report.h>

#include <string>

namespace hpvi
{
/**
 * The mesh of a step as scalable vector graphics: degrees as colours and as digits, axes in the
 * scene's unit of length, the contact boundary as a thick line.
 */
std::string mesh_picture(const StepReport<2> &step);
} // namespace hpvi

#endif
