// What all emitters are told.
//
// Emitters that have no surface and do not surround the scene may stand in a shape as well as outside: it makes no
// difference to them, and the shape is black if it names no bsdf.
#pragma once

#include <glm/mat3x3.hpp>

#include "compile/lights.h"

namespace norrsken {

/// Of what shines alike in all directions.
inline constexpr ColorParameter kUniformRadiance{.name = "radiance",
                                                 .fallback = 1,
                                                 .range = {0, kMaxEmission},
                                                 .text = "",
                                                 .unit = "W / (m^2 sr)",
                                                 .of = ColorOf::light};

void set_values(float (&out)[3], const glm::dvec3& v);

/// The local axes of an emitter as rows: what takes directions of the world into its space.
void set_axes(LightRecord& light, const glm::dmat3& local_from_world);

/// A complaint if the emitter stands inside of a shape; `reason` is why it has no place there.
void refuse_shape(Parameters& p, std::uint32_t shape, const char* reason);

/// The texture `child` of parameter `name`, if there is one, which is thrown like a slide; a complaint if only surfaces
/// have it.
std::optional<Texture> slide_texture(Parameters& p, Lights& lights, std::string_view name, const Node::Child* child);

}  // namespace norrsken
