#include "formats/pbrt/lens.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/numbers.h"
#include "base/text.h"

namespace norrsken::pbrt {
namespace {

constexpr double kMillimetre = 1e-3;

/// From front to back: metres.
struct Element {
  double curvature_radius, thickness, index, aperture_radius;
};

/// Empty after a complaint.
std::vector<Element> read_elements(Context& context, const Parameter& filename) {
  const auto refuse = [&](std::string message) {
    context.diagnostics.error(filename.value.location(), std::move(message),
                              "four numbers a line: radius and thickness in mm, index, diameter in mm");
    return std::vector<Element>();
  };
  const std::string path = context.find_file(filename);
  if (path.empty()) return {};
  std::string error;
  const auto contents = read_counted(context.files, path, error);
  if (!contents) return refuse(fmt::format("cannot read the lens file {}: {}", quoted(path, 200), error));
  std::vector<double> numbers;
  for (const TextPiece& line : split(contents->bytes, "\r\n")) {
    for (const TextPiece& word : split(line.text.substr(0, line.text.find('#')), " \t")) {
      double value = 0;
      if (parse_number(word.text, value) != NumberStatus::ok)
        return refuse(fmt::format("{} in the lens file {} is not a number", quoted(word.text), quoted(path, 200)));
      numbers.push_back(value);
    }
  }
  if (numbers.empty() || numbers.size() % 4 != 0)
    return refuse(fmt::format("the lens file {} has {} numbers", quoted(path, 200), numbers.size()));
  std::vector<Element> elements;
  for (std::size_t i = 0; i < numbers.size(); i += 4)
    elements.push_back(
        {kMillimetre * numbers[i], kMillimetre * numbers[i + 1], numbers[i + 2], kMillimetre * numbers[i + 3] / 2});
  return elements;
}

/// The focal length, from a paraxial ray (height 1, parallel to the axis) taken through all surfaces from the front.
double focal_length(const std::vector<Element>& elements) {
  double height = 1, slope = 0, index = 1;
  for (const Element& element : elements) {
    const double behind = element.curvature_radius == 0 || element.index == 0 ? index : element.index;
    // n' u' = n u - h (n' - n) / R: refraction at one surface, to first order.
    if (element.curvature_radius != 0)
      slope = (index * slope - height * (behind - index) / element.curvature_radius) / behind;
    index = element.curvature_radius == 0 ? index : behind;
    height += slope * element.thickness;
  }
  return slope != 0 ? -1 / slope : 0;
}

}  // namespace

Optics read_optics(Context& context, Parameters& p, const FilmSize& film) {
  const Parameter* filename = p.find("string", "lensfile");
  double diameter = p.positive("aperturediameter", 1) * kMillimetre;
  const double focus = p.positive("focusdistance", 10);
  p.text("aperture", {});
  if (!filename) p.error(nullptr, "camera 'realistic' has no lens file", R"("string lensfile" "lens.dat")");
  const std::vector<Element> elements =
      filename && p.has_values(*filename, 1) ? read_elements(context, *filename) : std::vector<Element>();
  if (elements.empty()) return {};
  for (const Element& element : elements) {
    if (element.curvature_radius == 0) diameter = std::min(diameter, 2 * element.aperture_radius);
  }
  const double f = focal_length(elements);
  if (!(f > 0)) {
    p.error(filename, "the lens does not gather light", "a lens with a focal length above 0");
    return {};
  }
  context.tell(p.place(), "camera 'realistic' is not supported",
               fmt::format("a thin lens of {:.4g} mm, without its flaws, vignetting and exposure", f / kMillimetre));
  // 1 / f = 1 / focus + 1 / film.
  const double behind = focus > f ? 1 / (1 / f - 1 / focus) : f;
  const double aspect = film.aspect();
  const double width = film.diagonal * aspect / std::sqrt(1 + aspect * aspect);
  return {width / 2 / behind, diameter / 2, focus};
}

}  // namespace norrsken::pbrt
