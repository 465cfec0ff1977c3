// homogeneous: a medium that is the same everywhere. It fills what the shapes that name it enclose.
//
// The light that passes it is known in closed form, so shadow rays have no noise of it; but with an `sggx`, which differs by
// place and direction. Where nothing closes the medium it ends where lights around the scene stand, twice the radius of the
// scene's sphere away.
//
// Rays start a little beyond the surface that they leave (64 ulps of its coordinates), and what lies between is not paid for:
// where that is not little against a mean free path, very dense media and those far from the origin come out too dark.
#include <fmt/core.h>

#include <glm/gtc/matrix_transform.hpp>

#include "medium/majorants_host.h"
#include "medium/medium_host.h"

namespace norrsken {
MediumRecord compile_medium_homogeneous(Parameters& p, Media& media) {
  MediumRecord record{.sigma_t = {}, .albedo = {}};
  glm::dvec3 sigma_t = p.read(kSigmaT).rgb() * p.read(kScale);
  for (int c = 0; c < 3; ++c) {
    if (sigma_t[c] > kMostExtinction) {
      p.error(kSigmaT.name, fmt::format("an extinction of {:g} per unit of length", sigma_t[c]),
              fmt::format("up to {:g}, with 'scale'", kMostExtinction));
      sigma_t = glm::dvec3(0);
    }
    record.sigma_t[c] = static_cast<float>(sigma_t[c]);
  }
  read_scattering(p, media, record);
  if (record.flakes_volume != kNone) {
    // What flakes extinguish differs by direction and place: a volume of one value, as far as scenes go.
    constexpr double kFar = 1e7;
    const glm::dmat4 everywhere = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(-kFar)), glm::dvec3(2 * kFar));
    set_extinction(p, media, add_constant(media, sigma_t, everywhere), 1, record);
    return record;
  }
  media.describe(p.node(), fmt::format("sigma_t {:.4g} {:.4g} {:.4g}", sigma_t.r, sigma_t.g, sigma_t.b));
  return record;
}

}  // namespace norrsken
