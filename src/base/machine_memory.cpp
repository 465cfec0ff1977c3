#include "base/machine_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include "norrsken/memory.h"

namespace norrsken {
namespace {

constexpr std::uint64_t kUnlimited = MemoryBudget::kUnlimited;

/// Files that tell how a control group stands.
struct GroupFiles {
  const char *folder, *limit, *usage;
  const char* reclaimable[2];  ///< file cache that has been read once, and more often
};
constexpr GroupFiles kVersion1{"sys/fs/cgroup/memory",
                               "memory.limit_in_bytes",
                               "memory.usage_in_bytes",
                               {"total_inactive_file ", "total_active_file "}};
constexpr GroupFiles kVersion2{"sys/fs/cgroup", "memory.max", "memory.current", {"inactive_file ", "active_file "}};

std::string contents_of(const std::string& path) {
  const std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

/// Empty for words, "max" among them.
std::optional<std::uint64_t> leading_number(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  std::uint64_t value = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc()) return std::nullopt;
  return value;
}

/// The number behind `name` at the beginning of a line.
std::optional<std::uint64_t> number_named(std::string_view text, std::string_view name) {
  for (std::size_t at = 0; at < text.size(); at = std::min(text.find('\n', at), text.size() - 1) + 1) {
    const std::string_view line = text.substr(at);
    if (line.starts_with(name)) return leading_number(line.substr(name.size()));
  }
  return std::nullopt;
}

/// What one group has left.
std::uint64_t left_in(const std::string& folder, const GroupFiles& files) {
  const auto limit = leading_number(contents_of(folder + files.limit));
  if (!limit) return kUnlimited;
  const std::uint64_t usage = leading_number(contents_of(folder + files.usage)).value_or(0);
  const std::string statistics = contents_of(folder + "memory.stat");
  std::uint64_t cache = 0;
  for (const char* name : files.reclaimable) cache += number_named(statistics, name).value_or(0);
  const std::uint64_t held = usage - std::min(cache, usage);
  return *limit - std::min(held, *limit);
}

/// What the group at `path` and those around it have left. Within a container the path may be that of outside, and what
/// is seen begins with the container's own group: folders that are not there are passed over.
std::uint64_t left_of_path(const std::string& root, std::string path, const GroupFiles& files) {
  std::uint64_t left = kUnlimited;
  for (;;) {
    left = std::min(left, left_in(root + files.folder + path + "/", files));
    if (path.empty()) return left;
    path.resize(std::min(path.rfind('/'), path.size() - 1));
  }
}

bool lists_memory(std::string_view controllers) {
  for (std::size_t at = 0; at <= controllers.size();) {
    const std::size_t end = std::min(controllers.find(',', at), controllers.size());
    if (controllers.substr(at, end - at) == "memory") return true;
    at = end + 1;
  }
  return false;
}

/// Lines of /proc/self/cgroup are NUMBER:CONTROLLERS:PATH, without controllers in version 2.
std::uint64_t left_in_groups(const std::string& root) {
  std::uint64_t left = kUnlimited;
  std::istringstream lines(contents_of(root + "proc/self/cgroup"));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string_view controllers = std::string_view(line).substr(first + 1, second - first - 1);
    std::string path = line.substr(second + 1);
    if (path == "/") path.clear();
    if (controllers.empty()) left = std::min(left, left_of_path(root, path, kVersion2));
    if (lists_memory(controllers)) left = std::min(left, left_of_path(root, path, kVersion1));
  }
  return left;
}

struct ProcessPages {
  std::uint64_t mapped = 0, resident = 0;
};
ProcessPages process_pages() {
  ProcessPages pages;
  std::istringstream text(contents_of("/proc/self/statm"));
  text >> pages.mapped >> pages.resident;
  return pages;
}

std::uint64_t page_bytes() { return static_cast<std::uint64_t>(std::max(sysconf(_SC_PAGE_SIZE), 1L)); }

}  // namespace

std::uint64_t available_memory(const std::string& root) {
  const auto kibibytes = number_named(contents_of(root + "proc/meminfo"), "MemAvailable:");
  const std::uint64_t machine = kibibytes ? *kibibytes * 1024 : kUnlimited;
  return std::min(machine, left_in_groups(root));
}

std::uint64_t available_address_space() {
  struct rlimit limit {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
  const std::uint64_t mapped = process_pages().mapped * page_bytes();
  return limit.rlim_cur - std::min<std::uint64_t>(mapped, limit.rlim_cur);
}

std::uint64_t resident_memory() { return process_pages().resident * page_bytes(); }

}  // namespace norrsken
