// SPDX-License-Identifier: MIT
#include "tests/runtime/dynid/run_dynid.h"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace dyngen::test {

Outcome dynid(const std::string& arguments, const std::string& environment) {
  // sentences in one piece, unless the caller asks for another width
  return run_shell("DYNGEN_COLUMNS=100000 " + environment + " " DYNID " " + arguments);
}

Outcome run_shell(const std::string& call) {
  Outcome outcome;
  FILE* pipe = popen((call + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer{};
  for (std::size_t count = 0; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    outcome.out.append(buffer.data(), count);
  }
  outcome.exit_code = WEXITSTATUS(pclose(pipe));
  return outcome;
}

std::string content(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace dyngen::test
