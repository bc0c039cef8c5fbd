// SPDX-License-Identifier: MIT
#include "tests/support/exact_evaluation.h"

#include <cln/cln.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>
#include <unordered_map>
#include <vector>

#include "gen/symbols/calls.h"
#include "gen/symbols/exact.h"

namespace dyngen::test {
namespace {

using cln::cl_R;
using GiNaC::ex;

const cln::float_format_t kFormat = cln::float_format(60);

/// A decimal of nine digits in +-3.
cl_R random_value(std::uint64_t seed, const std::string& array, int index) {
  std::uint64_t state = seed * 0x9e3779b97f4a7c15U + static_cast<std::uint64_t>(index + 1);
  for (const char letter : array) {
    state = (state ^ static_cast<std::uint64_t>(letter)) * 0x100000001b3U;
  }
  std::mt19937_64 random(state);
  const std::int64_t thousandths = static_cast<std::int64_t>(random() % 6000000001U) - 3000000000;
  return cln::cl_R(cln::cl_I(static_cast<long>(thousandths))) / cl_R(1000000000L);
}

class Evaluation {
 public:
  Evaluation(const SymbolTable& symbols, std::uint64_t seed, const ExactValues& given)
      : symbols_(symbols), seed_(seed), given_(given) {}

  void assign(const GiNaC::symbol& target, const ex& value) {
    assigned_[target.get_name()] = evaluate(value);
  }

  cl_R evaluate(const ex& value) {
    if (GiNaC::is_a<GiNaC::symbol>(value)) return symbol(value);
    if (is_number(value)) return number(value);
    if (GiNaC::is_a<GiNaC::add>(value)) {
      cl_R sum = 0;
      for (std::size_t i = 0; i < value.nops(); ++i) sum = sum + evaluate(value.op(i));
      return sum;
    }
    if (GiNaC::is_a<GiNaC::mul>(value)) {
      cl_R product = 1;
      for (std::size_t i = 0; i < value.nops(); ++i) product = product * evaluate(value.op(i));
      return product;
    }
    if (GiNaC::is_a<GiNaC::power>(value)) {
      const int exponent = GiNaC::ex_to<GiNaC::numeric>(value.op(1)).to_int();
      return cln::expt(evaluate(value.op(0)), cln::cl_I(exponent));
    }
    const std::string name = call_name(value);
    if (name.empty()) throw std::invalid_argument("unknown function");
    std::vector<ex> arguments;
    for (std::size_t i = 0; i < value.nops(); ++i) {
      arguments.push_back(GiNaC::numeric(evaluate(value.op(i))));
    }
    return number(make_call(name, arguments));
  }

 private:
  static cl_R number(const ex& value) {
    const PrecisionScope precision;
    const ex result = value.evalf();
    const auto number = cln::the<cl_R>(GiNaC::ex_to<GiNaC::numeric>(result).to_cl_N());
    return cln::cl_float(number, kFormat);
  }

  cl_R symbol(const ex& value) const {
    const SymbolInfo& info = symbols_.info(value);
    if (const auto it = assigned_.find(info.name); it != assigned_.end()) return it->second;
    if (info.kind == SymbolKind::kConstant) return number(info.value);
    if (info.kind == SymbolKind::kIntermediate) {
      throw std::invalid_argument(info.name + " is read before it is assigned");
    }
    if (const auto it = given_.find({info.array, info.index}); it != given_.end()) {
      return it->second;
    }
    return cln::cl_float(random_value(seed_, info.array, info.index), kFormat);
  }

  const SymbolTable& symbols_;
  std::uint64_t seed_;
  const ExactValues& given_;
  std::unordered_map<std::string, cl_R> assigned_;
};

}  // namespace

ExactValues exact_outputs(const Trace& trace, std::uint64_t seed, const ExactValues& given) {
  Evaluation evaluation(trace.symbols(), seed, given);
  for (const Assignment& assignment : trace.assignments()) {
    evaluation.assign(assignment.target, assignment.value);
  }
  ExactValues outputs;
  for (const Output& output : trace.outputs()) {
    outputs[{output.array, output.index}] = evaluation.evaluate(output.value);
  }
  return outputs;
}

double exact_difference(const ExactValues& a, const ExactValues& b) {
  const double kInfinity = std::numeric_limits<double>::infinity();
  if (a.size() != b.size()) return kInfinity;
  std::map<std::string, cl_R> largest;  // of each array
  for (const auto& [element, value] : a) {
    const auto it = largest.emplace(element.first, 0).first;
    it->second = cln::max(it->second, cln::abs(value));
  }
  double difference = 0;
  for (const auto& [element, value] : a) {
    const auto other = b.find(element);
    if (other == b.end()) return kInfinity;
    const cl_R distance = cln::abs(value - other->second);
    const cl_R& size = largest.at(element.first);
    if (cln::zerop(distance)) continue;
    if (cln::zerop(size)) return kInfinity;
    difference = std::max(difference, cln::double_approx(distance / size));
  }
  return difference;
}

}  // namespace dyngen::test
