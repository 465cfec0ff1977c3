// The builder's part that is about participating media.
#include <fmt/format.h>

#include "base/text.h"
#include "compile/builder.h"
#include "compile/plugins.h"
#include "scene/within_memory.h"

namespace norrsken {
namespace {

/// Phase functions within phase functions.
constexpr int kMaxPhaseDepth = 64;

}  // namespace

std::uint32_t Builder::medium(const Node& node) {
  if (const auto known = scene_.media.find(&node); known != scene_.media.end()) return known->second;
  if (is_frame_alone_) {
    diagnostics_.error(node.location, "a sensor stands in a medium that is none of the scene's",
                       "a medium that the scene was loaded with");
    return kNone;
  }
  std::uint32_t index = kNone;
  if (const auto* plugin = find_plugin(medium_plugins(), node, diagnostics_)) {
    const IntegratorSettings& integrator = tables().integrator;
    if (!integrator.media && !integrator.distance) {
      diagnostics_.warning(node.location,
                           fmt::format("integrator {} takes no notice of medium {}", quoted(scene_.info.integrator),
                                       quoted(node.plugin)),
                           "integrator 'volpath'");
    }
    Parameters p = parameters(node);
    Media media(*this);
    within_memory(node.location, "medium " + quoted(node.plugin), diagnostics_, [&] {
      const MediumRecord record = plugin->compile(p, media);
      index = static_cast<std::uint32_t>(tables().media.size());
      tables().media.push_back(record);
    });
    p.finish();
  }
  scene_.media.emplace(&node, index);
  return index;
}

PhaseWord Builder::phase(const Node& node) {
  if (const auto known = phases_.find(&node); known != phases_.end()) return known->second;
  PhaseWord word = 0;
  if (phase_depth_ == kMaxPhaseDepth) {
    diagnostics_.error(node.location, fmt::format("phase functions are nested more than {} deep", kMaxPhaseDepth),
                       fmt::format("up to {} inside each other", kMaxPhaseDepth));
  } else if (const auto* plugin = find_plugin(phase_plugins(), node, diagnostics_)) {
    ++phase_depth_;
    Parameters p = parameters(node);
    Media media(*this);
    word = plugin->compile(p, media);
    p.finish();
    --phase_depth_;
  }
  phases_.emplace(&node, word);
  return word;
}

Volume Builder::volume(const Node& node) {
  if (const auto known = volumes_.find(&node); known != volumes_.end()) return known->second;
  Volume volume;
  if (const auto* plugin = find_plugin(volume_plugins(), node, diagnostics_)) {
    Parameters p = parameters(node);
    Media media(*this);
    volume = plugin->compile(p, media);
    p.finish();
  }
  volumes_.emplace(&node, volume);
  return volume;
}

void Builder::compile_media_of(Parameters& shape, ShapeRecord& record) {
  bool bounds = false;
  std::uint32_t interior = kNone, exterior = kNone;
  for (const Node::Child* child : shape.children("medium")) {
    const bool is_interior = child->name == "interior";
    if (!is_interior && child->name != "exterior") {
      diagnostics_.error(
          child->location,
          fmt::format("a medium of shape {} is named {}", quoted(shape.node().plugin), quoted(child->name)),
          "'interior' or 'exterior'");
      continue;
    }
    (is_interior ? interior : exterior) = medium(*child->node);
    bounds = true;
  }
  if (bounds) record.interior = interior, record.exterior = exterior;
}

std::uint32_t Builder::medium_around(Parameters& p) {
  const Node::Child* child = p.child("medium");
  return child ? medium(*child->node) : kNone;
}

}  // namespace norrsken
