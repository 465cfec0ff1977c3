// envmap: an image in latitude-longitude format around the scene.
#include "light/envmap.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "color/srgb.h"
#include "compile/field_of_view.h"
#include "compile/images.h"
#include "light/light_host.h"

namespace norrsken {
namespace {

constexpr FileParameter kFilename{
    .name = "filename",
    .text =
        "PNG, JPEG, BMP, TGA, TIFF, PNM, PFM, EXR or HDR, at least 2 x 3 pixels. Programs may give an `image` in its "
        "place"};
constexpr NumberParameter kScale{
    .name = "scale", .fallback = 1, .range = {0, kMaxEmission}, .text = "factor on the image's radiance"};
constexpr TransformParameter kToWorld{
    .name = "to_world",
    .text =
        "it keeps shapes. The local y axis is up, where the image's first row is; its first and last column are at -z, "
        "its middle one is at +z, and columns to the left of the middle are towards +x"};
constexpr BooleanParameter kMisCompensation{
    .name = "mis_compensation",
    .text =
        "light sampling leaves what is darker than the mean to the directions that surfaces sample, which can reduce "
        "noise; of effect only where both compete (path, and direct with samples of both)"};

constexpr std::size_t kMaxTexels = std::size_t{1} << 31;

/// Writes what EnvmapEnvironment::Distribution says, of cells with these weights; evenly if none has any.
void write_distribution(std::span<const double> weights, std::uint32_t guide_size, float* out) {
  const std::size_t cells = weights.size();
  double total = 0;
  for (const double w : weights) total += w;
  double sum = 0;
  for (std::size_t i = 0; i < cells; ++i) {
    out[i] = static_cast<float>(sum);
    sum += total > 0 ? weights[i] / total : 1.0 / static_cast<double>(cells);
  }
  // What rounding leaves at the end belongs to the last cell with a weight: one without must never be found.
  std::size_t last = cells;
  while (total > 0 && last > 1 && weights[last - 1] <= 0) --last;
  std::fill(out + last, out + cells + 1, 1.0f);
  std::uint32_t cell = 0;
  for (std::uint32_t k = 0; k <= guide_size; ++k) {
    const float u = static_cast<float>(k) / static_cast<float>(guide_size);
    while (cell + 1 < last && out[cell + 1] <= u) ++cell;
    out[cells + 1 + k] = std::bit_cast<float>(cell);
  }
}

/// The image's texels as 3 floats each; their offset.
std::uint32_t float_texels(const StoredImage& image, Array<float>& texels) {
  if (image.stride == 3) return image.texels;
  const auto offset = static_cast<std::uint32_t>(texels.size());
  const std::size_t count = std::size_t{image.width} * image.height;
  texels.reserve(offset + 3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const float value = texels[image.texels + i];
    for (std::uint32_t c = 0; c < 3; ++c) {
      texels.push_back(image.stride == 1 ? value
                                         : texels[image.table + (std::bit_cast<std::uint32_t>(value) >> 8 * c & 255)]);
    }
  }
  return offset;
}

double luminance_of(const float* texel) { return luminance(double{texel[0]}, double{texel[1]}, double{texel[2]}); }

/// The sine of the polar angle of row `y` of texels, the last of which is `last`; at the poles that of a quarter of a row.
double sine_of_row(std::size_t y, std::size_t last) {
  const auto rows = static_cast<double>(last);
  return std::sin(std::clamp(static_cast<double>(y), 0.25, rows - 0.25) * std::numbers::pi / rows);
}

/// The mean luminance over all directions; 0 of an image in which it hardly differs from the least, for which there is
/// nothing to be gained.
double compensation_of(const StoredImage& image, const float* texels) {
  double total = 0, weight = 0, least = std::numeric_limits<double>::infinity();
  for (std::size_t y = 0; y < image.height; ++y) {
    const double sine = sine_of_row(y, image.height - std::size_t{1});
    for (std::size_t x = 0; x < image.width; ++x) {
      const double value = luminance_of(&texels[3 * (y * image.width + x)]);
      total += value * sine, weight += sine;
      least = std::min(least, value);
    }
  }
  const double mean = total / weight;
  return mean - least > 0.01 * mean ? mean : 0;
}

using Stored = isa_host::EnvmapEnvironment::Stored;

/// Writes the distributions and the kernel's parameters; returns the mean radiance over all directions.
glm::dvec3 write_map(const StoredImage& image, bool compensate, Array<float>& texels, Stored& stored) {
  const std::uint32_t first = float_texels(image, texels);
  const std::size_t width = image.width, rows = image.height - std::size_t{1};
  // Memory is what finding a column costs: a guide to every fourth stays in the caches, and the rest stands together.
  const auto row_guide = static_cast<std::uint32_t>(std::bit_floor(rows));
  const std::uint32_t column_guide = std::max(std::bit_floor(image.width) / 4, 1u);
  const std::size_t columns_offset = rows + 1 + row_guide + 1, stride = width + 1 + column_guide + 1;
  const auto offset = static_cast<std::uint32_t>(texels.size());
  texels.resize(texels.size() + columns_offset + rows * stride);

  // As the kernel has it.
  const double darkest = compensate ? double{static_cast<float>(compensation_of(image, &texels[first]))} : 0.0;
  glm::dvec3 total(0);
  std::vector<double> above(width), below(width), patches(width), row_weights(rows);
  for (std::size_t y = 0; y <= rows; ++y) {
    const double sine = sine_of_row(y, rows);
    above.swap(below);
    for (std::size_t x = 0; x < width; ++x) {
      const float* texel = &texels[first + 3 * (y * width + x)];
      const glm::dvec3 color(texel[0], texel[1], texel[2]);
      below[x] = std::max(luminance_of(texel) - darkest, 0.0) * sine;
      total += color * sine * (y == 0 || y == rows ? 0.5 : 1.0);
    }
    if (y == 0) continue;
    double sum = 0;
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t next = x + 1 < width ? x + 1 : 0;
      patches[x] = (above[x] + above[next] + below[x] + below[next]) / 4;
      sum += patches[x];
    }
    row_weights[y - 1] = sum;
    write_distribution(patches, column_guide, &texels[offset + columns_offset + (y - 1) * stride]);
  }
  write_distribution(row_weights, row_guide, &texels[offset]);

