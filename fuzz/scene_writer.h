// Writes a scene file of legal parts, as the bytes of a fuzzer's input choose.
#pragma once

#include <string>

#include "fuzz/byte_source.h"

namespace norrsken::fuzz {

/// Paths of files that scenes may name.
struct SceneFiles {
  std::string obj, ply, serialized, volume, curves, picture, sky;
};

/// Anything in it is allowed by docs/scenes.md, though not every combination has to be: transforms may be singular,
/// shapes may lie beyond the coordinates that there are. Images have 4 x 4 pixels and few samples.
std::string write_scene(ByteSource& choices, const SceneFiles& files);

}  // namespace norrsken::fuzz
