// SPDX-License-Identifier: MIT
#include "tests/support/compiled_model.h"

#include <dlfcn.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace dyngen::test {
namespace {

std::string make_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "dyngen_test_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a folder");
  return pattern;
}

void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// Runs a command; whatever it prints is an error.
void run(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run: " + command);
  std::string output;
  std::array<char, 512> buffer{};
  while (fgets(buffer.data(), buffer.size(), pipe) != nullptr) output += buffer.data();
  if (pclose(pipe) != 0 || !output.empty()) throw std::runtime_error(command + "\n" + output);
}

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
    case 1: reinterpret_cast<void (*)(const T*, T*)>(function)(a, tau.data()); break;
    case 2: reinterpret_cast<void (*)(const T*, const T*, T*)>(function)(a, b, tau.data()); break;
    case 3:
      reinterpret_cast<void (*)(const T*, const T*, const T*, T*)>(function)(a, b, c, tau.data());
      break;
    default:
      reinterpret_cast<void (*)(const T*, const T*, const T*, const T*, T*)>(function)(
          a, b, c, d, tau.data());
  }
  return std::vector<double>(tau.begin(), tau.end());
}

}  // namespace

CompiledModel::CompiledModel(const RobotModel& model, const GeneratorOptions& options)
    : folder_(make_folder()) {
  const CodeModel code = make_code_model(model, options);
  takes_chi_ = code.takes_chi;
  chi_count_ = code.chi.size();
  single_ = options.scalar == Scalar::kFloat;
  prefix_ = options.prefix.empty() ? model.name : options.prefix;
  const CText text = generate(model, options);
  write(folder_ + "/" + prefix_ + ".h", text.header);
  write(folder_ + "/" + prefix_ + ".c", text.source);
  const std::string object = folder_ + "/model.so";
  // no contraction to fused operations: they would round differently from the evaluated program
  run("cc -std=c99 -O2 -ffp-contract=off -shared -fPIC -Wall -Wextra -Wpedantic -Wconversion -Wshadow "
      "-Wdouble-promotion " +
      folder_ + "/" + prefix_ + ".c -o " + object + " -lm");
  library_ = dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr) throw std::runtime_error(dlerror());
}

CompiledModel::~CompiledModel() {
  if (library_ != nullptr) dlclose(library_);
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void* CompiledModel::symbol(const std::string& name) const {
  void* found = dlsym(library_, (prefix_ + "_" + name).c_str());
  if (found == nullptr) throw std::runtime_error("no symbol " + prefix_ + "_" + name);
  return found;
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
