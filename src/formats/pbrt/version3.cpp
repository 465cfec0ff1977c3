#include "formats/pbrt/version3.h"

#include <algorithm>
#include <iterator>

namespace norrsken::pbrt {
namespace {

struct Renamed {
  std::string_view directive, old, today;
};
constexpr Renamed kTypes[] = {
    {"Film", "image", "rgb"},
    {"Material", "matte", "diffuse"},
    {"Material", "glass", "dielectric"},
    {"Material", "metal", "conductor"},
    {"Material", "mirror", "conductor"},
    {"Material", "plastic", "coateddiffuse"},
    {"Material", "substrate", "coateddiffuse"},
    {"Material", "uber", "coateddiffuse"},
    {"Material", "translucent", "diffusetransmission"},
    {"Material", "none", "interface"},
    {"Material", "", "interface"},
    {"Sampler", "02sequence", "sobol"},
    {"Sampler", "lowdiscrepancy", "sobol"},
    {"Sampler", "maxmindist", "sobol"},
    {"Sampler", "random", "independent"},
    {"Integrator", "directlighting", "path"},
    {"AreaLightSource", "area", "diffuse"},
    {"LightSource", "goniometer", "goniometric"},
    {"LightSource", "exinfinite", "infinite"},
};

/// Of a directive's objects of that (old) type; empty: of any.
struct RenamedParameter {
  std::string_view directive, type, old, today;  ///< today empty: it is left out
};
constexpr RenamedParameter kParameters[] = {
    {"Material", "matte", "Kd", "reflectance"},
    {"Material", "matte", "sigma", ""},
    {"Material", "glass", "index", "eta"},
    {"Material", "glass", "Kr", ""},
    {"Material", "glass", "Kt", ""},
    {"Material", "mirror", "Kr", "reflectance"},
    {"Material", "plastic", "Kd", "reflectance"},
    {"Material", "plastic", "Ks", ""},
    {"Material", "substrate", "Kd", "reflectance"},
    {"Material", "substrate", "Ks", ""},
    {"Material", "uber", "Kd", "reflectance"},
    {"Material", "uber", "Ks", ""},
    {"Material", "uber", "Kr", ""},
    {"Material", "uber", "Kt", ""},
    {"Material", "uber", "opacity", ""},
    {"Material", "uber", "index", "eta"},
    {"Material", "translucent", "Kd", "reflectance"},
    {"Material", "translucent", "Ks", ""},
    {"Material", "translucent", "roughness", ""},
    {"Material", "translucent", "transmit", "transmittance"},
    {"Material", "translucent", "reflect", ""},
    {"Material", "", "bumpmap", "displacement"},
    {"Material", "mix", "namedmaterial1", ""},
    {"PixelFilter", "", "xwidth", "xradius"},
    {"PixelFilter", "", "ywidth", "yradius"},
    {"PixelFilter", "gaussian", "alpha", ""},
    {"Film", "", "scale", ""},
    {"Film", "", "maxsampleluminance", "maxcomponentvalue"},
    {"Camera", "", "halffov", ""},
    {"Integrator", "", "rrthreshold", ""},
    {"Integrator", "", "lightsamplestrategy", ""},
    {"Integrator", "", "strategy", ""},
    {"Integrator", "", "pixelbounds", ""},
    {"LightSource", "", "samples", ""},
    {"LightSource", "", "nsamples", ""},
    {"AreaLightSource", "", "samples", ""},
    {"AreaLightSource", "", "nsamples", ""},
    {"Shape", "", "st", "uv"},
    {"Shape", "", "nlevels", "levels"},
    {"Shape", "", "shadowalpha", ""},
    {"Texture", "", "trilinear", ""},
    {"Texture", "", "gamma", ""},
};

/// What version 3 takes where nothing is given, and today's material something else.
struct Default {
  std::string_view type, parameter, today;  ///< the type that it had, and its names then and now
  double value;
};
constexpr Default kDefaults[] = {
    {"plastic", "roughness", "roughness", 0.1},     {"plastic", "Kd", "reflectance", 0.25},
    {"substrate", "uroughness", "uroughness", 0.1}, {"substrate", "vroughness", "vroughness", 0.1},
    {"uber", "roughness", "roughness", 0.1},        {"uber", "Kd", "reflectance", 0.25},
    {"metal", "roughness", "roughness", 0.01},      {"mirror", "Kr", "reflectance", 0.9},
    {"translucent", "Kd", "reflectance", 0.25},
};

void add_defaults(const Place& place, Object3& object, const std::string& old_type) {
  if (object.directive != "Material") return;
  for (const Default& rule : kDefaults) {
    const bool is_given =
        std::ranges::any_of(object.parameters, [&](const auto& p) { return p->name == rule.parameter; });
    if (rule.type != old_type || is_given) continue;
    auto parameter = std::make_shared<Parameter>();
    const bool is_color = rule.today == "reflectance";
    parameter->type = is_color ? "rgb" : "float";
    parameter->name = rule.today;
    parameter->numbers.assign(is_color ? 3 : 1, rule.value);
    parameter->place = parameter->value = place;
    object.parameters.push_back(std::move(parameter));
  }
}

bool applies(const RenamedParameter& rule, const Object3& object, const std::string& old_type,
             const Parameter& parameter) {
  return rule.directive == object.directive && (rule.type.empty() || rule.type == old_type) &&
         rule.old == parameter.name;
}

void rename_parameters(Context& context, Object3& object, const std::string& old_type) {
  SharedParameters renamed;
  for (auto& parameter : object.parameters) {
    const auto* rule = std::ranges::find_if(
        kParameters, [&](const RenamedParameter& r) { return applies(r, object, old_type, *parameter); });
    if (rule == std::end(kParameters)) {
      renamed.push_back(std::move(parameter));
    } else if (rule->today.empty()) {
      context.tell(parameter->place, fmt::format("'{}' of {} '{}', of pbrt's version 3, has no effect", rule->old,
                                                 object.directive, old_type));
    } else {
      context.diagnostics.note(parameter->place.location(),
                               fmt::format("'{}' of {} '{}', of pbrt's version 3, is '{}'", rule->old, object.directive,
                                           old_type, rule->today));
      auto copy = std::make_shared<Parameter>(*parameter);
      copy->name = rule->today;
      if (rule->old == "st" && copy->type == "float") copy->type = "point2";
      renamed.push_back(std::move(copy));
    }
  }
  object.parameters = std::move(renamed);
}

}  // namespace

void update(Context& context, const Place& place, Object3& object) {
  const std::string old_type = object.type;
  const auto* type = std::ranges::find_if(
      kTypes, [&](const Renamed& r) { return r.directive == object.directive && r.old == object.type; });
  if (type != std::end(kTypes)) {
    object.type = type->today;
    context.diagnostics.note(place.location(), fmt::format("{} '{}', of pbrt's version 3, is '{}'", object.directive,
                                                           old_type, type->today));
  }
  add_defaults(place, object, old_type);
  const bool has_old = std::ranges::any_of(object.parameters, [&](const auto& p) {
    return std::ranges::any_of(kParameters,
                               [&](const RenamedParameter& r) { return applies(r, object, old_type, *p); });
  });
  if (has_old) rename_parameters(context, object, old_type);
}

}  // namespace norrsken::pbrt
