// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <deque>
#include <string>
#include <unordered_map>

namespace dyngen {

enum class SymbolKind {
  kInput,         ///< q, dq, ddq, tau of one joint; gravity, wrench, payload
  kParameter,     ///< an entry of chi
  kConstant,      ///< a named number
  kIntermediate,  ///< assigned by the program
};

/// What is known of a symbol.
struct SymbolInfo {
  GiNaC::symbol symbol{};
  std::string name{};  ///< unique in its table; also the C name of constants and intermediates
  SymbolKind kind = SymbolKind::kIntermediate;
  std::string unit{};
  std::string comment{};  ///< where it comes from ("ur10e.robot:9"); may be empty
  GiNaC::ex value = 0;    ///< of a constant: exact
  std::string array{};    ///< of an input or parameter: the C array that holds it ("q", "chi")
  int index = -1;         ///< its place in that array
  bool shared = false;    ///< of an input or parameter: one for all samples of a batch
};

/// Makes each symbol once and remembers its place: the only source of order in the output.
///
/// GiNaC orders symbols by a serial number and a hash that change from run to run, so everything
/// that is written is sorted by these places. A table may stand on a parent's: its places come
/// after the parent's.
class SymbolTable {
 public:
  SymbolTable() = default;
  explicit SymbolTable(const SymbolTable* parent) : parent_(parent) {}

  /// Adds a symbol. If the name is taken, "_2", "_3" ... is added to it.
  GiNaC::symbol add(SymbolInfo info);

  /// @throws InternalError if the symbol was not made here
  [[nodiscard]] const SymbolInfo& info(const GiNaC::ex& symbol) const;
  [[nodiscard]] int place(const GiNaC::ex& symbol) const;
  [[nodiscard]] bool contains(const std::string& name) const;
  /// @return null if no symbol has this name
  [[nodiscard]] const SymbolInfo* find_name(const std::string& name) const;
  [[nodiscard]] const SymbolTable* parent() const { return parent_; }
  /// Made by this table itself, in order.
  [[nodiscard]] const std::deque<SymbolInfo>& own() const { return own_; }

 private:
  struct Found {
    const SymbolInfo* info = nullptr;
    int place = -1;
  };
  [[nodiscard]] Found find(const std::string& name) const;
  [[nodiscard]] int size() const;

  const SymbolTable* parent_ = nullptr;
  std::deque<SymbolInfo> own_;  // references to its entries stay valid
  std::unordered_map<std::string, int> index_;
};

/// A named number in a table: its symbol, or the number itself if it is 0, 1 or -1.
/// The same name with the same value is the same symbol.
GiNaC::ex add_constant(SymbolTable& table, const std::string& name, const GiNaC::ex& value,
                       const std::string& unit = {}, const std::string& comment = {});

}  // namespace dyngen
