// What an image file says about how it was made.
#pragma once

#include <string>

#include "exit_status.h"

namespace norrsken::cli {

/// Prints size, channels and texts of an EXR or PNG file.
ExitStatus print_image_info(const std::string& path, bool json);

}  // namespace norrsken::cli
