// What pbrt's version 3 says in other words, where there is a word for it today.
#pragma once

#include <string>

#include "formats/pbrt/context.h"

namespace norrsken::pbrt {

/// An object as a directive has it: Material "matte" "rgb Kd" [ 1 0 0 ].
struct Object3 {
  std::string directive, type;
  SharedParameters parameters;
};

/// Puts it into today's words; a note says so once for each of them.
void update(Context& context, const Place& place, Object3& object);

}  // namespace norrsken::pbrt
