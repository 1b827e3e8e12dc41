// SPDX-License-Identifier: LGPL-2.1-or-later

// Patches of one signature share a factor, and those of one form the choice of their conditions. Both are made by the first of them, to
// the last bit: so they are looked up in order, by one thread, and what is long in each step is done by all.
#include <hpvi/base/thread_pool.h>
#include <hpvi/bound/patches.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace hpvi
{
namespace
{
/** A patch whose factor is made. */
struct NewPatch
{
  PatchProblem *problem;
  PatchFactor *factor;
  EquilibrationCache::Signature form;
  bool is_settled = false;
};

/** New patches of one form, in order, and the conditions that the last of them has left as those to try. */
struct Form
{
  std::vector<unsigned int> *conditions;
  bool are_known;
  std::vector<NewPatch *> patches;
  unsigned int n_settled = 0;

  /** Where the conditions are not known, or not those of the next patch, its own are. */
  void renew()
  {
    if (are_known || n_settled == patches.size())
      return;
    patches[n_settled]->problem->renew(*conditions, *patches[n_settled]->factor);
    are_known = true;
    ++n_settled;
  }

  void count_settled()
  {
    while (n_settled < patches.size() && patches[n_settled]->is_settled)
      ++n_settled;
    are_known = n_settled == patches.size();
  }
};

std::vector<Form> forms_of(std::vector<NewPatch> &patches, EquilibrationCache &cache)
{
  std::vector<Form> result;
  std::map<EquilibrationCache::Signature, unsigned int> places;
  for (NewPatch &patch : patches)
  {
    const auto [place, is_first] = places.try_emplace(patch.form, result.size());
    if (is_first)
    {
      const auto [known, is_new] = cache.independent_conditions.try_emplace(patch.form);
      result.push_back({&known->second, !is_new, {}});
    }
    result[place->second].patches.push_back(&patch);
  }
  return result;
}

/** Conditions that imply all others, as each patch has them from the one before if they are independent. */
void choose_conditions(std::vector<NewPatch> &patches, EquilibrationCache &cache)
{
  std::vector<Form> forms = forms_of(patches, cache);
  std::vector<std::pair<const Form *, NewPatch *>> open;
  do
  {
    parallel_for_each(forms.size(), 1, [&](const unsigned int k) { forms[k].renew(); });
    open.clear();
    for (const Form &form : forms)
      for (unsigned int k = form.n_settled; k < form.patches.size(); ++k)
        open.emplace_back(&form, form.patches[k]);
    parallel_for_each(open.size(), 4,
                      [&](const unsigned int k)
                      {
                        const auto &[form, patch] = open[k];
                        patch->is_settled =
                            patch->problem->choose(*form->conditions, *patch->factor);
                      });
    for (Form &form : forms)
      form.count_settled();
  } while (!open.empty());
}
} // namespace

std::vector<PatchDefect> solve_patches(const std::vector<Patch> &patches, EquilibrationCache &cache)
{
  const unsigned int n = patches.size();
  constexpr unsigned int grain = 8;
  std::vector<std::optional<PatchProblem>> problems(n);
  std::vector<EquilibrationCache::Signature> signatures(n);
  parallel_for_each(n, grain,
                    [&](const unsigned int k)
                    {
                      problems[k].emplace(patches[k], cache);
                      signatures[k] = problems[k]->signature();
                    });
  std::vector<const PatchFactor *> factors;
  std::vector<NewPatch> new_patches;
  for (unsigned int k = 0; k < n; ++k)
  {
    const auto [found, is_new] = cache.patches.try_emplace(signatures[k]);
    found->second.is_used = true;
    factors.push_back(&found->second.value);
    if (is_new)
      new_patches.push_back({&*problems[k], &found->second.value, {}});
  }
  parallel_for_each(new_patches.size(), 2,
                    [&](const unsigned int k)
                    {
                      NewPatch &patch = new_patches[k];
                      patch.problem->set_matrices(*patch.factor);
                      patch.form = patch.problem->form(*patch.factor);
                    });
  choose_conditions(new_patches, cache);
  std::vector<PatchDefect> defects(n);
  parallel_for_each(n, grain,
                    [&](const unsigned int k) { defects[k] = problems[k]->solve(*factors[k]); });
  for (const std::optional<PatchProblem> &problem : problems)
    problem->add_tractions();
  return defects;
}
} // namespace hpvi
