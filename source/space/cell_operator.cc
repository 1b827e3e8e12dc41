// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/cell_operator.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/hp/q_collection.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

#ifdef HPVI_WIDE
// deal.II's library has what follows for its own width alone; degrees are those of mappings, for products know theirs.
#define FE_EVAL_FACTORY_DEGREE_MAX 2
#include <deal.II/matrix_free/dof_info.templates.h>
#include <deal.II/matrix_free/evaluation_kernels_hanging_nodes.h>
#include <deal.II/matrix_free/evaluation_template_factory.templates.h>
#include <deal.II/matrix_free/mapping_info.templates.h>
#include <deal.II/matrix_free/matrix_free.templates.h>
#include <deal.II/matrix_free/shape_info.templates.h>

DEAL_II_NAMESPACE_OPEN
namespace internal
{
/** Nobody asks for faces, which would take time to compile. */
template <int dim, typename Number>
void FEFaceEvaluationFactory<dim, Number>::evaluate(const unsigned int,
                                                    const EvaluationFlags::EvaluationFlags,
                                                    const Number *,
                                                    FEEvaluationData<dim, Number, true> &)
{
  AssertThrow(false, ExcNotImplemented());
}

/** Of the degrees that products have; those above are the mappings'. */
template <int dim, typename Number, typename Wide>
void FEEvaluationHangingNodesFactory<dim, Number, Wide>::apply(
    const unsigned int n_components, const unsigned int degree,
    const MatrixFreeFunctions::ShapeInfo<Wide> &shape, const bool transpose,
    const std::array<MatrixFreeFunctions::compressed_constraint_kind, Wide::size()> &hanging,
    Wide *values)
{
  using Kernel = FEEvaluationImplHangingNodes<dim, Wide>;
  const auto run = degree == 2   ? &Kernel::template run<2, 3>
                   : degree == 3 ? &Kernel::template run<3, 4>
                                 : &Kernel::template run<4, 5>;
  run(n_components, shape, transpose, hanging, values);
}
} // namespace internal
DEAL_II_NAMESPACE_CLOSE
#endif

namespace hpvi
{
using namespace dealii;

namespace
{
/** Moduli of the cells of a batch. */
template <typename Wide, class Stiffness>
struct Law;

template <typename Wide>
struct Law<Wide, IsotropicStiffness>
{
  Wide volume, shear;

  void set(const unsigned int v, const IsotropicStiffness &own)
  {
    volume[v] = own.volume;
    shear[v] = own.shear;
  }

  Tensor<2, 3, Wide> stress(const Tensor<2, 3, Wide> &gradient) const
  {
    const Wide pressure = volume * trace(gradient);
    Tensor<2, 3, Wide> result;
    for (unsigned int i = 0; i < 3; ++i)
    {
      result[i][i] = 2. * shear * gradient[i][i] + pressure;
      for (unsigned int j = 0; j < i; ++j)
        result[i][j] = result[j][i] = shear * (gradient[i][j] + gradient[j][i]);
    }
    return result;
  }
};

template <typename Wide>
struct Law<Wide, GeneralStiffness>
{
  std::array<Wide, 21> C; ///< the upper triangle, row by row

  static constexpr unsigned int place(const unsigned int i, const unsigned int j)
  {
    return i < j ? i * (11 - i) / 2 + j : j * (11 - j) / 2 + i;
  }

  void set(const unsigned int v, const GeneralStiffness &own)
  {
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = i; j < 6; ++j)
        C[place(i, j)][v] = own[i][j];
  }

  Tensor<2, 3, Wide> stress(const Tensor<2, 3, Wide> &gradient) const
  {
    const std::array<Wide, 6> strain{
        {gradient[0][0], gradient[1][1], gradient[2][2], gradient[0][1] + gradient[1][0],
         gradient[0][2] + gradient[2][0], gradient[1][2] + gradient[2][1]}};
    std::array<Wide, 6> sigma;
    for (unsigned int i = 0; i < 6; ++i)
    {
      sigma[i] = C[place(i, 0)] * strain[0];
      for (unsigned int j = 1; j < 6; ++j)
        sigma[i] += C[place(i, j)] * strain[j];
    }
    Tensor<2, 3, Wide> result;
    for (unsigned int i = 0; i < 3; ++i)
    {
      result[i][i] = sigma[i];
      for (unsigned int j = 0; j < i; ++j)
        result[i][j] = result[j][i] = sigma[2 + i + j];
    }
    return result;
  }
};

template <typename Number, class Stiffness>
class ElasticOperator : public CellOperator<Number>
{
public:
  using Vector = typename CellOperator<Number>::Vector;

