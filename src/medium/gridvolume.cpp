// gridvolume: values on a grid that fills the unit cube, from a volume file (.vol) with 1, 3 or 6 channels.
//
// The values stand in the middle of the grid's voxels. Three channels are linear sRGB, six are those of an `sggx`.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "base/text.h"
#include "formats/vol.h"
#include "medium/majorants_host.h"
#include "scene/read_files.h"

namespace norrsken {
namespace {

constexpr FileParameter kFilename{.name = "filename", .text = "a volume file (.vol) of 1, 3 or 6 channels"};
constexpr BooleanParameter kUseGridBbox{
    .name = "use_grid_bbox", .text = "the values fill the bounding box that the file tells instead of the unit cube"};
constexpr ChoiceParameter<VolumeFilter> kFilter{
    .name = "filter_type",
    .words = {{{"trilinear", VolumeFilter::trilinear}, {"nearest", VolumeFilter::nearest}}},
    .text = "how values are looked up between those of the grid"};
constexpr ChoiceParameter<VolumeWrap> kWrap{
    .name = "wrap_mode",
    .words = {{{"clamp", VolumeWrap::clamp}, {"repeat", VolumeWrap::repeat}, {"mirror", VolumeWrap::mirror}}},
    .text = "what there is beyond the unit cube: the values at its faces, or the same values again, or mirrored"};
constexpr BooleanParameter kRaw{.name = "raw", .text = "taken and of no effect: values are always as they are stored"};
constexpr BooleanParameter kAccel{.name = "accel", .fallback = true, .text = "taken and of no effect"};
constexpr TransformParameter kToWorld{.name = "to_world", .text = "where the unit cube, or the box, stands"};

/// Signed 32-bit lanes count the numbers of all tables.
constexpr std::size_t kMaxNumbers = std::size_t{1} << 31;

std::optional<VolumeData> read_values(const std::string& path, Parameters& p, Media& media) {
  std::string problem;
  const std::optional<FileContents> contents = read_counted(media.files(), path, problem);
  if (!contents) {
    p.error(kFilename.name, fmt::format("cannot read {}: {}", quoted(path, 200), problem), "a readable .vol file");
    return std::nullopt;
  }
  p.diagnostics().named_at(path, p.where(kFilename.name));
  std::optional<VolumeData> data = read_vol(contents->bytes, path, p.diagnostics());
  if (!data) return std::nullopt;
  constexpr std::array<std::uint32_t, 3> kChannels = {1, 3, 6};
  if (std::ranges::find(kChannels, data->channels) == kChannels.end()) {
    p.error(kFilename.name, fmt::format("a volume of {} channels", data->channels), "1, 3 or 6 channels");
    return std::nullopt;
  }
  if (data->values.size() > kMaxNumbers - std::min(kMaxNumbers, media.tables().texels.size())) {
    p.error(kFilename.name, "images and volumes have too many numbers", fmt::format("{} in all", kMaxNumbers));
    return std::nullopt;
  }
  return data;
}

/// From the unit cube to the box of the file.
std::optional<glm::dmat4> box_of(const VolumeData& data, Parameters& p) {
  glm::dvec3 lower, extent;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    lower[axis] = double{data.lower[k]};
    extent[axis] = double{data.upper[k]} - lower[axis];
    if (extent[axis] > 1e-20 && extent[axis] < 1e20 && std::abs(lower[axis]) < 1e20) continue;
    p.error(kUseGridBbox.name,
            fmt::format("the bounding box of the volume goes from {:g} to {:g} along {}", data.lower[k], data.upper[k],
                        "xyz"[axis]),
            "a box that is not empty");
    return std::nullopt;
  }
  return glm::scale(glm::translate(glm::dmat4(1), lower), extent);
}

}  // namespace

Volume compile_volume_gridvolume(Parameters& p, Media& media) {
  const std::string path = p.read(kFilename);
  const bool use_box = p.read(kUseGridBbox);
  VolumeRecord record{};
  record.filter = p.read(kFilter);
  record.wrap = p.read(kWrap);
  p.read(kRaw);
  p.read(kAccel);
  glm::dmat4 world_from_local = p.read(kToWorld);
  if (path.empty()) return {};
  const std::optional<VolumeData> data = read_values(path, p, media);
  if (!data) return {};
  if (use_box) {
    const std::optional<glm::dmat4> box = box_of(*data, p);
    if (!box) return {};
    world_from_local = world_from_local * *box;
  }
  const auto [nx, ny, nz] = data->size;
  record.size_x = static_cast<float>(nx), record.size_y = static_cast<float>(ny),
  record.size_z = static_cast<float>(nz);
  record.channels = data->channels;
  Array<float>& texels = media.tables().texels;
  record.first = static_cast<std::uint32_t>(texels.size());
  texels.insert(texels.end(), data->values.begin(), data->values.end());
  const auto [min, max] = std::ranges::minmax(data->values);
  media.describe(p.node(), fmt::format("{} x {} x {} of {} channel{}, {:.4g} to {:.4g}", nx, ny, nz, data->channels,
                                       data->channels == 1 ? "" : "s", min, max));
  return add_volume(media, record, world_from_local, double{min}, double{max});
}

}  // namespace norrsken
