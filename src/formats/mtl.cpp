#include "formats/mtl.h"

#include <fmt/format.h>
#include <algorithm>

#include "base/numbers.h"
#include "base/text.h"
#include "scene/source_text.h"

namespace norrsken {
namespace {

class MtlReader {
 public:
  MtlReader(std::string_view bytes, const std::string& path, Diagnostics& diagnostics)
      : text_(path, bytes), diagnostics_(diagnostics) {}

  std::map<std::string, MtlMaterial> read() {
    for (const TextPiece& line : split(text_.text(), "\r\n")) {
      const std::vector<TextPiece> words = split(line.text, " \t");
      if (!words.empty() && !words[0].text.starts_with('#')) statement(line, words);
    }
    return std::move(materials_);
  }

 private:
  void statement(const TextPiece& line, const std::vector<TextPiece>& words) {
    const std::string_view keyword = words[0].text;
    if (keyword == "newmtl") {
      material_ = &materials_[std::string(trim(line.text.substr(words[0].offset + keyword.size())))];
      return;
    }
    if (!material_) return;
    MtlMaterial& m = *material_;
    const auto one = [&](double& value) { numbers(line, words, &value, 1, 1); };
    const auto three = [&](std::array<double, 3>& value) { numbers(line, words, value.data(), 3, 1e6); };
    if (keyword == "Kd") {
      three(m.diffuse);
    } else if (keyword == "Ks") {
      three(m.specular);
    } else if (keyword == "Ke") {
      three(m.emission);
    } else if (keyword == "Ns") {
      numbers(line, words, &m.exponent, 1, 1e9);
    } else if (keyword == "Ni") {
      numbers(line, words, &m.index, 1, 100);
    } else if (keyword == "d") {
      one(m.opacity);
    } else if (keyword == "Tr") {
      double transparency = 0;
      one(transparency);
      m.opacity = 1 - transparency;
    } else if (keyword == "Pr") {
      one(m.roughness);
    } else if (keyword == "Pm") {
      one(m.metallic);
    } else if (keyword == "map_Kd") {
      map(line, words, m.diffuse_map, m.diffuse_map_place);
    } else if (keyword == "map_d") {
      map(line, words, m.opacity_map, m.opacity_map_place);
    } else if (keyword == "map_Ke") {
      map(line, words, m.emission_map, m.emission_map_place);
    }
  }

  SourceLocation place(const TextPiece& line, const TextPiece& word) const {
    return text_.location(line.offset + word.offset, word.text.size());
  }

  /// One number stands for three; what is beyond 0 and `most` is clamped.
  void numbers(const TextPiece& line, const std::vector<TextPiece>& words, double* values, std::size_t count,
               double most) {
    // "Kd spectral FILE", "Kd xyz X Y Z", "d -halo 0.5".
    const std::size_t first = words.size() > 2 && words[1].text == "-halo" ? 2 : 1;
    if (words.size() > 1 && (words[1].text == "spectral" || words[1].text == "xyz"))
      return diagnostics_.warning(place(line, words[1]),
                                  fmt::format("{} of a material is left out", quoted(words[1].text)));
    for (std::size_t i = 0; i < count; ++i) {
      if (first + i >= words.size() || words[first + i].text.starts_with('#')) {
        if (i == 0)
          return diagnostics_.error(place(line, words[0]), fmt::format("{} has no number", quoted(words[0].text)),
                                    "a number");
        values[i] = values[0];
        continue;
      }
      double value = 0;
      const NumberStatus status = parse_number(words[first + i].text, value);
      if (status != NumberStatus::ok)
        return diagnostics_.error(place(line, words[first + i]),
                                  fmt::format("{} {}", quoted(words[first + i].text), describe(status)), "a number");
      values[i] = std::clamp(value, 0.0, most);
    }
  }

  /// The name stands last, behind options of which each begins with a minus.
  void map(const TextPiece& line, const std::vector<TextPiece>& words, std::string& name, SourceLocation& at) {
    if (words.size() < 2) return;
    const bool has_options = words[1].text.starts_with('-');
    const TextPiece& first = has_options ? words.back() : words[1];
    name = std::string(trim(line.text.substr(first.offset)));
    at = text_.location(line.offset + first.offset, name.size());
    if (has_options) diagnostics_.warning(place(line, words[1]), "options of a map are left out");
  }

  SourceText text_;
  Diagnostics& diagnostics_;
  std::map<std::string, MtlMaterial> materials_;
  MtlMaterial* material_ = nullptr;
};

}  // namespace

std::map<std::string, MtlMaterial> read_mtl(std::string_view bytes, const std::string& path, Diagnostics& diagnostics) {
  return MtlReader(bytes, path, diagnostics).read();
}

}  // namespace norrsken
