// SPDX-License-Identifier: MIT
#include "runtime/identification/summary_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::string_view kWord = "dyngenqr";
constexpr std::uint32_t kVersion = 2;
constexpr std::uint64_t kMostEntries = 1'000'000;  // of anything: a count above it is damage

/// CRC-32 of IEEE 802.3.
std::uint32_t checksum(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> values{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? 0xEDB88320U : 0);
      values[i] = value;
    }
    return values;
  }();
  std::uint32_t sum = 0xFFFFFFFFU;
  for (const char c : bytes)
    sum = table[(sum ^ static_cast<unsigned char>(c)) & 0xFFU] ^ (sum >> 8);
  return ~sum;
}

class Writer {
 public:
  void number(std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) text += static_cast<char>((value >> (8 * i)) & 0xFFU);
  }
  void count(std::size_t value) { number(value, 4); }
  void real(double value) { number(std::bit_cast<std::uint64_t>(value), 8); }
  void word(const std::string& value) {
    count(value.size());
    text += value;
  }
  void words(const std::vector<std::string>& values) {
    count(values.size());
    for (const std::string& value : values) word(value);
  }
  void vector(const VectorXd& values) {
    count(static_cast<std::size_t>(values.size()));
    for (const double value : values) real(value);
  }
  /// The upper triangle, row by row.
  void triangle(const MatrixXd& R) {
    count(static_cast<std::size_t>(R.rows()));
    for (Index i = 0; i < R.rows(); ++i) {
      for (Index k = i; k < R.cols(); ++k) real(R(i, k));
    }
  }

  std::string text;
};

class Reader {
 public:
  /// @param start  where in the file these bytes begin
  Reader(std::string_view bytes, std::size_t start, std::string name)
      : bytes_(bytes), start_(start), name_(std::move(name)) {}

  [[noreturn]] void fail(const std::string& reason) const {
    throw SummaryFileError(fmt::format("{}: error: byte {}: {}", name_, start_ + place_, reason));
  }
  std::uint64_t number(int bytes) {
    if (place_ + static_cast<std::size_t>(bytes) > bytes_.size()) fail("the file ends too early");
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[place_++])) << (8 * i);
    }
    return value;
  }
  std::size_t count() {
    const std::uint64_t value = number(4);
    if (value > kMostEntries)
      fail(fmt::format("a count of {}, expected at most {}", value, kMostEntries));
    return static_cast<std::size_t>(value);
  }
  double real() {
    const double value = std::bit_cast<double>(number(8));
    if (!std::isfinite(value)) fail("a number that is not finite");
    return value;
  }
  std::string word() {
    const std::size_t size = count();
    if (place_ + size > bytes_.size()) fail("the file ends too early");
    place_ += size;
    return std::string(bytes_.substr(place_ - size, size));
  }
  std::vector<std::string> words() {
    std::vector<std::string> values(count());
    for (std::string& value : values) value = word();
    return values;
  }
  VectorXd vector(std::size_t expected) {
    const std::size_t size = count();
    if (size != expected) fail(fmt::format("{} values, expected {}", size, expected));
    VectorXd values(static_cast<Index>(size));
    for (double& value : values) value = real();
    return values;
  }
  MatrixXd triangle(std::size_t expected) {
    const std::size_t size = count();
    if (size != expected) fail(fmt::format("a triangle of {} rows, expected {}", size, expected));
    const Index n = static_cast<Index>(size);
    MatrixXd R = MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i) {
      for (Index k = i; k < n; ++k) R(i, k) = real();
    }
    return R;
  }
  [[nodiscard]] bool at_end() const { return place_ == bytes_.size(); }

 private:
  std::string_view bytes_;
  std::size_t start_;
  std::string name_;
  std::size_t place_ = 0;
};

void write_factor(Writer& writer, const TorqueFactor& factor) {
  for (const JointFactor& joint : factor.joints) {
    writer.real(joint.rows);
    writer.triangle(joint.R);
  }
}

void read_factor(Reader& reader, TorqueFactor& factor) {
  for (std::size_t j = 0; j < factor.joints.size(); ++j) {
    factor.joints[j].rows = reader.real();
    factor.joints[j].R = reader.triangle(factor.columns[j].size() + 1);
  }
}

void write_summary(Writer& writer, const RecordingSummary& summary) {
  writer.number(static_cast<std::uint64_t>(summary.recordings), 8);
  for (const double value : {summary.row_time, summary.lowest_cutoff, summary.highest_cutoff}) {
    writer.real(value);
  }
  write_factor(writer, summary.equations);
  write_factor(writer, summary.regressor_noise);
  for (const MatrixXd& F : summary.noise.F) writer.triangle(F);
  writer.vector(summary.noise.power);
  writer.vector(summary.noise.correlated_power);
  const MotionExtent& extent = summary.extent;
  writer.real(extent.samples);
  for (const VectorXd* values :
       {&extent.lowest, &extent.highest, &extent.speed, &extent.acceleration}) {
    writer.vector(*values);
  }
}

