// What became of one sample of one pixel, vertex by vertex.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "norrsken/render.h"
#include "norrsken/result.h"
#include "norrsken/scene.h"

namespace norrsken {

/// A point, a unit direction or linear sRGB; lengths in scene units.
using Triple = std::array<float, 3>;

/// A ray of the path and what it met.
struct PathVertex {
  Triple origin{}, direction{}, throughput{};
  float pdf_sa = 0;  ///< density that sampled the direction; 0 if no light sampling competes with it

  bool hit = false;  ///< the rest is of what was hit; a last ray that is sent for emission alone meets emitters only
  float distance = 0;
  Triple position{};
  std::uint32_t shape = 0, primitive = 0;  ///< index of the shape in the scene, of the primitive within it
  std::string shape_id;                    ///< that the scene gives the shape; may be empty
  std::string bsdf;                        ///< as in "diffuse", or "blendbsdf > diffuse" where it was looked through

  Triple emission{};  ///< what the ray's end, a surface or the surroundings, added to the sample

  struct LightSample {
    std::string bsdf;  ///< that it was sampled for
    Triple origin{}, direction{};
    float distance = 0;
    Triple contribution{};  ///< to the sample, if nothing is in between
    bool reached = false;
  };
  std::vector<LightSample> light_samples;
};

struct PathTrace {
  std::vector<PathVertex> vertices;
  Triple radiance{};  ///< the sample's
};

/// The sample of pixel (x, y) of the image that a rendering with these options takes as its number `sample`, with the same
/// numbers on the way. Errors: an unknown instruction set or accelerator, a pixel outside of the image, or an integrator
/// whose paths do not belong to pixels.
Result<PathTrace> trace_path(const Scene& scene, const RenderOptions& options, int x, int y, std::uint32_t sample);

}  // namespace norrsken
