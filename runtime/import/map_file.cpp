// SPDX-License-Identifier: MIT
#include "runtime/import/map_file.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "runtime/import/map_gears.h"
#include "runtime/import/map_lengths.h"
#include "runtime/import/map_nodes.h"
#include "runtime/import/map_signal.h"
#include "runtime/import/map_text_format.h"
#include "runtime/import/spelling.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

class MapFileReader {
 public:
  MapFileReader(const std::string& name, MapUse use) : use_(use), faults_(name) {
    map_.name = name;
  }

  ImportMap read(const YAML::Node& root);

 private:
  void read_joints(const MapEntries& top);
  void read_files(const YAML::Node& node);
  void read_time(const YAML::Node& node);
  void read_runs(const YAML::Node& node);
  void check_together();

  MapUse use_;
  ImportMap map_;
  MapFaults faults_;
  MapLengths lengths_;
};

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
      file.text = read_text_settings(entries, faults_);
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
  if (!entries.has("column") && !entries.has("rate")) {
    faults_.add(time.place, "found neither 'column' nor 'rate' in 'time', expected one of them");
  }
  if (entries.has("unit") && entries.has("rate")) {
    faults_.add(entries.place_of_value("unit"),
                "found 'unit' and 'rate' in 'time', expected one of them: a column with a rate "
                "counts, and has no unit");
  }
  if (!time.unit.empty() && !unit_conversion(time.unit, ColumnQuantity::kTime)) {
    faults_.add(entries.place_of_value("unit"),
                fmt::format("found unit {} of time, expected {}", runtime::quoted(time.unit),
                            known_units(ColumnQuantity::kTime)));
  }
}

void MapFileReader::read_runs(const YAML::Node& node) {
  const MapEntries entries(
      node, "runs", {"split", "keep", "skip_first", "skip_last", "cut", "file", "table"}, faults_);
  RunsMap& runs = map_.runs;
  runs.place = entries.place();
  runs.file = entries.text("file");
  if (entries.has("file")) check_file(entries, map_.files, faults_);
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
  each("commanded", map_.commanded);
  const bool motion = use_ == MapUse::kMotion;
  if (!map_.position && !(motion && map_.commanded)) {
    faults_.add({1, 1}, "found no 'position', expected the columns of the joints' positions");
  }
  if (!map_.torque && !motion) {
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
  const MapEntries top(root, "the map",
                       {"joints", "format", "files", "table", "time", "position", "velocity",
                        "acceleration", "torque", "simulated_torque", "link_position", "commanded",
                        "temperature", "gears", "coupling", "runs"},
                       faults_);
  read_joints(top);
  if (const YAML::Node* node = top.find("format")) {
    map_.text = read_text_settings(MapEntries(*node, "format", kTextFormatKeys, faults_), faults_);
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
  SignalReader signals(map_, lengths_, faults_);
  map_.position = signals.read(top, "position", ColumnQuantity::kPosition);
  map_.velocity = signals.read(top, "velocity", ColumnQuantity::kVelocity);
  map_.acceleration = signals.read(top, "acceleration", ColumnQuantity::kAcceleration);
  map_.torque = signals.read(top, "torque", ColumnQuantity::kTorque);
  map_.simulated_torque = signals.read(top, "simulated_torque", ColumnQuantity::kTorque);
  map_.link_position = signals.read(top, "link_position", ColumnQuantity::kPosition);
  map_.commanded = signals.read(top, "commanded", ColumnQuantity::kPosition);
  map_.temperature = signals.read(top, "temperature", ColumnQuantity::kTemperature);
  read_gears(top, map_, lengths_, faults_);
  if (const YAML::Node* node = top.find("runs")) read_runs(*node);
  lengths_.check(map_, faults_);
  check_together();
  faults_.check();
  return std::move(map_);
}

}  // namespace

bool import_maps_available() { return true; }

ImportMap parse_import_map(const std::string& text, const std::string& name, MapUse use) {
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
    return MapFileReader(name, use).read(documents.front());
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

ImportMap read_import_map(const std::string& path, MapUse use) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream && !stream.eof()) {
    throw ImportError(fmt::format("{}: error: cannot read the map: {}", path,
                                  errno != 0 ? std::strerror(errno) : "it is no file"));
  }
  return parse_import_map(text, path, use);
}

}  // namespace dyngen::runtime
