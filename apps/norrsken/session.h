// Loading a scene and starting a rendering of it, with what goes wrong turned into a message and an exit status.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "exit_status.h"
#include "norrsken/render.h"
#include "norrsken/scene.h"

namespace norrsken::cli {

/// What to exit with if `path` could not be read: no_input if it is missing, no regular file or forbidden, otherwise
/// data_error. Never opens it: that waits for ever on a pipe.
ExitStatus unreadable_input_status(const std::string& path);

/// Tells the scene's diagnostics on stderr. A Failure without text if there were errors, of the status that
/// `failed_scene_status` tells. `so_far` is what has been
/// complained about before the scene was loaded: if it is not `done`, it is the Failure's status.
Scene load_scene(const std::string& name, const LoadOptions& options, bool with_warnings = true,
                 ExitStatus so_far = ExitStatus::done);

/// What to exit with after a scene could not be read: no_input if the file itself cannot be, usage if all complaints are
/// about the command line, data_error otherwise.
ExitStatus failed_scene_status(const std::string& scene, const Diagnostics& diagnostics);

/// A Failure without text: usage if the options do not fit this build, this processor or the scene, data_error if the
/// checkpoint does not.
std::unique_ptr<Render> create_render(const Scene& scene, const RenderOptions& options, bool with_warnings = true);

/// Tells on stderr what is wrong with each of these images to be written, and with the checkpoint unless its name is
/// empty: `usage` if the extension of an image is unknown, otherwise `cannot_create`, or `done`.
ExitStatus check_outputs(const std::vector<std::string>& images, const std::string& checkpoint = {});

/// Tells on stderr which of these images are too large for their formats: `cannot_create` if there is one, or `done`.
ExitStatus check_image_sizes(const std::vector<std::string>& images, int width, int height);

/// A Failure (io_error) if the file could not be written.
void write_image_or_fail(const std::string& path, const Image& image, const ToneMapping& tone);

}  // namespace norrsken::cli
