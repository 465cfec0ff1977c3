// The head of a PLY file: which elements of which properties its body holds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/mesh_complaints.h"

namespace norrsken {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes that a value takes in a binary file.
constexpr std::size_t size_of(PlyType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<int>(type)];
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count_type;  ///< given for a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as the file claims; there need not be as many
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes up to the body
};

/// Empty after a complaint.
std::optional<PlyHeader> read_ply_header(std::string_view bytes, MeshComplaints& complaints);

}  // namespace norrsken
