// SPDX-License-Identifier: MIT
// Logs that writers of their own have written (write_logs.py), read exactly; and damaged ones.
#include "tests/runtime/logs/written_logs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>

#include "runtime/logs/log_summary.h"
#include "tests/runtime/logs/read_log.h"

namespace dyngen::test {
namespace {

using testing::HasSubstr;

/// Tables that a log must have, from NAME.expected.
std::vector<WholeTable> expected_tables(const std::string& path) {
  std::ifstream file(path + ".expected");
  std::vector<WholeTable> tables;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> words;
    std::size_t begin = 0;
    for (std::size_t end = 0; end != line.npos; begin = end + 1) {
      end = line.find('\t', begin);
      words.push_back(line.substr(begin, end == line.npos ? end : end - begin));
    }
    const std::vector<std::string> rest(words.begin() + 1, words.end());
    if (words[0] == "table") tables.push_back({rest[0], {}, {}, {}, {}});
    if (words[0] == "columns") tables.back().columns = rest;
    if (words[0] == "units") tables.back().units = rest;
    if (words[0] != "row") continue;
    std::vector<double> row;
    for (const std::string& word : rest) row.push_back(std::strtod(word.c_str(), nullptr));
    tables.back().rows.push_back(row);
  }
  return tables;
}

void expect_tables(const WholeLog& log, const std::vector<WholeTable>& expected) {
  ASSERT_EQ(log.tables.size(), expected.size()) << log.notices;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const WholeTable &found = log.tables[i], &wanted = expected[i];
    EXPECT_EQ(found.name, wanted.name);
    EXPECT_EQ(found.columns, wanted.columns);
    EXPECT_EQ(found.units, wanted.units);
    ASSERT_EQ(found.rows.size(), wanted.rows.size()) << found.name;
    for (std::size_t row = 0; row < wanted.rows.size(); ++row) {
      ASSERT_EQ(found.rows[row].size(), wanted.rows[row].size());
      for (std::size_t k = 0; k < wanted.rows[row].size(); ++k) {
        ASSERT_TRUE(same_number(found.rows[row][k], wanted.rows[row][k]))
            << found.name << ", row " << row << ", " << found.columns[k] << ": "
            << found.rows[row][k] << ", expected " << wanted.rows[row][k];
      }
    }
  }
}

/// All logs that were written, once for the suite.
class WrittenLogsOf : public testing::Test {
 protected:
  static void SetUpTestSuite() { logs_ = std::make_unique<WrittenLogs>(); }
  static void TearDownTestSuite() { logs_.reset(); }

  void SetUp() override {
    if (logs_->absent().starts_with("FAILED")) FAIL() << logs_->absent();
    if (!logs_->absent().empty()) GTEST_SKIP() << logs_->absent();
  }

  static std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(logs_->path(""))) {
      const std::string name = entry.path().filename().string();
      if (logs_->has(name + ".expected")) all.push_back(name);
    }
    return all;
  }

  static std::unique_ptr<WrittenLogs> logs_;
};
std::unique_ptr<WrittenLogs> WrittenLogsOf::logs_;

TEST_F(WrittenLogsOf, AllFormatsAreReadExactly) {
  EXPECT_GE(names().size(), 35U);
  for (const std::string& name : names()) {
    SCOPED_TRACE(name);
    const std::string path = logs_->path(name);
    if (const std::string package = absent_package_of(name); !package.empty()) {
      try {
        runtime::open_log(path);
        ADD_FAILURE() << "opened without " << package;
      } catch (const runtime::LogError& error) {
        EXPECT_THAT(error.what(), HasSubstr(package));
      }
      continue;
    }
    const std::vector<WholeTable> expected = expected_tables(path);
    const auto log = runtime::open_log(path);
    expect_tables(read_whole(*log), expected);
    const auto from_memory = runtime::open_log_bytes(bytes_of_file(path), name);
    expect_tables(read_whole(*from_memory, 1000), expected);
  }
}

