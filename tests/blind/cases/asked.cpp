// SPDX-License-Identifier: MIT
#include "tests/blind/cases/asked.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLongestLead = 10;  // s
constexpr double kSame = 1e-6;       // rad: the digits of a file

/// Rows of numbers behind a header.
MatrixXd read_rows(const std::string& path, Index columns) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be opened", path));
  std::string line;
  std::getline(file, line);
  std::vector<double> values;
  for (Index number = 2; std::getline(file, line); ++number) {
    const char* at = line.data();
    const char* const end = at + line.size();
    for (Index c = 0; c < columns; ++c) {
      double value = 0;
      const auto read = std::from_chars(at, end, value);
      const bool ends = c + 1 == columns;
      const bool good = read.ec == std::errc() && std::isfinite(value) &&
                        (ends ? read.ptr == end : read.ptr != end && *read.ptr == ',');
      if (!good) {
        throw std::runtime_error(fmt::format("{}:{}: expected {} numbers with commas between them",
                                             path, number, columns));
      }
      values.push_back(value);
      at = ends ? end : read.ptr + 1;
    }
  }
  return Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(
      values.data(), static_cast<Index>(values.size()) / columns, columns);
}

Colour colour_of(const std::string& name) {
  for (const Colour colour :
       {Colour::kWhite, Colour::kAutoregressive, Colour::kMixed, Colour::kPink}) {
    if (colour_name(colour) == name) return colour;
  }
  throw std::runtime_error(fmt::format("noise: found '{}'", name));
}

/// The polynomial of the fifth degree from one state to another in h seconds.
Wanted between(const Wanted& a, const Wanted& b, double h, double u) {
  const VectorXd way = b.q - a.q - h * a.dq - h * h / 2 * a.ddq;
  const VectorXd more = h * (b.dq - a.dq - h * a.ddq), bend = h * h * (b.ddq - a.ddq);
  const VectorXd c3 = 10 * way - 4 * more + bend / 2;
  const VectorXd c4 = -15 * way + 7 * more - bend;
  const VectorXd c5 = 6 * way - 3 * more + bend / 2;
  Wanted wanted;
  wanted.q = a.q + u * h * a.dq + u * u * h * h / 2 * a.ddq + u * u * u * (c3 + u * (c4 + u * c5));
  wanted.dq = a.dq + u * h * a.ddq + u * u * (3 * c3 + u * (4 * c4 + 5 * u * c5)) / h;
  wanted.ddq = a.ddq + u * (6 * c3 + u * (12 * c4 + 20 * u * c5)) / (h * h);
  return wanted;
}

/// Of a crowd's truths, some may not have reached their strength: they are in no entry.
void leave_out_others(const nlohmann::json& truths, Draft& draft) {
  std::erase_if(draft.truths, [&](const Truth& drawn) {
    return std::none_of(truths.begin(), truths.end(), [&](const nlohmann::json& one) {
      return one["family"] == drawn.family && one["joint"] == drawn.joint;
    });
  });
}

}  // namespace

Motion read_motion(const std::string& path, Index joints) {
  const MatrixXd rows = read_rows(path, 1 + 3 * joints);
  const Index count = rows.rows();
  if (count < 3) throw std::runtime_error(fmt::format("{}: fewer than 3 rows", path));
  const double h = (rows(count - 1, 0) - rows(0, 0)) / static_cast<double>(count - 1);
  for (Index k = 0; k < count; ++k) {
    if (std::abs(rows(k, 0) - rows(0, 0) - h * static_cast<double>(k)) < h / 100) continue;
    throw std::runtime_error(fmt::format("{}:{}: rows are not equally far apart", path, k + 2));
  }
  const auto row = [rows, joints](Index k) {
    return Wanted{rows.row(k).segment(1, joints).transpose(),
                  rows.row(k).segment(1 + joints, joints).transpose(),
                  rows.row(k).segment(1 + 2 * joints, joints).transpose()};
  };
  const Wanted first = row(0), last = row(count - 1);
  const double fastest = rows.middleCols(1 + joints, joints).cwiseAbs().maxCoeff();
  const bool meets = (last.q - first.q).cwiseAbs().maxCoeff() < kSame &&
                     (last.dq - first.dq).cwiseAbs().maxCoeff() < kSame * (1 + fastest);
  if (!meets && first.dq.cwiseAbs().maxCoeff() > 1e-6 * fastest) {
    throw std::runtime_error(fmt::format("{}: it neither begins at rest nor where it ends", path));
  }
  const double duration = h * static_cast<double>(count - 1);
  return {duration, meets, [=](double t) {
            if (!meets && t <= 0) {
              return Wanted{first.q, VectorXd::Zero(joints), VectorXd::Zero(joints)};
            }
            if (meets) t -= std::floor(t / duration) * duration;
            const Index k = std::clamp<Index>(static_cast<Index>(std::floor(t / h)), 0, count - 2);
            const double u = std::clamp(t / h - static_cast<double>(k), 0.0, 1.0);
            return between(row(k), row(k + 1), h, u);
          }};
}

Redrawn redraw(const nlohmann::json& entry, const std::string& arms) {
  CaseOptions options;
  options.kind = entry["kind"];
  options.lambda = entry["wanted_lambda"];
  options.seed = entry["seed"];
  options.arm = entry["arm"];
  options.family = entry.value("wanted_family", "");
  options.habit = entry.value("habit", "");
  auto drawn = draw_case(options, arms);
  const auto& truths = entry["truths"];
  if (drawn && options.kind == "crowd") leave_out_others(truths, *drawn);
  bool same = drawn && drawn->truths.size() == truths.size() && drawn->rate == entry["rate"];
  Redrawn redrawn;
  for (std::size_t i = 0; same && i < truths.size(); ++i) {
    same = drawn->truths[i].family == truths[i]["family"] &&
           drawn->truths[i].form == truths[i]["form"] &&
           drawn->truths[i].joint == truths[i]["joint"];
    redrawn.sizes.push_back(truths[i]["size"]);
  }
  if (!same) {
    throw std::runtime_error(fmt::format("{}: seed {} draws something else here",
                                         entry.value("case", "a case"), options.seed));
  }
  redrawn.draft = *drawn;
  redrawn.draft.noise.colour = colour_of(entry["noise"]);  // it may have been told
  redrawn.deviation = noise_deviation(*drawn);
  return redrawn;
}

Recording record_again(const Redrawn& redrawn, std::size_t place) {
  const Draft& draft = redrawn.draft;
  Recording recording = record(draft, draft.truths, redrawn.sizes, ride_of(draft, place));
  add_noise_at(draft, redrawn.deviation, place, recording);
  return recording;
}

Recording record_along(const Redrawn& redrawn, const Motion& motion) {
  const Draft& draft = redrawn.draft;
  const std::size_t place = draft.motions.size();  // behind all that were made
  const double lead = motion.repeats ? std::min(motion.duration, kLongestLead) : 1;
  Recording recording =
      record(draft, draft.truths, redrawn.sizes, {motion, lead, motion.duration, place});
  add_noise_at(draft, redrawn.deviation, place, recording);
  return recording;
}

std::vector<Recording> training_again(const Redrawn& redrawn) {
  std::vector<Recording> training;
  for (std::size_t place = 0; place < redrawn.draft.training; ++place) {
    training.push_back(record_again(redrawn, place));
  }
  return training;
}

}  // namespace blind
