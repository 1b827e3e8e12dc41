// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_material_reader_h
#define hpvi_material_reader_h

#include <hpvi/reader/input/parameters.h>
#include <hpvi/scene/material.h>

#include <string>
#include <vector>

namespace hpvi
{
/** The section of a material in a body of so many dimensions; one with a @p name inherits what it leaves out. */
std::vector<Entry> material_entries(int dim, const std::string &name);

/** What it says, but for orthotropy. */
Material read_material(const Parameters &parameters, int dim, const std::string &name);

/** Of the entry `Plane`. */
PlaneModel plane_model(const std::string &word);

/**
 * Sets @p material.orthotropy where its section says so, or the unnamed one whose entries it inherits. Its plane is known where
 * @p dim is 2. Refuses numbers that are missing and entries of the other kind of elasticity beside its own.
 */
void read_elasticity(const Parameters &parameters, int dim, Material &material);
} // namespace hpvi

#endif
