#include "figures/figures_page.h"

#include <fmt/format.h>

#include <cmath>

#include "figures/svg_plot.h"
#include "text_format.h"

namespace norrsken::cli {
namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --page: #fbfaf8; --card: #ffffff; --text: #1d1f22; --soft: #5c6168; --rule: #dcdad5;
  --literal: #b4461b; --one-ray: #1768ac; }
@media (prefers-color-scheme: dark) {
  :root { --page: #15171a; --card: #1e2125; --text: #e8e6e3; --soft: #a3a8b0; --rule: #3a3f46;
    --literal: #ff9a66; --one-ray: #6cb8ff; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2.5rem 1.5rem 4rem; max-width: 82rem; background: var(--page); color: var(--text);
  font: 16px/1.55 system-ui, "Segoe UI", "Liberation Sans", "DejaVu Sans", sans-serif; }
h1 { font-size: 2rem; line-height: 1.2; margin: 0 0 .6rem; }
h2 { font-size: 1.35rem; margin: 3rem 0 1rem; }
p { max-width: 48rem; margin: .5rem 0; }
a { color: var(--one-ray); }
code { font: .9em/1.4 ui-monospace, "Liberation Mono", "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
.soft { color: var(--soft); }
.grid-of-figures { display: grid; gap: 1.25rem; grid-template-columns: repeat(auto-fill, minmax(19rem, 1fr)); }
.pair { display: grid; gap: 1.25rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); }
figure { margin: 0; background: var(--card); border: 1px solid var(--rule); border-radius: 8px; overflow: hidden; }
figure img { display: block; width: 100%; height: auto; background: #000; }
figure.small-image img { image-rendering: pixelated; }
figcaption { padding: .8rem 1rem 1rem; }
figcaption strong { margin-right: .35rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .1rem .9rem; margin: .6rem 0 0; font-size: .9rem; }
dt { color: var(--soft); }
dd { margin: 0; font-variant-numeric: tabular-nums; }
.result { font-size: 1.15rem; max-width: 56rem; margin-bottom: 1.25rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .35rem .7rem; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--rule); }
th { color: var(--soft); font-weight: 600; vertical-align: bottom; }
th:first-child, td:first-child { text-align: left; }
.plot { padding: 1rem; }
svg { display: block; width: 100%; height: auto; }
svg text { fill: var(--text); font-size: 13px; }
svg .tick { fill: var(--soft); font-size: 12px; }
svg .point, svg .legend { paint-order: stroke; stroke: var(--card); stroke-width: 4px; stroke-linejoin: round; }
svg .point { font-size: 12px; }
svg .grid { stroke: var(--rule); stroke-width: 1; }
svg .axis { fill: none; stroke: var(--soft); stroke-width: 1.2; }
svg .line { fill: none; stroke-width: 2.2; }
svg .line.literal { stroke: var(--literal); }
svg .line.one-ray { stroke: var(--one-ray); }
svg .marker { stroke: var(--card); stroke-width: 1.5; }
svg .marker.literal { fill: var(--literal); }
svg .marker.one-ray { fill: var(--one-ray); }
)";

std::string count_of_rays(const FigureResult& result) { return format_count(static_cast<double>(result.rays())); }

std::string msamples_per_second(const FigureResult& result) { return format_digits(result.samples_per_second() / 1e6); }

std::string row(std::string_view name, const std::string& value) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape_html(name), escape_html(value));
}

/// The image with caption, settings, cost and, unless it is a reference, error.
std::string figure_card(const FigureResult& result, int width) {
  const std::string file = escape_html(result.stem);
  std::string html = fmt::format(
      "<figure{}>\n<a href=\"{}.png\"><img src=\"{}.png\" width=\"{}\" height=\"{}\" alt=\"{}: {}\"></a>\n<figcaption>"
      "<strong>{}</strong> {}\n<dl>\n",
      width < 400 ? " class=\"small-image\"" : "", file, file, width, width, escape_html(result.name),
      escape_html(result.caption), escape_html(result.name), escape_html(result.caption));
  html += row("Settings", fmt::format("{} light, {}, {}, {}, {}", result.light, result.integrator,
                                      format_plural(result.spp, "sample"),
                                      format_plural(result.shadow_rays, "shadow ray"), result.sampler));
  html += row("Time", format_duration(result.statistics.seconds));
  html += row("Rays", count_of_rays(result));
  html += row("Speed", msamples_per_second(result) + " Msamples/s");
  if (result.reference.empty()) {
    html += row("Own error", format_percent(result.relative_error()) + " (estimated)");
  } else {
    html += row("Error", fmt::format("{} (relMSE {:.3g}), FLIP {:.3f}", format_percent(result.relative_error()),
                                     result.comparison.rel_mse, result.comparison.flip));
  }
  html += fmt::format("</dl>\n<p class=\"soft\"><a href=\"{0}.exr\">{0}.exr</a></p></figcaption>\n</figure>\n", file);
  return html;
}

