// norrsken merge: joins what `render --samples` has left.
#include "norrsken/merge.h"

#include <fmt/format.h>

#include <algorithm>

#include "commands.h"
#include "console.h"
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
  if (const ExitStatus outputs = check_outputs(arguments.outputs); outputs != ExitStatus::done) return outputs;
  MergedRender merged;
  const IoStatus status = merge_renders(arguments.files, arguments.layers, merged, arguments.memory.budget());
  if (!status) throw Failure(status_of(arguments.files), status.error);

  if (!merged.gaps.empty()) print_warning(fmt::format("no file holds the samples {}", list_of(merged.gaps)));
  const SavingGuard guard;
  for (const std::string& path : arguments.outputs)
    write_image_or_fail(path, merged.image, arguments.tone.tone_mapping());
  if (arguments.quiet) return ExitStatus::done;
  std::uint64_t count = 0;
  for (const SampleRange& range : merged.samples) count += range.count();
  print_note(fmt::format("{} x {} pixels, {} per pixel ({}) of {}", merged.image.width, merged.image.height,
                         format_plural(static_cast<int>(count), "sample"), list_of(merged.samples),
                         format_plural(static_cast<int>(arguments.files.size()), "file")));
  print_note(fmt::format("wrote {}", fmt::join(arguments.outputs, ", ")));
  return ExitStatus::done;
}

}  // namespace

void add_merge_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("merge", "Join the samples that several renderings of a scene have taken");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("FILE", arguments->files, "Checkpoints that 'norrsken render --samples A:B' has completed")
      ->required()
      ->type_name("");
  command->add_option("-o,--output", arguments->outputs, "Image to write: .exr, .png or .jpg; may be repeated")
      ->required()
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("FILE");
  command->add_flag(
      "--layers", arguments->layers,
      "Add sample count, variance, error and 95 % interval layers to EXR files, and features that were rendered");
  arguments->tone.add_to(*command);
  arguments->memory.add_to(*command);
  command->add_flag("--quiet", arguments->quiet, "Print errors and warnings only");
  command->footer(
      "The image is that of one rendering of all samples, bit for bit, in whatever order the files are named. Files "
      "of\n"
      "other scenes, settings or instruction sets are refused, and so are samples that two files hold; samples that "
      "no\n"
      "file holds are told.\n\n"
      "Examples:\n"
      "  norrsken render room.xml --samples 0:512 --checkpoint a.part\n"
      "  norrsken render room.xml --samples 512:1024 --checkpoint b.part\n"
      "  norrsken merge a.part b.part -o room.exr -o room.png");
  command->group("Commands");
  command->callback([&action, arguments] { action = [arguments] { return merge(*arguments); }; });
}

}  // namespace norrsken::cli
