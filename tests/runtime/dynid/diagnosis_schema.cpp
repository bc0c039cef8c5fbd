// SPDX-License-Identifier: MIT
#include "tests/runtime/dynid/diagnosis_schema.h"

#include <cctype>
#include <cstring>
#include <functional>
#include <map>
#include <set>

#include "runtime/report/document_json.h"

namespace dyngen::test {
namespace {

using Json = nlohmann::json;
using Faults = std::vector<std::string>;
using Check = std::function<void(const Json& value, const std::string& place, Faults& faults)>;

Check kind(const std::string& kinds) {
  return [kinds](const Json& value, const std::string& place, Faults& faults) {
    for (const char k : kinds) {
      if (k == 's' && value.is_string()) return;
      if (k == 'n' && value.is_number()) return;
      if (k == 'i' && value.is_number_integer() && value.get<int>() >= 0) return;
      if (k == '0' && value.is_null()) return;
      if (k == 'b' && value.is_boolean()) return;
    }
    faults.push_back(place + ": of the wrong kind: " + value.dump());
  };
}

Check array_of(Check element) {
  return [element](const Json& value, const std::string& place, Faults& faults) {
    if (!value.is_array()) {
      faults.push_back(place + ": expected an array");
      return;
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
      element(value[i], place + "/" + std::to_string(i), faults);
    }
  };
}

/// @param optional  keys that may be absent
Check object(std::map<std::string, Check> keys, std::map<std::string, Check> optional = {}) {
  return [keys, optional](const Json& value, const std::string& place, Faults& faults) {
    if (!value.is_object()) {
      faults.push_back(place + ": expected an object");
      return;
    }
    for (const auto& [key, check] : keys) {
      if (value.contains(key)) {
        check(value[key], place + "/" + key, faults);
      } else {
        faults.push_back(place + "/" + key + ": missing");
      }
    }
    for (const auto& item : value.items()) {
      if (keys.contains(item.key())) continue;
      if (optional.contains(item.key())) {
        optional.at(item.key())(item.value(), place + "/" + item.key(), faults);
      } else {
        faults.push_back(place + "/" + item.key() + ": unknown");
      }
    }
  };
}

/// Any names, each with the same kind of value.
Check table_of(Check element) {
  return [element](const Json& value, const std::string& place, Faults& faults) {
    if (!value.is_object()) {
      faults.push_back(place + ": expected an object");
      return;
    }
    for (const auto& item : value.items()) {
      element(item.value(), place + "/" + item.key(), faults);
    }
  };
}

Check one_of(std::set<std::string> words) {
  return [words](const Json& value, const std::string& place, Faults& faults) {
    if (!value.is_string() || !words.contains(value.get<std::string>())) {
      faults.push_back(place + ": not one of the words: " + value.dump());
    }
  };
}

/// A joint with two encoders; one that is not judged has remarks alone.
Check two_encoders() {
  const Check number = kind("n0"), text = kind("s");
  std::map<std::string, Check> keys = {{"value", number}, {"low", number},     {"high", number},
                                       {"p", number},     {"seen", kind("b")}, {"below", number},
                                       {"unit", text}};
  const Check quantity = object(keys);
  const Check or_null = [quantity](const Json& value, const std::string& place, Faults& faults) {
    if (!value.is_null()) quantity(value, place, faults);
  };
  keys.insert({{"driver", text}, {"reach", number}});
  const Check line = object({{"order", number},
                             {"of_motor", number},
                             {"amplitude", quantity},
                             {"phase", number},
                             {"p", number}});
  return object({{"joint", kind("i")}, {"judged", kind("b")}, {"remarks", array_of(text)}},
                {{"delay", quantity},
                 {"stiffness", quantity},
                 {"compliance", quantity},
                 {"hardening", quantity},
                 {"hysteresis", object(keys)},
                 {"backlash", or_null},
                 {"slow_gear_error", quantity},
                 {"rotor_inertia", or_null},
                 {"gear_error", object({{"lines", array_of(line)},
                                        {"below", number},
                                        {"least_order", number},
                                        {"most_order", number}})},
                 {"load", object({{"explained", number},
                                  {"own_rms", number},
                                  {"attenuation", number},
                                  {"model_share", number}})},
                 {"residual", number},
                 {"degrees", kind("i")}});
}

/// Orders of a joint's angle; a joint that is not judged has remarks alone.
Check ripple() {
  const Check number = kind("n0"), text = kind("s"), flag = kind("b");
  const Check interval =
      object({{"value", number}, {"low", number}, {"high", number}, {"unit", text}});
  const Check wave = object({{"amplitude", interval}, {"phase", interval}});
  const Check wave_or_null = [wave](const Json& value, const std::string& place, Faults& faults) {
    if (!value.is_null()) wave(value, place, faults);
  };
  const Check line = object({{"kind", one_of({"torque", "position_error"})},
                             {"order", interval},
                             {"stated", number},
                             {"of_motor", number},
                             {"both", wave_or_null},
                             {"forward", wave_or_null},
                             {"backward", wave_or_null},
                             {"directions_differ", flag},
                             {"position_error_open", flag},
                             {"changes_with_speed", flag},
                             {"p", number},
                             {"lambda", number},
                             {"from_hz", number},
                             {"to_hz", number},
                             {"found_as", text}});
  const Check ruled_out = object({{"order", number},
                                  {"reason", one_of({"fixed_frequency", "image"})},
                                  {"hz", number},
                                  {"other_order", number}});
  return object({{"joint", kind("i")}, {"judged", flag}, {"remarks", array_of(text)}},
                {{"lines", array_of(line)},
                 {"ruled_out", array_of(ruled_out)},
                 {"cut_off", flag},
                 {"below", number},
                 {"least_order", number},
                 {"most_order", number},
                 {"resolution", number}});
}

/// A joint with runs of constant speed or held poses.
Check steady() {
  const Check number = kind("n0"), text = kind("s"), count = kind("i"), texts = array_of(text);
  const std::map<std::string, Check> interval = {
      {"value", number}, {"low", number}, {"high", number}};
  std::map<std::string, Check> parameter = interval;
  parameter.insert({"unit", text});
  const Check form = object({{"terms", texts},
                             {"words", text},
                             {"parameters", table_of(object(parameter))},
                             {"tests", array_of(object({{"term", text},
                                                        {"f", number},
                                                        {"degrees", number},
                                                        {"shapes", count},
                                                        {"p", number},
                                                        {"kept", kind("b")}}))},
                             {"rivals", array_of(texts)},
                             {"chi_square", number},
                             {"fitted", count},
                             {"scatter", number},
                             {"degrees", count}});
  const Check form_or_null = [form](const Json& value, const std::string& place, Faults& faults) {
    if (!value.is_null()) form(value, place, faults);
  };
  const Check mean = object(interval);
  return object({{"joint", count},
                 {"unit", text},
                 {"runs", count},
                 {"left_out", count},
                 {"seconds", number},
                 {"points", array_of(object({{"speed", number},
                                             {"torque", number},
                                             {"low", number},
                                             {"high", number},
                                             {"runs", count},
                                             {"seconds", number}}))},
                 {"form", form_or_null},
                 {"poses", array_of(object({{"q", array_of(number)},
                                            {"from_below", mean},
                                            {"from_above", mean},
                                            {"gravity", mean},
                                            {"held_back", mean}}))},
                 {"one_sided_poses", count},
                 {"remarks", texts}});
}

Check schema() {
  const Check text = kind("s"), number = kind("n0"), joint = kind("i"), texts = array_of(text);
  const Check where = object({{"variable", kind("s0")},
                              {"from", number},
                              {"to", number},
                              {"t_from", number},
                              {"t_to", number},
                              {"share", number}});
  // held parameters have no std, but always a unit
  const Check parameter = object({{"value", number}, {"std", number}, {"unit", text}});
  const Check finding = object(
      {{"family", text},
       {"joint", joint},
       {"other_joint", kind("i0")},
       {"aliases", texts},
       {"probability", number},
       {"since_reference", kind("b")},
       {"where", where},
       {"formula", text},
       {"parameters", table_of(parameter)},
       {"evidence", object({{"lambda", number}, {"delta_bic", number}, {"heldout_gain", number}})},
       {"unusual", texts},
       {"caveats", texts},
       {"why", text}});
  return object(
      {{"schema", one_of({"dynid.diagnosis/1"})},
       {"robot", text},
       {"joints", joint},
       {"verdict", one_of({"clean", "explained", "not_explained", "unexplained_structure",
                           "insufficient_data"})},
       {"findings", array_of(finding)},
       {"not_judged",
        array_of(
            object({{"joint", joint}, {"equations", number}, {"needed", number}, {"why", text}}))},
       {"undecidable", array_of(object({{"families", texts}, {"joint", joint}, {"why", text}}))},
       {"unexplained", array_of(object({{"joint", joint},
                                        {"variables", texts},
                                        {"rms", number},
                                        {"unit", text},
                                        {"description", text}}))},
       {"certificate", array_of(object({{"family", text},
                                        {"joint", joint},
                                        {"smallest_detectable", number},
                                        {"unit", kind("s0")}}))},
       {"base_parameters",
        array_of(object({{"name", text}, {"before", number}, {"after", number}, {"std", number}}))},
       {"heldout", object({{"unit", text},
                           {"rms_before", array_of(number)},
                           {"rms_after", array_of(number)},
                           {"noise_floor", array_of(number)}})},
       {"effort", object({{"done", number}, {"limit", number}, {"not_searched", array_of(text)}})},
       {"next_experiment", object({{"purpose", kind("s0")}, {"trajectory", kind("s0")}})},
       {"notes", texts},
       {"ripple", array_of(ripple())}},
      {{"two_encoders", array_of(two_encoders())}, {"steady", array_of(steady())}});
}

void add_keys(const Json& json, const Json::json_pointer& place,
              std::vector<Json::json_pointer>& keys) {
  if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) add_keys(json[i], place / i, keys);
  }
  if (!json.is_object()) return;
  for (const auto& item : json.items()) {
    // names of an effect's parameters are no part of the schema
    if (place.empty() || place.back() != "parameters") keys.push_back(place / item.key());
    add_keys(item.value(), place / item.key(), keys);
  }
}

}  // namespace

