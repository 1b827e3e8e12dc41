// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_listing_h
#define hpvi_scene_listing_h

#include <string>

namespace hpvi
{
/**
 * The text of scene.prm as HTML, whole; what stands at its default has the class `default`, by which a printer
 * can leave it out.
 */
std::string scene_listing(const std::string &scene_prm, int dim);
} // namespace hpvi

#endif
