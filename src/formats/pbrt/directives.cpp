#include "formats/pbrt/directives.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/numbers.h"
#include "base/text.h"
#include "formats/pbrt/version3.h"

namespace norrsken::pbrt {
namespace {

constexpr std::size_t kMaxIncludes = 32;  // inside each other
constexpr int kMaxFiles = 10000;          // included one after the other

}  // namespace

struct DirectiveTable {
  using Reader = DirectiveReader;
  using Part = Reader::Part;
  static constexpr Reader::Directive kAll[] = {
      {"Accelerator", Part::header, &Reader::read_setting},
      {"ActiveTransform", Part::any, &Reader::read_active_transform},
      {"AreaLightSource", Part::world, &Reader::read_area_light_source},
      {"Attribute", Part::any, &Reader::read_attribute},
      {"AttributeBegin", Part::world, &Reader::read_block_begin},
      {"AttributeEnd", Part::world, &Reader::read_block_end},
      {"Camera", Part::header, &Reader::read_setting},
      {"ColorSpace", Part::any, &Reader::read_color_space},
      {"ConcatTransform", Part::any, &Reader::read_concat_transform},
      {"CoordSysTransform", Part::any, &Reader::read_coord_sys_transform},
      {"CoordinateSystem", Part::any, &Reader::read_coordinate_system},
      {"Film", Part::header, &Reader::read_setting},
      {"Identity", Part::any, &Reader::read_identity},
      {"Import", Part::world, &Reader::read_import},
      {"Include", Part::any, &Reader::read_include},
      {"Integrator", Part::header, &Reader::read_setting},
      {"LightSource", Part::world, &Reader::read_light_source},
      {"LookAt", Part::any, &Reader::read_look_at},
      {"MakeNamedMaterial", Part::world, &Reader::read_make_named_material},
      {"MakeNamedMedium", Part::any, &Reader::read_make_named_medium},
      {"Material", Part::world, &Reader::read_material},
      {"MediumInterface", Part::any, &Reader::read_medium_interface},
      {"NamedMaterial", Part::world, &Reader::read_named_material},
      {"ObjectBegin", Part::world, &Reader::read_object_begin},
      {"ObjectEnd", Part::world, &Reader::read_object_end},
      {"ObjectInstance", Part::world, &Reader::read_object_instance},
      {"Option", Part::any, &Reader::read_option},
      {"PixelFilter", Part::header, &Reader::read_setting},
      {"ReverseOrientation", Part::world, &Reader::read_reverse_orientation},
      {"Rotate", Part::any, &Reader::read_rotate},
      {"Sampler", Part::header, &Reader::read_setting},
      {"Scale", Part::any, &Reader::read_scale},
      {"Shape", Part::world, &Reader::read_shape},
      {"SurfaceIntegrator", Part::header, &Reader::read_setting},
      {"Texture", Part::world, &Reader::read_texture},
      {"Transform", Part::any, &Reader::read_transform},
      {"TransformBegin", Part::world, &Reader::read_block_begin},
      {"TransformEnd", Part::world, &Reader::read_block_end},
      {"TransformTimes", Part::header, &Reader::read_transform_times},
      {"Translate", Part::any, &Reader::read_translate},
      {"WorldBegin", Part::header, &Reader::read_world_begin},
      {"WorldEnd", Part::world, &Reader::read_world_end},
  };
};

const DirectiveReader::Directive* DirectiveReader::find_directive(std::string_view name) {
  const auto* found = std::ranges::find(DirectiveTable::kAll, name, &Directive::name);
  return found == std::end(DirectiveTable::kAll) ? nullptr : found;
}

void DirectiveReader::error(const Place& place, std::string message, std::string accepted) {
  context_.diagnostics.error(place.location(), std::move(message), std::move(accepted));
}

void DirectiveReader::read_scene(const std::string& path) {
  read_file(path, {});
  if (context_.diagnostics.has_errors()) return;
  for (const OpenBlock& block : blocks_)
    error(block.place, block.kind == OpenBlock::Kind::object ? "the object does not end" : "the block does not end",
          block.kind == OpenBlock::Kind::object ? "ObjectEnd" : "AttributeEnd");
  if (!in_world_) {
    SourceLocation whole;
    whole.file = path;
    context_.diagnostics.error(whole, "the scene ends before its world", "WorldBegin, and what is in the world");
  }
}

void DirectiveReader::read_file(const std::string& path, const SourceLocation& named_at) {
  std::string problem;
  auto contents = read_unpacked(context_.files, path, problem);
  if (!contents) {
    context_.diagnostics.error(named_at, fmt::format("cannot read the file {}: {}", quoted(path, 200), problem),
                               "a file of pbrt's scene language, packed by gzip or not");
    return;
  }
  if (!named_at.file.empty()) context_.diagnostics.named_at(path, named_at);
  if (contents->bytes.starts_with("\xFE\xFF") || contents->bytes.starts_with("\xFF\xFE")) {
    SourceLocation whole;
    whole.file = path;
    context_.diagnostics.error(whole, "the file is in UTF-16", "UTF-8");
    return;
  }
  const Source& source = sources_.emplace_back(path, *std::move(contents));
  open_files_.push_back(path);
  read_text(source);
  open_files_.pop_back();
}

void DirectiveReader::read_text(const Source& source) {
  Lexer lexer(source, context_.diagnostics);
  Lexer* const outer = std::exchange(lexer_, &lexer);
  bool skipping = false;  // behind something that was complained about
  while (const Token* next = lexer.peek()) {
    if (lexer.is_broken()) break;
    const Token token = *next;
    lexer.take();
    const bool is_word = token.kind == Token::Kind::word;
    if (is_word && find_directive(token.text)) {
      skipping = false;
      const int errors = context_.diagnostics.error_count();
      read_directive(token);
      skipping = context_.diagnostics.error_count() > errors;
    } else if (!skipping) {
      skipping = true;
      std::vector<std::string> known;
      for (const Directive& directive : DirectiveTable::kAll) known.emplace_back(directive.name);
      error(token.place,
            is_word ? fmt::format("unknown directive {}{}", quoted(token.text), did_you_mean(token.text, known))
                    : fmt::format("{} in place of a directive", shortened(token.text)),
            join(known));
    }
  }
  lexer_ = outer;
}

void DirectiveReader::read_directive(const Token& word) {
  const Directive& directive = *find_directive(word.text);
  if (directive.part == Part::header && in_world_) {
    error(word.place, fmt::format("{} behind WorldBegin", word.text), "it before WorldBegin");
  } else if (directive.part == Part::world && !in_world_) {
    error(word.place, fmt::format("{} before WorldBegin", word.text), "it behind WorldBegin");
  } else {
    (this->*directive.read)(word);
  }
}

std::optional<Token> DirectiveReader::take_string(const Token& word, std::string_view what) {
  const Token* next = lexer_->peek();
  if (next && next->kind == Token::Kind::string) return lexer_->take();
  error(next ? next->place : lexer_->end(), fmt::format("{} needs {}", word.text, what), "a string in quotes");
  return std::nullopt;
}

std::optional<std::vector<double>> DirectiveReader::take_numbers(const Token& word, std::size_t count) {
  const auto is = [this](Token::Kind kind) { return lexer_->peek() && lexer_->peek()->kind == kind; };
  const bool in_brackets = is(Token::Kind::open);
  if (in_brackets) lexer_->take();
  std::vector<double> numbers;
  while (numbers.size() < count && is(Token::Kind::word)) {
    double value = 0;
    if (parse_number(lexer_->peek()->text, value) != NumberStatus::ok) break;
    lexer_->take();
    numbers.push_back(value);
  }
  const bool closed = !in_brackets || is(Token::Kind::close);
  if (numbers.size() == count && closed) {
    if (in_brackets) lexer_->take();
    return numbers;
  }
  const Token* next = lexer_->peek();
  error(next ? next->place : lexer_->end(),
        next ? fmt::format("{} in the numbers of {}", quoted(next->text), word.text)
             : fmt::format("the file ends in the numbers of {}", word.text),
        fmt::format("{} number{}", count, count == 1 ? "" : "s"));
  return std::nullopt;
}

SharedParameters DirectiveReader::take_list(std::string_view target) {
  SharedParameters all;
  for (std::size_t i = 0; i < std::size(kAttributeTargets); ++i) {
    if (kAttributeTargets[i] == target) all = state_.attributes[i];
  }
  SharedParameters own = read_parameters(*lexer_, context_.diagnostics);
  all.insert(all.end(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
  return all;
}

Parameters DirectiveReader::take_parameters(std::string object, const Place& place, std::string_view target) {
  return {std::move(object), place, take_list(target), context_.diagnostics};
}

void DirectiveReader::include(const Token& word, bool is_import) {
  const auto name = take_string(word, "a file");
  if (!name) return;
  Parameter as_parameter;
  as_parameter.value = name->place;
  const std::string path = context_.find_file(as_parameter, name->value);
  if (path.empty()) return;
  const std::string key = normal_path(path);
  const auto open =
      std::ranges::find_if(open_files_, [&](const std::string& file) { return normal_path(file) == key; });
  if (open != open_files_.end()) {
    std::vector<std::string> chain(open, open_files_.end());
    chain.push_back(*open);
    return error(name->place, "the file includes itself: " + join(chain, " -> "), "a file that does not");
  }
  if (open_files_.size() > kMaxIncludes || ++file_count_ > kMaxFiles)
    return error(name->place, "too many includes",
                 fmt::format("up to {} inside each other, {} in all", kMaxIncludes, kMaxFiles));
  if (!is_import) return read_file(path, name->place.location());
  const GraphicsState state = state_;
  read_file(path, name->place.location());
  state_ = state;
}

}  // namespace norrsken::pbrt
