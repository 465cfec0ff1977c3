#include "formats/polygon.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace norrsken {
namespace {

glm::dvec3 between(const PolygonCutter::Point& from, const PolygonCutter::Point& to) {
  return {double{to[0]} - double{from[0]}, double{to[1]} - double{from[1]}, double{to[2]} - double{from[2]}};
}

/// Calls `use` with the normal of each triangle of the fan, as long as twice its area, until that says false.
template <class Use>
bool for_each_fan_normal(std::span<const PolygonCutter::Point> points, const Use& use) {
  glm::dvec3 before = between(points[0], points[1]);
  for (std::size_t i = 2; i < points.size(); ++i) {
    const glm::dvec3 side = between(points[0], points[i]);
    if (!use(glm::cross(before, side))) return false;
    before = side;
  }
  return true;
}

}  // namespace

/// The corners in the plane of that normal, seen from its front.
void PolygonCutter::project(std::span<const Point> points, glm::dvec3 normal) {
  normal = glm::normalize(normal);
  // Axes that make coordinates in planes across an axis the very ones of the file.
  const glm::dvec3 size = glm::abs(normal);
  const int dominant = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  glm::dvec3 other(0);
  other[(dominant + 2) % 3] = 1;
  const glm::dvec3 x = glm::normalize(glm::cross(other, normal)), y = glm::cross(normal, x);

  corners_.resize(points.size());
  const auto count = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const glm::dvec3 p = between(points[0], points[i]);
    corners_[i] = {
        {glm::dot(p, x), glm::dot(p, y)}, i == 0 ? count - 1 : i - 1, i + 1 == count ? 0 : i + 1, true, false};
  }
}

/// Twice the area of a triangle, above 0 if it turns to the left.
double PolygonCutter::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const Flat &p = corners_[a].at, &q = corners_[b].at, &r = corners_[c].at;
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

std::uint32_t PolygonCutter::column(double x) const {
  return static_cast<std::uint32_t>(std::clamp((x - lower_.x) * cells_per_unit_.x, 0.0, columns_ - 1.0));
}

std::uint32_t PolygonCutter::row(double y) const {
  return static_cast<std::uint32_t>(std::clamp((y - lower_.y) * cells_per_unit_.y, 0.0, rows_ - 1.0));
}

void PolygonCutter::fill_grid() {
  lower_ = corners_[0].at;
  Flat upper = lower_;
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < corners_.size(); ++i) {
    Corner& corner = corners_[i];
    corner.blocks = !is_convex(i);
    count += corner.blocks ? 1 : 0;
    lower_ = {std::min(lower_.x, corner.at.x), std::min(lower_.y, corner.at.y)};
    upper = {std::max(upper.x, corner.at.x), std::max(upper.y, corner.at.y)};
  }
  // Square cells, one for four corners.
  const double width = std::max(upper.x - lower_.x, 1e-300), height = std::max(upper.y - lower_.y, 1e-300);
  const double cells = std::max(static_cast<double>(count) / 4, 1.0);
  columns_ = static_cast<std::uint32_t>(std::clamp(std::sqrt(cells * (width / height)), 1.0, cells));
  rows_ = static_cast<std::uint32_t>(std::clamp(cells / columns_, 1.0, cells));
  cells_per_unit_ = {columns_ / width, rows_ / height};

  const auto cell_of = [&](const Corner& corner) { return row(corner.at.y) * columns_ + column(corner.at.x); };
  first_.assign(std::size_t{columns_} * rows_ + 1, 0);
  for (const Corner& corner : corners_) {
    if (corner.blocks) ++first_[cell_of(corner) + 1];
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  end_.assign(first_.begin(), first_.end() - 1);
  blockers_.resize(count);
  for (std::uint32_t i = 0; i < corners_.size(); ++i) {
    if (corners_[i].blocks) blockers_[end_[cell_of(corners_[i])]++] = i;
  }
}

/// The first and the last column that a triangle reaches in a row of the grid.
std::array<std::uint32_t, 2> PolygonCutter::columns_of(const std::array<Flat, 3>& triangle, std::uint32_t row) const {
  // A little more than the row, for the rounding of what is computed here.
  constexpr double kMore = 1e-6;
  const double bottom = lower_.y + (row - kMore) / cells_per_unit_.y,
               top = lower_.y + (row + 1 + kMore) / cells_per_unit_.y;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t k = 0; k < 3; ++k) {
    const Flat &a = triangle[k], &b = triangle[(k + 1) % 3], &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
    if (low.y > top || high.y < bottom) continue;
    const double slope = high.y > low.y ? (high.x - low.x) / (high.y - low.y) : 0;
    const double from = low.y < bottom ? low.x + slope * (bottom - low.y) : low.x;
    const double to = high.y > top ? high.x - slope * (high.y - top) : high.x;
    least = std::min({least, from, to}), most = std::max({most, from, to});
  }
  const double more = kMore / cells_per_unit_.x;
  return {column(least - more), column(most + more)};
}

