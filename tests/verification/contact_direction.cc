// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact along a direction that is not the normal: forces node by node, what code may say of it, its picture.
#include "discretisation.h"

#include <hpvi/base/input_error.h>
#include <hpvi/output/scene_json.h>
#include <hpvi/reader/checks/checks.h>

#include <map>

namespace
{
using namespace verification;

const Tensor<1, 2> d({0.6, -0.8});

/** A skew block that is pressed down: no loads but those of contact on its bottom. */
Overrides pressed()
{
  return {given::quadrilateral("Geometry", "0, 0; 2, 0.3; 2.2, 1.3; 0.2, 1", "3, 2"),
          given::elastic("10", "0.3"),
          {"Boundary top/Displacement", "0.03; -0.1 - 0.05*x"},
          {"Boundary bottom/Contact direction", "3; -4"},
          given::steps("hup3", "2")};
}

struct ContactNode
{
  Point<2> x;
  Tensor<1, 2> u, force; ///< on the body, which its stress has to meet
};

/** Where the edges of contact have their nodes. */
std::vector<ContactNode> contact_nodes(const Solution<2> &solution)
{
  const DisplacementSpace<2> &space = solution.displacement_space;
  const Vector<double> forces =
      internal_forces(solution.scene, space, solution.tables, solution.u).forces;
  std::map<types::global_dof_index, ContactNode> nodes;
  for (const ContactFace<2> &face : solution.contact_space.faces())
  {
    const auto dofs = space.cell_dofs(face.cell->active_cell_index());
    const std::vector<unsigned int> &on_edge =
        solution.tables.numbering(face.degree).edge[face.face_no];
    for (unsigned int k = 0; k <= face.degree; ++k)
    {
      const auto x = dofs[on_edge[k]], y = dofs[on_edge[face.degree + 1 + k]];
      nodes[x] = {face.point(solution.tables.gauss_lobatto(face.degree + 1).point(k)[0]),
                  Tensor<1, 2>({solution.u[x], solution.u[y]}),
                  Tensor<1, 2>({forces[x], forces[y]})};
    }
  }
  std::vector<ContactNode> result;
  for (const auto &node : nodes)
    result.push_back(node.second);
  return result;
}

std::vector<ContactNode> solved(const Overrides &more)
{
  Overrides entries = pressed();
  entries.insert(entries.end(), more.begin(), more.end());
  std::vector<ContactNode> result;
  each_step<2>(scene_of(entries),
               [&](const StepReport<2> &step) { result = contact_nodes(step.solution()); });
  return result;
}

TEST(ContactDirection, WithoutFrictionForcesAreAlongIt)
{
  unsigned int n_pressed = 0, n_open = 0;
  for (const ContactNode &node :
       solved({{"Boundary bottom/Contact", "unilateral"}, {"Boundary bottom/Gap", "0.08*x"}}))
  {
    const double left = 0.08 * node.x[0] - node.u * d, pressure = -(node.force * d);
    EXPECT_NEAR(cross_product_2d(d) * node.force, 0., 1e-12);
    EXPECT_GE(pressure, -1e-12);
    EXPECT_GE(left, -1e-14);
    EXPECT_NEAR(pressure * left, 0., 1e-12);
    ++(pressure > 1e-3 ? n_pressed : n_open);
  }
  EXPECT_GT(n_pressed, 2u);
  EXPECT_GT(n_open, 2u);
}

TEST(ContactDirection, BilateralContactHoldsItAlone)
{
  for (const ContactNode &node : solved({{"Boundary bottom/Contact", "bilateral"}}))
  {
    EXPECT_NEAR(node.u * d, 0., 1e-15);
    EXPECT_NEAR(cross_product_2d(d) * node.force, 0., 1e-12);
  }
}

TEST(ContactDirection, FrictionIsAcrossIt)
{
  double along = 0, across = 0; // of all forces
  for (const ContactNode &node : solved({given::rough("bottom", "tangential", "0.001")}))
  {
    along += std::abs(node.force * d);
    across -= cross_product_2d(d) * node.force;
  }
  EXPECT_NEAR(along, 0., 1e-12);
  EXPECT_NEAR(std::abs(across), 0.001 * std::hypot(2, 0.3), 1e-12); // it slips everywhere
}

std::string refusal(const std::function<void(Scene<2> &)> &spoil)
{
  Overrides entries = pressed();
  entries.emplace_back("Boundary bottom/Contact", "bilateral");
  Scene<2> scene = scene_of(entries);
  spoil(scene);
  return failure_of<InputError>([&] { check(scene); });
}

TEST(ContactDirection, OfCodeIsAUnitVectorOutOfTheBody)
{
  using Direction = std::optional<Tensor<1, 2>>;
  const auto set = [](const std::string &name, const Direction &direction)
  { return [=](Scene<2> &scene) { scene.boundary(name).contact_direction = direction; }; };
  EXPECT_EQ(refusal(set("bottom", d)), "");
  EXPECT_EQ(refusal(set("bottom", Direction())), "");
  EXPECT_NE(refusal(set("bottom", 2. * d)).find("has the length 2"), std::string::npos);
  EXPECT_NE(refusal(set("bottom", -d)).find("does not point out of the body"), std::string::npos);
  EXPECT_NE(refusal(set("left", Tensor<1, 2>({-1., 0.}))).find("needs contact"), std::string::npos);
}

TEST(ContactDirection, HasArrowsAndWords)
{
  Overrides entries = pressed();
  entries.emplace_back("Boundary bottom/Contact", "unilateral");
  const std::string json = scene_json(scene_of(entries));
  EXPECT_NE(json.find("\"direction\": [0.6, -0.8]"), std::string::npos);
  EXPECT_NE(json.find("contact along (0.6 -0.8)"), std::string::npos);
  entries.emplace_back("Boundary bottom/Contact direction", "");
  EXPECT_EQ(scene_json(scene_of(entries)).find("\"direction\": ["), std::string::npos);
}
} // namespace
