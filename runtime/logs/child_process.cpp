// SPDX-License-Identifier: MIT
#include "runtime/logs/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>

#include "runtime/logs/log_error.h"

namespace dyngen::runtime {
namespace {

constexpr std::uint64_t kChildMemory = std::uint64_t{4} << 30;  ///< bytes beyond the parent's
constexpr std::uint64_t kChildSeconds = 30;
constexpr std::uint64_t kChildBytesPerSecond = 4'000'000;  ///< slower than any reader on any disk

/// Bytes of address space that this process has.
std::uint64_t address_space() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t pages = 0;
  statm >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void bound(int resource, std::uint64_t most) {
  rlimit limit{};
  if (getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) != 0) return;
  if (limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur > most) limit.rlim_cur = most;
  setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// What the child does; it never returns.
[[noreturn]] void run_child(int answer, std::uint64_t bytes, const std::function<void()>& work) {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
  bound(RLIMIT_AS, address_space() + kChildMemory);
  bound(RLIMIT_CPU, kChildSeconds + bytes / kChildBytesPerSecond);
  bound(RLIMIT_CORE, 0);
  constexpr int kDone = 0, kTold = 1;
  int code = kTold;
  try {
    work();
    code = kDone;
  } catch (const std::bad_alloc&) {
    write_all(answer, "found a size that needs more memory than there is for it");
  } catch (const std::exception& error) {
    write_all(answer, error.what());
  }
  _exit(code);
}

}  // namespace

void try_in_child(const std::string& file, std::uint64_t bytes, const std::function<void()>& work) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw log_error(file, fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  }
  const pid_t child = fork();
  if (child == 0) run_child(ends[1], bytes, work);
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    throw log_error(file, fmt::format("cannot start a process: {}", std::strerror(errno)));
  }
  std::string answer;
  std::array<char, 4096> piece;
  for (;;) {
    const ssize_t got = read(ends[0], piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    answer.append(piece.data(), static_cast<std::size_t>(got));
  }
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    throw log_error(file,
                    "found no end of it in the time that such a file may take: it is damaged");
  }
  if (!answer.empty()) {
    const std::string begin = file + ": error: ";
    throw answer.starts_with(begin) ? LogError(answer) : log_error(file, answer);
  }
  throw log_error(file, "found a file on which the library of its format stops: it is damaged");
}

}  // namespace dyngen::runtime
