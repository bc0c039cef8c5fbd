// SPDX-License-Identifier: MIT
#include "runtime/import/map_signal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "runtime/import/signal_units.h"
#include "runtime/import/spelling.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {

namespace {

bool is_not_zero(double value) { return value != 0; }
bool is_positive(double value) { return value > 0; }
bool is_a_sign(double value) { return std::abs(value) == 1; }
bool is_an_efficiency(double value) { return value > 0 && value <= 1; }

/// The keys of a signal, which differ by what is measured.
MapEntries entries_of(const YAML::Node& node, const char* key, ColumnQuantity quantity,
                      MapFaults& faults) {
  if (quantity == ColumnQuantity::kTorque) {
    return {node,
            key,
            {"columns", "column", "unit", "side", "sign", "gain", "offset", "delay", "file",
             "table", "constant", "efficiency", "rated", "duty", "full", "voltage", "resistance",
             "back_emf", "bits"},
            faults};
  }
  if (quantity == ColumnQuantity::kTemperature) {
    return {node, key, {"columns", "column", "unit", "delay", "file", "table", "bits"}, faults};
  }
  return {node,
          key,
          {"columns", "column", "unit", "side", "sign", "gain", "offset", "delay", "file", "table",
           "counts_per_rev", "bits"},
          faults};
}

/// Values of a key that mean nothing are faults, each at its place.
void check_values(const MapEntries& entries, const char* key, const PerJoint& values,
                  bool (*is_right)(double), const char* expected, MapFaults& faults) {
  const std::vector<MapPlace> places = entries.places_of_values(key);
  for (std::size_t i = 0; i < values.size() && i < places.size(); ++i) {
    if (is_right(values[i])) continue;
    faults.add(places[i], fmt::format("found {} {}, expected {}", key, values[i], expected));
  }
}

}  // namespace

void check_file(const MapEntries& entries, const std::vector<FileMap>& files, MapFaults& faults) {
  const std::string key = entries.text("file");
  std::vector<std::string> keys;
  for (const FileMap& file : files) keys.push_back(file.key);
  if (std::find(keys.begin(), keys.end(), key) != keys.end()) return;
  faults.add(
      entries.place_of_value("file"),
      keys.empty()
          ? fmt::format("found file {}, expected 'files' to name the files", runtime::quoted(key))
          : fmt::format("found file {}, expected one of {}", runtime::quoted(key), listed(keys)));
}

void SignalReader::units(const MapEntries& entries, ColumnQuantity quantity, SignalMap& signal) {
  signal.units = entries.texts("unit");
  signal.unit_places = entries.places_of_values("unit");
  lengths_->note(entries, "unit", "units", signal.units.size());
  for (std::size_t i = 0; i < signal.units.size(); ++i) {
    const std::string& unit = signal.units[i];
    if (unit.empty()) continue;  // told
    const auto known = signal_unit(unit, quantity);
    if (!known) {
      faults_->add(signal.unit_places[i],
                   fmt::format("found unit {}, expected {}", runtime::quoted(unit),
                               known_signal_units(quantity)));
    }
  }
}

void SignalReader::sides(const MapEntries& entries, SignalMap& signal) {
  for (const std::string& word : entries.texts("side")) {
    if (word != "motor" && word != "joint" && !word.empty()) {
      faults_->add(entries.place_of_value("side"),
                   fmt::format("found side {}, expected motor or joint", runtime::quoted(word)));
    }
    signal.sides.push_back(word == "motor" ? GearSide::kMotor : GearSide::kJoint);
  }
  lengths_->note(entries, "side", "sides", signal.sides.size());
}

void SignalReader::duty(const MapEntries& entries, SignalMap& signal) {
  DutyTorque law;
  law.duty = entries.columns("duty");
  lengths_->note(law.duty.place, "columns", law.duty.names.size());
  law.full_scale = entries.numbers("full", MapNumber::kRatio);
  law.resistance = entries.numbers("resistance", MapNumber::kResistance);
  law.back_emf = entries.numbers("back_emf", MapNumber::kBackEmf);
  check_values(entries, "full", law.full_scale, is_not_zero, "the column's value at full voltage",
               *faults_);
  check_values(entries, "resistance", law.resistance, is_positive, "more than 0 ohm", *faults_);
  if (entries.has("voltage")) {
    const std::vector<std::string> words = entries.texts("voltage");
    const bool number =
        !words.empty() && read_map_number(words.front(), MapNumber::kVoltage).value.has_value();
    if (number) {
      law.supply = entries.numbers("voltage", MapNumber::kVoltage);
      check_values(entries, "voltage", law.supply, is_not_zero, "the volts of the supply",
                   *faults_);
    } else {
      law.voltage = entries.columns("voltage");
    }
  }
  for (const auto& [key, what] : {std::pair{"full", "the column's value at full voltage"},
                                  std::pair{"voltage", "the supply's column, or its volts"},
                                  std::pair{"resistance", "the winding's, in ohm"},
                                  std::pair{"constant", "the motor's, in N m/A"}}) {
    if (!entries.has(key)) {
      faults_->add(signal.place,
                   fmt::format("found 'duty' without '{}' in 'torque', expected {}", key, what));
    }
  }
  signal.duty = std::move(law);
}