RecordingSummary read_summary(Reader& reader, const std::vector<std::vector<int>>& columns,
                              int parameters) {
  RecordingSummary summary = empty_summary(columns, parameters);
  summary.recordings = static_cast<std::int64_t>(reader.number(8));
  for (double* value : {&summary.row_time, &summary.lowest_cutoff, &summary.highest_cutoff}) {
    *value = reader.real();
  }
  read_factor(reader, summary.equations);
  read_factor(reader, summary.regressor_noise);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    summary.noise.F[j] = reader.triangle(columns[j].size());
  }
  summary.noise.power = reader.vector(columns.size());
  summary.noise.correlated_power = reader.vector(columns.size());
  MotionExtent& extent = summary.extent;
  extent.samples = reader.real();
  for (VectorXd* values : {&extent.lowest, &extent.highest, &extent.speed, &extent.acceleration}) {
    *values = reader.vector(columns.size());
  }
  return summary;
}

}  // namespace

std::string write_summaries(const RobotSummaries& all) {
  Writer writer;
  writer.text = kWord;
  writer.number(kVersion, 4);
  writer.word(all.model);
  writer.words(all.joints);
  writer.words(all.parameters);
  const std::vector<std::vector<int>> none(all.joints.size());
  const auto& columns = all.robots.empty() ? none : all.robots.begin()->second.equations.columns;
  for (const std::vector<int>& of_joint : columns) {
    writer.count(of_joint.size());
    for (const int c : of_joint) writer.count(static_cast<std::size_t>(c));
  }
  writer.count(all.robots.size());
  for (const auto& [name, summary] : all.robots) {
    writer.word(name);
    write_summary(writer, summary);
  }
  writer.number(checksum(writer.text), 4);
  return writer.text;
}

RobotSummaries read_summaries(const std::string& bytes, const std::string& name) {
  const std::string_view all_bytes = bytes;
  if (!all_bytes.starts_with(kWord)) {
    throw SummaryFileError(
        fmt::format("{}: error: no file of 'dynid accumulate': expected it to "
                    "begin with '{}'",
                    name, kWord));
  }
  if (all_bytes.size() < kWord.size() + 8) {
    throw SummaryFileError(fmt::format("{}: error: the file ends too early", name));
  }
  const std::string_view content = all_bytes.substr(0, all_bytes.size() - 4);
  const std::uint64_t stored =
      Reader(all_bytes.substr(content.size()), content.size(), name).number(4);
  Reader reader(content.substr(kWord.size()), kWord.size(), name);
  const std::uint64_t version = reader.number(4);
  if (version != kVersion) {
    throw SummaryFileError(
        fmt::format("{}: error: version {} of the format, expected {}", name, version, kVersion));
  }
  if (stored != checksum(content)) {
    throw SummaryFileError(
        fmt::format("{}: error: the checksum does not fit: the file is damaged or cut off", name));
  }
  RobotSummaries all;
  all.model = reader.word();
  all.joints = reader.words();
  all.parameters = reader.words();
  std::vector<std::vector<int>> columns(all.joints.size());
  for (std::vector<int>& of_joint : columns) {
    of_joint.resize(reader.count());
    for (int& c : of_joint) {
      c = static_cast<int>(reader.count());
      if (static_cast<std::size_t>(c) >= all.parameters.size()) {
        reader.fail(fmt::format("parameter {} of {}", c, all.parameters.size()));
      }
    }
  }
  const std::size_t robots = reader.count();
  for (std::size_t i = 0; i < robots; ++i) {
    const std::string robot = reader.word();
    all.robots.emplace(robot,
                       read_summary(reader, columns, static_cast<int>(all.parameters.size())));
  }
  if (!reader.at_end()) reader.fail("more bytes than expected");
  return all;
}

RobotSummaries read_summary_file(const std::string& path) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  if (!stream || !(content << stream.rdbuf())) {
    throw SummaryFileError(fmt::format("{}: error: cannot read: {}", path,
                                       errno != 0 ? std::strerror(errno) : "it is empty"));
  }
  return read_summaries(content.str(), path);
}

bool is_summary_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string word(kWord.size(), '\0');
  return stream.read(word.data(), static_cast<std::streamsize>(word.size())) && word == kWord;
}

}  // namespace dyngen::runtime
