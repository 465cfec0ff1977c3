#include "formats/gltf/accessors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/text.h"

namespace norrsken::gltf {
namespace {

struct ComponentType {
  std::size_t number, bytes;
  double most;  ///< of a normalized integer what stands for 1
};
constexpr ComponentType kComponentTypes[] = {{5120, 1, 127},   {5121, 1, 255},          {5122, 2, 32767},
                                             {5123, 2, 65535}, {5125, 4, 4294967295.0}, {5126, 4, 1}};

struct ElementType {
  std::string_view name;
  std::size_t components, columns;
};
constexpr ElementType kElementTypes[] = {{"SCALAR", 1, 1}, {"VEC2", 2, 1}, {"VEC3", 3, 1}, {"VEC4", 4, 1},
                                         {"MAT2", 4, 2},   {"MAT3", 9, 3}, {"MAT4", 16, 4}};

/// How an accessor's elements lie in its bytes.
struct Layout {
  const ComponentType* component = nullptr;
  std::size_t components = 1, columns = 1;
  bool normalized = false;

  std::size_t rows() const { return components / columns; }
  /// Columns of matrices begin at multiples of four bytes.
  std::size_t column_bytes() const {
    const std::size_t bytes = rows() * component->bytes;
    return columns == 1 ? bytes : (bytes + 3) / 4 * 4;
  }
  std::size_t bytes() const { return columns * column_bytes(); }

  double value(const char* element, std::size_t c) const {
    const char* at = element + c / rows() * column_bytes() + c % rows() * component->bytes;
    std::uint32_t bits = 0;
    for (std::size_t k = component->bytes; k-- > 0;) bits = bits << 8u | static_cast<unsigned char>(at[k]);
    switch (component->number) {
      case 5120:
        return scaled(static_cast<std::int8_t>(bits));
      case 5122:
        return scaled(static_cast<std::int16_t>(bits));
      case 5126:
        return std::bit_cast<float>(bits);
      default:
        return scaled(bits);
    }
  }

