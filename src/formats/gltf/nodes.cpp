#include "formats/gltf/nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/text.h"

namespace norrsken::gltf {
namespace {

/// Where a time lies between key frames.
struct KeyFrame {
  std::size_t before = 0, after = 0;
  double share = 0, seconds = 0;  ///< of the way from `before`, which takes so long
};

KeyFrame key_frame_at(const Numbers& times, double time) {
  const std::size_t last = times.count - 1;
  if (time <= double{times.values[0]}) return {};
  if (time >= double{times.values[last]}) return {last, last, 0, 0};
  const auto next = std::upper_bound(times.values.begin(), times.values.end(), static_cast<float>(time));
  const std::size_t after = std::clamp<std::size_t>(static_cast<std::size_t>(next - times.values.begin()), 1, last);
  const double begin = double{times.values[after - 1]}, seconds = double{times.values[after]} - begin;
  return {after - 1, after, seconds > 0 ? (time - begin) / seconds : 0, seconds};
}

/// `n` numbers of an animation's output at a time.
std::vector<double> sample(const Numbers& times, const Numbers& output, std::size_t n, const std::string& interpolation,
                           double time) {
  const KeyFrame key = key_frame_at(times, time);
  const bool is_cubic = interpolation == "CUBICSPLINE";
  const auto at = [&](std::size_t frame, std::size_t part, std::size_t c) {
    return double{output.values[((is_cubic ? 3 : 1) * frame + part) * n + c]};
  };
  std::vector<double> values(n);
  const double t = interpolation == "STEP" ? 0 : key.share, t2 = t * t, t3 = t2 * t;
  for (std::size_t c = 0; c < n; ++c) {
    if (is_cubic) {
      values[c] = (2 * t3 - 3 * t2 + 1) * at(key.before, 1, c) +
                  key.seconds * (t3 - 2 * t2 + t) * at(key.before, 2, c) + (-2 * t3 + 3 * t2) * at(key.after, 1, c) +
                  key.seconds * (t3 - t2) * at(key.after, 0, c);
    } else {
      values[c] = (1 - t) * at(key.before, 0, c) + t * at(key.after, 0, c);
    }
  }
  if (n == 4 && interpolation == "LINEAR" && key.before != key.after) {
    const auto quaternion = [&](std::size_t frame) {
      return glm::dquat(at(frame, 0, 3), at(frame, 0, 0), at(frame, 0, 1), at(frame, 0, 2));
    };
    const glm::dquat q = glm::slerp(quaternion(key.before), quaternion(key.after), t);
    values = {q.x, q.y, q.z, q.w};
  }
  return values;
}

glm::dquat rotation_of(double x, double y, double z, double w) {
  const glm::dquat q(w, x, y, z);
  const double length = glm::length(q);
  return length > 0 ? q / length : glm::dquat(1, 0, 0, 0);
}

}  // namespace

glm::dmat4 Pose::matrix() const {
  return glm::scale(glm::translate(glm::dmat4(1), translation) * glm::mat4_cast(rotation), scale);
}

glm::dmat4 without_scale(const glm::dmat4& matrix) {
  glm::dmat4 rigid(1);
  for (const int i : {2, 1, 0}) {
    glm::dvec3 axis(matrix[i]);
    for (int k = 2; k > i; --k) axis -= glm::dvec3(rigid[k]) * glm::dot(axis, glm::dvec3(rigid[k]));
    const double length = glm::length(axis);
    if (length > 0) rigid[i] = glm::dvec4(axis / length, 0);
  }
  rigid[3] = matrix[3];
  return rigid;
}

Pose Nodes::pose_of(const Json& node) {
  Pose pose;
  const auto t = asset_.numbers<3>(node, "translation", {0, 0, 0}), s = asset_.numbers<3>(node, "scale", {1, 1, 1});
  const auto q = asset_.numbers<4>(node, "rotation", {0, 0, 0, 1});
  pose.translation = to_glm(t), pose.scale = to_glm(s), pose.rotation = rotation_of(q[0], q[1], q[2], q[3]);
  return pose;
}

glm::dmat4 Nodes::local(const Json& node, Pose* animated) {
  if (animated) return animated->matrix();
  if (!node.find("matrix")) return pose_of(node).matrix();
  const auto m = asset_.numbers<16>(node, "matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  glm::dmat4 matrix;
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) matrix[c][r] = m[static_cast<std::size_t>(4 * c + r)];
  }
  return matrix;
}

