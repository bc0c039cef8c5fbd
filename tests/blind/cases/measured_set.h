// SPDX-License-Identifier: MIT
// What is measured of the single effects of a set, once their truths are known.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

namespace blind {

/// Where a set lies, and what is to be written.
struct MeasuredSet {
  std::filesystem::path manifest, arms, out;
  void add_to(CLI::App& app);
};

/// Writes a JSON object by case of what `measure` gives of its entry; those that it throws of are
/// told and left out.
/// @param jobs  threads that share the cases
/// @return      how many were left out
int write_measured(const MeasuredSet& set, unsigned jobs,
                   const std::function<nlohmann::json(const nlohmann::json& entry)>& measure);

}  // namespace blind
