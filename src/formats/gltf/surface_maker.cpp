#include "formats/gltf/surface_maker.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/text.h"
#include "color/srgb.h"

namespace norrsken::gltf {
namespace {

using Texel = std::array<float, 4>;
using Factor = std::array<double, 3>;

float stored(float linear) { return srgb_from_linear(linear); }

/// Extensions of materials whose effect is left out.
struct LeftOut {
  const char *name, *factor, *instead;
};
constexpr LeftOut kLeftOut[] = {
    {"KHR_materials_iridescence", "iridescenceFactor", "no thin film"},
    {"KHR_materials_anisotropy", "anisotropyStrength", "the same roughness in all directions"},
    {"KHR_materials_dispersion", "dispersion", "one index of refraction for all colours"},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionFactor", "no light through the diffuse base"}};

/// Puts one surface together.
class SurfaceMaker {
 public:
  SurfaceMaker(Asset& all, Images& all_images, const Json& json, const PrimitiveTraits& of_primitive,
               std::size_t texcoords)
      : asset(all), images(all_images), material(json), traits(of_primitive), set(texcoords), place(all.place(json)) {}

  Surface make();

 private:
  Asset& asset;
  Images& images;
  const Json& material;
  const PrimitiveTraits& traits;
  std::size_t set;
  SourceLocation place;
  bool is_volume = false;

  /// Empty as well if the texture is for other texture coordinates than the primitive has.
  std::optional<TextureUse> use(const Json& object, std::string_view name) {
    auto found = images.use(object, name);
    if (!found) return found;
    if (std::ranges::find(traits.sets, found->set) == traits.sets.end()) {
      asset.tell(*found->info, fmt::format("'{}' is for TEXCOORD_{}, which a primitive lacks", name, found->set),
                 "no texture there");
      return std::nullopt;
    }
    if (found->set != set) {
      asset.tell(
          *found->info,
          fmt::format("'{}' is for TEXCOORD_{}, other textures of the material for TEXCOORD_{}", name, found->set, set),
          "no texture there");
      return std::nullopt;
    }
    return found;
  }

  /// A colour with a factor as a parameter of `node`: a number or a texture.
  void color(Node& node, const char* parameter, const Json& object, std::string_view texture, const Factor& factor) {
    const auto found = use(object, texture);
    if (!found) return give(node, parameter, Property::Rgb{factor}, place);
    auto bitmap = images.bitmap(
        *found, fmt::format("color {} {} {}", factor[0], factor[1], factor[2]), false, [factor](const Texel& t) {
          return std::array<float, 3>{t[0] * static_cast<float>(factor[0]), t[1] * static_cast<float>(factor[1]),
                                      t[2] * static_cast<float>(factor[2])};
        });
    if (bitmap) node.children.push_back({parameter, std::move(bitmap), place});
  }

  /// A number with a factor, in one channel of a texture: 0 to 3 for red to alpha; `invert` of what 1 - v counts.
  void number(Node& node, const char* parameter, const Json& object, std::string_view texture, int channel,
              double factor, bool invert = false) {
    const auto found = use(object, texture);
    if (!found) return give(node, parameter, invert ? 1 - factor : factor, place);
    auto bitmap =
        images.bitmap(*found, fmt::format("number {} {} {}", channel, factor, invert), true, [=](const Texel& t) {
          const auto c = static_cast<std::size_t>(channel);
          const float value = (channel == 3 ? t[c] : stored(t[c])) * static_cast<float>(factor);
          return std::array<float, 3>{invert ? 1 - value : value};
        });
    if (bitmap) node.children.push_back({parameter, std::move(bitmap), place});
  }

  Node mesh_attribute(const char* name) {
    Node node = make_node("texture", "mesh_attribute", place);
    give(node, "name", std::string(name), place);
    return node;
  }

  /// What the medium inside lets pass on half of its way, as a factor for each of its two sides.
  Factor attenuation(const Json& volume, double thickness) {
    const double distance = asset.number(volume, "attenuationDistance", 0, 0);
    const auto color = asset.numbers<3>(volume, "attenuationColor", {1, 1, 1});
    Factor factor{1, 1, 1};
    if (distance <= 0 || color == Factor{1, 1, 1}) return factor;
    for (std::size_t c = 0; c < 3; ++c)
      factor[c] = std::pow(std::clamp(color[c], 0.0, 1.0), thickness / (2 * distance));
    asset.tell(volume, "absorption inside of KHR_materials_volume is not followed",
               "its color at the thickness that the material tells, half of it at each surface");
    return factor;
  }

  void transmission(Node& bsdf, Factor& base) {
    const Json* extension = asset.extension(material, "KHR_materials_transmission");
    if (!extension) return;
    const double factor = asset.number(*extension, "transmissionFactor", 0, 0, 1);
    if (factor == 0) return;
    number(bsdf, "transmission", *extension, "transmissionTexture", 0, factor);
    const Json* volume = asset.extension(material, "KHR_materials_volume");
    const double thickness = volume ? asset.number(*volume, "thicknessFactor", 0, 0) : 0;
    if (thickness <= 0) return;
    give(bsdf, "thin", false, place);
    is_volume = true;
    const Factor passed = attenuation(*volume, thickness);
    for (std::size_t c = 0; c < 3; ++c) base[c] *= passed[c];
  }

  void clearcoat(Node& bsdf) {
    const Json* extension = asset.extension(material, "KHR_materials_clearcoat");
    const double factor = extension ? asset.number(*extension, "clearcoatFactor", 0, 0, 1) : 0;
    if (factor == 0) return;
    number(bsdf, "clearcoat", *extension, "clearcoatTexture", 0, factor);
    number(bsdf, "clearcoat_roughness", *extension, "clearcoatRoughnessTexture", 1,
           asset.number(*extension, "clearcoatRoughnessFactor", 0, 0, 1));
    if (extension->find("clearcoatNormalTexture"))
      asset.tell(*extension, "'clearcoatNormalTexture' is not supported", "the normals of what is below");
  }

  void sheen(Node& bsdf) {
    const Json* extension = asset.extension(material, "KHR_materials_sheen");
    const Factor factor = extension ? asset.numbers<3>(*extension, "sheenColorFactor", {0, 0, 0}) : Factor{0, 0, 0};
    if (factor == Factor{0, 0, 0}) return;
    color(bsdf, "sheen_color", *extension, "sheenColorTexture", factor);
    number(bsdf, "sheen_roughness", *extension, "sheenRoughnessTexture", 3,
           asset.number(*extension, "sheenRoughnessFactor", 0, 0, 1));
  }

  void dielectric(Node& bsdf) {
    if (const Json* extension = asset.extension(material, "KHR_materials_ior")) {
      const double ior = asset.number(*extension, "ior", 1.5, 0, 100);
      if (ior != 1.5) give(bsdf, "ior", ior, place);
    }
    if (const Json* extension = asset.extension(material, "KHR_materials_specular")) {
      number(bsdf, "specular", *extension, "specularTexture", 3, asset.number(*extension, "specularFactor", 1, 0, 1));
      color(bsdf, "specular_color", *extension, "specularColorTexture",
            asset.numbers<3>(*extension, "specularColorFactor", {1, 1, 1}));
    }
  }

  Factor base_factor(const Json& object, std::string_view name, double& alpha) {
    const auto factor = asset.numbers<4>(object, name, {1, 1, 1, 1});
    alpha = std::clamp(factor[3], 0.0, 1.0);
    return {std::clamp(factor[0], 0.0, 1.0), std::clamp(factor[1], 0.0, 1.0), std::clamp(factor[2], 0.0, 1.0)};
  }

  /// Archived, and still met: a dielectric whose reflection head on is a colour.
  void specular_glossiness(Node& bsdf, const Json& object, Factor base) {
    give(bsdf, "metallic", 0.0, place);
    color(bsdf, "base_color", object, "diffuseTexture", base);
    Factor specular = asset.numbers<3>(object, "specularFactor", {1, 1, 1});
    for (double& s : specular) s /= 0.04;
    color(bsdf, "specular_color", object, "specularGlossinessTexture", specular);
    number(bsdf, "roughness", object, "specularGlossinessTexture", 3, asset.number(object, "glossinessFactor", 1, 0, 1),
           true);
  }

  /// A bsdf around another, with what stands before and after it.
  std::shared_ptr<const Node> wrapped(const char* plugin, Node inside, const std::function<void(Node&)>& before,
                                      const std::function<void(Node&)>& after = {}) {
    Node around = make_node("bsdf", plugin, place);
    if (before) before(around);
    around.children.push_back({{}, std::make_shared<const Node>(std::move(inside)), place});
    if (after) after(around);
    return std::make_shared<const Node>(std::move(around));
  }

  Node with_normal_map(Node bsdf) {
    const auto found = use(material, "normalTexture");
    if (!found) return bsdf;
    const double scale = asset.number(*found->info, "scale", 1);
    const float flip = traits.is_mirrored ? -1.0f : 1.0f, s = static_cast<float>(scale);
    auto bitmap = images.bitmap(*found, fmt::format("normal {} {}", scale, flip), false, [=](const Texel& t) {
      float x = s * (2 * stored(t[0]) - 1), y = s * flip * (2 * stored(t[1]) - 1), z = 2 * stored(t[2]) - 1;
      const float length = std::sqrt(x * x + y * y + z * z);
      if (!(length > 0)) return std::array<float, 3>{0.5f, 0.5f, 1};
      x /= length, y /= length, z /= length;
      return std::array<float, 3>{(x + 1) / 2, (y + 1) / 2, (z + 1) / 2};
    });
    if (!bitmap) return bsdf;
    // Facets that face away are what makes a rough surface dark at its edge, not the map.
    return *wrapped("normalmap", std::move(bsdf), [&](Node& around) {
      around.children.push_back({"normalmap", bitmap, place});
      give(around, "use_shadowing_function", false, place);
    });
  }

  /// The same from behind, or nothing; the boundary of a volume has its own back.
  Node with_back(Node bsdf) {
    if (is_volume) return bsdf;
    const bool is_double_sided = asset.boolean(material, "doubleSided", false);
    return *wrapped("twosided", std::move(bsdf), {}, [&](Node& around) {
      if (!is_double_sided)
        around.children.push_back({{}, std::make_shared<const Node>(make_node("bsdf", "null", place)), place});
    });
  }

  /// With what its alpha leaves out.
  Node with_coverage(Node bsdf, const Json& base_object, std::string_view base_texture, double alpha) {
    const std::string mode = asset.string(material, "alphaMode", "OPAQUE");
    if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND")
      asset.error(*material.find("alphaMode"), fmt::format("unknown alphaMode {}", quoted(mode)),
                  "OPAQUE, MASK, BLEND");
    if (mode == "OPAQUE") return bsdf;
    const auto found = use(base_object, base_texture);
    const double cutoff = asset.number(material, "alphaCutoff", 0.5, 0);
    const bool cuts = mode == "MASK";
    if (!found && (!traits.has_alpha || cuts)) {
      if (cuts && traits.has_alpha)
        asset.tell(material, "alphaMode MASK does not heed the alpha of COLOR_0", "that of the factor");
      const double opacity = cuts ? (alpha >= cutoff ? 1 : 0) : alpha;
      if (opacity == 1) return bsdf;
      return *wrapped("mask", std::move(bsdf), [&](Node& around) { give(around, "opacity", opacity, place); });
    }
    if (found) {
      auto opacity = cuts ? images.cut_out(*found, alpha, cutoff)
                          : images.bitmap(*found, fmt::format("alpha {}", alpha), true, [=](const Texel& t) {
                              return std::array<float, 3>{t[3] * static_cast<float>(alpha)};
                            });
      if (!opacity) return bsdf;
      bsdf = *wrapped("mask", std::move(bsdf), [&](Node& around) {
        around.children.push_back({"opacity", opacity, place});
      });
    }
    if (traits.has_alpha && !cuts)
      bsdf = *wrapped("mask", std::move(bsdf), [&](Node& around) {
        around.children.push_back({"opacity", std::make_shared<const Node>(mesh_attribute("vertex_alpha")), place});
        if (!found && alpha != 1)
          asset.tell(material, "the alpha of COLOR_0 is not multiplied with that of the factor");
      });
    return bsdf;
  }

  /// What shines is as bright as it is there: what alpha leaves out does not.
  double covered(double alpha) {
    const std::string mode = asset.string(material, "alphaMode", "OPAQUE");
    if (mode == "MASK") return alpha >= asset.number(material, "alphaCutoff", 0.5, 0) ? 1 : 0;
    return mode == "BLEND" ? alpha : 1;
  }

  void emitter(Surface& surface, Node area) {
    surface.emitter = std::make_shared<const Node>(std::move(area));
    surface.shines_on_both_sides = asset.boolean(material, "doubleSided", false);
  }

  void emission(Surface& surface, const Json& base_object, std::string_view base_texture, double alpha) {
    const Json* strength = asset.extension(material, "KHR_materials_emissive_strength");
    Factor factor = asset.numbers<3>(material, "emissiveFactor", {0, 0, 0});
    for (double& e : factor) e = std::max(e, 0.0) * (strength ? asset.number(*strength, "emissiveStrength", 1, 0) : 1);
    if (factor == Factor{0, 0, 0}) return;
    if (asset.string(material, "alphaMode", "OPAQUE") != "OPAQUE" && use(base_object, base_texture)) {
      asset.tell(material, "emission is not left out where the base color's texture is transparent", "all of it");
    } else {
      for (double& e : factor) e *= covered(alpha);
    }
    Node area = make_node("emitter", "area", place);
    color(area, "radiance", material, "emissiveTexture", factor);
    emitter(surface, std::move(area));
  }

  /// The base color as emission alone.
  Surface unlit(const Json& base_object, std::string_view base_texture, const Factor& base, double alpha) {
    Surface surface;
    Node area = make_node("emitter", "area", place);
    const auto found = use(base_object, base_texture);
    if (traits.has_colors) {
      area.children.push_back({"radiance", std::make_shared<const Node>(mesh_attribute("vertex_color")), place});
      if (found || base != Factor{1, 1, 1})
        asset.tell(material, "vertex colors of KHR_materials_unlit are not multiplied with its base color",
                   "they alone");
    } else if (found) {
      const std::string key =
          fmt::format("unlit {} {} {} {} {} {}", base[0], base[1], base[2], alpha, covered(0.25), covered(0.75));
      auto bitmap = images.bitmap(*found, key, false, [&](const Texel& t) {
        const double share = covered(alpha * double{t[3]});
        std::array<float, 3> color{};
        for (std::size_t c = 0; c < 3; ++c) color[c] = static_cast<float>(base[c] * share) * t[c];
        return color;
      });
      if (bitmap) area.children.push_back({"radiance", std::move(bitmap), place});
    } else {
      const double share = covered(alpha);
      give(area, "radiance", Property::Rgb{{base[0] * share, base[1] * share, base[2] * share}}, place);
    }
    emitter(surface, std::move(area));
    Node black = make_node("bsdf", "diffuse", place);
    give(black, "reflectance", 0.0, place);
    surface.bsdf =
        std::make_shared<const Node>(with_coverage(with_back(std::move(black)), base_object, base_texture, alpha));
    return surface;
  }
};

Surface SurfaceMaker::make() {
  Surface surface;
  const Json* metallic = asset.member(material, "pbrMetallicRoughness", Json::Kind::object);
  const Json* glossy = asset.extension(material, "KHR_materials_pbrSpecularGlossiness");
  const Json& base_object = glossy ? *glossy : metallic ? *metallic : no_members();
  const char* base_texture = glossy ? "diffuseTexture" : "baseColorTexture";
  double alpha = 1;
  Factor base = base_factor(base_object, glossy ? "diffuseFactor" : "baseColorFactor", alpha);
  if (asset.extension(material, "KHR_materials_unlit")) return unlit(base_object, base_texture, base, alpha);
  Node bsdf = make_node("bsdf", "gltf", place);
  transmission(bsdf, base);
  if (glossy) {
    specular_glossiness(bsdf, *glossy, base);
  } else {
    color(bsdf, "base_color", base_object, base_texture, base);
    number(bsdf, "metallic", base_object, "metallicRoughnessTexture", 2,
           asset.number(base_object, "metallicFactor", 1, 0, 1));
    number(bsdf, "roughness", base_object, "metallicRoughnessTexture", 1,
           asset.number(base_object, "roughnessFactor", 1, 0, 1));
  }
  if (traits.has_colors)
    bsdf.children.push_back({"vertex_color", std::make_shared<const Node>(mesh_attribute("vertex_color")), place});
  if (!glossy) dielectric(bsdf);
  clearcoat(bsdf);
  sheen(bsdf);
  for (const LeftOut& left : kLeftOut) {
    const Json* extension = asset.extension(material, left.name);
    if (extension && extension->find(left.factor))
      asset.tell(*extension, std::string(left.name) + " is not supported", left.instead);
  }
  if (material.find("occlusionTexture"))
    asset.diagnostics.note(asset.place(*material.find("occlusionTexture")),
                           "occlusion textures have no effect: the light itself is followed");
  surface.bsdf = std::make_shared<const Node>(
      with_coverage(with_back(with_normal_map(std::move(bsdf))), base_object, base_texture, alpha));
  emission(surface, base_object, base_texture, alpha);
  return surface;
}

}  // namespace

Surface make_surface(Asset& asset, Images& images, const Json& material, const PrimitiveTraits& traits,
                     std::size_t set) {
  return SurfaceMaker(asset, images, material, traits, set).make();
}

}  // namespace norrsken::gltf
