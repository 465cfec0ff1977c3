#include "formats/pbrt/textures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "base/text.h"
#include "formats/pbrt/texture_mapping.h"

namespace norrsken::pbrt {
namespace {

const std::vector<std::string> kTypes = {"bilerp", "checkerboard", "constant", "directionmix", "dots",
                                         "fbm",    "imagemap",     "marble",   "mix",          "ptex",
                                         "scale",  "windy",        "wrinkled"};

/// Perlin's noise is between -1 and 1; this is about what it is in size on the average.
constexpr double kNoise = 0.2;

glm::dvec3 mean_of_marble() { return {0.797, 0.795, 0.835}; }  // of its nine colours, weighed alike

}  // namespace

bool Textures::define(const std::string& kind, const std::string& name, TextureDefinition definition) {
  return definitions_.try_emplace({kind, name}, std::move(definition)).second;
}

Pattern Textures::number(Parameters& p, std::string_view name, double fallback) {
  const Parameter* parameter = p.find({"float", "texture"}, name);
  if (!parameter || !p.has_values(*parameter, 1)) return Pattern::constant(glm::dvec3(fallback));
  if (parameter->type == "float") return Pattern::constant(glm::dvec3(parameter->numbers[0]));
  return of({"float", parameter->strings[0]}, Slot::unbounded, p, *parameter);
}

std::optional<Pattern> Textures::color(Parameters& p, std::string_view name, Slot slot, const ColorSpace& space) {
  const Parameter* parameter = p.find({"rgb", "spectrum", "blackbody", "texture"}, name);
  if (!parameter) return std::nullopt;
  if (parameter->type == "texture") {
    if (!p.has_values(*parameter, 1)) return std::nullopt;
    return of({"spectrum", parameter->strings[0]}, slot, p, *parameter);
  }
  const auto color = color_of(context_, p, *parameter, slot, space);
  return Pattern::constant(color.value_or(glm::dvec3(0.5)));
}

Pattern Textures::color(Parameters& p, std::string_view name, Slot slot, const ColorSpace& space,
                        const glm::dvec3& fallback) {
  return color(p, name, slot, space).value_or(Pattern::constant(fallback));
}

void Textures::finish() {
  for (auto& [key, definition] : definitions_) {
    const bool is_used =
        std::ranges::any_of(patterns_, [&key = key](const auto& known) { return known.first.first == key; });
    if (!is_used) read(key, definition, key.first == "float" ? Slot::unbounded : Slot::albedo);
    definition.parameters.finish();
  }
}

Pattern Textures::of(const Key& key, Slot slot, Parameters& user, const Parameter& reference) {
  const Pattern fallback = Pattern::constant(glm::dvec3(0.5));
  const auto definition = definitions_.find(key);
  if (definition == definitions_.end()) {
    std::vector<std::string> known;
    for (const auto& [other, ignored] : definitions_) {
      if (other.first == key.first) known.push_back(other.second);
    }
    user.error(
        &reference,
        fmt::format("there is no {} texture {}{}", key.first, quoted(key.second), did_you_mean(key.second, known)),
        known.empty() ? fmt::format("a Texture of type {}", key.first) : listed(known));
    return fallback;
  }
  if (std::ranges::find(open_, key) != open_.end()) {
    user.error(&reference, fmt::format("texture {} is made of itself", quoted(key.second)),
               "a texture declared before");
    return fallback;
  }
  if (const auto known = patterns_.find({key, slot}); known != patterns_.end()) return known->second;
  open_.push_back(key);
  Pattern pattern = read(key, definition->second, slot);
  open_.pop_back();
  return patterns_.try_emplace({key, slot}, std::move(pattern)).first->second;
}

Pattern Textures::operand(const Key& key, TextureDefinition& definition, std::string_view name, double fallback,
                          Slot slot) {
  Parameters& p = definition.parameters;
  return key.first == "float" ? number(p, name, fallback)
                              : color(p, name, slot, *definition.space, glm::dvec3(fallback));
}

Pattern Textures::read(const Key& key, TextureDefinition& definition, Slot slot) {
  Parameters& p = definition.parameters;
  const std::string& type = definition.type;
  const auto child = [&](std::string_view name, double fallback) {
    return operand(key, definition, name, fallback, slot);
  };
  const auto flat = [&](const glm::dvec3& color) {
    context_.tell(p.place(), fmt::format("texture '{}' is not supported", type), "its mean value is taken");
    return Pattern::constant(color);
  };
  if (type == "constant") return child("value", 1);
  if (type == "scale") {
    return map({child("tex", 1), number(p, "scale", 1)}, [](const auto& v) { return v[0] * v[1]; });
  }
  if (type == "mix") {
    return map({child("tex1", 0), child("tex2", 1), number(p, "amount", 0.5)},
               [](const auto& v) { return glm::mix(v[0], v[1], v[2]); });
  }
  if (type == "directionmix") {
    p.vector("vector3", "dir");
    context_.tell(p.place(), "texture 'directionmix' is not supported", "both of its textures, half and half");
    return map({child("tex1", 0), child("tex2", 1)}, [](const auto& v) { return (v[0] + v[1]) / 2.0; });
  }
  if (type == "bilerp") {
    const auto corner = [&](const char* name, double fallback) { return child(name, fallback).mean(); };
    const glm::dvec3 v00 = corner("v00", 0), v01 = corner("v01", 1), v10 = corner("v10", 0), v11 = corner("v11", 1);
    const TextureMapping mapping = read_mapping(context_, p);
    if (!mapping.is_uv) return Pattern::constant((v00 + v01 + v10 + v11) / 4.0);
    Pattern pattern;
    pattern.is_constant = false;
    pattern.period = glm::dvec2(Pattern::kNoPeriod);
    pattern.texels = glm::dvec2(256);
    pattern.at = [=](const glm::dvec2& uv) {
      const glm::dvec2 st = mapping.at(uv);
      return glm::mix(glm::mix(v00, v10, st.x), glm::mix(v01, v11, st.x), st.y);
    };
    return pattern;
  }
  if (type == "checkerboard") {
    const std::int64_t dimension = p.integer("dimension", 2, 2, 3);
    const Pattern first = child("tex1", 1), second = child("tex2", 0);
    if (dimension == 3) return flat((first.mean() + second.mean()) / 2.0);
    const TextureMapping mapping = read_mapping(context_, p);
    if (!mapping.is_uv) return Pattern::constant((first.mean() + second.mean()) / 2.0);
    const Pattern squares = mapping.squares();
    return map({squares, first, second}, [](const auto& v) { return v[0].r > 0.5 ? v[1] : v[2]; });
  }
  if (type == "dots") {
    const Pattern inside = child("inside", 1), outside = child("outside", 0);
    read_mapping(context_, p);
    // Every other cell has one, of radius 0.35.
    constexpr double kShare = 0.5 * 3.14159265358979 * 0.35 * 0.35;
    context_.tell(p.place(), "texture 'dots' is not supported", "its mean value");
    return Pattern::constant(glm::mix(outside.mean(), inside.mean(), kShare));
  }
  if (type == "imagemap") return read_image(key, definition);
  if (key.first == "float" && (type == "fbm" || type == "wrinkled")) {
    p.integer("octaves", 8, 1);
    const double roughness = p.number("roughness", 0.5);
    return flat(glm::dvec3(type == "fbm" ? 0 : kNoise / std::max(1 - roughness, 0.1)));
  }
  if (key.first == "float" && type == "windy") return flat(glm::dvec3(0));
  if (key.first == "spectrum" && type == "marble") {
    p.integer("octaves", 8, 1);
    for (const char* name : {"roughness", "scale", "variation"}) p.number(name, 0);
    return flat(mean_of_marble());
  }
  if (type == "ptex") {
    p.text("filename", {});
    p.text("encoding", {});
    p.number("scale", 1);
    context_.tell(p.place(), "texture 'ptex' is not supported", "grey of 0.5");
    return Pattern::constant(glm::dvec3(0.5));
  }
  const bool exists = std::ranges::find(kTypes, type) != kTypes.end();
  context_.diagnostics.error(p.place().location(),
                             exists ? fmt::format("there is no texture '{}' of kind '{}'", type, key.first)
                                    : fmt::format("unknown texture {}{}", quoted(type), did_you_mean(type, kTypes)),
                             join(kTypes));
  return Pattern::constant(glm::dvec3(0.5));
}

Pattern Textures::read_image(const Key& key, TextureDefinition& definition) {
  Parameters& p = definition.parameters;
  ImageLookup lookup = read_lookup(p);
  lookup.is_number = key.first == "float";
  const TextureMapping mapping = read_mapping(context_, p);
  const Parameter* filename = p.find("string", "filename");
  if (!filename || !p.has_values(*filename, 1)) {
    if (!filename) p.error(nullptr, "texture 'imagemap' has no file", R"("string filename" "image.png")");
    return Pattern::constant(glm::dvec3(0.5));
  }
  return image_pattern(context_, images_, *filename, lookup, mapping);
}

}  // namespace norrsken::pbrt
