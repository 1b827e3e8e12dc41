// SPDX-License-Identifier: LGPL-2.1-or-later
// In front of deal.II's own configuration where cell_operator.cc is built for wide vectors: the width is part of the names
// of all types that depend on it, so that these stand beside those of the library.
#include_next <deal.II/base/config.h>
#undef DEAL_II_VECTORIZATION_WIDTH_IN_BITS
#undef DEAL_II_COMPILER_VECTORIZATION_LEVEL
#if defined(__AVX512F__)
#define DEAL_II_VECTORIZATION_WIDTH_IN_BITS 512
#define DEAL_II_COMPILER_VECTORIZATION_LEVEL 3
#else
#define DEAL_II_VECTORIZATION_WIDTH_IN_BITS 256
#define DEAL_II_COMPILER_VECTORIZATION_LEVEL 2
#endif
