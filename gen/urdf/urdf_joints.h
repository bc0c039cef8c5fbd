// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "gen/urdf/urdf_elements.h"

namespace dyngen {

/// Reads the joints of a URDF; remembers their names. All that it is given outlives it.
class UrdfJoints {
 public:
  /// @param links  places of the bodies by the names of their links
  UrdfJoints(const std::map<std::string, std::size_t>& links, UrdfElements& elements)
      : links_(links), elements_(elements), values_(elements.values()) {}

  /// @return none if it has no name
  std::optional<TreeJoint> read(const XmlElement& element);

 private:
  /// @return  whether it is continuous
  bool read_type(const XmlElement& element, const std::string& whose, TreeJoint& joint);
  int read_end(const XmlElement& element, std::string_view end, const std::string& whose);
  void read_axis(const XmlElement& element, const std::string& whose, TreeJoint& joint);
  void read_limits(const XmlElement& element, const std::string& whose, bool continuous,
                   TreeJoint& joint);
  void read_dynamics(const XmlElement& element, TreeJoint& joint);

  const std::map<std::string, std::size_t>& links_;
  UrdfElements& elements_;
  XmlValues& values_;
  std::map<std::string, int> names_;  // lines
};

}  // namespace dyngen
