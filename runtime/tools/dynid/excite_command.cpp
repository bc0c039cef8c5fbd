// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <iostream>
#include <stdexcept>

#include "runtime/tools/dynid/commands.h"

#ifdef DYNGEN_WITH_NLOPT
#include "gen/tool/output_files.h"
#include "gen/tool/progress_line.h"
#include "runtime/tools/dynid/excite_picture.h"
#include "runtime/tools/dynid/excite_report.h"
#endif

namespace dyngen::runtime {

#ifndef DYNGEN_WITH_NLOPT

int run_excite(const ToolOptions& /*options*/) {
  std::cerr << "dynid: excite: this dynid was built without NLopt (libnlopt-dev)\n";
  return kUsage;
}

#else

int run_excite(const ToolOptions& options) {
  if (!options.excite.findings.empty()) {
    throw std::invalid_argument(fmt::format(
        "--for: {}: trajectories that tell findings apart cannot be made yet; expected the command "
        "without --for, which designs one for the parameters",
        options.excite.findings));
  }
  ProgressLine progress("dynid");
  const ExciteReport report =
      make_excite_report(options.robot, options.excite,
                         [&](const std::string& what, std::size_t place, std::size_t all) {
                           progress.show(what, place, all);
                         });
  progress.clear();
  if (!options.json.empty()) {
    write_files({{options.json, json_of(report, options.output)}});
  }
  std::cout << text_of(report);
  if (!report.found) return kCannotAnswer;
  write_trajectory(report.trajectory, options.output);
  std::cout << fmt::format("written: {}, {} rows\n", options.output, report.trajectory.samples());
  if (!options.excite.picture.empty()) {
    draw(picture_of(report), options.excite.picture);
    std::cout << fmt::format("written: {}\n", options.excite.picture);
  }
  return kDone;
}

#endif

}  // namespace dyngen::runtime
