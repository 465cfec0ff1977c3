// Film, PixelFilter, Sampler, Integrator: how pbrt renders, in our words.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "formats/pbrt/state.h"

namespace norrsken::pbrt {
namespace {

const std::vector<std::string> kFilms = {"gbuffer", "rgb", "spectral"};
const std::vector<std::string> kFilters = {"box", "gaussian", "mitchell", "sinc", "triangle"};
const std::vector<std::string> kSamplers = {"halton", "independent", "paddedsobol", "pmj02bn",
                                            "sobol",  "stratified",  "zsobol"};
const std::vector<std::string> kIntegrators = {
    "ambientocclusion", "bdpt",       "function",      "lightpath", "mlt",    "path",
    "randomwalk",       "simplepath", "simplevolpath", "sppm",      "volpath"};
const std::vector<std::string> kSensors = {
    "cie1931",       "canon_eos_100d",     "canon_eos_1dx_mkii", "canon_eos_200d",    "canon_eos_200d_mkii",
    "canon_eos_5d",  "canon_eos_5d_mkii",  "canon_eos_5d_mkiii", "canon_eos_5d_mkiv", "canon_eos_5ds",
    "canon_eos_m",   "hasselblad_l1d_20c", "nikon_d810",         "nikon_d850",        "sony_ilce_6400",
    "sony_ilce_7m3", "sony_ilce_7rm3",     "sony_ilce_9"};

/// Of an accelerator nothing shows; it is asked for what pbrt asks for.
void read_accelerator(const std::string& type, Parameters& p) {
  static const std::vector<std::string> kAccelerators = {"bvh", "kdtree"};
  if (type == "bvh") {
    p.choice("splitmethod", "sah", {"sah", "hlbvh", "middle", "equal"});
    p.integer("maxnodeprims", 4);
  } else if (type == "kdtree") {
    for (const char* name : {"intersectcost", "traversalcost", "maxprims", "maxdepth"}) p.integer(name, 1);
    p.number("emptybonus", 0.5);
  } else {
    p.error(nullptr, fmt::format("unknown accelerator {}{}", quoted(type), did_you_mean(type, kAccelerators)),
            join(kAccelerators));
  }
}

void refuse(Parameters& p, std::string_view what, const std::string& type, const std::vector<std::string>& known) {
  p.error(nullptr, fmt::format("unknown {} {}{}", what, quoted(type), did_you_mean(type, known)), join(known));
}

std::optional<std::array<double, 4>> read_rectangle(Parameters& p, std::string_view type, std::string_view name) {
  const Parameter* parameter = p.find(type, name);
  if (!parameter || !p.has_values(*parameter, 4)) return std::nullopt;
  return std::array{parameter->numbers[0], parameter->numbers[1], parameter->numbers[2], parameter->numbers[3]};
}

/// The rectangle of pixels that is rendered: from x0 and y0 up to but without x1 and y1.
void give_crop(Node& node, Parameters& p, const FilmSize& size) {
  const auto bounds = read_rectangle(p, "integer", "pixelbounds"), window = read_rectangle(p, "float", "cropwindow");
  std::array<double, 4> crop = bounds.value_or(std::array{0.0, double(size.width), 0.0, double(size.height)});
  if (window) {
    for (std::size_t i = 0; i < 4; ++i)
      crop[i] = std::ceil(std::clamp((*window)[i], 0.0, 1.0) * (i < 2 ? size.width : size.height));
  }
  const double limits[] = {double(size.width), double(size.height)};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    double &low = crop[2 * axis], &high = crop[2 * axis + 1];
    if (low > high) std::swap(low, high);
    low = std::max(low, 0.0), high = std::min(high, limits[axis]);
    if (!(low < high)) {
      p.error(nullptr, fmt::format("nothing of {} is rendered", p.object()),
              "a cropwindow or pixelbounds that has pixels");
      return;
    }
  }
  if (!bounds && !window) return;
  const auto whole = [](double v) { return static_cast<std::int64_t>(v); };
  give(node, "crop_offset_x", whole(crop[0]), p.place());
  give(node, "crop_offset_y", whole(crop[2]), p.place());
  give(node, "crop_width", whole(crop[1] - crop[0]), p.place());
  give(node, "crop_height", whole(crop[3] - crop[2]), p.place());
}

Node make_film(Context& context, const std::string& type, Parameters& p, FilmSize& size, const ColorSpace& space) {
  if (std::ranges::find(kFilms, type) == kFilms.end()) refuse(p, "film", type, kFilms);
  constexpr std::int64_t kMostPixels = 65536;
  size.width = static_cast<int>(p.integer("xresolution", size.width, 1, kMostPixels));
  size.height = static_cast<int>(p.integer("yresolution", size.height, 1, kMostPixels));
  size.diagonal = p.positive("diagonal", 35) * 1e-3;
  p.text("filename", {});
  p.flag("savefp16", true);
  p.number("iso", 100);
  const std::string sensor = p.text("sensor", "cie1931");
  if (std::ranges::find(kSensors, sensor) == kSensors.end()) refuse(p, "sensor", sensor, kSensors);
  if (sensor != "cie1931")
    context.tell(p.place(), fmt::format("sensor '{}' is not supported", sensor),
                 "the colours of 'cie1931', which are as bright");
  const bool balances = p.number("whitebalance", 0) != 0;
  if (balances && sensor == "cie1931") context.tell(p.place(), "whitebalance is not supported", "colours as they are");
  if (std::isfinite(p.number("maxcomponentvalue", Parameters::kInfinity, 0)))
    context.tell(p.place(), "maxcomponentvalue is not supported", "samples as they are");
  if (type == "gbuffer") {
    p.choice("coordinatesystem", "camera", {"camera", "world"});
    context.tell(p.place(), "film 'gbuffer' is not supported",
                 "the image alone; 'norrsken render --layers' has others");
  } else if (type == "spectral") {
    p.integer("nbuckets", 16);
    p.number("lambdamin", 360);
    p.number("lambdamax", 830);
    context.tell(p.place(), "film 'spectral' is not supported", "the image in linear sRGB");
  }
  if (space.name != srgb_space().name)
    context.tell(p.place(), fmt::format("images in color space '{}' are not written", space.name), "linear sRGB");
  Node node = make_node("film", "hdrfilm", p.place());
  give(node, "width", std::int64_t{size.width}, p.place());
  give(node, "height", std::int64_t{size.height}, p.place());
  give_crop(node, p, size);
  return node;
}

Node make_filter(Context& context, const std::string& type, Parameters& p) {
  const auto radius_of = [&](double fallback) {
    const double x = p.positive("xradius", fallback), y = p.positive("yradius", fallback);
    if (x != y) context.tell(p.place(), "a filter of another width than height", "the mean of both radii");
    return (x + y) / 2;
  };
  const auto expect = [&](double radius, double usual) {
    if (std::abs(radius - usual) > 1e-6)
      context.tell(p.place(), fmt::format("filter '{}' of radius {:g} is not supported", type, radius),
                   fmt::format("radius {:g}", usual));
  };
  if (type == "box") {
    expect(radius_of(0.5), 0.5);
    return make_node("rfilter", "box", p.place());
  }
  if (type == "triangle") {
    Node node = make_node("rfilter", "tent", p.place());
    give(node, "radius", std::min(radius_of(2), 100.0), p.place());
    return node;
  }
  if (type == "mitchell") {
    expect(radius_of(2), 2);
    Node node = make_node("rfilter", "mitchell", p.place());
    for (const char* name : {"B", "C"}) give(node, name, std::clamp(p.number(name, 1. / 3), 0.0, 1.0), p.place());
    return node;
  }
  if (type == "sinc") {
    const double radius = radius_of(4), tau = p.positive("tau", 3);
    const double lobes = std::clamp(std::round(tau), 1.0, 16.0);
    // pbrt's window does not end where the filter does.
    if (radius != lobes || tau != lobes)
      context.tell(p.place(), fmt::format("filter 'sinc' of radius {:g} and tau {:g}", radius, tau),
                   fmt::format("lanczos of {:g} lobes", lobes));
    Node node = make_node("rfilter", "lanczos", p.place());
    give(node, "lobes", static_cast<std::int64_t>(lobes), p.place());
    return node;
  }
  if (type != "gaussian") refuse(p, "filter", type, kFilters);
  const double radius = radius_of(1.5), sigma = p.positive("sigma", 0.5);
  if (radius < 2 * sigma)
    context.tell(p.place(), fmt::format("filter 'gaussian' of radius {:g} and sigma {:g}", radius, sigma),
                 "a Gaussian that ends after four sigma");
  Node node = make_node("rfilter", "gaussian", p.place());
  give(node, "stddev", std::min(sigma, 25.0), p.place());
  return node;
}

Node make_sampler(const std::string& type, Parameters& p, std::int64_t seed) {
  if (std::ranges::find(kSamplers, type) == kSamplers.end()) refuse(p, "sampler", type, kSamplers);
  std::int64_t samples = 0;
  if (type == "stratified") {
    samples = p.integer("xsamples", 4, 1, 1 << 15) * p.integer("ysamples", 4, 1, 1 << 15);
    p.flag("jitter", true);
  } else {
    samples = p.integer("pixelsamples", type == "independent" ? 4 : 16, 1);
    if (type == "halton") {
      p.choice("randomization", "permutedigits", {"none", "permutedigits", "owen"});
    } else if (type == "zsobol" || type == "paddedsobol" || type == "sobol") {
      p.choice("randomization", "fastowen", {"none", "permutedigits", "fastowen", "owen"});
    }
  }
  const bool is_plain = type == "independent" || type == "stratified";
  Node node = make_node("sampler", is_plain ? type : "sobol", p.place());
  give(node, "sample_count", samples, p.place());
  give(node, "seed", std::max<std::int64_t>(p.integer("seed", seed), 0), p.place());
  return node;
}

Node make_integrator(Context& context, const std::string& type, Parameters& p) {
  if (std::ranges::find(kIntegrators, type) == kIntegrators.end()) refuse(p, "integrator", type, kIntegrators);
  Node node = make_node("integrator", type == "lightpath" ? "ptracer" : "path", p.place());
  const bool has_depth = type != "ambientocclusion" && type != "function";
  // Both count the surfaces that a path is scattered by.
  if (has_depth) give(node, "bounces", p.integer("maxdepth", 5, 0), p.place());
  const bool regularizes =
      (type == "path" || type == "volpath" || type == "bdpt" || type == "mlt") && p.flag("regularize", false);
  if (regularizes) context.tell(p.place(), "regularize is not supported", "surfaces as they are");
  if (type == "path" || type == "volpath") p.text("lightsampler", "bvh");
  const auto instead = [&](const char* what) {
    context.tell(p.place(), fmt::format("integrator '{}' is not supported", type), what);
  };
  if (type == "simplepath") {
    p.flag("samplelights", true);
    p.flag("samplebsdf", true);
  } else if (type == "bdpt") {
    if (p.flag("visualizestrategies", false) || p.flag("visualizeweights", false))
      context.tell(p.place(), "the pictures of bdpt's strategies are not supported", "none");
    instead("path");
  } else if (type == "mlt") {
    for (const char* name : {"bootstrapsamples", "chains", "mutationsperpixel"}) p.integer(name, 100);
    for (const char* name : {"largestepprobability", "sigma"}) p.number(name, 0);
    instead("path");
  } else if (type == "sppm") {
    p.integer("photonsperiteration", -1);
    p.number("radius", 1);
    p.integer("seed", 0);
    instead("path");
  } else if (type == "ambientocclusion") {
    p.flag("cossample", true);
    p.number("maxdistance", 0);
    instead("path");
  } else if (type == "function") {
    for (const char* name : {"function", "filename", "imagefilename"}) p.text(name, {});
    p.flag("skipbad", true);
    instead("path");
  }
  return node;
}

}  // namespace

