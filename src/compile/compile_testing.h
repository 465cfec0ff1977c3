// For tests: from the text of a scene to its tables and complaints, without touching the disk.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "compile/compile.h"
#include "formats/mitsuba_xml.h"
#include "scene/memory_files.h"

namespace norrsken::testing {

struct Compiled {
  std::optional<LoadedScene> scene;
  Diagnostics diagnostics;

  const SceneTables& tables() const { return scene.value().tables; }
  const SceneInfo& info() const { return scene.value().info; }

  /// One line per complaint: "error: MESSAGE [ACCEPTED]", or "warning: ", or "note: ", without the brackets if nothing is accepted.
  std::vector<std::string> messages() const {
    std::vector<std::string> lines;
    for (const Diagnostic& d : diagnostics.all()) {
      lines.push_back(std::string(name_of(d.severity)) + ": " + d.message +
                      (d.accepted.empty() ? "" : " [" + d.accepted + "]"));
    }
    return lines;
  }
};

using Files = std::map<std::string, std::string>;

/// Compiles `files["scene.xml"]`.
inline Compiled compile_files(const Files& files, const LoadOptions& options = {}) {
  Compiled result;
  const MemoryFiles memory(files);
  if (const auto description = read_mitsuba_xml("scene.xml", memory, options.parameters, result.diagnostics)) {
    result.scene = compile(*description, memory, options, result.diagnostics);
  }
  return result;
}

/// Compiles a scene with these elements; `files` may add meshes.
inline Compiled compile_elements(const std::string& elements, Files files = {}, const LoadOptions& options = {}) {
  files["scene.xml"] = "<scene version=\"3.0.0\">\n" + elements + "\n</scene>\n";
  return compile_files(files, options);
}

/// What a scene needs so that nothing but the element under test is complained about.
inline const std::string kSensor =
    R"(<sensor type="perspective"><film type="hdrfilm"><rfilter type="box"/></film></sensor>)";
inline const std::string kShape = R"(<shape type="sphere"/>)";
inline const std::string kEmitter = R"(<emitter type="point"/>)";

inline Compiled compile_bsdf(const std::string& bsdf) {
  return compile_elements(kSensor + kEmitter + "<shape type=\"sphere\">" + bsdf + "</shape>");
}
inline Compiled compile_shape(const std::string& shape, const Files& files = {}) {
  return compile_elements(kSensor + kEmitter + shape, files);
}
inline Compiled compile_emitter(const std::string& emitter) { return compile_elements(kSensor + kShape + emitter); }
inline Compiled compile_sensor(const std::string& sensor) { return compile_elements(sensor + kShape + kEmitter); }
/// Parameters and children of an hdrfilm of a perspective sensor.
inline Compiled compile_film(const std::string& inside) {
  return compile_sensor("<sensor type=\"perspective\"><film type=\"hdrfilm\">" + inside + "</film></sensor>");
}
inline Compiled compile_sampler(const std::string& sampler) {
  return compile_sensor(R"(<sensor type="perspective"><film type="hdrfilm"><rfilter type="box"/></film>)" + sampler +
                        "</sensor>");
}
inline Compiled compile_integrator(const std::string& integrator, const LoadOptions& options = {}) {
  return compile_elements(integrator + kSensor + kShape + kEmitter, {}, options);
}

}  // namespace norrsken::testing
