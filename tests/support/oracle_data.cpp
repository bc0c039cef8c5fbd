// SPDX-License-Identifier: MIT
#include "tests/support/oracle_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace dyngen::test {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 10> kInertialNames = {"XX", "XY", "XZ", "YY", "YZ",
                                                        "ZZ", "MX", "MY", "MZ", "M"};

std::string oracle_path(const std::string& file) {
  return std::string(DYNGEN_SOURCE_DIR "/tests/data/oracles/") + file;
}

std::ifstream open_oracle(const std::string& file) {
  std::ifstream stream(oracle_path(file));
  if (!stream) throw std::runtime_error(oracle_path(file) + ": cannot be read");
  return stream;
}

json read_json(const std::string& file) {
  std::ifstream stream = open_oracle(file);
  try {
    return json::parse(stream);
  } catch (const json::exception& error) {
    throw std::runtime_error(oracle_path(file) + ": " + error.what());
  }
}

/// The stored gravity is g itself; the robot carries -g.
void set_gravity(const json& gravity, NumericRobot& robot) {
  for (std::size_t k = 0; k < 3; ++k) robot.base_acceleration[k] = -gravity.at(k).get<double>();
}

double radians(double degrees) { return degrees / 180.0 * std::numbers::pi; }

NumericJoint serial_joint(std::size_t i) {
  NumericJoint joint;
  joint.parent = static_cast<int>(i);
  return joint;
}

/// planar2r ... panda7: one object per joint.
NumericRobot robot_from_joints(const json& file) {
  NumericRobot robot;
  for (std::size_t i = 0; i < file.at("joints").size(); ++i) {
    const json& row = file.at("joints").at(i);
    NumericJoint joint = serial_joint(i);
    joint.sigma = row.at("sigma").get<int>();
    joint.alpha = row.at("alpha").get<double>();
    joint.d = row.at("d").get<double>();
    joint.theta = row.at("theta").get<double>();
    joint.r = row.at("r").get<double>();
    joint.inertial = file.at("inertial").at(i).get<std::array<double, 10>>();
    joint.IA = row.at("IA").get<double>();
    joint.Fs = row.at("FS").get<double>();
    joint.Fv = row.at("FV").get<double>();
    robot.joints.push_back(joint);
  }
  set_gravity(file.at("gravity"), robot);
  return robot;
}

/// The `standard_dh` part: drives as in the modified form, all else its own.
NumericRobot standard_form(const json& file, const NumericRobot& modified) {
  const json& part = file.at("standard_dh");
  NumericRobot robot = modified;
  robot.standard = true;
  for (std::size_t i = 0; i < robot.size(); ++i) {
    const json& row = part.at("rows").at(i);
    NumericJoint& joint = robot.joints[i];
    joint.sigma = row.at("sigma").get<int>();
    joint.theta = row.at("theta").get<double>();
    joint.r = row.at("r").get<double>();
    joint.d = row.at("a").get<double>();
    joint.alpha = row.at("alpha").get<double>();
    joint.inertial = part.at("inertial").at(i).get<std::array<double, 10>>();
  }
  set_gravity(part.at("gravity"), robot);
  return robot;
}

/// The two PUMA 560 files: one array per quantity, and Corke's names in the standard one.
NumericRobot puma560(const json& file) {
  NumericRobot robot;
  robot.standard = file.contains("d_offset");
  const json& d = file.at(robot.standard ? "a" : "d");
  const json& r = file.at(robot.standard ? "d_offset" : "r");
  for (std::size_t i = 0; i < file.at("alpha").size(); ++i) {
    NumericJoint joint = serial_joint(i);
    joint.alpha = file.at("alpha").at(i).get<double>();
    joint.d = d.at(i).get<double>();
    joint.r = r.at(i).get<double>();
    if (file.contains("theta")) joint.theta = file.at("theta").at(i).get<double>();
    joint.inertial = file.at("inertial").at(i).get<std::array<double, 10>>();
    joint.IA = file.at("IA").at(i).get<double>();
    joint.Fs = file.at("FS").at(i).get<double>();
    joint.Fv = file.at("FV").at(i).get<double>();
    robot.joints.push_back(joint);
  }
  set_gravity(file.at("gravity"), robot);
  return robot;
}

std::vector<OracleState> read_states(const json& rows) {
  std::vector<OracleState> states;
  for (const json& row : rows) {
    OracleState state;
    row.at("q").get_to(state.q);
    row.at("qd").get_to(state.dq);
    row.at("qdd").get_to(state.ddq);
    row.at("tau").get_to(state.tau);
    row.at("tau_nofric").get_to(state.tau_nofric);
    row.at("tau_rb").get_to(state.tau_rb);
    row.at("g").get_to(state.g);
    row.at("c").get_to(state.c);
    for (const json& line : row.at("M")) {
      for (const json& entry : line) state.M.push_back(entry.get<double>());
    }
    states.push_back(std::move(state));
  }
  return states;
}

