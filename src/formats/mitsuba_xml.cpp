#include "formats/mitsuba_xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "base/numbers.h"
#include "base/text.h"
#include "formats/mitsuba_element.h"
#include "formats/mitsuba_property.h"
#include "formats/mitsuba_references.h"
#include "formats/mitsuba_values.h"
#include "formats/other_files.h"
#include "formats/xml_document.h"

namespace norrsken {
namespace {

constexpr int kMaxDepth = 100;                               // of elements, includes counted in
constexpr std::size_t kMaxIncludes = 16;                     // inside each other
constexpr int kMaxFiles = 10000;                             // included one after the other
constexpr std::size_t kMaxXmlBytes = std::size_t{64} << 20;  // of all files, each as often as it is included

/// Of memory, beside the text itself: pugixml's nodes, and of a node or a property the texts that it holds (names, and
/// for complaints the file's name and the line, twice).
constexpr std::size_t kTreeBytesPerByte = 8, kTextBytes = 512;

const std::vector<std::string> kObjects = {"bsdf",    "emitter", "film",  "integrator", "medium",  "phase", "rfilter",
                                           "sampler", "sensor",  "shape", "spectrum",   "texture", "volume"};
const std::vector<std::string> kDirectives = {"alias", "default", "include", "path", "ref"};

bool contains(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

class MitsubaReader {
 public:
  MitsubaReader(const FileSystem& files, const SceneParameters::Values& parameters,
                const SceneParameters::Values& preferred, Diagnostics& diagnostics)
      : diagnostics_(diagnostics),
        context_{files, diagnostics, SceneParameters(parameters, preferred, diagnostics),
                 {},    {},          MitsubaUpgrade(diagnostics)},
        references_(diagnostics) {}

  std::optional<Description> read(const std::string& path) {
    context_.search_paths.push_back(folder_of(path));
    auto scene = std::make_shared<Node>();
    scene->kind = "scene";
    // Nodes that could not be read well enough to be used, kept until references are resolved.
    auto rejected = std::make_shared<Node>();
    rejected_ = rejected.get();
    Scope scope{*scene, {}};
    read_file(path, scope, 0, {}, "the scene");

    Node everything;
    everything.children = {{{}, scene, {}}, {{}, rejected, {}}};
    if (!references_.resolve(everything) || !complete_) return std::nullopt;
    context_.upgrade.finish(*scene);
    context_.parameters.finish();
    return Description{std::move(scene), std::move(context_.search_paths), context_.parameters.values(),
                       std::make_shared<MemoryReservation>(std::move(memory_)), context_.upgrade.take_changes()};
  }

 private:
  /// A node that is being filled, and the names that its properties and named children have so far.
  struct Scope {
    Node& node;
    std::unordered_map<std::string, int> names;  ///< and their lines
  };

  bool gave_up() {
    const bool too_many = context_.gave_up();
    complete_ = complete_ && !too_many;
    return too_many;
  }

  /// The scene is not known in full: whatever else would be said of it could be wrong.
  void fail(SourceLocation location, std::string message, std::string accepted = {}) {
    complete_ = false;
    diagnostics_.error(std::move(location), std::move(message), std::move(accepted));
  }

  // --- files ---

  void read_file(const std::string& path, Scope& into, int depth, const SourceLocation& named_at,
                 std::string_view what) {
    std::string error;
    auto contents = read_counted(context_.files, path, error);
    if (!contents)
      return fail(named_at, fmt::format("cannot read {} {}: {}", what, quoted(path, 200), error), "an XML file");
    if (const auto other = recognise_other_file(path, contents->bytes)) {
      SourceLocation location;
      location.file = path;
      diagnostics_.named_at(path, named_at);
      return fail(std::move(location), other->message, other->accepted);
    }
    xml_bytes_ += contents->bytes.size();
    if (xml_bytes_ > kMaxXmlBytes) {
      SourceLocation location;
      location.file = path;
      return fail(std::move(location), "the scene's XML is too large",
                  fmt::format("up to {} MiB, all includes together", kMaxXmlBytes >> 20));
    }
    diagnostics_.named_at(path, named_at);
    const MemoryReservation tree(kTreeBytesPerByte * contents->bytes.size());
    const auto document = XmlDocument::parse(path, std::move(contents->bytes), diagnostics_);
    if (!document) {
      complete_ = false;
      return;
    }
    open_files_.push_back(path);
    const SceneVersion outer_version = context_.upgrade.version;
    const std::vector<std::string> outer_folders = context_.file_folders;
    context_.file_folders.insert(context_.file_folders.begin(), folder_of(path));
    read_root(*document, into, depth);
    context_.upgrade.version = outer_version;
    context_.file_folders = outer_folders;
    open_files_.pop_back();
  }

  void read_root(const XmlDocument& document, Scope& into, int depth) {
    const pugi::xml_node root = document.root();
    const bool top = depth == 0;
    const std::string_view name = root.name();
    if (name != "scene") {
      if (!top && contains(kObjects, name)) return read_node(document, root, into, depth);
      return fail(document.location(root), fmt::format("the root element is <{}>", name),
                  top ? "<scene>" : "<scene>, or an object such as <bsdf>");
    }
    const Element scene = context_.open(document, root, {{}, {"version", "id", "name", "type"}});
    if (top && scene.good && !scene.find("version"))
      fail(scene.location, "<scene> needs an attribute 'version'",
           "version=\"3.0.0\", or that of the Mitsuba which the scene is for");
    if (top) into.node.location = scene.location;
    if (const Literal* version = scene.find("version"); version && !check_version(*version)) return;
    read_children(document, root, into, depth);
  }

  bool check_version(const Literal& version) {
    constexpr const char* kAccepted = "a version such as 3.0.0";
    const auto parts = split(trim(version.text), ".");
    std::int64_t numbers[2] = {0, 0};
    for (std::size_t i = 0; i < std::size(numbers) && i < std::max<std::size_t>(parts.size(), 1); ++i) {
      const std::string_view part = parts.empty() ? std::string_view() : parts[i].text;
      if (parse_integer(part, numbers[i]) == NumberStatus::ok && numbers[i] >= 0 && numbers[i] < 1000) continue;
      fail(version.location(), fmt::format("{} is not a version", version.quote(trim(version.text))), kAccepted);
      return false;
    }
    context_.upgrade.version = {static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
    const std::string text = quoted(trim(version.text));
    if (context_.upgrade.version.is_old() && !std::exchange(told_of_upgrade_, true))
      diagnostics_.note(version.location(),
                        fmt::format("the scene is for Mitsuba {} and was upgraded; 'norrsken info' tells how", text));
    if (numbers[0] > 3)
      diagnostics_.warning(version.location(),
                           fmt::format("the scene is for Mitsuba {}, which may mean other things", text), "0.x to 3.x");
    return true;
  }

  // --- elements ---

  void read_children(const XmlDocument& document, pugi::xml_node parent, Scope& into, int depth) {
    for (const pugi::xml_node child : parent.children()) {
      if (gave_up()) return;
      if (child.type() != pugi::node_element) {
        diagnostics_.error(document.location(child), fmt::format("text in <{}>", parent.name()), "elements");
      } else {
        read_node(document, child, into, depth + 1);
      }
    }
  }

  void read_node(const XmlDocument& document, pugi::xml_node node, Scope& into, int depth) {
    const std::string name = context_.upgrade.element(document, node);
    if (depth > kMaxDepth)
      return fail(document.location(node), fmt::format("elements are nested more than {} deep", kMaxDepth),
                  fmt::format("up to {} inside each other", kMaxDepth));
    const bool plain_spectrum = name == "spectrum" && !node.attribute("type");
    const bool old_value = context_.upgrade.version.is_old() && contains(old_value_types(), name);
    if (contains(kObjects, name) && !plain_spectrum) return read_object(document, node, name, into, depth);
    if (old_value || contains(value_types(), name)) return read_value(document, node, into);
    if (name == "ref") return read_ref(document, node, into);
    if (name == "include") return read_include(document, node, into, depth);
    if (name == "default") return read_default(document, node);
    if (name == "path") return read_path(document, node, into);
    if (name == "alias") return read_alias(document, node);

    std::vector<std::string> known = kObjects;
    known.insert(known.end(), value_types().begin(), value_types().end());
    known.insert(known.end(), kDirectives.begin(), kDirectives.end());
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    std::string message = fmt::format("unknown element {}{}", quoted(name), did_you_mean(name, known));
    if (name == "scene") message = "<scene> inside of another element";
    if (name == "animation" || name == "subsurface") message = fmt::format("<{}> is not supported", name);
    if (transform_step_rules(name)) message = fmt::format("<{}> outside of a <transform>", name);
    diagnostics_.error(document.location(node), std::move(message), join(known));
  }

  // Whether `name` is still free in the node; empty names always are.
  bool claim(Scope& scope, const std::string& name, const SourceLocation& location) {
    if (name.empty()) return true;
    const auto [place, is_new] = scope.names.emplace(name, location.line);
    if (!is_new)
      diagnostics_.error(location, fmt::format("{} is already given in line {}", quoted(name), place->second),
                         "each name once");
    return is_new;
  }

  void read_object(const XmlDocument& document, pugi::xml_node xml, const std::string& kind, Scope& into, int depth) {
    const Element element = context_.open(document, xml, {{"type"}, {"id", "name"}});
    memory_.grow(sizeof(Node) + kTextBytes);
    auto node = std::make_shared<Node>();
    node->kind = kind;
    node->plugin = element.text("type");
    node->id = element.text("id");
    const Literal* name = element.find("name");
    if (name) node->name = context_.upgrade.parameter(*name);
    node->location = element.location;
    node->plugin_location = node->location;
    if (const Literal* type = element.find("type")) node->plugin_location = type->location();

    if (const Literal* id = element.find("id")) references_.name(node->id, node, id->location());
    const bool is_free = !name || claim(into, node->name, name->location());
    Node& parent = element.good && is_free ? into.node : *rejected_;
    if (!element.good && name) into.node.unreadable.push_back(node->name);
    parent.children.push_back({node->name, node, node->location});
    context_.upgrade.add(node);
    Scope scope{*node, {}};
    read_children(document, xml, scope, depth);
  }

  void read_ref(const XmlDocument& document, pugi::xml_node xml, Scope& into) {
    const Element element = context_.open(document, xml, {{"id"}, {"name"}});
    context_.refuse_contents(document, xml);
    if (!element.good) return;
    const Literal* name = element.find("name");
    const std::string today = name ? context_.upgrade.parameter(*name) : std::string();
    if (name && !claim(into, today, name->location())) return;
    references_.refer(into.node, element.text("id"), today, element.find("id")->location());
  }

  void read_alias(const XmlDocument& document, pugi::xml_node xml) {
    const Element element = context_.open(document, xml, {{"id", "as"}, {}});
    context_.refuse_contents(document, xml);
    if (!element.good) return;
    references_.alias(element.text("id"), element.text("as"), element.find("id")->location(),
                      element.find("as")->location());
  }

  void read_default(const XmlDocument& document, pugi::xml_node xml) {
    const Element element = context_.open(document, xml, {{"name", "value"}, {}});
    context_.refuse_contents(document, xml);
    if (!element.find("name")) return;
    const Literal& name = *element.find("name");
    if (SceneParameters::is_name(name.text)) {
      // Also after a complaint about the value: the name is known, its uses are not to blame.
      const Literal* value = element.find("value");
      context_.parameters.define(name.text, element.text("value"), value ? value->raw() : std::string_view());
    } else {
      diagnostics_.error(name.location(), fmt::format("{} cannot be the name of a parameter", name.quote(name.text)),
                         "letters, digits and _");
    }
  }

  void read_path(const XmlDocument& document, pugi::xml_node xml, Scope& into) {
    const Element element = context_.open(document, xml, {{"value"}, {}});
    context_.refuse_contents(document, xml);
    if (!element.good) return;
    const Literal& value = *element.find("value");
    if (into.node.kind != "scene") {
      diagnostics_.error(element.location, fmt::format("<path> in a <{}>", into.node.kind), "<path> in <scene>");
      return;
    }
    const std::string folder = resolve_file(context_.files, value.text, context_.file_folders);
    if (folder.empty()) {
      diagnostics_.error(value.location(), fmt::format("there is no folder {}", value.quote(value.text)),
                         "an existing folder, relative to this file");
    } else if (!context_.files.is_folder(folder)) {
      diagnostics_.error(value.location(), fmt::format("{} is not a folder", value.quote(value.text)),
                         "an existing folder, relative to this file");
    } else {
      context_.file_folders.insert(context_.file_folders.begin(), folder);
      // What an included file adds is for its own sake; the scene's are asked first.
      auto& paths = context_.search_paths;
      paths.insert(open_files_.size() == 1 ? paths.begin() : paths.end(), folder);
    }
  }

  void read_include(const XmlDocument& document, pugi::xml_node xml, Scope& into, int depth) {
    const Element element = context_.open(document, xml, {{"filename"}, {}});
    context_.refuse_contents(document, xml);
    if (!element.good) {
      complete_ = false;
      return;
    }
    const Literal& filename = *element.find("filename");
    const std::string path = context_.find_file(filename);
    if (path.empty()) {
      complete_ = false;
      return;
    }
    const std::string key = normal_path(path);
    const auto is_same = [&key](const std::string& open) { return normal_path(open) == key; };
    if (const auto open = std::find_if(open_files_.begin(), open_files_.end(), is_same); open != open_files_.end()) {
      std::vector<std::string> chain(open, open_files_.end());
      chain.push_back(*open);
      return fail(filename.location(), "the file includes itself: " + join(chain, " -> "), "a file that does not");
    }
    if (open_files_.size() > kMaxIncludes || ++file_count_ > kMaxFiles)
      return fail(filename.location(), "too many includes",
                  fmt::format("up to {} inside each other, {} in all", kMaxIncludes, kMaxFiles));
    read_file(path, into, depth, filename.location(), "the included file");
  }

  void read_value(const XmlDocument& document, pugi::xml_node xml, Scope& into) {
    const Element element = context_.open(document, xml, value_rules(xml.name(), context_.upgrade.version));
    const Literal* name = element.find("name");
    const std::string today = name ? context_.upgrade.parameter(*name) : std::string();
    if (name && !claim(into, today, name->location())) return;
    auto property = read_property(context_, document, xml, element, today);
    if (property) {
      memory_.grow(sizeof(Property) + kTextBytes);
      into.node.properties.push_back(std::move(*property));
    } else if (name) {
      into.node.unreadable.push_back(today);
    }
  }

  Diagnostics& diagnostics_;
  MitsubaContext context_;
  References references_;
  std::vector<std::string> open_files_;  ///< the file being read and those that include it, outermost first
  std::size_t xml_bytes_ = 0;
  MemoryReservation memory_{0};
  int file_count_ = 0;
  Node* rejected_ = nullptr;
  bool complete_ = true;
  bool told_of_upgrade_ = false;
};

}  // namespace

std::optional<Description> read_mitsuba_xml(const std::string& path, const FileSystem& files,
                                            const std::vector<std::pair<std::string, std::string>>& parameters,
                                            Diagnostics& diagnostics,
                                            const std::vector<std::pair<std::string, std::string>>& preferred) {
  return MitsubaReader(files, parameters, preferred, diagnostics).read(path);
}

}  // namespace norrsken
