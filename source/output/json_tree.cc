// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/json_tree.h>

#define BOOST_BIND_GLOBAL_PLACEHOLDERS // as the parser still does; silences its note
#include <boost/property_tree/json_parser.hpp>

#include <sstream>

namespace hpvi
{
std::optional<JsonTree> json_tree(const std::string &text)
{
  JsonTree tree;
  std::istringstream in(text);
  try
  {
    boost::property_tree::read_json(in, tree);
  }
  catch (const boost::property_tree::ptree_error &)
  {
    return std::nullopt;
  }
  return tree;
}

const JsonTree *member(const JsonTree &tree, const std::string &name)
{
  const auto found = tree.find(name);
  return found == tree.not_found() || found->second.data() == "null" ? nullptr : &found->second;
}

std::string words_of(const JsonTree &tree, const std::string &name)
{
  const JsonTree *const found = member(tree, name);
  return found ? found->data() : "";
}
} // namespace hpvi
