// The images of a scene's textures, each read once and stored as compactly as its file has it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "norrsken/diagnostics.h"
#include "norrsken/image.h"
#include "scene/file_system.h"
#include "scene/parameters.h"
#include "tables/scene_tables.h"

namespace norrsken {

struct TexelImage;

/// An image among the scene's texels. Row 0 is the top.
struct StoredImage {
  std::uint32_t width = 0, height = 0;
  std::uint32_t texels = 0;  ///< offset of the first
  /// Floats from one texel to the next: 3 of colour, 1 of grey. 0: one word, with bytes R, G, B from the lowest up, whose
  /// values are in a table of 256 floats.
  std::uint32_t stride = 0;
  std::uint32_t table = 0;  ///< offset of that table
  glm::dvec3 mean{0};
  double min = 0, max = 0;
  std::string path;  ///< of the file, or what stands in messages for it
};

class ImageStore {
 public:
  ImageStore(const FileSystem& files, Diagnostics& diagnostics, SceneTables& tables)
      : files_(files), diagnostics_(diagnostics), tables_(tables) {}

  /// The image of a plugin's node: the file that its parameter names, or the `image` that a program gave it,
  /// whose numbers are taken as they are. Empty after a complaint.
  std::optional<StoredImage> of(Parameters& p, const FileParameter& filename, bool raw);
  /// The image in a file, in linear sRGB; `raw`: with the numbers that are stored. Empty after a complaint.
  std::optional<StoredImage> load(const std::string& path, bool raw, const SourceLocation& named_at);
  /// A copy of an image of floats with its values brought into a range. Empty after a complaint.
  std::optional<StoredImage> clamped(const StoredImage& image, double min, double max, const SourceLocation& named_at);

 private:
  std::optional<StoredImage> read(const std::string& path, bool raw, const SourceLocation& named_at);
  std::optional<StoredImage> copy(const Image& image, Parameters& p);
  std::optional<StoredImage> store(const TexelImage& image, bool raw, const std::string& path,
                                   const SourceLocation& named_at);
  /// Whether the scene may have so many more; complains if not.
  bool has_room(std::size_t texels, const std::string& path, const SourceLocation& named_at);
  /// What the 256 bytes mean: values stored with sRGB's transfer function, or fractions.
  std::uint32_t byte_table(bool encoded);

  const FileSystem& files_;
  Diagnostics& diagnostics_;
  SceneTables& tables_;
  std::map<std::pair<std::string, bool>, std::optional<StoredImage>> images_;
  std::map<const Image*, std::optional<StoredImage>> given_images_;
  std::optional<std::uint32_t> byte_tables_[2];
};

}  // namespace norrsken
