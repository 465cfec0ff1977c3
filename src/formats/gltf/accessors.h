// The numbers that accessors describe: every component type, normalized or not, with strides and sparse replacements.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "formats/gltf/asset.h"

namespace norrsken::gltf {

/// `components` numbers for each of `count` elements, one after the other.
struct Numbers {
  std::size_t components = 0, count = 0;
  Array<float> values;

  const float* at(std::size_t i) const { return values.data() + i * components; }
};

/// The accessor that a member of `object` names, if its type is one of `accepted` ("VEC3", "VEC4"). Empty if there is none, or
/// after a complaint. Integers are their fractions if they are normalized.
std::optional<Numbers> read_numbers(Asset& asset, const Json& object, std::string_view name,
                                    const std::vector<std::string>& accepted);

/// The indices that a primitive names.
std::optional<Array<std::uint32_t>> read_indices(Asset& asset, const Json& object, std::string_view name);

}  // namespace norrsken::gltf
