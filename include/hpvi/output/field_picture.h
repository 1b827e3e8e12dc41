// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_field_picture_h
#define hpvi_field_picture_h

#include <hpvi/output/record.h>
#include <hpvi/output/vtu_reader.h>
#include <hpvi/scene/scene.h>

#include <string>
#include <vector>

namespace hpvi
{
/** A picture as SVG, and what to know of it. */
struct FieldPicture
{
  std::string svg, caption;
};

/**
 * von Mises' stress on the deformed body in colours that the colour-blind tell apart, with a colour bar; displacements are as
 * many times larger as one can see. In the plane dashed the body before, and along @p contact, rows of contact-NN.csv, its
 * states. In space seen from below, where contact mostly is.
 */
template <int dim>
FieldPicture stress_picture(const Scene<dim> &scene, const SampledField &field,
                            const std::vector<Record> &contact);

/** Polynomial degrees of the cells, where a mesh is too large to draw each of them. */
std::string degree_picture(const SampledField &field);
} // namespace hpvi

#endif
