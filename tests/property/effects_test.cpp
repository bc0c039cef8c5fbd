// SPDX-License-Identifier: MIT
// Effects in emitted code: against a judge that reads the effect file's tree in plain numbers, and
// compiled against evaluated.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "gen/diagnostic/diagnostic.h"
#include "gen/effects/effect_catalogue.h"
#include "gen/emit_c/c_spelling.h"
#include "gen/symbols/exact.h"
#include "tests/support/compiled_model.h"
#include "tests/support/effect_judge.h"
#include "tests/support/relative_error.h"

namespace dyngen::test {
namespace {

constexpr int kSamples = 200;
constexpr double kPeriod = 0.002;  // s

/// The planar arm with rows `effect`.
std::string arm_with(const std::string& rows) {
  std::ifstream file(std::string(DYNGEN_SOURCE_DIR) + "/robots/planar2r.robot");
  std::stringstream text;
  text << file.rdbuf();
  std::string robot = text.str();
  return robot.replace(robot.rfind("stop"), 4, rows + "\nstop");
}

RobotModel model_with(const std::string& rows) { return parse_model(arm_with(rows)); }

/// Sizes of such an arm, for starts and typical values.
double scale(const std::string& name) {
  static const std::map<std::string, double> kScales = {
      {"Fc", 2.5288},    {"Fv", 1.7243},   {"Ia", 0.47588},
      {"v_max", 3},      {"v90", 2},       {"q_range", 3},
      {"tau_max", 30},   {"duration", 20}, {"position_step", 1e-4},
      {"temp_range", 20}};
  return kScales.at(name);
}

/// Start values; where these say "nothing of it", what is typical; where that too, a tenth.
std::map<std::string, double> parameters_of(const EffectFile& effect) {
  std::map<std::string, double> values;
  for (const EffectParameter& parameter : effect.parameters) {
    double value = numeric_value(parameter.start, scale);
    if (value == 0) value = numeric_value(parameter.typical, scale);
    values[parameter.name] = value == 0 && !parameter.min ? 0.1 : value;
  }
  return values;
}

std::string row_of(const EffectFile& effect, const std::map<std::string, double>& values,
                   int joint = 2, int other = 1) {
  std::string row = fmt::format("effect {} joint={}", effect.name, joint);
  if (effect.scope == EffectScope::kPair) row += fmt::format(" other={}", other);
  for (const auto& [name, value] : values) row += fmt::format(" {}={}", name, value);
  return row;
}

/// A motion that reverses, stands still and goes on, with its own derivatives.
std::vector<MotionSample> motion(int count) {
  std::vector<MotionSample> samples;
  for (int k = 0; k < count; ++k) {
    const double t = k * kPeriod;
    MotionSample sample;
    for (const double w : {23.0, 31.0}) {
      sample.q.push_back(0.4 + 0.05 * std::sin(w * t));
      sample.dq.push_back(0.05 * w * std::cos(w * t));
      sample.ddq.push_back(-0.05 * w * w * std::sin(w * t));
    }
    if (k == 70) sample.dq = {0.0, 0.0};
    samples.push_back(std::move(sample));
  }
  return samples;
}

GeneratorOptions functions_of(std::vector<std::string> names) {
  GeneratorOptions options;
  options.functions = std::move(names);
  return options;
}

std::vector<double> sum(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

std::vector<std::string> effects_of_controllers() {
  std::vector<std::string> names;
  const EffectCatalogue catalogue;
  for (const auto& effect : catalogue.all()) {
    if (effect->runs_in_controller()) names.push_back(effect->name);
  }
  return names;
}

/// A function whether it takes a state or not.
std::vector<double> evaluated_call(const EvaluatedModel& model, const std::string& function,
                                   const MotionSample& sample, EffectState& state) {
  return model.code().memory.empty() ? model.call(function, sample)
                                     : model.advance(function, sample, state);
}

class EveryEffect : public testing::TestWithParam<std::string> {
 protected:
  EveryEffect() : effect_(EffectCatalogue().find(GetParam())), values_(parameters_of(*effect_)) {}

  /// What the effect's equations may read of a joint and its partner.
  static NumericValues variables(const MotionSample& sample, const std::vector<double>& load,
                                 int joint) {
    return [&sample, &load, joint](const std::string& name) {
      const bool partner = name.ends_with("_other");
      const std::size_t at = partner == (joint == 2) ? 0 : 1;
      const std::string own = partner ? name.substr(0, name.size() - 6) : name;
      if (own == "q") return sample.q[at];
      if (own == "qd") return sample.dq[at];
      if (own == "qdd") return sample.ddq[at];
      if (own == "tau_load") return load[at];
      if (own == "sign_qd") return sample.dq[at] > 0 ? 1.0 : sample.dq[at] < 0 ? -1.0 : 0.0;
      if (own == "Fc") return at == 0 ? 2.911 : 2.5288;
      if (own == "Fv") return at == 0 ? 0.7729 : 1.7243;
      return at == 0 ? 0.67065 : 0.47588;  // Ia
    };
  }

  /// At one of the two joints; rotor inertia of joint 1 is grouped with base parameters.
  void expect_torque(int joint, const GeneratorOptions& options) {
    const RobotModel model = model_with(row_of(*effect_, values_, joint, 3 - joint));
    const EvaluatedModel evaluated(model, options);
    EffectJudge judge(*effect_, [&](const std::string& name) { return values_.at(name); });
    EffectState state = evaluated.new_state(kPeriod);
    RelativeError error;
    double step = 0;
    const std::size_t at = static_cast<std::size_t>(joint - 1);
    for (const MotionSample& sample : motion(kSamples)) {
      std::vector<double> load = evaluated.call("id_rigid", sample);
      load[0] -= 0.67065 * sample.ddq[0];  // rotor inertias of the file
      load[1] -= 0.47588 * sample.ddq[1];
      const std::vector<double> own = judge.torque(variables(sample, load, joint), step);
      const std::vector<double> torque = evaluated_call(evaluated, "effects", sample, state);
      error.add(torque[at], own[0]);
      if (own.size() > 1) {
        error.add(torque[1 - at], own[1]);
      } else {
        EXPECT_EQ(torque[1 - at], 0.0);
      }
      step = kPeriod;
    }
    // the judge's differences of rates err, most where these grow as a broken power of the state
    const double differences = GetParam() == "bouc_wen" ? 1e-3 : 1e-5;
    EXPECT_LT(error.value(), effect_->states.empty() ? 1e-12 : differences)
        << GetParam() << " of joint " << joint;
  }

  std::shared_ptr<const EffectFile> effect_;
  std::map<std::string, double> values_;
};

TEST_P(EveryEffect, TorqueIsWhatItsFileSays) {
  GeneratorOptions options = functions_of({"effects", "id_rigid"});
  for (const ParameterMode mode : {ParameterMode::kBaked, ParameterMode::kRuntime}) {
    options.parameters = mode;
    for (const bool regroup : {true, false}) {
      options.regroup = regroup;
      expect_torque(1, options);
      expect_torque(2, options);
    }
  }
}

TEST_P(EveryEffect, IsTheDifferenceOfIdAndTheRigidModelWithFriction) {
  const std::string row = row_of(*effect_, values_);
  for (const ParameterMode mode : {ParameterMode::kBaked, ParameterMode::kRuntime}) {
    GeneratorOptions options;
    options.functions = {"id", "id_rigid", "friction", "effects"};
    options.parameters = mode;
    const EvaluatedModel with(model_with(row), options);
    options.functions = {"friction"};
    const EvaluatedModel without(model_with(""), options);
    EffectState of_id = with.new_state(kPeriod), of_friction = of_id, of_effects = of_id;
    RelativeError id, friction;
    for (const MotionSample& sample : motion(kSamples)) {
      const std::vector<double> effects = evaluated_call(with, "effects", sample, of_effects);
      const std::vector<double> both = sum(without.call("friction", sample), effects);
      friction.add(evaluated_call(with, "friction", sample, of_friction), both);
      id.add(evaluated_call(with, "id", sample, of_id), sum(with.call("id_rigid", sample), both));
    }
    EXPECT_LT(id.value(), 1e-12) << GetParam();
    EXPECT_LT(friction.value(), 1e-12) << GetParam();
  }
}

TEST_P(EveryEffect, CompiledIsEvaluated) {
  GeneratorOptions options;
  options.functions = {"id", "effects"};
  options.trig = Trig::kLibm;
  const RobotModel model = model_with(row_of(*effect_, values_));
  const CompiledModel compiled(model, options);
  const EvaluatedModel evaluated(model, options);
  for (const std::string& function : options.functions) {
    RelativeError error;
    const bool stateful = !effect_->states.empty();
    EffectState own = stateful ? compiled.new_state(kPeriod) : EffectState();
    EffectState state = evaluated.new_state(kPeriod);
    for (const MotionSample& sample : motion(kSamples)) {
      error.add(stateful ? compiled.advance(function, sample, evaluated.chi(), own)
                         : compiled.call(function, sample, evaluated.chi()),
                evaluated_call(evaluated, function, sample, state));
    }
    EXPECT_LT(error.value(), 4e-15) << GetParam() << " " << function;
    EXPECT_EQ(own.step, stateful ? kPeriod : 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(catalogue, EveryEffect, testing::ValuesIn(effects_of_controllers()),
                         [](const auto& name) { return name.param; });

// ---- one robot with many of them

const char* const kAlgebraic =
    "effect stribeck joint=2 Fs=3.1 vs=0.05\n"
    "effect load_friction joint=1 mu=*\n"
    "effect cogging joint=2 a=0.3 b=0.2 n=24\n"
    "effect power_law_viscous joint=1 Fa=0.8 alpha=0.7\n"
    "effect gas_spring joint=2 F0=500 n=1.3\n"
    "effect gear_efficiency joint=2 eta_drive=0.9 eta_back=0.8\n"
    "effect motor_coupling joint=2 other=1 F=0.3 Fvm=0.1 I=0.02 ratio=0.5";
const char* const kStateful =
    "effect dahl joint=1 F=0.7 zs=0.003\n"
    "effect lugre joint=2 F=1.5 rise=1.3 vs=0.1 zs=0.002\n"
    "effect maxwell_slip joint=2 F1=0.1 F2=0.2 F3=0.3 F4=0.4 zs=0.0005\n"
    "effect elasto_plastic joint=1 F=0.5 zs=0.002 begin=0.4\n"
    "effect thermal_power joint=2 kv=-0.01 kc=0.002 warm=3\n"
    "effect exponential_viscous joint=1 A=0.4 vt=0.5";

struct EmittedCase {
  std::string name;
  const char* rows;
  GeneratorOptions options;
  std::string flags = "-std=c99 -O2 -ffp-contract=off";
  std::string compiler = "cc";
  double tolerance = 4e-15;  ///< sines of the code and of the library differ in the last bit
};

std::vector<EmittedCase> emitted_cases() {
  GeneratorOptions baked;
  baked.functions = {"id", "friction", "effects"};
  GeneratorOptions runtime = baked, single = baked, folded = baked, standard = baked;
  runtime.parameters = standard.parameters = ParameterMode::kRuntime;
  single.scalar = Scalar::kFloat;
  folded.parameters = ParameterMode::kRuntime;
  folded.fold = true;
  standard.regroup = false;
  standard.gravity = standard.wrench = standard.payload = true;
  const std::string cpp = "-std=c++20 -O2 -ffp-contract=off", c = "-std=c99 -O2 -ffp-contract=off";
  std::vector<EmittedCase> cases;
  for (const bool stateful : {false, true}) {
    const std::string name = stateful ? "stateful_" : "algebraic_";
    const char* rows = stateful ? kStateful : kAlgebraic;
    cases.push_back({name + "baked", rows, baked});
    cases.push_back({name + "runtime", rows, runtime});
    cases.push_back({name + "folded", rows, folded});
    cases.push_back({name + "standard", rows, standard});
    cases.push_back({name + "cpp", rows, baked, cpp, "c++"});
    cases.push_back({name + "clang", rows, runtime, c, "clang"});
    // some hundred operations at 6e-8 each, slopes of 1/zs
    cases.push_back({name + "float", rows, single, c, "cc", 2e-4});
  }
  return cases;
}

class Emitted : public testing::TestWithParam<EmittedCase> {};

TEST_P(Emitted, CompiledIsEvaluated) {
  const EmittedCase& own = GetParam();
  const RobotModel model = model_with(own.rows);
  const CompiledModel compiled(model, own.options, own.flags, own.compiler);
  const EvaluatedModel evaluated(model, own.options);
  std::vector<MotionSample> samples = motion(kSamples);
  const std::vector<MotionSample> random = random_samples(2, kSamples, 3);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k].gravity = random[k].gravity;
    samples[k].wrench = random[k].wrench;
    samples[k].payload = random[k].payload;
  }
  const bool stateful = own.rows == kStateful;
  for (const std::string& function : own.options.functions) {
    RelativeError error;
    EffectState in_c = stateful ? compiled.new_state(kPeriod) : EffectState();
    EffectState state = evaluated.new_state(kPeriod);
    for (const MotionSample& sample : samples) {
      error.add(stateful ? compiled.advance(function, sample, evaluated.chi(), in_c)
                         : compiled.call(function, sample, evaluated.chi()),
                evaluated_call(evaluated, function, sample, state));
    }
    EXPECT_LT(error.value(), own.tolerance) << function;
  }
}

// GiNaC's order of terms changes with the addresses of symbols, which are new each time.
TEST_P(Emitted, TextIsTheSameEveryTime) {
  const EmittedCase& own = GetParam();
  GeneratorOptions options = with_short_search(own.options);
  options.cpp_wrapper = true;
  const CText first = generate(model_with(own.rows), options);
  for (int run = 2; run <= 5; ++run) {
    const CText again = generate(model_with(own.rows), options);
    EXPECT_EQ(first.source, again.source);
    EXPECT_EQ(first.header, again.header);
    EXPECT_EQ(first.wrapper, again.wrapper);
  }
}

INSTANTIATE_TEST_SUITE_P(effects, Emitted, testing::ValuesIn(emitted_cases()),
                         [](const auto& own) { return own.param.name; });

TEST(EffectBatch, GivesTheBitsOfOneSample) {
  GeneratorOptions options;
  options.functions = {"id", "id_batch", "effects", "effects_batch"};
  options.trig = Trig::kLibm;
  for (const Scalar scalar : {Scalar::kDouble, Scalar::kFloat}) {
    options.scalar = scalar;
    for (const char* flags : {"-std=c99 -O1", "-std=c99 -O1 -mavx2"}) {
      const RobotModel model = model_with(kAlgebraic);
      const CText text = generate(model, with_short_search(options));
      const SharedObject library({{"planar2r.h", text.header}, {"planar2r.c", text.source}}, flags);
      const std::vector<MotionSample> samples = motion(21);
      const auto compare = [&](auto zero) {
        using T = decltype(zero);
        const std::size_t n = samples.size();
        std::vector<T> q(2 * n), dq(2 * n), ddq(2 * n), tau(2 * n), chi(12, T(0.25));
        for (std::size_t k = 0; k < n; ++k) {
          for (std::size_t i = 0; i < 2; ++i) {
            q[i * n + k] = static_cast<T>(samples[k].q[i]);
            dq[i * n + k] = static_cast<T>(samples[k].dq[i]);
            ddq[i * n + k] = static_cast<T>(samples[k].ddq[i]);
          }
        }
        for (const std::string name : {"id", "effects"}) {
          using Batch = void (*)(std::size_t, const T*, const T*, const T*, const T*, T*);
          using One = void (*)(const T*, const T*, const T*, const T*, T*);
          reinterpret_cast<Batch>(library.symbol("planar2r_" + name + "_batch"))(
              n, q.data(), dq.data(), ddq.data(), chi.data(), tau.data());
          const auto one = reinterpret_cast<One>(library.symbol("planar2r_" + name));
          for (std::size_t k = 0; k < n; ++k) {
            const T own_q[2] = {q[k], q[n + k]}, own_dq[2] = {dq[k], dq[n + k]};
            const T own_ddq[2] = {ddq[k], ddq[n + k]};
            T own[2] = {};
            one(own_q, own_dq, own_ddq, chi.data(), own);
            for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(tau[i * n + k], own[i]) << name << k;
          }
        }
      };
      if (scalar == Scalar::kDouble) {
        compare(0.0);
      } else {
        compare(0.0F);
      }
    }
  }
}

// ---- states

TEST(EffectStates, FirstCallAfterResetLeavesThemAndFurtherOnesMoveThem) {
  GeneratorOptions options;
  options.functions = {"id"};
  const RobotModel model = model_with("effect dahl joint=2 F=1.2 zs=0.004");
  const CompiledModel compiled(model, options);
  EffectState state = compiled.new_state(kPeriod);
  EXPECT_EQ(state.z, std::vector<double>{0.0});
  EXPECT_EQ(state.step, 0.0);
  EXPECT_EQ(state.dt, kPeriod);
  MotionSample sample;
  sample.q = {0.1, 0.2};
  sample.dq = {0.3, 0.8};
  sample.ddq = {0.0, 0.0};
  compiled.advance("id", sample, {}, state);
  EXPECT_EQ(state.z[0], 0.0);
  EXPECT_EQ(state.last, std::vector<double>{0.8});
  EXPECT_EQ(state.step, kPeriod);
  // Dahl 1968 at a constant speed: z = 1 - exp(-distance / zs), exactly
  for (int k = 1; k <= 20; ++k) {
    compiled.advance("id", sample, {}, state);
    EXPECT_NEAR(state.z[0], 1 - std::exp(-0.8 * k * kPeriod / 0.004), 1e-14);
  }
}

TEST(EffectStates, StartAtTheNearestPointWithinTheirLimits) {
  GeneratorOptions options;
  options.functions = {"effects"};
  const RobotModel model = model_with("effect maxwell_slip joint=2 F1=1 F2=1 F3=1 F4=1 zs=0.001");
  const CompiledModel compiled(model, options);
  EXPECT_EQ(compiled.new_state(0.1).z, (std::vector<double>(4, 0.0)));
  // far too long a step ends at the limits
  EffectState state = compiled.new_state(1.0);
  MotionSample sample;
  sample.q = sample.ddq = {0.0, 0.0};
  sample.dq = {0.0, -2.0};
  compiled.advance("effects", sample, {}, state);
  compiled.advance("effects", sample, {}, state);
  EXPECT_EQ(state.z, (std::vector<double>{-0.001, -0.002, -0.004, -0.008}));
}

TEST(EffectStates, StaysBoundedAtAnyPeriod) {
  GeneratorOptions options;
  options.functions = {"effects"};
  for (const char* rows : {"effect dahl joint=2 F=1 zs=0.0001",
                           "effect lugre joint=2 F=1 rise=1.5 "
                           "vs=0.02 zs=0.0001"}) {
    const EvaluatedModel evaluated(model_with(rows), options);
    for (const double period : {1e-5, 1e-3, 0.1}) {
      EffectState state = evaluated.new_state(period);
      for (const MotionSample& sample : motion(kSamples)) {
        evaluated.advance("effects", sample, state);
        EXPECT_LE(std::abs(state.z[0]), 1.5 * (1 + 1e-12)) << rows << " " << period;
      }
    }
  }
}

TEST(EffectStates, HeaderNamesThem) {
  const CText text = generate(model_with(kStateful), functions_of({"id"}));
  for (const char* part :
       {"#define PLANAR2R_NSTATE 8 ", "void planar2r_reset(planar2r_state *s, double dt);",
        "void planar2r_id(planar2r_state *s, const double *q, const double *dq, const double "
        "*ddq,"}) {
    EXPECT_NE(text.header.find(part), std::string::npos) << part;
  }
  for (const char* part : {"\"dahl_1_z\"", "\"maxwell_slip_2_z4\"", "\"thermal_power_2_power\""}) {
    EXPECT_NE(text.source.find(part), std::string::npos) << part;
  }
}

TEST(EffectStates, FunctionsWithoutThemTakeNoState) {
  const CText text = generate(model_with(kStateful), functions_of({"id_rigid", "gravity"}));
  EXPECT_EQ(text.header.find("_state"), std::string::npos);
  EXPECT_NE(text.header.find("The robot's effects are left out."), std::string::npos);
}

// ---- what there is and what there is not

std::string refusal(const std::string& rows, const GeneratorOptions& options) {
  try {
    (void)generate(model_with(rows), with_short_search(options));
  } catch (const ModelError& error) {
    return error.what();
  }
  return {};
}

TEST(EffectFunctions, FrictionReadsOnlyWhatItsEffectsDo) {
  GeneratorOptions options;
  options.functions = {"friction"};
  EXPECT_NE(generate(model_with("effect stribeck joint=2 Fs=3 vs=0.1"), options)
                .header.find("void planar2r_friction(const double *dq, double *tau);"),
            std::string::npos);
  EXPECT_NE(generate(model_with("effect cogging joint=2 a=1 b=0 n=10"), options)
                .header.find("void planar2r_friction(const double *q, const double *dq, const "
                             "double *ddq, double *tau);"),
            std::string::npos);
}

TEST(EffectFunctions, RobotWithoutEffectsHasNoFunctionOfThem) {
  EXPECT_NE(refusal("", functions_of({"effects"}))
                .find("the robot has no effect that runs in a controller"),
            std::string::npos);
  EXPECT_EQ(generate(model_with(""), {}).header.find("_effects"), std::string::npos);
}

TEST(EffectFunctions, ForwardDynamicsTakesThemOff) {
  GeneratorOptions options;
  options.functions = {"id", "fd"};
  for (const std::string rows : {"effect stribeck joint=2 Fs=3 vs=0.1\neffect cogging joint=1 a=1 "
                                 "b=0.5 n=9",
                                 "effect dahl joint=1 F=1 zs=0.002"}) {
    const EvaluatedModel model(model_with(rows), options);
    EffectState of_id = model.new_state(kPeriod), of_fd = of_id;
    RelativeError error;
    for (MotionSample sample : motion(kSamples)) {
      sample.tau = evaluated_call(model, "id", sample, of_id);
      error.add(evaluated_call(model, "fd", sample, of_fd), sample.ddq);
    }
    EXPECT_LT(error.value(), 1e-12) << rows;
  }
}

TEST(EffectFunctions, NoForwardDynamicsWhereTheTorqueDependsOnAccelerations) {
  for (const char* rows :
       {"effect load_friction joint=2 mu=0.1", "effect rotor_inertia joint=1 J=1",
        "effect inertial_coupling joint=2 other=1 I=0.1 ratio=1"}) {
    EXPECT_NE(refusal(rows, functions_of({"fd"})).find("an effect reads accelerations"),
              std::string::npos)
        << rows;
  }
}

TEST(EffectFunctions, NoBatchOfWhatRemembers) {
  EXPECT_NE(refusal(kStateful, functions_of({"id_batch"}))
                .find("'id_batch': effects of this robot remember the call before"),
            std::string::npos);
  const CText text = generate(model_with(kStateful), with_short_search(functions_of({"all"})));
  EXPECT_EQ(text.header.find("planar2r_id_batch"), std::string::npos);
  EXPECT_NE(text.header.find("planar2r_gravity_batch"), std::string::npos);
}

TEST(EffectFunctions, EffectsCanBeLeftOut) {
  GeneratorOptions options;
  options.functions = {"id", "friction"};
  const CText without = generate(model_with(""), options);
  options.effects = false;
  const CText left_out = generate(model_with(kStateful), options);
  EXPECT_EQ(left_out.source, without.source);
  EXPECT_EQ(left_out.header, without.header);
}

TEST(EffectFunctions, RegressorColumnsOfTheirParametersAreZero) {
  GeneratorOptions options;
  options.functions = {"regressor"};
  options.parameters = ParameterMode::kRuntime;
  const EvaluatedModel with(model_with(kAlgebraic), options), without(model_with(""), options);
  const std::size_t columns = with.code().chi.size(), own = without.code().chi.size();
  ASSERT_GT(columns, own);
  for (const MotionSample& sample : motion(5)) {
    const std::vector<double> Y = with.call("regressor", sample);
    const std::vector<double> rigid = without.call("regressor", sample);
    for (std::size_t k = 0; k < Y.size(); ++k) {
      const std::size_t column = k % columns;
      EXPECT_EQ(Y[k], column < own ? rigid[k / columns * own + column] : 0.0) << k;
    }
  }
}

TEST(EffectFunctions, UnknownRotorInertiaThatIsGroupedIsRefused) {
  const std::string row = "effect load_friction_directional joint=1 km=0.1 ke=0.05";
  RobotModel model = model_with(row);
  model.joints[0].chi[index(Chi::kIA)].unknown = true;
  GeneratorOptions options;
  options.functions = {"id"};
  EXPECT_THROW((void)generate(model, options), ModelError);
  options.regroup = false;
  EXPECT_NO_THROW((void)generate(model, options));
}

}  // namespace
}  // namespace dyngen::test
