// SPDX-License-Identifier: MIT
#include "runtime/import/map_file.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/LU>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>

#include "runtime/import/map_nodes.h"
#include "runtime/import/signal_units.h"
#include "runtime/import/spelling.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

constexpr int kMostImportedJoints = 1000;
constexpr std::size_t kMostSkippedLines = 100000;

/// "q{1..7}" as q1, q2, ... q7; any other name as it is.
std::vector<std::string> expanded(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names) {
    const std::size_t open = name.find('{'), dots = name.find("..", open == name.npos ? 0 : open);
    const std::size_t close = name.find('}', dots == name.npos ? 0 : dots);
    int first = 0, last = 0;
    const auto read = [&](std::size_t from, std::size_t to, int& value) {
      return std::from_chars(name.data() + from, name.data() + to, value).ptr == name.data() + to;
    };
    const bool is_range = open != name.npos && dots != name.npos && close != name.npos &&
                          dots > open + 1 && close > dots + 2 && read(open + 1, dots, first) &&
                          read(dots + 2, close, last) && first <= last &&
                          last - first < kMostImportedJoints;
    if (!is_range) {
      all.push_back(name);
      continue;
    }
    for (int number = first; number <= last; ++number) {
      all.push_back(name.substr(0, open) + std::to_string(number) + name.substr(close + 1));
    }
  }
  return all;
}

class MapFileReader {
 public:
  explicit MapFileReader(const std::string& name) : faults_(name) { map_.name = name; }

  ImportMap read(const YAML::Node& root);

 private:
  LogTextSettings text_settings(const MapEntries& entries);
  char sign(const MapEntries& entries, const char* key, std::initializer_list<char> allowed);
  void read_joints(const MapEntries& top);
  void read_files(const YAML::Node& node);
  void read_time(const YAML::Node& node);
  std::optional<SignalMap> read_signal(const MapEntries& top, const char* key,
                                       ColumnQuantity quantity);
  void read_units(const MapEntries& entries, ColumnQuantity quantity, SignalMap& signal);
  void read_sides(const MapEntries& entries, SignalMap& signal);
  void read_duty(const MapEntries& entries, SignalMap& signal);
  void read_gears(const MapEntries& top);
  void read_runs(const YAML::Node& node);
  /// @param is_list  in brackets: one of a list is not one for all
  void note_length(const MapPlace& place, std::string what, std::size_t length,
                   bool is_list = false) {
    if (length > 1 || (length == 1 && is_list))
      lengths_.push_back({place, std::move(what), length});
  }
  static bool is_list(const MapEntries& entries, const char* key) {
    const YAML::Node* node = entries.find(key);
    return node != nullptr && node->IsSequence();
  }
  void check_lengths();
  void check_together();
  void check_file(const MapPlace& place, const std::string& key);

  struct Length {
    MapPlace place;
    std::string what;
    std::size_t length;
  };

  ImportMap map_;
  MapFaults faults_;
  std::vector<Length> lengths_;
};

char MapFileReader::sign(const MapEntries& entries, const char* key,
                         std::initializer_list<char> allowed) {
  const std::string word = entries.text(key);
  if (word == "tab" || word == "\\t") return '\t';
  if (word == "blank" || word == "space") return ' ';
  if (word.size() == 1 && std::find(allowed.begin(), allowed.end(), word[0]) != allowed.end()) {
    return word[0];
  }
  std::string signs;
  for (const char c : allowed) {
    signs += fmt::format("{}{}", signs.empty() ? "" : ", ",
                         c == '\t'  ? "tab"
                         : c == ' ' ? "blank"
                                    : fmt::format("'{}'", c));
  }
  faults_.add(entries.place_of_value(key), fmt::format("found {} in '{}', expected one of {}",
                                                       runtime::quoted(word), key, signs));
  return *allowed.begin();
}

