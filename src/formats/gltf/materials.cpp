#include "formats/gltf/materials.h"

#include <algorithm>

#include "base/text.h"
#include "formats/gltf/surface_maker.h"

namespace norrsken::gltf {
namespace {

/// Where the textures of a material stand, in the order in which they decide on the texture coordinates.
struct TexturePlace {
  const char *extension, *object, *name;  ///< either of the first two may be empty
};
constexpr TexturePlace kTexturePlaces[] = {{"", "pbrMetallicRoughness", "baseColorTexture"},
                                           {"KHR_materials_pbrSpecularGlossiness", "", "diffuseTexture"},
                                           {"", "", "normalTexture"},
                                           {"", "pbrMetallicRoughness", "metallicRoughnessTexture"},
                                           {"", "", "emissiveTexture"}};

}  // namespace

std::optional<std::size_t> Materials::variant_number() {
  if (variant_) return *variant_;
  variant_ = std::optional<std::size_t>();
  const Json* extension = asset_.extension(asset_.root(), "KHR_materials_variants");
  if (!extension) {
    if (!asset_.choices.variant.empty())
      asset_.diagnostics.error({}, "-Dvariant: the file has no variants", "a file with KHR_materials_variants");
    return *variant_;
  }
  std::vector<std::string> names;
  for (const Json& variant : asset_.items(*extension, "variants")) {
    names.push_back(asset_.string(variant, "name"));
    if (names.back() == asset_.choices.variant && !*variant_) variant_ = names.size() - 1;
  }
  if (!asset_.choices.variant.empty() && !*variant_) {
    asset_.diagnostics.error({},
                             fmt::format("-Dvariant={}: there is no such variant{}", asset_.choices.variant,
                                         did_you_mean(asset_.choices.variant, names)),
                             listed(names));
  } else if (!*variant_) {
    asset_.diagnostics.note(asset_.place(*extension), "the file has variants, of which none is chosen",
                            "-Dvariant= " + listed(names));
  }
  return *variant_;
}

const Json* Materials::of_primitive(const Json& primitive) {
  const auto variant = variant_number();
  const Json* extension = asset_.extension(primitive, "KHR_materials_variants");
  if (variant && extension) {
    for (const Json& mapping : asset_.items(*extension, "mappings")) {
      const bool applies = std::ranges::any_of(asset_.items(mapping, "variants"), [&](const Json& number) {
        return number.kind == Json::Kind::number && number.number == static_cast<double>(*variant);
      });
      if (applies) return asset_.referred(mapping, "material", "materials");
    }
  }
  return primitive.find("material") ? asset_.referred(primitive, "material", "materials") : &no_members();
}

std::size_t Materials::set_of(const Json* material, const std::vector<std::size_t>& available) {
  for (const TexturePlace& place : kTexturePlaces) {
    const Json* object = material;
    if (*place.extension != 0) object = asset_.extension(*material, place.extension);
    if (*place.object != 0) object = asset_.member(*material, place.object, Json::Kind::object);
    const auto use = object ? images_.use(*object, place.name) : std::nullopt;
    if (use && std::ranges::find(available, use->set) != available.end()) return use->set;
  }
  return available.empty() ? 0 : available.front();
}

bool Materials::has_normal_map(const Json* material) { return material->find("normalTexture") != nullptr; }

const Surface& Materials::surface(const Json* material, const PrimitiveTraits& traits) {
  const auto [known, is_new] = surfaces_.try_emplace({material, traits});
  if (!is_new) return known->second;
  return known->second = make_surface(asset_, images_, *material, traits, set_of(material, traits.sets));
}

}  // namespace norrsken::gltf
