// Which of our models each of pbrt's materials is, or is nearest to.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <utility>

#include "base/text.h"
#include "formats/pbrt/materials.h"
#include "formats/pbrt/subsurface.h"

namespace norrsken::pbrt {
namespace {

constexpr double kSmoothAlpha = 1e-3;  // below which pbrt's surfaces are smooth

double mean_of(const glm::dvec3& c) { return (c.r + c.g + c.b) / 3; }

/// The imaginary index of a conductor of real index 1 that reflects so much head on, as pbrt has it.
glm::dvec3 k_of_reflectance(const glm::dvec3& r) {
  const glm::dvec3 inside = glm::clamp(r, glm::dvec3(0), glm::dvec3(0.9999));
  return 2.0 * glm::sqrt(inside) / glm::sqrt(1.0 - inside);
}

double peak_of(const Pattern& pattern) {
  if (pattern.whole) return peak_of(pattern.whole());
  constexpr int kSamples = 64;
  double peak = 0;
  for (int i = 0; i < (pattern.is_constant ? 1 : kSamples * kSamples); ++i) {
    const glm::dvec3 color = pattern.at((glm::dvec2(i % kSamples, i / kSamples) + 0.5) / double{kSamples});
    peak = std::max({peak, color.r, color.g, color.b});
  }
  return peak;
}

}  // namespace

bool Materials::Roughness::is_smooth() const {
  return u.is_constant && v.is_constant && std::max(mean_of(u.value()), mean_of(v.value())) < kSmoothAlpha;
}

Materials::Roughness Materials::read_roughness(Parameters& p, const std::string& prefix, bool remap) {
  const Pattern both = textures_.number(p, prefix + "roughness", 0);
  const auto one = [&](const char* name) {
    const Pattern own = textures_.number(p, prefix + name, 0);
    const Pattern& pattern = p.has(prefix + name) ? own : both;
    return map(pattern, [remap](const glm::dvec3& r) {
      const glm::dvec3 positive = glm::max(glm::dvec3(mean_of(r)), glm::dvec3(0));
      return remap ? glm::sqrt(positive) : positive;
    });
  };
  return {one("uroughness"), one("vroughness")};
}

void Materials::give_roughness(Node& node, const Roughness& roughness, const Place& place) {
  give(node, "distribution", std::string("ggx"), place);
  give_number(context_, node, "alpha_u", roughness.u, place);
  give_number(context_, node, "alpha_v", roughness.v, place);
}

Node Materials::make_conductor(Definition& definition, const std::string& prefix) {
  Parameters& p = definition.parameters;
  const bool remap = p.flag("remaproughness", true);
  const Roughness roughness = read_roughness(p, prefix, remap);
  if (!prefix.empty()) {
    read_roughness(p, "interface.", remap);
    read_index(context_, p, "interface.eta", 1.5);
    textures_.number(p, "thickness", 0.01);
    textures_.number(p, "g", 0);
    textures_.color(p, "albedo", Slot::albedo, *definition.space);
    p.integer("maxdepth", 10);
    p.integer("nsamples", 1);
    context_.tell(p.place(), "material 'coatedconductor' is not supported", "its conductor, without the coat");
  }
  Node node = make_node("bsdf", roughness.is_smooth() ? "conductor" : "roughconductor", p.place());
  if (!roughness.is_smooth()) give_roughness(node, roughness, p.place());
  if (const auto reflectance = textures_.color(p, "reflectance", Slot::albedo, *definition.space)) {
    give(node, "eta", to_rgb(glm::dvec3(1)), p.place());
    give_color(context_, node, "k", map(*reflectance, k_of_reflectance), p.place());
    if (p.has(prefix + "eta") || p.has(prefix + "k"))
      p.error(nullptr, fmt::format("{} has 'reflectance' beside '{}eta' or '{}k'", p.object(), prefix, prefix),
              "either");
    return node;
  }
  const Parameter* eta = p.find({"rgb", "spectrum", "blackbody", "texture"}, prefix + "eta");
  const Parameter* k = p.find({"rgb", "spectrum", "blackbody", "texture"}, prefix + "k");
  const std::string_view metal = eta ? metal_of(*eta, "eta") : "Cu", other = k ? metal_of(*k, "k") : "Cu";
  if (metal == other && !metal.empty() && metal != "CuZn") {
    give(node, "material", std::string(metal), p.place());
    return node;
  }
  const glm::dvec3 copper_eta(0.201034, 0.923738, 1.10186), copper_k(3.91386, 2.45302, 2.1414);
  give_color(context_, node, "eta", textures_.color(p, prefix + "eta", Slot::unbounded, *definition.space, copper_eta),
             p.place());
  give_color(context_, node, "k", textures_.color(p, prefix + "k", Slot::unbounded, *definition.space, copper_k),
             p.place());
  return node;
}

Node Materials::make_plastic(const Parameters& p, const Pattern& reflectance, const Roughness& roughness, double eta) {
  const bool is_smooth = roughness.is_smooth();
  Node node = make_node("bsdf", is_smooth ? "plastic" : "roughplastic", p.place());
  give_color(context_, node, "diffuse_reflectance", reflectance, p.place());
  give(node, "int_ior", eta, p.place());
  give(node, "ext_ior", 1.0, p.place());
  give(node, "nonlinear", true, p.place());
  if (is_smooth) return node;
  const double u = mean_of(roughness.u.mean()), v = mean_of(roughness.v.mean());
  if (!roughness.u.is_constant || !roughness.v.is_constant || std::abs(u - v) > 1e-6)
    context_.tell(p.place(), "the roughness of coats is one number here", "the mean of textures and of u and v");
  give(node, "distribution", std::string("ggx"), p.place());
  give(node, "alpha", (u + v) / 2, p.place());
  return node;
}

Node Materials::make_coated_diffuse(Definition& definition) {
  Parameters& p = definition.parameters;
  const Roughness roughness = read_roughness(p, {}, p.flag("remaproughness", true));
  const Pattern reflectance = textures_.color(p, "reflectance", Slot::albedo, *definition.space, glm::dvec3(0.5));
  const double eta = read_index(context_, p, "eta", 1.5);
  textures_.number(p, "thickness", 0.01);
  textures_.number(p, "g", 0);
  const auto albedo = textures_.color(p, "albedo", Slot::albedo, *definition.space);
  p.integer("maxdepth", 10);
  p.integer("nsamples", 1);
  context_.tell(p.place(), "material 'coateddiffuse' is a coat without thickness here",
                "plastic, or roughplastic of distribution ggx, with nonlinear true");
  if (albedo && peak_of(*albedo) > 0)
    context_.tell(p.place(), "a medium inside the coat ('albedo') is not supported", "a clear coat");
  if (eta == 1) {
    Node node = make_node("bsdf", "diffuse", p.place());
    give_color(context_, node, "reflectance", reflectance, p.place());
    return node;
  }
  return make_plastic(p, reflectance, roughness, eta);
}

Node Materials::make_dielectric(Definition& definition) {
  Parameters& p = definition.parameters;
  const Roughness roughness = read_roughness(p, {}, p.flag("remaproughness", true));
  const double eta = read_index(context_, p, "eta", 1.5);
  const bool is_smooth = roughness.is_smooth() || eta == 1;
  Node node = make_node("bsdf", is_smooth ? "dielectric" : "roughdielectric", p.place());
  give(node, "int_ior", eta, p.place());
  give(node, "ext_ior", 1.0, p.place());
  if (!is_smooth) give_roughness(node, roughness, p.place());
  return node;
}

Node Materials::make_diffuse_transmission(Definition& definition) {
  Parameters& p = definition.parameters;
  const double scale = p.number("scale", 1, 0);
  const auto scaled = [scale](const glm::dvec3& c) { return glm::clamp(scale * c, glm::dvec3(0), glm::dvec3(1)); };
  const Pattern reflectance =
      map(textures_.color(p, "reflectance", Slot::albedo, *definition.space, glm::dvec3(0.25)), scaled);
  const Pattern transmittance =
      map(textures_.color(p, "transmittance", Slot::albedo, *definition.space, glm::dvec3(0.25)), scaled);
  context_.tell(p.place(), "what material 'diffusetransmission' lets through is scattered by 'principledthin' here",
                "a little less at slanting angles than alike in all directions");
  const double through = peak_of(transmittance), back = peak_of(reflectance);
  const double weight = through + back > 0 ? through / (through + back) : 0;
  const auto share = [](double part) {
    return [part](const glm::dvec3& c) { return part > 0 ? glm::min(c / part, glm::dvec3(1)) : glm::dvec3(0); };
  };
  Node reflecting = make_node("bsdf", "diffuse", p.place());
  give_color(context_, reflecting, "reflectance", map(reflectance, share(1 - weight)), p.place());
  Node both = make_node("bsdf", "twosided", p.place());
  both.add(std::move(reflecting));
  Node letting_through = make_node("bsdf", "principledthin", p.place());
  give_color(context_, letting_through, "base_color", map(transmittance, share(weight)), p.place());
  give(letting_through, "diff_trans", 2.0, p.place());
  give(letting_through, "eta", 1.0, p.place());
  Node node = make_node("bsdf", "blendbsdf", p.place());
  give(node, "weight", weight, p.place());
  node.add(std::move(both));
  node.add(std::move(letting_through));
  return node;
}

Node Materials::make_subsurface(Definition& definition) {
  Parameters& p = definition.parameters;
  const Roughness roughness = read_roughness(p, {}, p.flag("remaproughness", true));
  const double g = p.number("g", 0);
  p.number("scale", 1);
  const double eta = read_index(context_, p, "eta", 1.33);
  const auto reflectance = textures_.color(p, "reflectance", Slot::albedo, *definition.space);
  textures_.color(p, "mfp", Slot::unbounded, *definition.space);
  const auto absorbed = textures_.color(p, "sigma_a", Slot::unbounded, *definition.space);
  const auto scattered = textures_.color(p, "sigma_s", Slot::unbounded, *definition.space);
  const Parameter* name = p.find("string", "name");
  context_.tell(p.place(), "material 'subsurface' is not supported",
                "a coat over a surface that scatters as much light back where it came in");
  Pattern color = Pattern::constant(multiple_scattering_albedo({.0011, .0024, .014}, {2.55, 3.21, 3.77}, g));
  if (name && p.has_values(*name, 1)) {
    const auto known = named_subsurface_albedo(name->strings[0]);
    if (!known)
      context_.tell(name->place, fmt::format("subsurface material {} is not known", quoted(name->strings[0])),
                    "the colour of " + listed(subsurface_names()) + "; here that of marble");
    color = Pattern::constant(known.value_or(*named_subsurface_albedo("Marble")));
  } else if (reflectance) {
    color = *reflectance;
  } else if (absorbed && scattered) {
    color = Pattern::constant(multiple_scattering_albedo(absorbed->mean(), scattered->mean(), g));
  } else if (absorbed || scattered) {
    p.error(nullptr, "material 'subsurface' has one of 'sigma_a' and 'sigma_s'", "both, or neither");
  }
  return make_plastic(p, color, roughness, eta);
}

Node Materials::make_hair(Definition& definition) {
  Parameters& p = definition.parameters;
  const auto absorbed = textures_.color(p, "sigma_a", Slot::unbounded, *definition.space);
  auto color = textures_.color(p, "reflectance", Slot::albedo, *definition.space);
  const auto alias = textures_.color(p, "color", Slot::albedo, *definition.space);
  if (!color) color = alias;
  const bool has_pigment = p.has("eumelanin") || p.has("pheomelanin");
  const Pattern brown = textures_.number(p, "eumelanin", has_pigment ? 0 : 1.3),
                red = textures_.number(p, "pheomelanin", 0);
  // Of a texture the mean.
  const auto number = [&](const char* name, double fallback) {
    return mean_of(textures_.number(p, name, fallback).mean());
  };
  const double eta = number("eta", 1.55), beta_m = number("beta_m", 0.3), beta_n = number("beta_n", 0.3),
               alpha = number("alpha", 2);
  const Pattern absorption = absorbed ? *absorbed
                             : color ? map(*color, [beta_n](const glm::dvec3& c) { return hair_absorption(c, beta_n); })
                                     : map({brown, red}, [](const std::vector<glm::dvec3>& amount) {
                                         return amount[0].r * kEumelanin + amount[1].r * kPheomelanin;
                                       });
  context_.tell(p.place(), "light that passes through a hair meets the far side of its tube as another hair",
                "hairs that are somewhat darker and rougher than pbrt's, which are flat");
  Node node = make_node("bsdf", "hair", p.place());
  give_color(context_, node, "sigma_a", absorption, p.place());
  give(node, "longitudinal_roughness", beta_m, p.place());
  give(node, "azimuthal_roughness", beta_n, p.place());
  give(node, "scale_tilt", alpha, p.place());
  give(node, "int_ior", eta, p.place());
  give(node, "ext_ior", 1.0, p.place());
  give(node, "along", std::string("u"), p.place());
  return node;
}

Node Materials::make_measured(Definition& definition) {
  Parameters& p = definition.parameters;
  const Parameter* filename = p.find("string", "filename");
  if (!filename) {
    p.error(nullptr, "material 'measured' has no file", R"("string filename" "name.bsdf")");
  } else {
    context_.find_file(*filename);
  }
  context_.tell(p.place(), "material 'measured' is not supported", "a grey diffuse surface of reflectance 0.5");
  Node node = make_node("bsdf", "diffuse", p.place());
  give(node, "reflectance", to_rgb(glm::dvec3(0.5)), p.place());
  return node;
}

}  // namespace norrsken::pbrt
