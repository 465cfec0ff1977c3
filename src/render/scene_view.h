// The scene made ready for kernels: tables, acceleration structure and settings in one view.
#pragma once

#include <string>

#include "accel/build.h"
#include "compile/compile.h"
#include "isa/entry.h"
#include "norrsken/diagnostics.h"
#include "norrsken/render.h"
#include "tables/wave_types.h"

namespace norrsken {

/// The kernels of an instruction set by name, as usable_isas() has it, or "auto"; complains about others.
const KernelEntry* choose_kernels(const std::string& isa, Diagnostics& diagnostics);

/// The accelerator by name ("auto", "planes", "moller_trumbore", "bvh", "embree"); "auto" goes by the number of primitives
/// and lanes, and takes none that knows only polygons if `layers` count the triangles. Complains about unknown names, planes for a
/// large scene, and about what does not know the scene's shapes, and falls back to auto's choice.
AccelKind choose_accel(const std::string& name, const SceneTables& tables, const SceneLayers& layers,
                       std::uint32_t lanes, Diagnostics& diagnostics);
const char* accel_name(AccelKind kind);

/// In the frame that the scene was loaded with. Borrows from both arguments, which must outlive it.
SceneView make_scene_view(const SceneTables& tables, const AccelView& accel);

/// Gives a view of the tables another frame, which must outlive it.
void set_frame(SceneView& view, const SceneFrame& frame, const SceneTables& tables);

}  // namespace norrsken
