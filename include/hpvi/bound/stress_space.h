// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stress_space_h
#define hpvi_stress_space_h

#include <deal.II/base/tensor.h>
#include <hpvi/bound/modes.h>
#include <hpvi/scene/material.h>

#include <array>
#include <utility>
#include <vector>

namespace hpvi
{
/** The tensor product stresses of a StressElement, mode by mode: their energy and their data. */
class StressSpace
{
public:
  StressSpace(unsigned int degree, const dealii::Tensor<2, 2> &B, const Material &material);

  const unsigned int m;
  const unsigned int n_normal, n_tangential; ///< coefficients of a traction on an edge: m-1, m
  const unsigned int n_divergence, n_edges, n_data;

  /** Place of a coefficient of the traction of @p face among those of all edges. */
  unsigned int edge_entry(const unsigned int face, const unsigned int tangential) const
  {
    return face * (n_normal + n_tangential) + tangential * n_normal;
  }

protected:
  using Data = std::vector<std::pair<unsigned int, double>>; ///< row, entry

  /** Is there a mode of a component? By bits, which components have it? */
  bool has(unsigned int component, unsigned int i, unsigned int j) const;
  unsigned int present(unsigned int i, unsigned int j) const;

  /** @p data := those of one mode of S, none if there is no such mode. */
  void set_data(unsigned int component, unsigned int i, unsigned int j, Data &data) const;

  void subtract_data(const Modes<3> &q, double *r) const; ///< r -= A q

  /** C^-1 of a stress, as far as the space has its modes; and the stress of the space that has them. */
  Modes<3> moments(const Modes<3> &stress) const;
  Modes<3> inverse_compliance(const Modes<3> &moments) const;

  /** That of the space which is nearest in energy. */
  Modes<3> nearest(const Modes<3> &stress) const;

  std::array<std::array<double, 3>, 3> compliance; ///< C^-1 between components
  /** Inverse of compliance for the components of a mode that exist, by their bits. */
  std::array<std::array<std::array<double, 3>, 3>, 8> inverses;
  /** Of edges along eta (0) and xi (1): T_n of the normal component, T_t of it and of the shear. */
  std::array<std::array<double, 3>, 2> traction;

private:
  void set_compliance(const dealii::Tensor<2, 2> &B, const Material &material);
  void set_tractions(const dealii::Tensor<2, 2> &B);
  void set_nearest(unsigned int i, unsigned int j, const std::array<double, 3> &moments,
                   Modes<3> &result) const;
};
} // namespace hpvi

#endif
