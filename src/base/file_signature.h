// What a file is by its first bytes: of the formats that somebody may give in place of what is read.
#pragma once

#include <string_view>

namespace norrsken {

enum class FileKind {
  read_image,   ///< of a format that is read
  other_image,  ///< of one that is not
  volume,       ///< of the one format of volumes
  scene,        ///< what holds a scene, or may, in the format of another program
  packed,       ///< what holds other files
  checkpoint,   ///< of this program
  other
};

struct FileSignature {
  std::string_view start;  ///< the first bytes
  std::string_view what;   ///< "a GIF image"
  FileKind kind;
};

/// Null if the file is none that is known. Files without bytes of their own at the start (TGA, most texts) never are.
const FileSignature* file_signature(std::string_view contents);

}  // namespace norrsken
