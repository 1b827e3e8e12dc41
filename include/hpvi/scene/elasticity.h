// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_elasticity_h
#define hpvi_elasticity_h

#include <hpvi/scene/material.h>

#include <string>
#include <vector>

namespace hpvi
{
struct Entry;
class Parameters;

/** What the section of a material says of orthotropy in the plane: entries of the unnamed one, without section. */
std::vector<Entry> elasticity_entries();

/**
 * Sets @p material.orthotropy where its section says so, or the unnamed one whose entries it inherits. Its plane is known.
 * Refuses numbers that are missing and entries of the other kind of elasticity beside its own.
 */
void read_elasticity(const Parameters &parameters, Material &material);

/** As in "Young's modulus 200 MPa, Poisson's ratio 0.3"; for @p unit "" without. */
std::string elasticity_in_words(const Material &material, const std::string &unit);
} // namespace hpvi

#endif