LogTextSettings MapFileReader::text_settings(const MapEntries& entries) {
  LogTextSettings settings;
  if (entries.has("separator")) {
    settings.separator = sign(entries, "separator", {',', ';', '|', ':', '\t', ' '});
  }
  if (entries.has("decimal")) settings.decimal = sign(entries, "decimal", {'.', ','});
  if (const auto skip = entries.number("skip", MapNumber::kRatio)) {
    if (*skip < 0 || *skip > static_cast<double>(kMostSkippedLines) ||
        *skip != static_cast<double>(static_cast<std::size_t>(*skip))) {
      faults_.add(entries.place_of_value("skip"),
                  fmt::format("found skip: {}, expected a number of lines, 0 to {}", *skip,
                              kMostSkippedLines));
    } else {
      settings.skip_lines = static_cast<std::size_t>(*skip);
    }
  }
  if (entries.has("columns")) settings.columns = expanded(entries.texts("columns"));
  return settings;
}

void MapFileReader::read_joints(const MapEntries& top) {
  if (!top.has("joints")) return;
  map_.joints_place = top.place_of_value("joints");
  if (top.find("joints")->IsSequence()) {
    map_.joint_names = top.texts("joints");
    map_.joints = static_cast<int>(map_.joint_names.size());
    return;
  }
  const auto count = top.number("joints", MapNumber::kRatio);
  if (!count) return;
  if (*count < 1 || *count > kMostImportedJoints || *count != static_cast<int>(*count)) {
    faults_.add(map_.joints_place,
                fmt::format("found joints: {}, expected how many there are (1 to {}), or their "
                            "names in a list",
                            *count, kMostImportedJoints));
    return;
  }
  map_.joints = static_cast<int>(*count);
}

void MapFileReader::read_files(const YAML::Node& node) {
  if (!node.IsMap() || node.size() == 0) {
    faults_.add(place_of(node),
                "found no files in 'files', expected a name for each and its pattern, such as "
                "'{encoders: \"enc*.csv\", drives: \"drive*.csv\"}'");
    return;
  }
  for (const auto& entry : node) {
    FileMap file;
    file.place = place_of(entry.first);
    file.key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (entry.second.IsScalar()) {
      file.pattern = entry.second.Scalar();
    } else {
      const MapEntries entries(entry.second, "files: " + file.key,
                               {"name", "separator", "decimal", "skip", "columns"}, faults_);
      file.pattern = entries.text("name");
      file.text = text_settings(entries);
    }
    if (file.pattern.empty() || file.pattern == "?") {
      faults_.add(place_of(entry.second), fmt::format("found no name of file {}, expected one, "
                                                      "such as 'enc*.csv'",
                                                      runtime::quoted(file.key)));
    }
    map_.files.push_back(std::move(file));
  }
}

void MapFileReader::read_time(const YAML::Node& node) {
  const MapEntries entries(node, "time", {"column", "unit", "rate"}, faults_);
  TimeMap& time = map_.time;
  time.place = entries.place();
  time.column = entries.text("column");
  time.unit = entries.text("unit");
  if (const auto rate = entries.number("rate", MapNumber::kRate)) {
    time.rate = *rate;
    if (!(time.rate > 0)) {
      faults_.add(entries.place_of_value("rate"),
                  fmt::format("found rate: {} Hz, expected more than 0", time.rate));
    }
  }
  if (entries.has("column") == entries.has("rate")) {
    faults_.add(time.place, "expected in 'time' either a column or a rate");
  }
  if (!time.unit.empty() && !unit_conversion(time.unit, ColumnQuantity::kTime)) {
    faults_.add(entries.place_of_value("unit"),
                fmt::format("found unit {} of time, expected {}", runtime::quoted(time.unit),
                            known_units(ColumnQuantity::kTime)));
  }
}

void MapFileReader::read_units(const MapEntries& entries, ColumnQuantity quantity,
                               SignalMap& signal) {
  signal.units = entries.texts("unit");
  signal.unit_place = entries.place_of_value("unit");
  note_length(signal.unit_place, "units", signal.units.size(), is_list(entries, "unit"));
  for (const std::string& unit : signal.units) {
    if (unit.empty()) continue;  // told
    const auto known = signal_unit(unit, quantity);
    if (!known) {
      faults_.add(signal.unit_place,
                  fmt::format("found unit {}, expected {}", runtime::quoted(unit),
                              known_signal_units(quantity)));
    }
  }
}

