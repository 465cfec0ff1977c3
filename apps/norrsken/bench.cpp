// norrsken bench: how fast a scene renders, as one line of JSON.
#include <algorithm>

#include "arguments.h"
#include "commands.h"
#include "console.h"
#include "interrupt.h"
#include "session.h"

namespace norrsken::cli {
namespace {

struct Arguments {
  SceneArguments scene;
  MachineArguments machine;
  int repeat = 5;
};

Json spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const double median = n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
  return {{"median", median}, {"min", values.front()}, {"max", values.back()}};
}

RenderStatistics render_once(const Scene& scene, const RenderOptions& options) {
  const auto render = create_render(scene, options);
  const InterruptGuard guard(*render);
  RenderStatistics statistics = render->run();
  if (!statistics.failure.empty()) throw Failure(ExitStatus::internal, statistics.failure);
  if (statistics.cancelled) throw Failure(ExitStatus::interrupted, "interrupted; nothing measured");
  return statistics;
}

ExitStatus bench(const Arguments& arguments) {
  const Scene scene = load_scene(arguments.scene.scene, arguments.scene.load_options());
  const SceneInfo info = scene.info();
  RenderOptions options;
  arguments.machine.apply_to(options);

  // The first run is not counted: it pays for page faults and the processor's change of clock.
  RenderStatistics statistics = render_once(scene, options);
  std::vector<double> seconds, samples_per_second, rays_per_second;
  for (int i = 0; i < arguments.repeat; ++i) {
    statistics = render_once(scene, options);
    const double rays = static_cast<double>(statistics.closest_rays + statistics.shadow_rays);
    seconds.push_back(statistics.seconds);
    samples_per_second.push_back(static_cast<double>(statistics.samples) / statistics.seconds / 1e6);
    rays_per_second.push_back(rays / statistics.seconds / 1e6);
  }
  print_json({{"scene", arguments.scene.scene},
              {"width", info.width},
              {"height", info.height},
              {"samples_per_pixel", info.samples_per_pixel},
              {"integrator", info.integrator},
              {"sampler", info.sampler},
              {"max_depth", info.max_depth},
              {"emitter_samples", info.emitter_samples},
              {"isa", statistics.isa},
              {"lanes", statistics.lanes},
              {"threads", statistics.threads},
              {"accelerator", statistics.accelerator},
              {"repeats", arguments.repeat},
              {"samples", statistics.samples},
              {"closest_rays", statistics.closest_rays},
              {"shadow_rays", statistics.shadow_rays},
              {"seconds", spread(seconds)},
              {"msamples_per_second", spread(samples_per_second)},
              {"mrays_per_second", spread(rays_per_second)}});
  return ExitStatus::done;
}

}  // namespace

Command bench_command() {
  auto arguments = std::make_shared<Arguments>();
  Command command = {.name = "bench", .summary = "Measure how fast a scene renders"};
  arguments->scene.add_to(command);
  command.options.push_back({"--repeat", &arguments->repeat, "N",
                             "Measured runs, after one that is not counted; default 5", whole_number(1, 1000)});
  arguments->machine.add_to(command);
  command.footer =
      "Prints one line of JSON: median, least and greatest seconds, million camera samples and million rays a\n"
      "second over the runs, and the number of rays of each type of one run. Nothing is written.\n\n"
      "Examples:\n"
      "  norrsken bench hexagon_room -Dshadow_rays=1 --sampler independent --spp 64\n"
      "  norrsken bench hexagon_room --isa avx2 --threads 1 --repeat 9";
  command.run = [arguments] { return bench(*arguments); };
  return command;
}

}  // namespace norrsken::cli
