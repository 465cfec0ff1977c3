#include "scene/base_parameters.h"

#include <algorithm>
#include <iterator>

namespace norrsken {
namespace {

using Type = BaseParameter::Type;

// Source: what Mitsuba 3.9.1 takes when each is given to each of its plugins.
constexpr BaseParameter kTable[] = {
    {"bsdf", "twosided", "allow_transmission", Type::boolean, ""},
    {"emitter", "constant", "to_world", Type::transform, ""},
    {"film", "", "compensate", Type::boolean, ""},
    {"integrator", "", "block_size", Type::integer, ""},
    {"integrator", "", "samples_per_pass", Type::integer, ""},
    {"integrator", "", "timeout", Type::number, "--time"},
    {"integrator", "aov", "hide_emitters", Type::boolean, "hide_emitters of the integrator inside"},
    {"integrator", "depth", "hide_emitters", Type::boolean, ""},
    {"integrator", "moment", "hide_emitters", Type::boolean, "hide_emitters of the integrator inside"},
    {"integrator", "volpathmis", "use_spectral_mis", Type::boolean, ""},
    {"medium", "", "has_spectral_extinction", Type::boolean, ""},
    {"scene", "", "allow_thread_reordering", Type::boolean, ""},
    {"scene", "", "compact_acceleration_structures", Type::boolean, ""},
    {"scene", "", "embree_use_robust_intersections", Type::boolean, ""},
    {"scene", "", "kd_clip", Type::boolean, ""},
    {"scene", "", "kd_empty_space_bonus", Type::number, ""},
    {"scene", "", "kd_exact_primitive_threshold", Type::integer, ""},
    {"scene", "", "kd_intersection_cost", Type::number, ""},
    {"scene", "", "kd_max_depth", Type::integer, ""},
    {"scene", "", "kd_min_max_bins", Type::integer, ""},
    {"scene", "", "kd_retract_bad_splits", Type::boolean, ""},
    {"scene", "", "kd_stop_prims", Type::integer, ""},
    {"scene", "", "kd_traversal_cost", Type::number, ""},
    {"sensor", "", "focus_distance", Type::number, "sensor 'thinlens'"},
    {"sensor", "", "shutter_close", Type::number, ""},
    {"sensor", "", "shutter_open", Type::number, ""},
    {"shape", "", "silhouette_sampling_weight", Type::number, ""},
    {"shape", "rectangle", "face_normals", Type::boolean, ""},
    {"shape", "shapegroup", "to_world", Type::transform, "to_world of the instances and of the shapes inside"},
    {"spectrum", "blackbody", "wavelength_max", Type::number, ""},
    {"spectrum", "blackbody", "wavelength_min", Type::number, ""},
    {"volume", "gridvolume", "max_value", Type::number, ""},
};

}  // namespace

std::span<const BaseParameter> base_parameters() { return kTable; }

const BaseParameter* find_base_parameter(std::string_view kind, std::string_view plugin, std::string_view name) {
  const auto* found = std::ranges::find_if(kTable, [&](const BaseParameter& row) {
    return row.kind == kind && row.name == name && (row.plugin.empty() || row.plugin == plugin);
  });
  return found == std::end(kTable) ? nullptr : found;
}

}  // namespace norrsken
