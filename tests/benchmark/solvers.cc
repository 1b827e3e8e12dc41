// SPDX-License-Identifier: LGPL-2.1-or-later
// MUMPS against CHOLMOD, each with its Schur complement on the contact unknowns.
//
//   OMP_NUM_THREADS=1 solver_benchmark [SCENE.prm]
//
// Solves the scene with hpa2 to 60000 unknowns and stops at a few sizes on the way to compute
// S = B A^-1 B' twice from the same A and B. Both sides use the same BLAS, with one thread, and
// seconds are those of the processor: what else runs on the machine then counts less. The
// comparison leans towards MUMPS: CHOLMOD's seconds include the reduction of the load as well,
// those of MUMPS neither the conversion of A to triplets nor the set-up of its instance.
//
// MUMPS orders otherwise than asked for, without a word, where it lacks an ordering: where a Schur
// complement is asked for, 5.5.1 as Debian 12 builds it always takes AMD. So nested dissection is
// computed here and given to MUMPS, and its seconds count as analysis.
#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_templates.h>
#include <dmumps_c.h>
#include <hpvi/algebra/linear_solver.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/reader/scene_reader.h>
#include <metis.h>

#include <algorithm>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using namespace dealii;
using namespace hpvi;

constexpr unsigned int repetitions = 5;

// ---------------------------------------------------------------- MUMPS

/** What MUMPS calls its orderings, asked for in ICNTL(7) and reported in INFOG(7). */
const std::map<int, std::string> ordering_names = {{0, "AMD"},    {1, "given"}, {2, "AMF"},
                                                   {3, "SCOTCH"}, {4, "PORD"},  {5, "METIS"},
                                                   {6, "QAMD"},   {7, "auto"}};
constexpr int given = 1;

/** The upper triangle as MUMPS reads it: triplets, numbered from 1. */
struct Triplets
{
  unsigned int n;
  std::vector<int> row, column;
  std::vector<double> value;

  explicit Triplets(const SymmetricMatrix &A) : n(A.n()), row(A.row), value(A.value)
  {
    for (int &i : row)
      ++i;
    for (unsigned int j = 0; j < n; ++j)
      column.insert(column.end(), A.column_start[j + 1] - A.column_start[j], j + 1);
  }
};

/**
 * The position of each unknown, from 1: all others by METIS's nested dissection of their graph, then
 * @p last (numbered from 1) as they come.
 */
std::vector<int> nested_dissection(const Triplets &A, const std::vector<int> &last)
{
  std::vector<int> position(A.n, -1), number(A.n, -1);
  for (unsigned int k = 0; k < last.size(); ++k)
    position[last[k] - 1] = A.n - last.size() + k + 1;
  idx_t n = 0;
  for (unsigned int i = 0; i < A.n; ++i)
    if (position[i] < 0)
      number[i] = n++;

  std::vector<std::vector<idx_t>> neighbours(n);
  for (unsigned int k = 0; k < A.row.size(); ++k)
  {
    const int i = number[A.row[k] - 1], j = number[A.column[k] - 1];
    if (i >= 0 && j >= 0 && i != j)
    {
      neighbours[i].push_back(j);
      neighbours[j].push_back(i);
    }
  }
  std::vector<idx_t> start{0}, all, order(n), place(n);
  for (const auto &list : neighbours)
  {
    all.insert(all.end(), list.begin(), list.end());
    start.push_back(all.size());
  }
  const int status =
      METIS_NodeND(&n, start.data(), all.data(), nullptr, nullptr, order.data(), place.data());
  AssertThrow(status == METIS_OK, ExcMessage("METIS failed"));
  for (unsigned int i = 0; i < A.n; ++i)
    if (position[i] < 0)
      position[i] = place[number[i]] + 1;
  return position;
}