void MapFileReader::read_sides(const MapEntries& entries, SignalMap& signal) {
  for (const std::string& word : entries.texts("side")) {
    if (word != "motor" && word != "joint" && !word.empty()) {
      faults_.add(entries.place_of_value("side"),
                  fmt::format("found side {}, expected motor or joint", runtime::quoted(word)));
    }
    signal.sides.push_back(word == "motor" ? GearSide::kMotor : GearSide::kJoint);
  }
  note_length(entries.place_of_value("side"), "sides", signal.sides.size(),
              is_list(entries, "side"));
}

void MapFileReader::read_duty(const MapEntries& entries, SignalMap& signal) {
  DutyTorque duty;
  duty.duty = entries.columns("duty");
  note_length(duty.duty.place, "columns", duty.duty.names.size());
  duty.full_scale = entries.numbers("full", MapNumber::kRatio);
  duty.resistance = entries.numbers("resistance", MapNumber::kResistance);
  duty.back_emf = entries.numbers("back_emf", MapNumber::kBackEmf);
  if (entries.has("voltage")) {
    const std::vector<std::string> words = entries.texts("voltage");
    const bool number =
        !words.empty() && read_map_number(words.front(), MapNumber::kVoltage).value.has_value();
    if (number) {
      duty.supply = entries.numbers("voltage", MapNumber::kVoltage);
    } else {
      duty.voltage = entries.columns("voltage");
    }
  }
  for (const auto& [key, what] : {std::pair{"full", "the column's value at full voltage"},
                                  std::pair{"voltage", "the supply's column, or its volts"},
                                  std::pair{"resistance", "the winding's, in ohm"},
                                  std::pair{"constant", "the motor's, in N m/A"}}) {
    if (!entries.has(key)) {
      faults_.add(signal.place,
                  fmt::format("found 'duty' without '{}' in 'torque', expected {}", key, what));
    }
  }
  signal.duty = std::move(duty);
}

