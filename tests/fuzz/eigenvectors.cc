// SPDX-License-Identifier: LGPL-2.1-or-later
// clang gives a function of deal.II, the length of whose result is an expression, another name than the compiler of
// Debian's library did: here the one calls the other.
#include <deal.II/base/symmetric_tensor.h>

namespace
{
using Pairs = std::array<std::pair<double, dealii::Tensor<1, 3>>, 3>;
using Matrix = dealii::SymmetricTensor<2, 3>;
using Way = dealii::SymmetricTensorEigenvectorMethod;
} // namespace

Pairs in_library(const Matrix &A, Way way) __asm__(
    "_ZN6dealii12eigenvectorsILi3EdEESt5arrayISt4pairIT0_NS_6TensorILi1EXT_ES3_EEEXsrSt17integral_"
    "constantIiXT_EE5valueEE"
    "RKNS_15SymmetricTensorILi2EXT_ES3_EENS_32SymmetricTensorEigenvectorMethodE");

namespace dealii
{
template <>
Pairs eigenvectors(const Matrix &A, const Way way)
{
  return in_library(A, way);
}
} // namespace dealii
