// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/workspace.h"

#include <algorithm>
#include <utility>

#include "gen/symbols/index.h"

namespace dyngen {
namespace {

bool is_copy(const std::vector<Term>& terms) {
  return terms.size() == 1 && terms[0].factors.size() == 1;
}

/// Zero, one or minus one.
bool is_constant(const std::vector<Term>& terms) {
  return terms.empty() || (terms.size() == 1 && terms[0].factors.empty());
}

/// Equal for a sum and its negation.
std::size_t unsigned_hash(const std::vector<Term>& terms) {
  std::uint64_t hash = 0x9e3779b97f4a7c15U;
  const auto mix = [&](std::uint64_t part) {
    hash = (hash ^ part) * 0xff51afd7ed558ccdU;
    hash ^= hash >> 32;
  };
  for (const Term& term : terms) {
    mix(term.negative != terms[0].negative ? 1 : 2);
    for (const int factor : term.factors) mix(static_cast<std::uint64_t>(factor) + 3);
  }
  return static_cast<std::size_t>(hash);
}

bool equal_up_to_sign(const std::vector<Term>& a, const std::vector<Term>& b) {
  if (a.size() != b.size()) return false;
  const bool opposite = a[0].negative != b[0].negative;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].factors != b[i].factors || a[i].negative != (b[i].negative != opposite)) return false;
  }
  return true;
}

}  // namespace

Workspace::Workspace(Network network) : network_(std::move(network)) {
  grow();
  first_own_ = network_.size();
  for (const NetworkOutput& output : network_.outputs) ++outputs_[at(output.node)];
  for (int id = 0; id < network_.size(); ++id) {
    if (!network_.node(id).alive) continue;
    enter(id);
    touch(id);
  }
  tidy();
  begin();
}

void Workspace::grow() {
  const std::size_t size = network_.nodes.size();
  offers_.resize(size);
  readers_.resize(size);
  inverses_.resize(size);
  outputs_.resize(size, 0);
  is_touched_.resize(size, false);
  is_free_.resize(size, false);
}

// ---- books

/// Enters a node that is alive into the books; its offers too if they are not known yet.
void Workspace::enter(int id) {
  const Node& node = network_.node(id);
  if (!node.alive) return;
  if (node.kind == Node::Kind::kInverse) inverses_[at(node.of)].push_back(id);
  if (node.kind != Node::Kind::kSum) return;
  for (const Term& term : node.terms) {
    for (const int factor : term.factors) {
      auto& list = readers_[at(factor)];
      const auto it = std::find_if(list.begin(), list.end(),
                                   [&](const auto& entry) { return entry.first == id; });
      if (it == list.end()) {
        list.emplace_back(id, 1);
      } else {
        ++it->second;
      }
    }
  }
  if (offers_[at(id)].empty()) offers_[at(id)] = table_.offers(node.terms);
  table_.add(id, offers_[at(id)]);
  if (!is_constant(node.terms)) equal_.emplace(unsigned_hash(node.terms), id);
  operations_ += dyngen::operations(node.terms);
}

void Workspace::leave(int id) {
  const Node& node = network_.node(id);
  if (!node.alive) return;
  if (node.kind == Node::Kind::kInverse) {
    auto& list = inverses_[at(node.of)];
    list.erase(std::find(list.begin(), list.end(), id));
  }
  if (node.kind != Node::Kind::kSum) return;
  for (const Term& term : node.terms) {
    for (const int factor : term.factors) {
      auto& list = readers_[at(factor)];
      const auto it = std::find_if(list.begin(), list.end(),
                                   [&](const auto& entry) { return entry.first == id; });
      if (--it->second == 0) list.erase(it);
    }
  }
  table_.remove(id, offers_[at(id)]);
  if (!is_constant(node.terms)) {
    const auto [first, last] = equal_.equal_range(unsigned_hash(node.terms));
    equal_.erase(std::find_if(first, last, [&](const auto& entry) { return entry.second == id; }));
  }
  operations_ -= dyngen::operations(node.terms);
}

void Workspace::detach(int id) {
  leave(id);
  const Node& node = network_.node(id);
  for (const Term& term : node.terms) {
    for (const int factor : term.factors) touch(factor);
  }
  if (node.kind == Node::Kind::kInverse) touch(node.of);
  journal_.push_back(
      {id, node.kind, node.terms, node.of, node.alive, node.negated, std::move(offers_[at(id)])});
  offers_[at(id)].clear();
}

