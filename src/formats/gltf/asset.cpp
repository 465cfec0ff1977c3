#include "formats/gltf/asset.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/text.h"
#include "scene/find_file.h"

namespace norrsken::gltf {
namespace {

constexpr std::string_view kMagic = "glTF";
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr double kMostWhole = 9007199254740992.0;  // 2^53

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t k = 4; k-- > 0;) word = word << 8u | static_cast<unsigned char>(bytes[offset + k]);
  return word;
}

/// Empty if it is no base64.
std::optional<std::string> decode_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  while (text.ends_with('=')) text.remove_suffix(1);
  for (const char c : text) {
    std::uint32_t value = 0;
    if (c >= 'A' && c <= 'Z') {
      value = static_cast<std::uint32_t>(c - 'A');
    } else if (c >= 'a' && c <= 'z') {
      value = static_cast<std::uint32_t>(c - 'a') + 26;
    } else if (c >= '0' && c <= '9') {
      value = static_cast<std::uint32_t>(c - '0') + 52;
    } else if (c == '+' || c == '-') {
      value = 62;
    } else if (c == '/' || c == '_') {
      value = 63;
    } else {
      return std::nullopt;
    }
    bits = bits << 6u | value;
    if (++count == 4) {
      for (const unsigned shift : {16u, 8u, 0u}) bytes += static_cast<char>(bits >> shift & 0xffu);
      bits = 0, count = 0;
    }
  }
  if (count == 1) return std::nullopt;
  if (count > 1) bits <<= 6u * static_cast<unsigned>(4 - count);
  for (int k = 0; k + 1 < count; ++k) bytes += static_cast<char>(bits >> (16u - 8u * static_cast<unsigned>(k)) & 0xffu);
  return bytes;
}

/// With %20 and the like as what they stand for.
std::string decode_percent(std::string_view uri) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : (c | 0x20) >= 'a' && (c | 0x20) <= 'f' ? (c | 0x20) - 'a' + 10 : -1;
  };
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
      path += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

/// Whether the path, below some folder, leaves it or is no path of its own.
bool leaves_folder(std::string_view path) {
  if (path.starts_with('/') || path.starts_with('\\') || (path.size() > 1 && path[1] == ':')) return true;
  int depth = 0;
  for (const TextPiece& piece : split(path, "/\\")) {
    if (piece.text == "..") {
      if (--depth < 0) return true;
    } else if (piece.text != ".") {
      ++depth;
    }
  }
  return false;
}

}  // namespace

Asset::Asset(const FileSystem& all_files, Diagnostics& complaints, const std::string& path)
    : files(all_files), diagnostics(complaints), folder_(folder_of(path)), source_(path, {}) {}

bool Asset::open(const std::string& path) {
  std::string reason;
  contents_ = read_counted(files, path, reason);
  const auto refuse = [&](const std::string& message, const std::string& accepted) {
    diagnostics.error(source_.location(), message, accepted);
    return false;
  };
  if (!contents_) return refuse("cannot read the scene: " + reason, "a glTF file");
  std::string_view json = contents_->bytes;
  if (json.starts_with(kMagic)) {
    if (!open_binary()) return false;
    json = source_.text();
  } else {
    if (json.starts_with("\xEF\xBB\xBF")) json.remove_prefix(3);
    source_ = SourceText(path, json);
  }
  JsonFault fault;
  root_ = parse_json(json, memory, fault);
  if (!root_) {
    diagnostics.error(source_.location(fault.offset), "the JSON is damaged: " + fault.message, "JSON (RFC 8259)");
    return false;
  }
  if (root_->kind != Json::Kind::object)
    return refuse("the JSON is no glTF: it is " + std::string(name_of(root_->kind)), "an object");
  const Json* asset = member(*root_, "asset", Json::Kind::object);
  if (!asset) {
    if (!diagnostics.has_errors()) refuse("the JSON is no glTF: it has no 'asset'", R"("asset": { "version": "2.0" })");
    return false;
  }
  const std::string version = string(*asset, "version"), least = string(*asset, "minVersion", "2.0");
  if (!version.starts_with("2.") || least > "2.0")
    error(*asset, fmt::format("version {} of glTF is not supported", quoted(least > "2.0" ? least : version)), "2.0");
  return !diagnostics.has_errors();
}

