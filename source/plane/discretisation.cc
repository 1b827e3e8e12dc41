// SPDX-License-Identifier: LGPL-2.1-or-later

// One step is a chain of objects, each complete from its constructor and constant from then on. The
// order of members is the order of computation, and what an object needs is in its argument list.
// To see what depends on what, read the initialiser lists.
#include <hpvi/base/dense_work.h>
#include <hpvi/base/memory.h>
#include <hpvi/plane/discretisation.h>
#include <hpvi/plane/initial_stress.h>
#include <hpvi/plane/matching.h>

namespace hpvi
{
using namespace dealii;

// @sect3{Spaces}
//
// Before any integral: the displacement space (3.57) with all of its constraints, the contact faces
// with the unknowns of friction and pressure (3.58), and the operator $b(v,z)$ between both. They
// are shared with the solution, which outlives the step.
template <int dim>
Spaces<dim>::Spaces(const Scene<dim> &scene,
                    std::shared_ptr<const Triangulation<dim>> triangulation, const Degrees &degrees,
                    std::shared_ptr<const ShapeTables<dim>> shape_tables,
                    std::shared_ptr<const LoadRules<dim>> rules, PastSlip<dim> past_slip)
    : mesh(std::move(triangulation)), tables(std::move(shape_tables)),
      loads(rules ? std::move(rules)
                  : std::make_shared<const LoadRules<dim>>(scene, *mesh, tables)),
      past(std::move(past_slip)), displacement_space(scene, *mesh, degrees, *tables, loads.get()),
      contact_space(scene, displacement_space, *tables, past),
      contact_operator(displacement_space, contact_space, *tables)
{
}

template <int dim>
std::string Spaces<dim>::no_error_bound(const Scene<dim> &scene) const
{
  if (const std::string why = hpvi::no_error_bound(scene); !why.empty())
    return why;
  for (const ContactFace<dim> &face : contact_space.faces())
    if (face.past && (!face.segments.empty() || has_given_tractions(contact_space)))
      return "friction between bodies, along curves and directions and around an axis counts slip "
             "from the load step before";
  return "";
}

template <int dim>
void Spaces<dim>::keep_bound(const Scene<dim> &scene, Refinement &refinement) const
{
  if (scene.error_bound && !scene.has_coulomb_friction() && no_error_bound(scene).empty())
    keep_matching(contact_space, *mesh, refinement);
}

// @sect3{Discretisation}
//
// If supports leave the body a motion without strain, $A$ is singular and $S = BA^{-1}B^T$ does not
// exist. Friction or unilateral contact may still hold the body; then the balance of forces along
// each free motion becomes an equality constraint of the quadratic program. A body that is held has
// none of this.
namespace
{
/** How far the normals of polynomial edges between bodies are off those of their curves; a foundation has pressures at nodes. */
template <int dim>
double precision_of_normals(const ContactSpace<dim> &contact_space)
{
  double result = 0;
  for (const ContactFace<dim> &face : contact_space.faces())
    for (const double s : {0., 0.25, 0.5, 0.75, 1.})
      if (face.condition->pair && face.map.is_curved())
        result = std::max(result, (face.node_frame(s).normal - face.frame(s).normal).norm());
  return result;
}

template <int dim>
std::optional<RigidMotions<dim>>
motions_of(const Scene<dim> &scene, const Spaces<dim> &spaces, const Unknowns<dim> &unknowns,
           const ConditionRows &rows, const ElasticSystem<dim> &system)
{
  const std::vector<RigidBodyMotion<dim>> basis = scene.free_motions();
  if (basis.empty())
    return std::nullopt;
  return RigidMotions<dim>(basis, scene.geometry, spaces.displacement_space, unknowns, rows,
                           spaces.contact_space.multipliers(), system,
                           precision_of_normals(spaces.contact_space));
}
} // namespace

// The second half of the chain: <code>unknowns</code> counts what the linear system is solved for,
// with moments in the place of contact nodes; <code>contact_rows</code> is $B$ in these unknowns;
// <code>condensation</code> takes the interior of each cell away, as no other cell sees it; and
// <code>system</code> is $A$ and $f$.
template <int dim>
Discretisation<dim>::Discretisation(const Scene<dim> &scene,
                                    std::shared_ptr<const Spaces<dim>> all_spaces,
                                    CondensedElements<dim> &elements)
    : scene(scene), spaces(std::move(all_spaces)),
      unknowns(spaces->displacement_space, spaces->contact_operator, *spaces->tables),
      contact_rows(unknowns.contact_rows()), condensation(spaces->displacement_space, elements),
      system(scene, spaces->displacement_space, unknowns, condensation, *spaces->tables,
             *spaces->loads, elements),
      free_motions(motions_of(scene, *spaces, unknowns, contact_rows, system))
{
}

// The way back: from the unknowns $x$ to displacements on the boundaries of cells, and from there
// into their interior.
template <int dim>
Vector<double> Discretisation<dim>::displacement(const Vector<double> &x) const
{
  Vector<double> u = unknowns.distribute(x);
  condensation.extend(u);
  if (has_interior_loads(scene))
    condensation.add_interior(system.loads(), u);
  return u;
}

// The unknowns of contact are to be eliminated last. Dense matrices of their size follow; whether
// memory suffices for both is asked before either begins.
template <int dim>
void Discretisation<dim>::factor(LinearSolver &other) const
{
  other.factor_again(system.A, stabilisation());
}

template <int dim>
std::vector<Stabilisation> Discretisation<dim>::stabilisation() const
{
  return free_motions ? free_motions->stabilisation() : std::vector<Stabilisation>();
}

template <int dim>
LinearSolver Discretisation<dim>::factor() const
{
  const DenseWork dense{contact_rows.interface.size(), contact_rows.n_rows()};
  if (dense.n_multipliers > 0)
    require_memory(dense.bytes(), dense.name());
  return LinearSolver(system.A, contact_rows.interface,
                      dense.n_multipliers > 0 ? dense.bytes() : 0., stabilisation(), system.hints);
}

template class Spaces<2>;
template class Discretisation<2>;
} // namespace hpvi
