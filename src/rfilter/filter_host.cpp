#include "rfilter/filter_host.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace norrsken {
namespace {

struct FilterNode {
  double x, f;
};

/// The piecewise linear filter, with a node where it changes its sign.
std::vector<FilterNode> make_nodes(const FilterFunction& filter) {
  const int intervals = std::max(1, static_cast<int>(std::ceil(filter.radius / filter.step - 1e-9)));
  const double rounding = 1e-9 * std::abs(filter.value(0));
  const auto value = [&](double x) {
    const double f = x < filter.radius ? filter.value(x) : 0;
    return std::abs(f) < rounding ? 0 : f;
  };
  std::vector<FilterNode> nodes;
  for (int i = 0; i <= intervals; ++i) {
    const double x = i == intervals ? filter.radius : filter.radius * i / intervals, f = value(x);
    if (!nodes.empty() && f * nodes.back().f < 0) {
      const FilterNode& last = nodes.back();
      nodes.push_back({last.x + (x - last.x) * last.f / (last.f - f), 0});
    }
    nodes.push_back({x, f});
  }
  return nodes;
}

/// Integrals from 0 to some distance.
struct Integrals {
  double absolute = 0, with_sign = 0;
};

Integrals integrate(const std::vector<FilterNode>& nodes, double end) {
  Integrals sum;
  for (std::size_t i = 0; i + 1 < nodes.size() && nodes[i].x < end; ++i) {
    const FilterNode &a = nodes[i], &b = nodes[i + 1];
    const double x = std::min(end, b.x), share = (x - a.x) / (b.x - a.x);
    const double area = (x - a.x) * (a.f + (a.f + (b.f - a.f) * share)) / 2;
    sum.absolute += std::abs(area);
    sum.with_sign += area;
  }
  return sum;
}

}  // namespace

FilterRecord tabulate_filter(const FilterFunction& filter, Array<float>& table) {
  const std::vector<FilterNode> nodes = make_nodes(filter);
  const double total = integrate(nodes, filter.radius).absolute;
  std::vector<double> cdf(nodes.size());
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    cdf[i] = cdf[i - 1] + (nodes[i].x - nodes[i - 1].x) * std::abs(nodes[i - 1].f + nodes[i].f) / 2 / total;
  }
  cdf.back() = 1;

  FilterRecord record;
  record.kind = FilterKind::tabulated;
  record.nodes = static_cast<std::uint32_t>(nodes.size());
  record.cells = record.nodes;
  record.edges = static_cast<std::uint32_t>(std::max(0.0, std::ceil(filter.radius - 0.5)));
  record.signs = std::ranges::any_of(nodes, [](const FilterNode& n) { return n.f < 0; });

  table.clear();
  for (const FilterNode& n : nodes) table.push_back(static_cast<float>(n.x));
  for (const FilterNode& n : nodes) table.push_back(static_cast<float>(n.f / total));
  for (const double c : cdf) table.push_back(static_cast<float>(c));
  // As the kernel sees it, in floats, so that no number falls between two cells.
  const std::vector<float> steps(table.begin() + std::ptrdiff_t{2} * record.nodes, table.end() - 1);
  for (std::uint32_t i = 0; i <= record.cells; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(record.cells);
    const auto above = std::ranges::upper_bound(steps, t);
    const std::ptrdiff_t interval = std::clamp<std::ptrdiff_t>(above - steps.begin() - 1, 0, record.nodes - 2);
    table.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(interval)));
  }
  for (const bool with_sign : {false, true}) {
    for (std::uint32_t i = 0; i <= record.edges; ++i) {
      const Integrals to_edge = integrate(nodes, i == record.edges ? filter.radius : i + 0.5);
      table.push_back(static_cast<float>((with_sign ? to_edge.with_sign : to_edge.absolute) / total));
    }
  }
  return record;
}

}  // namespace norrsken
