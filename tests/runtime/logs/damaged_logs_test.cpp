// SPDX-License-Identifier: MIT
// What lies about its size, is nested too deeply or unpacks without end, and where it is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "runtime/logs/message_decoder.h"
#include "runtime/logs/message_definition.h"
#include "runtime/logs/unpacking.h"
#include "tests/runtime/logs/read_log.h"

namespace dyngen::test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

template <typename Value>
std::string packed(Value value) {
  std::string bytes;
  for (std::size_t i = 0; i < sizeof(Value); ++i) {
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFF);
  }
  return bytes;
}

std::string packed_text(const std::string& text) {
  return packed<std::uint32_t>(static_cast<std::uint32_t>(text.size())) + text;
}

std::string mcap_record(std::uint8_t kind, const std::string& content) {
  return packed(kind) + packed<std::uint64_t>(content.size()) + content;
}

const std::string kMcapBegin = {"\x89MCAP0\r\n", 8};

std::string chunk(std::uint64_t size, std::uint32_t crc, const std::string& method,
                  const std::string& records) {
  return mcap_record(6, packed<std::uint64_t>(0) + packed<std::uint64_t>(0) + packed(size) +
                            packed(crc) + packed_text(method) +
                            packed<std::uint64_t>(records.size()) + records);
}

TEST(DamagedLog, McapThatLiesIsRefusedAtItsByte) {
  EXPECT_THAT(
      error_of(kMcapBegin + packed<std::uint8_t>(5) + packed<std::uint64_t>(1ULL << 62)),
      HasSubstr("run.log: error: byte 18: found the end of the file after 0 bytes, expected "
                "the record that begins here"));
  EXPECT_THAT(error_of(kMcapBegin + chunk(1ULL << 60, 0, "lz4", "x")),
              HasSubstr("byte 9: found a chunk of 1152921504606846976 bytes, expected 1073741824"));
  EXPECT_THAT(error_of(kMcapBegin + chunk(4, 1, "", "abcd")),
              HasSubstr("byte 9: found a chunk whose check (CRC) does not fit"));
  EXPECT_THAT(error_of(kMcapBegin + chunk(5, 0, "", "abcd")),
              HasSubstr("byte 9: found a chunk of 4 bytes, expected 5"));
  EXPECT_THAT(error_of(kMcapBegin + chunk(4, 0, "rar", "abcd")), HasSubstr("packed with 'rar'"));
  EXPECT_THAT(error_of(kMcapBegin + mcap_record(5, packed<std::uint16_t>(7))),
              HasSubstr("byte 9: found a message of channel 7, which is not there"));
  EXPECT_THAT(error_of(kMcapBegin), HasSubstr("byte 9: found the end of the file"));
}

TEST(DamagedLog, NumpyThatLiesIsRefused) {
  const auto array = [](const std::string& header, const std::string& data) {
    return std::string("\x93NUMPY\x01\x00", 8) +
           packed<std::uint16_t>(static_cast<std::uint16_t>(header.size())) + header + data;
  };
  EXPECT_THAT(
      error_of(array("{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999,), }", "x")),
      HasSubstr("found 1 bytes of data, expected 99999999999 elements of 8 bytes"));
  EXPECT_THAT(error_of(array("{'descr': '<f8', 'fortran_order': False, "
                             "'shape': (4294967296, 4294967296, 4294967296), }",
                             "")),
              HasSubstr("found an array of more than"));
  EXPECT_THAT(error_of(array(std::string(2000, '['), "")), HasSubstr("nested less deeply"));
  EXPECT_THAT(error_of(array("{'descr': '<f8', 'fortran_order': ", "")),
              HasSubstr("run.log: error: "));
  EXPECT_THAT(
      error_of(array("{'descr': 'f99999999999', 'fortran_order': False, 'shape': (1,)}", "")),
      HasSubstr("found the type 'f99999999999'"));
}

TEST(DamagedLog, JsonIsRefusedAtItsByteOrLine) {
  EXPECT_THAT(error_of("{\"a\": [1, 2,, 3]}", "run.json"), HasSubstr("run.json: error: byte 13"));
  EXPECT_THAT(error_of("{\"a\": 1}\n{\"a\": 2}\n{\"a\": }\n", "run.json"),
              HasSubstr("run.json: error: line 3: byte 7"));
  EXPECT_THAT(error_of("[" + std::string(100000, '['), "run.json"),
              HasSubstr("nested more than 64 deep"));
  EXPECT_THAT(error_of("{\"text\": \"only\"}", "run.json"), HasSubstr("found no numbers"));
}

