// SPDX-License-Identifier: LGPL-2.1-or-later
// Fields in closed form: the primal path reproduces polynomials and converges at its rate to others.
#include "runs.h"

#include <hpvi/results/true_error.h>

#include <filesystem>
#include <fstream>

namespace
{
using namespace space;

/** A box of cells that are no cubes, with hanging nodes on all sides. */
Scene<3> graded_box(const unsigned int degree)
{
  Scene<3> scene;
  scene.materials[0].young = 7;
  scene.materials[0].poisson = 0.3;
  scene.geometry.corners = box_corners(Point<3>(-1, 0, 2), Point<3>(2, 1, 4));
  scene.geometry.subdivisions = {{2, 2, 1}};
  scene.geometry.graded_towards = {Point<3>(-1, 0, 2), Point<3>(2, 0, 4)};
  scene.geometry.grading_levels = 2;
  scene.adaptivity.start_degree = degree;
  scene.adaptivity.maximum_steps = 1;
  scene.solver.primal_tolerance = 1e-13;
  return scene;
}

const Tensor<1, 3> direction({3. / 13, 0., 4. * 3 / 13}); // of no length in particular

/** `u = B x + b` */
KnownField<3> linear(const Tensor<2, 3> &B, const Tensor<1, 3> &b)
{
  return {[=](const Point<3> &x) { return B * x + b; }, [=](const Point<3> &) { return B; }};
}

TEST(Exact, ConstantStress)
{
  const double entries[3][3] = {{0.1, 0.02, -0.3}, {0.05, -0.2, 0.07}, {0.11, 0.13, 0.17}};
  const KnownField<3> exact = linear(Tensor<2, 3>(entries), Tensor<1, 3>({0.4, -0.5, 0.6}));
  const Orthotropy fibres{{{50, 5, 7}},
                          {{0.3, 0.2, 0.25}},
                          3,
                          0,
                          {{4, 2}},
                          {{Tensor<1, 3>({1, 2, -1}), Tensor<1, 3>({0, 1, 3})}}};
  for (const auto &[degree, is_isotropic] : {std::make_pair(2U, true), std::make_pair(3U, true),
                                             std::make_pair(2U, false), std::make_pair(3U, false)})
  {
    Scene<3> scene = graded_box(degree);
    if (!is_isotropic)
      scene.materials[0].orthotropy = fibres;
    for (const char *const name : {"left", "bottom", "front"})
      prescribe(scene.boundary(name), exact);
    for (auto &boundary : scene.boundaries)
      if (!boundary.has_displacement())
      {
        Tensor<1, 3> normal;
        normal[boundary.id / 2] = 1;
        const Tensor<1, 3> traction =
            HookesLaw<3>(scene.materials[0]).traction(Tensor<2, 3>(entries), normal);
        for (unsigned int c = 0; c < 3; ++c)
          boundary.traction[c] = expression<3>(traction[c]);
      }
    steps_of<3>(scene,
                [&](const StepReport<3> &step)
                {
                  EXPECT_LT(energy_error(step, exact), 1e-10 * step.energies.norm);
                  EXPECT_LT(step.norms.total, 1e-9 * step.energies.norm);
                });
  }
}

/** Uniform slip askew to the axes on the bottom under uniform shear: u = (s + gamma y) n, lambda = n. */
TEST(Exact, UniformObliqueSlip)
{
  const double slip = 0.3, gamma = 0.2;
  const Tensor<1, 3> n = direction / direction.norm();
  Tensor<2, 3> B;
  for (unsigned int i = 0; i < 3; ++i)
    B[i][1] = gamma * n[i];
  const KnownField<3> exact = linear(B, slip * n);
  for (const unsigned int degree : {2U, 3U, 4U})
  {
    Scene<3> scene = graded_box(degree);
    for (const char *const name : {"left", "right", "front", "back"})
      prescribe(scene.boundary(name), exact);
    const double shear = gamma * scene.materials[0].mu();
    scene.boundary("bottom").contact = Contact::bilateral;
    scene.boundary("bottom").friction.bound = expression<3>(shear);
    for (unsigned int c = 0; c < 3; ++c)
      scene.boundary("top").traction[c] = expression<3>(shear * n[c]);
    scene.error_bound = degree < 4;
    const auto steps =
        steps_of<3>(scene,
                    [&](const StepReport<3> &step)
                    {
                      ASSERT_EQ(bool(step.bound), degree < 4) << step.no_bound;
                      // the root of a gap that is round-off
                      EXPECT_LT(step.bound ? step.bound->total : 0, 1e-7 * step.energies.norm);
                      EXPECT_LT(energy_error(step, exact), 1e-10 * step.energies.norm);
                      EXPECT_LT(step.energies.slack, 1e-10 * step.energies.norm);
                      for (const ContactPoint<3> &point : step.contact.at(0).points)
                      {
                        EXPECT_TRUE(point.slips);
                        EXPECT_LT((point.lambda - n).norm(), 1e-10);
                        EXPECT_LT((point.tangential_displacement - slip * n).norm(), 1e-10);
                        EXPECT_NEAR(point.normal_displacement, 0, 1e-14);
                        EXPECT_NEAR(point.normal_traction, 0, 1e-9);
                      }
                    });
    EXPECT_EQ(steps[0].n_slipping, steps[0].n_contact_points);
  }
}

/**
 * Contact along a direction d in space, under uniform stress: the bottom, whose traction is -p d - g s, slips by s at the distance of
 * the gap. Under Coulomb's law g is a share of p.
 */
TEST(Exact, UniformSlipAcrossADirection)
{
  const Tensor<1, 3> d = Tensor<1, 3>({0.3, -1., 0.2}) / Tensor<1, 3>({0.3, -1., 0.2}).norm();
  Tensor<2, 3> B;
  for (unsigned int i = 0; i < 3; ++i)
    B[i][1] = Tensor<1, 3>({0.1, -0.2, 0.15})[i];
  for (const unsigned int degree : {2U, 3U, 4U})
    for (const bool is_coulomb : {false, true})
    {
      Scene<3> scene = graded_box(degree);
      const Tensor<1, 3> T =
          HookesLaw<3>(scene.materials[0]).traction(B, Tensor<1, 3>({0., -1., 0.}));
      const double p = -(T * d), g = (T + p * d).norm(), gap = 0.05;
      const Tensor<1, 3> s = -(T + p * d) / g;
      const KnownField<3> exact = linear(B, 0.3 * s + gap * d);
      ASSERT_GT(p, 0.1);
      for (const char *const name : {"left", "right", "front", "back", "top"})
        prescribe(scene.boundary(name), exact);
      BoundaryCondition<3> &bottom = scene.boundary("bottom");
      bottom.contact = Contact::unilateral;
      bottom.contact_direction = d;
      bottom.gap = expression<3>(gap);
      (is_coulomb ? bottom.friction.coefficient : bottom.friction.bound) =
          expression<3>(is_coulomb ? g / p : g);
      scene.solver.normal_contact = NormalContact::multiplier;
      steps_of<3>(scene,
                  [&](const StepReport<3> &step)
                  {
                    EXPECT_LT(energy_error(step, exact), 1e-9 * step.energies.norm);
                    EXPECT_LT(step.norms.total, 1e-8 * step.energies.norm);
                    for (const ContactPoint<3> &point : step.contact.at(0).points)
                    {
                      EXPECT_TRUE(point.slips);
                      EXPECT_LT((point.lambda - s).norm(), 1e-8);
                      EXPECT_LT((point.tangential_displacement - 0.3 * s).norm(), 1e-9);
                      EXPECT_NEAR(point.normal_displacement, gap, 1e-9);
                      EXPECT_NEAR(point.normal_traction, -p, 1e-8);
                    }
                  });
    }
}

/**
 * A smooth field that slips everywhere, u = phi n with phi = exp((x + 2 z)/4) (1 + a y + y^2) + b y, so that
 * T_t = -mu d_y phi n on y = 0. Friction's bound is constant for a = 0.
 */
struct SmoothSlip
{
  const double a, b;
  const Tensor<1, 3> n = direction / direction.norm();

