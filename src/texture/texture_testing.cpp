#include "texture/texture_testing.h"

#include "texture/parameter_reader.h"

namespace norrsken::NORRSKEN_ISA {
namespace {

void evaluate_all(const SceneView& scene, TextureWord word, const float* u, const float* v,
                  const std::uint32_t* primitive, const std::uint32_t* shape, float* const out[5],
                  std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; i += kLanes) {
    const Mask active = first_lanes(count - i);
    const Vec2f uv{load(u + i), load(v + i)};
    const TexturePoint point{uv, load_uint(reinterpret_cast<const float*>(primitive) + i),
                             load_uint(reinterpret_cast<const float*>(shape) + i), uv};
    const Color color = evaluate_texture(scene, UInt(word), point, active);
    store(out[0] + i, color.r), store(out[1] + i, color.g), store(out[2] + i, color.b);
    if (texture_kind(word) != TextureKind::bitmap) continue;
    const Vec2f gradient = Bitmap::gradient(scene, UInt(word & kTextureOffsetMask), point, active);
    store(out[3] + i, gradient.x), store(out[4] + i, gradient.y);
  }
}

}  // namespace

extern const TextureCheck kTextureCheck;
const TextureCheck kTextureCheck = {NORRSKEN_ISA_NAME, evaluate_all};

}  // namespace norrsken::NORRSKEN_ISA
