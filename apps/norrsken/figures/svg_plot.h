// Plots with two logarithmic axes, as SVG to be put into an HTML page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace norrsken::cli {

/// `text` with the five characters that HTML and XML reserve replaced by entities.
std::string escape_html(std::string_view text);

struct PlotPoint {
  double x = 0, y = 0;  ///< above 0 and finite; other points are left out
  std::string label;
};

struct PlotSeries {
  std::string name;
  std::string css_class;       ///< the page gives it its colour: `stroke` of lines, `fill` of markers
  bool square_marker = false;  ///< told apart without colour too
  bool label_above = false;    ///< labels above and to the right of the points, else below and to the left
  std::vector<PlotPoint> points;
};

struct Plot {
  std::string title;  ///< for those who cannot see it
  std::string x_label, y_label;
  std::vector<PlotSeries> series;
};

/// Values of 1, 2 and 5 times a power of ten within [min, max], both above 0.
std::vector<double> log_ticks(double min, double max);

/// One `<svg>` element. Colours are the page's: classes `grid`, `axis`, `tick`, `label` and those of the series.
std::string svg_log_log_plot(const Plot& plot);

}  // namespace norrsken::cli
