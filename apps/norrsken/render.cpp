// norrsken render: from a scene to image files.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "arguments.h"
#include "commands.h"
#include "console.h"
#include "file_use.h"
#include "interrupt.h"
#include "progress.h"
#include "replay.h"
#include "session.h"
#include "text_format.h"

namespace norrsken::cli {
namespace {

struct Arguments {
  SceneArguments scene;
  MachineArguments machine;
  ToneArguments tone;
  ReplayArguments replay;
  std::vector<std::string> outputs;
  std::uint64_t seed = 0;
  std::string samples, checkpoint, checkpoint_every;
  std::string target_error, time;
  bool adaptive = false, layers = false, features = false, quiet = false, json = false;

  /// What decides a sample, and the machine that takes it.
  RenderOptions sampling() const {
    RenderOptions options;
    machine.apply_to(options);
    options.seed = seed;
    return options;
  }
  /// An error or a time says when to end.
  bool is_open() const { return !target_error.empty() || !time.empty(); }
  Verbosity verbosity() const { return quiet ? Verbosity::quiet : json ? Verbosity::json : Verbosity::text; }
};

bool is_exr(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".exr";
}

/// The scene's name with the extension .exr, in the current folder, as renderers do.
std::string default_output(const std::string& scene) {
  const std::string stem = std::filesystem::path(scene).stem().string();
  return (stem.empty() ? "render" : stem) + ".exr";
}

/// Options that cannot have an effect on any of the files asked for.
void warn_about_useless_options(const Arguments& arguments) {
  const bool any_exr = std::any_of(arguments.outputs.begin(), arguments.outputs.end(), is_exr);
  const bool all_exr = std::all_of(arguments.outputs.begin(), arguments.outputs.end(), is_exr);
  if ((arguments.layers || arguments.features) && !any_exr)
    print_warning("layers are only kept in EXR files: add '-o FILE.exr'");
  if ((arguments.tone.exposure != 0 || arguments.tone.curve != "srgb") && all_exr)
    print_warning("EXR files hold linear radiance: --exposure and --tone change PNG and JPEG files only");
}

Json or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

/// Samples of each pixel that are asked for; nothing if an error or a time says when to end.
std::optional<int> sample_count(const Arguments& arguments, const SceneInfo& info) {
  if (const auto range = parse_samples(arguments.samples)) return static_cast<int>(range->count());
  return arguments.is_open() && arguments.scene.spp == 0 ? std::nullopt : std::optional(info.samples_per_pixel);
}

/// "64 samples per pixel", "at most 64 samples per pixel until the error is 1%".
std::string end_text(const Arguments& arguments, const SceneInfo& info) {
  std::vector<std::string> parts;
  if (const auto count = sample_count(arguments, info))
    parts.push_back(fmt::format("{}{} per pixel{}", arguments.is_open() ? "at most " : "",
                                format_plural(*count, "sample"), arguments.adaptive ? " on average" : ""));
  if (!arguments.target_error.empty()) parts.push_back("until the error is " + arguments.target_error);
  if (!arguments.time.empty()) parts.push_back("for " + arguments.time);
  return fmt::format("{}", fmt::join(parts, ", "));
}

void tell_start(const Arguments& arguments, const SceneInfo& info) {
  if (arguments.json) {
    print_json({{"event", "start"},
                {"version", NORRSKEN_VERSION},
                {"scene", arguments.scene.scene},
                {"width", info.width},
                {"height", info.height},
                {"samples_per_pixel", sample_count(arguments, info)},
                {"target_error", parse_share(arguments.target_error)},
                {"time", parse_duration(arguments.time)},
                {"adaptive", arguments.adaptive},
                {"seed", arguments.seed},
                {"samples", or_null(arguments.samples)},
                {"checkpoint", or_null(arguments.checkpoint)},
                {"integrator", info.integrator},
                {"max_depth", info.max_depth},
                {"emitter_samples", info.emitter_samples},
                {"sampler", info.sampler},
                {"files", arguments.outputs}});
  } else if (!arguments.quiet) {
    print_note(fmt::format("{}: {} x {} pixels, {} ({}), {}, {} per hit", arguments.scene.scene, info.width,
                           info.height, end_text(arguments, info), info.sampler, info.integrator,
                           format_plural(info.emitter_samples, "shadow ray")));
  }
}

/// Samples that were left out because they were not finite.
void tell_dropped(const Arguments& arguments, const RenderStatistics& statistics) {
  if (statistics.dropped_samples == 0) return;
  std::string where;
  for (const DroppedSample& dropped : statistics.dropped)
    where += fmt::format("{} pixel ({}, {}) sample {}", where.empty() ? "" : ",", dropped.x, dropped.y, dropped.sample);
  const bool more = statistics.dropped_samples > statistics.dropped.size();
  print_warning(fmt::format("{} sample{} left out, being infinite or not a number:{}{}", statistics.dropped_samples,
                            statistics.dropped_samples == 1 ? " was" : "s were", where, more ? ", ..." : ""));
  // Light paths belong to no pixel.
  if (statistics.dropped.empty() || !statistics.samples_of_pixels) return;
  const DroppedSample& first = statistics.dropped.front();
  print_note(fmt::format("what became of the first: {}",
                         replay_command(arguments.scene, arguments.seed, statistics, first.x, first.y, first.sample)));
}

/// Rays that came to a medium's boundary in another medium: the scene says what it does not mean.
void tell_wrong_media(const RenderStatistics& statistics) {
  if (statistics.wrong_media == 0) return;
  const std::string& id = statistics.wrong_medium_shape_id;
  print_warning(fmt::format(
      "{} ray{} came to the boundary of a medium in another medium than the one that lies there, first at {}: does the "
      "sensor stand in a medium, is a mesh open, or do shapes overlap without saying their 'exterior'?",
      statistics.wrong_media, statistics.wrong_media == 1 ? "" : "s",
      id.empty() ? fmt::format("shape {}", statistics.wrong_medium_shape) : fmt::format("shape '{}'", id)));
}

/// Writes every file that can be written, tells what is wrong with the others, and returns those written.
std::vector<std::string> write_outputs(const Arguments& arguments, const Render& rendering) {
  const Image image = rendering.image(arguments.layers || arguments.features);
  std::vector<std::string> written;
  for (const std::string& path : arguments.outputs) {
    const IoStatus status = write_image(path, image, arguments.tone.tone_mapping());
    status ? written.push_back(path) : print_error(status.error);
  }
  return written;
}

void tell_done(const Arguments& arguments, const SceneInfo& info, const RenderStatistics& statistics,
               const std::vector<std::string>& written) {
  const double pixels = static_cast<double>(info.width) * info.height;
  const double samples = static_cast<double>(statistics.samples);
  const double taken = static_cast<double>(statistics.samples - statistics.samples_resumed);
  const double seconds = std::max(statistics.seconds, 1e-9);
  const double rays = static_cast<double>(statistics.closest_rays + statistics.shadow_rays);
  if (arguments.json) {
    Json dropped = Json::array();
    for (const DroppedSample& sample : statistics.dropped)
      dropped.add({{"x", sample.x}, {"y", sample.y}, {"sample", sample.sample}});
    Json object = {{"event", "done"},
                   {"interrupted", statistics.cancelled},
                   {"seconds", statistics.seconds},
                   {"samples", statistics.samples},
                   {"samples_resumed", statistics.samples_resumed},
                   {"samples_per_pixel", samples / pixels},
                   {"samples_per_second", taken / seconds},
                   {"closest_rays", statistics.closest_rays},
                   {"shadow_rays", statistics.shadow_rays},
                   {"rays_per_second", rays / seconds},
                   {"dropped_samples", statistics.dropped_samples},
                   {"dropped", dropped},
                   {"isa", statistics.isa},
                   {"lanes", statistics.lanes},
                   {"threads", statistics.threads},
                   {"accelerator", statistics.accelerator},
                   {"files", written}};
    add_error(object, statistics.error);
    print_json(object);
    return;
  }
  if (arguments.quiet) return;
  const bool was_done = statistics.samples_resumed > 0 && statistics.samples_resumed == statistics.samples;
  std::string text = fmt::format("{} samples in {}, {} Msamples/s, {} Mrays/s", format_count(taken),
                                 format_duration(statistics.seconds), format_digits(taken / seconds / 1e6),
                                 format_digits(rays / seconds / 1e6));
  if (was_done) {
    text = fmt::format("no samples were left to take: the checkpoint holds {}",
                       format_count(static_cast<double>(statistics.samples)));
  } else if (statistics.samples_resumed > 0) {
    text += fmt::format(", {} from the checkpoint", format_count(static_cast<double>(statistics.samples_resumed)));
  }
  text += ", " + error_text(statistics.error, samples / pixels);
  if (!was_done)
    text += fmt::format(" ({}, {}, {}, {})", statistics.isa, format_plural(statistics.lanes, "lane"),
                        format_plural(statistics.threads, "thread"), statistics.accelerator);
  print_note(text);
  if (!written.empty()) print_note(fmt::format("wrote {}", fmt::join(written, ", ")));
  if (!statistics.cancelled) return;
  const double per_pixel = samples / pixels;
  const std::optional<int> asked = sample_count(arguments, info);
  const bool is_saved = !arguments.checkpoint.empty() && statistics.checkpoint_error.empty();
  const std::string advice = is_saved                       ? "; the same command goes on"
                             : arguments.checkpoint.empty() ? "; with --checkpoint FILE, the same command would go on"
                                                            : "";
  if (!written.empty())
    print_note(fmt::format("interrupted: the image holds {}{} per pixel{}",
                           per_pixel < 1 ? fmt::format("{:.2g}", per_pixel) : format_digits(per_pixel),
                           asked ? " of " + format_plural(*asked, "sample") : " samples", advice));
  else if (!statistics.has_image)
    print_note(fmt::format("interrupted before the first {}: no image was written{}",
                           statistics.samples == 0 ? "sample" : "image was complete", advice));
  else
    print_note("interrupted" + advice);
}

ExitStatus replay(const Arguments& arguments) {
  if (!arguments.outputs.empty() || !arguments.checkpoint.empty() || !arguments.checkpoint_every.empty() ||
      !arguments.samples.empty() || arguments.is_open() || arguments.adaptive)
    throw Failure(ExitStatus::usage,
                  "--pixel prints one sample: -o, --checkpoint, --samples, --target-error, --time and --adaptive have "
                  "no place beside it");
  LoadOptions options = arguments.scene.load_options();
  options.reserve_film = false;
  const Scene scene = load_scene(arguments.scene.scene, options, !arguments.quiet);
  return replay(scene, arguments.sampling(), arguments.replay, arguments.json);
}

/// A Failure for options that have no meaning together.
void check_combination(const Arguments& arguments) {
  if (!arguments.checkpoint_every.empty() && arguments.checkpoint.empty())
    throw Failure(ExitStatus::usage, "--checkpoint-every needs --checkpoint FILE, which is written so often");
  const auto samples = parse_samples(arguments.samples);
  if (!samples) return;
  if (arguments.checkpoint.empty())
    throw Failure(ExitStatus::usage, "--samples needs --checkpoint FILE, which receives what 'norrsken merge' joins");
  if (arguments.is_open() || arguments.adaptive)
    throw Failure(
        ExitStatus::usage,
        "--samples takes all samples of a range: --target-error, --time and --adaptive have no place beside it");
  const int spp = arguments.scene.spp;  // beside a range, how many samples its image is to have in all
  if (spp > 0 && samples->end > static_cast<std::uint32_t>(spp))
    throw Failure(ExitStatus::usage, fmt::format("--samples {} ends behind the {} of --spp", arguments.samples,
                                                 format_plural(spp, "sample")));
}

/// Tells which of the files that are written are read, too, or are one file, and images that are too large for their
/// formats: what the first of that means, or `done`.
ExitStatus check_files(const Arguments& arguments, const SceneInfo& info) {
  const std::vector<FileUse> read = uses_of(info.files, "a file that the scene reads");
  std::vector<FileUse> taken = read;
  ExitStatus result = ExitStatus::done;
  const auto note = [&](ExitStatus status) {
    if (result == ExitStatus::done) result = status;
  };
  if (!arguments.checkpoint.empty()) {
    for (const std::string& path : checkpoint_files(arguments.checkpoint)) {
      note(check_written_files({path}, read));
      taken.push_back({path, path == arguments.checkpoint ? "the checkpoint" : "a file of the checkpoint"});
    }
  }
  note(check_written_files(arguments.outputs, taken));
  note(check_image_sizes(arguments.outputs, info.width, info.height));
  return result;
}

ExitStatus render(Arguments arguments) {
  if (arguments.replay.wanted()) return replay(arguments);
  check_combination(arguments);
  // A part of the samples is there to be merged, and only shown if that is asked for.
  if (arguments.outputs.empty() && arguments.samples.empty())
    arguments.outputs = {default_output(arguments.scene.scene)};
  arguments.outputs = without_repetitions(arguments.outputs);
  const ExitStatus outputs = check_outputs(arguments.outputs, arguments.checkpoint);
  if (!arguments.quiet && outputs == ExitStatus::done) warn_about_useless_options(arguments);

  const Scene scene = load_scene(arguments.scene.scene, arguments.scene.load_options(), !arguments.quiet, outputs);
  const SceneInfo info = scene.info();
  if (const ExitStatus status = check_files(arguments, info); status != ExitStatus::done) return status;
  RenderOptions options = arguments.sampling();
  options.features = arguments.features;
  if (!arguments.samples.empty()) options.samples = parse_samples(arguments.samples);
  if (arguments.scene.spp > 0) options.samples_per_pixel = arguments.scene.spp;
  options.target_error = parse_share(arguments.target_error).value_or(0);
  options.seconds = parse_duration(arguments.time).value_or(0);
  options.adaptive = arguments.adaptive;
  options.checkpoint = arguments.checkpoint;
  options.checkpoint_seconds = parse_duration(arguments.checkpoint_every).value_or(options.checkpoint_seconds);
  const auto rendering = create_render(scene, options, !arguments.quiet);
  tell_start(arguments, info);

  const InterruptGuard guard(*rendering);
  ProgressMeter meter(arguments.verbosity());
  meter.start("");
  const RenderStatistics statistics = rendering->run([&](const RenderProgress& progress) {
    meter.update(progress);
    if (!progress.checkpoint_error.empty()) meter.warn(progress.checkpoint_error);
    if (interrupt_requested()) meter.announce("stopping; writing what there is (Ctrl-C again before that discards it)");
  });
  meter.finish();

  std::vector<std::string> written;
  if (statistics.has_image) written = write_outputs(arguments, *rendering);
  if (!statistics.checkpoint_error.empty()) print_error(statistics.checkpoint_error);
  if (!arguments.quiet) tell_dropped(arguments, statistics), tell_wrong_media(statistics);
  tell_done(arguments, info, statistics, written);
  if (!statistics.failure.empty()) throw Failure(ExitStatus::internal, statistics.failure);
  const bool all_written = !statistics.has_image || written.size() == arguments.outputs.size();
  if (!all_written || !statistics.checkpoint_error.empty()) return ExitStatus::io_error;
  return statistics.cancelled ? ExitStatus::interrupted : ExitStatus::done;
}

}  // namespace

Command render_command() {
  auto arguments = std::make_shared<Arguments>();
  Command command = {.name = "render", .summary = "Render a scene to image files"};
  const auto add = [&](std::initializer_list<Option> options) {
    command.options.insert(command.options.end(), options);
  };
  arguments->scene.add_to(command);
  add({{"-o,--output", &arguments->outputs, "FILE",
        "Image to write: .exr (linear float), .png or .jpg (tone-mapped); may be repeated;\n"
        "default: the scene's name with .exr, in the current folder"},
       {"--seed", &arguments->seed, "S", "Seed of the random numbers; default 0", seed_number()}});
  arguments->machine.add_to(command);
  add({{"--checkpoint", &arguments->checkpoint, "FILE",
        "File that keeps the state of the rendering; the same command goes on from it, also with more --spp",
        file_name()},
       {"--checkpoint-every", &arguments->checkpoint_every, "TIME", "How often it is written: 90s, 5m, 1h; default 60s",
        duration()},
       {"--samples", &arguments->samples, "A:B",
        "Take the samples A to B-1 of each pixel alone (of --spp in all) and leave them in the checkpoint, for\n"
        "'norrsken merge'",
        sample_range()},
       {"--target-error", &arguments->target_error, "E",
        "Render until the estimated error of the whole image (RMSE over mean) is at most this: 1%, 0.005;\n"
        "--spp is the most to take then",
        share()},
       {"--time", &arguments->time, "TIME",
        "Render for so long: 30s, 5m, 1h, without loading and writing; --spp is\nthe most to take then", duration()},
       {.names = "--adaptive",
        .target = &arguments->adaptive,
        .help = "Take more samples where there is more noise; --spp is their mean"},
       {.names = "--layers",
        .target = &arguments->layers,
        .help = "Add sample count, variance, error and 95 % interval layers to EXR files"},
       {.names = "--features",
        .target = &arguments->features,
        .help = "Add depth, normal, albedo and object id of the first hits too (implies --layers)"}});
  arguments->tone.add_to(command);
  arguments->replay.add_to(command);
  add({{.names = "--quiet", .target = &arguments->quiet, .help = "Print errors only; with --json, start and done only"},
       {.names = "--json",
        .target = &arguments->json,
        .help = "Print one JSON object a line on stdout: start, progress, done"}});
  command.footer =
      "Ctrl-C, SIGTERM or SIGHUP stops the rendering, writes what there is and exits with status 77; a second one\n"
      "before that discards it (not the last checkpoint). SIGUSR1, SIGUSR2, SIGXCPU and SIGALRM, with which batch "
      "systems warn, "
      "stop\n"
      "it likewise, and discard nothing. The same scene, seed and options give the same image for any number of "
      "threads.\n\n"
      "Examples:\n"
      "  norrsken render hexagon_room -Dshadow_rays=1              writes hexagon_room.exr\n"
      "  norrsken render hexagon_room -Dshadow_rays=1 -o room.png --spp 128 --exposure 1.5 --tone filmic\n"
      "  norrsken render hexagon_room -Dlight=point -Dshadow_rays=1 -o a.exr -o a.png --layers\n"
      "  norrsken render hexagon_room -Dshadow_rays=1 --size 1920x1080 --json\n"
      "  norrsken render hexagon_room -Dshadow_rays=1 --target-error 5% --adaptive\n"
      "  norrsken render hexagon_room -Dshadow_rays=1 --time 30s --layers\n"
      "  norrsken render hexagon_room -Dshadow_rays=1 --spp 4096 --checkpoint room.ckpt --checkpoint-every 10m\n"
      "  norrsken render hexagon_room -Dshadow_rays=1 --samples 0:32 --checkpoint a.part\n"
      "  norrsken render hexagon_room -Dshadow_rays=1 --pixel 400,500 --sample 3 --trace";
  command.run = [arguments] { return render(*arguments); };
  return command;
}

}  // namespace norrsken::cli
