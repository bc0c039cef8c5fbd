// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/mjcf/mjcf_defaults.h"

#include <fmt/format.h>

namespace dyngen {

MjcfDefaults::MjcfDefaults(const XmlElement& root, XmlValues& values) {
  bool first = true;
  for (const XmlElement& child : root.children) {
    if (child.name != "default") continue;
    const XmlAttribute* name = child.attribute("class");
    if (first && name != nullptr) main_ = name->value;
    const std::string own = name != nullptr ? name->value : main_;
    // several <default> elements at the top go on with the same class
    read(child, own, classes_[own], values);
    first = false;
  }
  classes_[main_];
}

void MjcfDefaults::read(const XmlElement& element, const std::string& name, const Class& around,
                        XmlValues& values) {
  Class own = around;
  for (const XmlElement& child : element.children) {
    if (child.name != "default") own[child.name].take(child);
  }
  classes_[name] = own;
  for (const XmlElement& child : element.children) {
    if (child.name != "default") continue;
    const XmlAttribute* nested = values.required(child, "class", "a nested <default>");
    if (nested == nullptr) continue;
    if (classes_.contains(nested->value)) {
      values.error(*nested,
                   fmt::format("default class '{}' stands twice", printable(nested->value)),
                   "each class has a name of its own");
      continue;
    }
    read(child, nested->value, own, values);
  }
}

MjcfAttributes MjcfDefaults::of(const XmlElement& element, std::string_view kind,
                                const std::string& given, XmlValues& values) const {
  const XmlAttribute* asked = element.attribute("class");
  const std::string& name = asked != nullptr ? asked->value : given.empty() ? main_ : given;
  const auto found = classes_.find(name);
  MjcfAttributes result;
  if (found != classes_.end()) {
    const auto own = found->second.find(kind);
    if (own != found->second.end()) result = own->second;
  } else if (asked != nullptr) {
    values.error(*asked, fmt::format("default class '{}' does not exist", printable(name)),
                 "expected the class of a <default>");
  }
  result.take(element);
  return result;
}

}  // namespace dyngen
