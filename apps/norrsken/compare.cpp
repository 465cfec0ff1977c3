// norrsken compare: how far an image is from a reference.
#include <fmt/format.h>

#include <algorithm>

#include "arguments.h"
#include "commands.h"
#include "console.h"
#include "file_use.h"
#include "norrsken/compare.h"
#include "norrsken/merge.h"
#include "session.h"
#include "text_format.h"

namespace norrsken::cli {
namespace {

struct Arguments {
  std::string a, b, output;
  ToneArguments tone;
  MemoryArguments memory;
  bool json = false;
};

/// Complaints about one image after the other are printed; the first one's status stays.
Image read_image_or_tell(const std::string& path, const std::shared_ptr<MemoryBudget>& memory, ExitStatus& result) {
  Result<Image> image = read_image(path, memory);
  if (image) {
    for (const Channel& channel : image->channels) memory->take(channel.values.size() * sizeof(float));
    return *std::move(image);
  }
  print_error(is_checkpoint(path)
                  ? fmt::format("'{0}' is a checkpoint, not an image: 'norrsken merge {0} -o image.exr --layers' makes "
                                "one of it",
                                path)
                  : image.error());
  if (result == ExitStatus::done) result = unreadable_input_status(path);
  return {};
}

ExitStatus check_output(const Arguments& arguments) {
  if (arguments.output.empty()) return ExitStatus::done;
  const auto images = uses_of({arguments.a, arguments.b}, "one of the images to compare");
  const ExitStatus clash = check_written_files({arguments.output}, images);
  if (clash != ExitStatus::done) return clash;
  return check_outputs({arguments.output});
}

void print_as_json(const Arguments& arguments, const Comparison& comparison) {
  Json z_test;
  if (const auto& z = comparison.z_test) {
    const auto estimated = z->estimated;
    z_test = {{"passed_share", z->passed_share},
              {"rms_z", z->rms_z},
              {"mean_z", z->mean_z},
              {"noise_estimated_of", estimated == Comparison::ZTest::Estimated::neither ? Json()
                                     : estimated == Comparison::ZTest::Estimated::a     ? Json("image")
                                                                                        : Json("reference")}};
  }
  Json object = {{"image", arguments.a},
                 {"reference", arguments.b},
                 {"mse", comparison.mse},
                 {"rel_mse", comparison.rel_mse},
                 {"psnr", comparison.psnr},
                 {"flip", comparison.flip},
                 {"mean", comparison.mean_a},
                 {"reference_mean", comparison.mean_b},
                 {"nan_pixels", comparison.nan_a},
                 {"reference_nan_pixels", comparison.nan_b},
                 {"z_test", z_test}};
  if (!arguments.output.empty()) object.add("file", arguments.output);
  print_json(object);
}

void print_as_text(const Comparison& comparison) {
  print_line(fmt::format("MSE     {:.6g}", comparison.mse));
  print_line(fmt::format("relMSE  {:.6g}", comparison.rel_mse));
  print_line(fmt::format("PSNR    {:.2f} dB", comparison.psnr));
  print_line(fmt::format("FLIP    {:.4f}", comparison.flip));
  print_line(fmt::format("mean    {:.6g}, reference {:.6g}", comparison.mean_a, comparison.mean_b));
  const auto tell_nan = [](std::uint64_t pixels, const char* which) {
    if (pixels > 0) print_line(fmt::format("NaN     in {} of the {}", format_plural(pixels, "pixel"), which));
  };
  tell_nan(comparison.nan_a, "image");
  tell_nan(comparison.nan_b, "reference");
  const auto& z = comparison.z_test;
  if (!z) {
    print_line("z-test  none: no pixel has a known variance (norrsken render --layers, two samples at least)");
    return;
  }
  print_line(
      fmt::format("z-test  {:.4g} % of the pixel channels pass, rms z {:.3f}, z of the means {:.2f} {:.2f} {:.2f}",
                  100 * z->passed_share, z->rms_z, z->mean_z[0], z->mean_z[1], z->mean_z[2]));
  if (z->estimated == Comparison::ZTest::Estimated::neither) return;
  print_line(
      fmt::format("        The {} has no variance layers (norrsken render --layers): its noise is estimated from",
                  z->estimated == Comparison::ZTest::Estimated::a ? "image" : "reference"));
  print_line("        differences between neighbouring pixels.");
}

ExitStatus compare_images(const Arguments& arguments) {
  ExitStatus wrong = check_output(arguments);
  const auto memory = arguments.memory.budget();
  const Image a = read_image_or_tell(arguments.a, memory, wrong), b = read_image_or_tell(arguments.b, memory, wrong);
  if (wrong != ExitStatus::done) return wrong;
  if (a.width != b.width || a.height != b.height)
    throw Failure(ExitStatus::data_error, fmt::format("the images differ in size: {} is {}x{}, {} {}x{}", arguments.a,
                                                      a.width, a.height, arguments.b, b.width, b.height));
  CompareOptions options;
  options.tone = arguments.tone.tone_mapping();
  options.memory = memory;
  options.difference = !arguments.output.empty();
  const Result<Comparison> comparison = compare(a, b, options);
  if (!comparison)
    throw Failure(ExitStatus::data_error,
                  fmt::format("cannot compare '{}' with '{}': {}", arguments.a, arguments.b, comparison.error()));
  if (options.difference) write_image_or_fail(arguments.output, comparison->difference, options.tone);
  arguments.json ? print_as_json(arguments, *comparison) : print_as_text(*comparison);
  return ExitStatus::done;
}

}  // namespace

Command compare_command() {
  auto arguments = std::make_shared<Arguments>();
  Command command = {
      .name = "compare",
      .summary = "Tell how far an image is from a reference",
      .options = {
          {.names = "IMAGE", .target = &arguments->a, .help = "Image to judge", .is_required = true},
          {.names = "REFERENCE",
           .target = &arguments->b,
           .help = "Image taken as right, of the same size",
           .is_required = true},
          {"-o,--output", &arguments->output, "FILE", "Write the absolute difference to this EXR, PNG or JPEG file"}}};
  arguments->tone.add_to(command);
  arguments->memory.add_to(command);
  command.options.push_back({.names = "--json", .target = &arguments->json, .help = "Print one JSON object"});
  command.footer =
      "MSE and relMSE are of linear radiance, PSNR and FLIP of the tone-mapped images. The z-test asks, for every\n"
      "pixel, whether both images can be estimates of the same picture; it needs variance layers in both of them. If\n"
      "one has none, its noise is estimated from differences between neighbouring pixels.\n\n"
      "Examples:\n"
      "  norrsken compare room.exr reference.exr\n"
      "  norrsken compare room.exr reference.exr -o difference.png --exposure 2";
  command.run = [arguments] { return compare_images(*arguments); };
  return command;
}

}  // namespace norrsken::cli
