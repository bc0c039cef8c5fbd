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
  signal.unit_place = entries.place_of_value("unit");
  lengths_->note(entries, "unit", "units", signal.units.size());
  for (const std::string& unit : signal.units) {
    if (unit.empty()) continue;  // told
    const auto known = signal_unit(unit, quantity);
    if (!known) {
      faults_->add(signal.unit_place,
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
  if (entries.has("voltage")) {
    const std::vector<std::string> words = entries.texts("voltage");
    const bool number =
        !words.empty() && read_map_number(words.front(), MapNumber::kVoltage).value.has_value();
    if (number) {
      law.supply = entries.numbers("voltage", MapNumber::kVoltage);
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

std::optional<SignalMap> SignalReader::read(const MapEntries& top, const char* key,
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
                        *faults_);
    }
    if (quantity == ColumnQuantity::kTemperature) {
      return MapEntries(*node, key, {"columns", "column", "unit", "delay", "file", "table", "bits"},
                        *faults_);
    }
    return MapEntries(*node, key,
                      {"columns", "column", "unit", "side", "sign", "gain", "offset", "delay",
                       "file", "table", "counts_per_rev", "bits"},
                      *faults_);
  }();
  SignalMap signal;
  signal.place = entries.place();
  signal.file = entries.text("file");
  if (entries.has("file")) check_file(entries, map_->files, *faults_);
  signal.table = entries.text("table");
  signal.columns = entries.columns(entries.has("column") ? "column" : "columns");
  lengths_->note(signal.columns.place, "columns",
                 quantity == ColumnQuantity::kTemperature ? 0 : signal.columns.names.size());
  units(entries, quantity, signal);
  sides(entries, signal);
  const auto numbers = [&](const char* own, MapNumber kind) {
    PerJoint values = entries.numbers(own, kind);
    lengths_->note(entries, own, fmt::format("numbers in '{}'", own), values.size());
    return values;
  };
  signal.sign = numbers("sign", MapNumber::kRatio);
  for (const double value : signal.sign) {
    if (std::abs(value) != 1) {
      faults_->add(entries.place_of_value("sign"),
                   fmt::format("found sign {}, expected 1 or -1", value));
    }
  }
  signal.bits = static_cast<int>(entries.number("bits", MapNumber::kRatio).value_or(0));
  if (entries.has("bits") && signal.bits != 8 && signal.bits != 16 && signal.bits != 32) {
    faults_->add(entries.place_of_value("bits"),
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
      faults_->add(entries.place_of_value("efficiency"),
                   fmt::format("found efficiency {}, expected more than 0, at most 1", value));
    }
  }
  signal.rated = numbers("rated", MapNumber::kTorque);
  if (entries.has("duty")) {
    duty(entries, signal);
  } else {
    for (const char* own : {"full", "voltage", "resistance", "back_emf"}) {
      if (!entries.has(own)) continue;
      faults_->add(entries.place_of_value(own),
                   fmt::format("found '{}' without 'duty' in '{}', expected the column of the "
                               "duty cycle",
                               own, key));
    }
  }
  if (entries.has("columns") + entries.has("column") + entries.has("duty") != 1) {
    faults_->add(signal.place, fmt::format("expected in '{}' one of 'columns'{}", key,
                                           torque ? ", 'column' and 'duty'" : " and 'column'"));
  }
  if ((quantity == ColumnQuantity::kVelocity || quantity == ColumnQuantity::kAcceleration) &&
      entries.has("offset")) {
    faults_->add(
        entries.place_of_value("offset"),
        fmt::format("found 'offset' in '{}', expected it of positions and torques alone", key));
  }
  return signal;
}

}  // namespace dyngen::runtime