void Workspace::attach(int id) {
  enter(id);
  touch(id);
}

void Workspace::touch(int id) {
  if (is_touched_[at(id)]) return;
  is_touched_[at(id)] = true;
  touched_.push_back(id);
}

void Workspace::begin() {
  for (const Change& change : journal_) {
    const int id = change.id;
    if (id < first_own_ || network_.node(id).alive || !network_.is_sum(id) || is_free_[at(id)]) {
      continue;
    }
    is_free_[at(id)] = true;
    free_.push_back(id);
  }
  journal_.clear();
  output_journal_.clear();
}

void Workspace::roll_back() {
  for (auto it = journal_.rbegin(); it != journal_.rend(); ++it) {
    leave(it->id);
    Node& node = network_.node(it->id);
    node.kind = it->kind;
    node.terms = std::move(it->terms);
    node.of = it->of;
    node.alive = it->alive;
    node.negated = it->negated;
    offers_[at(it->id)] = std::move(it->offers);
    enter(it->id);
  }
  for (auto it = output_journal_.rbegin(); it != output_journal_.rend(); ++it) {
    NetworkOutput& output = network_.outputs[it->output];
    --outputs_[at(output.node)];
    output = it->old;
    ++outputs_[at(output.node)];
  }
  for (const int id : touched_) is_touched_[at(id)] = false;
  touched_.clear();
  begin();
}

int Workspace::add_sum(std::vector<Term> terms) {
  int id = 0;
  if (free_.empty()) {
    id = network_.add({.alive = false});
    grow();
  } else {
    id = free_.back();
    free_.pop_back();
    is_free_[at(id)] = false;
  }
  detach(id);
  Node& node = network_.node(id);
  node.terms = std::move(terms);
  node.alive = true;
  node.negated = false;
  attach(id);
  return id;
}

void Workspace::set_terms(int id, std::vector<Term> terms) {
  terms = normalised(network_, std::move(terms));
  grow();  // for new constants
  detach(id);
  network_.node(id).terms = std::move(terms);
  attach(id);
}

// ---- who reads what

std::vector<int> Workspace::readers(int id) const {
  std::vector<int> result;
  for (const auto& [reader, times] : readers_[at(id)]) result.push_back(reader);
  std::sort(result.begin(), result.end());
  return result;
}

int Workspace::uses(int id) const {
  int count = outputs_[at(id)] + static_cast<int>(inverses_[at(id)].size());
  for (const auto& [reader, times] : readers_[at(id)]) count += times;
  return count;
}

/// Read once, by a term that takes it in without a multiplication more.
bool Workspace::stands_alone(int id) const {
  if (readers_[at(id)].size() != 1 || uses(id) != 1) return false;
  if (network_.node(id).terms.size() == 1) return true;
  const Node& reader = network_.node(readers_[at(id)][0].first);
  return std::any_of(reader.terms.begin(), reader.terms.end(), [&](const Term& term) {
    return term.factors.size() == 1 && term.factors[0] == id;
  });
}

// ---- tidying

void Workspace::tidy() {
  while (!touched_.empty()) {
    const int id = touched_.back();
    touched_.pop_back();
    is_touched_[at(id)] = false;
    tidy(id);
  }
}

void Workspace::tidy(int id) {
  const Node& node = network_.node(id);
  const bool sum = node.kind == Node::Kind::kSum;
  if (!node.alive || (!sum && node.kind != Node::Kind::kInverse)) return;
  if (uses(id) == 0) {
    detach(id);
    network_.node(id).alive = false;
    network_.node(id).terms.clear();
    return;
  }
  if (!sum) return;
  // NOLINTNEXTLINE(bugprone-branch-clone): the order of the tests decides
  if (is_constant(node.terms)) {
    write_out_everywhere(id);
  } else if (is_copy(node.terms)) {
    replace(id, node.terms[0].factors[0], node.terms[0].negative);
  } else if (node.terms.size() == 1 && node.terms[0].negative && inverses_[at(id)].empty()) {
    negate(id);
  } else if (stands_alone(id)) {
    write_out_everywhere(id);
  } else {
    share(id);
  }
}

