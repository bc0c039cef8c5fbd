// SPDX-License-Identifier: MIT
#include "tests/blind/cases/logger.h"

#include <cmath>

namespace blind {

using Eigen::Index;
using Eigen::VectorXd;

Columns columns_of(const Recording& recording, const Logger& logger) {
  const Log& log = recording.log;
  const Index count = log.q.rows() - logger.late;  // positions from the first row, torque later
  Columns columns;
  columns.q = (log.q + recording.encoder_error).topRows(count);
  columns.tau = (log.recorded + recording.torque_noise).bottomRows(count);
  columns.qd = log.dq.topRows(count);
  columns.qdd = log.ddq.topRows(count);
  if (logger.gain.size() > 0) columns.tau *= logger.gain.asDiagonal();
  columns.time.resize(count);
  Random random = Random(logger.stamps).part(recording.place);
  for (Index k = 0; k < count; ++k) {
    double samples = static_cast<double>(k);
    if (logger.jitter > 0) samples += random.between(0, logger.jitter);
    columns.time[k] = samples / log.rate;
    if (logger.digit > 0)
      columns.time[k] = std::round(columns.time[k] / logger.digit) * logger.digit;
  }
  return columns;
}

}  // namespace blind