TEST_F(WrittenLogsOf, WhatIsLeftOutIsTold) {
  struct Told {
    const char *name, *notice;
  };
  for (const Told& told : std::initializer_list<Told>{
           {"humble.db3",
            "topic '/strange' is left out: its type 'who_msgs/msg/Knows' is not known"},
           {"records.mcap", "'mode' of '/custom' is left out (text)"},
           {"records.mcap", "'picture' of '/custom' is left out (bytes)"},
           {"records.mcap", "topic '/proto' is left out: messages encoded as 'protobuf'"},
           {"stored.npz", "gain = 0.5"},
           {"stored.npz", "word (type <U1) is left out"},
           {"turned.npy", "has 3 x 50 elements; samples are taken along the second side"},
           {"record.npy", "word (type |S3) is left out"},
           {"lines.jsonl", "'name' is left out (text)"},
           {"document.json", "constants beside the tables: mass = 0.49, setup.kp = 100"},
           {"document.json", "setup.gravity"},
           {"seven.mat", "gain = 0.5"},
           {"seven.mat", "'rec.cells' is left out (a cell array)"},
           {"seven.mat", "'rec.label', 'words' is left out (text)"},
           {"seven.mat", "samples are taken along the second side of 'rec.pos'"},
           {"groups.h5", "'robot/cube' is left out (3 dimensions)"},
       }) {
    SCOPED_TRACE(told.name);
    if (!logs_->has(told.name) || !absent_package_of(told.name).empty()) continue;
    const auto log = runtime::open_log(logs_->path(told.name));
    EXPECT_THAT(read_whole(*log).notices, HasSubstr(told.notice));
  }
}

TEST(JsonSides, ASquareOfListsIsRefusedWithAdvice) {
  const auto square = [](const std::string& time) {
    std::string text = "{" + time + "\"pos\": [";
    for (int i = 0; i < 12; ++i) {
      text += i > 0 ? ",[" : "[";
      for (int k = 0; k < 12; ++k) text += (k > 0 ? "," : "") + std::to_string(i + 0.5 * k);
      text += "]";
    }
    return text + "]}";
  };
  if (!absent_package_of("a.json").empty()) GTEST_SKIP() << "needs nlohmann-json3-dev";
  EXPECT_THAT(error_of(square("\"time\": [0,1,2,3,4,5,6,7,8,9,10,11], ")),
              testing::AllOf(HasSubstr("found 12 lists of 12 numbers in 'pos', as many as in "
                                       "'time': they may be samples or channels"),
                             HasSubstr("give each channel a list of its own name")));
  EXPECT_THAT(error_of(square("")), HasSubstr("and no time beside them"));
}

TEST_F(WrittenLogsOf, StampsKeepTheirOrigin) {
  const auto log = runtime::open_log(logs_->path("records.mcap"));
  for (std::size_t table = 0; table < 2; ++table) {
    EXPECT_EQ(log->origin(table, 0)->count, 1423155837204875566 + 5'000'000);
    EXPECT_EQ(log->origin(table, 1)->count, 1423155837204875566);
    EXPECT_EQ(log->origin(table, 1)->counts_per_unit, 1'000'000'000);
  }
  EXPECT_EQ(log->origin(1, 11)->count, 1LL << 60);  // ticks
  EXPECT_FALSE(log->origin(0, 2));
  const auto stamps = runtime::open_log(logs_->path("stamps.npy"));
  EXPECT_EQ(stamps->origin(0, 0)->count, 1423155837204875566);
}

TEST_F(WrittenLogsOf, ObjectsOfPythonAreRefusedByName) {
  EXPECT_THAT(error_of(bytes_of_file(logs_->path("object.npy")), "object.npy"),
              HasSubstr("object.npy: error: found Python objects (type '|O', pickled)"));
}

TEST_F(WrittenLogsOf, FolderOfABagIsItsFilesInOrder) {
  if (!absent_package_of("a.db3").empty()) GTEST_SKIP() << "needs libsqlite3-dev";
  const std::string folder = logs_->path("bag");
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(logs_->path("humble.db3"), folder + "/bag_1.db3");
  std::filesystem::copy_file(logs_->path("iron.db3"), folder + "/bag_0.db3");
  std::ofstream(folder + "/metadata.yaml") << "rosbag2_bagfile_information:\n  version: 5\n"
                                              "  relative_file_paths:\n    - bag_1.db3\n"
                                              "    - bag_0.db3\n  duration:\n    nanoseconds: 1\n";
  const auto log = runtime::open_log(folder);
  const WholeLog whole = read_whole(*log);
  ASSERT_EQ(whole.tables.size(), 2U);
  EXPECT_EQ(whole.tables[0].rows.size(), 80U);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(whole.tables[0].rows[40][k], whole.tables[0].rows[0][k]);
  }
  std::filesystem::remove(folder + "/bag_0.db3");
  try {
    runtime::open_log(folder);
    FAIL() << "opened without one of its files";
  } catch (const runtime::LogError& error) {
    EXPECT_THAT(error.what(), HasSubstr("bag_0.db3: error: metadata.yaml names this file"));
  }
}

