// sdfgrid: the surface of a signed distance function that is sampled on a grid, the values interpolated trilinearly.
//
// The values need not be distances: what counts is where they change from negative to 0 or more, which is outside. The
// surface is open where it meets the cube's faces. It has no texture coordinates: textures are looked up at (0, 0).
// Departures: grids that only touch 0 without being negative anywhere have no surface here. As a light (Mitsuba has none of
// this shape) it is found by rays alone, so path renders it, noisily if it is small, and ptracer does not.
#include "shape/sdfgrid.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/text.h"
#include "compile/shapes.h"
#include "formats/vol.h"
#include "shape/analytic_host.h"
#include "shape/shape_file_host.h"

namespace norrsken {
namespace {

constexpr FileParameter kFilename{
    .name = "filename",
    .text =
        "a volume file (.vol) of one channel: the values at the vertices of a grid that fills the cube from (0, 0, 0) "
        "to "
        "(1, 1, 1), whatever bounding box the file tells; 2 or more along each axis; negative inside"};
constexpr ChoiceParameter<bool> kIsSmooth{
    .name = "normals",
    .words = {{{"smooth", true}, {"analytic", false}}},
    .text = "shading normals without steps between voxels, or the gradient of the interpolation"};
constexpr TransformParameter kToWorld{.name = "to_world", .text = "any that is not singular"};
constexpr BooleanParameter kWatertight{.name = "watertight",
                                       .fallback = true,
                                       .text =
                                           "taken and of no effect. In Mitsuba 3.5 and 3.6 it closes the gaps between "
                                           "voxels; here, and in later Mitsubas, "
                                           "there are none"};

/// Signed 32-bit lanes count the numbers of all tables.
constexpr std::size_t kMaxNumbers = std::size_t{1} << 31;

std::optional<VolumeData> read_grid(const std::string& path, Parameters& p, Shapes& shapes) {
  std::string problem;
  const std::optional<FileContents> contents = read_counted(shapes.files(), path, problem);
  if (!contents) {
    p.error(kFilename.name, fmt::format("cannot read {}: {}", quoted(path, 200), problem), "a readable .vol file");
    return std::nullopt;
  }
  p.diagnostics().named_at(path, p.where(kFilename.name));
  return read_vol(contents->bytes, path, p.diagnostics());
}

/// The shape's table without its head; voxels behind the values.
class Voxels {
 public:
  explicit Voxels(const VolumeData& volume) : volume_(volume) {
    const auto& size = volume.size;
    for (std::uint32_t z = 0; z + 1 < size[2]; ++z) {
      for (std::uint32_t y = 0; y + 1 < size[1]; ++y) {
        for (std::uint32_t x = 0; x + 1 < size[0]; ++x) {
          if (is_crossed(x, y, z)) add(x, y, z);
        }
      }
    }
  }
  const Array<std::uint32_t>& numbers() const { return numbers_; }
  /// Of all of them, in the cube.
  glm::dvec3 lower() const { return lower_; }
  glm::dvec3 upper() const { return upper_; }

 private:
  std::size_t number(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x + std::size_t{volume_.size[0]} * (y + std::size_t{volume_.size[1]} * z);
  }
  bool is_crossed(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    int inside = 0;
    for (std::uint32_t i = 0; i < 8; ++i)
      inside += volume_.values[number(x + (i & 1), y + ((i >> 1) & 1), z + (i >> 2))] < 0 ? 1 : 0;
    return inside != 0 && inside != 8;
  }
  void add(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    numbers_.push_back(static_cast<std::uint32_t>(number(x, y, z)));
    const glm::dvec3 voxels(volume_.size[0] - 1, volume_.size[1] - 1, volume_.size[2] - 1), corner(x, y, z);
    lower_ = glm::min(lower_, corner / voxels);
    upper_ = glm::max(upper_, (corner + 1.0) / voxels);
  }

  const VolumeData& volume_;
  Array<std::uint32_t> numbers_;
  glm::dvec3 lower_{1}, upper_{0};
};

/// The values times a power of two that brings the largest close to 1, which changes neither surface nor normals: sums
/// and products of whatever floats a file has are floats then.
void append_values(const Array<float>& values, Array<float>& table) {
  float largest = 0;
  for (const float value : values) largest = std::max(largest, std::abs(value));
  const int exponent = std::ilogb(largest);
  for (const float value : values) table.push_back(std::ldexp(value, -exponent));
}

}  // namespace

std::optional<ShapeGeometry> compile_shape_sdfgrid(Parameters& p, Shapes& shapes) {
  const std::string path = p.read(kFilename);
  const bool smooth = p.read(kIsSmooth);
  const glm::dmat4 to_world = p.read(kToWorld);
  p.read(kWatertight);
  if (path.empty()) return std::nullopt;

  const std::optional<VolumeData> volume = read_grid(path, p, shapes);
  if (!volume) return std::nullopt;
  const auto refuse = [&](std::string message, std::string accepted) {
    p.error(kFilename.name, std::move(message), std::move(accepted));
    return std::nullopt;
  };
  const auto& size = volume->size;
  const std::string grid = fmt::format("{} x {} x {} values", size[0], size[1], size[2]);
  if (volume->channels != 1) return refuse(fmt::format("a volume of {} channels", volume->channels), "1");
  if (std::min({size[0], size[1], size[2]}) < 2) return refuse("a grid of " + grid, "2 or more along each axis");
  const Voxels voxels(*volume);
  if (voxels.numbers().empty())
    return refuse("the grid has no surface: its values have one sign",
                  "values that are negative inside, 0 or more outside");

  const std::size_t numbers = SdfGridTable::kValues + volume->values.size() + voxels.numbers().size();
  if (shapes.texel_count() + numbers > kMaxNumbers)
    return refuse("the scene's grids and images are too large", fmt::format("{} values in all", kMaxNumbers));

  AnalyticShape shape{.kind = AnalyticKind::sdfgrid,
                      .world_from_local = to_world,
                      .area = 0,
                      .flip_normals = false,
                      .lower = voxels.lower(),
                      .upper = voxels.upper()};
  // Nothing samples the surface: that of the cube will do.
  const glm::dvec3 a(to_world[0]), b(to_world[1]), c(to_world[2]);
  for (const glm::dvec3& face : {glm::cross(a, b), glm::cross(b, c), glm::cross(c, a)})
    shape.area += 2 * glm::length(face);
  shape.table.reserve(numbers);
  for (const std::uint32_t word : {size[0], size[1], size[2], smooth ? 1u : 0u})
    shape.table.push_back(std::bit_cast<float>(word));
  append_values(volume->values, shape.table);
  for (const std::uint32_t number : voxels.numbers()) shape.table.push_back(std::bit_cast<float>(number));
  shape.element_count = static_cast<std::uint32_t>(voxels.numbers().size());
  shapes.describe(p.node(), fmt::format("{}, {} voxels{}", grid, shape.element_count, smooth ? ", smooth" : ""));
  return place_analytic(shape, p);
}

}  // namespace norrsken
