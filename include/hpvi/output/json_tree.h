// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_json_tree_h
#define hpvi_json_tree_h

#include <boost/property_tree/ptree.hpp>

#include <optional>
#include <string>

namespace hpvi
{
/** JSON as it is read back. */
using JsonTree = boost::property_tree::ptree;

/** Nothing where @p text is no JSON. */
std::optional<JsonTree> json_tree(const std::string &text);

/** The member of this very name, where it is there and not null; paths of names are none, for names of boundaries have points. */
const JsonTree *member(const JsonTree &tree, const std::string &name);

/** Of that; empty. */
std::string words_of(const JsonTree &tree, const std::string &name);
} // namespace hpvi

#endif
