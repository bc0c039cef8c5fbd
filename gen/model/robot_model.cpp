// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/model/robot_model.h"

#include <fmt/format.h>

namespace dyngen {
namespace {

constexpr std::array<RowKey, kChiCount> kChiRows = {
    RowKey::kXX, RowKey::kXY, RowKey::kXZ, RowKey::kYY, RowKey::kYZ, RowKey::kZZ, RowKey::kMX,
    RowKey::kMY, RowKey::kMZ, RowKey::kM,  RowKey::kIA, RowKey::kFv, RowKey::kFs, RowKey::kOff};

const FieldValue* field(const RobotFile& file, RowKey key, int index) {
  const Row& row = file.row(key);
  return row.present ? &row.values[static_cast<std::size_t>(index)] : nullptr;
}

Quantity quantity(const RobotFile& file, RowKey key, int index) {
  const FieldValue* value = field(file, key, index);
  if (value == nullptr) return {};
  return {value->unknown, value->value, value->position.line};
}

GiNaC::ex number(const RobotFile& file, RowKey key, int index) {
  const FieldValue* value = field(file, key, index);
  return value == nullptr ? GiNaC::ex(0) : value->value;
}

std::optional<GiNaC::ex> limit(const RobotFile& file, RowKey key, int index) {
  const FieldValue* value = field(file, key, index);
  if (value == nullptr || value->unknown) return std::nullopt;
  return value->value;
}

int integer(const RobotFile& file, RowKey key, int index, int absent) {
  const FieldValue* value = field(file, key, index);
  return value == nullptr ? absent : GiNaC::ex_to<GiNaC::numeric>(value->value).to_int();
}

}  // namespace

RobotModel build_model(const RobotFile& file) {
  RobotModel model;
  model.name = file.name;
  model.file_name = file.file_name;
  model.convention = file.convention;
  model.parameters = file.parameters;
  model.effects = file.effects;
  model.text = file.source_text;
  for (int i = 0; i < file.joint_count; ++i) {
    JointModel joint;
    joint.type = static_cast<JointType>(integer(file, RowKey::kSigma, i, 0));
    joint.parent = integer(file, RowKey::kAnt, i, i);
    joint.alpha = number(file, RowKey::kAl, i);
    joint.theta = number(file, RowKey::kTh, i);
    joint.d = quantity(file, RowKey::kD, i);
    joint.r = quantity(file, RowKey::kR, i);
    for (std::size_t k = 0; k < kChiCount; ++k) joint.chi[k] = quantity(file, kChiRows[k], i);
    joint.qmin = limit(file, RowKey::kQmin, i);
    joint.qmax = limit(file, RowKey::kQmax, i);
    joint.name = file.joint_names.empty() ? fmt::format("joint{}", i + 1)
                                          : file.joint_names[static_cast<std::size_t>(i)];
    if (joint.type != JointType::kFixed) joint.coordinate = model.coordinate_count++;
    model.joints.push_back(std::move(joint));
  }
  constexpr std::array<RowKey, 3> kGravityRows = {RowKey::kGx, RowKey::kGy, RowKey::kGz};
  for (std::size_t k = 0; k < 3; ++k) model.gravity[k] = quantity(file, kGravityRows[k], 0);
  return model;
}

}  // namespace dyngen