  static double along(const Point<3> &x)
  {
    return std::exp((x[0] + 2 * x[2]) / 4);
  }

  double psi(const Point<3> &x) const
  {
    return along(x) * (1 + a * x[1] + x[1] * x[1]);
  }

  double psi_y(const Point<3> &x) const
  {
    return along(x) * (a + 2 * x[1]);
  }

  double bound(const Material &material, const Point<3> &x) const
  {
    return material.mu() * (a * along(x) + b);
  }

  KnownField<3> field() const
  {
    const SmoothSlip self = *this;
    return {
        [self](const Point<3> &x) { return (self.psi(x) + self.b * x[1]) * self.n; },
        [self](const Point<3> &x)
        {
          const double psi = self.psi(x);
          return outer_product(self.n, Tensor<1, 3>({psi / 4, self.psi_y(x) + self.b, psi / 2}));
        }};
  }

  /** `-(lambda + mu) grad div u - mu Delta u`; div u = (n_x/4 + n_z/2) psi. */
  Tensor<1, 3> body_force(const Material &material, const Point<3> &x) const
  {
    const double divergence = n[0] / 4 + n[2] / 2, mu = material.mu(), psi = this->psi(x);
    return -((material.lambda(3) + mu) * divergence * Tensor<1, 3>({psi / 4, psi_y(x), psi / 2}) +
             mu * ((1. / 16 + 1. / 4) * psi + 2 * along(x)) * n);
  }
};

/** The unit cube with @p exact: prescribed all around but on the bottom, where it slips. */
Scene<3> slipping_cube(const SmoothSlip &exact, const unsigned int degree)
{
  const auto of = [](const auto &function)
  { return expression<3>(std::function<double(const Point<3> &)>(function)); };
  Scene<3> scene;
  scene.adaptivity.start_degree = degree;
  scene.adaptivity.method =
      std::array<Method, 3>{{Method::hup2, Method::hup3, Method::hup4}}[degree - 2];
  scene.adaptivity.maximum_steps = degree == 2 ? 4 : 3;
  scene.solver.primal_tolerance = 1e-12;
  const Material material = scene.materials[0];
  for (const char *const name : {"left", "right", "front", "back", "top"})
    prescribe(scene.boundary(name), exact.field());
  scene.boundary("bottom").contact = Contact::bilateral;
  scene.boundary("bottom").friction.bound =
      of([=](const Point<3> &x) { return exact.bound(material, x); });
  for (unsigned int c = 0; c < 3; ++c)
    scene.body_force[c] = of([=](const Point<3> &x) { return exact.body_force(material, x)[c]; });
  return scene;
}

/** The rate of the energy norm in h between the last two meshes. */
double rate(const Scene<3> &scene, const SmoothSlip &exact)
{
  std::vector<double> errors;
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                errors.push_back(energy_error(step, exact.field()));
                EXPECT_GT(step.scaled_estimate, 0.5 * errors.back());
                EXPECT_LT(step.scaled_estimate, 20 * errors.back());
              });
  return std::log2(errors[errors.size() - 2] / errors.back());
}

