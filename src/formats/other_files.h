// Files that are given as a scene and are none: what they look like, and what can be done with them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace norrsken {

struct OtherFile {
  std::string message;   ///< "'bunny.obj' is a Wavefront OBJ mesh, not a scene"
  std::string accepted;  ///< how to come to a scene; may have several lines
};

/// By the first bytes of the file, and by its name where those leave it open. Empty for what may be a scene.
std::optional<OtherFile> recognise_other_file(const std::string& path, std::string_view bytes);

}  // namespace norrsken
