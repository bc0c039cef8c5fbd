// SPDX-License-Identifier: MIT
#include "runtime/logs/sqlite_source.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "runtime/logs/log_error.h"
#include "runtime/logs/unpacking.h"
#include "runtime/recordings/notice_log.h"

#ifdef DYNGEN_LOGS_WITH_SQLITE
#include <sqlite3.h>
#endif

namespace dyngen::runtime {

#ifdef DYNGEN_LOGS_WITH_SQLITE

namespace {

constexpr int kMostMessageBytes = 1 << 28;  ///< that SQLite hands out in one piece
constexpr std::size_t kMostUnpackedMessage = 1 << 28;

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct EndStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, EndStatement>;

/// "file:/a%20b.db3?immutable=1": nothing is written beside the file.
std::string address_of(const std::string& path, bool immutable) {
  std::string address = "file:";
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '/' || c == '.' || c == '_' || c == '-';
    address += plain ? std::string(1, c)
                     : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return address + (immutable ? "?immutable=1" : "?mode=ro");
}

class Rosbag2Database final : public MessageSource {
 public:
  explicit Rosbag2Database(const LogBytes& bytes);

  [[nodiscard]] const std::vector<MessageTopic>& topics() const override { return topics_; }
  [[nodiscard]] double fraction_read() const override {
    return last_id_ == first_id_
               ? 1
               : (static_cast<double>(id_) - static_cast<double>(first_id_)) /
                     (static_cast<double>(last_id_) - static_cast<double>(first_id_));
  }
  void rewind() override;
  bool next(LogMessage& message) override;

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw log_error(name_, fmt::format("{}: {}", what, sqlite3_errmsg(database_.get())));
  }
  void open(const LogBytes& bytes);
  void check_table(const std::string& table) const;
  [[nodiscard]] Statement prepare(const std::string& query) const;
  [[nodiscard]] static std::string text(const Statement& statement, int column);
  [[nodiscard]] bool has_table(const std::string& table) const;
  void read_topics();
  void read_range();

  std::string name_;
  std::shared_ptr<const std::string> memory_;
  Database database_;
  std::vector<MessageTopic> topics_;
  std::map<std::int64_t, std::size_t> topic_of_id_;
  Statement messages_;
  std::string unpacked_;
  std::int64_t id_ = 0, first_id_ = 0, last_id_ = 0;
  std::uint64_t number_ = 0;
};

void Rosbag2Database::open(const LogBytes& bytes) {
  sqlite3* opened = nullptr;
  constexpr int kFlags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX;
  std::error_code ignored;
  // a log that was not closed has its last messages beside it
  const bool has_journal = !bytes.memory && std::filesystem::exists(bytes.path + "-wal", ignored);
  const std::string address = bytes.memory ? "file::memory:" : address_of(bytes.path, !has_journal);
  const int outcome = sqlite3_open_v2(address.c_str(), &opened, kFlags, nullptr);
  database_.reset(opened);
  if (outcome != SQLITE_OK) fail("cannot open the database");
  if (bytes.memory) {
    // SQLite does not write to a database that is read only; its interface is without const.
    auto* data = reinterpret_cast<unsigned char*>(const_cast<char*>(bytes.memory->data()));
    const auto size = static_cast<sqlite3_int64>(bytes.memory->size());
    if (sqlite3_deserialize(opened, "main", data, size, size, SQLITE_DESERIALIZE_READONLY) !=
        SQLITE_OK) {
      fail("cannot read the database");
    }
  }
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, kMostMessageBytes);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_exec(opened, "PRAGMA cell_size_check=ON; PRAGMA mmap_size=0", nullptr, nullptr, nullptr);
}

Rosbag2Database::Rosbag2Database(const LogBytes& bytes) : name_(bytes.name), memory_(bytes.memory) {
  open(bytes);
  for (const char* table : {"topics", "messages"}) check_table(table);
  read_topics();
  read_range();
  Rosbag2Database::rewind();
}

Statement Rosbag2Database::prepare(const std::string& query) const {
  sqlite3_stmt* prepared = nullptr;
  if (sqlite3_prepare_v2(database_.get(), query.c_str(), -1, &prepared, nullptr) != SQLITE_OK) {
    fail("cannot read the database");
  }
  return Statement(prepared);
}

std::string Rosbag2Database::text(const Statement& statement, int column) {
  const auto* bytes = sqlite3_column_text(statement.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement.get(), column));
  return bytes == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(bytes), size);
}

