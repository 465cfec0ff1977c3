// Descriptions that programs put together: what no reader lets through, they must not contain.
#pragma once

#include <string>

#include "scene/description.h"

namespace norrsken {

/// False after a complaint: no scene, nodes inside of themselves or nested too deep, malformed spectra.
bool check_description(const Description& description, Diagnostics& diagnostics);

/// 32 hexadecimal digits of all that it says, places and names of files apart, and of `files`, another fingerprint.
std::string fingerprint_of(const Description& description, const std::string& files);

}  // namespace norrsken
