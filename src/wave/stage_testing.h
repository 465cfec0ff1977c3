// For tests of single stages on made-up queues: a small scene from text, and a wave's memory with records set by name.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "isa/kernel_testing.h"
#include "tests/temporary_folder.h"

namespace norrsken {

/// What stands in the middle of a scene file; the camera at the origin looks along +z, with 90 degrees across.
inline std::unique_ptr<ViewedScene> scene_of(const std::string& objects, const std::string& camera_words = "",
                                             const std::string& integrator_words = "", int width = 8, int height = 4) {
  const TemporaryFolder folder;
  return view_scene(folder.write("scene.xml", R"(<scene version="3.0.0"><integrator type="path">)" + integrator_words +
                                                  R"(</integrator><sensor type="perspective">)" + camera_words +
                                                  R"(<float name="fov" value="90"/><string name="fov_axis" value="x"/>
    <transform name="to_world"><lookat origin="0,0,0" target="0,0,1" up="0,1,0"/></transform>
    <film type="hdrfilm"><integer name="width" value=")" +
                                                  std::to_string(width) + R"("/><integer name="height" value=")" +
                                                  std::to_string(height) +
                                                  R"("/><rfilter type="box"/></film></sensor>)" + objects + "</scene>"),
                    AccelKind::planes);
}

/// A square of edges 2 around (0, 0, z) whose front is seen from the camera; inside it: its children.
inline std::string facing_square(double z, const std::string& inside) {
  return R"(<shape type="rectangle"><transform name="to_world"><rotate y="1" angle="180"/><translate z=")" +
         std::to_string(z) + R"("/></transform>)" + inside + "</shape>";
}
inline std::string diffuse(const std::string& rgb) {
  return R"(<bsdf type="diffuse"><rgb name="reflectance" value=")" + rgb + R"("/></bsdf>)";
}
inline std::string area_light(const std::string& rgb) {
  return R"(<emitter type="area"><rgb name="radiance" value=")" + rgb + R"("/></emitter>)";
}
inline std::string point_light(const std::string& place, const std::string& rgb) {
  return R"(<emitter type="point"><point name="position" )" + place + R"(/><rgb name="intensity" value=")" + rgb +
         R"("/></emitter>)";
}

using Triple = std::array<float, 3>;

inline double dot(const Triple& a, const Triple& b) {
  return double{a[0]} * double{b[0]} + double{a[1]} * double{b[1]} + double{a[2]} * double{b[2]};
}
inline Triple unit(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

/// So that a scene has light, where it does not matter.
inline std::string far_light() { return point_light(R"(x="0" y="1000" z="0")", "1"); }

/// A ray of slot 0 that no light sampling competes with.
inline stored::Ray ray_along(const Triple& origin, const Triple& direction) {
  stored::Ray ray{};
  ray.origin = origin;
  ray.direction = direction;
  ray.throughput = {1, 1, 1};
  ray.eta2 = 1;
  return ray;
}

/// A wave's memory, its slots black.
class StageMemory {
 public:
  explicit StageMemory(std::uint32_t slots = 1) : arena_(slots, {.connections = true}) {
    memory.slots.count = slots;
    for (std::uint32_t s = 0; s < slots; ++s) {
      stored::Slot slot{};
      slot.key = 0x9e3779b9u * (s + 1);
      memory.slots.set(s, slot);
    }
  }

  template <class Record>
  static void push(Queue<Record>& queue, const Record& record) {
    queue.set(queue.count++, record);
    poison_tail(queue);
  }
  Triple radiance(std::uint32_t slot = 0) const { return memory.slots[slot].radiance; }

 private:
  WaveArena arena_;

 public:
  WaveMemory& memory = arena_.memory();
};

inline void expect_near(const Triple& got, const std::array<double, 3>& wanted, const std::string& what) {
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(double{got[k]}, wanted[k], 1e-5 * std::max(1.0, std::abs(wanted[k]))) << what << ", component " << k;
  }
}

/// Calls test(probe, name) for every instruction set that this processor runs.
template <class Test>
void for_every_isa(const Test& test) {
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) test(probe_of(**k), std::string((*k)->name));
}

}  // namespace norrsken