/** One instance of MUMPS for a positive definite matrix, released with its owner. */
class Mumps
{
public:
  Mumps(Triplets &A, std::vector<int> &schur_unknowns, std::vector<double> &schur,
        const int ordering)
      : A(A), schur_unknowns(schur_unknowns)
  {
    data.sym = 1; // positive definite: no pivoting
    data.par = 1;
    data.comm_fortran = MPI_Comm_c2f(MPI_COMM_WORLD);
    run(-1);
    for (const unsigned int stream : {1, 2, 3, 4})
      icntl(stream) = 0; // silent
    icntl(7) = ordering;
    icntl(19) = 1; // the dense Schur complement by rows
    icntl(28) = 1; // sequential analysis, the one that obeys ICNTL(7)
    data.n = A.n;
    data.nnz = A.value.size();
    data.irn = A.row.data();
    data.jcn = A.column.data();
    data.a = A.value.data();
    data.size_schur = schur_unknowns.size();
    data.listvar_schur = schur_unknowns.data();
    data.schur = schur.data();
  }

  ~Mumps()
  {
    data.job = -2;
    dmumps_c(&data);
  }

  Mumps(const Mumps &) = delete;
  Mumps &operator=(const Mumps &) = delete;

  void analyse()
  {
    if (data.icntl[7 - 1] == given)
    {
      positions = nested_dissection(A, schur_unknowns);
      data.perm_in = positions.data();
    }
    run(1);
  }
  void factorise()
  {
    run(2);
  }
  int ordering_used() const
  {
    return data.infog[7 - 1];
  }

private:
  int &icntl(const unsigned int number)
  {
    return data.icntl[number - 1];
  }

  void run(const int job)
  {
    data.job = job;
    dmumps_c(&data);
    if (data.infog[0] < 0)
      throw std::runtime_error("MUMPS, job " + std::to_string(job) +
                               ": INFOG(1) = " + std::to_string(data.infog[0]) +
                               ", INFOG(2) = " + std::to_string(data.infog[1]));
  }

  const Triplets &A;
  const std::vector<int> &schur_unknowns;
  std::vector<int> positions;
  DMUMPS_STRUC_C data{};
};

/**
 * `S = B_c C^-1 B_c'` by the Cholesky factorisation of the dense @p C, which is overwritten. MUMPS
 * returns the lower triangle by rows: for LAPACK, which counts by columns, the upper one.
 */
LAPACKFullMatrix<double> reduce_to_multiplier(std::vector<double> &C, const FullMatrix<double> &B)
{
  const types::blas_int n = B.n(), n_multipliers = B.m();
  types::blas_int info = 0;
  potrf("U", &n, C.data(), &n, &info);
  AssertThrow(info == 0, ExcMessage("the reduced matrix is not positive definite"));

  LAPACKFullMatrix<double> Y(n, n_multipliers);
  for (unsigned int m = 0; m < B.m(); ++m)
    for (unsigned int k = 0; k < B.n(); ++k)
      Y(k, m) = B(m, k);
  trtrs("U", "T", "N", &n, &n_multipliers, C.data(), &n, &Y(0, 0), &n, &info);
  LAPACKFullMatrix<double> S(n_multipliers, n_multipliers);
  Y.Tmmult(S, Y);
  return S;
}

// ---------------------------------------------------------------- measurements

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/** ||a - b|| / ||b|| in the Frobenius norm. */
double relative_difference(const LAPACKFullMatrix<double> &a, const LAPACKFullMatrix<double> &b)
{
  LAPACKFullMatrix<double> difference(a);
  difference.add(-1., b);
  return difference.frobenius_norm() / b.frobenius_norm();
}

/** Processor seconds since the last question. */
class Stopwatch
{
public:
  double lap()
  {
    const std::clock_t now = std::clock();
    const double seconds = double(now - start) / CLOCKS_PER_SEC;
    start = now;
    return seconds;
  }

private:
  std::clock_t start = std::clock();
};

/**
 * CHOLMOD and one ordering of MUMPS on one system, seconds of all repetitions. The two take turns,
 * so that a disturbance hits both and neither finds the caches as it left them.
 */
struct Comparison
{
  int asked, used = -1; ///< the ordering: MUMPS takes another one where this is not available
  std::vector<double> cholmod, analysis, factor, dense, total;
  double difference = 0; ///< largest relative difference between the two S

