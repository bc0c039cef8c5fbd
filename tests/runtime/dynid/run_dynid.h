// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// dynid as its users call it.
namespace dyngen::test {

struct Outcome {
  int exit_code = -1;
  std::string out;  ///< standard output and error together
};

/// @param arguments    as in a shell
/// @param environment  variables for it alone: "PATH= A=1"
Outcome dynid(const std::string& arguments, const std::string& environment = "");

/// Any call of the shell.
Outcome run_shell(const std::string& call);

/// All of a file; empty if there is none.
std::string content(const std::string& path);

}  // namespace dyngen::test
