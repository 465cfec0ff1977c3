// Choosing among many lights by where the reference point is: down a binary tree over the lights that have a place,
// each time to a child by what its lights might send there, told from their bounds. Lights that surround the scene
// stand beside the tree and keep their shares (an alias table).
//
// Source      Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018: the
//             importance of a node (section 4), bounds and tree; one light by one path down the tree as in Pharr, Jakob,
//             Humphreys, "Physically Based Rendering", 4th ed., section 12.6.3
// Departures  no node is split into several samples. Cosines are not bounded but taken in the mean over what the bounds
//             fill of the view, or a node would stand out for being large. Importance is continuous in the reference
//             point and nowhere 0: emission ends in a slope, and what shines away keeps kLeastFacing. A ray that finds a
//             light by itself does not know the normal where it began, so the weights of multiple importance sampling go
//             by what the lights send, on both sides alike; which light is chosen goes by what the surface takes of it
//             besides. So no light is lost, and the probability that the weights know is the same within rounding at a
//             surface point and at the origin of a ray that leaves it.
#pragma once

#include "light/light.h"

namespace norrsken::NORRSKEN_ISA {

/// What is left of a node's importance where its lights shine away.
inline constexpr float kLeastFacing = 1e-3f;

/// An angle from 0 to pi.
struct Angle {
  Float cos, sin;
};
NORRSKEN_INLINE Float sine_of(Float cosine) { return sqrt(max(fnma(cosine, cosine, 1.0f), 0.0f)); }
/// a - b, or 0 if b is larger.
NORRSKEN_INLINE Angle less(const Angle& a, const Angle& b) {
  const Mask nothing = a.cos >= b.cos;
  return {select(nothing, 1.0f, fma(a.cos, b.cos, a.sin * b.sin)),
          select(nothing, 0.0f, fms(a.sin, b.cos, a.cos * b.sin))};
}

/// A LightNode in lanes.
struct LightNodes {
  Vec3f center;
  Float intensity;
  UInt axis, normals, extent;
};
NORRSKEN_INLINE LightNodes gather_light_node(const SceneView& scene, UInt node, Mask active) {
  const auto of_node = [&](auto member) { return gather(scene.light_nodes, member, node, active); };
  return {of_node(&LightNode::center), of_node(&LightNode::intensity), of_node(&LightNode::axis),
          of_node(&LightNode::normals), of_node(&LightNode::extent)};
}
NORRSKEN_INLINE LightNodes broadcast_light_node(const LightNode& node) {
  return {broadcast(node.center), Float(node.intensity), UInt(node.axis), UInt(node.normals), UInt(node.extent)};
}

/// What bounds the lights of a node.
struct LightCone {
  Vec3f axis;  ///< its length is 1 within ten bits: too few for narrow beams
  Angle normals;
  Float radius2, slope;
};
NORRSKEN_INLINE LightCone light_cone(const LightNodes& n) {
  const auto component = [](UInt v) { return fma(to_float(v & 1023u), Float(1.0f / 511.0f), -1.0f); };
  return {{component(n.axis), component(shift_right<10>(n.axis)), component(shift_right<20>(n.axis))},
          {fma(to_float(n.normals & 65535u), Float(2.0f / 65535.0f), -1.0f),
           to_float(shift_right<16>(n.normals)) * Float(1.0f / 65535.0f)},
          from_bits(n.extent & 0xffff0000u),
          from_bits(shift_left<16>(n.extent))};
}

/// What the surface at a reference point takes of light: by the cosine with its normal, but nowhere less than `least`.
struct Receiver {
  Vec3f normal;
  Float least;
};
/// Takes light from everywhere alike.
NORRSKEN_INLINE Receiver any_receiver() { return {{0.0f, 0.0f, 0.0f}, 1.0f}; }

/// About the mean of max(x, 0) over an interval around x that reaches as far as the root of `reach2`: x where it lies above
/// 0, and a quarter of the reach where x is 0.
NORRSKEN_INLINE Float mean_above(Float x, Float reach2) { return 0.5f * (x + sqrt(fma(x, x, 0.25f * reach2))); }

struct Importance {
  Float sent;   ///< intensity over squared distance, times how far the lights may face the reference point
  Float taken;  ///< that times what the receiver may take
};

NORRSKEN_INLINE Importance light_importance(const LightNodes& node, const Vec3f& reference, const Receiver& receiver) {
  const LightCone cone = light_cone(node);
  const Vec3f from = reference - node.center;
  const Float distance2 = max(dot(from, from), cone.radius2);
  const Float inverse = 1.0f / sqrt(distance2), one(1.0f);
  const auto cosine_to = [&](const Vec3f& v) { return min(max(dot(v, from) * inverse, -one), one); };
  // sin^2 of the angle under which the bounds' radius is seen; 1 inside of them.
  const Float seen2 = min(cone.radius2 * inverse * inverse, one);
  const Float cos_axis = cosine_to(cone.axis * (1.0f / sqrt(dot(cone.axis, cone.axis))));
  const Float cos_normals = less({cos_axis, sine_of(cos_axis)}, cone.normals).cos;
  const Float facing = mean_above(fnma(cone.slope, one - cos_normals, one), cone.slope * cone.slope * seen2);
  const Float sent = node.intensity * inverse * inverse * max(min(facing, one), kLeastFacing);
  return {sent, sent * max(mean_above(-cosine_to(receiver.normal), seen2), receiver.least)};
}

/// The probability of a child of importance a whose sibling has b.
NORRSKEN_INLINE Float child_prob(Float a, Float b) {
  const Float sum = a + b;
  return select(sum > 0.0f, a / sum, 0.5f);
}

/// The share of the tree beside the lights around the scene.
NORRSKEN_INLINE Float tree_share(const SceneView& scene) {
  return Float(scene.lights_around[scene.lights_around_count - 1].prob);
}

struct PickedLight {
  UInt light;
  Float prob;         ///< with which it was picked
  Float weight_prob;  ///< its share by what lights send: `light_prob_by_place`
};

/// The two numbers take turns, so that neither runs out of bits.
inline PickedLight pick_light_by_place(const SceneView& scene, Vec3f reference, Receiver receiver, Vec2f u,
                                       Mask active) {
  UInt around(0u);
  Mask in_tree = active;
  if (scene.lights_around_count > 1) {
    const auto count = static_cast<float>(scene.lights_around_count);
    const Float scaled = u.x * Float(count);
    const UInt cell = to_uint(min(scaled, Float(count - 1)));
    u.x = scaled - to_float(cell);
    const auto of_cell = [&](auto member) { return gather(scene.lights_around, member, cell, active); };
    const Float keep = of_cell(&AroundLight::keep);
    const Mask kept = (u.x < keep) | (keep >= 1.0f);
    around = select(kept, of_cell(&AroundLight::light), of_cell(&AroundLight::alias));
    in_tree &= around == kNone;
    const Float rest = select(kept, u.x / keep, (u.x - keep) / (1.0f - keep));
    u.x = min(rest, 0x1.fffffep-1f);
  }
  UInt content(scene.light_nodes[0].content);
  Float prob = tree_share(scene);
  const Mask is_around = active & !in_tree;
  if (any(is_around)) prob = select(is_around, light_prob(scene, around, is_around), prob);
  Float weight_prob = prob;
  const auto go_down = [&](UInt left, const LightNodes& left_node, const LightNodes& right_node, Mask open) {
    const Importance a = light_importance(left_node, reference, receiver),
                     b = light_importance(right_node, reference, receiver);
    const Float p = child_prob(a.taken, b.taken);
    const Mask first = u.x < p;
    const Float rest = select(first, u.x, u.x - p) / select(first, p, 1.0f - p);
    u = {u.y, min(rest, 0x1.fffffep-1f)};
    prob = select(open, prob * select(first, p, child_prob(b.taken, a.taken)), prob);
    const Float sent = child_prob(select(first, a.sent, b.sent), select(first, b.sent, a.sent));
    weight_prob = select(open, weight_prob * sent, weight_prob);
    const UInt next = select(first, left, left + 1u);
    content = select(open, gather(scene.light_nodes, &LightNode::content, next, open), content);
  };
  // All begin at the root.
  if ((scene.light_nodes[0].content & kLightLeafBit) == 0) {
    const LightNode* children = scene.light_nodes + scene.light_nodes[0].content;
    go_down(content, broadcast_light_node(children[0]), broadcast_light_node(children[1]), in_tree);
  }
  const auto inner = [&] { return in_tree & ((content & kLightLeafBit) == 0u); };
  for (Mask open = inner(); any(open); open = inner()) {
    const UInt left = select(open, content, 0u);
    go_down(left, gather_light_node(scene, left, open), gather_light_node(scene, left + 1u, open), open);
  }
  return {select(in_tree, content & ~kLightLeafBit, around), prob, weight_prob};
}

/// The probability with which `pick_light_by_place` finds the light for any_receiver(). Not inlined: most scenes have few lights.
__attribute__((noinline)) inline Float light_prob_by_place(const SceneView& scene, UInt light, Vec3f reference,
                                                           Mask active) {
  UInt node = gather(scene.light_leaves, light, active);
  const Mask in_tree = active & (node != kNone);
  Float prob = select(in_tree, tree_share(scene), light_prob(scene, light, active));
  for (Mask open = in_tree & (node != 0u); any(open); open &= node != 0u) {
    // Siblings are 2k + 1 and 2k + 2.
    const UInt sibling = ((node + 1u) ^ 1u) - 1u;
    const auto sent = [&](UInt of) {
      return light_importance(gather_light_node(scene, of, open), reference, any_receiver()).sent;
    };
    const Float a = sent(node), b = sent(sibling);
    prob = select(open, prob * child_prob(a, b), prob);
    node = select(open, gather(scene.light_nodes, &LightNode::parent, node, open), node);
  }
  return prob;
}

}  // namespace norrsken::NORRSKEN_ISA