bool Asset::open_binary() {
  const std::string_view bytes = contents_->bytes;
  const std::string path = source_.path();
  const auto refuse = [&](const std::string& message, const std::string& accepted) {
    diagnostics.error(source_.location(), message, accepted);
    return false;
  };
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes)
    return refuse(fmt::format("the binary glTF is cut off: it has {} bytes", bytes.size()),
                  "a header of 12 bytes, and chunks");
  if (word_at(bytes, 4) != 2)
    return refuse(fmt::format("version {} of binary glTF is not supported", word_at(bytes, 4)), "2");
  const std::size_t total = word_at(bytes, 8);
  if (total > bytes.size() || total < kHeaderBytes + kChunkHeaderBytes)
    return refuse(
        fmt::format("the binary glTF is damaged: its header tells of {} bytes, the file has {}", total, bytes.size()),
        "the file's length");
  bool has_json = false;
  for (std::size_t at = kHeaderBytes; at + kChunkHeaderBytes <= total;) {
    const std::size_t length = word_at(bytes, at);
    const std::string_view type = bytes.substr(at + 4, 4);
    at += kChunkHeaderBytes;
    if (length > total - at)
      return refuse(
          fmt::format("the binary glTF is damaged: a chunk of {} bytes begins at byte {} of {}", length, at, total),
          "chunks that end within the file");
    std::string_view chunk = bytes.substr(at, length);
    if (!has_json) {
      if (type != "JSON") return refuse("the binary glTF does not begin with a chunk JSON", "the chunk JSON first");
      while (chunk.ends_with('\0')) chunk.remove_suffix(1);  // that some writers fill up with
      source_ = SourceText(path, chunk);
      has_json = true;
    } else if (!has_binary_ && type == std::string_view("BIN\0", 4)) {
      binary_ = chunk;
      has_binary_ = true;
    }
    at += length;
  }
  return has_json || refuse("the binary glTF has no chunk JSON", "the chunk JSON first");
}

void Asset::error(const Json& value, const std::string& message, std::string accepted) {
  diagnostics.error(place(value), fmt::format("{} (at {})", message, pointer_to(*root_, value)), std::move(accepted));
}

void Asset::tell(const Json& value, const std::string& message, const std::string& instead) {
  if (!told_.insert(message).second) return;
  diagnostics.warning(place(value), instead.empty() ? message : message + "; instead: " + instead);
}

const Json* Asset::member(const Json& object, std::string_view name, Json::Kind kind) {
  const Json* found = object.find(name);
  if (!found || found->kind == kind) return found;
  error(*found, fmt::format("'{}' is {}", name, name_of(found->kind)), std::string(name_of(kind)));
  return nullptr;
}

const std::vector<Json>& Asset::items(const Json& object, std::string_view name) {
  static const std::vector<Json> none;
  const Json* list = member(object, name, Json::Kind::array);
  return list ? list->items : none;
}

const Json* Asset::extension(const Json& object, std::string_view name) {
  const Json* all = member(object, "extensions", Json::Kind::object);
  return all ? member(*all, name, Json::Kind::object) : nullptr;
}

double Asset::number(const Json& object, std::string_view name, double fallback, double min, double max) {
  const Json* found = member(object, name, Json::Kind::number);
  if (!found) return fallback;
  if (found->number >= min && found->number <= max) return found->number;
  error(*found, fmt::format("'{}' is {:g}", name, found->number),
        min > -1e30 && max < 1e30 ? fmt::format("a number from {:g} to {:g}", min, max)
        : min > -1e30             ? fmt::format("a number of at least {:g}", min)
                                  : "a number of at most 1e30");
  return fallback;
}

bool Asset::boolean(const Json& object, std::string_view name, bool fallback) {
  const Json* found = member(object, name, Json::Kind::boolean);
  return found ? found->boolean : fallback;
}

std::string Asset::string(const Json& object, std::string_view name, const std::string& fallback) {
  const Json* found = member(object, name, Json::Kind::string);
  return found ? found->text : fallback;
}

std::optional<std::size_t> Asset::index(const Json& object, std::string_view name) {
  const Json* found = member(object, name, Json::Kind::number);
  if (!found) return std::nullopt;
  if (found->number >= 0 && found->number <= kMostWhole && std::floor(found->number) == found->number)
    return static_cast<std::size_t>(found->number);
  error(*found, fmt::format("'{}' is {:g}", name, found->number), "a whole number from 0 on");
  return std::nullopt;
}

std::size_t Asset::whole(const Json& object, std::string_view name, std::size_t fallback) {
  return index(object, name).value_or(fallback);
}

void Asset::fill(const Json& list, double* values, std::size_t n) {
  const bool fits = list.items.size() == n && std::ranges::all_of(list.items, [](const Json& item) {
                      return item.kind == Json::Kind::number && std::abs(item.number) <= 1e30;
                    });
  if (!fits) return error(list, "the array does not hold what it stands for", fmt::format("{} numbers", n));
  for (std::size_t i = 0; i < n; ++i) values[i] = list.items[i].number;
}

