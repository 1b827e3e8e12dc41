// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_true_error_h
#define hpvi_true_error_h

#include <hpvi/results/contact_state.h>
#include <hpvi/results/stored_solution.h>
#include <hpvi/scene/exact_solution.h>

#include <limits>
#include <memory>
#include <vector>

namespace hpvi
{
/** Errors of a discrete solution; NaN where the scene gives nothing to compare with. */
struct TrueErrors
{
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double energy = unknown;           ///< |u - u_N|_a, (stress length^dim)^{1/2}
  double energy_norm = unknown;      ///< |u|_a, to relate it to
  double reference_energy = unknown; ///< J(u) of the exact or reference solution
  double l2 = unknown;               ///< |u - u_N|_{L2}, length^{1+dim/2}
  double multiplier_l2 = unknown;    ///< |lambda - z_N/g|_{L2(Gamma_C)}, length^{(dim-1)/2}
  double pressure_l2 = unknown;      ///< |p - lambda_Nn|_{L2(Gamma_C)}, stress length^{(dim-1)/2}
  double transition = unknown;       ///< largest distance from a transition of u to u_N's, length
  /** Against an exact solution alone: squares of energy and of multiplier_l2. */
  std::vector<double> of_cells; ///< by active cell index, zero on cells of other processes
  std::vector<double> of_faces; ///< by face of the field
};

/**
 * The true error of discrete solutions: against a field in closed form, by quadrature that is
 * graded towards its singular points, or against a stored reference solution, on the common
 * refinement of both meshes, where both are polynomials and Gauss quadrature is exact.
 */
template <int dim>
class TrueError
{
public:
  /** Takes what the scene names: its exact solution, else its reference solution. */
  explicit TrueError(const Scene<dim> &scene);
  ~TrueError();

  /** Of @p field, on whose contact boundaries @p contact happens. Collective. */
  TrueErrors measure(const Field<dim> &field, const std::vector<ContactState<dim>> &contact) const;

private:
  void compare_with_exact(const Field<dim> &field, const std::vector<ContactState<dim>> &contact,
                          TrueErrors &errors) const;
  void compare_with_reference(const Field<dim> &field, TrueErrors &errors) const;

  const Scene<dim> &scene;
  std::unique_ptr<const StoredSolution<dim>> reference;
};
} // namespace hpvi

#endif
