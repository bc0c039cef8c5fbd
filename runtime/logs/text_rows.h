// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/logs/log_words.h"
#include "runtime/logs/text_layout.h"

namespace dyngen::runtime {

/// The rows of a sample, cut at one separator.
struct SampleRows {
  char separator = ',';
  std::size_t fields = 0;              ///< of a row of data
  std::vector<std::size_t> rows;       ///< indices of the lines that are rows of data
  std::vector<WordKind> column_kinds;  ///< of each field, what most rows have there
  double odd_fields = 0;               ///< share of words in which another separator stands
  double text_fields = 0;              ///< share of words that are text
  bool header_fits = false;            ///< the line before has as many fields
};

/// Cuts the sample's lines at a separator and finds the rows of numbers; nothing if there are none.
std::optional<SampleRows> rows_by(char separator, const std::vector<SampleLine>& sample);

/// The way to cut lines that gives the most rows, with the least text between numbers.
std::optional<SampleRows> best_rows(const std::vector<SampleLine>& sample,
                                    std::optional<char> separator);

/// The fields of a line without empty ones at its end beyond `fields`.
std::vector<std::string_view> fields_of(std::string_view line, char separator, std::size_t fields);

}  // namespace dyngen::runtime
