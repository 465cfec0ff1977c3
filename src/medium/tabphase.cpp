// tabphase: host side.
#include "medium/tabphase.h"

#include <fmt/core.h>

#include "compile/media.h"

namespace norrsken {
namespace {

constexpr NumbersParameter kValues{
    .name = "values",
    .text =
        "how much is scattered by the cosine of the angle, from -1 (back) to 1 (straight on) in equal steps; "
        "normalised",
    .example = R"(<string name="values" value="1, 2, 3"/>)"};
constexpr std::size_t kMostValues = std::size_t{1} << 20;

}  // namespace

PhaseWord compile_phase_tabphase(Parameters& p, Media& media) {
  const std::vector<double> values = p.read(kValues);
  if (values.empty()) return 0;
  if (values.size() < 2 || values.size() > kMostValues) {
    p.error(kValues.name, fmt::format("{} value{}", values.size(), values.size() == 1 ? "" : "s"),
            fmt::format("2 to {}", kMostValues));
    return 0;
  }
  const double width = 2.0 / static_cast<double>(values.size() - 1);
  std::vector<double> integrals(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] < 0 || values[i] > 1e20) {
      p.error(kValues.name, fmt::format("the value {:g}", values[i]), "0 to 1e20");
      return 0;
    }
    if (i > 0) integrals[i] = integrals[i - 1] + (values[i - 1] + values[i]) / 2 * width;
  }
  const double whole = integrals.back();
  if (!(whole > 0)) {
    p.error(kValues.name, "every value is 0", "a value above 0");
    return 0;
  }
  Array<float>& texels = media.tables().texels;
  const auto first = static_cast<std::uint32_t>(texels.size());
  for (const double value : values) texels.push_back(static_cast<float>(value / whole));
  for (const double integral : integrals) texels.push_back(static_cast<float>(integral / whole));
  return media.add(
      isa_host::TabulatedPhase::Stored{.segments = static_cast<std::uint32_t>(values.size() - 1), .first = first});
}

}  // namespace norrsken
