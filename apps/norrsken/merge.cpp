// norrsken merge: joins what `render --samples` has left.
#include "norrsken/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "arguments.h"
#include "commands.h"
#include "console.h"
#include "file_use.h"
#include "interrupt.h"
#include "session.h"
#include "text_format.h"

namespace norrsken::cli {
namespace {

struct Arguments {
  std::vector<std::string> files, outputs;
  ToneArguments tone;
  MemoryArguments memory;
  bool layers = false, quiet = false;
};

std::string list_of(const std::vector<SampleRange>& ranges) {
  std::vector<std::string> texts;
  texts.reserve(ranges.size());
  for (const SampleRange& range : ranges) texts.push_back(fmt::format("{}:{}", range.first, range.end));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// no_input if a file cannot be read at all.
ExitStatus status_of(const std::vector<std::string>& files) {
  const bool unreadable = std::any_of(files.begin(), files.end(), [](const std::string& file) {
    return unreadable_input_status(file) == ExitStatus::no_input;
  });
  return unreadable ? ExitStatus::no_input : ExitStatus::data_error;
}

ExitStatus merge(const Arguments& arguments) {
  const std::vector<std::string> outputs = without_repetitions(arguments.outputs);
  if (const ExitStatus status = check_outputs(outputs); status != ExitStatus::done) return status;
  const ExitStatus clash = check_written_files(outputs, uses_of(arguments.files, "one of the files to merge"));
  if (clash != ExitStatus::done) return clash;
  const Result<MergedRender> result = merge_renders(arguments.files, arguments.layers, arguments.memory.budget());
  if (!result) throw Failure(status_of(arguments.files), result.error());
  const MergedRender& merged = *result;

  if (!merged.gaps.empty()) print_warning(fmt::format("no file holds the samples {}", list_of(merged.gaps)));
  for (const MergedRender::Unfinished& part : merged.unfinished)
    print_warning(fmt::format("'{}' is not finished: it holds {} of {} per pixel", part.file,
                              format_digits(part.samples_per_pixel), format_plural(part.goal, "sample")));
  if (merged.pixels_without_samples > 0)
    print_warning(fmt::format("{} no sample yet and {} black",
                              merged.pixels_without_samples == 1
                                  ? "1 pixel has"
                                  : fmt::format("{} pixels have", merged.pixels_without_samples),
                              merged.pixels_without_samples == 1 ? "is" : "are"));
  const SavingGuard guard;
  for (const std::string& path : outputs) write_image_or_fail(path, merged.image, arguments.tone.tone_mapping());
  if (arguments.quiet) return ExitStatus::done;
  const bool is_whole = merged.unfinished.empty() && merged.samples_per_pixel == std::floor(merged.samples_per_pixel);
  print_note(fmt::format("{} x {} pixels, {} per pixel{} of {}, {}", merged.image.width, merged.image.height,
                         is_whole ? format_plural(static_cast<std::uint64_t>(merged.samples_per_pixel), "sample")
                                  : format_digits(merged.samples_per_pixel) + " samples",
                         is_whole ? fmt::format(" ({})", list_of(merged.samples)) : "",
                         format_plural(arguments.files.size(), "file"),
                         error_text(merged.error, merged.samples_per_pixel)));
  print_note(fmt::format("wrote {}", fmt::join(outputs, ", ")));
  return ExitStatus::done;
}

}  // namespace

Command merge_command() {
  auto arguments = std::make_shared<Arguments>();
  Command command = {
      .name = "merge",
      .summary = "Make an image of checkpoints: join the samples that renderings of a scene have taken",
      .options = {{.names = "FILE",
                   .target = &arguments->files,
                   .help = "Checkpoints that 'norrsken render' has written, finished or not",
                   .is_required = true},
                  {.names = "-o,--output",
                   .target = &arguments->outputs,
                   .value = "FILE",
                   .help = "Image to write: .exr, .png or .jpg; may be repeated",
                   .is_required = true},
                  {.names = "--layers",
                   .target = &arguments->layers,
                   .help = "Add sample count, variance, error and 95 % interval layers to EXR files, and features that "
                           "were rendered"}}};
  arguments->tone.add_to(command);
  arguments->memory.add_to(command);
  command.options.push_back(
      {.names = "--quiet", .target = &arguments->quiet, .help = "Print errors and warnings only"});
  command.footer =
      "The image is that of one rendering of all samples, bit for bit, in whatever order the files are named. Files "
      "of\n"
      "other scenes, settings or instruction sets are refused, and so are samples that two files hold; samples that "
      "no\n"
      "file holds are told, and files that are not finished: renderings may go on writing them.\n\n"
      "Examples:\n"
      "  norrsken render hexagon_room -Dshadow_rays=1 --samples 0:32 --checkpoint a.part\n"
      "  norrsken render hexagon_room -Dshadow_rays=1 --samples 32:64 --checkpoint b.part\n"
      "  norrsken merge a.part b.part -o room.exr -o room.png";
  command.run = [arguments] { return merge(*arguments); };
  return command;
}

}  // namespace norrsken::cli
