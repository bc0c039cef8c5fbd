// SPDX-License-Identifier: GPL-2.0-or-later
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "gen/diagnostic/assert.h"
#include "gen/explain/explain.h"
#include "gen/generator/generator.h"
#include "gen/model/robot_model.h"
#include "gen/robot_file/robot_file.h"
#include "gen/tool/options.h"
#include "gen/tool/output_files.h"
#include "gen/tool/progress_line.h"

namespace dyngen {
namespace {

constexpr int kDone = 0, kInputWrong = 1, kUsage = 2, kOurBug = 70;

void print_warnings(const RobotFile& file, const RobotModel& model) {
  Diagnostics diagnostics(file.file_name, file.text);
  for (const Diagnostic& warning : file.warnings) {
    diagnostics.warning(warning.position, warning.length, warning.message, warning.hint);
  }
  for (const EffectRow& effect : model.effects) {
    diagnostics.warning(
        effect.position, static_cast<int>(effect.name.size()),
        "effect '" + effect.name + "' is read but not part of the emitted functions");
  }
  std::cerr << diagnostics.render();
}

void print(const std::string& text) {
  std::cout << text << std::flush;
  if (!std::cout) throw OutputError("standard output: error: cannot write");
}

/// What is asked for does not go with this robot.
bool report_misuse(const GeneratorOptions& options, const RobotModel& model) {
  try {
    options.validate(model);
    return false;
  } catch (const std::invalid_argument& error) {
    std::cerr << "dyngen: " << error.what() << "\n";
    return true;
  }
}

/// The options with a line of progress. @param line  must outlive them
GeneratorOptions with_progress(GeneratorOptions options, ProgressLine& line) {
  options.progress = [&line](const std::string& name, std::size_t place, std::size_t all) {
    line.show(name, place, all);
  };
  return options;
}

CText generated_text(const RobotModel& model, const GeneratorOptions& options) {
  ProgressLine line("dyngen");
  return generate(model, with_progress(options, line));
}

std::string counted(const RobotModel& model, const GeneratorOptions& options) {
  CodeModel code = make_code_model(model, options);
  ProgressLine line("dyngen");
  return count_table(code, write_functions(code, with_progress(options, line)));
}

int run(const ToolOptions& options) {
  const RobotFile file = read_robot_file(options.robot);
  const RobotModel model = build_model(file);
  if (report_misuse(options.generator, model)) return kUsage;
  print_warnings(file, model);
  if (!options.output.empty()) {
    const CText text = generated_text(model, options.generator);
    std::vector<OutputFile> files = {{options.output, text.source},
                                     {options.header(), text.header}};
    if (options.generator.cpp_wrapper) files.push_back({options.wrapper(), text.wrapper});
    if (!options.depfile.empty()) {
      std::vector<std::string> targets;
      for (const OutputFile& written : files) targets.push_back(written.path);
      files.push_back({options.depfile, depfile_text(targets, options.robot)});
    }
    write_files(files);
  }
  if (options.explain) print(explain(model));
  if (options.count) print(counted(model, options.generator));
  return kDone;
}

int guarded_main(int argc, const char* const* argv) {
  const ParsedOptions parsed = parse_options(argc, argv);
  if (parsed.exit_code >= 0) return parsed.exit_code;
  try {
    return run(parsed.options);
  } catch (const ModelError& error) {
    std::cerr << error.what();
    return kInputWrong;
  } catch (const OutputError& error) {
    std::cerr << error.what() << "\n";
    return kInputWrong;
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << "dyngen: error: " << error.what() << "\n";
    return kInputWrong;
  } catch (const std::exception& error) {
    std::cerr << "dyngen: internal error: " << error.what()
              << "\nThis is a bug of dyngen. Please report it with the file "
              << parsed.options.robot << ".\n";
    return kOurBug;
  }
}

}  // namespace
}  // namespace dyngen

int main(int argc, char** argv) { return dyngen::guarded_main(argc, argv); }
