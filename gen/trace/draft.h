// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gen/trace/trace.h"

namespace dyngen {

/// A short sum of products of draft symbols with whole coefficients; the terms stand in one order.
/// No memory is allocated: drafts are written many times over.
class DraftValue {
 public:
  static constexpr std::size_t kMostFactors = 4;
  static constexpr std::size_t kMostTerms = 8;
  struct Term {
    int coefficient;
    std::array<int, kMostFactors> factors;  ///< symbols, ascending, then -1

    bool operator==(const Term&) const = default;
  };

  DraftValue() = default;
  DraftValue(const DraftValue& other) { *this = other; }
  DraftValue& operator=(const DraftValue& other) {
    size_ = other.size_;
    std::copy_n(other.terms_.begin(), size_, terms_.begin());
    return *this;
  }
  DraftValue(int number);  // NOLINT: numbers stand in formulas
  static DraftValue symbol(int symbol);

  [[nodiscard]] bool is_zero() const { return size_ == 0; }
  [[nodiscard]] std::span<const Term> terms() const { return {terms_.data(), size_}; }
  /// A number, x or -x.
  [[nodiscard]] bool is_plain() const;

  DraftValue operator-() const;
  friend DraftValue operator+(const DraftValue& a, const DraftValue& b);
  friend DraftValue operator-(const DraftValue& a, const DraftValue& b) { return a + -b; }
  friend DraftValue operator*(const DraftValue& a, const DraftValue& b);
  DraftValue& operator+=(const DraftValue& other) { return *this = *this + other; }
  bool operator==(const DraftValue& other) const {
    return std::equal(terms().begin(), terms().end(), other.terms().begin(), other.terms().end());
  }

 private:
  void add(const Term& term);

  std::size_t size_ = 0;
  std::array<Term, kMostTerms> terms_;  // the first size_ of them
};

/// The symbols that drafts start from: what an algorithm has in the trace already.
class DraftLeaves {
 public:
  explicit DraftLeaves(Trace& trace) : trace_(trace) {}

  /// @param value  a symbol, its negative, 0, 1 or -1; anything else gets a statement of this name
  DraftValue add(const std::string& name, const GiNaC::ex& value);

  [[nodiscard]] std::size_t size() const { return symbols_.size(); }
  [[nodiscard]] const GiNaC::ex& symbol(std::size_t i) const { return symbols_[i]; }
  [[nodiscard]] bool constant(std::size_t i) const { return constant_[i]; }
  [[nodiscard]] Trace& trace() const { return trace_; }

 private:
  Trace& trace_;
  std::vector<GiNaC::ex> symbols_;
  std::vector<bool> constant_;
};

/// Name of a statement: stem, then numbers: "FN3_6_4".
struct DraftName {
  const char* stem = "";
  int component = 0;  ///< left out if 0
  int first = 0;
  int second = 0;  ///< left out if 0

  [[nodiscard]] std::string text() const;
};

/// A program that is cheap to write and to count, for algorithms that try several ways and keep
/// the shortest.
///
/// As in a Trace, what is zero, one, a copy or assigned already makes no statement. Nothing is
/// written to the trace before write().
class Draft {
 public:
  explicit Draft(const DraftLeaves& leaves);

  /// Statements that follow belong to this section: the title is before + number + after.
  void section(const char* before, int number, const char* after);
  DraftValue assign(const DraftName& name, const DraftValue& value);
  /// A value that is wanted. @return its place for write()
  std::size_t want(const DraftValue& value);

  /// Multiplications and additions of what is wanted.
  [[nodiscard]] int count() const;
  /// Statements made, wanted or not: what a draft costs to write.
  [[nodiscard]] std::size_t statement_count() const { return statements_.size(); }

  /// Writes what is wanted into the trace. @return the values, in the order of want()
  std::vector<GiNaC::ex> write() const;

 private:
  struct Statement {
    DraftName name;
    DraftValue value;
    int symbol = 0;
    int section = 0;
  };
  struct Section {
    const char* before = "";
    int number = 0;
    const char* after = "";
  };
  /// Place in index_ of a value that is assigned, or of the gap where it belongs.
  [[nodiscard]] std::size_t find(const DraftValue& value) const;
  void grow_index();
  [[nodiscard]] std::vector<bool> needed() const;
  [[nodiscard]] int operations(const DraftValue& value) const;

  const DraftLeaves& leaves_;
  std::vector<bool> constant_;  // of every symbol
  std::vector<Statement> statements_;
  std::vector<DraftValue> wanted_;
  std::vector<Section> sections_;
  std::vector<int> index_;  // hash table of statements: their places, -1 where there is a gap
};

}  // namespace dyngen
