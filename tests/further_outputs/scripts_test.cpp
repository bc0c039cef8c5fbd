// SPDX-License-Identifier: MIT
// --numpy and --matlab: the scripts compute what the C functions compute, for one sample and for
// many.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "gen/diagnostic/diagnostic.h"
#include "gen/emit_script/emit_matlab.h"
#include "gen/emit_script/emit_numpy.h"
#include "tests/support/compiled_model.h"
#include "tests/support/model_bridge.h"
#include "tests/support/relative_error.h"
#include "tests/support/temporary_path.h"

namespace dyngen::test::scripts_tests {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

constexpr double kTolerance = 1e-12;

constexpr const char* kPythonDriver = R"py(
import json
import numpy as np
import robot

with open("input.json") as file:
    given = json.load(file)
results = {}
for name, function in given["functions"].items():
    call = getattr(robot, name)
    shared = {a: np.array(given["samples"][0][a]) for a in function["shared"]}

    def arguments(pick):
        return {a: shared[a] if a in shared else pick(a) for a in function["inputs"]}

    def shaped(a, value):
        return value.reshape(tuple(function["shapes"][a]) + value.shape[1:])

    single = [call(**arguments(lambda a: shaped(a, np.array(s[a])))) for s in given["samples"]]
    many = call(**arguments(
        lambda a: shaped(a, np.stack([np.array(s[a]) for s in given["samples"]], axis=-1))))
    several = isinstance(many, tuple)

    def of_sample(one, all_samples, i):  # what reads no sample is the same for all
        return all_samples if one.shape == all_samples.shape else all_samples[..., i]

    results[name] = [
        {output: [np.ravel(one[k] if several else one).tolist(),
                  np.ravel(of_sample(one[k] if several else one,
                                     many[k] if several else many, i)).tolist()]
         for k, output in enumerate(function["outputs"])}
        for i, one in enumerate(single)]
with open("output.json", "w") as file:
    json.dump(results, file)
)py";

constexpr const char* kOctaveDriver = R"m(
given = jsondecode(fileread('input.json'));
robot = robot_functions();
names = fieldnames(given.functions);
results = struct();
count = numel(given.samples);
for f = 1:numel(names)
  name = names{f};
  fun = given.functions.(name);
  call = robot.(name);
  as_cell = @(x) x(:)';
  many = {};
  for a = as_cell(fun.inputs)
    values = [];
    for k = 1:count
      s = given.samples(k);
      value = s.(a{1})(:);
      shape = fun.shapes.(a{1})(:)';
      if numel(shape) == 2, value = reshape(value, fliplr(shape)).'; end
      if any(strcmp(a{1}, fun.shared))
        values = value;
      elseif numel(shape) == 2
        values(:, :, k) = value;
      else
        values(:, k) = value;
      end
    end
    many{end + 1} = values;
  end
  outputs = cell(1, numel(fun.outputs));
  [outputs{:}] = call(many{:});
  list = {};
  for k = 1:count
    entry = struct();
    for o = 1:numel(fun.outputs)
      value = outputs{o};
      if fun.matrix(o)  % what reads no sample has one page, or one column
        flat = reshape(value(:, :, min(k, size(value, 3))).', 1, []);
      else
        flat = value(:, min(k, size(value, 2))).';
      end
      entry.(fun.outputs{o}) = {num2cell(flat)};
    end
    list{end + 1} = entry;
  end
  results.(name) = list;
end
file = fopen('output.json', 'w');
fputs(file, jsonencode(results));
fclose(file);
)m";

struct ScriptCase {
  std::string name;
  std::string robot;
  GeneratorOptions options;
};