std::string table_row(const FigureResult& result) {
  return fmt::format(
      "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
      "<td>{:.3g}</td><td>{}</td><td>{:.3f}</td></tr>\n",
      escape_html(result.name), escape_html(result.light), escape_html(result.integrator), result.spp,
      result.shadow_rays, format_duration(result.statistics.seconds), count_of_rays(result),
      msamples_per_second(result), format_percent(result.relative_error()), result.comparison.rel_mse,
      format_percent(result.relative_rmse()), result.comparison.flip);
}

/// The figures that vary nothing but the counts, with as many shadow rays as samples; 7 and 10 are the same, and the
/// later ones are the report's series.
std::vector<FigureResult> literal_series(const FiguresReport& report) {
  std::vector<FigureResult> series;
  for (const FigureResult& figure : report.figures) {
    if (figure.light != "area" || figure.integrator != "path" || figure.spp != figure.shadow_rays) continue;
    if (!series.empty() && series.back().spp >= figure.spp) series.pop_back();
    series.push_back(figure);
  }
  return series;
}

std::string plot(const FiguresReport& report, bool against_time) {
  const auto point = [&](const FigureResult& result, std::string label) {
    return PlotPoint{.x = against_time ? result.statistics.seconds : result.spp,
                     .y = 100 * result.relative_error(),
                     .label = std::move(label)};
  };
  PlotSeries literal{.name = "as many shadow rays as samples (the report)", .css_class = "literal", .points = {}};
  PlotSeries one_ray{.name = "one shadow ray per hit", .css_class = "one-ray", .square_marker = true, .points = {}};
  // The report's series needs fewer samples and more time: labels go to the side where the other one is not.
  literal.label_above = against_time;
  one_ray.label_above = !against_time;
  for (const FigureResult& result : literal_series(report)) literal.points.push_back(point(result, result.name));
  for (const FigureResult& result : report.one_ray)
    one_ray.points.push_back(point(result, fmt::format("{} spp", result.spp)));
  return svg_log_log_plot({.title = against_time ? "Error against time" : "Error against samples per pixel",
                           .x_label = against_time ? "rendering time, seconds" : "samples per pixel",
                           .y_label = "error, percent",
                           .series = {literal, one_ray}});
}

/// Whose settings the figures have.
std::string settings_text(const FiguresReport& report) {
  std::vector<std::string> others;
  if (report.width != kReportSide || report.height != kReportSide)
    others.push_back(fmt::format("the size, which is {0} × {0} there", kReportSide));
  if (report.figures.front().sampler != kReportSampler)
    others.push_back(fmt::format("the sampling, which is {} there", kReportSampler));
  if (others.empty()) return "the report's own settings";
  return fmt::format("the report's settings but for {}", fmt::join(others, " and "));
}

std::string equal_error_section(const FiguresReport& report) {
  if (!report.equal) return "";
  const FigureResult &last = report.figures.back(), &equal = report.one_ray[*report.equal];
  std::string html = fmt::format(
      "<h2>{0} and the same error with one shadow ray per hit</h2>\n"
      "<p class=\"result\">{0} takes {1} for {2} with {3} per hit, and its error is {4}. With one shadow ray "
      "per "
      "hit, {5} per pixel come to {6} in <strong>{7}</strong>: {8} samples, <strong>{9:.3g} times as "
      "fast</strong>. More shadow rays smooth the direct light only: the noise of indirect light and of "
      "what the sphere reflects needs more samples.</p>\n",
      escape_html(last.name), format_duration(last.statistics.seconds), format_plural(last.spp, "sample"),
      format_plural(last.shadow_rays, "shadow ray"), format_percent(last.relative_error()),
      format_plural(equal.spp, "sample"), format_percent(equal.relative_error()),
      format_duration(equal.statistics.seconds),
      equal.spp == last.spp ? "as many"
                            : fmt::format("{:.3g} times as many", static_cast<double>(equal.spp) / last.spp),
      last.statistics.seconds / equal.statistics.seconds);
  html += "<div class=\"pair\">\n" + figure_card(last, report.width) + figure_card(equal, report.width) + "</div>\n";
  return html;
}

}  // namespace

