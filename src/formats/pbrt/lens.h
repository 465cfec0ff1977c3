// The camera "realistic": what its glasses come to as one thin lens.
#pragma once

#include "formats/pbrt/state.h"

namespace norrsken::pbrt {

struct Optics {
  double half_width = 1;   ///< of the picture at distance 1
  double lens_radius = 0;  ///< scene units, as is the next
  double focus = 1;
};

/// Reads the camera's parameters and its lens file, and tells what is lost.
Optics read_optics(Context& context, Parameters& p, const FilmSize& film);

}  // namespace norrsken::pbrt