PerJoint SignalReader::numbers(const MapEntries& entries, const char* key, MapNumber kind) {
  PerJoint values = entries.numbers(key, kind);
  lengths_->note(entries, key, fmt::format("numbers in '{}'", key), values.size());
  return values;
}

void SignalReader::conversion(const MapEntries& entries, bool torque, SignalMap& signal) {
  const auto check = [&](const char* own, const PerJoint& values, bool (*is_right)(double),
                         const char* expected) {
    check_values(entries, own, values, is_right, expected, *faults_);
  };
  signal.sign = numbers(entries, "sign", MapNumber::kRatio);
  check("sign", signal.sign, is_a_sign, "1 or -1");
  signal.gain = numbers(entries, "gain", MapNumber::kRatio);
  check("gain", signal.gain, is_not_zero,
        "another number than 0, which makes every value 0; leave 'gain' out if values are right "
        "as they are");
  const MapNumber offset = torque ? MapNumber::kTorque : MapNumber::kPosition;
  signal.offset = numbers(entries, "offset", offset);
  signal.offset_units = entries.units_of_numbers("offset", offset);
  signal.offset_places = entries.places_of_values("offset");
  signal.delay = entries.number("delay", MapNumber::kDuration).value_or(0);
  signal.counts_per_turn = numbers(entries, "counts_per_rev", MapNumber::kRatio);
  check("counts_per_rev", signal.counts_per_turn, is_not_zero,
        "the counts of one turn of the encoder");
  signal.constant = numbers(entries, "constant", MapNumber::kConstant);
  check("constant", signal.constant, is_not_zero, "the torque of one ampere");
  signal.efficiency = numbers(entries, "efficiency", MapNumber::kRatio);
  check("efficiency", signal.efficiency, is_an_efficiency, "more than 0, at most 1");
  signal.rated = numbers(entries, "rated", MapNumber::kTorque);
  check("rated", signal.rated, is_not_zero, "the torque at 100 %");
}

/// Keys that exclude or need one another.
void SignalReader::check_keys(const MapEntries& entries, const char* key, ColumnQuantity quantity,
                              const SignalMap& signal) {
  if (entries.has("bits") && signal.bits != 8 && signal.bits != 16 && signal.bits != 32) {
    faults_->add(entries.place_of_value("bits"),
                 fmt::format("found {} bits, expected 8, 16 or 32", signal.bits));
  }
  for (const char* own : {"full", "voltage", "resistance", "back_emf"}) {
    if (entries.has("duty") || !entries.has(own)) continue;
    faults_->add(entries.place_of_value(own),
                 fmt::format("found '{}' without 'duty' in '{}', expected the column of the "
                             "duty cycle",
                             own, key));
  }
  if (entries.has("columns") + entries.has("column") + entries.has("duty") != 1) {
    faults_->add(signal.place,
                 fmt::format("expected in '{}' one of 'columns'{}", key,
                             quantity == ColumnQuantity::kTorque ? ", 'column' and 'duty'"
                                                                 : " and 'column'"));
  }
  if ((quantity == ColumnQuantity::kVelocity || quantity == ColumnQuantity::kAcceleration) &&
      entries.has("offset")) {
    faults_->add(
        entries.place_of_value("offset"),
        fmt::format("found 'offset' in '{}', expected it of positions and torques alone", key));
  }
}

std::optional<SignalMap> SignalReader::read(const MapEntries& top, const char* key,
                                            ColumnQuantity quantity) {
  const YAML::Node* node = top.find(key);
  if (node == nullptr) return std::nullopt;
  const MapEntries entries = entries_of(*node, key, quantity, *faults_);
  SignalMap signal;
  signal.place = entries.place();
  signal.file = entries.text("file");
  if (entries.has("file")) check_file(entries, map_->files, *faults_);
  signal.table = entries.text("table");
  signal.columns = entries.columns(entries.has("column") ? "column" : "columns");
  lengths_->note(signal.columns.place, "columns",
                 quantity == ColumnQuantity::kTemperature ? 0 : signal.columns.names.size());
  signal.bits = static_cast<int>(entries.number("bits", MapNumber::kRatio).value_or(0));
  units(entries, quantity, signal);
  sides(entries, signal);
  conversion(entries, quantity == ColumnQuantity::kTorque, signal);
  if (entries.has("duty")) duty(entries, signal);
  check_keys(entries, key, quantity, signal);
  return signal;
}

}  // namespace dyngen::runtime
