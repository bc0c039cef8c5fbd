// SPDX-License-Identifier: MIT
#include "tests/support/compiled_model.h"

#include <stdexcept>
#include <utility>

namespace dyngen::test {
namespace {

/// Calls a function of any number of pointers.
template <std::size_t... I>
void call_pointers(void* function, const std::vector<void*>& p, std::index_sequence<I...>) {
  reinterpret_cast<void (*)(decltype(static_cast<void>(I), static_cast<void*>(nullptr))...)>(
      function)(p[I]...);
}

void call_pointers(void* function, const std::vector<void*>& p) {
  switch (p.size()) {  // from fold(chi, folded) to id_derivatives with every argument
    case 2:
      return call_pointers(function, p, std::make_index_sequence<2>());
    case 3:
      return call_pointers(function, p, std::make_index_sequence<3>());
    case 4:
      return call_pointers(function, p, std::make_index_sequence<4>());
    case 5:
      return call_pointers(function, p, std::make_index_sequence<5>());
    case 6:
      return call_pointers(function, p, std::make_index_sequence<6>());
    case 7:
      return call_pointers(function, p, std::make_index_sequence<7>());
    case 8:
      return call_pointers(function, p, std::make_index_sequence<8>());
    case 9:
      return call_pointers(function, p, std::make_index_sequence<9>());
    case 10:
      return call_pointers(function, p, std::make_index_sequence<10>());
    default:
      throw std::runtime_error("call_pointers(): unexpected number of arguments");
  }
}

/// The members of a state one after the other, as they lie in the struct.
template <class T>
std::vector<T> members(const EffectState& state) {
  std::vector<T> all(state.z.begin(), state.z.end());
  for (const double last : state.last) all.push_back(static_cast<T>(last));
  all.push_back(static_cast<T>(state.step));
  all.push_back(static_cast<T>(state.dt));
  return all;
}

template <class T>
void set_members(EffectState& state, const std::vector<T>& all) {
  std::size_t at = 0;
  for (double& z : state.z) z = static_cast<double>(all[at++]);
  for (double& last : state.last) last = static_cast<double>(all[at++]);
  state.step = static_cast<double>(all[at++]);
  state.dt = static_cast<double>(all[at]);
}

template <class T>
void reset(void* function, EffectState& state, double dt) {
  std::vector<T> all = members<T>(state);
  reinterpret_cast<void (*)(T*, T)>(function)(all.data(), static_cast<T>(dt));
  set_members(state, all);
}

/// @param parameters  chi or folded
template <class T>
std::vector<double> call_as(void* function, const std::vector<Argument>& all,
                            const MotionSample& sample, const std::vector<double>& parameters,
                            const std::string& output, EffectState* state = nullptr) {
  std::vector<T> memory;
  if (state != nullptr) memory = members<T>(*state);
  std::vector<std::vector<T>> arrays;
  std::vector<void*> pointers;
  std::size_t wanted = all.size();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& name = all[i].name;
    if (all[i].state) {
      arrays.push_back(memory);
    } else if (all[i].output) {
      arrays.emplace_back(static_cast<std::size_t>(all[i].size()), T(-77));
      if (output.empty() ? wanted == all.size() : name == output) wanted = i;
    } else {
      const bool own = name == "chi" || name == "folded";
      const std::vector<double>& values = own ? parameters : sample.input(name);
      arrays.emplace_back(values.begin(), values.end());
    }
    pointers.push_back(arrays.back().data());
  }
  call_pointers(function, pointers);
  if (state != nullptr) set_members(*state, arrays.front());
  return std::vector<double>(arrays.at(wanted).begin(), arrays.at(wanted).end());
}

// As a rule without contraction to fused operations: they would round differently from the
// evaluated program.
SharedObject compile(const RobotModel& model, const GeneratorOptions& options,
                     const std::string& prefix, const std::string& flags,
                     const std::string& compiler) {
  const CText text = generate(model, with_short_search(options));
  const std::string ending = flags.find("-std=c++") == std::string::npos ? ".c" : ".cpp";
  return SharedObject({{prefix + ".h", text.header}, {prefix + ending, text.source}}, flags,
                      compiler);
}

}  // namespace

CompiledModel::CompiledModel(const RobotModel& model, const GeneratorOptions& options,
                             const std::string& flags, const std::string& compiler)
    : prefix_(options.prefix.empty() ? model.name : options.prefix),
      library_(compile(model, options, prefix_, flags, compiler)),
      code_(make_code_model(model, options)),
      single_(options.scalar == Scalar::kFloat) {
  if (options.fold) write_functions(code_, with_short_search(options));  // for the names of folded
}

void* CompiledModel::symbol(const std::string& name) const {
  return library_.symbol(prefix_ + "_" + name);
}

std::vector<double> CompiledModel::call(const std::string& function, const MotionSample& sample,
                                        const std::vector<double>& chi,
                                        const std::string& output) const {
  const bool is_fold = function == fold_spec().name;
  const FunctionSpec* spec = is_fold ? &fold_spec() : find_function(function);
  if (spec == nullptr) throw std::runtime_error("no function " + function);
  void* address = symbol(function);
  const std::vector<Argument> all = arguments(*spec, code_);
  const std::vector<double> parameters =
      code_.folds() && !is_fold ? call("fold", sample, chi) : chi;
  return single_ ? call_as<float>(address, all, sample, parameters, output)
                 : call_as<double>(address, all, sample, parameters, output);
}

EffectState CompiledModel::new_state(double dt) const {
  EffectState state;
  state.z.assign(code_.memory.states.size(), 9.0);
  state.last.assign(code_.memory.last.size(), 9.0);
  state.step = state.dt = 9.0;
  if (single_) {
    reset<float>(symbol("reset"), state, dt);
  } else {
    reset<double>(symbol("reset"), state, dt);
  }
  return state;
}

std::vector<double> CompiledModel::advance(const std::string& function, const MotionSample& sample,
                                           const std::vector<double>& chi,
                                           EffectState& state) const {
  void* address = symbol(function);
  const std::vector<Argument> all = arguments(*find_function(function), code_);
  const std::vector<double> parameters = code_.folds() ? call("fold", sample, chi) : chi;
  return single_ ? call_as<float>(address, all, sample, parameters, {}, &state)
                 : call_as<double>(address, all, sample, parameters, {}, &state);
}

std::vector<double> CompiledModel::call_in_place(const std::string& function,
                                                 const MotionSample& sample,
                                                 const std::vector<double>& chi) const {
  void* address = symbol(function);
  std::vector<double> both = sample.ddq;
  const double* q = sample.q.data();
  const double* dq = sample.dq.data();
  if (code_.takes_chi) {
    using Function = void (*)(const double*, const double*, const double*, const double*, double*);
    reinterpret_cast<Function>(address)(q, dq, both.data(), chi.data(), both.data());
  } else {
    using Function = void (*)(const double*, const double*, const double*, double*);
    reinterpret_cast<Function>(address)(q, dq, both.data(), both.data());
  }
  return both;
}

std::vector<double> CompiledModel::chi_values() const {
  if (code_.chi.empty()) return {};
  if (single_) {
    const auto* values = static_cast<const float*>(symbol("chi_values"));
    return {values, values + code_.chi.size()};
  }
  const auto* values = static_cast<const double*>(symbol("chi_values"));
  return {values, values + code_.chi.size()};
}

}  // namespace dyngen::test
