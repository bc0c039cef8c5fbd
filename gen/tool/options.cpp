// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/tool/options.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "gen/emit_script/emit_matlab.h"
#include "gen/tool/output_files.h"
#include "gen/tool/robot_options.h"
#include "gen/tool/usage_hint.h"
#include "gen/tool/wrench_words.h"

namespace dyngen {
namespace {

bool is_source_name(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".c" || ending == ".cc" || ending == ".cpp" || ending == ".cxx";
}

/// What the words of an option stand for.
template <class Value>
Value meaning(const std::string& option, const std::string& word,
              const std::vector<std::pair<std::string, Value>>& meanings) {
  std::string expected;
  for (const auto& [name, value] : meanings) {
    if (name == word) return value;
    expected += (expected.empty() ? "" : " or ") + name;
  }
  throw std::invalid_argument(option + ": '" + word + "' is unknown; expected " + expected);
}

/// No file may be written over another one of the same call.
void check_paths(const ToolOptions& options) {
  std::vector<std::pair<std::string, std::string>> files = {{"the robot file", options.robot.path}};
  if (!options.compare.empty() && !is_same_file(options.compare, options.robot.path)) {
    files.emplace_back("the robot file of --compare", options.compare);
  }
  if (!options.drawing.empty()) files.emplace_back("--drawing", options.drawing);
  if (!options.to_robot.empty()) files.emplace_back("--to-robot", options.to_robot);
  if (!options.to_urdf.empty()) files.emplace_back("--to-urdf", options.to_urdf);
  if (!options.to_mjcf.empty()) files.emplace_back("--to-mjcf", options.to_mjcf);
  if (!options.latex.empty()) files.emplace_back("--latex", options.latex);
  if (!options.numpy.empty()) files.emplace_back("--numpy", options.numpy);
  if (!options.matlab.empty()) files.emplace_back("--matlab", options.matlab);
  if (!options.output.empty()) {
    files.emplace_back("-o", options.output);
    files.emplace_back("the header", options.header());
  }
  if (options.output.find_first_of("\"\\\n") != std::string::npos) {
    throw std::invalid_argument(
        "-o: a file name with quotes, backslashes or line ends cannot be included");
  }
  if (options.generator.cpp_wrapper) files.emplace_back("the C++ header", options.wrapper());
  if (!options.depfile.empty()) files.emplace_back("--depfile", options.depfile);
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (is_same_file(files[i].second, files[k].second)) {
        throw std::invalid_argument(files[i].first + " and " + files[k].first +
                                    " are the same file: '" + files[i].second + "'");
      }
    }
  }
}

/// An output file has the ending of its kind, and a name that its language can call.
void check_ending(const char* option, const std::string& path, const char* ending,
                  std::string (*why_no_name)(const std::string&) = nullptr) {
  if (path.empty()) return;
  const std::filesystem::path file(path);
  if (file.extension().string() != ending) {
    throw std::invalid_argument(std::string(option) + ": '" + path + "': expected a file name in " +
                                ending);
  }
  const std::string reason = why_no_name == nullptr ? "" : why_no_name(file.stem().string());
  if (!reason.empty()) throw std::invalid_argument(std::string(option) + ": " + reason);
}

bool has_work(const ToolOptions& options) {
  return !options.output.empty() || !options.drawing.empty() || options.count || options.explain ||
         !options.latex.empty() || !options.numpy.empty() || !options.matlab.empty() ||
         !options.compare.empty() || !options.eval.empty() || !options.to_robot.empty() ||
         !options.to_urdf.empty() || !options.to_mjcf.empty();
}

