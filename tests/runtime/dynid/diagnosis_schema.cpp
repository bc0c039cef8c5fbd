// SPDX-License-Identifier: MIT
#include "tests/runtime/dynid/diagnosis_schema.h"

#include <cctype>
#include <cstring>
#include <functional>
#include <map>
#include <set>

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

Check object(std::map<std::string, Check> keys) {
  return [keys](const Json& value, const std::string& place, Faults& faults) {
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
      if (!keys.contains(item.key())) faults.push_back(place + "/" + item.key() + ": unknown");
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
       {"where", where},
       {"formula", text},
       {"parameters", table_of(parameter)},
       {"evidence", object({{"lambda", number}, {"delta_bic", number}, {"heldout_gain", number}})},
       {"why", text}});
  return object(
      {{"schema", one_of({"dynid.diagnosis/1"})},
       {"robot", text},
       {"joints", joint},
       {"verdict", one_of({"clean", "explained", "unexplained_structure", "insufficient_data"})},
       {"findings", array_of(finding)},
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
       {"next_experiment", object({{"purpose", kind("s0")}, {"trajectory", kind("s0")}})}});
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

std::string markup_fault(const std::string& page) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < page.size(); ++i) {
    if (page[i] == '&') {
      const std::size_t end = page.find(';', i);
      bool entity = end != std::string::npos && end - i <= 6 && end - i >= 2;
      for (std::size_t k = i + 1; entity && k < end; ++k) {
        entity = std::isalnum(static_cast<unsigned char>(page[k])) != 0 || page[k] == '#';
      }
      if (!entity) return "a bare & at " + page.substr(i, 20);
    }
    if (page[i] == '>') return "a bare > at " + page.substr(i, 20);
    if (page[i] != '<') continue;
    const std::size_t end = page.find('>', i);
    if (end == std::string::npos) return "a bare < at " + page.substr(i, 20);
    const std::string tag = page.substr(i + 1, end - i - 1);
    i = end;
    if (tag.empty() || tag.find('<') != std::string::npos) return "a bare < before " + tag;
    if (tag[0] == '!' || tag.back() == '/') continue;
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return tag + " closes nothing";
      open.pop_back();
      continue;
    }
    if (std::isalpha(static_cast<unsigned char>(tag[0])) == 0) return "no element: " + tag;
    open.push_back(tag.substr(0, tag.find(' ')));
    if (open.back() == "style") i = page.find("</style>", i) - 1;
  }
  return open.empty() ? "" : open.back() + " is not closed";
}

}  // namespace dyngen::test