  double weight = 0;
  for (const double w : row_weights) weight += w;
  const double patch_count = static_cast<double>(width) * static_cast<double>(rows);
  const double density_scale = weight > 0 ? patch_count / weight / (2 * std::numbers::pi * std::numbers::pi) : 0;
  stored = {.texels = first,
            .rows = offset,
            .columns = static_cast<std::uint32_t>(columns_offset),
            .row = {static_cast<std::uint32_t>(rows), row_guide},
            .column = {image.width, column_guide},
            .density_scale = static_cast<float>(density_scale),
            .darkest = static_cast<float>(darkest)};
  return total / patch_count * (std::numbers::pi / 2);
}

}  // namespace

void compile_emitter_envmap(Parameters& p, Lights& lights, std::uint32_t shape) {
  refuse_shape(p, shape, "surrounds the scene");
  const double scale = p.read(kScale);
  const glm::dmat4 to_world = p.read(kToWorld);
  const bool compensate = p.read(kMisCompensation) && lights.paths_find_lights();
  glm::dmat3 axes(to_world);
  axes /= glm::length(axes[0]);
  if (!keeps_lengths(axes)) {
    p.error(kToWorld.name, "'to_world' of emitter 'envmap' distorts",
            "translations, rotations and scales with one value");
  }
  const std::optional<StoredImage> image = lights.images().of(p, kFilename, /*raw=*/false);
  if (!image) return;
  const std::size_t pixels = std::size_t{image->width} * image->height;
  if (image->width < 2 || image->height < 3) {
    p.error(kFilename.name, fmt::format("the image has {} x {} pixels", image->width, image->height), "at least 2 x 3");
    return;
  }
  if (lights.texels().size() + 6 * pixels >= kMaxTexels) {
    p.error(kFilename.name, "the scene's images are too many or too large",
            fmt::format("{} texels in all", kMaxTexels));
    return;
  }
  if (image->max * scale > kMaxEmission) {
    p.error(kFilename.name, fmt::format("the image's radiance is up to {:g}", image->max * scale),
            fmt::format("radiance up to {:g}", kMaxEmission));
    return;
  }

  Stored stored;
  const glm::dvec3 mean = scale * write_map(*image, compensate, lights.texels(), stored);
  LightRecord light{};
  light.kind = LightKind::envmap;
  set_values(light.emission, glm::dvec3(scale));
  set_axes(light, glm::transpose(axes));
  light.parameters = lights.store(stored);
  lights.add_environment(p.node(), light, environment_power(glm::max(mean, glm::dvec3(0))));
  lights.describe(p.node(), fmt::format("{} x {}, mean radiance {:.6g} {:.6g} {:.6g}", image->width, image->height,
                                        mean.r, mean.g, mean.b));
}

}  // namespace norrsken
