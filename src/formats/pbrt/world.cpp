// The directives that name things and make them.
#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <iterator>
#include <utility>

#include "base/numbers.h"
#include "base/text.h"
#include "formats/pbrt/directives.h"
#include "formats/pbrt/version3.h"

namespace norrsken::pbrt {
namespace {

/// Small letters without - and _, as pbrt compares the names of options.
std::string plain(std::string_view name) {
  std::string result;
  for (const char c : name) {
    if (c != '-' && c != '_') result += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return result;
}

std::string named(std::string_view kind, const std::string& type) {
  return fmt::format("{} '{}'", kind, shortened(type));
}

SharedParameters with_name(const SharedParameters& parameters, std::string_view name) {
  SharedParameters found;
  std::ranges::copy_if(parameters, std::back_inserter(found), [name](const auto& p) { return p->name == name; });
  return found;
}

}  // namespace

void DirectiveReader::read_include(const Token& word) { include(word, false); }
void DirectiveReader::read_import(const Token& word) { include(word, true); }

void DirectiveReader::read_option(const Token& word) {
  static const std::vector<std::string> kOptions = {"disablepixeljitter",
                                                    "disabletexturefiltering",
                                                    "disablewavelengthjitter",
                                                    "displacementedgescale",
                                                    "forcediffuse",
                                                    "msereferenceimage",
                                                    "msereferenceout",
                                                    "pixelstats",
                                                    "rendercoordsys",
                                                    "seed",
                                                    "wavefront"};
  const auto given = take_string(word, "a name");
  if (!given) return;
  std::string name = given->value;
  // Older files of version 4 declare it as a parameter: "bool disablepixeljitter".
  if (const std::size_t blank = name.rfind(' '); blank != std::string::npos) name = name.substr(blank + 1);
  name = plain(name);
  const bool in_brackets = lexer_->peek() && lexer_->peek()->kind == Token::Kind::open;
  if (in_brackets) lexer_->take();
  const auto value = lexer_->take();
  if (in_brackets && lexer_->peek() && lexer_->peek()->kind == Token::Kind::close) lexer_->take();
  if (std::ranges::find(kOptions, name) == kOptions.end())
    return error(given->place, fmt::format("unknown option {}{}", quoted(given->value), did_you_mean(name, kOptions)),
                 join(kOptions));
  if (!value) return error(lexer_->end(), fmt::format("option '{}' has no value", name), "a value");
  if (name == "seed") {
    if (parse_integer(value->text, settings_.seed) != NumberStatus::ok)
      error(value->place, fmt::format("{} is no seed", quoted(value->text)), "a whole number");
  } else if (value->text != "false" && (name == "disablepixeljitter" || name == "forcediffuse")) {
    context_.tell(given->place, fmt::format("option '{}' is not supported", name), "a picture without it");
  }
}

void DirectiveReader::read_color_space(const Token& word) {
  const auto name = take_string(word, "a name");
  if (!name) return;
  if (const ColorSpace* space = find_color_space(name->value)) {
    state_.space = space;
  } else {
    const std::vector<std::string> known = color_space_names();
    error(name->place, fmt::format("unknown color space {}{}", quoted(name->value), did_you_mean(name->value, known)),
          join(known));
  }
}

void DirectiveReader::read_setting(const Token& word) {
  const auto type = take_string(word, "a type");
  if (!type) return;
  const std::string directive(word.text == "SurfaceIntegrator" ? "Integrator" : word.text);
  Object3 object{directive, type->value, take_list({})};
  update(context_, type->place, object);
  std::string kind = plain(directive == "PixelFilter" ? "filter" : directive);
  Parameters parameters(named(kind, object.type), type->place, std::move(object.parameters), context_.diagnostics);
  settings_.objects.insert_or_assign(directive,
                                     Settings::Object{object.type, std::move(parameters), state_.transforms});
  if (directive == "Film") settings_.film_space = state_.space;
  if (directive != "Camera") return;
  coordinate_systems_["camera"] = {glm::inverse(state_.transforms.start), glm::inverse(state_.transforms.end)};
}

void DirectiveReader::read_world_begin(const Token& /*word*/) {
  in_world_ = true;
  state_.transforms = {};
  state_.changes_start = state_.changes_end = true;
  coordinate_systems_["world"] = {};
  context_.imaging_ratio = imaging_ratio_of(settings_);
}

void DirectiveReader::read_world_end(const Token& word) {
  context_.diagnostics.note(word.place.location(), "WorldEnd, of pbrt's version 3, is not needed");
}

void DirectiveReader::read_block_begin(const Token& word) {
  if (word.text == "TransformBegin")
    context_.diagnostics.note(word.place.location(), "TransformBegin keeps all attributes, as AttributeBegin does");
  blocks_.push_back({OpenBlock::Kind::attributes, word.place, state_});
}

void DirectiveReader::read_block_end(const Token& word) {
  if (blocks_.empty() || blocks_.back().kind != OpenBlock::Kind::attributes)
    return error(word.place, fmt::format("{} without a beginning", word.text),
                 blocks_.empty() ? "AttributeBegin before it" : "ObjectEnd");
  state_ = std::move(blocks_.back().state);
  blocks_.pop_back();
}

void DirectiveReader::read_object_begin(const Token& word) {
  const auto name = take_string(word, "a name");
  if (!name) return;
  if (maker_.in_object()) return error(word.place, "an object inside of another", "ObjectEnd before it");
  if (!maker_.begin_object(name->value, name->place))
    error(name->place, fmt::format("there is an object {} already", quoted(name->value)), "each name once");
  blocks_.push_back({OpenBlock::Kind::object, word.place, state_});
}

void DirectiveReader::read_object_end(const Token& word) {
  if (blocks_.empty() || blocks_.back().kind != OpenBlock::Kind::object)
    return error(word.place, "ObjectEnd without a beginning",
                 blocks_.empty() ? "ObjectBegin before it" : "AttributeEnd");
  state_ = std::move(blocks_.back().state);
  blocks_.pop_back();
  maker_.end_object();
}

void DirectiveReader::read_object_instance(const Token& word) {
  const auto name = take_string(word, "a name");
  if (!name) return;
  if (maker_.in_object()) return error(word.place, "an instance inside of an object", "shapes");
  maker_.add_instance(name->value, name->place, state_.transforms.start);
}

void DirectiveReader::read_attribute(const Token& word) {
  const auto target = take_string(word, "a target");
  if (!target) return;
  const std::vector<std::string> known(std::begin(kAttributeTargets), std::end(kAttributeTargets));
  const auto found = std::ranges::find(known, target->value);
  const SharedParameters given = read_parameters(*lexer_, context_.diagnostics);
  if (found == known.end())
    return error(
        target->place,
        fmt::format("unknown target {} of Attribute{}", quoted(target->value), did_you_mean(target->value, known)),
        join(known));
  SharedParameters& attributes = state_.attributes[static_cast<std::size_t>(found - known.begin())];
  for (const auto& parameter : given) {
    auto copy = std::make_shared<Parameter>(*parameter);
    copy->given = true;
    context_.memory.grow(sizeof(Parameter));
    attributes.push_back(std::move(copy));
  }
}

void DirectiveReader::read_reverse_orientation(const Token& /*word*/) { state_.reverse = !state_.reverse; }

void DirectiveReader::read_texture(const Token& word) {
  const auto name = take_string(word, "a name");
  const auto kind = name ? take_string(word, "a kind") : std::nullopt;
  const auto type = kind ? take_string(word, "a type") : std::nullopt;
  if (!type) return;
  std::string known_kind = kind->value;
  if (known_kind == "color") {
    context_.diagnostics.note(kind->place.location(),
                              "textures of kind 'color', of pbrt's version 3, are of kind 'spectrum'");
    known_kind = "spectrum";
  }
  Object3 object{"Texture", type->value, take_list("texture")};
  update(context_, type->place, object);
  Parameters parameters(named("texture", object.type), type->place, std::move(object.parameters), context_.diagnostics);
  if (known_kind != "float" && known_kind != "spectrum")
    return error(kind->place, fmt::format("unknown kind {} of a texture", quoted(kind->value)), "float, spectrum");
  context_.memory.grow(sizeof(TextureDefinition));
  if (!maker_.textures().define(known_kind, name->value, {object.type, std::move(parameters), state_.space}))
    error(name->place, fmt::format("there is a {} texture {} already", known_kind, quoted(name->value)),
          "each name once");
}

void DirectiveReader::read_material(const Token& word) {
  const auto type = take_string(word, "a type");
  if (!type) return;
  Object3 object{"Material", type->value, take_list("material")};
  update(context_, type->place, object);
  Parameters parameters(named("material", object.type), type->place, std::move(object.parameters),
                        context_.diagnostics);
  state_.material = {.number = maker_.materials().add(object.type, std::move(parameters), *state_.space)};
}

void DirectiveReader::read_make_named_material(const Token& word) {
  const auto name = take_string(word, "a name");
  if (!name) return;
  SharedParameters list = take_list("material");
  const auto type = std::ranges::find_if(list, [](const auto& p) { return p->type == "string" && p->name == "type"; });
  if (type == list.end() || (*type)->strings.size() != 1)
    return error(name->place, fmt::format("material {} has no type", quoted(name->value)),
                 R"("string type" "diffuse")");
  const Place place = (*type)->value;
  Object3 object{"Material", (*type)->strings[0], {}};
  std::ranges::copy_if(list, std::back_inserter(object.parameters), [](const auto& p) { return p->name != "type"; });
  update(context_, place, object);
  Parameters parameters(named("material", object.type), place, std::move(object.parameters), context_.diagnostics);
  if (!maker_.materials().add_named(name->value, object.type, std::move(parameters), *state_.space))
    error(name->place, fmt::format("there is a material {} already", quoted(name->value)), "each name once");
}

void DirectiveReader::read_named_material(const Token& word) {
  const auto name = take_string(word, "a name");
  if (name) state_.material = {.name = name->value, .place = name->place};
}

void DirectiveReader::read_make_named_medium(const Token& word) {
  const auto name = take_string(word, "a name");
  if (!name) return;
  read_parameters(*lexer_, context_.diagnostics);
  context_.tell(name->place, fmt::format("media are not supported: {}", quoted(name->value)), "empty space");
}

void DirectiveReader::read_medium_interface(const Token& word) {
  if (!take_string(word, "a medium")) return;
  if (lexer_->peek() && lexer_->peek()->kind == Token::Kind::string) lexer_->take();
}

void DirectiveReader::read_light_source(const Token& word) {
  const auto type = take_string(word, "a type");
  if (!type) return;
  Object3 object{"LightSource", type->value, take_list("light")};
  update(context_, type->place, object);
  Parameters p(named("light", object.type), type->place, std::move(object.parameters), context_.diagnostics);
  const glm::dmat4& to_world = state_.transforms.start;
  if (!std::isnormal(glm::determinant(glm::dmat3(to_world))))
    return error(type->place, fmt::format("{} is placed where it has no volume", p.object()),
                 "a transform that can be undone");
  add_light(context_, maker_.textures().images(), object.type, p, *state_.space, to_world, maker_.scene(),
            maker_.environment());
  p.finish();
}

void DirectiveReader::read_area_light_source(const Token& word) {
  const auto type = take_string(word, "a type");
  if (!type) return;
  Object3 object{"AreaLightSource", type->value, take_list("light")};
  update(context_, type->place, object);
  Parameters p(named("light", object.type), type->place, std::move(object.parameters), context_.diagnostics);
  auto light = read_area_light(context_, maker_.textures().images(), object.type, p, *state_.space);
  p.finish();
  state_.area_light = light ? std::make_shared<const AreaLight>(*std::move(light)) : nullptr;
}

void DirectiveReader::read_shape(const Token& word) {
  const auto type = take_string(word, "a type");
  if (!type) return;
  Object3 object{"Shape", type->value, take_list("shape")};
  update(context_, type->place, object);
  SharedParameters alpha = with_name(object.parameters, "alpha");
  maker_.add_shape(
      object.type,
      Parameters(named("shape", object.type), type->place, std::move(object.parameters), context_.diagnostics),
      std::move(alpha), state_);
}

}  // namespace norrsken::pbrt
