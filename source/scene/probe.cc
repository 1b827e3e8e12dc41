// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/probe.h>

namespace hpvi
{
template <int dim>
std::vector<std::string> columns_of(const Probe<dim> &probe)
{
  std::vector<std::string> result;
  if (probe.kind == ProbeKind::line)
    return result;
  for (unsigned int d = 0; d < dim; ++d)
    for (const char *const end : {"", "_bound"})
      result.push_back(probe.name + "_u" + "xyz"[d] + end);
  for (const char *const stress : {"_s1", "_s2", dim == 2 ? "_szz" : "_s3", "_mises"})
    result.push_back(probe.name + stress);
  return result;
}

template std::vector<std::string> columns_of(const Probe<2> &);
template std::vector<std::string> columns_of(const Probe<3> &);
} // namespace hpvi
