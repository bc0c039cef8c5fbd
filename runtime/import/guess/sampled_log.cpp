// SPDX-License-Identifier: MIT
#include "runtime/import/guess/sampled_log.h"

#include <algorithm>
#include <memory>

#include "runtime/recordings/notice.h"

namespace dyngen::runtime {

SampledLog sample_logs(const std::vector<std::string>& paths, std::size_t most) {
  using Eigen::Index;
  SampledLog sampled;
  sampled.paths = paths;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    try {
      const std::unique_ptr<RawLog> log = open_log(paths[i]);
      const std::size_t tables = log->tables().size();
      std::vector<Eigen::MatrixXd> values(tables);
      std::vector<Index> counts(tables, 0);
      constexpr std::size_t kAtOnce = 4096;
      for (LogRows rows; log->next(rows, kAtOnce);) {
        Eigen::MatrixXd& own = values[rows.table];
        Index& count = counts[rows.table];
        if (own.size() == 0) own.resize(static_cast<Index>(most), rows.values.cols());
        const Index room = std::min(own.rows() - count, rows.values.rows());
        own.middleRows(count, room) = rows.values.topRows(room);
        count += room;
        // tables come in turn: when one is full, the others have what belongs to it
        if (count == own.rows()) break;
      }
      for (std::size_t t = 0; t < tables; ++t) {
        if (counts[t] == 0) continue;
        sampled.tables.push_back({i, log->tables()[t], values[t].topRows(counts[t]), {}});
        for (std::size_t c = 0; c < log->tables()[t].columns.size(); ++c) {
          sampled.tables.back().words.push_back(log->constant_word(t, c));
        }
      }
    } catch (const LogError& error) {
      throw RecordingError(error.what());
    }
  }
  return sampled;
}

}  // namespace dyngen::runtime
