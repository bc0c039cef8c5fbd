// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/symbols/symbol_table.h"

#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/symbols/exact.h"

namespace dyngen {

int SymbolTable::size() const {
  return static_cast<int>(own_.size()) + (parent_ == nullptr ? 0 : parent_->size());
}

SymbolTable::Found SymbolTable::find(const std::string& name) const {
  if (const auto it = index_.find(name); it != index_.end()) {
    const int base = parent_ == nullptr ? 0 : parent_->size();
    return {&own_[static_cast<std::size_t>(it->second)], base + it->second};
  }
  return parent_ == nullptr ? Found{} : parent_->find(name);
}

bool SymbolTable::contains(const std::string& name) const { return find(name).info != nullptr; }

const SymbolInfo* SymbolTable::find_name(const std::string& name) const { return find(name).info; }

GiNaC::symbol SymbolTable::add(SymbolInfo info) {
  if (contains(info.name)) {
    int copy = 2;
    while (contains(info.name + "_" + std::to_string(copy))) ++copy;
    info.name += "_" + std::to_string(copy);
  }
  info.symbol = GiNaC::symbol(info.name);
  index_.emplace(info.name, static_cast<int>(own_.size()));
  own_.push_back(std::move(info));
  return own_.back().symbol;
}

const SymbolInfo& SymbolTable::info(const GiNaC::ex& symbol) const {
  DYNGEN_ASSERT(GiNaC::is_a<GiNaC::symbol>(symbol), "only symbols have an entry");
  const Found found = find(GiNaC::ex_to<GiNaC::symbol>(symbol).get_name());
  DYNGEN_ASSERT(found.info != nullptr, "the symbol belongs to another table");
  return *found.info;
}

int SymbolTable::place(const GiNaC::ex& symbol) const {
  DYNGEN_ASSERT(GiNaC::is_a<GiNaC::symbol>(symbol), "only symbols have a place");
  const Found found = find(GiNaC::ex_to<GiNaC::symbol>(symbol).get_name());
  DYNGEN_ASSERT(found.info != nullptr, "the symbol belongs to another table");
  return found.place;
}

GiNaC::ex add_constant(SymbolTable& table, const std::string& name, const GiNaC::ex& value,
                       const std::string& unit, const std::string& comment) {
  DYNGEN_ASSERT(is_number(value), name);
  GiNaC::ex settled = rational_or_float(value);
  if (settled.is_zero() || settled.is_equal(1) || settled.is_equal(-1)) return settled;
  if (const SymbolInfo* found = table.find_name(name); found != nullptr &&
                                                       found->kind == SymbolKind::kConstant &&
                                                       is_zero_number(found->value - settled)) {
    return found->symbol;
  }
  SymbolInfo info;
  info.name = name;
  info.kind = SymbolKind::kConstant;
  info.unit = unit;
  info.comment = comment;
  info.value = settled;
  return table.add(std::move(info));
}

}  // namespace dyngen
