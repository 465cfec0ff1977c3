#include "formats/pbrt/pbrt_testing.h"

#include <gtest/gtest.h>

#include "formats/pbrt/read_pbrt.h"

namespace norrsken::pbrt {
namespace {

std::shared_ptr<const Node> find_in(const std::shared_ptr<const Node>& node, const std::string& kind) {
  if (node->kind == kind) return node;
  for (const Node::Child& child : node->children) {
    if (auto found = find_in(child.node, kind)) return found;
  }
  return nullptr;
}

}  // namespace

std::optional<Description> read_files(const TestFiles& files, Diagnostics& diagnostics) {
  return read_pbrt("scene.pbrt", MemoryFiles(files), diagnostics);
}

std::string complaints_of(const TestFiles& files) {
  Diagnostics diagnostics;
  const auto description = read_files(files, diagnostics);
  EXPECT_NE(description.has_value(), diagnostics.has_errors());
  diagnostics.sort();
  return to_text(diagnostics);
}

std::string complaints_of(const std::string& scene) { return complaints_of(TestFiles{{"scene.pbrt", scene}}); }

std::string messages_of(const std::string& scene, const TestFiles& files) {
  TestFiles all = files;
  all["scene.pbrt"] = scene;
  Diagnostics diagnostics;
  read_files(all, diagnostics);
  std::string messages;
  for (const Diagnostic& diagnostic : diagnostics.all()) messages += diagnostic.message + "\n";
  return messages;
}

std::shared_ptr<const Node> find_node(const std::string& kind, const std::string& scene, const TestFiles& files) {
  TestFiles all = files;
  all["scene.pbrt"] = scene;
  Diagnostics diagnostics;
  const auto description = read_files(all, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << to_text(diagnostics);
  return description ? find_in(description->scene, kind) : nullptr;
}

std::string node_of_scene(const std::string& kind, const std::string& scene, const TestFiles& files) {
  const auto node = find_node(kind, scene, files);
  return node ? text_of(*node) : "none";
}

std::string node_of(const std::string& kind, const std::string& world, const TestFiles& files) {
  return node_of_scene(kind, "WorldBegin\n" + world, files);
}

}  // namespace norrsken::pbrt
