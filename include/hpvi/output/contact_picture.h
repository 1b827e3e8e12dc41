// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_picture_h
#define hpvi_contact_picture_h

#include <hpvi/output/record.h>

#include <string>
#include <vector>

namespace hpvi
{
/**
 * Of one contact boundary in space, rows of contact-NN.csv: its states and the pressure on it, side by side, seen along the
 * axis in which it extends least. @p unit is that of stress.
 */
std::string contact_picture(const std::vector<Record> &contact, const std::string &unit);
} // namespace hpvi

#endif
