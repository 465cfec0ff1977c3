// For tests that write the scenes they render.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/end_to_end/rendering.h"
#include "tests/temporary_folder.h"

namespace norrsken::end_to_end {

/// A folder of its own, gone after the test.
class SceneFolder : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  /// A scene of these elements.
  Scene load_elements(const std::string& elements) const {
    write("scene.xml", "<scene version=\"3.0.0\">" + elements + "</scene>");
    return load(path("scene.xml"));
  }

 private:
  const TemporaryFolder folder_;
};

inline std::string integer(const std::string& name, int value) {
  return "<integer name=\"" + name + "\" value=\"" + std::to_string(value) + "\"/>";
}
inline std::string text(const std::string& name, const std::string& value) {
  return "<string name=\"" + name + "\" value=\"" + value + "\"/>";
}
inline std::string diffuse(const std::string& rgb) {
  return "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"" + rgb + "\"/></bsdf>";
}

struct View {
  std::string origin = "0, 0, 4", target = "0, 0, 0", up = "0, 1, 0";
  /// 4 units away a square of side 4 fills the picture.
  std::string fov = "53.13010235415598";
};
/// A perspective camera with square pictures; `film` is what else the film has in it, `sampler` of which kind it is.
inline std::string camera(int size, const View& view = {}, const std::string& film = "<rfilter type=\"box\"/>",
                          const std::string& sampler = "sobol") {
  return "<sensor type=\"perspective\"><float name=\"fov\" value=\"" + view.fov +
         "\"/><transform name=\"to_world\"><lookat origin=\"" + view.origin + "\" target=\"" + view.target +
         "\" up=\"" + view.up + "\"/></transform><sampler type=\"" + sampler + "\"/><film type=\"hdrfilm\">" +
         integer("width", size) + integer("height", size) + film + "</film></sensor>";
}

}  // namespace norrsken::end_to_end
