// Reads pbrt's files directive by directive.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/pbrt/scene_maker.h"

namespace norrsken::pbrt {

class DirectiveReader {
 public:
  explicit DirectiveReader(Context& context) : context_(context), maker_(context) {}

  /// The scene's file. Complains about what goes wrong, and about what is still open at its end.
  void read_scene(const std::string& path);
  /// What has been read.
  std::shared_ptr<const Node> finish() { return maker_.finish(settings_); }

 private:
  friend struct DirectiveTable;
  using Read = void (DirectiveReader::*)(const Token& word);
  enum class Part { any, header, world };
  struct Directive {
    std::string_view name;
    Part part;
    Read read;
  };

  struct OpenBlock {
    enum class Kind { attributes, object };
    Kind kind;
    Place place;
    GraphicsState state;
  };

  // --- files: directives.cpp ---
  void read_file(const std::string& path, const SourceLocation& named_at);
  void read_text(const Source& source);
  void read_directive(const Token& word);
  static const Directive* find_directive(std::string_view name);

  // --- arguments: directives.cpp ---
  void error(const Place& place, std::string message, std::string accepted = {});
  /// A string in quotes; empty after a complaint.
  std::optional<Token> take_string(const Token& word, std::string_view what);
  /// So many numbers, in brackets or not.
  std::optional<std::vector<double>> take_numbers(const Token& word, std::size_t count);
  /// The parameters that follow, behind those that Attribute has for the target.
  Parameters take_parameters(std::string object, const Place& place, std::string_view target = {});
  SharedParameters take_list(std::string_view target);

  // --- transforms: transforms.cpp ---
  void read_identity(const Token& word);
  void read_translate(const Token& word);
  void read_scale(const Token& word);
  void read_rotate(const Token& word);
  void read_look_at(const Token& word);
  void read_transform(const Token& word);
  void read_concat_transform(const Token& word);
  void read_coordinate_system(const Token& word);
  void read_coord_sys_transform(const Token& word);
  void read_active_transform(const Token& word);
  void read_transform_times(const Token& word);
  void concatenate(const glm::dmat4& by);
  void replace(const glm::dmat4& by);
  std::optional<glm::dmat4> take_matrix(const Token& word);

  // --- the rest: world.cpp ---
  void read_include(const Token& word);
  void read_import(const Token& word);
  void read_option(const Token& word);
  void read_color_space(const Token& word);
  void read_setting(const Token& word);
  void read_world_begin(const Token& word);
  void read_world_end(const Token& word);
  void read_block_begin(const Token& word);
  void read_block_end(const Token& word);
  void read_object_begin(const Token& word);
  void read_object_end(const Token& word);
  void read_object_instance(const Token& word);
  void read_attribute(const Token& word);
  void read_reverse_orientation(const Token& word);
  void read_texture(const Token& word);
  void read_material(const Token& word);
  void read_make_named_material(const Token& word);
  void read_named_material(const Token& word);
  void read_make_named_medium(const Token& word);
  void read_medium_interface(const Token& word);
  void read_light_source(const Token& word);
  void read_area_light_source(const Token& word);
  void read_shape(const Token& word);
  void include(const Token& word, bool is_import);

  Context& context_;
  SceneMaker maker_;
  Settings settings_;
  GraphicsState state_;
  Array<OpenBlock> blocks_;
  std::map<std::string, Transforms> coordinate_systems_;
  std::deque<Source> sources_;
  std::vector<std::string> open_files_;  ///< the one that is read and those that include it, outermost first
  int file_count_ = 0;
  bool in_world_ = false;
  Lexer* lexer_ = nullptr;  ///< of the file that is read
};

}  // namespace norrsken::pbrt
