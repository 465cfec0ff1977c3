// The intersectors must agree ray by ray. Where they do not, the ray must run along an edge, which double
// precision decides.
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "accel/polygons.h"
#include "isa/kernel_testing.h"
#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kRays = 200'000;

glm::dvec3 at(const float* x, const float* y, const float* z, std::uint32_t i) { return {x[i], y[i], z[i]}; }

/// Whether the ray passes any triangle's edge, or any sphere's silhouette, closer than rounding can tell.
bool runs_along_an_edge(const SceneTables& scene, const glm::dvec3& o, const glm::dvec3& d) {
  const double tolerance = 2e-5 * scene_scale(scene);
  for (std::size_t i = 0; i < scene.triangle_count(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = [&](std::size_t c) {
        const float* p = scene.positions.data() + 3 * scene.triangle_vertices[3 * i + c % 3];
        return glm::dvec3(p[0], p[1], p[2]);
      };
      const glm::dvec3 a = corner(k), e = corner(k + 1) - a, n = glm::cross(d, e);
      const double length = glm::length(n);
      if (length < 1e-9 || std::abs(glm::dot(a - o, n)) / length < tolerance) return true;
    }
  }
  for (std::size_t i = scene.triangle_count(); i < scene.surfaces.size(); ++i) {
    const float* g = scene.surfaces[i].geometry;
    const glm::dvec3 l = glm::dvec3(g[0], g[1], g[2]) - o;
    if (std::abs(glm::length(l - d * glm::dot(l, d)) - static_cast<double>(g[3])) < tolerance) return true;
  }
  return false;
}

struct Closest {
  Answers<float> t{kRays};
  Answers<std::uint32_t> primitive{kRays};

  Closest(const ViewedScene& viewed, const KernelEntry& kernels, const RandomRays& rays, bool coherent) {
    probe_of(kernels).closest_rays(viewed.view, coherent, rays.arrays(), t.data(), primitive.data());
  }
};

/// Whether both surfaces lie in one plane (one may face the other way): which of them a ray meets first is open.
bool coincide(const SceneTables& scene, std::uint32_t a, std::uint32_t b) {
  if (a >= scene.triangle_count() || b >= scene.triangle_count()) return false;
  const float *p = scene.surfaces[a].geometry, *q = scene.surfaces[b].geometry;
  const float cosine = p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  return std::abs(cosine) > 1 - 1e-6f &&
         std::abs(p[3] - std::copysign(1.0f, cosine) * q[3]) < 1e-5f * static_cast<float>(scene_scale(scene));
}

/// Same distance, same side, and a primitive of the same shape (planes name a merged polygon by its first triangle).
void expect_agreement(const ViewedScene& viewed, const RandomRays& rays, const Closest& a, const Closest& b,
                      const std::string& what) {
  const SceneTables& tables = viewed.scene.tables().tables;
  const RayArrays& r = rays.arrays();
  std::uint32_t differing = 0, hits = 0;
  for (std::uint32_t i = 0; i < kRays; ++i) {
    const bool hit_a = a.primitive[i] != kNone, hit_b = b.primitive[i] != kNone;
    hits += hit_b ? 1u : 0u;
    bool same = hit_a == hit_b;
    if (hit_a && hit_b) {
      const auto shape = [&](std::uint32_t word) { return tables.surfaces[word & 0x7fffffffu].shape; };
      const bool same_surface =
          (a.primitive[i] >> 31) == (b.primitive[i] >> 31) && shape(a.primitive[i]) == shape(b.primitive[i]);
      same = std::abs(a.t[i] - b.t[i]) <= 2e-5f * std::max(a.t[i], static_cast<float>(scene_scale(tables))) &&
             (same_surface || coincide(tables, a.primitive[i] & 0x7fffffffu, b.primitive[i] & 0x7fffffffu));
    }
    if (same) continue;
    ++differing;
    EXPECT_TRUE(runs_along_an_edge(tables, at(r.ox, r.oy, r.oz, i), at(r.dx, r.dy, r.dz, i)))
        << what << ": ray " << i << ", t " << a.t[i] << " and " << b.t[i] << ", primitives " << std::hex
        << a.primitive[i] << " and " << b.primitive[i];
    if (differing > 20) break;
  }
  EXPECT_LE(differing, kRays / 10'000) << what;
  EXPECT_GT(hits, kRays / 20) << what;
}

class Agreement : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<ViewedScene> load(AccelKind kind) const {
    return view_scene(GetParam() == "hexagon_room" ? GetParam() : NORRSKEN_TEST_SCENES + GetParam() + ".xml", kind);
  }
};