Faults schema_faults(const Json& json) {
  Faults faults;
  schema()(json, "", faults);
  return faults;
}

std::vector<Json::json_pointer> all_keys(const Json& json) {
  std::vector<Json::json_pointer> keys;
  add_keys(json, Json::json_pointer(), keys);
  return keys;
}

Json page_document(const std::string& page) {
  const std::string begin = "<script id=\"report\" type=\"application/json\">";
  const std::size_t from = page.find(begin);
  if (from == std::string::npos) return nullptr;
  const std::size_t to = page.find("</script>", from);
  const std::string text = page.substr(from + begin.size(), to - from - begin.size());
  return Json::parse(text, nullptr, false);
}

std::string page_fault(const std::string& page) {
  const std::string& whole = runtime::page_template();
  const std::string title = "@TITLE@", report = "@REPORT@";
  const std::size_t first = whole.find(title), second = whole.find(report);
  if (first == std::string::npos || second == std::string::npos || second < first) {
    return "the template has no places";
  }
  const std::string head = whole.substr(0, first);
  const std::string middle = whole.substr(first + title.size(), second - first - title.size());
  const std::string tail = whole.substr(second + report.size());
  const std::size_t next = page.find(middle, head.size());
  if (page.compare(0, head.size(), head) != 0) return "another beginning";
  if (next == std::string::npos) return "another middle";
  if (page.size() < tail.size() || page.substr(page.size() - tail.size()) != tail) {
    return "another end";
  }
  const std::size_t from = next + middle.size();
  const std::string document = page.substr(from, page.size() - tail.size() - from);
  for (const std::string& part : {page.substr(head.size(), next - head.size()), document}) {
    const std::size_t bad = part.find_first_of("<>");
    if (bad != std::string::npos) return "not escaped: " + part.substr(bad, 20);
  }
  if (document.find('&') != std::string::npos) return "& in the document";
  const Json json = Json::parse(document, nullptr, false);
  if (json.is_discarded()) return "the document cannot be read";
  return json.value("schema", "") == "dynid.report/1" ? "" : "another schema";
}

}  // namespace dyngen::test
