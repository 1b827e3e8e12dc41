// SPDX-License-Identifier: LGPL-2.1-or-later
// Moments and nodes of both directions as unknowns, and multipliers that go from mesh to mesh.
#include "opening_contact.h"

#include <hpvi/plane/multiplier_trace.h>

namespace
{
using namespace verification;

// ---------------------------------------------------------------- unknowns

struct ContactKind
{
  std::string name;
  Contact contact;
  bool has_friction;
  NormalContact normal;
  int offset = -2;
};

const std::vector<ContactKind> kinds = {
    {"Bilateral", Contact::bilateral, true, NormalContact::nodes},
    {"BilateralLess", Contact::bilateral, true, NormalContact::nodes, -3},
    {"BilateralMore", Contact::bilateral, true, NormalContact::nodes, -1},
    {"Tangential", Contact::tangential, true, NormalContact::nodes},
    {"TangentialLess", Contact::tangential, true, NormalContact::multiplier, -3},
    {"TangentialMore", Contact::tangential, true, NormalContact::multiplier, -1},
    {"Nodes", Contact::unilateral, false, NormalContact::nodes},
    {"NodesFriction", Contact::unilateral, true, NormalContact::nodes},
    {"NodesFrictionLess", Contact::unilateral, true, NormalContact::nodes, -3},
    {"NodesFrictionMore", Contact::unilateral, true, NormalContact::nodes, -1},
    {"Multiplier", Contact::unilateral, false, NormalContact::multiplier},
    {"MultiplierLess", Contact::unilateral, false, NormalContact::multiplier, -3},
    {"MultiplierMore", Contact::unilateral, false, NormalContact::multiplier, -1},
    {"MultiplierFriction", Contact::unilateral, true, NormalContact::multiplier},
    {"MultiplierFrictionLess", Contact::unilateral, true, NormalContact::multiplier, -3},
    {"MultiplierFrictionMore", Contact::unilateral, true, NormalContact::multiplier, -1}};

/** Bodies with level, upright and slanted contact edges, at different angles of their corners. */
const std::vector<Turned> bodies = {{"Box", {{{0, 0}, {3, 0}, {3, 2}, {0, 2}}}, 0.},
                                    {"Slanted", {{{0, 0}, {3, 0.5}, {2.5, 2}, {0.2, 1.7}}}, 0.},
                                    {"Turned", {{{0, 0}, {3, 0}, {3, 2}, {0, 2}}}, 2.5}};

/** Two neighbouring contact edges, the third side held; what is held moves the end of a contact edge. */
Scene<2> scene_with(const ContactKind &kind, const Turned &body, const bool corner_is_held)
{
  Scene<2> scene;
  scene.geometry = body.geometry(2, 2);
  scene.solver.normal_contact = kind.normal;
  scene.solver.multiplier_offset = kind.offset;
  BoundaryCondition<2> &bottom = scene.boundary("bottom");
  bottom.contact = kind.contact;
  if (kind.contact == Contact::unilateral)
    bottom.gap = expression<2>([](const Point<2> &x) { return 5 + 0.1 * x[0] * x[1] - x[1]; });
  if (kind.has_friction)
    bottom.friction.bound = expression<2>(1.);
  if (kind.contact != Contact::bilateral && corner_is_held)
    scene.boundary("left").displacement = {
        {expression<2>([](const Point<2> &x) { return 0.3 - 0.1 * x[1]; }), expression<2>(0.2)}};
  else if (kind.contact != Contact::bilateral)
  {
    BoundaryCondition<2> &left = scene.boundary("left");
    left.contact = bottom.contact;
    left.gap = bottom.gap;
    left.friction = bottom.friction;
  }
  scene.boundary("top").displacement = {
      {expression<2>(0.1), expression<2>([](const Point<2> &x) { return x[0]; })}};
  return scene;
}

class ContactUnknowns : public ::testing::TestWithParam<std::tuple<ContactKind, Turned, bool>>
{
protected:
  const ContactKind kind = std::get<0>(GetParam());
  const Scene<2> scene = scene_with(kind, std::get<1>(GetParam()), std::get<2>(GetParam()));
  const RandomMesh mesh{scene, 3, 1, 3, 7};
  const Spaces<2> spaces{scene, borrowed(mesh.mesh), mesh.degrees,
                         std::make_shared<const ShapeTables<2>>()};
  const Unknowns<2> unknowns{spaces.displacement_space, spaces.contact_operator, *spaces.tables};
  const ConditionRows rows = unknowns.contact_rows();
  const ContactOracle oracle{spaces, kind.normal};
  std::mt19937 random{11};

