// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/algebraic_multigrid.h>
#include <hpvi/space/rigid_motions.h>

#include <ml_MultiLevelPreconditioner.h>

namespace hpvi
{
template <int dim>
Teuchos::ParameterList algebraic_multigrid(std::vector<double> &motions)
{
  Teuchos::ParameterList parameters;
  ML_Epetra::SetDefaults("SA", parameters);
  parameters.set("ML output", 0);
  parameters.set("PDE equations", dim);
  parameters.set("null space: type", "pre-computed");
  parameters.set("null space: dimension", static_cast<int>(n_motions<dim>));
  parameters.set("null space: vectors", motions.data());
  parameters.set("aggregation: type", "Uncoupled");
  parameters.set("aggregation: threshold", 0.);
  parameters.set("coarse: type", "Amesos-KLU");
  parameters.set("coarse: max size", 2000);
  parameters.set("smoother: type", "Chebyshev");
  parameters.set("smoother: Chebyshev alpha", 10.);
  parameters.set("smoother: sweeps", 2);
  return parameters;
}

template Teuchos::ParameterList algebraic_multigrid<2>(std::vector<double> &);
template Teuchos::ParameterList algebraic_multigrid<3>(std::vector<double> &);
} // namespace hpvi
