// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_text_h
#define hpvi_scene_text_h

#include <hpvi/base/parameter_file.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
class GivenMesh;

/**
 * A scene as it is written, which Python changes entry by entry; it is read, and checked, each time that it is asked or
 * solved. Functions throw InputError as read_scene() does.
 */
struct SceneText
{
  std::string file; ///< empty: entries are all that there is
  /** "Section/Entry", value, in the order in which they were set; of each entry one. */
  std::vector<std::pair<std::string, std::string>> entries;
  /** What Geometry, or each Body, is made of that names no File; null: files alone. */
  std::shared_ptr<const GivenMesh> mesh = nullptr;
  std::string mesh_file = {}; ///< into which that is written; empty: nowhere

  ParameterFile read() const; ///< all that is said

  void set(const std::string &path, const std::string &value);

  std::string
  value(const std::string &path) const; ///< of an entry, its default where it is not set

  std::string words() const; ///< of `hpvi --validate`
  std::string json() const;  ///< scene_json(), of which `hpvi --picture` draws
  std::string print() const; ///< scene.prm, every entry with its value
  std::string title() const;
};

/** Does the entry have components, which semicolons part, where commas part those of points? */
bool has_components(const std::string &path, const std::string &value);
} // namespace hpvi

#endif
