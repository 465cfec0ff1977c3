// Mesh files as people have them, seen in pictures.
#include <string>

#include "norrsken/image.h"
#include "tests/end_to_end/scene_folder.h"
#include "tests/told.h"

namespace norrsken::end_to_end {
namespace {

constexpr int kSize = 16;

class MeshFiles : public SceneFolder {
 protected:
  /// Of a scene that is loaded with warnings.
  statistics::Picture picture_with_warnings(const std::string& elements, const std::string& accelerator) const {
    write("scene.xml", "<scene version=\"3.0.0\">" + elements + "</scene>");
    Diagnostics diagnostics;
    const auto scene = told(Scene::load(path("scene.xml"), {}), diagnostics);
    EXPECT_TRUE(scene.has_value() && !diagnostics.has_errors() && !diagnostics.all().empty());
    return picture_of(render_image(*scene, {.samples_per_pixel = 16, .accelerator = accelerator}));
  }
};

const std::string kShines = R"(<emitter type="area"><float name="radiance" value="1"/></emitter>)";

TEST_F(MeshFiles, ConcavePolygonsShowTheirAreaAndNothingElse) {
  // An L of 5 squares in a view of 16, with edges on those of pixels.
  for (const char* face : {"1 2 3 4 5 6", "2 3 4 5 6 1", "3 4 5 6 1 2", "4 5 6 1 2 3"}) {
    write("a.obj", std::string("v -1 -1 0\nv 2 -1 0\nv 2 0 0\nv 0 0 0\nv 0 2 0\nv -1 2 0\nf ") + face + "\n");
    const Scene scene = load_elements(R"(<integrator type="path"/>)" + camera(kSize) + R"(<shape type="obj">)" +
                                      text("filename", "a.obj") + kShines + "</shape>");
    for (const char* accelerator : {"planes", "moller_trumbore", "bvh", "embree"}) {
      const auto picture = picture_of(render_image(scene, {.samples_per_pixel = 16, .accelerator = accelerator}));
      double sum = 0;
      for (const auto& pixel : picture.pixels) sum += pixel[1];
      EXPECT_NEAR(sum, 5 * 16, 1e-3) << face << " " << accelerator;
    }
  }
}

TEST_F(MeshFiles, WhatHasNothingToDrawLeavesTheSky) {
  write("line.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n");
  const std::string sky = R"(<emitter type="constant"><float name="radiance" value="2"/></emitter>)";
  for (const std::string& inside : {std::string(), kShines}) {
    for (const char* accelerator : {"planes", "moller_trumbore", "bvh", "embree"}) {
      const auto picture =
          picture_with_warnings(R"(<integrator type="path"/>)" + camera(kSize) + sky + R"(<shape type="obj">)" +
                                    text("filename", "line.obj") + inside + "</shape>",
                                accelerator);
      for (const auto& pixel : picture.pixels) ASSERT_NEAR(pixel[1], 2, 1e-6) << accelerator;
    }
  }
}

}  // namespace
}  // namespace norrsken::end_to_end
