// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_import_run_h
#define hpvi_import_run_h

#include <string>

namespace hpvi
{
/**
 * `hpvi --import`: the deck @p file as scene.prm and mesh.msh in @p directory, with import.txt, the list of what is left out,
 * which is printed, too. Throws InputError or OutputFailure; what another program has written there stays.
 */
void import_deck_into(const std::string &file, const std::string &directory);
} // namespace hpvi

#endif
