// Textures on every instruction set that this processor runs, against closed forms and against what Mitsuba 3.9 says.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "base/aligned.h"
#include "isa/entry.h"
#include "texture/bitmap.h"
#include "texture/texture_testing.h"

namespace norrsken {

#define NORRSKEN_BUILT_ISA(space)          \
  namespace space {                        \
  extern const TextureCheck kTextureCheck; \
  }
#include "isa/built.def"
#undef NORRSKEN_BUILT_ISA

namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

float word(std::uint32_t bits) { return std::bit_cast<float>(bits); }

/// A place that a texture is asked about; on triangles u and v are also the barycentric coordinates.
struct Place {
  float u, v;
  std::uint32_t primitive = 0, shape = 0;
};
struct Value {
  float rgb[3];
  float gradient[2];
};

/// What each instruction set makes of the texture of these parameters and texels.
template <class Check>
void for_each_set(TextureKind kind, const std::vector<float>& parameters, const std::vector<float>& texels,
                  const std::vector<std::uint32_t>& triangle_vertices, const std::vector<Place>& places,
                  const Check& check) {
  SceneView scene;
  scene.parameters = parameters.data();
  scene.texels = texels.data();
  scene.triangle_vertices = triangle_vertices.data();
  scene.texture_kinds = 1u << static_cast<std::uint32_t>(kind);
  // One more than a multiple of every register's lanes.
  const std::size_t n = places.size(), padded = (n + 16) / 16 * 16;
  AlignedVector<float> u(padded), v(padded), out[5];
  AlignedVector<std::uint32_t> primitive(padded), shape(padded);
  for (std::size_t i = 0; i < n; ++i)
    u[i] = places[i].u, v[i] = places[i].v, primitive[i] = places[i].primitive, shape[i] = places[i].shape;
  float* outs[5];
  for (int k = 0; k < 5; ++k) out[k].resize(padded), outs[k] = out[k].data();
  int sets = 0;
  for (const TextureCheck* set : {
#define NORRSKEN_BUILT_ISA(space) &space::kTextureCheck,
#include "isa/built.def"
#undef NORRSKEN_BUILT_ISA
       }) {
    if (find_kernels(set->name) == nullptr) continue;
    SCOPED_TRACE(set->name);
    set->evaluate(scene, make_texture(kind, 0), u.data(), v.data(), primitive.data(), shape.data(), outs,
                  static_cast<std::uint32_t>(n));
    std::vector<Value> values(n);
    for (std::size_t i = 0; i < n; ++i) values[i] = {{out[0][i], out[1][i], out[2][i]}, {out[3][i], out[4][i]}};
    check(values);
    ++sets;
  }
  EXPECT_GE(sets, 1);
}

enum Wrap { kRepeat, kMirror, kClamp };
struct Wraps {
  Wraps(Wrap both) : u(both), v(both) {}
  Wraps(Wrap along_u, Wrap along_v) : u(along_u), v(along_v) {}
  Wrap u, v;
};
enum Layout { kPacked, kColor, kGrey };

/// 3 x 2 texels; the reds are those of an image that Mitsuba was asked about, in 255ths.
constexpr int kWidth = 3, kHeight = 2;
float texel(Layout layout, int x, int y, int channel) {
  const float rgb[3] = {static_cast<float>(20 + 60 * x), static_cast<float>(100 + 80 * y),
                        static_cast<float>(50 + 11 * x * y)};
  return rgb[layout == kGrey ? 0 : channel] / 255.0f;
}

struct TestImage {
  std::vector<float> parameters, texels;

  TestImage(Layout layout, Wraps wrap, bool nearest, std::vector<float> to_uv = {1, 0, 0, 0, 1, 0}) {
    texels.resize(5, 1e9f);  // what stands before it is another's
    if (layout == kPacked) {
      for (int byte = 0; byte < 256; ++byte) texels.push_back(static_cast<float>(byte) / 255.0f);
    }
    const auto first = static_cast<std::uint32_t>(texels.size());
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        std::uint32_t packed = 0;
        for (int c = 0; c < 3; ++c) {
          if (layout == kColor || (layout == kGrey && c == 0)) texels.push_back(texel(layout, x, y, c));
          packed |= static_cast<std::uint32_t>(std::lround(255 * texel(layout, x, y, c))) << (8 * c);
        }
        if (layout == kPacked) texels.push_back(word(packed));
      }
    }
    texels.resize(texels.size() + 5, 1e9f);
    using isa_host::Bitmap;
    const std::uint32_t stride = layout == kPacked ? 0 : layout == kColor ? 3 : 1;
    const bool mapped = to_uv != std::vector<float>{1, 0, 0, 0, 1, 0};
    const std::uint32_t flags = stride | (wrap.u + 4u * wrap.v) << Bitmap::kWrapShift |
                                (nearest ? Bitmap::kNearest : 0u) | (mapped ? Bitmap::kMapped : 0u);
    parameters = std::move(to_uv);
    for (const float value : {float(kWidth), float(kHeight), word(first), word(5), word(flags)})
      parameters.push_back(value);
  }
};

