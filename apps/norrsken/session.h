// Loading a scene and starting a rendering of it, with what goes wrong turned into a message and an exit status.
#pragma once

#include <memory>
#include <string>

#include "norrsken/render.h"
#include "norrsken/scene.h"

namespace norrsken::cli {

/// Tells the scene's diagnostics on stderr. A Failure without text if there were errors: no_input if the file itself
/// cannot be read, usage if all complaints are about the command line, data_error otherwise.
Scene load_scene(const std::string& name, const LoadOptions& options, bool with_warnings = true);

/// A Failure (usage) if the options do not fit this build, this processor or the scene.
std::unique_ptr<Render> create_render(const Scene& scene, const RenderOptions& options);

/// A Failure (cannot_create) that tells what is wrong with `path`.
void require_writable(const std::string& path);

/// A Failure (io_error) if the file could not be written.
void write_image_or_fail(const std::string& path, const Image& image, const ToneMapping& tone);

}  // namespace norrsken::cli
