// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_metamorphic_random_scene_h
#define hpvi_metamorphic_random_scene_h

#include "fibres.h"
#include "frame.h"

#include <array>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace metamorphic
{
/** What a side or a part of it says; functions of X and Y in [0,1], the coordinates along sides 0 and 3; empty: nothing. */
struct Side
{
  std::array<std::string, 2> displacement, traction; ///< in the axes of the body
  std::string pressure, shear;                       ///< along its normal, its tangent
  std::string contact, gap, bound, coefficient, law;
  std::array<std::string, 2> spring{}; ///< k_n, k_t
  std::optional<double>
      turn; ///< of the direction of contact from the normal, counterclockwise; nothing: is not said
  std::array<std::string, 2> force{}; ///< on a rigid plate, in the axes of the body
  std::string moment;                 ///< likewise; empty: there is no plate
  unsigned int on = 0;                ///< the side
  std::string where;                  ///< the part; empty: what parts leave
};

/** One beside the first; what another has is not its. */
struct OtherMaterial
{
  std::string where;
  double young = 1, poisson = 0.3, density = 0;
  std::optional<Fibres> fibres{};
};

/** Its name, its entries with their values. */
using Section = std::pair<std::string, std::vector<std::pair<std::string, std::string>>>;

/** A problem without a frame, and how it is solved. */
struct RandomScene
{
  explicit RandomScene(std::mt19937 &random);

  /** Of two materials either may be the one without a name. */
  void exchange_materials();

  /** The scene as a file, told in @p frame. */
  std::string text(const Frame &frame) const;

  /** The frame of the body itself: all others start from it. */
  Frame own_frame() const;

  bool needs_axes() const; ///< is one component prescribed, and the other not?
  bool is_held() const;    ///< without its contact
  bool has_polynomial_data() const;
  bool is_isotropic() const;
  bool has(std::string Side::*entry) const;
  bool has_plates() const;
  bool has_springs() const; ///< which stay where they are when all else moves
  bool has_initial_strain() const;
  bool has_direction() const; ///< of contact, which has no bound and no other path then

  /** Along which @p side has contact, in the axes of the body. */
  Tensor<1, 2> contact_direction(const Side &side) const;

  bool is_box = false, has_probe = false;
  std::array<Point<2>, 4> corners; ///< counterclockwise, side k from corner k to corner k+1
  std::array<unsigned int, 2> subdivisions{}; ///< of sides 0 and 2, of sides 1 and 3
  double young = 1, poisson = 0.3, density = 0, thickness = 1;
  std::optional<Fibres> fibres; ///< in the place of poisson
  std::string plane;
  std::string temperature;                ///< times the expansion of all materials
  double expansion = 0;                   ///< of the unnamed material, which others inherit
  std::array<double, 3> initial_strain{}; ///< e11, e22, e12 in the axes of the body, likewise
  std::vector<OtherMaterial> materials;   ///< nowhere two of them
  std::array<std::string, 2> body_force, gravity;
  std::vector<Side> sides;                     ///< all four, then parts
  std::map<std::string, std::string> settings; ///< entries "Section/Name" that no frame changes

private:
  Section geometry(const Frame &frame) const;
  Section probe(const Frame &frame) const;
  void add_initial_strain(const Frame &frame, Section &material) const;
  Section boundary(unsigned int k, const Frame &frame) const; ///< side k as the frame counts them
  std::vector<Section> material_sections(const Frame &frame) const;
};
} // namespace metamorphic

#endif
