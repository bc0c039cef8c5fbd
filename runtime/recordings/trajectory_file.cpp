// SPDX-License-Identifier: MIT
#include "runtime/recordings/trajectory_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "runtime/recordings/notice_log.h"
#include "runtime/recordings/spline.h"
#include "runtime/recordings/writer.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

void check_shape(const char* name, const Eigen::MatrixXd& matrix, Index samples, Index joints) {
  if (matrix.rows() != samples || matrix.cols() != joints) {
    throw std::invalid_argument(fmt::format("Trajectory: {} is {} x {}, expected {} x {}", name,
                                            matrix.rows(), matrix.cols(), samples, joints));
  }
  if (!matrix.allFinite()) {
    throw std::invalid_argument(fmt::format("Trajectory: {} has a value that is not finite", name));
  }
}

/// The quintic over [0, 1] with the values p, first derivatives v and second derivatives a at its
/// ends, and its derivatives with respect to the same variable.
struct Quintic {
  double p0, v0, a0, c3, c4, c5;

  Quintic(double p_left, double v_left, double a_left, double p_right, double v_right,
          double a_right)
      : p0(p_left), v0(v_left), a0(a_left) {
    // what the right end asks for beyond the left end's parabola
    const double dp = p_right - p0 - v0 - a0 / 2;
    const double dv = v_right - v0 - a0;
    const double da = a_right - a0;
    c3 = 10 * dp - 4 * dv + da / 2;
    c4 = -15 * dp + 7 * dv - da;
    c5 = 6 * dp - 3 * dv + da / 2;
  }
  [[nodiscard]] double value(double s) const {
    return p0 + s * (v0 + s * (a0 / 2 + s * (c3 + s * (c4 + s * c5))));
  }
  [[nodiscard]] double first(double s) const {
    return v0 + s * (a0 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)));
  }
  [[nodiscard]] double second(double s) const {
    return a0 + s * (6 * c3 + s * (12 * c4 + s * 20 * c5));
  }
};

void stand_at(const Trajectory& trajectory, Index sample, double* q, double* dq,
              double* ddq) noexcept {
  const Index n = trajectory.q.cols();
  for (Index j = 0; j < n; ++j) {
    if (q != nullptr) q[j] = trajectory.q(sample, j);
    if (dq != nullptr) dq[j] = 0;
    if (ddq != nullptr) ddq[j] = 0;
  }
}

}  // namespace

void Trajectory::validate() const {
  if (time.size() < 2 || q.cols() < 1) {
    throw std::invalid_argument(
        fmt::format("Trajectory: {} samples of {} joints, expected at least 2 of at least 1",
                    time.size(), q.cols()));
  }
  check_shape("q", q, time.size(), q.cols());
  check_shape("dq", dq, time.size(), q.cols());
  check_shape("ddq", ddq, time.size(), q.cols());
  for (Index k = 0; k < time.size(); ++k) {
    if (!(k == 0 ? time(k) - time(k) == 0 : time(k) > time(k - 1))) {
      throw std::invalid_argument(fmt::format(
          "Trajectory: time({}) is {}, expected finite values that increase", k, time(k)));
    }
  }
}

Trajectory read_trajectory(const std::string& path, std::vector<Notice>* repairs) {
  return read_trajectory(recording_file(path), repairs);
}

Trajectory read_trajectory(const RecordingInput& input, std::vector<Notice>* repairs) {
  ReadOptions options;
  options.torque_required = false;
  Recording recording = read_recording(input, options, repairs);
  if (recording.run_starts.size() > 1) {
    const Index next = recording.run_starts[1];
    throw recording_error(
        input.name, 0, 0,
        fmt::format("found {} runs (time starts again, leaves a gap or changes its segment after "
                    "{} s), expected one trajectory without a gap",
                    recording.run_starts.size(), recording.time(next - 1)));
  }
  Trajectory trajectory;
  trajectory.time = std::move(recording.time);
  trajectory.q = std::move(recording.q);
  trajectory.dq = recording.dq.cols() > 0 ? std::move(recording.dq)
                                          : differentiate_spline(trajectory.time, trajectory.q);
  trajectory.ddq = recording.ddq.cols() > 0 ? std::move(recording.ddq)
                                            : differentiate_spline(trajectory.time, trajectory.dq);
  return trajectory;
}

void write_trajectory(const Trajectory& trajectory, const std::string& path) {
  trajectory.validate();
  Recording recording;
  recording.time = trajectory.time;
  recording.q = trajectory.q;
  recording.dq = trajectory.dq;
  recording.ddq = trajectory.ddq;
  recording.run_starts = {0};
  WriteOptions options;
  options.torque_required = false;
  write_recording(recording, path, options);
}

void motion_at(const Trajectory& trajectory, double time, double* q, double* dq,
               double* ddq) noexcept {
  const double* begin = trajectory.time.data();
  const Index last = trajectory.time.size() - 1;
  if (!(time >= begin[0])) return stand_at(trajectory, 0, q, dq, ddq);
  if (time > begin[last]) return stand_at(trajectory, last, q, dq, ddq);
  const Index left =
      std::min<Index>(std::upper_bound(begin, begin + last + 1, time) - begin, last) - 1;
  const double h = begin[left + 1] - begin[left];
  const double s = (time - begin[left]) / h;
  for (Index j = 0; j < trajectory.q.cols(); ++j) {
    const Quintic curve(trajectory.q(left, j), h * trajectory.dq(left, j),
                        h * h * trajectory.ddq(left, j), trajectory.q(left + 1, j),
                        h * trajectory.dq(left + 1, j), h * h * trajectory.ddq(left + 1, j));
    if (q != nullptr) q[j] = curve.value(s);
    if (dq != nullptr) dq[j] = curve.first(s) / h;
    if (ddq != nullptr) ddq[j] = curve.second(s) / (h * h);
  }
}

}  // namespace dyngen::runtime
