#include "tests/process.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace norrsken::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct Channel {
  int read_end = -1, write_end = -1;
};

Channel open_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("pipe2 failed");
  return {ends[0], ends[1]};
}

Channel open_terminal() {
  Channel channel;
  winsize size{};
  size.ws_row = 24;
  size.ws_col = 80;
  if (openpty(&channel.read_end, &channel.write_end, nullptr, nullptr, &size) != 0)
    throw std::runtime_error("openpty failed");
  return channel;
}

[[noreturn]] void become_program(const std::vector<std::string>& arguments, const ProcessOptions& options, int out,
                                 int err) {
  // The tests' own terminal must not decide what is tested.
  unsetenv("NO_COLOR");
  setenv("TERM", "xterm", 1);
  for (const std::string& entry : options.environment) putenv(const_cast<char*>(entry.c_str()));
  if (options.largest_file > 0) {
    const rlimit limit{options.largest_file, options.largest_file};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (options.processor_seconds > 0) {
    const rlimit limit{options.processor_seconds, options.processor_seconds};
    setrlimit(RLIMIT_CPU, &limit);
  }
  if (options.address_space > 0) {
    const rlimit limit{options.address_space, options.address_space};
    setrlimit(RLIMIT_AS, &limit);
  }
  if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(126);
  if (!options.stdout_file.empty()) out = open(options.stdout_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  std::vector<char*> argv = {const_cast<char*>(NORRSKEN_PROGRAM)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(NORRSKEN_PROGRAM, argv.data());
  _exit(127);
}

}  // namespace

ProcessResult run_program(const std::vector<std::string>& arguments, const ProcessOptions& options) {
  const Channel out = open_pipe(), err = options.terminal ? open_terminal() : open_pipe();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) become_program(arguments, options, out.write_end, err.write_end);
  close(out.write_end);
  close(err.write_end);

  ProcessResult result;
  const auto start = Clock::now();
  auto next_signal = start + options.signal_delay;
  std::size_t signals_sent = 0;
  bool is_time = !options.signal_when;
  std::array<pollfd, 2> files = {{{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}}};
  while (files[0].fd >= 0 || files[1].fd >= 0) {
    constexpr std::chrono::milliseconds kLongest(20);
    const auto wait = signals_sent < options.signals.size()
                          ? std::chrono::duration_cast<std::chrono::milliseconds>(next_signal - Clock::now())
                          : kLongest;
    poll(files.data(), files.size(), static_cast<int>(std::clamp<std::int64_t>(wait.count(), 0, kLongest.count())));
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (files[i].fd < 0 || files[i].revents == 0) continue;
      std::array<char, 4096> buffer;
      const ssize_t count = read(files[i].fd, buffer.data(), buffer.size());
      if (count > 0)
        (i == 0 ? result.out : result.err).append(buffer.data(), static_cast<std::size_t>(count));
      else  // a terminal reports an error where a pipe reports its end
        files[i].fd = -1;
    }
    const auto now = Clock::now();
    if (!is_time && options.signal_when()) is_time = true, next_signal = now;
    if (is_time && signals_sent < options.signals.size() && now >= next_signal) {
      kill(child, options.signals[signals_sent++]);
      next_signal = now + options.signal_delay;
    }
    if (now - start > std::chrono::minutes(2)) kill(child, SIGKILL);
  }
  close(out.read_end);
  close(err.read_end);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  result.peak_memory = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

}  // namespace norrsken::cli
