// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/html.h>

namespace hpvi
{
namespace
{
std::string row(const std::vector<std::string> &fields, const std::string &tag)
{
  std::string line = "<tr>";
  for (const std::string &field : fields)
    line += element(tag, field);
  return line + "</tr>\n";
}
} // namespace

std::string element(const std::string &tag, const std::string &words, const std::string &classes)
{
  return "<" + tag + (classes.empty() ? "" : " class=\"" + classes + '"') + ">" + xml_text(words) +
         "</" + tag + ">";
}

std::string html(const HtmlTable &table)
{
  if (table.rows.empty())
    return {};
  std::string text = "<table>\n<thead>" + row(table.head, "th") + "</thead>\n<tbody>\n";
  for (const std::vector<std::string> &fields : table.rows)
    text += row(fields, "td");
  return text + "</tbody>\n</table>\n";
}

std::string figure(const std::string &svg, const std::string &words)
{
  return "<figure>\n" + svg + element("figcaption", words) + "\n</figure>\n";
}

std::string missing(const std::string &words)
{
  return element("p", words, "missing") + "\n";
}
} // namespace hpvi