void check(ToolOptions& options) {
  if (options.robot.empty()) {  // among the words of a state
    for (auto word = options.eval.begin(); word != options.eval.end(); ++word) {
      if (word->find('=') != std::string::npos || !std::filesystem::exists(*word)) continue;
      options.robot.path = *word;
      options.eval.erase(word);
      break;
    }
  }
  if (options.robot.empty()) throw std::invalid_argument("robot is required");
  if (!has_work(options)) {
    throw std::invalid_argument(
        "nothing to do: give -o FILE, --count, --explain, --drawing FILE, --eval q=..., --compare "
        "FILE, --latex FILE, --numpy FILE, --matlab FILE, --to-robot FILE, --to-urdf FILE or "
        "--to-mjcf FILE");
  }
  check_ending("--latex", options.latex, ".tex");
  check_ending("--numpy", options.numpy, ".py", why_no_python_name);
  check_ending("--matlab", options.matlab, ".m", why_no_matlab_name);
  check_ending("--to-robot", options.to_robot, ".robot");
  check_ending("--to-urdf", options.to_urdf, ".urdf");
  check_ending("--to-mjcf", options.to_mjcf, ".xml");
  if (!options.drawing.empty() &&
      std::filesystem::path(options.drawing).extension().string() != ".svg") {
    throw std::invalid_argument("--drawing: '" + options.drawing +
                                "' is not a drawing; expected .svg");
  }
  if (!options.output.empty() && !is_source_name(options.output)) {
    throw std::invalid_argument("-o: '" + options.output +
                                "' is not a source file; expected .c, .cc, .cpp or .cxx");
  }
  if (!options.depfile.empty() && options.output.empty()) {
    throw std::invalid_argument("--depfile needs -o FILE");
  }
  if (options.generator.cpp_wrapper && options.output.empty()) {
    throw std::invalid_argument("--cpp-wrapper needs -o FILE");
  }
  check_paths(options);
  if (!options.output.empty()) {
    options.generator.header_name = std::filesystem::path(options.header()).filename().string();
  }
  options.generator.validate();
}

/// Words of the command line that stand for something else.
struct OptionWords {
  std::string parameters = "baked";
  std::string scalar = "double";
  std::string trig;
  std::string gravity = "file";
  bool keep_standard = false;
};

/// What is written, and how the code looks.
void add_code_options(CLI::App& app, ToolOptions& options, OptionWords& words) {
  app.add_option("-o,--output", options.output,
                 "C or C++ source to write; the header is written beside it")
      ->type_name("FILE");
  app.add_option("--functions", options.generator.functions,
                 "Functions to write (default: all for one sample): " + catalogue_names() +
                     "; with _batch: for many samples, structure of arrays; all: both")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME,...");
  app.add_option("--parameters", words.parameters,
                 "baked: the file's numbers stand in the code (default); runtime: they are read "
                 "from an argument chi[]. Unknown ones ('*') are always read from chi[]")
      ->type_name("baked|runtime");
  app.add_option("--scalar", words.scalar, "Arithmetic of the code (default: double)")
      ->type_name("double|float");
  app.add_option("--trig", words.trig,
                 "Sines and cosines: inline, all angles at once in the code (default), "
                 "or libm, calls of the C library")
      ->type_name("inline|libm");
  app.add_option("--prefix", options.generator.prefix,
                 "Begins every external name (default: the robot's name)")
      ->type_name("NAME");
  app.add_flag("--no-regroup", words.keep_standard,
               "Keep the standard parameters; by default they are regrouped to base parameters");
  app.add_flag(
      "--fold", options.generator.fold,
      "Functions read folded[] in place of chi[]: what depends on parameters alone, worked "
      "out by one more function, fold, when chi has changed (with --parameters runtime)");
}

/// What the code takes as arguments, and what is written with it.
void add_argument_options(CLI::App& app, ToolOptions& options, OptionWords& words) {
  app.add_option("--gravity", words.gravity,
                 "file: the file's (default); runtime: an argument gravity[3], m/s^2: the "
                 "acceleration of the base, -g, in frame 0")
      ->type_name("file|runtime");
  app.add_flag("--wrench", options.wrench,
               "An argument wrench[6]: force (N) and moment (N m) about its origin that act on the "
               "last link, in its frame; --wrench LINK: on this link, by number or joint name");
  app.add_flag("--payload", options.generator.payload,
               "An argument payload[10]: XX XY XZ YY YZ ZZ MX MY MZ M of a body on the last link, "
               "in its frame");
  app.add_option("--search", options.generator.search.work,
                 "How much work to spend on fewer operations, for each function (default: " +
                     std::to_string(SearchOptions().work) +
                     ", about half a second; 0: shared subexpressions only)")
      ->type_name("WORK");
  app.add_flag("--cpp-wrapper", options.generator.cpp_wrapper,
               "Write a C++20 header beside the C one (.hpp): the functions over Eigen's types");
  app.add_option("--effects", options.effect_folders,
                 "Folder of more effects, files NAME.effect; may stand several times")
      ->allow_extra_args(false)
      ->type_name("DIR");
  app.add_option("--depfile", options.depfile,
                 "Write a Make rule that names the robot file and effect files")
      ->type_name("FILE");
}