std::optional<SignalMap> MapFileReader::read_signal(const MapEntries& top, const char* key,
                                                    ColumnQuantity quantity) {
  const YAML::Node* node = top.find(key);
  if (node == nullptr) return std::nullopt;
  const bool torque = quantity == ColumnQuantity::kTorque;
  const auto entries = [&] {
    if (torque) {
      return MapEntries(*node, key,
                        {"columns", "column", "unit", "side", "sign", "gain", "offset", "delay",
                         "file", "table", "constant", "efficiency", "rated", "duty", "full",
                         "voltage", "resistance", "back_emf", "bits"},
                        faults_);
    }
    if (quantity == ColumnQuantity::kTemperature) {
      return MapEntries(*node, key, {"columns", "column", "unit", "delay", "file", "table", "bits"},
                        faults_);
    }
    return MapEntries(*node, key,
                      {"columns", "column", "unit", "side", "sign", "gain", "offset", "delay",
                       "file", "table", "counts_per_rev", "bits"},
                      faults_);
  }();
  SignalMap signal;
  signal.place = entries.place();
  signal.file = entries.text("file");
  if (entries.has("file")) check_file(entries.place_of_value("file"), signal.file);
  signal.table = entries.text("table");
  signal.columns = entries.columns(entries.has("column") ? "column" : "columns");
  note_length(signal.columns.place, "columns",
              quantity == ColumnQuantity::kTemperature ? 0 : signal.columns.names.size());
  read_units(entries, quantity, signal);
  read_sides(entries, signal);
  const auto numbers = [&](const char* own, MapNumber kind) {
    PerJoint values = entries.numbers(own, kind);
    note_length(entries.place_of_value(own), fmt::format("numbers in '{}'", own), values.size(),
                is_list(entries, own));
    return values;
  };
  signal.sign = numbers("sign", MapNumber::kRatio);
  for (const double value : signal.sign) {
    if (std::abs(value) != 1) {
      faults_.add(entries.place_of_value("sign"),
                  fmt::format("found sign {}, expected 1 or -1", value));
    }
  }
  signal.bits = static_cast<int>(entries.number("bits", MapNumber::kRatio).value_or(0));
  if (entries.has("bits") && signal.bits != 8 && signal.bits != 16 && signal.bits != 32) {
    faults_.add(entries.place_of_value("bits"),
                fmt::format("found {} bits, expected 8, 16 or 32", signal.bits));
  }
  signal.gain = numbers("gain", MapNumber::kRatio);
  signal.offset = numbers("offset", torque ? MapNumber::kTorque : MapNumber::kPosition);
  signal.delay = entries.number("delay", MapNumber::kDuration).value_or(0);
  signal.counts_per_turn = numbers("counts_per_rev", MapNumber::kRatio);
  signal.constant = numbers("constant", MapNumber::kConstant);
  signal.efficiency = numbers("efficiency", MapNumber::kRatio);
  for (const double value : signal.efficiency) {
    if (!(value > 0 && value <= 1)) {
      faults_.add(entries.place_of_value("efficiency"),
                  fmt::format("found efficiency {}, expected more than 0, at most 1", value));
    }
  }
  signal.rated = numbers("rated", MapNumber::kTorque);
  if (entries.has("duty")) {
    read_duty(entries, signal);
  } else {
    for (const char* own : {"full", "voltage", "resistance", "back_emf"}) {
      if (!entries.has(own)) continue;
      faults_.add(entries.place_of_value(own),
                  fmt::format("found '{}' without 'duty' in '{}', expected the column of the "
                              "duty cycle",
                              own, key));
    }
  }
  if (entries.has("columns") + entries.has("column") + entries.has("duty") != 1) {
    faults_.add(signal.place, fmt::format("expected in '{}' one of 'columns'{}", key,
                                          torque ? ", 'column' and 'duty'" : " and 'column'"));
  }
  if ((quantity == ColumnQuantity::kVelocity || quantity == ColumnQuantity::kAcceleration) &&
      entries.has("offset")) {
    faults_.add(
        entries.place_of_value("offset"),
        fmt::format("found 'offset' in '{}', expected it of positions and torques alone", key));
  }
  return signal;
}

void MapFileReader::read_gears(const MapEntries& top) {
  if (top.has("gears") && top.has("coupling")) {
    faults_.add(top.place_of_value("coupling"),
                "found 'gears' and 'coupling', expected one: the matrix has the ratios too");
  }
  if (top.has("gears")) {
    map_.gears_place = top.place_of_value("gears");
    map_.gears = top.numbers("gears", MapNumber::kRatio);
    note_length(map_.gears_place, "gears", map_.gears.size(), is_list(top, "gears"));
    for (const double ratio : map_.gears) {
      if (ratio == 0) {
        faults_.add(map_.gears_place,
                    "found a gear of 0, expected turns of the motor for one of the joint");
      }
    }
  }
  const YAML::Node* node = top.find("coupling");
  if (node == nullptr) return;
  map_.gears_place = place_of(*node);
  const std::size_t rows = node->IsSequence() ? node->size() : 0;
  if (rows == 0) {
    faults_.add(map_.gears_place,
                "found no matrix in 'coupling', expected a list with a row for each motor: motor "
                "= K * joint");
    return;
  }
  note_length(map_.gears_place, "rows", rows, true);
  map_.coupling.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(rows));
  Eigen::Index row = 0;
  for (const auto& line : *node) {
    if (!line.IsSequence() || line.size() != rows) {
      faults_.add(place_of(line), fmt::format("found {} numbers in a row of 'coupling', expected "
                                              "{}: one for each joint",
                                              line.IsSequence() ? line.size() : 1, rows));
      return;
    }
    Eigen::Index column = 0;
    for (const auto& number : line) {
      map_.coupling(row, column++) = top.number_of(number, MapNumber::kRatio).value_or(0);
    }
    ++row;
  }
  constexpr double kSingular = 1e-9;  // of the largest pivot: no ratio of gears is so uneven
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(map_.coupling);
  const auto pivots = factors.matrixLU().diagonal().cwiseAbs();
  if (!(pivots.minCoeff() > kSingular * pivots.maxCoeff())) {
    faults_.add(map_.gears_place,
                "found a 'coupling' that has no inverse, expected one from which the joints "
                "follow when the motors are known");
  }
}