int wrapped(int i, int size, Wrap wrap) {
  if (wrap == kClamp) return std::clamp(i, 0, size - 1);
  const int period = wrap == kMirror ? 2 * size : size, within = (i % period + period) % period;
  return within < size ? within : period - 1 - within;
}

/// The textbook's lookup in double precision.
double reference(Layout layout, Wraps wrap, bool nearest, double u, double v, int channel) {
  const double x = u * kWidth - (nearest ? 0 : 0.5), y = v * kHeight - (nearest ? 0 : 0.5);
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const auto at = [&](int a, int b) -> double {
    return texel(layout, wrapped(a, kWidth, wrap.u), wrapped(b, kHeight, wrap.v), channel);
  };
  if (nearest) return at(i, j);
  return std::lerp(std::lerp(at(i, j), at(i + 1, j), x - i), std::lerp(at(i, j + 1), at(i + 1, j + 1), x - i), y - j);
}

std::vector<Place> grid() {
  std::vector<Place> places;
  for (int i = -40; i <= 60; ++i) {
    for (int j = -30; j <= 30; ++j) places.push_back({0.0437f * float(i), 0.0731f * float(j)});
  }
  return places;
}

TEST(BitmapTexture, LooksUpLikeTheTextbookInEveryMode) {
  const auto places = grid();
  for (const Layout layout : {kPacked, kColor, kGrey}) {
    for (const Wraps wrap : {Wraps(kRepeat), {kMirror}, {kClamp}, {kRepeat, kClamp}, {kClamp, kMirror}}) {
      for (const bool nearest : {false, true}) {
        const TestImage image(layout, wrap, nearest);
        for_each_set(TextureKind::bitmap, image.parameters, image.texels, {}, places, [&](const auto& values) {
          int wrong = 0;
          for (std::size_t i = 0; i < places.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
              const double wanted = reference(layout, wrap, nearest, double{places[i].u}, double{places[i].v}, c);
              wrong += !(std::abs(values[i].rgb[c] - wanted) < 1e-5);
            }
          }
          EXPECT_EQ(wrong, 0) << layout << wrap.u << wrap.v << nearest;
        });
      }
    }
  }
}

TEST(BitmapTexture, AgreesWithMitsuba) {
  const auto red_green = [](const TestImage& image, float u, float v, double red, double green) {
    for_each_set(TextureKind::bitmap, image.parameters, image.texels, {}, {{u, v}}, [&](const auto& values) {
      EXPECT_NEAR(255 * values[0].rgb[0], red, 1e-3);
      EXPECT_NEAR(255 * values[0].rgb[1], green, 1e-3);
    });
  };
  red_green({kPacked, kRepeat, true}, 0.1f, 0.1f, 20, 100);
  red_green({kPacked, kRepeat, true}, 0.1f, 0.9f, 20, 180);
  red_green({kPacked, kRepeat, false}, 0.0f, 0.0f, 80, 140);
  red_green({kPacked, kRepeat, false}, 0.3f, 0.4f, 44, 124);
  red_green({kPacked, kRepeat, false}, -0.2f, 1.7f, 134, 172);
  red_green({kPacked, kMirror, false}, -0.2f, 1.7f, 26, 108);
  red_green({kPacked, kClamp, false}, -0.2f, 1.7f, 20, 180);
  red_green({kPacked, kRepeat, true}, -0.2f, 1.7f, 140, 180);
  red_green({kPacked, kMirror, true}, -0.2f, 1.7f, 20, 100);
  red_green({kPacked, kRepeat, false, {2, 0, 0.25f, 0, 3, 0.5f}}, 0.3f, 0.4f, 134, 172);
}

TEST(BitmapTexture, StaysInsideWhateverItIsAsked) {
  const std::vector<Place> places = {{1e30f, -1e30f}, {kInf, 0.5f}, {-kInf, kInf}, {std::nanf(""), 0.5f}, {1e9f, 1e9f}};
  for (const Layout layout : {kPacked, kColor, kGrey}) {
    for (const Wrap wrap : {kRepeat, kMirror, kClamp}) {
      const TestImage image(layout, wrap, true);
      for_each_set(TextureKind::bitmap, image.parameters, image.texels, {}, places, [&](const auto& values) {
        for (const Value& value : values) {
          for (const float component : value.rgb) EXPECT_TRUE(component >= 0 && component <= 1) << component;
        }
      });
    }
  }
}

