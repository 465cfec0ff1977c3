#include <dlfcn.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/regular_file.h"
#include "formats/image_oiio.h"
#include "formats/raster_image.h"
#include "norrsken/image.h"

namespace norrsken {
namespace {

namespace fs = std::filesystem;

/// Loads the module when the first image is read that is not a RasterImage: OpenImageIO brings some 260 libraries, 130 MB and a quarter of a
/// second with it, which a program that only renders should not pay. It is looked for beside the program or library
/// that this code is in, in its installation, and where it was built.
void* load_module(std::string& error) {
  Dl_info here{};
  std::vector<fs::path> folders;
  if (dladdr(reinterpret_cast<void*>(&load_module), &here) != 0 && here.dli_fname != nullptr) {
    std::error_code code;
    const fs::path program = fs::canonical(here.dli_fname, code);
    if (!code) folders = {program.parent_path(), program.parent_path() / NORRSKEN_MODULE_FOLDER_FROM_BIN};
  }
  folders.emplace_back(NORRSKEN_MODULE_BUILD_FOLDER);
  for (const fs::path& folder : folders) {
    const fs::path file = folder / NORRSKEN_OIIO_MODULE;
    std::error_code code;
    if (!fs::exists(file, code)) continue;
    // Never closed: the libraries behind it are not made for that.
    if (void* module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL)) return module;
    if (const char* text = dlerror()) error = text;
  }
  if (error.empty()) error = std::string("the module ") + NORRSKEN_OIIO_MODULE + " is not installed";
  return nullptr;
}

/// An entry of the module, or nullptr with `error` set.
template <class Entry>
Entry* find_entry(const char* name, std::string& error) {
  static std::string load_error;
  static void* const module = load_module(load_error);
  void* entry = module ? dlsym(module, name) : nullptr;
  if (entry == nullptr) error = module ? std::string(NORRSKEN_OIIO_MODULE) + " is of another version" : load_error;
  return reinterpret_cast<Entry*>(entry);
}

IoStatus failure(const std::string& path, const std::string& reason) {
  return {"cannot read '" + path + "': " + reason};
}

}  // namespace

IoStatus read_image(const std::string& path, Image& image, std::uint64_t most_bytes) {
  std::string error;
  const auto contents = read_regular_file(path, error, most_bytes);
  if (!contents) {
    const bool is_about_file = error.starts_with("is ") || error.starts_with("does ") || error.starts_with("claims ");
    return failure(path, (is_about_file ? "it " : "") + error);
  }

  const std::uint64_t left = most_bytes - std::min<std::uint64_t>(most_bytes, contents->size());
  Image read;
  if (is_raster_image(*contents)) {
    error = read_raster_image(*contents, left, read);
  } else {
    auto* reader = find_entry<decltype(norrsken_oiio_read)>("norrsken_oiio_read", error);
    if (reader != nullptr) reader(path, *contents, left, read, error);
  }
  if (!error.empty()) return failure(path, error);
  image = std::move(read);
  return {};
}

Result<Image> read_image(const std::string& path, const std::shared_ptr<MemoryBudget>& memory) {
  Image image;
  const IoStatus status = read_image(path, image, (memory ? memory : MemoryBudget::of_machine())->left());
  return status ? Result<Image>(std::move(image)) : Result<Image>::failure(status.error);
}

std::string read_texels(const std::string& path, const std::string& contents, TexelImage& image) {
  std::string error;
  TexelImage read;
  if (is_raster_image(contents)) {
    error = read_raster_texels(contents, read);
    if (error.empty()) image = std::move(read);
    return error;
  }
  auto* reader = find_entry<decltype(norrsken_oiio_read_texels)>("norrsken_oiio_read_texels", error);
  std::exception_ptr out_of_memory;
  if (reader != nullptr && reader(path, contents, read, error, out_of_memory)) image = std::move(read);
  if (out_of_memory) std::rethrow_exception(out_of_memory);
  return error;
}

}  // namespace norrsken
