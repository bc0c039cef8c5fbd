// SPDX-License-Identifier: MIT
// What is measured of the effects of a set, once their truths are known.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace blind {

/// Where a set lies, and what is to be written.
struct MeasuredSet {
  std::filesystem::path manifest, arms, out;
  void add_to(CLI::App& app);
};

/// Kinds of cases.
using Kinds = std::set<std::string>;

/// Writes a JSON object by case of what `measure` gives of its entry; those that it throws of are
/// told and left out.
/// @param kinds  that are measured
/// @param jobs  threads that share the cases
/// @return      how many were left out
int write_measured(const MeasuredSet& set, const Kinds& kinds, unsigned jobs,
                   const std::function<nlohmann::json(const nlohmann::json& entry)>& measure);

}  // namespace blind
