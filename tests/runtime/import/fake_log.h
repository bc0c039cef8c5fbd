// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/import/column_lookup.h"
#include "runtime/import/import_map.h"
#include "runtime/import/imported_rows.h"
#include "runtime/import/map_file.h"
#include "runtime/recordings/reader.h"

namespace dyngen::test {

/// A table in memory.
struct FakeTable {
  runtime::LogTable table;
  Eigen::MatrixXd values;
  std::optional<runtime::ColumnOrigin> origin{};  ///< of its first column
};

/// Tables in memory as a log: some rows of each in turn.
class FakeLog : public runtime::RawLog {
 public:
  explicit FakeLog(std::vector<FakeTable> tables) : tables_(std::move(tables)) {
    for (const FakeTable& one : tables_) names_.push_back(one.table);
    next_.resize(tables_.size(), 0);
  }
  [[nodiscard]] const std::vector<runtime::LogTable>& tables() const override { return names_; }
  bool next(runtime::LogRows& rows, std::size_t at_most) override {
    for (std::size_t tried = 0; tried < tables_.size(); ++tried) {
      const std::size_t t = turn_++ % tables_.size();
      const Eigen::MatrixXd& values = tables_[t].values;
      constexpr Eigen::Index kPiece = 50;
      const Eigen::Index count =
          std::min({values.rows() - next_[t], kPiece, static_cast<Eigen::Index>(at_most)});
      if (count == 0) continue;
      rows.table = t;
      rows.values = values.middleRows(next_[t], count);
      rows.places.clear();
      for (Eigen::Index k = 0; k < count; ++k) {
        rows.places.push_back(static_cast<std::uint64_t>(next_[t] + k + 2));
      }
      next_[t] += count;
      return true;
    }
    return false;
  }
  [[nodiscard]] std::string place_word() const override { return "line"; }
  [[nodiscard]] std::optional<runtime::ColumnOrigin> origin(std::size_t table,
                                                            std::size_t column) const override {
    return column == 0 ? tables_[table].origin : std::nullopt;
  }
  [[nodiscard]] double fraction_read() const override { return 0.5; }

 private:
  std::vector<FakeTable> tables_;
  std::vector<runtime::LogTable> names_;
  std::vector<Eigen::Index> next_;
  std::size_t turn_ = 0;
};

/// What a map makes of tables in memory.
struct Imported {
  runtime::Recording recording;
  std::vector<std::string> notices;
};

inline Imported imported(const std::string& map, std::vector<FakeTable> tables,
                         const runtime::ImportedRobot& robot = {}) {
  const runtime::ImportMap read = runtime::parse_import_map(map, "map.yaml");
  std::vector<runtime::OpenedLog> logs;
  logs.push_back({"log.csv", "", std::make_unique<FakeLog>(std::move(tables))});
  runtime::RecordingReader reader(
      [&](runtime::NoticeLog& log) {
        return runtime::imported_rows(read, std::move(logs), robot, log);
      },
      "log.csv", "line");
  Imported result;
  result.recording = runtime::read_all(reader);
  for (const runtime::Notice& notice : reader.notices()) result.notices.push_back(notice.text());
  return result;
}

/// A table of one motion: columns t and what is given.
inline FakeTable table_of(const std::string& name, std::vector<std::string> columns,
                          Eigen::MatrixXd values) {
  return {{name, std::move(columns), {}}, std::move(values)};
}

}  // namespace dyngen::test