double FigureResult::samples_per_second() const {
  return statistics.seconds > 0 ? static_cast<double>(statistics.samples) / statistics.seconds : 0;
}

double FigureResult::relative_error() const { return std::sqrt(comparison.rel_mse); }

double FigureResult::relative_rmse() const {
  return comparison.mean_b > 0 ? std::sqrt(comparison.mse) / comparison.mean_b : 0;
}

std::string figures_page(const FiguresReport& report) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>The hexagon room: figures 5 to 13</title>\n<style>";
  html += kStyle;
  html += "</style>\n</head>\n<body>\n<h1>The hexagon room: figures 5 to 13</h1>\n";
  const RenderStatistics& machine = report.figures.front().statistics;
  html += fmt::format(
      "<p>The figures of the report <em>A Monte Carlo ray tracer</em> (TNCG15, Linköping University) at {}: {} × {} "
      "pixels, 3 bounces, {} sampling, as many shadow rays at every hit as samples per pixel unless said otherwise. "
      "The "
      "report's renderer took from a minute for figure 9 to 7 hours for figure 13.</p>\n",
      settings_text(report), report.width, report.height, escape_html(report.figures.front().sampler));
  html += fmt::format("<p class=\"soft\">Measured on {}{}, {} instructions with {}, {} intersector.</p>\n",
                      report.machine.empty() ? "" : escape_html(report.machine) + ", ",
                      format_plural(machine.threads, "thread"), escape_html(machine.isa),
                      format_plural(machine.lanes, "lane"), escape_html(machine.accelerator));
  html += "<h2>The figures</h2>\n<div class=\"grid-of-figures\">\n";
  for (const FigureResult& figure : report.figures) html += figure_card(figure, report.width);
  html += "</div>\n";
  html += equal_error_section(report);
  html += "<h2>Error against samples and against time</h2>\n<div class=\"pair\">\n";
  for (const bool against_time : {false, true})
    html += "<figure class=\"plot\">\n" + plot(report, against_time) + "</figure>\n";
  html +=
      "</div>\n<h2>All measurements</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th></th><th>light</th>"
      "<th>integrator</th><th>samples</th><th>shadow rays</th><th>time</th><th>rays</th><th>Msamples/s</th>"
      "<th>error</th><th>relMSE</th><th>relative RMSE</th><th>FLIP</th></tr></thead>\n<tbody>\n";
  for (const FigureResult& figure : report.figures) html += table_row(figure);
  for (const FigureResult& result : report.one_ray) html += table_row(result);
  html +=
      "</tbody></table></div>\n"
      "<p class=\"soft\">The error is the root of relMSE, and relMSE the mean of (a − b)² / (b² + 0.01) over pixels "
      "and channels of linear radiance, b being the reference. Relative RMSE is the root mean square of a − b over "
      "the mean of b; a few very bright pixels, the edge of a light, weigh most in it. FLIP is the mean LDR-FLIP of "
      "the "
      "tone-mapped images. Rays are all rays traced, to closest hits and to lights. Rows of the same settings differ "
      "by "
      "chance: each has a seed of its own.</p>\n"
      "<h2>References</h2>\n<p>What the figures were compared with. The error that is left in a reference is its "
      "own estimate.</p>\n<div class=\"grid-of-figures\">\n";
  for (const FigureResult& reference : report.references) html += figure_card(reference, report.width);
  html += fmt::format("</div>\n<h2>To do it again</h2>\n<p><code>{}</code></p>\n</body>\n</html>\n",
                      escape_html(report.command));
  return html;
}

}  // namespace norrsken::cli