const Json* Asset::element(const Json& named_at, std::string_view collection, std::size_t index) {
  const Json* all = member(*root_, collection, Json::Kind::array);
  const std::size_t count = all ? all->items.size() : 0;
  if (index >= count) {
    error(named_at, fmt::format("there is no element {} of '{}'", index, collection),
          count == 0 ? std::string("none: the file has none") : fmt::format("0 to {}", count - 1));
    return nullptr;
  }
  const Json& found = all->items[index];
  if (found.kind == Json::Kind::object) return &found;
  error(found, fmt::format("an element of '{}' is {}", collection, name_of(found.kind)), "an object");
  return nullptr;
}

const Json* Asset::referred(const Json& object, std::string_view name, std::string_view collection) {
  const auto found = index(object, name);
  return found ? element(*object.find(name), collection, *found) : nullptr;
}

std::shared_ptr<const std::string> Asset::resource(const Json& owner) {
  const Json* uri = member(owner, "uri", Json::Kind::string);
  if (!uri) return nullptr;
  if (const auto known = resources_.find(uri); known != resources_.end()) return known->second;
  std::shared_ptr<const std::string>& result = resources_[uri];
  const std::string& text = uri->text;
  if (text.starts_with("data:")) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) {
      error(*uri, "the data URI has no data", "data:TYPE;base64,...");
      return nullptr;
    }
    memory.grow(text.size());
    const std::string_view data = std::string_view(text).substr(comma + 1);
    if (std::string_view(text).substr(0, comma).ends_with(";base64")) {
      auto bytes = decode_base64(data);
      if (!bytes) error(*uri, "the data URI is no base64", "A-Z, a-z, 0-9, + and /");
      if (bytes) result = std::make_shared<const std::string>(std::move(*bytes));
    } else {
      result = std::make_shared<const std::string>(decode_percent(data));
    }
    return result;
  }
  if (const std::size_t colon = text.find(':'); colon != std::string::npos && text.find('/') == colon + 1) {
    error(*uri, fmt::format("{} is not read over a network", quoted(text)), "a path beside the scene, or a data URI");
    return nullptr;
  }
  const std::string path = decode_percent(text);
  if (leaves_folder(path) && !choices.allow_outside) {
    error(*uri, fmt::format("{} is outside of the scene's folder", quoted(path)),
          "a path below it, or -Dallow_outside=true for what is trusted");
    return nullptr;
  }
  const std::string found = find_file(files, path, {folder_}, place(*uri), {}, diagnostics);
  if (found.empty()) return nullptr;
  std::shared_ptr<const std::string>& file = files_by_path_[found];
  if (!file) {
    std::string reason;
    auto contents = read_counted(files, found, reason);
    if (!contents) {
      error(*uri, fmt::format("cannot read {}: {}", quoted(path, 200), reason), "a file that can be read");
      return nullptr;
    }
    memory.grow(contents->bytes.size());
    file = std::make_shared<const std::string>(std::move(contents->bytes));
  }
  return result = file;
}

std::optional<std::string_view> Asset::view(const Json& buffer_view) {
  const Json* object = referred(buffer_view, "buffer", "buffers");
  if (!object) {
    if (!buffer_view.find("buffer")) error(buffer_view, "the buffer view has no 'buffer'", "an index");
    return std::nullopt;
  }
  std::string_view bytes;
  if (object->find("uri")) {
    const auto data = resource(*object);
    if (!data) {
      if (!diagnostics.has_errors()) error(*object, "the buffer cannot be read", "data");
      return std::nullopt;
    }
    bytes = *data;
  } else if (has_binary_) {
    bytes = binary_;
  } else if (extension(*object, "EXT_meshopt_compression") || extension(*object, "KHR_meshopt_compression")) {
    error(*object, "buffers that hold nothing but what EXT_meshopt_compression packs are not supported",
          "a file without that extension");
    return std::nullopt;
  } else {
    error(*object, "the buffer has no 'uri', and there is no chunk BIN", "one of them");
    return std::nullopt;
  }
  const std::size_t offset = whole(buffer_view, "byteOffset", 0), length = whole(buffer_view, "byteLength", 0);
  const std::size_t told = std::min(whole(*object, "byteLength", 0), bytes.size());
  if (offset > told || length > told - offset) {
    error(buffer_view,
          fmt::format("the buffer view goes from byte {} to {} of a buffer that has {}", offset, offset + length, told),
          fmt::format("up to {}", told));
    return std::nullopt;
  }
  return bytes.substr(offset, length);
}

void give(Node& node, std::string name, Property::Value value, const SourceLocation& place) {
  node.set(name, std::move(value));
  for (Property& property : node.properties) {
    if (property.name == name) property.location = property.name_location = place;
  }
}

Node make_node(std::string kind, std::string plugin, const SourceLocation& place) {
  Node node(std::move(kind), std::move(plugin));
  node.location = node.plugin_location = place;
  return node;
}

}  // namespace norrsken::gltf
