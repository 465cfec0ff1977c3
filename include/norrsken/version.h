// Which norrsken this is.
#pragma once

namespace norrsken {

/// Of the library that is linked, as in "0.1.0".
const char* version() noexcept;

}  // namespace norrsken
