// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/logs/raw_log.h"
#include "runtime/recordings/notice.h"

namespace dyngen::runtime {

/// What a map asks for cannot be had, or the map is wrong; what() has a line "MAP:3:12: error: ..."
/// for each fault.
class ImportError : public RecordingError {
 public:
  using RecordingError::RecordingError;
};

/// Where a word of the map stands, both from 1; 0: nowhere.
struct MapPlace {
  std::size_t line = 0, column = 0;
};

/// On which side of the gears a signal is measured.
enum class GearSide { kJoint, kMotor };

/// One value for all joints, one for each joint, or none.
using PerJoint = std::vector<double>;

/// The value of a joint (from 0), or `otherwise` where there is none.
double of_joint(const PerJoint& values, std::size_t joint, double otherwise);

/// Names of columns: one for each joint, or one pattern for all. In a pattern {n} is the joint's
/// number from 1, {i} its number from 0 and {joint} its name.
struct ColumnNames {
  MapPlace place;
  std::vector<std::string> names;
};

/// Torque of a servo that records its duty cycle: tau = k (u - ke w) / R with u = duty * voltage,
/// k N m/A, ke V s/rad, R ohm (a direct-current motor without inductance).
struct DutyTorque {
  ColumnNames duty;
  PerJoint full_scale;            ///< value of the column at full voltage
  ColumnNames voltage;            ///< V; no names: `supply`
  PerJoint supply;                ///< V
  PerJoint resistance, back_emf;  ///< ohm, V s/rad
};

/// One measured quantity of all joints. Value in SI = raw * unit * sign * gain; it is brought to
/// the joints after that, and `offset` is added last.
struct SignalMap {
  MapPlace place;
  std::string file;   ///< key of ImportMap::files; empty: the only one
  std::string table;  ///< topic or variable; empty: that of the map
  ColumnNames columns;
  std::vector<std::string> units;  ///< one, one for each joint, or none: the log's own
  std::vector<MapPlace> unit_places;
  PerJoint counts_per_turn;  ///< of unit "counts"
  int bits = 0;  ///< 8, 16, 32: the log holds signed numbers of so many bits as unsigned; 0: not
  std::vector<GearSide> sides;  ///< one, one for each joint, or none: joint
  PerJoint sign, gain;
  PerJoint offset;                        ///< rad or m, N m or N, at the joint
  std::vector<std::string> offset_units;  ///< as written; empty: none stands there
  std::vector<MapPlace> offset_places;
  double delay = 0;   ///< s: a value stands so much later than it was true
  PerJoint constant;  ///< torque of currents: N m/A (N/A)
  PerJoint efficiency;
  PerJoint rated;  ///< torque of percent: N m at 100 %
  std::optional<DutyTorque> duty;
};

/// The clock.
struct TimeMap {
  MapPlace place;
  std::string column;  ///< empty: there is none, rows come at `rate`
  std::string unit;    ///< empty: the log's own
  double rate = 0;     ///< Hz; with a column: at which it counts
};

/// Which rows are used, and where runs begin.
struct RunsMap {
  MapPlace place;
  std::string file, table;
  ColumnNames split;                            ///< a new run begins where a value changes
  ColumnNames keep;                             ///< rows where one is 0 are left out
  double skip_first = 0, skip_last = 0;         ///< s, of each log
  std::vector<std::pair<double, double>> cuts;  ///< s from the first row: left out, ends included
};

/// One of several files that make one recording.
struct FileMap {
  MapPlace place;
  std::string key;
  std::string pattern;  ///< of the file's name: '*' any text, '?' one character
  LogTextSettings text;
};

/// What makes a recording of a log: which columns are which, in which units, on which side of the
/// gears. docs/reference/import.md has the file that it is read from.
struct ImportMap {
  std::string name;  ///< of its file, for messages
  int joints = 0;    ///< 0: as many as the robot has, or as the log has columns
  std::vector<std::string> joint_names;
  MapPlace joints_place;
  bool joints_by_a_list = false;  ///< nothing but the length of a list says how many there are
  LogTextSettings text;
  std::vector<FileMap> files;  ///< empty: a log is one file
  std::string table;           ///< empty: the one that has the columns
  TimeMap time;
  std::optional<SignalMap> position, velocity, acceleration, torque, simulated_torque,
      link_position, temperature;
  std::optional<SignalMap> commanded;  ///< position that was asked for
  bool motion_only = false;            ///< of map_of_motion(): velocities that are absent are none
  PerJoint gears;                      ///< motor turns per joint turn, signed; empty: none
  Eigen::MatrixXd coupling;  ///< K (motors x joints): motor = K joint; 0 x 0: diagonal of gears
  MapPlace gears_place;
  RunsMap runs;
};

/// What the map says of a motion that is asked for: 'commanded', or else positions with the
/// velocities and accelerations that the log has. Files of other signals are not needed.
ImportMap map_of_motion(ImportMap map);

/// "MAP:3:12: error: message", for ImportError.
std::string map_error(const ImportMap& map, const MapPlace& place, const std::string& message);

}  // namespace dyngen::runtime