TEST_F(WrittenLogsOf, SummaryCountsWhatThereIs) {
  const auto log = runtime::open_log(logs_->path("lines.jsonl"));
  const auto tables = runtime::summary_of(*log);
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_EQ(tables[0].rows, 30U);
  EXPECT_EQ(tables[0].columns[0].values, 29U);
  EXPECT_EQ(tables[0].columns[1].most, 29);
  const auto again = runtime::open_log(logs_->path("lines.jsonl"));
  EXPECT_THAT(runtime::log_summary(*again), HasSubstr("30 rows, 6 columns\n"));
}

TEST_F(WrittenLogsOf, MatlabArraysThatLieAboutTheirSidesAreRefused) {
  if (!absent_package_of("a.mat").empty()) GTEST_SKIP() << "needs libmatio-dev";
  std::string bytes = bytes_of_file(logs_->path("five.mat"));
  if (bytes.empty()) GTEST_SKIP() << "needs python3-scipy";
  const std::string sides("\5\0\0\0\x8\0\0\0\x32\0\0\0\1\0\0\0", 16);  // 50 x 1
  const std::size_t place = bytes.find(sides);
  ASSERT_NE(place, std::string::npos);
  bytes[place + 8] = 51;
  EXPECT_THAT(error_of(bytes, "five.mat"),
              testing::AllOf(HasSubstr("five.mat: error: byte 129: "), HasSubstr("expected 51")));
}

/// Reads bytes; they are a log, or refused in a sentence that names the file.
bool is_refused(const std::string& bytes, const std::string& name) {
  const std::string error = error_of(bytes, name);
  if (error.empty()) return false;
  EXPECT_THAT(error, testing::StartsWith(name));
  EXPECT_THAT(error, HasSubstr("error: "));
  return true;
}

TEST_F(WrittenLogsOf, TruncatedOnesAreRefused) {
  for (const std::string& name : names()) {
    SCOPED_TRACE(name);
    const std::string bytes = bytes_of_file(logs_->path(name));
    // the last line of a text may be cut off
    if (name.find(".json") != std::string::npos && name != "document.json") continue;
    for (const double part : {0.03, 0.3, 0.6, 0.9, 0.999}) {
      const auto size = static_cast<std::size_t>(part * static_cast<double>(bytes.size()));
      const bool refused = is_refused(bytes.substr(0, size), name);
      // bags of ROS 1 may end after any record, and pages at the end of a database may be empty
      const bool may_end = name.ends_with(".bag") || (name.ends_with(".db3") && part > 0.5);
      EXPECT_TRUE(refused || may_end) << "cut at " << part;
    }
  }
}

TEST_F(WrittenLogsOf, DamagedOnesNeverStopTheProgram) {
  std::mt19937 random(11);
  std::size_t refused = 0, tried = 0;
  for (const std::string& name : names()) {
    SCOPED_TRACE(name);
    const std::string bytes = bytes_of_file(logs_->path(name));
    for (int i = 0; i < 12; ++i) {
      std::string damaged = bytes;
      const auto among = [&](std::size_t most) {
        return std::uniform_int_distribution<std::size_t>(0, most - 1)(random);
      };
      // sizes stand at the beginning
      const std::size_t region =
          i % 2 == 0 ? std::min<std::size_t>(bytes.size(), 600) : bytes.size();
      for (std::size_t k = 0; k < 1 + among(4); ++k) {
        damaged[among(region)] = static_cast<char>(i % 3 == 0 ? 0xFF : among(256));
      }
      ++tried;
      refused += is_refused(damaged, name) ? 1 : 0;
    }
  }
  EXPECT_GT(refused, tried / 4);
}

}  // namespace
}  // namespace dyngen::test