void MapFileReader::read_runs(const YAML::Node& node) {
  const MapEntries entries(
      node, "runs", {"split", "keep", "skip_first", "skip_last", "cut", "file", "table"}, faults_);
  RunsMap& runs = map_.runs;
  runs.place = entries.place();
  runs.file = entries.text("file");
  if (entries.has("file")) check_file(entries.place_of_value("file"), runs.file);
  runs.table = entries.text("table");
  runs.split = entries.columns("split");
  runs.keep = entries.columns("keep");
  for (const auto& [key, target] :
       {std::pair{"skip_first", &runs.skip_first}, std::pair{"skip_last", &runs.skip_last}}) {
    *target = entries.number(key, MapNumber::kDuration).value_or(0);
    if (*target < 0) {
      faults_.add(entries.place_of_value(key),
                  fmt::format("found {}: {} s, expected 0 or more", key, *target));
    }
  }
  const YAML::Node* cut = entries.find("cut");
  if (cut == nullptr) return;
  const auto wrong = [&](const YAML::Node& where) {
    faults_.add(place_of(where),
                "found no pair of times in 'cut', expected a list such as [[3 s, 4.5 s], [12 s, "
                "13 s]]");
  };
  if (!cut->IsSequence()) return wrong(*cut);
  for (const auto& pair : *cut) {
    if (!pair.IsSequence() || pair.size() != 2) {
      wrong(pair);
      continue;
    }
    const auto from = entries.number_of(pair[0], MapNumber::kDuration);
    const auto to = entries.number_of(pair[1], MapNumber::kDuration);
    if (!from || !to) continue;
    if (!(*from < *to)) {
      faults_.add(place_of(pair), fmt::format("found a cut from {} s to {} s, expected the first "
                                              "to be less",
                                              *from, *to));
    }
    runs.cuts.emplace_back(*from, *to);
  }
}

void MapFileReader::check_file(const MapPlace& place, const std::string& key) {
  std::vector<std::string> keys;
  for (const FileMap& file : map_.files) keys.push_back(file.key);
  if (std::find(keys.begin(), keys.end(), key) != keys.end()) return;
  faults_.add(place, keys.empty() ? fmt::format("found file {}, expected 'files' to name the files",
                                                runtime::quoted(key))
                                  : fmt::format("found file {}, expected one of {}",
                                                runtime::quoted(key), listed(keys)));
}

void MapFileReader::check_lengths() {
  std::size_t expected = static_cast<std::size_t>(map_.joints);
  std::string by = "joints";
  for (const Length& one : lengths_) {
    if (expected == 0) {
      expected = one.length;
      by = fmt::format("{} in line {}", one.what, one.place.line);
    } else if (one.length != expected) {
      faults_.add(one.place, fmt::format("found {} {}, expected {} as there are {}, or one for all",
                                         one.length, one.what, expected, by));
    }
  }
  if (map_.joints > 0 || lengths_.empty()) return;
  map_.joints = static_cast<int>(expected);
  map_.joints_place = lengths_.front().place;
  map_.joints_by_a_list = true;
}