double imaging_ratio_of(Settings& settings) {
  double time = 1, iso = 100;
  if (const auto camera = settings.objects.find("Camera"); camera != settings.objects.end()) {
    Parameters& p = camera->second.parameters;
    const double open = p.number("shutteropen", 0), close = p.number("shutterclose", 1);
    time = close - open;
    if (!(time > 0)) {
      p.error(p.find("float", "shutterclose"), fmt::format("the shutter opens at {:g} and closes at {:g}", open, close),
              "a shutterclose after shutteropen");
      time = 1;
    }
  }
  if (const auto film = settings.objects.find("Film"); film != settings.objects.end())
    iso = film->second.parameters.positive("iso", 100);
  return time * iso / 100;
}

void add_settings(Context& context, Settings& settings, Node& scene) {
  const auto object = [&](const std::string& directive, const char* type) -> Settings::Object& {
    const std::string what = fmt::format("{} '{}'", directive, type);
    return settings.objects
        .try_emplace(directive, Settings::Object{type, Parameters(what, {}, {}, context.diagnostics), {}})
        .first->second;
  };
  Settings::Object &camera = object("Camera", "perspective"), &film = object("Film", "rgb");
  Settings::Object &filter = object("PixelFilter", "gaussian"), &sampler = object("Sampler", "zsobol");
  Settings::Object& integrator = object("Integrator", "volpath");
  FilmSize size;
  Node film_node = make_film(context, film.type, film.parameters, size, *settings.film_space);
  film_node.add(make_filter(context, filter.type, filter.parameters));
  Node sensor = make_camera(context, camera.type, camera.parameters, camera.transforms.start, size);
  sensor.add(std::move(film_node));
  sensor.add(make_sampler(sampler.type, sampler.parameters, settings.seed));
  scene.add(make_integrator(context, integrator.type, integrator.parameters));
  scene.add(std::move(sensor));
  if (const auto accelerator = settings.objects.find("Accelerator"); accelerator != settings.objects.end())
    read_accelerator(accelerator->second.type, accelerator->second.parameters);
  for (auto& [directive, settings_object] : settings.objects) settings_object.parameters.finish();
}

}  // namespace norrsken::pbrt
