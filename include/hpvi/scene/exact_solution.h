// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_exact_solution_h
#define hpvi_exact_solution_h

#include <hpvi/scene/geometry.h>
#include <hpvi/scene/material.h>

#include <deal.II/base/function.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <vector>

namespace hpvi
{
/** A displacement field that solves the scene's problem in closed form. */
template <int dim>
class ExactSolution
{
public:
  virtual ~ExactSolution() = default;

  virtual dealii::Tensor<1, dim> displacement(const dealii::Point<dim> &x) const = 0;

  /** The entry (i,j) is `d u_i / d x_j`. */
  virtual dealii::Tensor<2, dim> gradient(const dealii::Point<dim> &x) const = 0;

  /** `lambda = -sigma_t/g` on the contact boundary; 0 without friction. */
  virtual double multiplier(const dealii::Point<dim> &x) const;

  /** `-T_n >= 0` [stress] on a contact boundary that may open; 0 where none does. */
  virtual double pressure(const dealii::Point<dim> &x) const;

  /** Points where the stress is not smooth, in space on lines along z: quadrature is graded towards them. */
  virtual std::vector<dealii::Point<dim>> singularities() const;

  /** Points of the contact boundary where its state changes: stick meets slip, contact ends. */
  virtual std::vector<dealii::Point<dim>> transitions() const;
};

/** One component of the displacement of an exact solution, for prescribed boundary values. */
template <int dim>
class ExactDisplacement : public dealii::Function<dim>
{
public:
  ExactDisplacement(std::shared_ptr<const ExactSolution<dim>> solution, unsigned int component);

  double value(const dealii::Point<dim> &x, unsigned int component = 0) const override;

private:
  const std::shared_ptr<const ExactSolution<dim>> solution;
  const unsigned int direction;
};

/** One component of the traction `sigma n` of an exact solution on a side of the body. */
template <int dim>
class ExactTraction : public dealii::Function<dim>
{
public:
  ExactTraction(std::shared_ptr<const ExactSolution<dim>> solution, const Material &material,
                const Side<dim> &side, unsigned int component);

  double value(const dealii::Point<dim> &x, unsigned int component = 0) const override;

private:
  const std::shared_ptr<const ExactSolution<dim>> solution;
  const Material material;
  const Side<dim> side;
  const unsigned int direction;
};
} // namespace hpvi

#endif
