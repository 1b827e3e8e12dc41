// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_material_h
#define hpvi_material_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>
#include <hpvi/scene/initial_strain.h>
#include <hpvi/scene/orthotropy.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/** Which plane problem Section 2.1.3 of the thesis reduces Hooke's law to. */
enum class PlaneModel
{
  stress,
  strain,
  axisymmetric ///< no plane: a body of revolution, x the radius, y the axis
};

/**
 * Linear elasticity (thesis, Section 2.1), isotropic, `sigma = lambda tr(eps) I + 2 mu eps`, or with the general tensor (2.7) of
 * Orthotropy. Stages ask it and HookesLaw, which has the formulas; Lame's parameters are for closed forms and for
 * what is below.
 */
struct Material
{
  double young = 1.;                      ///< Young's modulus E > 0, a stress
  double poisson = 0.3;                   ///< Poisson's ratio nu in (-1, 1/2), dimensionless
  PlaneModel plane = PlaneModel::strain;  ///< used in two dimensions only
  double density = 0;                     ///< mass per volume, what gravity acts on
  std::string name{};                     ///< of its section; empty: the unnamed one
  std::optional<Orthotropy> orthotropy{}; ///< in the place of E and nu

  /** Shear modulus `mu = E/(2(1+nu))`; (2.9) prints E/(1+nu), which contradicts Hooke's law. */
  double mu() const
  {
    return young / (2 * (1 + poisson));
  }

  /**
   * First Lame parameter `E nu/((1+nu)(1-2nu))`; plane stress replaces it by
   * `2 lambda mu/(lambda + 2 mu)`. @p dim selects whether the plane model applies.
   */
  double lambda(const int dim) const
  {
    const double lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    return dim == 2 && plane == PlaneModel::stress ? 2 * lame * mu() / (lame + 2 * mu()) : lame;
  }

  /** Stress over shear [stress]: weighs residuals of parts with each other, makes tractions of displacements. */
  double residual_weight() const
  {
    return orthotropy ? orthotropy->shear : mu();
  }

  /** Stress over strain of a bar [stress], along the stiffest axis in the plane or in space. */
  double modulus(int dim) const;

  /**
   * How much stiffer against changes of volume, or along fibres, than against shear: low degrees lock where it is large.
   * lambda/mu, or what is the same and general: the largest by the least eigenvalue of C, less one.
   */
  double locking_ratio(int dim) const;

  /** Why it locks, for messages: "Poisson's ratio 0.4999 is near 1/2 (lambda/mu = 5e+03)". */
  std::string locking_in_words(int dim) const;

  /** For messages: "Young's modulus 210000". */
  std::string stiffness_in_words(int dim) const;

  /** As in "Young's modulus 200 MPa, Poisson's ratio 0.3"; for @p unit "" without. */
  std::string elasticity_in_words(const std::string &unit, int dim) const;

  /** sigma_zz of a plane stress or strain with @p sigma in the plane [stress] and the initial strain e33 across it: in an
   * axisymmetric body less its hoop strain. */
  double transverse_stress(const dealii::SymmetricTensor<2, 2> &sigma, double e33 = 0) const;

  /** What e33 stores in plane strain beside the strains in_plane(), `E_3 e33^2/2` [stress]: nothing lets the body become thicker. */
  double energy_across(double e33) const;

  /** What an initial strain is in the plane: there `sigma = C : (eps - result)`; in plane strain e33 presses, too. */
  dealii::SymmetricTensor<2, 2> in_plane(const PlaneStrain &initial) const;

  /** The same for both: in the plane in_plane(), in space the tensor of the components. */
  dealii::SymmetricTensor<2, 2> without_stress(const StrainComponents<2> &initial) const
  {
    return in_plane(initial);
  }
  dealii::SymmetricTensor<2, 3> without_stress(const StrainComponents<3> &initial) const;

  /**
   * Is lambda above 20 mu, as from nu = 0.476 on? Below, mixed methods are no better than others; orthotropic materials have
   * none.
   */
  bool is_nearly_incompressible(const int dim) const
  {
    return !orthotropy && lambda(dim) > 20. * mu();
  }

  /** By their names in expressions. */
  std::map<std::string, double> constants() const;

  /** What no material has: the entry that says it, why not, and its value. */
  struct Flaw
  {
    std::string entry, problem, value;
  };
  std::optional<Flaw> flaw() const;

  /** The largest c [stress] with `c eps : eps <= sigma(eps) : eps`. */
  double coercivity(int dim) const;

  /**
   * Kolosov's constant of plane elasticity, `(lambda + 3 mu)/(lambda + mu)`: 3 - 4 nu in plane
   * strain, (3 - nu)/(1 + nu) in plane stress.
   */
  double kolosov() const;
};

/** `Material` where @p name is empty, else `Material NAME`. */
std::string section_of_material(const std::string &name);

/**
 * Hooke's law of one material, with its moduli at hand for loops over points and unknowns. The
 * entry (i,j) of a gradient is `d u_i / d x_j`; where there is an initial strain, it is subtracted from that.
 */
template <int dim>
class HookesLaw
{
public:
  explicit HookesLaw(const Material &material)
      : is_isotropic(!material.orthotropy), lambda(is_isotropic ? material.lambda(dim) : 0.),
        mu(is_isotropic ? material.mu() : 0.)
  {
    if (is_isotropic)
      return;
    if constexpr (dim == 2)
    {
      S = material.orthotropy->compliance(material.plane);
      C = inverse(S);
    }
    else
    {
      S = material.orthotropy->compliance_in_space();
      C = material.orthotropy->stiffness_in_space();
    }
  }

