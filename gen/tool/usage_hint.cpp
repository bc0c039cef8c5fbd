// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/tool/usage_hint.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include "gen/diagnostic/diagnostic.h"
#include "gen/words/spelling.h"

namespace dyngen {
namespace {

/// "--json" or "-o", and no negative number.
bool is_option(std::string_view word) {
  if (word.size() < 2 || word[0] != '-' || word == "--") return false;
  return std::isdigit(static_cast<unsigned char>(word[1])) == 0 && word[1] != '.';
}

/// Names of a command's options, without dashes.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const auto& own : {option->get_lnames(), option->get_snames()}) {
      names.insert(names.end(), own.begin(), own.end());
    }
  }
  return names;
}

std::vector<std::string> command_names(const CLI::App& tool) {
  std::vector<std::string> names;
  for (const CLI::App* command : tool.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string nearest(const std::string& word, const std::vector<std::string>& names) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  return std::string(nearest_word(word, views));
}

/// About a word that is no option of the command; empty: it is one, or nothing is near it.
std::string option_message(const CLI::App& command, const std::string& word) {
  const std::vector<std::string> names = option_names(command);
  std::string name = word.substr(word.find_first_not_of('-'));
  name = name.substr(0, name.find('='));
  const bool short_one = word[1] != '-';
  const bool known = contains(names, name) && short_one == (name.size() == 1);
  if (name.empty() || known) return "";
  if (short_one && contains(names, name.substr(0, 1))) return "";  // "-oFILE"
  const std::string near = nearest(name, names);
  if (near.empty()) return "";
  return "unknown option '" + printable(word) + "'; did you mean '" +
         (near.size() > 1 ? "--" : "-") + near + "'?";
}

std::string command_message(const CLI::App& tool, const std::string& word) {
  const std::vector<std::string> names = command_names(tool);
  const std::string near = nearest(word, names);
  std::string message = "unknown command '" + printable(word) + "'; ";
  if (!near.empty()) return message + "did you mean '" + near + "'?";
  for (const std::string& name : names) {
    message += (name == names.front() ? "expected " : name == names.back() ? " or " : ", ") + name;
  }
  return message;
}

}  // namespace

std::string usage_message(const CLI::App& tool, int argc, const char* const* argv,
                          const std::string& refused) {
  const CLI::App* command = &tool;
  const bool has_commands = !command_names(tool).empty();
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (is_option(word)) {
      std::string message = option_message(*command, word);
      if (!message.empty()) return message;
    } else if (has_commands && command == &tool) {
      if (!contains(command_names(tool), word)) return command_message(tool, word);
      command = tool.get_subcommand(word);
    }
  }
  return refused;
}

}  // namespace dyngen