TEST(BitmapTexture, GradientIsTheInterpolantsDerivative) {
  const std::vector<float> turned = {1.5f, -0.5f, 0.2f, 0.25f, 2, 0.1f};
  const TestImage image(kPacked, kRepeat, false, turned);
  // Away from the lines between texel centres, where the derivative jumps.
  std::vector<Place> places;
  for (const auto& [u, v] : {std::pair(0.3f, 0.05f), std::pair(0.72f, 0.21f), std::pair(-0.41f, 0.4f)}) {
    for (const auto& [du, dv] : {std::pair(0.0f, 0.0f), std::pair(0.01f, 0.0f), std::pair(0.0f, 0.01f)})
      places.push_back({u + du, v + dv});
  }
  for_each_set(TextureKind::bitmap, image.parameters, image.texels, {}, places, [&](const auto& values) {
    const auto luminance = [&](std::size_t i) {
      const float* c = values[i].rgb;
      return 0.212671 * c[0] + 0.715160 * c[1] + 0.072169 * c[2];
    };
    for (std::size_t i = 0; i < places.size(); i += 3) {
      EXPECT_NEAR(values[i].gradient[0], (luminance(i + 1) - luminance(i)) / 0.01, 0.02);
      EXPECT_NEAR(values[i].gradient[1], (luminance(i + 2) - luminance(i)) / 0.01, 0.02);
      EXPECT_GT(std::abs(values[i].gradient[0]) + std::abs(values[i].gradient[1]), 0.1);
    }
  });
  const TestImage nearest(kPacked, kRepeat, true);
  for_each_set(TextureKind::bitmap, nearest.parameters, nearest.texels, {}, places, [&](const auto& values) {
    for (const Value& value : values) EXPECT_EQ(value.gradient[0], 0.0f);
  });
}

TEST(CheckerboardTexture, ChangesAtHalves) {
  const std::vector<float> parameters = {1, 0, 0, 0, 2, 0, 0.1f, 0.2f, 0.3f, 0, 0.9f, 0.8f, 0.7f, 0};
  const std::vector<Place> places = {{0.1f, 0.05f}, {0.6f, 0.05f}, {0.1f, 0.3f},
                                     {0.6f, 0.3f},  {0.5f, 0.05f}, {-0.1f, 0.05f}};
  const float wanted[] = {0.1f, 0.9f, 0.9f, 0.1f, 0.1f, 0.9f};
  for_each_set(TextureKind::checkerboard, parameters, {}, {}, places, [&](const auto& values) {
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(values[i].rgb[0], wanted[i]) << i;
    EXPECT_EQ(values[1].rgb[2], 0.7f);
  });
}

// Two meshes: the second one's first vertex is number 3, its first triangle number 1.
TEST(MeshAttributeTexture, InterpolatesOrHoldsPerTriangle) {
  const std::vector<float> parameters = {2, word(0)};
  const std::vector<std::uint32_t> triangles = {0, 1, 2, 3, 4, 5};
  constexpr std::uint32_t kValues = 8;
  std::vector<float> texels = {
      word(kValues),
      word(3),  // shape 0: three channels per vertex
      word(kValues + 9 - 3),
      word(1),  // shape 1: one channel per vertex
      word(0),
      word(0),  // shape 2: none
      word(kValues + 12 - 3),
      word(3 | 4),  // shape 3: three channels per triangle
      1,
      2,
      3,
      4,
      5,
      6,
      7,
      8,
      9,  // of vertices 0 to 2
      10,
      20,
      40,  // of vertices 3 to 5
      0.5f,
      0.25f,
      0.125f,  // of triangle 1
  };
  const std::vector<Place> places = {
      {0.25f, 0.5f, 0, 0}, {0.25f, 0.5f, 1, 1}, {0.25f, 0.5f, 0, 2}, {0.25f, 0.5f, 1, 3}};
  for_each_set(TextureKind::mesh_attribute, parameters, texels, triangles, places, [&](const auto& values) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_FLOAT_EQ(values[0].rgb[c], 2 * (0.25f * float(1 + c) + 0.25f * float(4 + c) + 0.5f * float(7 + c)));
      EXPECT_FLOAT_EQ(values[1].rgb[c], 2 * (0.25f * 10 + 0.25f * 20 + 0.5f * 40));
      EXPECT_EQ(values[2].rgb[c], 0.0f);
      EXPECT_EQ(values[3].rgb[c], std::ldexp(1.0f, -c));
    }
  });
}

}  // namespace
}  // namespace norrsken
