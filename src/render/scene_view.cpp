#include "render/scene_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <vector>

namespace norrsken {
namespace {

/// Russian roulette, which changes no mean, must come some time: paths in a closed white room would not end.
constexpr int kLatestRoulette = 4096;

/// Materials with more choices on the way to a model are left to chance: each doubles the ways to sample lights for.
constexpr std::uint32_t kMostListedChoices = 3;

constexpr struct {
  const char* name;
  AccelKind kind;
} kAccels[] = {{"planes", AccelKind::planes},
               {"moller_trumbore", AccelKind::moller_trumbore},
               {"bvh", AccelKind::bvh},
               {"embree", AccelKind::embree}};

/// Lanes that gather nothing read the first element, which scenes without a surface have none of.
template <class T>
const T* data_or_one(const Array<T>& values) {
  static const T one{};
  return values.empty() ? &one : values.data();
}

/// Whether shadow rays may pass a surface of these kinds: adapters may stand before one that they do.
bool passes_light(std::uint32_t bsdf_kinds) {
  constexpr std::uint32_t kPassing =
      1u << static_cast<std::uint32_t>(BsdfKind::null) | 1u << static_cast<std::uint32_t>(BsdfKind::thindielectric);
  return (bsdf_kinds & kPassing) != 0;
}

/// From what has a frame's members: the tables have those of the frame that they were loaded with.
template <class Frame>
void set_frame_from(const Frame& frame, const SceneTables& tables, SceneView& view) {
  view.camera = frame.camera;
  view.batch = frame.batch.data();
  view.batch_count = static_cast<std::uint32_t>(frame.batch.size());
  view.meter = frame.meter.data();
  view.film = frame.film;
  view.filter = frame.filter.data();
  view.sampler = frame.sampler;
  view.integrator = frame.integrator;
  view.integrator.rr_depth = std::min(view.integrator.rr_depth, kLatestRoulette);
  const bool scatters = !tables.media.empty();
  view.volumetric = frame.integrator.media && (scatters || passes_light(view.bsdf_kinds));
  // Paths that begin at the lights have no place to choose them for.
  const bool by_place = !tables.light_nodes.empty() && !frame.integrator.from_lights;
  view.light_nodes = by_place ? tables.light_nodes.data() : nullptr;
  const bool samples_lights = !tables.lights.empty() && frame.integrator.emitter_samples > 0;
  const bool lists_choices = view.any_resolved && samples_lights && tables.material_choices <= kMostListedChoices;
  view.material_codes = lists_choices ? 1u << tables.material_choices : SceneView().material_codes;
}

/// Planes widen their polygons by what rounding does to coordinates of the scene: too much for a mesh, or a part of one that
/// shares no vertex with the rest, that is far from the origin and small. At 300 times its size a triangle has grown by
/// 0.2 % of its area, at 3000 times by 2 %.
bool is_too_far_for_planes(const SceneTables& tables) {
  constexpr double kFarthest = 300;  // of a part's own size
  struct Box {
    std::array<double, 3> lower, upper;
  };
  std::vector<std::uint32_t> parent(tables.positions.size() / 3);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto part_of = [&](std::uint32_t vertex) {
    while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
    return vertex;
  };
  const auto& corners = tables.triangle_vertices;
  for (std::size_t i = 0; i < corners.size(); ++i) parent[part_of(corners[i])] = part_of(corners[i - i % 3]);
  std::map<std::uint32_t, Box> boxes;
  for (const std::uint32_t vertex : corners) {
    const float* at = &tables.positions[3 * std::size_t{vertex}];
    const std::array<double, 3> point{at[0], at[1], at[2]};
    Box& box = boxes.try_emplace(part_of(vertex), Box{point, point}).first->second;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::min(box.lower[axis], point[axis]);
      box.upper[axis] = std::max(box.upper[axis], point[axis]);
    }
  }
  return std::ranges::any_of(boxes, [](const auto& part) {
    const auto& [lower, upper] = part.second;
    double size2 = 0, farthest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      size2 += (upper[axis] - lower[axis]) * (upper[axis] - lower[axis]);
      farthest = std::max({farthest, std::abs(lower[axis]), std::abs(upper[axis])});
    }
    return size2 > 0 && farthest > kFarthest * std::sqrt(size2);
  });
}

}  // namespace

