// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_run_files_h
#define hpvi_run_files_h

#include <hpvi/output/record.h>
#include <hpvi/output/vtu_reader.h>

#include <boost/property_tree/ptree.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
using JsonTree = boost::property_tree::ptree;

/** What a directory of results holds of its run, up to the last finished step. */
struct RunFiles
{
  JsonTree summary;
  std::vector<Record> steps;   ///< rows of convergence.csv
  std::vector<Record> loads;   ///< rows of loading.csv
  std::vector<Record> history; ///< rows of contact-history.csv
  std::vector<Record> cycles;  ///< rows of cycles.csv
  std::vector<Record> forces;  ///< rows of forces.csv of the last step
  std::vector<Record> contact; ///< rows of contact-NN.csv of the last step
  std::string mesh;            ///< mesh-NN.svg of the last step; empty: there is none
  SampledField field;          ///< of solution-NN.vtu, also in pieces, of the last step
  std::string no_field;        ///< why it is empty
};

/** Reads them in space of @p dim dimensions; @p summary is the text of summary.json. Throws InputError where that is none. */
RunFiles read_run(const std::string &directory, const std::string &summary, unsigned int dim);

/** Nothing where @p text is no JSON. */
std::optional<JsonTree> json_tree(const std::string &text);

/** The member of this very name, where it is there and not null; paths of names are none, for names of boundaries have points. */
const JsonTree *member(const JsonTree &tree, const std::string &name);

/** Of that; empty. */
std::string words_of(const JsonTree &tree, const std::string &name);
std::optional<double> number_of(const JsonTree &tree, const std::string &name);
} // namespace hpvi

#endif
