// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_result_class_h
#define hpvi_result_class_h

#include <pybind11/pybind11.h>

namespace hpvi
{
/** Adds what Python sees of a Result: `Result`, `Mesh`, and pictures by hpvi.plot. */
void add_result(pybind11::module_ &module);
} // namespace hpvi

#endif
