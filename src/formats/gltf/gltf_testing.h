// What the tests of the reader of glTF share.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/gltf/read_gltf.h"
#include "formats/reader_testing.h"

namespace norrsken::gltf {

/// Bytes of a buffer, little endian.
class Bytes {
 public:
  template <class T>
  Bytes& add(const std::vector<T>& values) {
    for (const T value : values) {
      const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
      text_.append(raw.data(), raw.size());
    }
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// A file of glTF with these members beside `asset`, in single quotes.
inline std::string file(std::string members) {
  std::string text = "{'asset':{'version':'2.0'}" + (members.empty() ? "" : ",\n" + members) + "}";
  for (char& c : text) c = c == '\'' ? '"' : c;
  return text;
}

/// Reads "a.gltf" of `files`.
inline std::optional<Description> read(const TestFiles& files, Diagnostics& diagnostics,
                                       const TestParameters& parameters = {}) {
  return read_gltf("a.gltf", MemoryFiles(files), parameters, diagnostics);
}

inline std::string complaints_of(const TestFiles& files, const TestParameters& parameters = {}) {
  Diagnostics diagnostics;
  read(files, diagnostics, parameters);
  return to_text(diagnostics);
}

/// All nodes of a kind in the scene.
inline std::vector<std::shared_ptr<const Node>> nodes_of(const TestFiles& files, const std::string& kind,
                                                         const TestParameters& parameters = {}) {
  Diagnostics diagnostics;
  const auto description = read(files, diagnostics, parameters);
  std::vector<std::shared_ptr<const Node>> nodes;
  if (!description) return nodes;
  for (const Node::Child& child : description->scene->children) {
    if (child.node->kind == kind) nodes.push_back(child.node);
  }
  return nodes;
}

inline std::shared_ptr<const Mesh> mesh_of(const Node& shape) {
  for (const Property& property : shape.properties) {
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&property.value)) return *mesh;
  }
  return std::make_shared<const Mesh>();
}

}  // namespace norrsken::gltf
