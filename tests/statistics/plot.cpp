#include "tests/statistics/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "tests/statistics/case_name.h"

namespace norrsken::statistics {

namespace {

constexpr double kSide = 360, kGap = 50, kLine = 18;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

int channel(double x) { return static_cast<int>(std::lround(255 * std::clamp(x, 0.0, 1.0))); }

/// From black over red and yellow to white.
std::string heat(double x) {
  return fmt::format("#{:02x}{:02x}{:02x}", channel(3 * x), channel(3 * x - 1), channel(3 * x - 2));
}

/// Blue: too few; red: too many; full at `kFull` standard deviations.
constexpr double kFull = 5;
std::string difference(double deviations) {
  // No number: none expected and none found.
  const double x = std::isnan(deviations) ? 0 : std::clamp(deviations / kFull, -1.0, 1.0);
  return fmt::format("#{:02x}{:02x}{:02x}", channel(1 + std::min(0.0, x)), channel(1 - std::abs(x)),
                     channel(1 - std::max(0.0, x)));
}

Rectangle bounds_of(std::span<const Cell> cells) {
  Rectangle all = cells[0].bounds;
  for (const Cell& c : cells) {
    for (std::size_t k = 0; k < 2; ++k) {
      all.low[k] = std::min(all.low[k], c.bounds.low[k]);
      all.high[k] = std::max(all.high[k], c.bounds.high[k]);
    }
  }
  return all;
}

template <class Colour>
void add_map(std::string& svg, std::span<const Cell> cells, const Rectangle& all, double x, double y,
             const std::string& title, const Colour& colour) {
  const auto out = std::back_inserter(svg);
  fmt::format_to(out, "<text x=\"{}\" y=\"{}\">{}</text>\n<g>\n", x, y - 6, title);
  const auto at = [&](std::size_t k, double v) { return kSide * (v - all.low[k]) / (all.high[k] - all.low[k]); };
  for (const Cell& c : cells) {
    fmt::format_to(out, "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                   x + at(0, c.bounds.low[0]), y + kSide - at(1, c.bounds.high[1]),
                   at(0, c.bounds.high[0]) - at(0, c.bounds.low[0]), at(1, c.bounds.high[1]) - at(1, c.bounds.low[1]),
                   colour(c));
  }
  fmt::format_to(out, "</g>\n");
}

}  // namespace

std::string heat_maps_svg(std::span<const Cell> cells, const std::array<std::string, 2>& axes,
                          const std::vector<std::string>& caption) {
  const double top = kLine * (static_cast<double>(caption.size()) + 2), height = top + kSide + 4 * kLine;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" font-size=\"13\" shape-rendering=\"crispEdges\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ddd\"/>\n",
      3 * kSide + 4 * kGap, height);
  const auto out = std::back_inserter(svg);
  double y = kLine;
  for (const std::string& line : caption) {
    fmt::format_to(out, "<text x=\"{}\" y=\"{}\">{}</text>\n", kGap, y, escaped(line));
    y += kLine;
  }
  if (cells.empty()) return svg + "</svg>\n";

  // Densities differ by orders of magnitude: four of them are shown.
  constexpr double kDecades = 4;
  double most = 0;
  for (const Cell& c : cells) most = std::max({most, c.expected / c.bounds.area(), c.observed / c.bounds.area()});
  const auto shade = [&](double count, const Cell& c) {
    return count > 0 ? heat(1 + std::log10(count / c.bounds.area() / most) / kDecades) : heat(0);
  };
  const Rectangle all = bounds_of(cells);
  const double step = kSide + kGap;
  add_map(svg, cells, all, kGap, top, "expected", [&](const Cell& c) { return shade(c.expected, c); });
  add_map(svg, cells, all, kGap + step, top, "observed", [&](const Cell& c) { return shade(c.observed, c); });
  add_map(svg, cells, all, kGap + 2 * step, top, "(observed - expected) / sqrt(expected), blue -5 to red +5",
          [&](const Cell& c) { return difference((c.observed - c.expected) / std::sqrt(c.expected)); });
  fmt::format_to(out, "<text x=\"{}\" y=\"{}\">to the right: {}, {:g} to {:g}; upwards: {}, {:g} to {:g}</text>\n",
                 kGap, top + kSide + kLine, escaped(axes[0]), all.low[0], all.high[0], escaped(axes[1]), all.low[1],
                 all.high[1]);
  fmt::format_to(out,
                 "<text x=\"{}\" y=\"{}\">densities: logarithmic, black 10^-{} to white {:.4g} samples per unit of "
                 "area</text>\n</svg>\n",
                 kGap, top + kSide + 2 * kLine, kDecades, most);
  return svg;
}

std::string save_plot(const std::string& name, const std::string& svg) {
  static std::atomic<int> written{0};
  const char* chosen = std::getenv("NORRSKEN_TEST_PLOTS");
  const std::filesystem::path folder = chosen && *chosen ? chosen : NORRSKEN_PLOT_FOLDER;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::filesystem::path path = folder / fmt::format("{}-{}.svg", plain_name(name), ++written);
  std::ofstream file(path, std::ios::binary);
  file << svg;
  file.close();
  return file ? path.string() : fmt::format("(could not be written to {})", path.string());
}

}  // namespace norrsken::statistics