/// What keys of several places mean together.
void MapFileReader::check_together() {
  const bool geared = !map_.gears.empty() || map_.coupling.size() > 0;
  const auto each = [&](const char* key, const std::optional<SignalMap>& signal) {
    if (!signal) return;
    const bool motor = std::find(signal->sides.begin(), signal->sides.end(), GearSide::kMotor) !=
                       signal->sides.end();
    if (geared && signal->sides.empty()) {
      faults_.add(signal->place,
                  fmt::format("'{}' does not say on which side of the gears it is: expected "
                              "'side: motor' or 'side: joint'",
                              key));
    }
    if (motor && !geared) {
      faults_.add(signal->place,
                  fmt::format("'{}' is on the motor side, and there are no gears: expected 'gears' "
                              "or 'coupling'",
                              key));
    }
    if (!map_.files.empty() && signal->file.empty() && map_.files.size() > 1) {
      faults_.add(signal->place, fmt::format("'{}' does not say in which file it is: expected "
                                             "'file'",
                                             key));
    }
  };
  each("position", map_.position);
  each("velocity", map_.velocity);
  each("acceleration", map_.acceleration);
  each("torque", map_.torque);
  each("simulated_torque", map_.simulated_torque);
  each("link_position", map_.link_position);
  if (!map_.position) {
    faults_.add({1, 1}, "found no 'position', expected the columns of the joints' positions");
  }
  if (!map_.torque) {
    faults_.add({1, 1}, "found no 'torque', expected the columns of the joints' torques");
  }
  if (map_.torque && map_.torque->duty && !map_.velocity) {
    faults_.add(map_.torque->place,
                "torque of a duty cycle needs the speed: expected 'velocity' too");
  }
}

ImportMap MapFileReader::read(const YAML::Node& root) {
  if (!root.IsMap()) {
    throw ImportError(map_error(map_, {1, 1},
                                "found no map, expected keys such as 'time:', 'position:' and "
                                "'torque:'"));
  }
  const MapEntries top(
      root, "the map",
      {"joints", "format", "files", "table", "time", "position", "velocity", "acceleration",
       "torque", "simulated_torque", "link_position", "temperature", "gears", "coupling", "runs"},
      faults_);
  read_joints(top);
  if (const YAML::Node* node = top.find("format")) {
    map_.text = text_settings(
        MapEntries(*node, "format", {"separator", "decimal", "skip", "columns"}, faults_));
  }
  if (const YAML::Node* node = top.find("files")) read_files(*node);
  map_.table = top.text("table");
  if (const YAML::Node* node = top.find("time")) {
    read_time(*node);
  } else {
    faults_.add({1, 1},
                "found no 'time', expected its column ('{column: t, unit: s}') or the rate "
                "('{rate: 1000 Hz}')");
  }
  map_.position = read_signal(top, "position", ColumnQuantity::kPosition);
  map_.velocity = read_signal(top, "velocity", ColumnQuantity::kVelocity);
  map_.acceleration = read_signal(top, "acceleration", ColumnQuantity::kAcceleration);
  map_.torque = read_signal(top, "torque", ColumnQuantity::kTorque);
  map_.simulated_torque = read_signal(top, "simulated_torque", ColumnQuantity::kTorque);
  map_.link_position = read_signal(top, "link_position", ColumnQuantity::kPosition);
  map_.temperature = read_signal(top, "temperature", ColumnQuantity::kTemperature);
  read_gears(top);
  if (const YAML::Node* node = top.find("runs")) read_runs(*node);
  check_lengths();
  check_together();
  faults_.check();
  return std::move(map_);
}

}  // namespace

bool import_maps_available() { return true; }

ImportMap parse_import_map(const std::string& text, const std::string& name) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.empty() || documents.front().IsNull()) {
      throw ImportError(fmt::format("{}:1:1: error: found an empty file, expected a map", name));
    }
    if (documents.size() > 1) {
      ImportMap named;
      named.name = name;
      throw ImportError(map_error(named, place_of(documents[1]),
                                  "found a second document in the file, expected one map"));
    }
    return MapFileReader(name).read(documents.front());
  } catch (const YAML::Exception& error) {
    ImportMap named;
    named.name = name;
    const MapPlace place = error.mark.is_null()
                               ? MapPlace{1, 1}
                               : MapPlace{static_cast<std::size_t>(error.mark.line) + 1,
                                          static_cast<std::size_t>(error.mark.column) + 1};
    throw ImportError(map_error(named, place, "this is no YAML: " + error.msg));
  }
}

ImportMap read_import_map(const std::string& path) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream && !stream.eof()) {
    throw ImportError(fmt::format("{}: error: cannot read the map: {}", path,
                                  errno != 0 ? std::strerror(errno) : "it is no file"));
  }
  return parse_import_map(text, path);
}

}  // namespace dyngen::runtime