  Comparison(const Discretisation<2> &discretisation, const int ordering) : asked(ordering)
  {
    const ElasticSystem<2> &system = discretisation.system;
    const ConditionRows &rows = discretisation.contact_rows;
    Triplets A(system.A);
    std::vector<int> schur_unknowns;
    for (const unsigned int unknown : rows.interface)
      schur_unknowns.push_back(unknown + 1);
    for (unsigned int repetition = 0; repetition < repetitions; ++repetition)
    {
      Stopwatch watch;
      const LinearSolver solver(system.A, rows.interface, 0., {}, system.hints);
      const SchurComplement reference(solver, system.f, rows);
      cholmod.push_back(watch.lap());
      measure_mumps(A, schur_unknowns, dense_rows(rows), reference.S());
    }
  }

private:
  static FullMatrix<double> dense_rows(const ConditionRows &rows)
  {
    FullMatrix<double> B(rows.n_rows(), rows.interface.size());
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
      for (const auto &[place, weight] : rows.B[i])
        B(i, place) = weight;
    return B;
  }

  void measure_mumps(Triplets &A, std::vector<int> &schur_unknowns, const FullMatrix<double> &B,
                     const LAPACKFullMatrix<double> &expected)
  {
    std::vector<double> schur(schur_unknowns.size() * schur_unknowns.size());
    Mumps mumps(A, schur_unknowns, schur, asked);
    Stopwatch watch;
    mumps.analyse();
    analysis.push_back(watch.lap());
    mumps.factorise();
    factor.push_back(watch.lap());
    const LAPACKFullMatrix<double> S = reduce_to_multiplier(schur, B);
    dense.push_back(watch.lap());
    total.push_back(analysis.back() + factor.back() + dense.back());
    used = mumps.ordering_used();
    difference = std::max(difference, relative_difference(S, expected));
  }
};

// ---------------------------------------------------------------- the table

void print_head()
{
  std::cout
      << "dofs_free   N of A  contact multipliers  CHOLMOD | MUMPS   used    analysis   factor"
         "    dense    total  / CHOLMOD  difference of S"
      << std::endl;
}

void print_row(const unsigned int n_free_dofs, const Discretisation<2> &discretisation,
               const Comparison &comparison)
{
  const ConditionRows &rows = discretisation.contact_rows;
  const double cholmod = median(comparison.cholmod), mumps = median(comparison.total);
  std::cout << std::fixed << std::setprecision(4) << std::setw(9) << n_free_dofs << std::setw(9)
            << discretisation.system.A.n() << std::setw(9) << rows.interface.size() << std::setw(12)
            << rows.n_rows() << std::setw(9) << cholmod << " | " << std::left << std::setw(8)
            << ordering_names.at(comparison.asked) << std::setw(8)
            << ordering_names.at(comparison.used) << std::right << std::setw(8)
            << median(comparison.analysis) << std::setw(9) << median(comparison.factor)
            << std::setw(9) << median(comparison.dense) << std::setw(9) << mumps
            << std::setprecision(2) << std::setw(11) << mumps / cholmod << std::scientific
            << std::setprecision(1) << std::setw(17) << comparison.difference << std::endl;
}

void run(const std::string &file)
{
  const auto scene = read_scene<2>(file, {{"Adaptivity/Method", "hpa2"},
                                          {"Adaptivity/Maximum steps", "100"},
                                          {"Adaptivity/Maximum unknowns", "60000"}});
  AdaptiveSolver<2> solver(scene);
  double next_size = 1000;
  print_head();
  solver.run(
      [&](const StepReport<2> &step)
      {
        const unsigned int n_free_dofs = step.solution().displacement_space.n_free_dofs();
        if (n_free_dofs < next_size && step.stopped_by.empty())
          return;
        next_size = 2.5 * n_free_dofs;
        CondensedElements<2> elements(scene, step.solution().tables);
        const Discretisation<2> discretisation(scene, step.solution().spaces, elements);
        for (const int ordering : {0, 5, 6, 7, given})
          print_row(n_free_dofs, discretisation, Comparison(discretisation, ordering));
      });
}
} // namespace

int main(int argc, char *argv[])
{
  try
  {
    const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    run(argc > 1 ? argv[1] : "prm/han-6-12.prm");
    return 0;
  }
  catch (const std::exception &error)
  {
    std::cerr << error.what() << std::endl;
    return 1;
  }
}
