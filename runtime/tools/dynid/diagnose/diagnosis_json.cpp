// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/diagnose/diagnosis_report.h"
#include "runtime/tools/dynid/ripple/joint_ripple_json.h"
#include "runtime/tools/dynid/robot/json_numbers.h"
#include "runtime/tools/dynid/robot/left_out_json.h"
#include "runtime/tools/dynid/steady/steady_json.h"
#include "runtime/tools/dynid/two_encoders/two_encoders_json.h"

namespace dyngen::runtime {
namespace {

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json parameters(const Finding& finding, const EffectWords& words) {
  Json json = Json::object();
  for (std::size_t p = 0; p < finding.parameters.size(); ++p) {
    const EffectParameterFit& parameter = finding.parameters[p];
    const bool known = !parameter.held && parameter.seen && parameter.stddev > 0;
    json[finding.effect.law.parameters[p].name] = {
        {"value", number(parameter.value)},
        {"std", known ? number(parameter.stddev) : Json(nullptr)},
        {"unit", words.units[p]}};
  }
  return json;
}

Json finding_json(const Finding& finding, const EffectWords& words) {
  const EffectLocation& where = finding.where;
  const int other = finding.effect.other;
  return {{"family", finding.effect.law.family},
          {"joint", answer_joint(finding.effect)},
          {"other_joint", other < 0 ? Json(nullptr) : Json(other + 1)},
          {"aliases", finding.aliases},
          {"probability", number(finding.probability)},
          {"since_reference", finding.since_reference},
          {"where",
           {{"variable", text_or_null(where.variable)},
            {"from", where.variable.empty() ? Json(nullptr) : number(where.from)},
            {"to", where.variable.empty() ? Json(nullptr) : number(where.to)},
            {"t_from", number(where.t_from)},
            {"t_to", number(where.t_to)},
            {"share", number(where.share)}}},
          {"formula", finding.formula.empty() ? words.formula : finding.formula},
          {"parameters", parameters(finding, words)},
          {"evidence",
           {{"lambda", number(finding.evidence.lambda)},
            {"delta_bic", number(finding.evidence.delta_bic)},
            {"heldout_gain", number(finding.evidence.heldout_gain)}}},
          {"unusual", finding.unusual},
          {"caveats", finding.caveats},
          {"why", finding.why}};
}

Json effort_json(const EffortUsed& effort) {
  return {{"done", number(effort.done)},
          {"limit", effort.most > 0 ? number(effort.most) : Json(nullptr)},
          {"not_searched", effort.not_searched()}};
}

/// One word for all joints where they are alike.
std::string torque_unit(const DiagnosisReport& report) {
  bool any_revolute = false, any_prismatic = false;
  for (const bool revolute : report.revolute) (revolute ? any_revolute : any_prismatic) = true;
  if (!any_prismatic) return "N m";
  return any_revolute ? "N m, N of prismatic joints" : "N";
}

}  // namespace

std::string diagnosis_json(const DiagnosisReport& report) {
  const Diagnosis& diagnosis = report.diagnosis;
  Json findings = Json::array(), not_judged = Json::array(), undecidable = Json::array(),
       unexplained = Json::array(), certificate = Json::array(), base = Json::array();
  for (std::size_t i = 0; i < diagnosis.findings.size(); ++i) {
    findings.push_back(finding_json(diagnosis.findings[i], report.words[i]));
  }
  for (const UnjudgedJoint& own : diagnosis.not_judged) {
    not_judged.push_back({{"joint", own.joint + 1},
                          {"equations", number(own.equations)},
                          {"needed", number(own.needed)},
                          {"why", own.why}});
  }
  for (const Undecidable& own : diagnosis.undecidable) {
    undecidable.push_back({{"families", own.families}, {"joint", own.joint + 1}, {"why", own.why}});
  }
  for (const Unexplained& own : diagnosis.unexplained) {
    unexplained.push_back({{"joint", own.joint + 1},
                           {"variables", own.variables},
                           {"rms", number(own.rms)},
                           {"unit", report.unit(own.joint)},
                           {"description", own.description}});
  }
  for (std::size_t i = 0; i < diagnosis.certificate.size(); ++i) {
    const CertificateLine& line = diagnosis.certificate[i];
    certificate.push_back({{"family", line.effect.law.family},
                           {"joint", answer_joint(line.effect)},
                           {"smallest_detectable", number(line.smallest)},
                           {"unit", text_or_null(report.certificate_units[i])}});
  }
  for (const BaseShift& shift : diagnosis.base_parameters) {
    base.push_back({{"name", shift.name},
                    {"before", number(shift.before)},
                    {"after", number(shift.after)},
                    {"std", number(shift.stddev)}});
  }
  Json json = {{"schema", "dynid.diagnosis/1"},
               {"robot", report.robot},
               {"joints", report.joints()},
               {"verdict", verdict_name(diagnosis.verdict)},
               {"findings", std::move(findings)},
               {"not_judged", std::move(not_judged)},
               {"undecidable", std::move(undecidable)},
               {"unexplained", std::move(unexplained)},
               {"certificate", std::move(certificate)},
               {"base_parameters", std::move(base)},
               {"heldout",
                {{"unit", torque_unit(report)},
                 {"rms_before", numbers(diagnosis.heldout.before)},
                 {"rms_after", numbers(diagnosis.heldout.after)},
                 {"noise_floor", numbers(diagnosis.heldout.floor)}}},
               {"effort", effort_json(diagnosis.effort)},
               {"next_experiment",
                {{"purpose", text_or_null(diagnosis.next.purpose)},
                 {"trajectory", text_or_null(report.trajectory)}}}};
  json["notes"] = report.notes;
  // long recordings
  for (const DiagnosedRecording& own : report.recordings) {
    for (const auto& [from, to] : own.stretches) {
      json["stretches"].push_back({{"recording", own.name}, {"t_from", from}, {"t_to", to}});
    }
  }
  if (report.two_encoders.any()) json["two_encoders"] = two_encoders_json(report.two_encoders);
  json["ripple"] = ripple_json(report.ripples);
  if (report.steady.any()) json["steady"] = steady_json(report.steady);
  if (report.written_back) json["written_back"] = written_back_json(*report.written_back);
  // names come from files: what is not UTF-8 must not stop the answer
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dyngen::runtime