bool Rosbag2Database::has_table(const std::string& table) const {
  const Statement found =
      prepare("SELECT sql FROM sqlite_master WHERE type='table' AND name='" + table + "'");
  const int outcome = sqlite3_step(found.get());
  if (outcome != SQLITE_ROW && outcome != SQLITE_DONE) fail("cannot read the database");
  // a view or a virtual table could compute for ever
  return outcome == SQLITE_ROW && text(found, 0).starts_with("CREATE TABLE");
}

void Rosbag2Database::check_table(const std::string& table) const {
  if (has_table(table)) return;
  throw log_error(name_, fmt::format("found an SQLite database without a table {}, expected one of "
                                     "rosbag2 (tables 'topics' and 'messages')",
                                     in_quotes(table)));
}

void Rosbag2Database::read_topics() {
  std::map<std::string, std::pair<std::string, std::string>> definitions;
  if (has_table("message_definitions")) {
    const Statement rows =
        prepare("SELECT topic_type, encoding, encoded_message_definition FROM message_definitions");
    int outcome = SQLITE_ROW;
    while ((outcome = sqlite3_step(rows.get())) == SQLITE_ROW) {
      if (!text(rows, 2).empty()) definitions[text(rows, 0)] = {text(rows, 1), text(rows, 2)};
    }
    if (outcome != SQLITE_DONE) fail("cannot read the message definitions");
  }
  const Statement rows = prepare("SELECT id, name, type, serialization_format FROM topics");
  int outcome = SQLITE_ROW;
  while ((outcome = sqlite3_step(rows.get())) == SQLITE_ROW) {
    MessageTopic topic;
    topic.name = text(rows, 1);
    topic.type = text(rows, 2);
    topic.encoding = text(rows, 3);
    const auto definition = definitions.find(topic.type);
    if (definition != definitions.end()) {
      topic.definition_encoding = definition->second.first;
      topic.definition = definition->second.second;
    }
    topic_of_id_[sqlite3_column_int64(rows.get(), 0)] = topics_.size();
    topics_.push_back(std::move(topic));
  }
  if (outcome != SQLITE_DONE) fail("cannot read the topics");
}

void Rosbag2Database::read_range() {
  const Statement range = prepare("SELECT min(rowid), max(rowid) FROM messages");
  if (sqlite3_step(range.get()) != SQLITE_ROW) fail("cannot read the messages");
  first_id_ = sqlite3_column_int64(range.get(), 0);
  last_id_ = sqlite3_column_int64(range.get(), 1);
}

void Rosbag2Database::rewind() {
  messages_ = prepare("SELECT rowid, topic_id, timestamp, data FROM messages ORDER BY rowid");
  number_ = 0;
  id_ = first_id_;
}

bool Rosbag2Database::next(LogMessage& message) {
  const int outcome = sqlite3_step(messages_.get());
  if (outcome == SQLITE_DONE) {
    id_ = last_id_;
    return false;
  }
  ++number_;
  if (outcome != SQLITE_ROW) fail(fmt::format("cannot read message {}", number_));
  id_ = sqlite3_column_int64(messages_.get(), 0);
  const std::int64_t topic_id = sqlite3_column_int64(messages_.get(), 1);
  const auto topic = topic_of_id_.find(topic_id);
  if (topic == topic_of_id_.end()) {
    throw log_error_at(name_, "message", number_,
                       fmt::format("found topic number {}, which is not there", topic_id));
  }
  message.topic = topic->second;
  message.received = sqlite3_column_int64(messages_.get(), 2);
  message.place = number_;
  const void* data = sqlite3_column_blob(messages_.get(), 3);
  const int size = sqlite3_column_bytes(messages_.get(), 3);
  message.bytes = {static_cast<const char*>(data),
                   data == nullptr ? 0 : static_cast<std::size_t>(size)};
  if (is_zstd(message.bytes)) {  // a bag that packs its messages one by one
    try {
      unpacked_ = unpacked("zstd", message.bytes, kMostUnpackedMessage);
    } catch (const std::runtime_error& error) {
      throw log_error_at(name_, "message", number_, error.what());
    }
    message.bytes = unpacked_;
  }
  return true;
}

}  // namespace

std::unique_ptr<MessageSource> open_rosbag2_database(const LogBytes& bytes) {
  return std::make_unique<Rosbag2Database>(bytes);
}

#else

std::unique_ptr<MessageSource> open_rosbag2_database(const LogBytes& bytes) {
  throw absent_package(bytes.name, "rosbag2 databases (.db3)", "libsqlite3-dev");
}

#endif

}  // namespace dyngen::runtime
