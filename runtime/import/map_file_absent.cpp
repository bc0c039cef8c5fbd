// SPDX-License-Identifier: MIT
// Stands for map_file.cpp where yaml-cpp is absent.
#include "runtime/import/map_file.h"

namespace dyngen::runtime {

bool import_maps_available() { return false; }

ImportMap parse_import_map(const std::string& /*text*/, const std::string& name, MapUse /*use*/) {
  throw ImportError(name +
                    ": error: this program was built without yaml-cpp, which reads maps; install "
                    "libyaml-cpp-dev and build it again");
}

ImportMap read_import_map(const std::string& path, MapUse use) {
  return parse_import_map({}, path, use);
}

}  // namespace dyngen::runtime