/// What is said of the robot, and in which other forms it is written.
void add_report_options(CLI::App& app, ToolOptions& options) {
  app.add_flag("--count", options.count,
               "Print multiplications and additions beside the bounds 105n-92 and 94n-86");
  app.add_flag("--explain", options.explain,
               "Print what was read in words, where every axis stands, the base parameters with "
               "their formulas, and what cannot be identified");
  app.add_option("--drawing", options.drawing,
                 "Draw the arm and the frames of its links (.svg), at zero or what is stated there")
      ->type_name("FILE");
  app.add_option("--to-robot", options.to_robot,
                 "Write the robot as a robot file (.robot): what was made of URDF, MJCF or .par")
      ->type_name("FILE");
  app.add_option("--to-urdf", options.to_urdf, "Write the robot as URDF (.urdf)")
      ->type_name("FILE");
  app.add_option("--to-mjcf", options.to_mjcf, "Write the robot as MJCF (.xml)")->type_name("FILE");
  app.add_option(
         "--eval", options.eval,
         "Print torque and its parts, poses and mass matrix at q=..., and dq=... ddq=... (0 "
         "where left out): values for the moving joints, commas between, expressions as in "
         "robot files; XX2=... gives a number that the file leaves unknown")
      ->type_name("q=Q,...");
  app.add_option("--compare", options.compare,
                 "Print where the robot of another file differs: torque, its parts, joint axes")
      ->type_name("FILE");
}

/// The functions in other languages.
void add_language_options(CLI::App& app, ToolOptions& options) {
  app.add_option("--latex", options.latex,
                 "Write table of joints, base parameters and equations as LaTeX (.tex)")
      ->type_name("FILE");
  app.add_option("--numpy", options.numpy, "Write the functions as a Python module (.py)")
      ->type_name("FILE");
  app.add_option("--matlab", options.matlab,
                 "Write the functions as a MATLAB or Octave function file (.m)")
      ->type_name("FILE");
}

void take_words(const OptionWords& words, ToolOptions& options) {
  options.generator.wrench = !options.wrench.empty();
  options.generator.parameters = meaning<ParameterMode>(
      "--parameters", words.parameters,
      {{"baked", ParameterMode::kBaked}, {"runtime", ParameterMode::kRuntime}});
  options.generator.scalar = meaning<Scalar>(
      "--scalar", words.scalar, {{"double", Scalar::kDouble}, {"float", Scalar::kFloat}});
  options.generator.trig = meaning<Trig>("--trig", words.trig.empty() ? "inline" : words.trig,
                                         {{"inline", Trig::kInline}, {"libm", Trig::kLibm}});
  options.generator.gravity =
      meaning<bool>("--gravity", words.gravity, {{"file", false}, {"runtime", true}});
  options.generator.regroup = !words.keep_standard;
}

}  // namespace

std::string ToolOptions::header() const {
  return std::filesystem::path(output).replace_extension(".h").string();
}

std::string ToolOptions::wrapper() const {
  return std::filesystem::path(output).replace_extension(".hpp").string();
}

ParsedOptions parse_options(int argc, const char* const* argv) {
  ParsedOptions parsed;
  ToolOptions& options = parsed.options;
  OptionWords words;
  CLI::App app("dyngen: a robot file in, its dynamics as straight-line C out", "dyngen");
  app.set_version_flag("--version", "dyngen " DYNGEN_VERSION);
  add_robot(app, options.robot, "Robot")->required(false);  // it may stand among words of --eval
  add_code_options(app, options, words);
  add_argument_options(app, options, words);
  add_report_options(app, options);
  add_language_options(app, options);
  app.footer(
      "Examples:\n"
      "  dyngen arm.robot -o arm.c\n"
      "  dyngen panda.urdf --tip link8 -o panda.c\n"
      "  dyngen arm.robot --to-urdf arm.urdf");
  const std::vector<std::string> line = with_joined_wrench(argc, argv);
  try {
    app.parse(std::vector<std::string>(line.rbegin(), line.rend() - 1));  // CLI11 reads backwards
    take_words(words, options);
    if (app.count("--prefix") > 0 && options.generator.prefix.empty()) {
      throw std::invalid_argument("--prefix: it is empty; expected a C identifier");
    }
    check(options);
  } catch (const CLI::Success& success) {
    parsed.exit_code = app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::cerr << "dyngen: " << usage_message(app, argc, argv, error.what())
              << "\nRun 'dyngen --help' for the options.\n";
    parsed.exit_code = kUsage;
  } catch (const std::invalid_argument& error) {
    std::cerr << "dyngen: " << error.what() << "\nRun 'dyngen --help' for the options.\n";
    parsed.exit_code = kUsage;
  }
  return parsed;
}

}  // namespace dyngen
