// norrsken figures: the pictures of the report that the hexagon room comes from, measured.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "arguments.h"
#include "commands.h"
#include "console.h"
#include "figures/equal_error.h"
#include "figures/figures_page.h"
#include "file_use.h"
#include "interrupt.h"
#include "progress.h"
#include "session.h"
#include "text_format.h"

namespace norrsken::cli {
namespace {

namespace fs = std::filesystem;

/// By its path: a file of the name in the current folder would hide the scene.
constexpr const char* kScenePath = "builtin:hexagon_room.xml";

struct Arguments {
  std::string folder, sampler = kReportSampler;
  MachineArguments machine;
  MemoryArguments memory;
  bool quick = false, quiet = false;

  /// The command line that gives the same figures.
  std::string command() const {
    std::string text = fmt::format("norrsken figures -o {}{}", folder, quick ? " --quick" : "");
    if (sampler != kReportSampler) text += " --sampler " + sampler;
    if (machine.threads > 0) text += fmt::format(" --threads {}", machine.threads);
    if (machine.isa != "auto") text += " --isa " + machine.isa;
    if (machine.accelerator != "auto") text += " --accel " + machine.accelerator;
    return text;
  }
};

/// Light, integrator and counts of a figure, as the report gives them; its words as the caption.
struct Figure {
  int number;
  const char *caption, *light, *integrator;
  int spp, shadow_rays;
};

constexpr std::array<Figure, 9> kFigures = {{
    {5, "5 samples per pixel (point light)", "point", "path", 5, 5},
    {6, "Direct illumination from figure 5", "point", "whitted", 5, 5},
    {7, "5 samples per pixel and 5 shadow rays", "area", "path", 5, 5},
    {8, "5 samples per pixel and 20 shadow rays", "area", "path", 5, 20},
    {9, "1 sample per pixel", "area", "path", 1, 1},
    {10, "5 samples per pixel", "area", "path", 5, 5},
    {11, "10 samples per pixel", "area", "path", 10, 10},
    {12, "20 samples per pixel", "area", "path", 20, 20},
    {13, "150 samples per pixel", "area", "path", 150, 150},
}};

/// What the figures are compared with: many samples of the low-discrepancy sampler, one shadow ray per hit.
struct Reference {
  const char *name, *stem, *light, *integrator;
  int spp, quick_spp;
};

constexpr std::array<Reference, 3> kReferences = {{
    {"Reference, area light", "reference_area", "area", "path", 2048, 1024},
    {"Reference, point light", "reference_point", "point", "path", 2048, 1024},
    {"Reference, direct light", "reference_direct", "point", "whitted", 1024, 256},
}};

std::string stem_of(const Figure& figure) { return fmt::format("figure_{:02}", figure.number); }
/// Of the image with one shadow ray per hit that is as right as the last figure.
std::string equal_stem() { return stem_of(kFigures.back()) + "_one_shadow_ray"; }

constexpr const char* kExtensions[] = {".exr", ".png"};

/// All images that are written to the folder.
std::vector<std::string> image_paths(const fs::path& folder) {
  std::vector<std::string> stems = {equal_stem()};
  for (const Reference& reference : kReferences) stems.emplace_back(reference.stem);
  for (const Figure& figure : kFigures) stems.push_back(stem_of(figure));
  std::vector<std::string> paths;
  for (const std::string& stem : stems) {
    for (const char* extension : kExtensions) paths.push_back((folder / (stem + extension)).string());
  }
  return paths;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos) return line.substr(line.find(": ") + 2);
  return "";
}

/// The sampler's name as an adjective: "Sobol'" of "sobol".
std::string sampler_word(const std::string& sampler) { return sampler == "sobol" ? "Sobol'" : sampler; }

/// What comparing with a perfect image would give, from the variance layers of the image itself.
Comparison estimated_error(const Image& image) {
  Comparison result;
  std::size_t count = 0;
  for (const char* name : {"R", "G", "B"}) {
    const Channel *radiance = image.find(name), *variance = image.find(std::string("variance.") + name);
    if (radiance == nullptr || variance == nullptr) continue;
    for (std::size_t i = 0; i < radiance->values.size(); ++i) {
      const double value = radiance->values[i], squared_error = variance->values[i];
      if (!std::isfinite(squared_error)) continue;
      result.mse += squared_error;
      result.rel_mse += squared_error / (value * value + 0.01);
      ++count;
    }
  }
  const double n = static_cast<double>(std::max<std::size_t>(count, 1));
  result.mse /= n;
  result.rel_mse /= n;
  return result;
}

/// Renders, measures, writes and tells; one rendering at a time.
class Workshop {
 public:
  explicit Workshop(const Arguments& arguments)
      : arguments_(arguments), meter_(arguments.quiet ? Verbosity::quiet : Verbosity::text) {
    report_.command = arguments.command();
    report_.machine = processor_name();
    report_.width = report_.height = arguments.quick ? 200 : kReportSide;
  }

