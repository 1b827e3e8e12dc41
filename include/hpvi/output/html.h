// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_html_h
#define hpvi_html_h

#include <string>
#include <vector>

namespace hpvi
{
/** A table of plain texts; the first column is left-aligned, numbers stand on the right. */
struct HtmlTable
{
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

/** Nothing where there are no rows. */
std::string html(const HtmlTable &table);

/** Plain @p words between <TAG class="CLASSES"> and its end. */
std::string element(const std::string &tag, const std::string &words,
                    const std::string &classes = "");

/** A picture, SVG as it stands, with plain @p words below. */
std::string figure(const std::string &svg, const std::string &words);

/** What is missing, in the place of a picture. */
std::string missing(const std::string &words);
} // namespace hpvi

#endif