  Vector<double> random_vector(const unsigned int n)
  {
    std::uniform_real_distribution<double> uniform(-1., 1.);
    Vector<double> x(n);
    for (double &value : x)
      value = uniform(random);
    return x;
  }

  void are_what_the_displacement_has();
  void describe_displacements_of_the_space();
  void have_the_conditions_of_their_displacement();
  void feel_the_forces_of_the_multiplier();
  void have_the_weights_of_their_basis();
  void make_moments_diagonal();
};

void ContactUnknowns::are_what_the_displacement_has()
{
  const Vector<double> x = random_vector(unknowns.n());
  Vector<double> back = unknowns.coordinates(unknowns.expand(x));
  back -= x;
  EXPECT_LE(back.linfty_norm(), 1e-13);
}

void ContactUnknowns::describe_displacements_of_the_space()
{
  const AffineConstraints<double> &constraints = spaces.displacement_space.constraints();
  const Vector<double> x = random_vector(unknowns.n()), u = unknowns.distribute(x);
  Vector<double> again = u;
  constraints.distribute(again);
  for (const auto &cell : spaces.displacement_space.dof_handler().active_cell_iterators())
  {
    const auto dofs = spaces.displacement_space.cell_dofs(cell->active_cell_index());
    const unsigned int n_boundary = spaces.tables->numbering(cell->get_fe().degree).n_boundary;
    for (unsigned int i = 0; i < n_boundary; ++i)
      EXPECT_NEAR(again[dofs[i]], u[dofs[i]], 1e-12);
  }
}

void ContactUnknowns::have_the_conditions_of_their_displacement()
{
  ASSERT_EQ(rows.n_rows(), oracle.gap.size());
  ASSERT_GT(rows.n_rows(), 0u);
  for (const double factor : {0., 1.})
  {
    Vector<double> x = random_vector(unknowns.n());
    x *= factor;
    const Vector<double> u = unknowns.distribute(x);
    EXPECT_GT(u.linfty_norm(), 0.);
    Vector<double> moments(rows.n_rows());
    oracle.B.vmult(moments, u);
    const Vector<double> own = spaces.contact_operator.moments(u);
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
    {
      double sum = rows.prescribed[i];
      for (const auto &[place, weight] : rows.B[i])
        sum += weight * x[rows.interface[place]];
      EXPECT_NEAR(own[i], moments[i], 1e-12);
      EXPECT_NEAR(sum, moments[i] - oracle.gap[i], 1e-12);
    }
  }
}

/** `T'(B' z)` is B' z of the unknowns: the reactions work as the conditions measure. */
void ContactUnknowns::feel_the_forces_of_the_multiplier()
{
  const Vector<double> z = random_vector(rows.n_rows());
  const Vector<double> forces = spaces.contact_operator.forces(z);
  Vector<double> expected(forces.size());
  oracle.B.Tvmult(expected, z);
  for (unsigned int i = 0; i < forces.size(); ++i)
    EXPECT_NEAR(forces[i], expected[i], 1e-12);
  Vector<double> collected = unknowns.collect(forces);
  for (unsigned int i = 0; i < rows.n_rows(); ++i)
    for (const auto &[place, weight] : rows.B[i])
      collected[rows.interface[place]] -= weight * z[i];
  EXPECT_LE(collected.linfty_norm(), 1e-12);
}

void ContactUnknowns::have_the_weights_of_their_basis()
{
  double length = 0, sum = 0, friction = 0;
  for (const ContactFace<2> &face : spaces.contact_space.faces())
    length += face.length;
  for (unsigned int i = 0; i < oracle.weight.size(); ++i)
  {
    const ContactMultiplier<2> &unknown = spaces.contact_space.multipliers()[i];
    EXPECT_NEAR(unknown.weight, oracle.weight[i], 1e-13);
    EXPECT_NEAR(unknown.gap, oracle.gap[i], 1e-13);
    EXPECT_GT(unknown.weight, 0.);
    (unknown.kind == ContactMultiplier<2>::Kind::friction ? friction : sum) += unknown.weight;
  }
  EXPECT_NEAR(friction, kind.has_friction ? length : 0., 1e-12);
  if (kind.contact == Contact::unilateral && kind.normal == NormalContact::multiplier)
  {
    EXPECT_NEAR(sum, length, 1e-12);
  }
}

/** One entry in a row where a moment is an unknown, or a node that no constraint binds. */
void ContactUnknowns::make_moments_diagonal()
{
  if (kind.offset != -2) // others keep nodal values
    return;
  const auto &multipliers = spaces.contact_space.multipliers();
  for (unsigned int i = 0; i < rows.n_rows(); ++i)
    if (multipliers[i].kind == ContactMultiplier<2>::Kind::friction ||
        kind.normal == NormalContact::multiplier)
    {
      ASSERT_EQ(rows.B[i].size(), 1u);
      EXPECT_EQ(rows.B[i][0].second, multipliers[i].weight);
      EXPECT_EQ(rows.prescribed[i], -multipliers[i].gap);
    }
}

TEST_P(ContactUnknowns, AreConsistent)
{
  are_what_the_displacement_has();
  describe_displacements_of_the_space();
  have_the_conditions_of_their_displacement();
  feel_the_forces_of_the_multiplier();
  have_the_weights_of_their_basis();
  make_moments_diagonal();
}

INSTANTIATE_TEST_SUITE_P(, ContactUnknowns,
                         ::testing::Combine(::testing::ValuesIn(kinds), ::testing::ValuesIn(bodies),
                                            ::testing::Bool()),
                         [](const auto &info)
                         {
                           return std::get<0>(info.param).name + std::get<1>(info.param).name +
                                  (std::get<2>(info.param) ? "Held" : "TwoContacts");
                         });

// ---------------------------------------------------------------- from mesh to mesh

/** @p mesh, refined at random once more with other degrees. */
RandomMesh finer(const Scene<2> &scene, const RandomMesh &mesh, const unsigned int seed,
                 const unsigned int lowest)
{
  RandomMesh result(scene, seed, 0);
  result.mesh.clear();
  result.mesh.copy_triangulation(mesh.mesh);
  std::mt19937 random(seed);
  refine_at_random(result.mesh, 2, random);
  result.degrees = random_degrees(result.mesh, lowest, 8, random);
  return result;
}

/** Pressure and friction that are polynomials along the edges are the same polynomials on a finer mesh. */
TEST(MultiplierTrace, CarriesPolynomialsExactly)
{
  for (const ContactKind &kind : kinds)
    for (const Turned &body : bodies)
      for (const bool held : {false, true})
      {
        SCOPED_TRACE(kind.name + " " + body.name + (held ? " held" : ""));
        const Scene<2> scene = scene_with(kind, body, held);
        const unsigned int lowest = 4; // the multiplier of offset -3 has degree 1
        const RandomMesh coarse(scene, 3, 1, lowest), fine = finer(scene, coarse, 4, lowest);
        const auto tables = std::make_shared<const ShapeTables<2>>();
        const Spaces<2> first(scene, borrowed(coarse.mesh), coarse.degrees, tables),
            second(scene, borrowed(fine.mesh), fine.degrees, tables);
        const ContactSpace<2> &one = first.contact_space, &two = second.contact_space;
        const auto value = [&](const ContactMultiplier<2> &unknown)
        {
          const double slope = unknown.kind == ContactMultiplier<2>::Kind::pressure ? 0.7 : -0.3;
          // Pressures at nodes are one polynomial on each edge, with one value at a common corner.
          return 1.3 + slope * unknown.x[0] + 0.2 * unknown.x[1];
        };
        Vector<double> z(one.n_multipliers());
        for (unsigned int i = 0; i < z.size(); ++i)
          z[i] = value(one.multipliers()[i]);
        const Vector<double> start = MultiplierTrace<2>(one, z).values(two, *tables);
        ASSERT_EQ(start.size(), two.n_multipliers());
        ASSERT_GT(start.size(), z.size() / 2);
        for (unsigned int i = 0; i < start.size(); ++i)
          EXPECT_NEAR(start[i], value(two.multipliers()[i]), 1e-12);
      }
}
} // namespace
