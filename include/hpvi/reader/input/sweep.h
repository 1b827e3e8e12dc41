// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_sweep_h
#define hpvi_sweep_h

#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** An entry of a scene and the values that it takes one after the other. */
struct SweptEntry
{
  std::string path;                ///< "Section/Entry"
  std::vector<std::string> values; ///< two at least differ, where there are two
};

/**
 * Reads "Section/Entry=a, b, c". Values end at commas outside of parentheses, or at `|` where one stands that is
 * not part of `||`. Throws InputError where there is no entry, no value between two separators, or a value twice.
 */
SweptEntry swept_entry(const std::string &text);

/** Do both name the same entry, whatever blanks they have? */
bool is_same_entry(const std::string &path, const std::string &other);

/** One scene of a sweep. */
struct SweptScene
{
  std::vector<std::pair<std::string, std::string>>
      overrides;         ///< path of each swept entry, its value
  std::string directory; ///< its name below that of the sweep

  /** As in Material/Young's modulus = 3, Friction bound = 1. */
  std::string words() const;
};

/**
 * A scene for each combination of values, the last entry running fastest. Directories are ENTRY=VALUE, those of
 * several entries joined by commas: the entry without its section, what is no letter, digit, `.`, `-` or `+` of the first
 * hundred characters of the value as `_`; names that are taken already end with _2, _3 and so on. Throws InputError where two of
 * @p entries are the same.
 */
std::vector<SweptScene> swept_scenes(const std::vector<SweptEntry> &entries);
} // namespace hpvi

#endif
