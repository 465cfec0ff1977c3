// What shapes are compiled with, and the host function of each: what src/shape/NAME.cpp defines.
#pragma once

#include "compile/plugin_tools.h"
#include "compile/shape_geometry.h"

namespace norrsken {

class Shapes : public PluginTools {
 public:
  using PluginTools::PluginTools;

  const FileSystem& files() const;
  /// Stores the nine numbers of a sphere's rotation, row by row, and returns their offset.
  std::uint32_t store_rotation(std::span<const float, 9> rows);
  /// How many numbers images and tables of shapes have by now.
  std::size_t texel_count() const;

  /// Whether the shape stands in a group.
  bool in_group() const;
  /// The group of shapes that a `shapegroup` node is; one that several instances refer to is compiled once.
  std::uint32_t group(const Node& node);
  /// False if the group would reach out of range there.
  bool add_instance(std::uint32_t group, const glm::dmat4& world_from_object);
};

/// World-space geometry; empty after a complaint.
using CompileShape = std::optional<ShapeGeometry>(Parameters&, Shapes&);

#define NORRSKEN_SHAPE(name) CompileShape compile_shape_##name;
#include "lists/shape.def"
#undef NORRSKEN_SHAPE

}  // namespace norrsken
