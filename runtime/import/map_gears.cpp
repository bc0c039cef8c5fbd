// SPDX-License-Identifier: MIT
#include "runtime/import/map_gears.h"

#include <fmt/format.h>

#include <Eigen/LU>

namespace dyngen::runtime {

void read_gears(const MapEntries& top, ImportMap& map, MapLengths& lengths, MapFaults& faults) {
  if (top.has("gears") && top.has("coupling")) {
    faults.add(top.place_of_value("coupling"),
               "found 'gears' and 'coupling', expected one: the matrix has the ratios too");
  }
  if (top.has("gears")) {
    map.gears_place = top.place_of_value("gears");
    map.gears = top.numbers("gears", MapNumber::kRatio);
    lengths.note(top, "gears", "gears", map.gears.size());
    const std::vector<MapPlace> places = top.places_of_values("gears");
    for (std::size_t i = 0; i < map.gears.size(); ++i) {
      if (map.gears[i] == 0) {
        faults.add(places[i],
                   "found a gear of 0, expected turns of the motor for one of the joint");
      }
    }
  }
  const YAML::Node* node = top.find("coupling");
  if (node == nullptr) return;
  map.gears_place = place_of(*node);
  const std::size_t rows = node->IsSequence() ? node->size() : 0;
  if (rows == 0) {
    faults.add(map.gears_place,
               "found no matrix in 'coupling', expected a list with a row for each motor: motor "
               "= K * joint");
    return;
  }
  lengths.note(map.gears_place, "rows", rows, true);
  map.coupling.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(rows));
  Eigen::Index row = 0;
  for (const auto& line : *node) {
    if (!line.IsSequence() || line.size() != rows) {
      faults.add(place_of(line), fmt::format("found {} numbers in a row of 'coupling', expected "
                                             "{}: one for each joint",
                                             line.IsSequence() ? line.size() : 1, rows));
      return;
    }
    Eigen::Index column = 0;
    for (const auto& number : line) {
      map.coupling(row, column++) = top.number_of(number, MapNumber::kRatio).value_or(0);
    }
    ++row;
  }
  constexpr double kSingular = 1e-9;  // of the largest pivot: no ratio of gears is so uneven
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(map.coupling);
  const auto pivots = factors.matrixLU().diagonal().cwiseAbs();
  if (!(pivots.minCoeff() > kSingular * pivots.maxCoeff())) {
    faults.add(map.gears_place,
               "found a 'coupling' that has no inverse, expected one from which the joints "
               "follow when the motors are known");
  }
}

}  // namespace dyngen::runtime