  FiguresReport run() {
    for (const Reference& reference : kReferences) make_reference(reference);
    for (const Figure& figure : kFigures) {
      FigureResult result = {.name = fmt::format("Figure {}", figure.number),
                             .caption = figure.caption,
                             .stem = stem_of(figure),
                             .light = figure.light,
                             .integrator = figure.integrator,
                             .sampler = arguments_.sampler,
                             .spp = figure.spp,
                             .shadow_rays = figure.shadow_rays};
      write(result.stem, measure(result, static_cast<std::uint64_t>(figure.number)));
      report_.figures.push_back(std::move(result));
    }
    measure_one_ray_series();
    return std::move(report_);
  }

 private:
  void make_reference(const Reference& reference) {
    FigureResult result = {.name = reference.name,
                           .caption = "Converged",
                           .stem = reference.stem,
                           .light = reference.light,
                           .integrator = reference.integrator,
                           .sampler = "sobol",
                           .spp = arguments_.quick ? reference.quick_spp : reference.spp,
                           .shadow_rays = 1};
    Image image = render(result, 0, true);
    result.comparison = estimated_error(image);
    write(result.stem, image);
    references_[{reference.light, reference.integrator}] = std::move(image);
    tell(result);
    report_.references.push_back(std::move(result));
  }

  /// Renders `result` and compares it with its reference.
  Image measure(FigureResult& result, std::uint64_t seed) {
    Image image = render(result, seed);
    const auto reference = std::find_if(report_.references.begin(), report_.references.end(), [&](const auto& r) {
      return r.light == result.light && r.integrator == result.integrator;
    });
    result.reference = reference->name;
    const Result<Comparison> comparison = compare(image, references_.at({result.light, result.integrator}));
    if (!comparison) throw Failure(ExitStatus::internal, comparison.error());
    result.comparison = *comparison;
    tell(result);
    return image;
  }

  /// Samples and time at which one shadow ray per hit is as right as the last figure.
  void measure_one_ray_series() {
    const FigureResult& last = report_.figures.back();
    auto& series = report_.one_ray;
    std::map<int, Image> images;
    std::vector<SppError> measured;
    const auto render_and_measure = [&](int spp) {
      FigureResult result = {.name = "One shadow ray per hit",
                             .caption = format_plural(spp, "sample") + " per pixel",
                             .stem = "",
                             .light = last.light,
                             .integrator = last.integrator,
                             .sampler = last.sampler,
                             .spp = spp,
                             .shadow_rays = 1};
      images[spp] = measure(result, 1000 + static_cast<std::uint64_t>(spp));
      series.push_back(std::move(result));
      return series.back().relative_error();
    };
    std::set<int> counts;  // those of the figures that differ from the last one in nothing else
    for (const FigureResult& figure : report_.figures)
      if (figure.light == last.light && figure.integrator == last.integrator) counts.insert(figure.spp);
    measured.reserve(measured.size() + counts.size());
    for (const int spp : counts) measured.push_back({spp, render_and_measure(spp)});
    const int equal_spp = find_equal_error(last.relative_error(), measured, render_and_measure).spp;

    std::sort(series.begin(), series.end(), [](const FigureResult& a, const FigureResult& b) { return a.spp < b.spp; });
    const auto equal =
        std::find_if(series.begin(), series.end(), [&](const FigureResult& result) { return result.spp == equal_spp; });
    equal->stem = equal_stem();
    write(equal->stem, images.at(equal_spp));
    report_.equal = static_cast<std::size_t>(equal - series.begin());
  }

