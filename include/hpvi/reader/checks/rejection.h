// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_rejection_h
#define hpvi_rejection_h

#include <hpvi/base/parameter_file.h>
#include <hpvi/scene/scene.h>

#include <string>

namespace hpvi
{
/** "Section/Entry = value": as the file wrote it, else @p value, which functions do not have. */
template <int dim>
std::string mention(const Scene<dim> &scene, const std::string &section, const std::string &name,
                    const std::string &value = "");

/** Throws InputError, one line: the scene's origin, mention() and @p problem_and_remedy. */
template <int dim>
[[noreturn]] void reject(const Scene<dim> &scene, const std::string &section,
                         const std::string &name, const std::string &problem_and_remedy,
                         const std::string &value = "");

/** Rejects @p shown, a value that code may have set, where a file may not say it. */
template <int dim>
void check_value(const Scene<dim> &scene, const std::string &section, const std::string &name,
                 const std::string &shown);

/** Its section in a file. */
template <int dim>
std::string section_of(const BoundaryCondition<dim> &boundary)
{
  return boundary.pair ? "Contact " + boundary.pair_name : "Boundary " + boundary.name;
}

/** @p message about the coarse mesh of a box in the entries that this scene has: of its bodies, or of the file that is its mesh. */
template <int dim>
std::string in_entries_of(const Scene<dim> &scene, const std::string &message);

std::string name_of(Contact contact);
} // namespace hpvi

#endif