void Workspace::write_out_in(int id, int reader, const std::vector<Term>& value) {
  set_terms(reader, written_out(network_.node(reader).terms, id, value));
}

void Workspace::write_out_everywhere(int id) {
  const std::vector<Term> value = network_.node(id).terms;
  for (const int reader : readers(id)) write_out_in(id, reader, value);
}

/// Readers take another node, or its negation.
void Workspace::replace(int id, int other, bool negative) {
  if (negative && !inverses_[at(id)].empty()) return;
  const std::vector<int> inverses = inverses_[at(id)];
  for (const int inverse : inverses) {
    detach(inverse);
    network_.node(inverse).of = other;
    attach(inverse);
  }
  for (std::size_t i = 0; i < network_.outputs.size() && outputs_[at(id)] > 0; ++i) {
    NetworkOutput& output = network_.outputs[i];
    if (output.node != id) continue;
    output_journal_.push_back({i, output});
    --outputs_[at(id)];
    ++outputs_[at(other)];
    output.node = other;
    output.negative = output.negative != negative;
  }
  for (const int reader : readers(id)) write_out_in(id, reader, {{negative, {other}}});
  touch(id);
}

void Workspace::negate(int id) {
  std::vector<Term> terms = network_.node(id).terms;
  for (Term& term : terms) term.negative = !term.negative;
  for (const int reader : readers(id)) {
    std::vector<Term> own = network_.node(reader).terms;
    for (Term& term : own) {
      const auto power = std::count(term.factors.begin(), term.factors.end(), id);
      if (power % 2 == 1) term.negative = !term.negative;
    }
    set_terms(reader, std::move(own));
  }
  for (std::size_t i = 0; i < network_.outputs.size() && outputs_[at(id)] > 0; ++i) {
    if (network_.outputs[i].node != id) continue;
    output_journal_.push_back({i, network_.outputs[i]});
    network_.outputs[i].negative = !network_.outputs[i].negative;
  }
  detach(id);
  network_.node(id).terms = std::move(terms);
  network_.node(id).negated = !network_.node(id).negated;
  attach(id);
}

void Workspace::share(int id) {
  const std::vector<Term>& terms = network_.node(id).terms;
  const auto [first, last] = equal_.equal_range(unsigned_hash(terms));
  int other = -1;
  for (auto it = first; it != last; ++it) {
    const bool smaller = other < 0 || it->second < other;
    if (it->second != id && smaller && equal_up_to_sign(terms, network_.node(it->second).terms)) {
      other = it->second;
    }
  }
  if (other < 0) return;
  const bool negative = terms[0].negative != network_.node(other).terms[0].negative;
  replace(std::max(id, other), std::min(id, other), negative);
}

// ---- steps

void Workspace::name(int divisor_place) {
  const Divisor divisor = table_.divisor(divisor_place);
  const std::vector<int> nodes = table_.nodes(divisor_place);
  const auto it = std::find_if(nodes.begin(), nodes.end(), [&](int id) {
    return is_divisor(network_.node(id).terms, divisor);
  });
  const int known = it != nodes.end() ? *it : add_sum(divisor);
  const bool negated = network_.node(known).terms[0].negative;
  for (const int id : nodes) {
    if (id == known) continue;
    set_terms(id, divided(network_.node(id).terms, divisor, known, negated));
  }
}

void Workspace::settle(std::uint64_t order) {
  tidy();
  while (true) {
    const int before = operations_;
    const int divisor = table_.best(order);
    if (divisor < 0) return;
    order = order * 6364136223846793005U + (order == 0 ? 0 : 1442695040888963407U);
    name(divisor);
    tidy();
    if (operations_ >= before) return;
  }
}

void Workspace::write_out(int id, std::size_t most_terms) {
  const std::vector<Term> value = network_.node(id).terms;
  for (const int reader : readers(id)) {
    const std::vector<Term>& old = network_.node(reader).terms;
    const auto times = static_cast<std::size_t>(
        std::count_if(old.begin(), old.end(), [&](const Term& term) { return reads(term, id); }));
    if (old.size() + times * value.size() > most_terms) continue;
    write_out_in(id, reader, value);
  }
  touch(id);
}

}  // namespace dyngen