AccelKind choose_accel(const std::string& name, const SceneTables& tables, const SceneLayers& layers,
                       std::uint32_t lanes, Diagnostics& diagnostics) {
  // Planes hold polygons, which do not know the triangles that they were merged from.
  const bool counts_triangles = variation_of(layers) == Variation::by_triangle;
  const std::size_t primitives = tables.surfaces.size();
  const bool polygons_and_spheres = tables.analytics.empty() && tables.group_count == 0;
  const std::size_t beside_triangles = primitives - tables.triangle_count();
  AccelKind automatic = AccelKind::embree;
  if (polygons_and_spheres && primitives <= planes_up_to(lanes) && !counts_triangles &&
      !is_too_far_for_planes(tables)) {
    automatic = AccelKind::planes;
  } else if (bvh_knows(tables) && beside_triangles <= kBesideBvhAtMost) {
    automatic = AccelKind::bvh;
  }
  if (name == "auto") return automatic;
  for (const auto& accel : kAccels) {
    if (name != accel.name) continue;
    if (accel.kind == AccelKind::bvh && !bvh_knows(tables)) {
      diagnostics.error(
          {},
          std::string("accelerator 'bvh' knows triangles, spheres, disks and cylinders only, and this scene has ") +
              (tables.group_count == 0 ? "curves or grids" : "groups"),
          "auto or embree");
      return automatic;
    }
    if ((accel.kind == AccelKind::planes || accel.kind == AccelKind::moller_trumbore) && !polygons_and_spheres) {
      diagnostics.error({},
                        "accelerator '" + name + "' knows triangles and spheres only, and this scene has " +
                            (tables.analytics.empty() ? "groups" : "other shapes"),
                        bvh_knows(tables) ? "auto, bvh or embree" : "auto or embree");
      return automatic;
    }
    if (accel.kind == AccelKind::planes && primitives > kPlanesAtMost) {
      diagnostics.error(
          {},
          "accelerator 'planes' is for small scenes, and this one has " + std::to_string(primitives) + " primitives",
          "at most " + std::to_string(kPlanesAtMost) + " primitives, or bvh or embree");
    }
    return accel.kind;
  }
  diagnostics.error({}, "unknown accelerator '" + name + "'", "auto, bvh, embree, moller_trumbore, planes");
  return automatic;
}

std::vector<std::string> usable_isas() {
  std::vector<std::string> names;
  for (const KernelEntry* const* entry = usable_kernels(); *entry != nullptr; ++entry)
    names.emplace_back((*entry)->name);
  return names;
}

const KernelEntry* choose_kernels(const std::string& isa, Diagnostics& diagnostics) {
  const KernelEntry* kernels = find_kernels(isa.c_str());
  if (kernels != nullptr) return kernels;
  std::string usable = "auto";
  for (const std::string& name : usable_isas()) usable += ", " + name;
  diagnostics.error({}, "instruction set '" + isa + "' is not built in or not supported by this processor", usable);
  return nullptr;
}

const char* accel_name(AccelKind kind) {
  const auto* it = std::find_if(std::begin(kAccels), std::end(kAccels), [&](const auto& a) { return a.kind == kind; });
  return it->name;
}

SceneView make_scene_view(const SceneTables& tables, const AccelView& accel) {
  SceneView view;
  view.positions = tables.positions.data();
  view.normals = tables.normals.empty() ? nullptr : tables.normals.data();
  view.triangle_vertices = tables.triangle_vertices.data();
  view.surfaces = data_or_one(tables.surfaces);
  view.shapes = data_or_one(tables.shapes);
  view.parameters = tables.parameters.data();
  view.texels = tables.texels.data();
  view.texcoords = tables.texcoords.empty() ? nullptr : tables.texcoords.data();
  view.texture_kinds = tables.texture_kinds;
  view.needs_uv = tables.needs_uv;
  view.environment = tables.environment;
  std::copy_n(tables.center, 3, view.center);
  view.radius = tables.radius;
  view.lights = tables.lights.data();
  view.light_leaves = tables.light_leaves.data();
  view.lights_around = tables.lights_around.data();
  view.lights_around_count = static_cast<std::uint32_t>(tables.lights_around.size());
  view.primitive_lights = tables.primitive_lights.data();
  view.triangle_count = tables.triangle_count();
  view.sphere_count = tables.sphere_count();
  view.analytics = tables.analytics.data();
  view.first_analytic = tables.first_analytic;
  for (const AnalyticRecord& a : tables.analytics) view.analytic_kinds |= 1u << static_cast<std::uint32_t>(a.kind);
  view.instances = tables.instances.data();
  view.instance_count = static_cast<std::uint32_t>(tables.instances.size());
  view.light_count = static_cast<std::uint32_t>(tables.lights.size());
  for (const SurfaceRecord& s : tables.surfaces) {
    view.bsdf_kinds |= 1u << static_cast<std::uint32_t>(material_kind(s.material_front));
    view.bsdf_kinds |= 1u << static_cast<std::uint32_t>(material_kind(s.material_back));
  }
  view.any_resolved = view.bsdf_kinds >> kModelCount != 0;
  if (view.any_resolved) view.bsdf_kinds |= tables.bsdf_kinds | 1u << static_cast<std::uint32_t>(BsdfKind::absorb);
  view.refracts = (view.bsdf_kinds & kRefractingKinds) != 0;
  for (const LightRecord& light : tables.lights) view.light_kinds |= 1u << static_cast<std::uint32_t>(light.kind);
  view.media = data_or_one(tables.media);
  view.volumes = data_or_one(tables.volumes);
  view.phase_kinds = tables.phase_kinds;
  for (const MediumRecord& medium : tables.media) view.any_grid_medium |= medium.sigma_volume != kNone;
  view.any_area_light = !tables.primitive_lights.empty();
  view.any_smooth =
      std::any_of(tables.shapes.begin(), tables.shapes.end(), [](const ShapeRecord& s) { return s.smooth != 0; });
  set_frame_from(tables, tables, view);
  view.accel = accel;
  return view;
}

void set_frame(SceneView& view, const SceneFrame& frame, const SceneTables& tables) {
  set_frame_from(frame, tables, view);
}

}  // namespace norrsken