TEST_P(Agreement, ClosestHits) {
  const auto reference = load(AccelKind::moller_trumbore), planes = load(AccelKind::planes), bvh = load(AccelKind::bvh),
             embree = load(AccelKind::embree);
  // Rays from a box half again as large as the scene: from inside and from outside, from behind every surface.
  const SceneInfo info = reference->scene.info();
  double lower[3], upper[3];
  for (int k = 0; k < 3; ++k) {
    const double margin = 0.25 * (info.bounds_max[k] - info.bounds_min[k]) + 0.1;
    lower[k] = info.bounds_min[k] - margin, upper[k] = info.bounds_max[k] + margin;
  }
  const RandomRays rays(kRays, 3, lower, upper);
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    const Closest wanted(*reference, **k, rays, false);
    expect_agreement(*reference, rays, Closest(*planes, **k, rays, false), wanted, std::string((*k)->name) + " planes");
    expect_agreement(*reference, rays, Closest(*bvh, **k, rays, false), wanted, std::string((*k)->name) + " bvh");
    expect_agreement(*reference, rays, Closest(*embree, **k, rays, false), wanted, std::string((*k)->name) + " embree");
    expect_agreement(*reference, rays, Closest(*embree, **k, rays, true), wanted,
                     std::string((*k)->name) + " embree packets");
  }
}

