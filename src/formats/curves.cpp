// The format as Mitsuba's manual of the `linearcurve` and `bsplinecurve` plugins describes it.
#include "formats/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "base/numbers.h"
#include "base/text.h"
#include "formats/mesh_complaints.h"
#include "scene/description.h"

namespace norrsken {
namespace {

/// Four times an index must fit the 32-bit lanes that gather, and more than curves is stored there.
constexpr std::size_t kMaxPoints = std::size_t{1} << 28;

/// The least value on [0, 1] of the uniform cubic B-spline with these control values.
double least_of_bspline(const double (&r)[4]) {
  const double a0 = (r[0] + 4 * r[1] + r[2]) / 6, a1 = (r[2] - r[0]) / 2, a2 = (r[0] - 2 * r[1] + r[2]) / 2,
               a3 = (r[3] - r[0] + 3 * (r[1] - r[2])) / 6;
  double least = std::min(a0, a0 + a1 + a2 + a3);
  // Where a1 + 2 a2 t + 3 a3 t^2 is 0, by the form of the formula that stays exact as a3 goes to 0.
  const double discriminant = a2 * a2 - 3 * a1 * a3;
  if (discriminant < 0) return least;
  const double q = -(a2 + std::copysign(std::sqrt(discriminant), a2));
  for (const double t : {q / (3 * a3), a1 / q}) {
    if (t > 0 && t < 1) least = std::min(least, a0 + t * (a1 + t * (a2 + t * a3)));
  }
  return least;
}

class CurveReader {
 public:
  CurveReader(std::string_view bytes, CurveBasis basis, const std::string& path, Diagnostics& diagnostics)
      : rest_(bytes),
        per_segment_(static_cast<std::uint32_t>(basis)),
        complaints_(path, bytes, diagnostics),
        source_(path, bytes),
        diagnostics_(diagnostics) {}

  std::optional<CurveData> read() {
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
    while (!rest_.empty() && !complaints_.gave_up()) {
      // Lines end with LF, CRLF, or CR alone.
      const std::string_view line = rest_.substr(0, rest_.find_first_of("\r\n"));
      rest_.remove_prefix(line.size());
      rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, rest_.size()));
      control_point(line);
      if (curves_.points.size() > kMaxPoints) {
        complaints_.about_file("the file has too many control points", fmt::format("up to {}", kMaxPoints));
        return std::nullopt;
      }
    }
    end_curve();
    if (curves_.points.empty() && !complaints_.any())
      complaints_.about_file("the file has no control points", "lines of 4 numbers: x, y, z and the radius");
    if (complaints_.any()) return std::nullopt;
    return std::move(curves_);
  }

 private:
  static constexpr std::string_view kBlanks = " \t\r";

  /// Takes the next word out of the line; empty at its end.
  static std::string_view next_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
    line.remove_prefix(word.size());
    return word;
  }

  void control_point(std::string_view line) {
    std::string_view word = next_word(line);
    if (word.empty()) return end_curve();
    if (in_curve_ == 0) first_word_ = word;
    const std::string_view first_word = word;
    std::array<float, 4> point{};
    for (std::size_t i = 0; i < 4; ++i, word = next_word(line)) {
      if (word.empty()) {
        complaints_.at(first_word, fmt::format("a control point of {} number{}", i, i == 1 ? "" : "s"),
                       "4 numbers: x, y, z and the radius");
        break;
      }
      if (!number(word, point[i])) break;
      if (i == 3) check_radius(word, point[3]);
    }
    if (!word.empty() && !complaints_.any()) warn_of_more(word);
    curves_.points.push_back(point);  // also after a complaint: the curve has it
    if (++in_curve_ >= per_segment_) {
      curves_.segments.push_back(static_cast<std::uint32_t>(curves_.points.size()) - per_segment_);
    }
  }

  bool number(std::string_view word, float& value) {
    constexpr auto kLimit = static_cast<float>(kMaxCoordinate);
    NumberStatus status = parse_number(word, value);
    if (status == NumberStatus::ok && std::abs(value) > kLimit) status = NumberStatus::overflow;
    if (status == NumberStatus::ok) return true;
    complaints_.at(word, fmt::format("{} {}", quoted(word), describe(status)),
                   status == NumberStatus::malformed ? "a number such as 1.5 or -2e3"
                                                     : fmt::format("a number from {:g} to {:g}", -kLimit, kLimit));
    return false;
  }

  /// Control points of B-splines may have negative radii: so a curve ends in a point.
  void check_radius(std::string_view word, float radius) {
    if (per_segment_ == 2) {
      if (radius < 0)
        complaints_.at(word, fmt::format("the radius {:g} is negative", radius), "a radius of at least 0");
      return;
    }
    if (in_curve_ + 1 < per_segment_) return;
    const auto* last = curves_.points.data() + curves_.points.size();
    const double r[4] = {last[-3][3], last[-2][3], last[-1][3], radius};
    const double size = std::max({std::abs(r[0]), std::abs(r[1]), std::abs(r[2]), std::abs(r[3])});
    const double least = least_of_bspline(r);
    // What decimals and floats leave of a radius that is meant to reach 0.
    if (least < -1e-5 * size) {
      complaints_.at(word, fmt::format("the curve's radius falls to {:g} in the segment that ends here", least),
                     "radii of control points that keep the curve's at 0 or above");
    }
  }

  void warn_of_more(std::string_view word) {
    if (warned_) return;
    warned_ = true;
    const auto offset = static_cast<std::size_t>(word.data() - source_.text().data());
    diagnostics_.warning(source_.location(offset, word.size()), "a control point of more than 4 numbers",
                         "x, y, z and the radius; the rest is left out");
  }

  void end_curve() {
    if (in_curve_ == 0) return;
    if (in_curve_ < per_segment_) {
      complaints_.at(first_word_, fmt::format("a curve of {} control point{}", in_curve_, in_curve_ == 1 ? "" : "s"),
                     fmt::format("at least {} control points", per_segment_));
    }
    ++curves_.curves;
    in_curve_ = 0;
  }

  std::string_view rest_;
  std::uint32_t per_segment_;
  MeshComplaints complaints_;
  SourceText source_;
  Diagnostics& diagnostics_;
  CurveData curves_;
  std::size_t in_curve_ = 0;     ///< control points of the curve so far
  std::string_view first_word_;  ///< of the curve
  bool warned_ = false;
};

}  // namespace

std::optional<CurveData> read_curves(std::string_view bytes, CurveBasis basis, const std::string& path,
                                     Diagnostics& diagnostics) {
  try {
    return CurveReader(bytes, basis, path, diagnostics).read();
  } catch (const std::bad_alloc&) {
    MeshComplaints(path, bytes, diagnostics).about_file("the curves do not fit into memory");
    return std::nullopt;
  }
}

}  // namespace norrsken