/// Whether another corner lies in the triangle, or `by_touch` on its edges.
bool PolygonCutter::is_blocked(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool by_touch) {
  const Flat &p = corners_[a].at, &q = corners_[b].at, &r = corners_[c].at;
  const auto is_inside = [&](std::uint32_t v) {
    if (corners_[v].at == p || corners_[v].at == q || corners_[v].at == r) return false;
    const double least = std::min({turn(a, b, v), turn(b, c, v), turn(c, a, v)});
    return by_touch ? least >= 0 : least > 0;
  };
  const std::uint32_t top = row(std::max({p.y, q.y, r.y}));
  for (std::uint32_t y = row(std::min({p.y, q.y, r.y})); y <= top; ++y) {
    const auto [left, right] = columns_of({p, q, r}, y);
    for (std::uint32_t cell = y * columns_ + left; cell <= y * columns_ + right; ++cell) {
      --work_left_;
      for (std::uint32_t i = first_[cell]; i < end_[cell];) {
        --work_left_;
        const std::uint32_t v = blockers_[i];
        if (!corners_[v].is_left || !corners_[v].blocks) {
          blockers_[i] = blockers_[--end_[cell]];
        } else if (is_inside(v)) {
          return true;
        } else {
          ++i;
        }
      }
    }
  }
  return false;
}

/// Whether corner `i` may be cut off. Never looks at more than one triangle's surroundings.
bool PolygonCutter::may_cut(std::uint32_t i, Standard standard) {
  constexpr double kThin = 1e-5;  ///< the sine of a corner's turn, below which others come first
  const std::uint32_t a = corners_[i].previous, c = corners_[i].next;
  const Flat &p = corners_[a].at, &q = corners_[i].at, &r = corners_[c].at;
  const double dx = q.x - p.x, dy = q.y - p.y, ex = r.x - q.x, ey = r.y - q.y;
  const double area = turn(a, i, c), along = dx * ex + dy * ey;
  --work_left_;
  // Two corners at one place, and a way there and back, hold nothing.
  if (area == 0 && !(along > 0)) return true;
  switch (standard) {
    case kEar:
      return area > kThin * std::sqrt((dx * dx + dy * dy) * (ex * ex + ey * ey)) && !is_blocked(a, i, c, true);
    case kThinEar:
      return area > 0 && !is_blocked(a, i, c, true);
    case kTouchedEar:
      return area > 0 && !is_blocked(a, i, c, false);
    case kNothing:
      return area == 0;
    case kConvex:
      return area > 0;
    case kAny:
      return true;
  }
  return true;
}

/// Cuts off one corner after the other. False if that takes too long.
bool PolygonCutter::clip() {
  Standard standard = kEar;
  auto left = static_cast<std::uint32_t>(corners_.size());
  std::uint32_t at = 0, in_vain = 0;
  bool has_cut = false;  // by this standard
  while (left > 3) {
    if (work_left_ < 0) return false;
    const Corner& corner = corners_[at];
    if (!may_cut(at, standard)) {
      at = corner.next;
      if (++in_vain < left) continue;
      standard = has_cut && standard != kEar ? kEar : static_cast<Standard>(standard + 1);
      in_vain = 0;
      has_cut = false;
      continue;
    }
    triangles_.push_back({corner.previous, at, corner.next});
    corners_[at].is_left = false;
    corners_[corner.previous].next = corner.next;
    corners_[corner.next].previous = corner.previous;
    --left;
    for (const std::uint32_t neighbour : {corner.previous, corner.next}) {
      if (is_convex(neighbour)) corners_[neighbour].blocks = false;
    }
    in_vain = 0;
    has_cut = standard <= kThinEar;
    if (!has_cut) standard = kEar;
    // Not its neighbour: ears side by side make slivers.
    at = corners_[corner.next].next;
  }
  triangles_.push_back({corners_[at].previous, at, corners_[at].next});
  return true;
}

std::span<const PolygonCutter::Triangle> PolygonCutter::cut(std::span<const Point> corners) {
  constexpr std::int64_t kWorkOfACorner = 64;
  if (corners.size() <= 3) return {};
  glm::dvec3 normal(0);
  for_each_fan_normal(corners, [&](const glm::dvec3& n) {
    normal += n;
    return true;
  });
  const double size = glm::dot(normal, normal);
  const bool has_plane = size > 0 && std::isfinite(size);
  if (!has_plane || for_each_fan_normal(corners, [&](const glm::dvec3& n) { return glm::dot(n, normal) > 0; }))
    return {};
  project(corners, normal);
  fill_grid();
  work_left_ = std::max<std::int64_t>(work_left_, 0) + kWorkOfACorner * static_cast<std::int64_t>(corners.size());
  triangles_.clear();
  triangles_.reserve(corners.size() - 2);
  if (clip()) return triangles_;
  too_intricate = true;
  return {};
}

}  // namespace norrsken