/// Between two points of surfaces; planes may leave out what bounds the scene only for such segments.
TEST_P(Agreement, Occlusion) {
  const auto reference = load(AccelKind::moller_trumbore), planes = load(AccelKind::planes), bvh = load(AccelKind::bvh),
             embree = load(AccelKind::embree);
  const KernelEntry& kernels = *find_kernels("auto");
  // All from inside the room: its walls' backs scatter nothing, so no segment begins behind them.
  const double lower[3] = {0, -5, -4.9}, upper[3] = {10, 5, 4.8};
  const RandomRays first(kRays, 11, lower, upper);
  const Closest ends(*reference, kernels, first, false);
  // From one ray's hit, pulled back a little, to that of the next ray that has one.
  const double pulled = 1e-4 * scene_scale(reference->scene.tables().tables);
  const double anywhere[3] = {0, 0, 0};
  RandomRays segments(kRays, 12, anywhere, anywhere);
  Answers<float> t_max(kRays);
  const RayArrays &f = first.arrays(), &s = segments.arrays();
  std::uint32_t count = 0;
  glm::dvec3 previous;
  for (std::uint32_t i = 0, found = 0; i < kRays; ++i) {
    const double distance = static_cast<double>(ends.t[i]) - pulled;
    if (ends.primitive[i] == kNone || distance < pulled) continue;
    const glm::dvec3 p = at(f.ox, f.oy, f.oz, i) + at(f.dx, f.dy, f.dz, i) * distance;
    if (found++ > 0) {
      const glm::dvec3 d = glm::normalize(p - previous);
      float* fields[6] = {const_cast<float*>(s.ox), const_cast<float*>(s.oy), const_cast<float*>(s.oz),
                          const_cast<float*>(s.dx), const_cast<float*>(s.dy), const_cast<float*>(s.dz)};
      for (int k = 0; k < 3; ++k) {
        fields[k][count] = static_cast<float>(previous[k]);
        fields[3 + k][count] = static_cast<float>(d[k]);
      }
      t_max.data()[count++] = static_cast<float>(glm::length(p - previous));
    }
    previous = p;
  }
  ASSERT_GT(count, kRays / 100);
  Answers<std::uint8_t> wanted(kRays), got(kRays);
  RayArrays rays = s;
  rays.count = count;
  kernels.occluded_rays(reference->view, rays, t_max.data(), wanted.data());
  std::uint32_t occluded = 0;
  for (std::uint32_t i = 0; i < count; ++i) occluded += wanted[i];
  EXPECT_GT(occluded, 0u);
  for (const ViewedScene* viewed : {planes.get(), bvh.get(), embree.get()}) {
    for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
      (*k)->occluded_rays(viewed->view, rays, t_max.data(), got.data());
      std::uint32_t differing = 0;
      for (std::uint32_t i = 0; i < count; ++i) {
        if (got[i] == wanted[i]) continue;
        ++differing;
        EXPECT_TRUE(
            runs_along_an_edge(reference->scene.tables().tables, at(s.ox, s.oy, s.oz, i), at(s.dx, s.dy, s.dz, i)))
            << accel_name(viewed->view.accel.kind) << " " << (*k)->name << ": segment " << i;
      }
      EXPECT_LE(differing, count / 10'000 + 1) << accel_name(viewed->view.accel.kind) << " " << (*k)->name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, testing::Values("hexagon_room", "soup"),
                         [](const auto& parameter) { return parameter.param; });

/// What is tried one by one beside the hierarchy is what Embree's callbacks find, flipped and squeezed, with its side.
TEST(BesideTheHierarchy, IsMetAsThroughEmbree) {
  const std::string shapes[] = {"sphere", "disk", "cylinder"};
  std::string xml = R"(<scene version="3.0.0"><sensor type="perspective"/><emitter type="constant"/>
    <shape type="cube"><transform name="to_world"><scale value="3"/></transform></shape>)";
  for (int i = 0; i < 12; ++i) {
    const std::string& type = shapes[i % 3];
    const std::string scale = type == "disk" ? R"(<scale x="0.7" y="0.7" z="2"/>)" : R"(<scale value="0.6"/>)";
    xml += "<shape type=\"" + type + "\"><boolean name=\"flip_normals\" value=\"" + (i % 2 == 0 ? "true" : "false") +
           "\"/><transform name=\"to_world\">" + scale +
           "<rotate x=\"0.436435780\" y=\"0.872871561\" z=\"0.218217890\" angle=\"" + std::to_string(40 * i) +
           "\"/><translate x=\"" + std::to_string(i % 4 - 1.5) + "\" y=\"" + std::to_string(i / 4 - 1) + "\" z=\"" +
           std::to_string(0.3 * i - 2) + "\"/></transform></shape>";
  }
  const TemporaryFolder folder;
  const std::string file = folder.write("shapes.xml", xml + "</scene>");
  const auto bvh = view_scene(file, AccelKind::bvh), embree = view_scene(file, AccelKind::embree);
  ASSERT_NE(bvh, nullptr);
  ASSERT_EQ(bvh->view.accel.analytic_count, 8u);
  const double lower[3] = {-2.9, -2.9, -2.9}, upper[3] = {2.9, 2.9, 2.9};
  const RandomRays rays(kRays, 13, lower, upper);
  std::vector<std::uint32_t> met(bvh->scene.tables().tables.surfaces.size());
  Answers<float> t_max(kRays);
  for (std::uint32_t i = 0; i < kRays; ++i) t_max.data()[i] = 0.001f * static_cast<float>(i % 4000);
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    const Closest ours(*bvh, **k, rays, false), theirs(*embree, **k, rays, false);
    Answers<std::uint8_t> hidden(kRays), hidden_from_them(kRays);
    (*k)->occluded_rays(bvh->view, rays.arrays(), t_max.data(), hidden.data());
    (*k)->occluded_rays(embree->view, rays.arrays(), t_max.data(), hidden_from_them.data());
    std::uint32_t differing = 0;
    for (std::uint32_t i = 0; i < kRays; ++i) {
      const bool same = ours.primitive[i] == theirs.primitive[i] && hidden[i] == hidden_from_them[i] &&
                        std::abs(ours.t[i] - theirs.t[i]) <= 1e-4f;
      differing += same ? 0u : 1u;
      if (ours.primitive[i] != kNone) ++met[ours.primitive[i] & 0x7fffffffu];
    }
    EXPECT_LE(differing, kRays / 5000) << (*k)->name;  // at silhouettes
  }
  for (const std::uint32_t times : met) EXPECT_GT(times, 100u) << "everything is met";
}