  ElasticOperator(const Mapping<3> &mapping, const DoFHandler<3> &dof_handler,
                  const AffineConstraints<Number> &constraints,
                  const std::vector<Stiffness> &stiffness)
  {
    typename Cells::AdditionalData settings;
    settings.tasks_parallel_scheme = Cells::AdditionalData::none;
    settings.mapping_update_flags = update_gradients | update_JxW_values;
    hp::QCollection<3> rules; // as many as elements
    for (const FiniteElement<3> &element : dof_handler.get_fe_collection())
    {
      degrees.push_back(element.degree);
      rules.push_back(QGauss<3>(element.degree + 1));
    }
    cells.reinit(mapping, dof_handler, constraints, rules, settings);
    const bool is_uniform = stiffness.size() == 1;
    laws.resize(is_uniform ? 1 : cells.n_cell_batches());
    for (unsigned int batch = 0; batch < laws.size(); ++batch)
      for (unsigned int v = 0; v < Wide::size(); ++v)
      {
        const bool is_cell = !is_uniform && v < cells.n_active_entries_per_cell_batch(batch);
        laws[batch].set(v,
                        stiffness[is_cell ? cells.get_cell_iterator(batch, v)->material_id() : 0]);
      }
  }

  void multiply(Vector &y, const Vector &x) const override
  {
    cells.template cell_loop<Vector, Vector>(
        [this](const Cells &, Vector &to, const Vector &from,
               const std::pair<unsigned int, unsigned int> &range)
        { add_product(to, from, range); },
        y, x, /*zero_dst_vector=*/true);
  }

  void reinit(Vector &v) const override
  {
    cells.initialize_dof_vector(v);
  }

  const std::vector<unsigned int> &constrained() const override
  {
    return cells.get_constrained_dofs();
  }

private:
  using Cells = MatrixFree<3, Number>;
  using Wide = VectorizedArray<Number>;

  /** Cells of a range have one degree. */
  void add_product(Vector &y, const Vector &x,
                   const std::pair<unsigned int, unsigned int> &range) const
  {
    switch (degrees[cells.get_cell_active_fe_index(range)])
    {
    case 2:
      return add_product_of<2>(y, x, range);
    case 3:
      return add_product_of<3>(y, x, range);
    default:
      return add_product_of<4>(y, x, range);
    }
  }

  template <int degree>
  void add_product_of(Vector &y, const Vector &x,
                      const std::pair<unsigned int, unsigned int> &range) const
  {
    FEEvaluation<3, degree, degree + 1, 3, Number> values(cells, range);
    for (unsigned int batch = range.first; batch < range.second; ++batch)
    {
      values.reinit(batch);
      values.gather_evaluate(x, EvaluationFlags::gradients);
      const Law<Wide, Stiffness> &law = laws[laws.size() == 1 ? 0 : batch];
      for (unsigned int q = 0; q < values.static_n_q_points; ++q)
        values.submit_gradient(law.stress(values.get_gradient(q)), q);
      values.integrate_scatter(EvaluationFlags::gradients, y);
    }
  }

  Cells cells;
  std::vector<unsigned int> degrees;        ///< by element
  AlignedVector<Law<Wide, Stiffness>> laws; ///< by batch of cells; of one material alone: one entry
};
} // namespace

template <typename Number, class Stiffness>
std::unique_ptr<CellOperator<Number>>
make_cell_operator(const Mapping<3> &mapping, const DoFHandler<3> &dof_handler,
                   const AffineConstraints<Number> &constraints,
                   const std::vector<Stiffness> &stiffness)
{
  for (const FiniteElement<3> &element : dof_handler.get_fe_collection())
    if (!has_cell_operator(element.degree))
      return nullptr;
  return std::make_unique<ElasticOperator<Number, Stiffness>>(mapping, dof_handler, constraints,
                                                              stiffness);
}

template std::unique_ptr<CellOperator<double>>
make_cell_operator(const Mapping<3> &, const DoFHandler<3> &, const AffineConstraints<double> &,
                   const std::vector<IsotropicStiffness> &);
template std::unique_ptr<CellOperator<float>>
make_cell_operator(const Mapping<3> &, const DoFHandler<3> &, const AffineConstraints<float> &,
                   const std::vector<IsotropicStiffness> &);
template std::unique_ptr<CellOperator<double>>
make_cell_operator(const Mapping<3> &, const DoFHandler<3> &, const AffineConstraints<double> &,
                   const std::vector<GeneralStiffness> &);
template std::unique_ptr<CellOperator<float>>
make_cell_operator(const Mapping<3> &, const DoFHandler<3> &, const AffineConstraints<float> &,
                   const std::vector<GeneralStiffness> &);
} // namespace hpvi
