// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_primal_backend_h
#define hpvi_primal_backend_h

#include <hpvi/driver/backend.h>
#include <hpvi/space/contact_statics.h>
#include <hpvi/space/friction_iteration.h>
#include <hpvi/space/past_state.h>
#include <hpvi/space/primal_system.h>

namespace hpvi
{
/**
 * Newton's method on displacements and contact dofs: meshes of boxes, each body of one degree, in the plane and in
 * space, distributed over any number of processes; no dense matrix. Each step starts from the solution of
 * the one before.
 */
template <int dim>
class PrimalBackend : public Backend<dim>
{
public:
  /** Throws InputError where the path does not offer what the scene asks for. */
  PrimalBackend(const Scene<dim> &scene, MPI_Comm communicator);

  void discretise() override;
  void solve() override;
  const Field<dim> &field() const override;
  ProblemSize size() const override;
  ErrorEstimate estimate() override;
  Energies energies() override;
  NodalForces<dim> nodal_forces() override;
  std::optional<PrimalPart<dim>> primal() const override;
  double energy_high() override;
  BoundOfStep bound(double hysteresis) override;
  std::string bound_forces(const ErrorBound &, std::vector<Resultant<dim>> &) override
  {
    return "bodies in space have an interval of the energy alone";
  }
  double decay_rate(unsigned int cell) const override;
  double round_off_estimate() const override;
  void mark_unresolved(Refinement &) const override
  {
  }
  bool resolves_data() override;
  double missed(const std::optional<ErrorBound> &) const override
  {
    return 0.;
  }
  Warnings warnings(const std::vector<ContactState<dim>> &contact,
                    const Equilibrium<dim> &balance) const override;
  void refine(const Refinement &refinement) override;
  Degrees degrees() const override;
  SolutionValues values() const override;
  bool restore(const SolutionValues &values) override;
  std::unique_ptr<Backend<dim>> next_load_step(const Scene<dim> &scene,
                                               const PastSlip<dim> &past) override;

private:
  using Backend<dim>::scene;
  using Backend<dim>::times;
  using Backend<dim>::begin;

  PrimalBackend(const Scene<dim> &scene, MPI_Comm communicator,
                std::shared_ptr<typename PrimalSpace<dim>::Mesh> mesh);

  void number();
  void assemble();
  void reach_loads();
  void iterate(FrictionIteration<dim> &friction, NewtonMatrix<dim> &matrix, DistributedVector &v,
               const NewtonSettings &settings);
  NewtonSettings first_settings() const;
  bool is_exact(NewtonSettings &settings) const;
  PastState<dim> end_state() const;
  void take();

  const std::shared_ptr<typename PrimalSpace<dim>::Mesh> mesh;
  const DegreeTables<dim> tables;
  const ShapeTables<dim> shape_tables; ///< for its field
  std::unique_ptr<PrimalSpace<dim>> space;
  std::unique_ptr<PrimalSystem<dim>> system;     ///< of it; null before solve()
  std::unique_ptr<const ContactStatics> statics; ///< of both, where contact alone holds the body
  DistributedVector u;                           ///< on the current mesh, from the one before
  std::vector<ContactVector<dim>> lambda;        ///< likewise
  bool has_start = false;                        ///< are there both?
  std::optional<PastState<dim>> past;            ///< the end of the load step before, likewise
  std::unique_ptr<const Field<dim>> values_at_points; ///< of both
  ErrorEstimate estimated;                            ///< likewise
  double error =
      0; ///< estimated of the current step, or of the last one, in the energy norm; 0: none
  std::optional<Energies> known_energies; ///< of the current step
  NewtonReport report;                    ///< likewise
  std::optional<LinearMethod> given_way;  ///< what took the place of one that broke down
};
} // namespace hpvi

#endif