  /** sigma of a displacement gradient [stress], in axisymmetric bodies with the strain @p hoop around the axis. */
  dealii::SymmetricTensor<2, dim> stress(const dealii::Tensor<2, dim> &gradient,
                                         const double hoop = 0.) const
  {
    if (!is_isotropic)
      return general_stress(gradient);
    const double pressure = lambda * (dealii::trace(gradient) + hoop);
    dealii::SymmetricTensor<2, dim> sigma;
    for (unsigned int i = 0; i < dim; ++i)
    {
      sigma[i][i] = 2 * mu * gradient[i][i] + pressure;
      for (unsigned int j = i + 1; j < dim; ++j)
        sigma[i][j] = mu * (gradient[i][j] + gradient[j][i]);
    }
    return sigma;
  }

  /** The stress around the axis, `lambda (tr eps + hoop) + 2 mu hoop` [stress]. */
  double hoop_stress(const dealii::Tensor<2, dim> &gradient, const double hoop) const
  {
    return lambda * (dealii::trace(gradient) + hoop) + 2 * mu * hoop;
  }

  /** `sigma n` [stress]. */
  dealii::Tensor<1, dim> traction(const dealii::Tensor<2, dim> &gradient,
                                  const dealii::Tensor<1, dim> &normal,
                                  const double hoop = 0.) const
  {
    return stress(gradient, hoop) * normal;
  }

  /** `div sigma` [stress/length] of second derivatives: @p second[i][j][k] is d_j d_k u_i. */
  dealii::Tensor<1, dim> divergence_of_stress(const dealii::Tensor<3, dim> &second) const
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int c = 0; c < dim; ++c)
    {
      if (is_isotropic)
        result[c] += mu * dealii::trace(second[c]);
      for (unsigned int d = 0; d < dim; ++d)
        if (is_isotropic)
          result[d] += (lambda + mu) * second[c][d][c];
        else
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int l = 0; l < dim; ++l)
              result[c] += C[voigt(c, d)][voigt(k, l)] * second[k][l][d];
    }
    return result;
  }

  /** `sigma : eps = lambda (tr eps)^2 + 2 mu eps : eps` [stress], twice the density of energy; @p hoop is one of its strains. */
  double energy_product(const dealii::Tensor<2, dim> &gradient, const double hoop = 0.) const
  {
    if (!is_isotropic)
      return dealii::scalar_product(dealii::Tensor<2, dim>(general_stress(gradient)), gradient);
    const dealii::Tensor<2, dim> strain = 0.5 * (gradient + dealii::transpose(gradient));
    const double divergence = dealii::trace(strain) + hoop;
    return lambda * divergence * divergence +
           2 * mu * (dealii::scalar_product(strain, strain) + hoop * hoop);
  }

  /** `s : C^-1 t` [stress] of two stresses, twice the density of complementary energy where they are one. */
  template <class Stress>
  double complementary_product(const Stress &s, const Stress &t) const
  {
    if (!is_isotropic)
    {
      double sum = 0;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int l = k; l < dim; ++l)
              sum += S[voigt(i, j)][voigt(k, l)] * s[i][j] * t[k][l];
      return sum;
    }
    const double nu = lambda / (dim * lambda + 2 * mu);
    return (dealii::scalar_product(s, t) - nu * dealii::trace(s) * dealii::trace(t)) / (2 * mu);
  }

  /** The factor of `(tr eps)^2` in energy_product() [stress], what locks where it is large; of isotropic materials. */
  double volume_modulus() const
  {
    return lambda;
  }

  /** What of a stress with this @p trace resists the change of volume, `lambda tr(eps)` [stress]; likewise. */
  double volumetric_stress(const double trace) const
  {
    return lambda / (dim * lambda + 2 * mu) * trace;
  }

  /**
   * a(phi e_c, psi e_d) of scalar functions phi and psi, from the integrals @p P(a, b) of
   * `d_a phi d_b psi` over a cell.
   */
  template <class Products>
  double stiffness(const Products &P, const unsigned int c, const unsigned int d) const
  {
    if (!is_isotropic)
    {
      double general = 0;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          general += C[voigt(c, a)][voigt(d, b)] * P(a, b);
      return general;
    }
    double sum = lambda * P(c, d) + mu * P(d, c);
    for (unsigned int a = 0; c == d && a < dim; ++a)
      sum += mu * P(a, a);
    return sum;
  }

  /**
   * What the hoop strains h = phi/x of phi e_0 and psi e_0 add to stiffness(), from the integrals @p Q(a) of `d_a phi psi/x`,
   * @p R(a) of `phi/x d_a psi`, and @p hoop of `phi psi/x^2`.
   */
  template <class One, class Other>
  double hoop_stiffness(const One &Q, const Other &R, const double hoop, const unsigned int c,
                        const unsigned int d) const
  {
    return (d == 0 ? lambda * Q(c) : 0.) + (c == 0 ? lambda * R(d) : 0.) +
           (c == 0 && d == 0 ? (lambda + 2 * mu) * hoop : 0.);
  }

private:
  static unsigned int voigt(const unsigned int i, const unsigned int j)
  {
    return hpvi::voigt<dim>(i, j);
  }

  dealii::SymmetricTensor<2, dim> general_stress(const dealii::Tensor<2, dim> &gradient) const
  {
    dealii::SymmetricTensor<2, dim> sigma;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            sigma[i][j] += C[voigt(i, j)][voigt(k, l)] * gradient[k][l];
    return sigma;
  }

  const bool is_isotropic;
  const double lambda, mu;
  Voigt<dim> C{}, S{}; ///< of others
};
} // namespace hpvi

#endif
