// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_space_reduced_path_h
#define hpvi_space_reduced_path_h

#include "runs.h"

#include <array>

namespace space
{
/** In the plane the reduced path has the same contact dofs and pressures. */
inline void expect_reduced_path(const Scene<2> &scene)
{
  std::vector<std::vector<ContactMode>> modes;
  std::vector<std::vector<Point<2>>> transitions;
  std::vector<std::array<double, 2>> resultants; // of T_n, T_t
  std::vector<Step> reduced;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        reduced.push_back({step.solution().displacement_space.degrees().size(),
                           step.solution().displacement_space.n_free_dofs(), 0, 0,
                           step.energies.lagrangian, step.energies.energy, step.estimate.total(),
                           step.energies.norm});
        modes.emplace_back();
        transitions.push_back(step.contact[0].transitions);
        resultants.push_back(
            {{step.contact[0].normal_resultant, step.contact[0].friction_resultant}});
        for (const ContactPoint<2> &point : step.contact[0].points)
          modes.back().push_back(point.mode());
      });
  unsigned int k = 0;
  steps_of<2>(scene,
              [&](const StepReport<2> &step)
              {
                ASSERT_LT(k, reduced.size());
                EXPECT_EQ(step.size.n_cells, reduced[k].n_cells);
                EXPECT_EQ(step.primal->space.n_free, reduced[k].n_free);
                EXPECT_NEAR(step.energies.lagrangian, reduced[k].lagrangian,
                            1e-9 * std::abs(reduced[k].lagrangian));
                EXPECT_NEAR(step.energies.norm, reduced[k].norm, 1e-9 * reduced[k].norm);
                EXPECT_NEAR(step.norms.total, reduced[k].estimate, 1e-7 * reduced[k].estimate);
                EXPECT_NEAR(step.energies.energy, reduced[k].energy,
                            1e-9 * std::abs(reduced[k].energy));
                const ContactState<2> &state = step.contact.at(0);
                ASSERT_EQ(state.points.size(), modes[k].size());
                for (unsigned int i = 0; i < modes[k].size(); ++i)
                  EXPECT_EQ(state.points[i].mode(), modes[k][i]) << state.points[i].x;
                EXPECT_EQ(state.transitions, transitions[k]);
                EXPECT_NEAR(state.normal_resultant, resultants[k][0], 1e-7);
                EXPECT_NEAR(state.friction_resultant, resultants[k][1], 1e-7);
                ++k;
              });
  EXPECT_EQ(k, reduced.size());
}
} // namespace space

#endif
