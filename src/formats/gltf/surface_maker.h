// One material as a BSDF, and what shines of it.
#pragma once

#include "formats/gltf/materials.h"

namespace norrsken::gltf {

/// `set` is that of the texture coordinates: what textures are for others is left out, and told.
Surface make_surface(Asset& asset, Images& images, const Json& material, const PrimitiveTraits& traits,
                     std::size_t set);

}  // namespace norrsken::gltf
