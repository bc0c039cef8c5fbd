// SPDX-License-Identifier: MIT
// blind_sealed_run CASE ANSWERS DYNID ARGUMENT...: runs dynid where it can read the case, its own
// program and the system's libraries, and write the answers, and nothing else: neither what is in
// the cases nor what made them. By Linux's Landlock, which any user may use and no one can undo.
#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

namespace {

constexpr std::uint64_t kRead = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t kRun = kRead | LANDLOCK_ACCESS_FS_EXECUTE;
constexpr std::uint64_t kWrite = kRead | LANDLOCK_ACCESS_FS_WRITE_FILE |
                                 LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_REMOVE_FILE;

bool allow(int rules, const std::string& path, std::uint64_t access) {
  const int place = open(path.c_str(), O_PATH | O_CLOEXEC);
  if (place < 0) return errno == ENOENT;
  landlock_path_beneath_attr rule{};
  rule.allowed_access = access;
  if (!std::filesystem::is_directory(path)) rule.allowed_access &= ~LANDLOCK_ACCESS_FS_READ_DIR;
  rule.parent_fd = place;
  const bool done =
      syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0;
  close(place);
  return done;
}

/// From here on this process, and what it becomes, can do no more than the rules say.
bool seal(const std::string& folder, const std::string& answers, const std::string& program) {
  landlock_ruleset_attr attributes{};
  attributes.handled_access_fs = kRun | kWrite | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                                 LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_SYM;
  const int rules =
      static_cast<int>(syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0));
  if (rules < 0) return false;
  for (const char* const system : {"/usr", "/lib", "/lib64"}) {
    if (!allow(rules, system, kRun)) return false;
  }
  for (const char* const file : {"/etc/ld.so.cache", "/dev/null", "/dev/urandom"}) {
    if (!allow(rules, file, LANDLOCK_ACCESS_FS_READ_FILE)) return false;
  }
  return allow(rules, program, kRun) && allow(rules, folder, kRead) &&
         allow(rules, answers, kWrite) && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         syscall(SYS_landlock_restrict_self, rules, 0) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr, "usage: %s CASE ANSWERS DYNID ARGUMENT...\n", argv[0]);
    return 2;
  }
  const std::string program = std::filesystem::canonical(argv[3]);
  const bool there = chdir(argv[1]) == 0;
  if (!there || !seal(".", argv[2], program)) {
    std::fprintf(stderr, "cannot seal the run: %s (Landlock: Linux 5.13 or later)\n",
                 std::strerror(errno));
    const char* const unsealed = std::getenv("UNSEALED");
    if (!there || unsealed == nullptr || std::strcmp(unsealed, "allowed") != 0) return 3;
  }
  execv(program.c_str(), argv + 3);
  std::fprintf(stderr, "cannot run %s: %s\n", program.c_str(), std::strerror(errno));
  return 127;
}