std::map<std::size_t, Pose> Nodes::animate() {
  std::map<std::size_t, Pose> poses;
  const Json* animations = asset_.member(asset_.root(), "animations", Json::Kind::array);
  if (!animations || animations->items.empty()) return poses;
  if (!asset_.choices.is_animated) {
    asset_.diagnostics.note(asset_.place(*animations),
                            "the file has an animation; its nodes stand where they are without it", "-Dtime=SECONDS");
    return poses;
  }
  if (animations->items.size() > 1) asset_.tell(*animations, "the file has several animations", "the first");
  const Json& animation = animations->items[0];
  const Json* channels = asset_.member(animation, "channels", Json::Kind::array);
  const Json* samplers = asset_.member(animation, "samplers", Json::Kind::array);
  if (!channels || !samplers) return poses;
  for (const Json& channel : channels->items) {
    const Json* target = asset_.member(channel, "target", Json::Kind::object);
    const auto node = target ? asset_.index(*target, "node") : std::nullopt;
    const std::size_t number = asset_.whole(channel, "sampler", 0);
    if (!target || !node) {
      if (target) asset_.tell(channel, "an animation of what is no node is not supported", "what it is without");
      continue;
    }
    if (*node >= all_.size() || number >= samplers->items.size()) {
      asset_.error(channel, "a channel names a node or a sampler that is not there", "indices of what is there");
      continue;
    }
    const Json& sampler = samplers->items[number];
    const auto times = read_numbers(asset_, sampler, "input", {"SCALAR"});
    const auto output = read_numbers(asset_, sampler, "output", {"SCALAR", "VEC3", "VEC4"});
    const std::string interpolation = asset_.string(sampler, "interpolation", "LINEAR");
    if (!times || !output || times->count == 0) continue;
    const std::string path = asset_.string(*target, "path");
    const std::size_t frames = times->count * (interpolation == "CUBICSPLINE" ? 3 : 1);
    const std::size_t n = output->values.size() / frames;
    const std::size_t wanted = path == "rotation" ? 4 : path == "weights" ? n : 3;
    if (n * frames != output->values.size() || n != wanted || n == 0) {
      asset_.error(sampler,
                   fmt::format("{} values for {} key frames of {}", output->values.size(), times->count, quoted(path)),
                   "as many as the path has, for each");
      continue;
    }
    const auto [pose, is_new] = poses.try_emplace(*node);
    if (is_new) pose->second = pose_of(*all_[*node].json);
    const std::vector<double> v = sample(*times, *output, n, interpolation, asset_.choices.time);
    if (path == "translation") {
      pose->second.translation = {v[0], v[1], v[2]};
    } else if (path == "scale") {
      pose->second.scale = {v[0], v[1], v[2]};
    } else if (path == "rotation") {
      pose->second.rotation = rotation_of(v[0], v[1], v[2], v[3]);
    } else if (path == "weights") {
      pose->second.weights = v;
    } else {
      asset_.tell(*target, fmt::format("animations of {} are not supported", quoted(path)), "what it is without");
    }
  }
  return poses;
}

bool Nodes::read() {
  const Json* nodes = asset_.member(asset_.root(), "nodes", Json::Kind::array);
  if (!nodes) return !asset_.diagnostics.has_errors();
  asset_.memory.grow(nodes->items.size() * sizeof(One));
  for (const Json& node : nodes->items) {
    if (node.kind != Json::Kind::object) {
      asset_.error(node, fmt::format("a node is {}", name_of(node.kind)), "an object");
      return false;
    }
    all_.push_back({&node});
  }
  for (One& one : all_) {
    for (const Json& child : asset_.items(*one.json, "children")) {
      const bool exists = child.kind == Json::Kind::number && child.number >= 0 &&
                          child.number < static_cast<double>(all_.size()) && std::floor(child.number) == child.number;
      if (!exists || all_[static_cast<std::size_t>(child.number)].has_parent) {
        asset_.error(child, exists ? "a node has two parents" : "there is no such node", "each node once");
        return false;
      }
      all_[static_cast<std::size_t>(child.number)].has_parent = true;
      one.children.push_back(static_cast<std::size_t>(child.number));
    }
  }
  std::map<std::size_t, Pose> animated = animate();
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (!all_[i].has_parent) open.push_back(i);
  }
  // Nodes have one parent each, so that each is reached once at most; those in a ring are not.
  std::size_t reached = 0;
  for (; !open.empty(); ++reached) {
    const std::size_t i = open.back();
    open.pop_back();
    One& one = all_[i];
    const auto pose = animated.find(i);
    one.to_world = one.to_world * local(*one.json, pose != animated.end() ? &pose->second : nullptr);
    if (pose != animated.end()) one.weights = pose->second.weights;
    if (const Json* weights = asset_.member(*one.json, "weights", Json::Kind::array); weights && one.weights.empty()) {
      for (const Json& weight : weights->items) one.weights.push_back(weight.number);
    }
    for (const std::size_t child : one.children) {
      all_[child].to_world = one.to_world;
      open.push_back(child);
    }
  }
  if (reached < all_.size()) asset_.error(*nodes, "nodes are children of themselves", "a tree");
  return !asset_.diagnostics.has_errors();
}

std::vector<std::size_t> Nodes::of_scene() {
  std::vector<std::size_t> open, result;
  const Json* scenes = asset_.member(asset_.root(), "scenes", Json::Kind::array);
  if (!scenes || scenes->items.empty()) {
    for (std::size_t i = all_.size(); i-- > 0;) {
      if (!all_[i].has_parent) open.push_back(i);
    }
  } else {
    const std::size_t number = asset_.choices.scene.value_or(asset_.whole(asset_.root(), "scene", 0));
    const Json* scene = asset_.element(asset_.root(), "scenes", number);
    const Json* roots = scene ? asset_.member(*scene, "nodes", Json::Kind::array) : nullptr;
    if (scenes->items.size() > 1)
      asset_.diagnostics.note(asset_.place(*scenes),
                              fmt::format("the file has {} scenes; this is number {}", scenes->items.size(), number),
                              "-Dscene=N");
    if (roots) {
      for (std::size_t k = roots->items.size(); k-- > 0;) {
        const Json& root = roots->items[k];
        const bool exists =
            root.kind == Json::Kind::number && root.number >= 0 && root.number < static_cast<double>(all_.size());
        if (exists) {
          open.push_back(static_cast<std::size_t>(root.number));
        } else {
          asset_.error(root, "there is no such node", fmt::format("below {}", all_.size()));
        }
      }
    }
  }
  std::vector<bool> seen(all_.size());
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    if (seen[i]) continue;
    seen[i] = true;
    const Json* visibility = asset_.extension(*all_[i].json, "KHR_node_visibility");
    if (visibility && !asset_.boolean(*visibility, "visible", true)) continue;
    result.push_back(i);
    open.insert(open.end(), all_[i].children.rbegin(), all_[i].children.rend());
  }
  return result;
}

}  // namespace norrsken::gltf