void check_order(const json& file, const std::string& name) {
  const auto order = file.at("inertial_order").get<std::vector<std::string>>();
  if (!std::equal(order.begin(), order.end(), kInertialNames.begin(), kInertialNames.end())) {
    throw std::runtime_error(oracle_path(name) +
                             ": inertial_order is not XX XY XZ YY YZ ZZ MX MY MZ M");
  }
}

Table read_table(const std::string& file) {
  std::ifstream stream = open_oracle(file);
  Table table;
  std::string line, cell;
  const auto next_line = [&] {
    if (!std::getline(stream, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();  // line ends of another system
    return true;
  };
  next_line();
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) table.names.push_back(cell);
  while (next_line()) {
    std::vector<double> row;
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) {
      row.push_back(std::stod(cell));
    }
    if (row.size() != table.names.size()) {
      throw std::runtime_error(oracle_path(file) + ": a row has " + std::to_string(row.size()) +
                               " cells, the header " + std::to_string(table.names.size()));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

const std::vector<std::string>& oracle_names() {
  static const std::vector<std::string> names = {
      "planar2r", "rp",     "scara_rrpr",      "stanford",         "rx90",
      "ur10e",    "panda7", "puma560_akb_mdh", "puma560_corke_std"};
  return names;
}

Oracle load_oracle(const std::string& name) {
  const std::string file_name = name + ".json";
  const json file = read_json(file_name);
  try {
    check_order(file, file_name);
    Oracle oracle;
    if (file.contains("joints")) {
      oracle.robot = robot_from_joints(file);
      oracle.standard = standard_form(file, oracle.robot);
    } else {
      oracle.robot = puma560(file);
    }
    oracle.states = read_states(file.at("states"));
    return oracle;
  } catch (const json::exception& error) {
    throw std::runtime_error(oracle_path(file_name) + ": " + error.what());
  }
}

NumericRobot load_sarcos() {
  const json file = read_json("sarcos_listing.json");
  const json& defines = file.at("defines");
  const json& dh = file.at("table_6_2");
  NumericRobot robot;
  robot.standard = true;
  for (std::size_t i = 0; i < dh.at("alpha_deg").size(); ++i) {
    NumericJoint joint = serial_joint(i);
    joint.alpha = radians(dh.at("alpha_deg").at(i).get<double>());
    joint.d = dh.at("a").at(i).get<double>();
    joint.r = dh.at("r").at(i).get<double>();
    joint.theta = radians(dh.at("theta_offset").at(i).get<double>());
    const std::string link = std::to_string(i + 1);
    joint.inertial[inertial_place("MX")] = defines.value("mX" + link, 0.0);
    joint.inertial[inertial_place("MY")] = defines.value("mY" + link, 0.0);
    joint.inertial[inertial_place("MZ")] = defines.value("mZ" + link, 0.0);
    robot.joints.push_back(joint);
  }
  robot.base_acceleration = {defines.at("GX").get<double>(), defines.at("GY").get<double>(),
                             defines.at("GZ").get<double>()};
  return robot;
}

NamedValues load_table_7_1() {
  const json file = read_json("puma3_table71.json");
  return {file.at("names").get<std::vector<std::string>>(),
          file.at("table_7_1").get<std::vector<double>>()};
}

NumericRobot load_puma3() {
  const json file = read_json("puma3_table71.json");
  NumericRobot robot;
  for (std::size_t i = 0; i < 3; ++i) robot.joints.push_back(serial_joint(i));
  robot.joints[1].alpha = radians(90);
  robot.joints[2].d = file.at("L").get<double>();
  robot.base_acceleration = {0, 0, file.at("g").get<double>()};
  const NamedValues table = load_table_7_1();
  for (std::size_t k = 0; k < table.names.size(); ++k) {
    const std::string& name = table.names[k];
    const std::size_t link = std::stoul(name.substr(2));
    robot.joints.at(link - 1).inertial[inertial_place(name.substr(0, 2))] = table.values[k];
  }
  return robot;
}

std::vector<double> Table::slice(std::size_t row, const std::string& first,
                                 std::size_t count) const {
  const auto found = std::find(names.begin(), names.end(), first);
  const auto left = static_cast<std::size_t>(names.end() - found);
  if (found == names.end() || left < count) {
    throw std::runtime_error("no " + std::to_string(count) + " columns from '" + first + "' on");
  }
  const auto begin = rows.at(row).begin() + (found - names.begin());
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

Table load_sarcos_gravity() { return read_table("sarcos_gravity.csv"); }

Table load_puma3_regressor() { return read_table("puma3_regressor.csv"); }

std::size_t inertial_place(const std::string& name) {
  const auto found = std::find(kInertialNames.begin(), kInertialNames.end(), name);
  if (found == kInertialNames.end()) {
    throw std::runtime_error("'" + name + "' is not one of XX XY XZ YY YZ ZZ MX MY MZ M");
  }
  return static_cast<std::size_t>(found - kInertialNames.begin());
}

}  // namespace dyngen::test