TEST(DamagedLog, DefinitionsThatContainThemselvesAreRefused) {
  using runtime::read_definition;
  using runtime::RosVersion;
  const auto refused = [](const std::string& text, const std::string& why) {
    EXPECT_THAT([&] { read_definition(text, "a/A", RosVersion::kTwo); },
                ThrowsMessage<std::runtime_error>(HasSubstr(why)));
  };
  refused("B b\n===\nMSG: a/B\nA a\n", "type 'a/A' contains itself");
  refused("Missing m\n", "type 'a/Missing' is unknown");
  refused("float64[99999999999] m\n", "has no size of an array");
  refused("float64\n", "is no field of a message");
  std::string huge = "B[1000000] b\n";
  for (char c = 'B'; c < 'H'; ++c) {
    huge += std::string("===\nMSG: a/") + c + "\n" + static_cast<char>(c + 1) + "[1000000] m\n";
  }
  refused(huge + "===\nMSG: a/H\nfloat64 x\n", "larger than any message");
}

class Numbers final : public runtime::FieldSink {
 public:
  void number(std::string_view, double) override { ++count; }
  void whole(std::string_view, std::int64_t) override { ++count; }
  void instant(std::string_view, std::int64_t) override { ++count; }
  void left_out(std::string_view, std::string_view) override {}
  int count = 0;
};

TEST(DamagedLog, MessagesThatLieAreRefusedAtTheirFieldAndByte) {
  const runtime::MessageDecoder decoder(
      runtime::read_definition("string[] names\nfloat64[] position\n", "a/A",
                               runtime::RosVersion::kTwo),
      runtime::MessageEncoding::kCdr);
  const std::string head("\0\1\0\0", 4), none = packed<std::uint32_t>(0);
  const auto refused = [&](const std::string& bytes, const std::string& why) {
    Numbers numbers;
    EXPECT_THAT([&] { decoder.decode(bytes, numbers); },
                ThrowsMessage<std::runtime_error>(HasSubstr(why)));
  };
  refused("", "byte 1: found fewer than 4 bytes");
  refused(std::string("\0\5\0\0", 4), "found encapsulation 0x0005");
  refused(head + packed<std::uint32_t>(0xFFFFFFFF),
          "byte 9 in 'names': found an array of 4294967295 elements");
  refused(head + packed<std::uint32_t>(1) + packed<std::uint32_t>(200),
          "byte 13 in 'names': found the end of the message, expected 200 more bytes");
  refused(head + none + packed<std::uint32_t>(2) + std::string(8, '\0'), "in 'position");
  refused(head + none + none + std::string(9, '\0'), "found 9 bytes after its last field");
  Numbers numbers;
  decoder.decode(head + none + packed<std::uint32_t>(1) + std::string(8, '\0'), numbers);
  EXPECT_EQ(numbers.count, 1);
}

TEST(DamagedLog, BagsOfRos1ThatLieAreRefused) {
  const std::string begin = "#ROSBAG V2.0\n";
  EXPECT_THAT(error_of("#ROSBAG V1.2\n"), HasSubstr("byte 1: found '#ROSBAG V1.2?', expected"));
  EXPECT_THAT(error_of(begin + packed<std::uint32_t>(0xFFFFFFF0)),
              HasSubstr("byte 14: found 4294967280 bytes for the header of a record"));
  EXPECT_THAT(error_of(begin + packed_text(packed_text("novalue")) + packed<std::uint32_t>(0)),
              HasSubstr("byte 14: found 'novalue', expected a field name=value"));
  EXPECT_THAT(error_of(begin), HasSubstr("found no messages that can be read"));
}

TEST(DamagedLog, WhatUnpacksWithoutEndIsRefused) {
  using runtime::unpacked;
  EXPECT_THAT([] { unpacked("none", "abcdef", 5); },
              ThrowsMessage<std::runtime_error>(HasSubstr("found 6 bytes, expected 5")));
  for (const char* method : {"lz4", "zstd", "bz2"}) {
    EXPECT_THROW(unpacked(method, "no such data", 100), std::runtime_error) << method;
    EXPECT_THROW(unpacked(method, "", 100), std::runtime_error) << method;
  }
  EXPECT_EQ(runtime::crc32_of("123456789"), 0xCBF43926U);  // the check value of the polynomial
}

TEST(DamagedLog, FormatsThatArePackedOrUnknownSayWhatToDo) {
  EXPECT_THAT(error_of("\x28\xB5\x2F\xFD with more", "bag.db3.zstd"), HasSubstr("zstd -d"));
  EXPECT_THAT(error_of(std::string("PK\x03\x04 damaged", 12), "run.npz"),
              HasSubstr("run.npz: error: "));
  try {
    runtime::open_log("/no/such/file");
    FAIL() << "opened what is not there";
  } catch (const runtime::LogError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("/no/such/file: error: cannot open the file: No such file"));
  }
}

}  // namespace
}  // namespace dyngen::test
