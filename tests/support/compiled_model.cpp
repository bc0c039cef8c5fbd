// SPDX-License-Identifier: MIT
#include "tests/support/compiled_model.h"

#include <stdexcept>

namespace dyngen::test {
namespace {

template <class T>
std::vector<double> call_as(void* function, const FunctionSpec& spec, const MotionSample& sample,
                            const std::vector<double>& chi, bool takes_chi) {
  const auto convert = [](const std::vector<double>& values) {
    return std::vector<T>(values.begin(), values.end());
  };
  std::vector<std::vector<T>> inputs;
  for (const std::string_view name : spec.inputs) {
    inputs.push_back(convert(name == "q" ? sample.q : name == "dq" ? sample.dq : sample.ddq));
  }
  if (takes_chi) inputs.push_back(convert(chi));
  std::vector<T> tau(sample.q.size(), T(-77));
  const T* a = inputs[0].data();
  const T* b = inputs.size() > 1 ? inputs[1].data() : nullptr;
  const T* c = inputs.size() > 2 ? inputs[2].data() : nullptr;
  const T* d = inputs.size() > 3 ? inputs[3].data() : nullptr;
  switch (inputs.size()) {
    case 1:
      reinterpret_cast<void (*)(const T*, T*)>(function)(a, tau.data());
      break;
    case 2:
      reinterpret_cast<void (*)(const T*, const T*, T*)>(function)(a, b, tau.data());
      break;
    case 3:
      reinterpret_cast<void (*)(const T*, const T*, const T*, T*)>(function)(a, b, c, tau.data());
      break;
    default:
      reinterpret_cast<void (*)(const T*, const T*, const T*, const T*, T*)>(function)(a, b, c, d,
                                                                                       tau.data());
  }
  return std::vector<double>(tau.begin(), tau.end());
}

SharedObject compile(const RobotModel& model, const GeneratorOptions& options,
                     const std::string& prefix) {
  const CText text = generate(model, options);
  // no contraction to fused operations: they would round differently from the evaluated program
  return SharedObject({{prefix + ".h", text.header}, {prefix + ".c", text.source}},
                      "-std=c99 -O2 -ffp-contract=off");
}

}  // namespace

CompiledModel::CompiledModel(const RobotModel& model, const GeneratorOptions& options)
    : prefix_(options.prefix.empty() ? model.name : options.prefix),
      library_(compile(model, options, prefix_)) {
  const CodeModel code = make_code_model(model, options);
  takes_chi_ = code.takes_chi;
  chi_count_ = code.chi.size();
  single_ = options.scalar == Scalar::kFloat;
}

void* CompiledModel::symbol(const std::string& name) const {
  return library_.symbol(prefix_ + "_" + name);
}

std::vector<double> CompiledModel::call(const std::string& function, const MotionSample& sample,
                                        const std::vector<double>& chi) const {
  const FunctionSpec* spec = find_function(function);
  if (spec == nullptr) throw std::runtime_error("no function " + function);
  void* address = symbol(function);
  return single_ ? call_as<float>(address, *spec, sample, chi, takes_chi_)
                 : call_as<double>(address, *spec, sample, chi, takes_chi_);
}

std::vector<double> CompiledModel::call_in_place(const std::string& function,
                                                 const MotionSample& sample,
                                                 const std::vector<double>& chi) const {
  void* address = symbol(function);
  std::vector<double> both = sample.ddq;
  const double* q = sample.q.data();
  const double* dq = sample.dq.data();
  if (takes_chi_) {
    using Function = void (*)(const double*, const double*, const double*, const double*, double*);
    reinterpret_cast<Function>(address)(q, dq, both.data(), chi.data(), both.data());
  } else {
    using Function = void (*)(const double*, const double*, const double*, double*);
    reinterpret_cast<Function>(address)(q, dq, both.data(), both.data());
  }
  return both;
}

std::vector<double> CompiledModel::chi_values() const {
  if (chi_count_ == 0) return {};
  if (single_) {
    const auto* values = static_cast<const float*>(symbol("chi_values"));
    return {values, values + chi_count_};
  }
  const auto* values = static_cast<const double*>(symbol("chi_values"));
  return {values, values + chi_count_};
}

}  // namespace dyngen::test