 private:
  double scaled(double integer) const { return normalized ? std::max(integer / component->most, -1.0) : integer; }
};

const ComponentType* component_type(Asset& asset, const Json& object) {
  const std::size_t number = asset.whole(object, "componentType", 0);
  const auto* const found = std::ranges::find(kComponentTypes, number, &ComponentType::number);
  if (found != std::end(kComponentTypes)) return found;
  asset.error(object, fmt::format("unknown componentType {}", number), "5120, 5121, 5122, 5123, 5125 or 5126");
  return nullptr;
}

/// `count` elements of a buffer view from `offset` on, `stride` bytes apart.
struct Elements {
  std::string_view bytes;
  std::size_t stride = 0;
  const char* at(std::size_t i) const { return bytes.data() + i * stride; }
};

/// Empty after a complaint.
std::optional<Elements> elements_of(Asset& asset, const Json& owner, const Layout& layout, std::size_t count,
                                    bool may_have_stride) {
  const Json* view = asset.referred(owner, "bufferView", "bufferViews");
  if (!view) {
    if (!owner.find("bufferView")) asset.error(owner, "there is no 'bufferView'", "an index");
    return std::nullopt;
  }
  const auto bytes = asset.view(*view);
  if (!bytes) return std::nullopt;
  const std::size_t offset = asset.whole(owner, "byteOffset", 0);
  std::size_t stride = may_have_stride ? asset.whole(*view, "byteStride", layout.bytes()) : layout.bytes();
  if (stride < layout.bytes() || stride > 65536) {
    asset.error(*view, fmt::format("'byteStride' is {}, the elements have {} bytes", stride, layout.bytes()),
                "at least as much");
    return std::nullopt;
  }
  const std::size_t available = offset <= bytes->size() ? bytes->size() - offset : 0;
  if (count > 0 && (available < layout.bytes() || (available - layout.bytes()) / stride < count - 1)) {
    asset.error(owner,
                fmt::format("{} elements of {} bytes, {} apart, do not fit into the buffer view's {} from byte {} on",
                            count, layout.bytes(), stride, bytes->size(), offset),
                "as many as there are bytes for");
    return std::nullopt;
  }
  return Elements{bytes->substr(std::min(offset, bytes->size())), stride};
}

struct Accessor {
  const Json* json = nullptr;
  Layout layout;
  std::size_t count = 0;
};

std::optional<Accessor> find_accessor(Asset& asset, const Json& object, std::string_view name,
                                      const std::vector<std::string>& accepted) {
  Accessor accessor;
  accessor.json = asset.referred(object, name, "accessors");
  if (!accessor.json) return std::nullopt;
  const std::string type = asset.string(*accessor.json, "type");
  if (std::ranges::find(accepted, type) == accepted.end()) {
    asset.error(*accessor.json, fmt::format("the type of the accessor that '{}' names is {}", name, quoted(type)),
                join(accepted, " or "));
    return std::nullopt;
  }
  const auto* const element = std::ranges::find(kElementTypes, type, &ElementType::name);
  accessor.layout.component = component_type(asset, *accessor.json);
  if (!accessor.layout.component) return std::nullopt;
  accessor.layout.components = element->components, accessor.layout.columns = element->columns;
  accessor.layout.normalized = asset.boolean(*accessor.json, "normalized", false);
  accessor.count = asset.whole(*accessor.json, "count", 0);
  constexpr std::size_t kMostElements = std::size_t{1} << 32;
  if (accessor.count > kMostElements) {
    asset.error(*accessor.json, fmt::format("an accessor of {} elements", accessor.count), "up to 2^32");
    return std::nullopt;
  }
  return accessor;
}

/// Calls `set(i, element, layout)` for each element that the accessor has bytes for, in order; false after a complaint.
template <class Set>
bool visit_elements(Asset& asset, const Accessor& accessor, const Set& set) {
  if (accessor.json->find("bufferView")) {
    const auto elements = elements_of(asset, *accessor.json, accessor.layout, accessor.count, true);
    if (!elements) return false;
    for (std::size_t i = 0; i < accessor.count; ++i) set(i, elements->at(i));
  }
  const Json* sparse = asset.member(*accessor.json, "sparse", Json::Kind::object);
  if (!sparse) return true;
  const std::size_t count = asset.whole(*sparse, "count", 0);
  const Json* indices = asset.member(*sparse, "indices", Json::Kind::object);
  const Json* values = asset.member(*sparse, "values", Json::Kind::object);
  if (!indices || !values) {
    asset.error(*sparse, "sparse replacements lack 'indices' or 'values'", "both");
    return false;
  }
  Layout index;
  index.component = component_type(asset, *indices);
  if (!index.component) return false;
  const auto places = elements_of(asset, *indices, index, count, false);
  const auto elements = elements_of(asset, *values, accessor.layout, count, false);
  if (!places || !elements) return false;
  for (std::size_t k = 0; k < count; ++k) {
    const double place = index.value(places->at(k), 0);
    if (!(place >= 0 && place < static_cast<double>(accessor.count))) {
      asset.error(*indices, fmt::format("a sparse index is {:g}", place), fmt::format("below {}", accessor.count));
      return false;
    }
    set(static_cast<std::size_t>(place), elements->at(k));
  }
  return true;
}

}  // namespace

std::optional<Numbers> read_numbers(Asset& asset, const Json& object, std::string_view name,
                                    const std::vector<std::string>& accepted) {
  const auto accessor = find_accessor(asset, object, name, accepted);
  if (!accessor) return std::nullopt;
  const Layout& layout = accessor->layout;
  Numbers numbers;
  numbers.components = layout.components, numbers.count = accessor->count;
  // Held against the bytes before so much is allocated.
  if (accessor->json->find("bufferView") && !elements_of(asset, *accessor->json, layout, accessor->count, true))
    return std::nullopt;
  numbers.values.resize(numbers.components * numbers.count);
  bool finite = true;
  const bool ok = visit_elements(asset, *accessor, [&](std::size_t i, const char* element) {
    for (std::size_t c = 0; c < layout.components; ++c) {
      auto value = static_cast<float>(layout.value(element, c));
      if (!std::isfinite(value)) finite = false, value = 0;
      numbers.values[i * layout.components + c] = value;
    }
  });
  if (!ok) return std::nullopt;
  if (!finite) asset.tell(*accessor->json, "an accessor has numbers that are not finite", "0");
  return numbers;
}

std::optional<Array<std::uint32_t>> read_indices(Asset& asset, const Json& object, std::string_view name) {
  const auto accessor = find_accessor(asset, object, name, {"SCALAR"});
  if (!accessor) return std::nullopt;
  if (accessor->layout.component->number == 5126) {
    asset.error(*accessor->json, "indices are floats", "componentType 5121, 5123 or 5125");
    return std::nullopt;
  }
  if (accessor->json->find("bufferView") &&
      !elements_of(asset, *accessor->json, accessor->layout, accessor->count, true))
    return std::nullopt;
  Array<std::uint32_t> indices(accessor->count);
  const bool ok = visit_elements(asset, *accessor, [&](std::size_t i, const char* element) {
    indices[i] = static_cast<std::uint32_t>(std::max(accessor->layout.value(element, 0), 0.0));
  });
  if (!ok) return std::nullopt;
  return indices;
}

}  // namespace norrsken::gltf