  Image render(FigureResult& result, std::uint64_t seed, bool layers = false) {
    const LoadOptions load_options = {.parameters = {{"light", result.light},
                                                     {"spp", std::to_string(result.spp)},
                                                     {"shadow_rays", std::to_string(result.shadow_rays)},
                                                     {"bounces", "3"}},
                                      .integrator = result.integrator,
                                      .sampler = result.sampler,
                                      .width = report_.width,
                                      .height = report_.height,
                                      .memory = arguments_.memory.budget()};
    const Scene scene = load_scene(kScenePath, load_options);
    RenderOptions options;
    arguments_.machine.apply_to(options);
    options.seed = seed;
    const auto rendering = create_render(scene, options);
    const InterruptGuard guard(*rendering);
    meter_.start(fmt::format("{}: ", result.name));
    result.statistics = rendering->run([this](const RenderProgress& progress) { meter_.update(progress); });
    meter_.finish();
    if (!result.statistics.failure.empty()) throw Failure(ExitStatus::internal, result.statistics.failure);
    if (result.statistics.cancelled)
      throw Failure(
          ExitStatus::interrupted,
          arguments_.quiet
              ? ""
              : fmt::format("interrupted in '{}': what was finished before is in '{}', index.html was not written",
                            result.name, arguments_.folder));
    return rendering->image(layers);
  }

  void write(const std::string& stem, const Image& image) const {
    const SavingGuard guard;
    for (const char* extension : kExtensions)
      write_image_or_fail((fs::path(arguments_.folder) / (stem + extension)).string(), image, ToneMapping{});
  }

  void tell(const FigureResult& result) const {
    if (arguments_.quiet) return;
    print_note(fmt::format(
        "{}: {} per pixel, {} per hit; {}, {}rays, {} Msamples/s, {} {}", result.name,
        format_plural(result.spp, sampler_word(result.sampler) + " sample"),
        format_plural(result.shadow_rays, "shadow ray"), format_duration(result.statistics.seconds),
        format_count(static_cast<double>(result.rays())), format_digits(result.samples_per_second() / 1e6),
        result.reference.empty() ? "own estimate of the error" : "error", format_percent(result.relative_error())));
  }

  const Arguments& arguments_;
  ProgressMeter meter_;
  FiguresReport report_;
  std::map<std::pair<std::string, std::string>, Image> references_;  ///< by light and integrator
};

/// Under a temporary name first, as images are: a reader never sees half of it.
void write_text(const fs::path& path, const std::string& text) {
  const fs::path temporary = fmt::format("{}.{}.tmp", path.string(), getpid());
  std::ofstream file(temporary, std::ios::binary);
  file << text;
  file.close();
  std::error_code error;
  if (file) fs::rename(temporary, path, error);
  if (file && !error) return;
  fs::remove(temporary, error);
  throw Failure(ExitStatus::io_error, fmt::format("cannot write '{}'", path.string()));
}

ExitStatus figures(const Arguments& arguments) {
  std::error_code error;
  fs::create_directories(arguments.folder, error);
  if (error)
    throw Failure(ExitStatus::cannot_create,
                  fmt::format("cannot create the folder '{}': {}", arguments.folder, error.message()));
  const std::vector<std::string> images = image_paths(arguments.folder);
  for (const ExitStatus status : {check_outputs(images), check_written_files(images, {})}) {
    if (status != ExitStatus::done) return status;
  }

  const FiguresReport report = Workshop(arguments).run();
  const fs::path page = fs::path(arguments.folder) / "index.html";
  write_text(page, figures_page(report));
  if (!arguments.quiet) print_note(fmt::format("wrote {} and the images beside it", page.string()));
  return ExitStatus::done;
}

}  // namespace

Command figures_command() {
  auto arguments = std::make_shared<Arguments>();
  Command command = {.name = "figures",
                     .summary = "Render and measure the nine figures of the room's report",
                     .options = {{.names = "-o,--output",
                                  .target = &arguments->folder,
                                  .value = "DIR",
                                  .help = "Folder to write to; made if it does not exist",
                                  .is_required = true},
                                 {.names = "--quick",
                                  .target = &arguments->quick,
                                  .help = "200 x 200 pixels and shorter references in place of 800 x 800"},
                                 {"--sampler", &arguments->sampler, "NAME",
                                  "Sampler of the figures: independent (default, as in the report), sobol"}}};
  arguments->machine.add_to(command);
  arguments->memory.add_to(command);
  command.options.push_back({.names = "--quiet", .target = &arguments->quiet, .help = "Print errors only"});
  command.footer =
      "Renders the hexagon room with 3 bounces at the settings of figures 5 to 13, each to PNG and EXR, measures\n"
      "every figure against a converged reference, finds out how many samples one shadow ray per hit needs to be as\n"
      "right as figure 13, and shows all of it in DIR/index.html. Takes minutes, with --quick about one.\n\n"
      "Examples:\n"
      "  norrsken figures -o figures\n"
      "  norrsken figures -o /tmp/quick --quick --isa avx2";
  command.run = [arguments] { return figures(*arguments); };
  return command;
}

}  // namespace norrsken::cli