TEST(Exact, RatesOfASmoothFieldThatSlips)
{
  const SmoothSlip exact{0, 0.7};
  for (const unsigned int degree : {2U, 3U, 4U})
    EXPECT_NEAR(rate(slipping_cube(exact, degree), exact), degree, 0.15);
}

/** A bound that varies has a polynomial of degree p-2 in its place, which costs half an order. */
TEST(Exact, RatesWhereTheBoundVaries)
{
  const SmoothSlip exact{0.5, 0};
  for (const unsigned int degree : {3U, 4U})
    EXPECT_NEAR(rate(slipping_cube(exact, degree), exact), degree - 0.5, 0.15);
}

/** int g |u_t| over the faces of @p field, by Gauss rules on @p n squares along each edge of each. */
double friction_work(const Field<3> &field, const unsigned int n)
{
  const QGauss<2> gauss(field.degree(field.faces().front().cell) + 1);
  double sum = 0;
  for (const FieldFace<3> &face : field.faces())
  {
    std::vector<Point<3>> points;
    std::vector<double> weights;
    for (unsigned int k = 0; k < n * n; ++k)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        points.push_back(point_on_face<3>(face.face_no, Point<2>((k % n + gauss.point(q)[0]) / n,
                                                                 (k / n + gauss.point(q)[1]) / n)));
        weights.push_back(gauss.weight(q) / (n * n));
      }
    const ShapeTable<3> table = tabulate<3>(face.degree(), points, weights, false);
    const std::vector<double> u = evaluate(table.values, field.coefficients(face.cell));
    for (unsigned int q = 0; q < points.size(); ++q)
      sum += weights[q] * face.area() * field.bound(face, points[q]) *
             std::hypot(u[q], u[2 * points.size() + q]);
  }
  return sum;
}

