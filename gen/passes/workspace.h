// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "gen/passes/divisor_table.h"
#include "gen/passes/network.h"

namespace dyngen {

/// A network under work: what reads what, which sums are equal and what each divisor saves are kept
/// up to date with every change, and changes can be taken back.
class Workspace {
 public:
  explicit Workspace(Network network);

  [[nodiscard]] const Network& network() const { return network_; }
  [[nodiscard]] int operations() const { return operations_; }
  /// Divisors looked at until now: the measure of the time that was spent.
  [[nodiscard]] std::int64_t work() const { return table_.work(); }
  [[nodiscard]] bool is_live_sum(int id) const {
    return network_.node(id).alive && network_.is_sum(id);
  }

  /// Takes copies, negations, equal sums and what is not read away, writes what is read once where
  /// it is read, and names divisors while that saves operations.
  /// @param order  chooses between divisors that save as much
  void settle(std::uint64_t order);

  /// Writes a sum out in its readers, but for those that would have more terms than this.
  void write_out(int id, std::size_t most_terms);

  /// Changes from here on can be taken back; those before are kept.
  void begin();
  void roll_back();

 private:
  struct Change {
    int id = 0;
    Node::Kind kind = Node::Kind::kSum;
    std::vector<Term> terms;
    int of = -1;
    bool alive = true;
    bool negated = false;
    DivisorTable::Offers offers;
  };
  struct OutputChange {
    std::size_t output = 0;
    NetworkOutput old;
  };

  void grow();
  int add_sum(std::vector<Term> terms);
  /// Takes a node out of the books, before it changes; attach() takes it in again.
  void detach(int id);
  void attach(int id);
  void enter(int id);
  void leave(int id);
  void touch(int id);
  void set_terms(int id, std::vector<Term> terms);
  [[nodiscard]] std::vector<int> readers(int id) const;
  [[nodiscard]] int uses(int id) const;
  [[nodiscard]] bool stands_alone(int id) const;
  void tidy();
  void tidy(int id);
  void write_out_in(int id, int reader, const std::vector<Term>& value);
  void write_out_everywhere(int id);
  void share(int id);
  void replace(int id, int other, bool negative);
  void negate(int id);
  void name(int divisor);

  Network network_;
  DivisorTable table_;
  std::vector<DivisorTable::Offers> offers_;               // of each node
  std::vector<std::vector<std::pair<int, int>>> readers_;  // of each node: sum, how often
  std::vector<std::vector<int>> inverses_;                 // of each node
  std::vector<int> outputs_;                               // that each node is
  std::unordered_multimap<std::size_t, int> equal_;        // hash of the unsigned terms -> sum
  std::vector<int> touched_;
  std::vector<bool> is_touched_;
  int first_own_ = 0;      // sums from here on are ours
  std::vector<int> free_;  // of them, those that are dead
  std::vector<bool> is_free_;
  std::vector<Change> journal_;
  std::vector<OutputChange> output_journal_;
  int operations_ = 0;
};

}  // namespace dyngen
