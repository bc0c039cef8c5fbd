// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/schedule.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <vector>

namespace dyngen {
namespace {

// Time from operands to result, in half cycles of a usual processor.
constexpr int kMultiplication = 6, kAddition = 7, kCall = 40;

/// A statement and its neighbours.
struct Vertex {
  std::vector<std::size_t> operands;  ///< statements whose values it reads, each once
  std::vector<std::size_t> users;
  int height = 0;  ///< time from its operands to the end of the program
};

class Scheduler {
 public:
  explicit Scheduler(const Trace& trace) : trace_(trace), vertices_(trace.assignments().size()) {
    connect();
    measure();
    for (std::size_t i = 0; i < vertices_.size(); ++i) waiting_[i] = vertices_[i].operands.size();
  }

  Trace run() {
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (placed_[i]) continue;
      section_ = trace_.assignments()[i].section;
      place(i);
      while (!ready_.empty()) place(std::get<2>(*ready_.begin()));
    }
    Trace result = trace_;
    result.rearrange(order_);
    return result;
  }

 private:
  using Candidate = std::tuple<int, int, std::size_t>;  // lifetimes more, -height, statement

  void connect() {
    std::map<int, std::size_t> makers;  // by place of the symbol
    const SymbolTable& symbols = trace_.symbols();
    const auto operands = [&](const GiNaC::ex& value) {
      std::set<std::size_t> found;
      for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
        if (!GiNaC::is_a<GiNaC::symbol>(*it)) continue;
        const auto maker = makers.find(symbols.place(*it));
        if (maker != makers.end()) found.insert(maker->second);
      }
      return std::vector<std::size_t>(found.begin(), found.end());
    };
    const auto& assignments = trace_.assignments();
    for (std::size_t i = 0; i < assignments.size(); ++i) {
      vertices_[i].operands = operands(assignments[i].value);
      for (const std::size_t operand : vertices_[i].operands) {
        vertices_[operand].users.push_back(i);
      }
      makers.emplace(symbols.place(assignments[i].target), i);
    }
    remaining_.resize(vertices_.size());
    waiting_.resize(vertices_.size());
    placed_.resize(vertices_.size());
    for (std::size_t i = 0; i < vertices_.size(); ++i) remaining_[i] = vertices_[i].users.size();
    for (const Output& output : trace_.outputs()) {  // outputs are written at the end
      for (const std::size_t operand : operands(output.value)) ++remaining_[operand];
    }
  }

  void measure() {
    for (std::size_t i = vertices_.size(); i-- > 0;) {
      const OperationCount count =
          count_operations(canonical_form(trace_.assignments()[i].value, trace_.symbols()));
      int height = 0;
      for (const std::size_t user : vertices_[i].users) {
        height = std::max(height, vertices_[user].height);
      }
      vertices_[i].height = height + (count.multiplications > 0 ? kMultiplication : 0) +
                            kAddition * count.additions +
                            kCall * (count.sin_cos_pairs + count.calls);
    }
  }

  /// How many more values are alive after the statement than before.
  [[nodiscard]] int growth(std::size_t i) const {
    int result = 1;
    for (const std::size_t operand : vertices_[i].operands) result -= remaining_[operand] == 1;
    return result;
  }

  [[nodiscard]] Candidate candidate(std::size_t i) const {
    return {growth(i), -vertices_[i].height, i};
  }

  /// Statements that need no operand wait for their place in the program: they are as good there.
  void consider(std::size_t i) {
    if (placed_[i] || waiting_[i] > 0 || vertices_[i].operands.empty()) return;
    if (growth(i) <= 0) ready_.insert(candidate(i));
  }

  void place(std::size_t i) {
    ready_.erase(candidate(i));
    placed_[i] = true;
    order_.push_back({i, section_});
    for (const std::size_t operand : vertices_[i].operands) {
      if (remaining_[operand]-- != 2) continue;
      for (const std::size_t user : vertices_[operand].users) last_user(user, operand);
    }
    for (const std::size_t user : vertices_[i].users) {
      --waiting_[user];
      consider(user);
    }
  }

  /// The operand has one user left: if it is this one, its growth is less by one now.
  void last_user(std::size_t user, std::size_t operand) {
    if (placed_[user] || waiting_[user] > 0) return;
    ++remaining_[operand];
    ready_.erase(candidate(user));
    --remaining_[operand];
    consider(user);
  }

  const Trace& trace_;
  std::vector<Vertex> vertices_;
  std::vector<std::size_t> remaining_;  ///< uses of each value that are still to come
  std::vector<std::size_t> waiting_;    ///< operands of each statement that are still to come
  std::vector<bool> placed_;
  std::set<Candidate> ready_;
  std::vector<Trace::Position> order_;
  int section_ = 0;
};

}  // namespace

Trace scheduled(const Trace& trace) { return Scheduler(trace).run(); }

}  // namespace dyngen
