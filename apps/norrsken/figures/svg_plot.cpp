#include "figures/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace norrsken::cli {
namespace {

constexpr double kWidth = 640, kHeight = 440, kLeft = 72, kRight = 26, kTop = 14, kBottom = 58;

bool is_drawable(const PlotPoint& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && point.x > 0 && point.y > 0;
}

/// One axis: value range and the pixels it maps to.
struct Axis {
  double log_min = std::numeric_limits<double>::infinity(), log_max = -log_min;
  double pixel_min = 0, pixel_max = 0;

  void include(double value) {
    log_min = std::min(log_min, std::log10(value));
    log_max = std::max(log_max, std::log10(value));
  }
  /// Leaves room around the data for markers and labels; at least half a decade in all.
  void pad() {
    if (log_min > log_max) log_min = log_max = 0;
    const double room = std::max(0.14 * (log_max - log_min), 0.25 - 0.5 * (log_max - log_min));
    log_min -= room;
    log_max += room;
  }
  double pixel(double value) const {
    return pixel_min + (std::log10(value) - log_min) / (log_max - log_min) * (pixel_max - pixel_min);
  }
  std::vector<double> ticks() const { return log_ticks(std::pow(10, log_min), std::pow(10, log_max)); }
  /// Only powers of ten are numbered where there are many.
  bool is_numbered(double tick) const {
    const double log = std::log10(tick);
    return log_max - log_min < 2.2 || std::abs(log - std::round(log)) < 1e-9;
  }
};

std::string tick_text(double value) {
  return value < 1e6 && value >= 1e-4 ? fmt::format("{:.12g}", value) : fmt::format("{:.0e}", value);
}

void draw_axes(std::string& svg, const Plot& plot, const Axis& x, const Axis& y) {
  for (const double tick : x.ticks()) {
    const double at = x.pixel(tick);
    svg += fmt::format("<line class=\"grid\" x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\"/>\n", at,
                       y.pixel_min, y.pixel_max);
    if (x.is_numbered(tick))
      svg += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", at,
                         y.pixel_min + 18, tick_text(tick));
  }
  for (const double tick : y.ticks()) {
    const double at = y.pixel(tick);
    svg += fmt::format("<line class=\"grid\" x1=\"{1:.1f}\" y1=\"{0:.1f}\" x2=\"{2:.1f}\" y2=\"{0:.1f}\"/>\n", at,
                       x.pixel_min, x.pixel_max);
    if (y.is_numbered(tick))
      svg += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n",
                         x.pixel_min - 8, at + 4, tick_text(tick));
  }
  svg += fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\"/>\n", x.pixel_min, y.pixel_max,
                     y.pixel_min, x.pixel_max);
  svg += fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                     (x.pixel_min + x.pixel_max) / 2, kHeight - 14, escape_html(plot.x_label));
  svg += fmt::format(
      "<text class=\"label\" transform=\"translate(18 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
      (y.pixel_min + y.pixel_max) / 2, escape_html(plot.y_label));
}

void draw_marker(std::string& svg, const PlotSeries& series, double x, double y) {
  if (series.square_marker)
    svg += fmt::format("<rect class=\"marker {}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"9\" height=\"9\"/>\n",
                       escape_html(series.css_class), x - 4.5, y - 4.5);
  else
    svg += fmt::format("<circle class=\"marker {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\"/>\n",
                       escape_html(series.css_class), x, y);
}

void draw_series(std::string& svg, const PlotSeries& series, const Axis& x, const Axis& y) {
  std::string path;
  for (const PlotPoint& point : series.points)
    if (is_drawable(point))
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x.pixel(point.x), y.pixel(point.y));
  if (path.empty()) return;
  svg += fmt::format("<path class=\"line {}\" d=\"{}\"/>\n", escape_html(series.css_class), path);
  for (const PlotPoint& point : series.points) {
    if (!is_drawable(point)) continue;
    const double px = x.pixel(point.x), py = y.pixel(point.y);
    draw_marker(svg, series, px, py);
    if (point.label.empty()) continue;
    svg += fmt::format("<text class=\"point\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n",
                       series.label_above ? px + 8 : px - 8, series.label_above ? py - 7 : py + 16,
                       series.label_above ? "start" : "end", escape_html(point.label));
  }
}

/// In the upper right corner: errors fall with samples and time, so it is empty.
void draw_legend(std::string& svg, const Plot& plot, const Axis& x, const Axis& y) {
  double at = y.pixel_max + 18;
  for (const PlotSeries& series : plot.series) {
    const double right = x.pixel_max - 10;
    svg += fmt::format("<text class=\"legend\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", right - 22,
                       at + 4, escape_html(series.name));
    svg += fmt::format("<path class=\"line {}\" d=\"M{:.1f} {:.1f}h24\"/>\n", escape_html(series.css_class), right - 14,
                       at);
    draw_marker(svg, series, right - 2, at);
    at += 22;
  }
}

}  // namespace

std::string escape_html(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::vector<double> log_ticks(double min, double max) {
  std::vector<double> ticks;
  // One part in 10^9 of slack, so that a bound which is a tick itself counts whatever its rounding.
  const int last = static_cast<int>(std::floor(std::log10(max) + 1e-9));
  for (int decade = static_cast<int>(std::floor(std::log10(min))); decade <= last; ++decade)
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double tick = digit * std::pow(10.0, decade);
      if (tick >= min * (1 - 1e-9) && tick <= max * (1 + 1e-9)) ticks.push_back(tick);
    }
  return ticks;
}

std::string svg_log_log_plot(const Plot& plot) {
  Axis x{.pixel_min = kLeft, .pixel_max = kWidth - kRight}, y{.pixel_min = kHeight - kBottom, .pixel_max = kTop};
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& point : series.points) {
      if (!is_drawable(point)) continue;
      x.include(point.x);
      y.include(point.y);
    }
  x.pad();
  y.pad();
  std::string svg = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n<title>{}</title>\n",
                                kWidth, kHeight, escape_html(plot.title), escape_html(plot.title));
  draw_axes(svg, plot, x, y);
  for (const PlotSeries& series : plot.series) draw_series(svg, series, x, y);
  draw_legend(svg, plot, x, y);
  return svg + "</svg>\n";
}

}  // namespace norrsken::cli
