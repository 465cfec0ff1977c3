#include "scene/check_description.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <type_traits>

#include "base/checksum.h"
#include "base/text.h"

namespace norrsken {
namespace {

constexpr int kMaxDepth = 100;  // as in files

class Check {
 public:
  explicit Check(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// Returns how deep the node is below it; 0 after a complaint.
  int visit(const Node& node) {
    if (const auto known = depth_.find(&node); known != depth_.end()) {
      if (known->second == kOpen) fail(fmt::format("{} stands inside of itself", name_of(node)), "a tree of nodes");
      return std::max(known->second, 0);
    }
    depth_[&node] = kOpen;
    ++open_;
    int deepest = 0;
    if (open_ > kMaxDepth) {
      fail(fmt::format("nodes are nested more than {} deep", kMaxDepth), fmt::format("up to {}", kMaxDepth));
    } else {
      std::set<std::string_view> names;
      for (const Property& property : node.properties) {
        check(property, node);
        if (!names.insert(property.name).second)
          fail(fmt::format("{} is given twice to {}", quoted(property.name), name_of(node)), "one value of each name");
      }
      for (const Node::Child& child : node.children) {
        if (!good_) break;
        if (!child.node) {
          fail(fmt::format("a child of {} is null", name_of(node)), "a node");
        } else {
          deepest = std::max(deepest, visit(*child.node) + 1);
        }
      }
    }
    --open_;
    // A node that is shared may be reached at the end of a longer path than the one that was looked at.
    if (open_ + deepest > kMaxDepth && good_)
      fail(fmt::format("nodes are nested more than {} deep", kMaxDepth), fmt::format("up to {}", kMaxDepth));
    return depth_[&node] = deepest;
  }
  bool good() const { return good_; }

 private:
  static constexpr int kOpen = -1;

  void fail(std::string message, std::string accepted) {
    good_ = false;
    diagnostics_.error({}, std::move(message), std::move(accepted));
  }

  void check(const Property& property, const Node& node) {
    const auto* spectrum = std::get_if<Property::Spectrum>(&property.value);
    if (!spectrum) return;
    const auto& samples = spectrum->samples;
    bool ascends = !samples.empty();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!std::isfinite(samples[i].first) || !std::isfinite(samples[i].second)) ascends = false;
      if (samples.size() > 1 && !(samples[i].first > (i == 0 ? 0 : samples[i - 1].first))) ascends = false;
    }
    if (!ascends)
      fail(fmt::format("spectrum {} of {} is malformed", quoted(property.name), name_of(node)),
           "one value, or finite values at ascending wavelengths above 0 nm");
  }

  Diagnostics& diagnostics_;
  std::map<const Node*, int> depth_;
  int open_ = 0;
  bool good_ = true;
};

class Printer {
 public:
  explicit Printer(Fingerprint& print) : print_(print) {}

  /// A node that was printed before is told by its number.
  void node(const Node& node) {
    const auto [known, is_new] = numbers_.try_emplace(&node, numbers_.size());
    word(known->second);
    if (!is_new) return;
    for (const std::string* text : {&node.kind, &node.plugin, &node.id}) bytes(*text);
    word(node.properties.size());
    for (const Property& property : node.properties) {
      bytes(property.name);
      word(property.value.index());
      std::visit([this](const auto& v) { value(v); }, property.value);
    }
    word(node.children.size());
    for (const Node::Child& child : node.children) {
      bytes(child.name);
      this->node(*child.node);
    }
  }

 private:
  void word(std::uint64_t w) { print_.add_all(std::span(&w, 1)); }
  template <class Container>
  void bytes(const Container& container) {
    word(container.size());
    print_.add_all(std::span(container.data(), container.size()));
  }

  void value(const std::string& text) { bytes(text); }
  void value(const Property::Rgb& v) { bytes(v.value); }
  void value(const Property::Vector& v) { bytes(v.value); }
  void value(const Property::Transform& v) {
    for (const auto& row : v.rows) bytes(row);
  }
  void value(const Property::Spectrum& v) {
    word(v.samples.size());
    for (const auto& [wavelength, sample] : v.samples) {
      value(wavelength);
      value(sample);
    }
  }
  void value(const FloatArray& v) { bytes(v); }
  void value(const IndexArray& v) { bytes(v); }
  void value(const Mesh& v) {
    for (const FloatArray* array : {&v.positions, &v.normals, &v.texcoords}) bytes(*array);
    bytes(v.triangles);
    for (const Mesh::Attribute& attribute : v.attributes) {
      bytes(attribute.name);
      bytes(attribute.values);
    }
  }
  void value(const Image& v) {
    word(static_cast<std::uint64_t>(v.width));
    word(static_cast<std::uint64_t>(v.height));
    for (const Channel& channel : v.channels) {
      bytes(channel.name);
      bytes(channel.values);
    }
  }
  template <class T>
  void value(const std::shared_ptr<const T>& v) {
    word(v ? 1 : 0);
    if (v) value(*v);
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void value(T v) { print_.add_all(std::span(&v, 1)); }

  Fingerprint& print_;
  std::map<const Node*, std::size_t> numbers_;
};

}  // namespace

bool check_description(const Description& description, Diagnostics& diagnostics) {
  if (!description.scene || description.scene->kind != "scene") {
    diagnostics.error({}, "the description has no scene", "a node of kind 'scene'");
    return false;
  }
  Check check(diagnostics);
  check.visit(*description.scene);
  return check.good();
}

std::string fingerprint_of(const Description& description, const std::string& files) {
  Fingerprint print;
  Printer(print).node(*description.scene);
  print.add_all(std::span(files.data(), files.size()));
  return print.text();
}

}  // namespace norrsken
