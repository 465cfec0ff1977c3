// The format is described in Mitsuba's manual of the `gridvolume` plugin. Little-endian: "VOL", the version's byte, five
// 32-bit integers (encoding; sizes along x, y, z; channels), six floats (bounding box), the values.
#include "formats/vol.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <new>

#include "formats/mesh_complaints.h"

namespace norrsken {
namespace {

static_assert(std::endian::native == std::endian::little, "values are taken as they stand in the file");

constexpr std::string_view kMagic = "VOL";
constexpr char kVersion = 3;
constexpr std::int32_t kFloat32 = 1;
constexpr std::size_t kIntegersAt = 4, kBoxAt = kIntegersAt + 5 * sizeof(std::int32_t),
                      kHeaderBytes = kBoxAt + 6 * sizeof(float);

std::optional<VolumeData> read(std::string_view bytes, MeshComplaints& complaints) {
  const auto refuse = [&](std::string message, std::string accepted) {
    complaints.about_file(std::move(message), std::move(accepted));
    return std::nullopt;
  };
  if (!bytes.starts_with(kMagic)) return refuse("this is no volume file", "a file that begins with VOL");
  if (bytes.size() < kHeaderBytes)
    return refuse(fmt::format("the file ends after {} bytes", bytes.size()), fmt::format("{} or more", kHeaderBytes));
  if (bytes[kMagic.size()] != kVersion)
    return refuse(fmt::format("version {}", static_cast<unsigned char>(bytes[kMagic.size()])),
                  std::to_string(int{kVersion}));
  std::int32_t integers[5];
  std::memcpy(integers, bytes.data() + kIntegersAt, sizeof integers);
  const auto [encoding, nx, ny, nz, channels] = integers;
  if (encoding != kFloat32) return refuse(fmt::format("encoding {}", encoding), "1, for 32-bit floats");
  const std::string grid = fmt::format("{} x {} x {} values", nx, ny, nz);
  if (nx < 1 || ny < 1 || nz < 1) return refuse(grid, "1 or more along x, y and z");
  if (channels < 1) return refuse(fmt::format("{} channels", channels), "1 or more");

  const auto x = static_cast<std::uint32_t>(nx), y = static_cast<std::uint32_t>(ny), z = static_cast<std::uint32_t>(nz);
  const auto of_each = static_cast<std::uint32_t>(channels);
  std::array<float, 3> lower, upper;
  std::memcpy(lower.data(), bytes.data() + kBoxAt, sizeof lower);
  std::memcpy(upper.data(), bytes.data() + kBoxAt + sizeof lower, sizeof upper);
  bytes.remove_prefix(kHeaderBytes);
  // Divided in turn, because the product may not fit any integer.
  const std::size_t there = bytes.size() / sizeof(float);
  if (there / x / y / z / of_each == 0)
    return refuse(fmt::format("{} of {} channel{} do not fit the {} bytes behind the header", grid, channels,
                              channels == 1 ? "" : "s", bytes.size()),
                  "4 bytes for each");
  VolumeData volume{{x, y, z}, of_each, Array<float>(std::size_t{x} * y * z * of_each), lower, upper};
  std::memcpy(volume.values.data(), bytes.data(), volume.values.size() * sizeof(float));
  for (std::size_t i = 0; i < volume.values.size() && !complaints.gave_up(); ++i) {
    if (std::isfinite(volume.values[i])) continue;
    const std::size_t place = i / of_each;
    complaints.about_file(
        fmt::format("the value at ({}, {}, {}) is {}", place % x, place / x % y, place / x / y, volume.values[i]),
        "finite numbers");
  }
  if (complaints.any()) return std::nullopt;
  return volume;
}

}  // namespace

std::optional<VolumeData> read_vol(std::string_view bytes, const std::string& path, Diagnostics& diagnostics) {
  MeshComplaints complaints(path, bytes, diagnostics);
  try {
    return read(bytes, complaints);
  } catch (const std::bad_alloc&) {
    complaints.about_file("the volume does not fit into memory");
    return std::nullopt;
  }
}

}  // namespace norrsken