std::vector<ScriptCase> cases() {
  GeneratorOptions baked;
  GeneratorOptions runtime;
  runtime.parameters = ParameterMode::kRuntime;
  GeneratorOptions arguments = runtime;
  arguments.gravity = arguments.wrench = arguments.payload = true;
  arguments.regroup = false;
  GeneratorOptions folded = runtime;
  folded.fold = true;
  GeneratorOptions weights = runtime;
  weights.functions = {"base_regressor_gradient", "id", "fk_2"};
  GeneratorOptions effects;
  effects.functions = {"id", "effects", "friction"};
  return {{"puma560_baked", "robots/puma560.robot", baked},
          {"scara_runtime", "robots/scara.robot", runtime},
          {"rp_arguments", "tests/robots/rp.robot", arguments},
          {"planar2r_folded", "robots/planar2r.robot", folded},
          {"planar2r_weights", "robots/planar2r.robot", weights},
          {"pendulum_baked", "tests/robots/pendulum.robot", baked},
          {"algebraic_arm", "tests/robots/effects/algebraic_arm.robot", effects}};
}

class Scripts : public testing::TestWithParam<ScriptCase> {
 protected:
  Scripts()
      : model_(read_model(GetParam().robot)),
        options_(with_short_search(GetParam().options)),
        evaluated_(model_, with_random_values(model_, 11), options_),
        folder_(temporary_path("scripts")) {
    std::filesystem::create_directories(folder_);
    samples_ = random_samples(model_.coordinate_count, 4, 5);
    const auto weights =
        static_cast<std::size_t>(model_.coordinate_count) * evaluated_.code().beta.size();
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      for (std::size_t i = 0; i < weights; ++i) {
        samples_[k].weights.push_back(0.01 * static_cast<double>(i * (k + 1)));
      }
    }
    for (MotionSample& sample : samples_) {  // one of each for all
      sample.gravity = samples_[0].gravity;
      sample.payload = samples_[0].payload;
    }
  }
  ~Scripts() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  [[nodiscard]] std::vector<double> folded() const {
    return evaluated_.code().folds() ? evaluated_.call("fold", samples_[0]) : std::vector<double>();
  }

  void write_input() const {
    Json input;
    for (const RobotFunction& function : evaluated_.functions()) {
      Json& entry = input["functions"][function.name];
      entry["shared"] = Json::array();
      entry["inputs"] = Json::array();
      for (const Argument& argument : arguments(*function.spec, evaluated_.code())) {
        if (argument.output) {
          entry["outputs"].push_back(argument.name);
          continue;
        }
        entry["inputs"].push_back(argument.name);
        entry["shapes"][argument.name] =
            argument.columns > 1 ? Json{argument.rows, argument.columns} : Json{argument.size()};
        if (argument.shared) entry["shared"].push_back(argument.name);
      }
      for (const OutputSpec& output : function.spec->outputs) {
        entry["matrix"].push_back(output.columns != Extent::kOne);
      }
    }
    for (const MotionSample& sample : samples_) {
      Json values;
      for (const char* name : {"q", "dq", "ddq", "tau", "gravity", "wrench", "payload", "A", "w"}) {
        values[name] = sample.input(name);
      }
      values["chi"] = evaluated_.chi();
      values["folded"] = folded();
      input["samples"].push_back(values);
    }
    write("input.json", input.dump());
  }

  /// Runs a command that ends well. @return what it prints
  std::string run(const std::string& command) const {
    const std::string line = "cd '" + folder_.string() + "' && " + command + " > words.txt 2>&1";
    const int code = std::system(line.c_str());
    std::ostringstream words;
    words << std::ifstream(folder_ / "words.txt").rdbuf();
    EXPECT_EQ(code, 0) << words.str();
    return words.str();
  }

  void expect_as_compiled() const {
    Json results;
    std::ifstream(folder_ / "output.json") >> results;
    const CompiledModel compiled(model_, options_);
    for (const RobotFunction& function : evaluated_.functions()) {
      for (const OutputSpec& output : function.spec->outputs) {
        const std::string array(output.array);
        RelativeError error;
        error.add(1e-3, 1e-3);  // an output that is zero throughout is judged against 0.001
        for (std::size_t k = 0; k < samples_.size(); ++k) {
          const std::vector<double> expected =
              compiled.call(function.name, samples_[k], evaluated_.chi(), array);
          for (const Json& actual : results.at(function.name).at(k).at(array)) {
            error.add(actual.get<std::vector<double>>(), expected);
          }
        }
        EXPECT_LT(error.value(), kTolerance) << function.name << " " << array;
      }
    }
  }

  RobotModel model_;
  GeneratorOptions options_;
  EvaluatedModel evaluated_;
  std::filesystem::path folder_;
  std::vector<MotionSample> samples_;
};

