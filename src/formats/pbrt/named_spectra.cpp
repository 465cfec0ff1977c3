#include "formats/pbrt/named_spectra.h"

#include "color/srgb.h"

namespace norrsken::pbrt {
namespace {

struct Illuminant {
  std::string_view name;
  Chromaticity at;
};
// CIE 15:2018, tables of chromaticities for the 2-degree observer; D60 is that of ACES (SMPTE ST 2065-1).
constexpr Illuminant kIlluminants[] = {
    {"stdillum-A", {0.44758, 0.40745}},    {"stdillum-D50", {0.34567, 0.35850}}, {"stdillum-D65", kSrgbWhite},
    {"illum-acesD60", {0.32168, 0.33767}}, {"stdillum-F1", {0.31310, 0.33727}},  {"stdillum-F2", {0.37208, 0.37529}},
    {"stdillum-F3", {0.40910, 0.39430}},   {"stdillum-F4", {0.44018, 0.40329}},  {"stdillum-F5", {0.31379, 0.34531}},
    {"stdillum-F6", {0.37790, 0.38835}},   {"stdillum-F7", {0.31292, 0.32933}},  {"stdillum-F8", {0.34588, 0.35875}},
    {"stdillum-F9", {0.37417, 0.37281}},   {"stdillum-F10", {0.34609, 0.35986}}, {"stdillum-F11", {0.38052, 0.37713}},
    {"stdillum-F12", {0.43695, 0.40441}},
};

struct Metal {
  std::string_view name;
  glm::dvec3 eta, k;
};
// As those of the same names in src/bsdf/metals.def; brass (CuZn), which is not among them, by values in general use for
// red, green and blue.
const Metal kMetals[] = {
    {"metal-Ag-", {0.1553, 0.116727, 0.138343}, {4.82909, 3.12218, 2.14621}},
    {"metal-Al-", {1.65775, 0.880394, 0.521077}, {9.22522, 6.26943, 4.83544}},
    {"metal-Au-", {0.143056, 0.375303, 1.44158}, {3.9836, 2.38553, 1.60284}},
    {"metal-Cu-", {0.201034, 0.923738, 1.10186}, {3.91386, 2.45302, 2.1414}},
    {"metal-CuZn-", {0.444, 0.527, 1.094}, {3.695, 2.765, 1.829}},
    {"metal-MgO-", {2.0899, 1.6507, 1.59436}, {0, 0, 0}},
    {"metal-TiO2-", {3.45714, 2.8017, 2.90424}, {0.000105211, 0, 0.00065227}},
};

struct Glass {
  std::string_view name;
  double index;
};
// Schott's catalogue, nd. What pbrt calls F5, F10 and F11 are the glasses SF5, SF10 and SF11.
constexpr Glass kGlasses[] = {{"glass-BK7", 1.5168},    {"glass-BAF10", 1.67003}, {"glass-FK51A", 1.48656},
                              {"glass-LASF9", 1.85025}, {"glass-F5", 1.6727},     {"glass-F10", 1.72825},
                              {"glass-F11", 1.78472}};

}  // namespace

std::optional<glm::dvec3> named_illuminant(std::string_view name) {
  for (const Illuminant& illuminant : kIlluminants) {
    if (illuminant.name != name) continue;
    const ColorVector rgb = kSrgbFromXyz * xyz_of(illuminant.at);
    return glm::dvec3(rgb[0], rgb[1], rgb[2]);
  }
  return std::nullopt;
}

std::optional<glm::dvec3> named_metal(std::string_view name) {
  for (const Metal& metal : kMetals) {
    if (!name.starts_with(metal.name)) continue;
    const std::string_view part = name.substr(metal.name.size());
    if (part == "eta") return metal.eta;
    if (part == "k") return metal.k;
  }
  return std::nullopt;
}

std::optional<double> named_glass(std::string_view name) {
  for (const Glass& glass : kGlasses) {
    if (glass.name == name) return glass.index;
  }
  return std::nullopt;
}

}  // namespace norrsken::pbrt
