// SPDX-License-Identifier: MIT
// What commands call of parts that this dynid was built without. None of it is ever reached.
#include "runtime/report/document_json.h"
#include "runtime/tools/dynid/atlas/atlas_report.h"
#include "runtime/tools/dynid/diagnose/diagnosis_report.h"
#include "runtime/tools/dynid/diagnose/forward_simulation.h"
#include "runtime/tools/dynid/excite/excite_report.h"
#include "runtime/tools/dynid/excite/finding_file.h"
#include "runtime/tools/dynid/excite/programme_report.h"
#include "runtime/tools/dynid/excite/separation_report.h"
#include "runtime/tools/dynid/fit/check_report.h"
#include "runtime/tools/dynid/fit/consistent_fit.h"
#include "runtime/tools/dynid/fit/fit_report.h"
#include "runtime/tools/dynid/options/commands.h"
#include "runtime/tools/dynid/options/parts.h"
#include "runtime/tools/dynid/robot/identified_description.h"

namespace dyngen::runtime {

#if !DYNGEN_WITH_BOOST
int run_simulate(const ToolOptions&) { call_absent(Part::kBoost); }
ForwardComparison compare_forward(const DiagnosisReport&, const DescribedRobot&,
                                  const EffectCatalogue&, const ForwardTask&,
                                  const std::function<void(double)>&) {
  call_absent(Part::kBoost);
}
#endif

#if !DYNGEN_WITH_CERES
ConsistentFit fit_consistently(const FitReport&) { call_absent(Part::kCeres); }
IdentifiedDescription identified_description(const std::string&, const std::string&,
                                             const WriteBackTask&, const EffectCatalogue&) {
  call_absent(Part::kCeres);
}
#endif

#if !DYNGEN_WITH_NLOPT
int run_excite(const ToolOptions&) { call_absent(Part::kNlopt); }
#endif

#if !DYNGEN_WITH_JSON
std::string report_page(const ReportDocument&) { call_absent(Part::kJson); }
std::string atlas_json(const AtlasReport&) { call_absent(Part::kJson); }
std::string check_json(const CheckReport&) { call_absent(Part::kJson); }
std::string diagnosis_json(const DiagnosisReport&) { call_absent(Part::kJson); }
std::string fit_json(const FitReport&) { call_absent(Part::kJson); }
std::string json_of(const ExciteReport&, const std::string&) { call_absent(Part::kJson); }
std::string programme_json(const ProgrammeReport&, const std::string&) { call_absent(Part::kJson); }
std::string separation_json(const SeparationReport&, const std::string&) {
  call_absent(Part::kJson);
}
OpenFinding read_open_finding(const std::string&) { call_absent(Part::kJson); }
#endif

}  // namespace dyngen::runtime
