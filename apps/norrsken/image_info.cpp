#include "image_info.h"

#include <fmt/format.h>

#include <algorithm>

#include "console.h"
#include "norrsken/image.h"
#include "session.h"

namespace norrsken::cli {

ExitStatus print_image_info(const std::string& path, bool json) {
  ImageHeader header;
  if (const IoStatus status = read_image_header(path, header); !status)
    throw Failure(unreadable_input_status(path), status.error);
  if (json) {
    print_json({{"image", path},
                {"format", header.format},
                {"width", header.width},
                {"height", header.height},
                {"channels", header.channels},
                {"metadata", Json::object(header.metadata)}});
    return ExitStatus::done;
  }
  print_line(path);
  print_line(fmt::format("  {}, {} x {} pixels", header.format, header.width, header.height));
  print_line(fmt::format("  channels {}", fmt::join(header.channels, ", ")));
  std::size_t width = 0;
  for (const auto& [name, text] : header.metadata) width = std::max(width, name.size());
  for (const auto& [name, text] : header.metadata) print_line(fmt::format("  {:<{}}  {}", name, width, text));
  if (header.metadata.empty()) print_line("  it does not say how it was made");
  return ExitStatus::done;
}

}  // namespace norrsken::cli