/** |u_t| has a kink where u_t vanishes: one Gauss rule a face misses 1e-4 of the work of friction. */
TEST(Energy, ResolvesTheKinkOfFriction)
{
  steps_of<3>(slab({{"Adaptivity/Maximum steps", "2"}}),
              [](const StepReport<3> &step)
              {
                const double computed = step.energies.slack + step.field.contact_work(),
                             exact = friction_work(step.field, 100),
                             coarse = friction_work(step.field, 1);
                EXPECT_NEAR(computed, exact, 2e-6 * exact);
                EXPECT_GT(std::abs(coarse - exact), 5e-5 * exact);
              });
}

/** The same field for TrueError. */
class ExactSlip : public ExactSolution<3>
{
public:
  explicit ExactSlip(const SmoothSlip &slip) : field(slip.field())
  {
  }

  Tensor<1, 3> displacement(const Point<3> &x) const override
  {
    return field.value(x);
  }

  Tensor<2, 3> gradient(const Point<3> &x) const override
  {
    return field.gradient(x);
  }

private:
  const KnownField<3> field;
};

/** Against a field in closed form, and against a finer solution from a file, in space. */
TEST(TrueErrorInSpace, IsThatOfClosedFormsAndReferences)
{
  const SmoothSlip exact{0, 0.7};
  Scene<3> scene = slipping_cube(exact, 2), known = scene;
  known.exact_solution = std::make_shared<const ExactSlip>(exact);
  const std::string file = "reference-in-space.dat";
  Scene<3> fine = slipping_cube(exact, 4);
  fine.adaptivity.maximum_steps = 2;
  double J = 0;
  steps_of<3>(fine,
              [&](const StepReport<3> &step)
              {
                std::ofstream out(file);
                J = step.energies.energy;
                write_solution(out, step.field, J);
              });
  known.reference_solution = file;
  Scene<3> compared = known;
  compared.exact_solution = nullptr;
  const TrueError<3> closed(known), stored(compared);
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                const TrueErrors errors = closed.measure(step.field, step.contact),
                                 other = stored.measure(step.field, step.contact);
                const double expected = energy_error(step, exact.field());
                EXPECT_NEAR(errors.energy, expected, 5e-3 * expected);
                EXPECT_NEAR(other.energy, errors.energy, 5e-3 * errors.energy);
                EXPECT_NEAR(other.l2, errors.l2, 5e-3 * errors.l2);
                EXPECT_EQ(other.reference_energy, J);
                EXPECT_NEAR(errors.reference_energy, J,
                            1e-6 * errors.energy_norm * errors.energy_norm);
                EXPECT_LT(errors.multiplier_l2, 1e-4); // it slips everywhere, along one direction
                EXPECT_TRUE(std::isnan(other.multiplier_l2));
              });
  std::filesystem::remove(file);
}

/** u and stress where they are known; nothing outside the body. */
TEST(Field, SaysWhatHappensAtAPoint)
{
  const double entries[3][3] = {{0.1, 0.02, -0.3}, {0.05, -0.2, 0.07}, {0.11, 0.13, 0.17}};
  const Tensor<2, 3> B(entries);
  Scene<3> scene = graded_box(2);
  for (auto &boundary : scene.boundaries)
    prescribe(boundary, linear(B, Tensor<1, 3>()));
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                const Point<3> x(0.3, 0.7, 2.4);
                const auto value = step.field.at(x);
                ASSERT_TRUE(value.has_value());
                EXPECT_LT((value->displacement - B * x).norm(), 1e-10);
                EXPECT_LT((value->stress - HookesLaw<3>(scene.materials[0]).stress(B)).norm(),
                          1e-9);
                EXPECT_FALSE(step.field.at(Point<3>(0, 1.1, 3)).has_value());
              });
}
} // namespace