TEST_P(Scripts, NumpyComputesWhatCComputes) {
  const std::string python = DYNGEN_PYTHON_WITH_NUMPY;
  if (python.empty()) GTEST_SKIP() << "there is no numpy (python3-numpy)";
  write("robot.py", emit_numpy(evaluated_.code(), evaluated_.functions()));
  write("driver.py", kPythonDriver);
  write_input();
  EXPECT_EQ(run(python + " -W error driver.py"), "");
  expect_as_compiled();
}

TEST_P(Scripts, MatlabComputesWhatCComputes) {
  const std::string text =
      emit_matlab(evaluated_.code(), evaluated_.functions(), "robot_functions");
  if (std::system("command -v octave-cli > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "there is no octave";
  }
  write("robot_functions.m", text);
  write("driver.m", kOctaveDriver);
  write_input();
  run("octave-cli --no-gui --norc --quiet driver.m");  // it may have words of its own to say
  expect_as_compiled();
}

INSTANTIATE_TEST_SUITE_P(Robots, Scripts, testing::ValuesIn(cases()),
                         [](const auto& entry) { return entry.param.name; });

TEST(ScriptText, OfMatlabIsWellFormed) {
  const RobotModel model = read_model("robots/puma560.robot");
  GeneratorOptions options;
  options.functions = {"id", "mass_matrix", "com", "external_torque_3"};
  CodeModel code = make_code_model(model, options);
  const std::string text =
      emit_matlab(code, write_functions(code, with_short_search(options)), "puma");
  EXPECT_TRUE(text.starts_with("function robot = puma\n%PUMA The dynamics of puma560"));
  EXPECT_THAT(text, HasSubstr("  robot.id = @f_id;\n"));
  EXPECT_THAT(text, HasSubstr("function tau_out = f_id(q, dq, ddq)\n"));
  EXPECT_THAT(text, HasSubstr("function [p_out, mass_out] = f_com(q)\n"));
  EXPECT_THAT(text, HasSubstr("= sin(q(2, :));"));
  std::istringstream lines(text);
  int open = 0;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 100U) << line;
    if (line.starts_with("function ")) ++open;
    if (line == "end") --open;
    EXPECT_TRUE(line.find(" * ") == std::string::npos || line.starts_with("%") ||
                line.find('%') != std::string::npos)
        << line;
  }
  EXPECT_EQ(open, 0);
}

TEST(ScriptText, OfNumpyFitsAndIsTheSameEveryTime) {
  const RobotModel model = read_model("robots/puma560.robot");
  GeneratorOptions options;
  options.functions = {"id", "mass_matrix"};
  CodeModel code = make_code_model(model, options);
  const auto functions = write_functions(code, with_short_search(options));
  const std::string text = emit_numpy(code, functions);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  CodeModel again = make_code_model(model, options);
  EXPECT_EQ(text, emit_numpy(again, write_functions(again, with_short_search(options))));
}

TEST(ScriptNames, AreThoseThatTheLanguageCanCall) {
  EXPECT_EQ(why_no_matlab_name("puma560"), "");
  for (const char* wrong : {"6dof", "my-robot", "_arm", "end", "", "a b"}) {
    EXPECT_NE(why_no_matlab_name(wrong), "") << wrong;
  }
  EXPECT_NE(why_no_matlab_name(std::string(64, 'a')), "");
  EXPECT_EQ(why_no_python_name("_arm"), "");
  for (const char* wrong : {"6dof", "my-robot", "class", "", "a.b"}) {
    EXPECT_NE(why_no_python_name(wrong), "") << wrong;
  }
}

}  // namespace
}  // namespace dyngen::test::scripts_tests
