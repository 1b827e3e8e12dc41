// SPDX-License-Identifier: LGPL-2.1-or-later
// A block lies on a plane and is pushed to the right; friction alone holds it.
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/reader/checks/checks.h>

#include <exception>
#include <iomanip>
#include <iostream>

using namespace hpvi;

int main()
try
{
  Scene<2> scene;
  scene.geometry.corners = box_corners<2>({0, 0}, {2, 1});
  scene.geometry.subdivisions = {{4, 2}};
  scene.materials = {{/*young=*/10., /*poisson=*/0.3, PlaneModel::stress}};
  scene.boundary("left").traction[0] = expression<2>(0.3);
  BoundaryCondition<2> &bottom = scene.boundary("bottom");
  bottom.contact = Contact::bilateral;
  bottom.friction.bound = expression<2>([](const dealii::Point<2> &x) { return 0.1 * (1 + x[0]); });
  scene.adaptivity.tolerance = 0.01;
  check(scene);

  AdaptiveSolver<2>(scene).run(
      [](const StepReport<2> &step)
      {
        if (step.stopped_by.empty())
          return; // it goes on
        std::cout << std::setprecision(12) << "x,normal_traction,tangential_traction,bound,state\n";
        for (const ContactPoint<2> &point : step.contact.front().points)
          std::cout << point.x[0] << ',' << point.normal_traction << ','
                    << point.tangential_traction << ',' << point.friction_bound << ','
                    << (point.slips ? "slip" : "stick") << '\n';
        std::cerr << "stopped by " << step.stopped_by << ", relative error at most "
                  << step.relative_bound << ", force of the plane "
                  << step.equilibrium.reactions.front().force << '\n';
      });
}
catch (const std::exception &error)
{
  std::cerr << error.what() << '\n';
  return 1;
}
