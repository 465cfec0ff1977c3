#include "formats/pbrt/read_pbrt.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/text.h"
#include "formats/pbrt/directives.h"

namespace norrsken {

bool looks_like_pbrt(std::string_view text) {
  static const std::vector<std::string_view> kFirst = {"Accelerator",
                                                       "ActiveTransform",
                                                       "Attribute",
                                                       "Camera",
                                                       "ColorSpace",
                                                       "ConcatTransform",
                                                       "CoordinateSystem",
                                                       "CoordSysTransform",
                                                       "Film",
                                                       "Identity",
                                                       "Include",
                                                       "Integrator",
                                                       "LookAt",
                                                       "MakeNamedMedium",
                                                       "MediumInterface",
                                                       "Option",
                                                       "PixelFilter",
                                                       "Rotate",
                                                       "Sampler",
                                                       "Scale",
                                                       "SurfaceIntegrator",
                                                       "Transform",
                                                       "TransformTimes",
                                                       "Translate",
                                                       "WorldBegin"};
  for (text = trim(text); text.starts_with('#'); text = trim(text))
    text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n\"["));
  return std::ranges::find(kFirst, word) != kFirst.end();
}

std::optional<Description> read_pbrt(const std::string& path, const FileSystem& files, Diagnostics& diagnostics) {
  pbrt::Context context(files, diagnostics, folder_of(path));
  pbrt::DirectiveReader reader(context);
  reader.read_scene(path);
  if (diagnostics.has_errors()) return std::nullopt;
  std::shared_ptr<const Node> scene = reader.finish();
  if (diagnostics.has_errors()) return std::nullopt;
  Description description;
  description.scene = std::move(scene);
  description.search_paths = context.folders;
  description.memory = std::make_shared<MemoryReservation>(std::move(context.memory));
  return description;
}

}  // namespace norrsken
