#include <dlfcn.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "formats/image_oiio.h"
#include "norrsken/image.h"

namespace norrsken {
namespace {

namespace fs = std::filesystem;

using Reader = decltype(&norrsken_oiio_read);

/// Loads the module when the first image is read: OpenImageIO brings some 260 libraries, 130 MB and a quarter of a
/// second with it, which a program that only renders should not pay. It is looked for beside the program or library
/// that this code is in, in its installation, and where it was built.
Reader load_reader(std::string& error) {
  Dl_info here{};
  std::vector<fs::path> folders;
  if (dladdr(reinterpret_cast<void*>(&load_reader), &here) != 0 && here.dli_fname != nullptr) {
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
    if (void* module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL)) {
      if (void* entry = dlsym(module, "norrsken_oiio_read")) return reinterpret_cast<Reader>(entry);
    }
    if (const char* text = dlerror()) error = text;
  }
  if (error.empty()) error = std::string("the module ") + NORRSKEN_OIIO_MODULE + " is not installed";
  return nullptr;
}

IoStatus failure(const std::string& path, const std::string& reason) {
  return {"cannot read '" + path + "': " + reason};
}

}  // namespace

IoStatus read_image(const std::string& path, Image& image) {
  if (path.find('\0') != std::string::npos) return failure(path, "not a file name");
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status)) return failure(path, code ? code.message() : "no such file");
  if (fs::is_directory(status)) return failure(path, "it is a folder");
  if (!fs::is_regular_file(status)) return failure(path, "it is not a regular file");

  static std::string load_error;
  static const Reader reader = load_reader(load_error);
  if (reader == nullptr) return failure(path, load_error);
  Image read;
  std::string error;
  if (!reader(path, read, error)) return failure(path, error);
  image = std::move(read);
  return {};
}

}  // namespace norrsken
