// Choosing among many lights by where the reference point is: down a binary tree over the lights that have a place,
// each time to a child by what its lights might send there, told from their bounds. Lights that surround the scene
// stand beside the tree and keep their shares (an alias table).
//
// Source      Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018: the
//             importance of a node (section 4), bounds and tree; one light by one path down the tree as in Pharr, Jakob,
//             Humphreys, "Physically Based Rendering", 4th ed., section 12.6.3
// Departures  no node is split into several samples, and the normal at the reference point is left out, for a ray that
//             finds a light by itself does not know it. Importance is continuous in the reference point and nowhere 0:
//             the angle that bounds subtend widens to a half turn at their surface, emission ends in a slope, and what
//             shines away keeps kLeastFacing. So a light's probability at a surface point and at the origin of a ray
//             that leaves it, which are a rounding bound apart, are the same within rounding, and no light is lost.
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

/// Intensity over squared distance, times how far the lights of the node may face the reference point.
NORRSKEN_INLINE Float light_importance(const SceneView& scene, UInt node, const Vec3f& reference, Mask active) {
  const auto of_node = [&](auto member) { return gather(scene.light_nodes, member, node, active); };
  const Vec3f from = reference - of_node(&LightNode::center);
  const Vec3f axis = of_node(&LightNode::axis);
  const Float radius2 = of_node(&LightNode::radius2), distance2 = max(dot(from, from), radius2);
  const Float inverse = 1.0f / sqrt(distance2), one(1.0f);
  // sin^2 of the angle under which the bounds' radius is seen. Its fourth power takes the cosine to -1 at the surface.
  const Float seen2 = min(radius2 * inverse * inverse, one);
  const Float cos_seen = fnma(seen2, seen2, sqrt(one - seen2));
  const Float cos_axis = min(max(dot(axis, from) * inverse, -one), one);
  const Angle off_normals =
      less({cos_axis, sine_of(cos_axis)}, {of_node(&LightNode::cos_normals), of_node(&LightNode::sin_normals)});
  const Angle least = less(off_normals, {cos_seen, sine_of(cos_seen)});
  const Float facing = fms(least.cos, of_node(&LightNode::slope), of_node(&LightNode::shift));
  return of_node(&LightNode::intensity) * inverse * inverse * max(facing, kLeastFacing);
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
  Float prob;
};

/// The two numbers take turns, so that neither runs out of bits.
inline PickedLight pick_light_by_place(const SceneView& scene, Vec3f reference, Vec2f u, Mask active) {
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
  UInt content = gather(scene.light_nodes, &LightNode::content, 0u, in_tree);
  Float prob = tree_share(scene);
  const Mask is_around = active & !in_tree;
  if (any(is_around)) prob = select(is_around, light_prob(scene, around, is_around), prob);
  const auto inner = [&] { return in_tree & ((content & kLightLeafBit) == 0u); };
  for (Mask open = inner(); any(open); open = inner()) {
    const UInt left = select(open, content, 0u), right = left + 1u;
    const Float a = light_importance(scene, left, reference, open), b = light_importance(scene, right, reference, open);
    const Float p = child_prob(a, b);
    const Mask first = u.x < p;
    const Float rest = select(first, u.x / p, (u.x - p) / (1.0f - p));
    u = {u.y, min(rest, 0x1.fffffep-1f)};
    prob = select(open, prob * select(first, p, child_prob(b, a)), prob);
    content = select(open, gather(scene.light_nodes, &LightNode::content, select(first, left, right), open), content);
  }
  return {select(in_tree, content & ~kLightLeafBit, around), prob};
}

/// The probability with which `pick_light_by_place` finds the light. Not inlined: most scenes have few lights.
__attribute__((noinline)) inline Float light_prob_by_place(const SceneView& scene, UInt light, Vec3f reference,
                                                           Mask active) {
  UInt node = gather(scene.light_leaves, light, active);
  const Mask in_tree = active & (node != kNone);
  Float prob = select(in_tree, tree_share(scene), light_prob(scene, light, active));
  for (Mask open = in_tree & (node != 0u); any(open); open &= node != 0u) {
    // Siblings are 2k + 1 and 2k + 2.
    const UInt sibling = ((node + 1u) ^ 1u) - 1u;
    const Float a = light_importance(scene, node, reference, open),
                b = light_importance(scene, sibling, reference, open);
    prob = select(open, prob * child_prob(a, b), prob);
    node = select(open, gather(scene.light_nodes, &LightNode::parent, node, open), node);
  }
  return prob;
}

}  // namespace norrsken::NORRSKEN_ISA
