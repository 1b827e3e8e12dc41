// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_equilibration_cache_h
#define hpvi_equilibration_cache_h

#include <hpvi/algebra/triangular.h>
#include <hpvi/bound/cut_element.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/bound/patch_data.h>
#include <hpvi/bound/row_element.h>
#include <hpvi/bound/stress_element.h>
#include <hpvi/plane/load_rule.h>

#include <map>
#include <memory>
#include <vector>

namespace hpvi
{
/** What a patch problem depends on besides its data: its matrices, factored. */
struct PatchFactor
{
  PackedTriangle H;                  ///< L of the energy of the unknown tractions
  std::vector<unsigned int> present; ///< conditions with columns, others hold by what is known
  std::vector<unsigned int> chosen;  ///< places in present of those that imply all others
  std::vector<double> W;             ///< n x chosen: L^-1 C
  PackedTriangle S;                  ///< L of W'W
};

/** What a run keeps from step to step: elements by class, patches by signature. */
struct EquilibrationCache
{
  using Signature = std::vector<long>;
  LegendreTables legendre;

  const RowTable &row_table(unsigned int degree, unsigned int n_gauss,
                            unsigned int marked_corners); ///< threads may ask together
  std::map<std::array<unsigned int, 3>, RowTable> row_tables;
  std::map<Signature, std::unique_ptr<const StressElement>> elements;
  std::map<Signature, PatchData> data_of_modes; ///< by address of the element, p and n_force

  /** What few other cells can share: kept as long as each step uses it. */
  template <class T>
  struct Kept
  {
    T value;
    bool is_used = false;
  };
  std::map<Signature, Kept<std::unique_ptr<const RowElement>>> row_elements;
  std::map<Signature, Kept<std::unique_ptr<const CutElement>>> cut_elements;
  std::map<Signature, Kept<PatchFactor>> patches;
  std::map<CellKey, double> initial_stress_errors, ///< by cell and degree
      missed_forces;                               ///< by cell and 1000 m + p

  /** Which conditions imply all others, by the form of a patch: places in PatchFactor::present. */
  std::map<Signature, std::vector<unsigned int>> independent_conditions;

  /** Drops elements and patches that have not been used since the last call. */
  void drop_unused();
};
} // namespace hpvi

#endif