/// So many triangles, all the same one, with so many spheres.
SceneTables tables_of(std::uint32_t triangles, std::uint32_t spheres) {
  SceneTables tables;
  for (const float x : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f}) tables.positions.push_back(x);
  for (std::uint32_t i = 0; i < 3 * triangles; ++i) tables.triangle_vertices.push_back(i % 3);
  tables.surfaces.resize(triangles + spheres);
  return tables;
}

TEST(ChooseAccel, GoesByWhatTheSceneHolds) {
  Diagnostics diagnostics;
  const auto automatic = [&](const SceneTables& tables, const SceneLayers& layers = {}) {
    return choose_accel("auto", tables, layers, 16, diagnostics);
  };
  EXPECT_EQ(automatic(tables_of(100, 5)), AccelKind::planes);
  SceneLayers with_triangles;
  with_triangles.features.push_back({"prim_index.Y", kFeaturePrimitive});
  EXPECT_EQ(automatic(tables_of(100, 5), with_triangles), AccelKind::bvh);
  EXPECT_EQ(automatic(tables_of(1000, 32)), AccelKind::bvh);
  EXPECT_EQ(automatic(tables_of(1000, 33)), AccelKind::embree);
  SceneTables other = tables_of(1000, 0);
  other.analytics.resize(1);
  other.analytics[0].kind = AnalyticKind::disk;
  EXPECT_EQ(automatic(other), AccelKind::bvh);
  other.analytics[0].kind = AnalyticKind::bsplinecurve;
  EXPECT_EQ(automatic(other), AccelKind::embree);
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_EQ(choose_accel("bvh", other, {}, 16, diagnostics), AccelKind::embree);
  SceneTables grouped = tables_of(1000, 0);
  grouped.group_count = 1;
  EXPECT_EQ(automatic(grouped), AccelKind::embree);
  EXPECT_EQ(choose_accel("bvh", grouped, {}, 16, diagnostics), AccelKind::embree);
  ASSERT_EQ(diagnostics.all().size(), 2u);
  EXPECT_EQ(diagnostics.all()[0].message,
            "accelerator 'bvh' knows triangles, spheres, disks and cylinders only, and this scene has curves or grids");
  EXPECT_EQ(diagnostics.all()[1].message,
            "accelerator 'bvh' knows triangles, spheres, disks and cylinders only, and this scene has groups");
}

TEST(Planes, MergeTheRoomToThirteenPlanes) {
  const auto viewed = view_scene("hexagon_room", AccelKind::planes);
  const PlaneTables tables = build_planes(viewed->scene.tables().tables);
  const auto planes = [](const PlaneSet& set) { return set.axis_begin[3] - set.axis_begin[0]; };
  EXPECT_EQ(planes(tables.all), 13u);  // floor, ceiling, 6 walls, 4 faces of the tetrahedron, the light
  // The tetrahedron and the light; the room itself has everything on its one side that scatters.
  EXPECT_EQ(planes(tables.occluders), 5u);
  EXPECT_EQ(planes(tables.emitters), 1u);
  std::uint32_t polygons = 0;
  for (std::uint32_t i = tables.all.axis_begin[0]; i < tables.all.axis_begin[3]; ++i) {
    polygons += tables.planes[i].polygon_count;
  }
  EXPECT_EQ(polygons, 13u);
}

TEST(Planes, LeaveNoWallOutThatLightFromOutsideMeets) {
  const auto viewed = view_scene("hexagon_room", AccelKind::planes);
  SceneTables scene = viewed->scene.tables().tables;
  LightRecord surroundings{};
  surroundings.kind = LightKind::constant;
  scene.lights.push_back(surroundings);
  const PlaneTables tables = build_planes(scene);
  EXPECT_EQ(tables.occluders.axis_begin[3] - tables.occluders.axis_begin[0], 13u);
}

}  // namespace
}  // namespace norrsken
