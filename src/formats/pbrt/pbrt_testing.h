// What the tests of the reader of pbrt scenes share.
#pragma once

#include <map>
#include <string>

#include "formats/reader_testing.h"
#include "scene/memory_files.h"

namespace norrsken::pbrt {

/// Reads "scene.pbrt" of `files`.
std::optional<Description> read_files(const TestFiles& files, Diagnostics& diagnostics);

/// All that is said of the scene, as a person reads it.
std::string complaints_of(const std::string& scene);
std::string complaints_of(const TestFiles& files);
/// Messages alone, without places, one a line.
std::string messages_of(const std::string& scene, const TestFiles& files = {});

/// The first node of that kind in the scene, as `text_of` tells it; the world is `world`.
std::string node_of(const std::string& kind, const std::string& world, const TestFiles& files = {});
/// Everything, with a header of its own.
std::string node_of_scene(const std::string& kind, const std::string& scene, const TestFiles& files = {});
/// The node itself; null if there is none.
std::shared_ptr<const Node> find_node(const std::string& kind, const std::string& scene, const TestFiles& files = {});

}  // namespace norrsken::pbrt
