// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/held_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "gen/diagnostic/diagnostic.h"
#include "gen/symbols/exact.h"

namespace dyngen::runtime {
namespace {

/// The row of the file in which a parameter stands, in the order of chi.h.
constexpr std::array<RowKey, kChiCount> kRowsOfChi = {
    RowKey::kXX, RowKey::kXY, RowKey::kXZ, RowKey::kYY, RowKey::kYZ, RowKey::kZZ, RowKey::kMX,
    RowKey::kMY, RowKey::kMZ, RowKey::kM,  RowKey::kIA, RowKey::kFv, RowKey::kFs, RowKey::kOff};

/// What the items of a list name.
enum class HoldKey { kAny, kLinks, kJoints, kRows, kNumbers };

std::string lower_letters(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// "MX1": as the file's row and the number of the link.
std::string number_name(std::size_t kind, int link) {
  return std::string(row_keyword(kRowsOfChi[kind])) + std::to_string(link);
}

bool has_number(const Quantity& quantity) {
  return quantity.line != 0 && !quantity.unknown && !quantity.value.is_zero();
}

std::optional<HoldKey> hold_key(std::string_view text) {
  const std::string key = lower_letters(text);
  if (key == "link" || key == "links") return HoldKey::kLinks;
  if (key == "joint" || key == "joints") return HoldKey::kJoints;
  if (key == "row" || key == "rows") return HoldKey::kRows;
  for (const char* name : {"number", "numbers", "parameter", "parameters"}) {
    if (key == name) return HoldKey::kNumbers;
  }
  return std::nullopt;
}

std::size_t row_named(std::string_view text) {
  for (std::size_t k = 0; k < kChiCount; ++k) {
    if (lower_letters(text) == lower_letters(row_keyword(kRowsOfChi[k]))) return k;
  }
  return kChiCount;
}

/// Where the digits at the end of a text begin.
std::size_t digits_of(std::string_view text) {
  return text.find_last_not_of("0123456789") + 1;  // npos + 1 is 0
}

std::vector<std::string> items_of(const std::string& list) {
  std::vector<std::string> result;
  for (std::size_t from = 0; from <= list.size();) {
    const std::size_t comma = std::min(list.find_first_of(", ", from), list.size());
    if (comma > from) result.push_back(list.substr(from, comma - from));
    from = comma + 1;
  }
  return result;
}

/// A standard deviation behind an item.
struct HoldDeviation {
  double value = 0;
  bool relative = false;

  [[nodiscard]] double of(double number) const {
    return relative ? value * std::abs(number) : value;
  }
};

class HoldReader {
 public:
  explicit HoldReader(const RobotModel& model) : model_(model) {
    const std::size_t count = kChiCount * static_cast<std::size_t>(model.size());
    held_.places.assign(count, false);
    held_.deviations = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
  }

  /// @param word  "links=1,2" or "MX1,m2": a key goes on until the next one
  void read(const std::string& word) {
    word_ = word;
    HoldKey key = HoldKey::kAny;
    const std::vector<std::string> items = items_of(word);
    if (items.empty()) throw unknown();
    for (const std::string& whole : items) {
      std::string item = whole;
      deviation_ = {};
      const std::size_t sign = std::min(item.find("+-"), item.find("±"));
      if (sign != std::string::npos) {
        deviation_ = deviation_of(item.substr(sign + 2));  // both are of two bytes
        item.resize(sign);
      }
      const std::size_t equals = item.find_first_of("=:");
      if (equals != std::string::npos) {
        const auto named = hold_key(item.substr(0, equals));
        if (!named || equals + 1 == item.size()) throw unknown();
        key = *named;
        item.erase(0, equals + 1);
      }
      hold_item(key, item);
    }
  }

  [[nodiscard]] HeldNumbers result() {
    for (std::size_t i = 0; i < held_.places.size(); ++i) {
      if (!held_.places[i]) continue;
      held_.names.push_back(number_name(i % kChiCount, static_cast<int>(i / kChiCount) + 1));
    }
    if (held_.deviations.isZero(0)) held_.deviations.resize(0);
    if (!held_.any() && !zeros_) {
      throw error(
          fmt::format("{}: the file has no number there to hold: '*' and absent rows are "
                      "estimated. It has {}",
                      word_, numbers_of_file()));
    }
    return std::move(held_);
  }

 private:
  [[nodiscard]] ModelError error(const std::string& text) const {
    return ModelError(fmt::format("{}: error: --hold {}\n", model_.file_name, text));
  }
  [[nodiscard]] ModelError unknown() const {
    return error(fmt::format("{}: expected {}", word_, kHoldForms));
  }

  [[nodiscard]] HoldDeviation deviation_of(std::string text) const {
    HoldDeviation deviation;
    deviation.relative = !text.empty() && text.back() == '%';
    if (deviation.relative) text.pop_back();
    const auto [end, fault] =
        std::from_chars(text.data(), text.data() + text.size(), deviation.value);
    if (fault != std::errc() || end != text.data() + text.size() || !(deviation.value >= 0) ||
        !std::isfinite(deviation.value)) {
      throw error(fmt::format(
          "{}: expected a standard deviation behind +-, as in MX1+-0.05 or links=1+-5%", word_));
    }
    if (deviation.relative) deviation.value /= 100;
    return deviation;
  }

  void hold_item(HoldKey key, const std::string& item) {
    switch (key) {
      case HoldKey::kLinks:
        return hold_links(item, true);
      case HoldKey::kJoints:
        return hold_links(item, false);
      case HoldKey::kRows:
        return hold_row(item);
      case HoldKey::kNumbers:
        return hold_number(item);
      case HoldKey::kAny:
        break;
    }
    // without a key: what the item itself says
    const std::size_t digits = digits_of(item);
    const std::string letters = item.substr(0, digits);
    if (lower_letters(item) == "all") {
      hold(item, [](int, std::size_t) { return true; });
    } else if (const auto kind = hold_key(letters)) {
      const bool whole = digits == item.size();  // "links": all of them
      if (whole && *kind == HoldKey::kLinks) {
        hold(item, [](int, std::size_t k) { return k < kInertialCount; });
      } else if (whole) {
        hold(item, [](int, std::size_t) { return true; });
      } else if (*kind == HoldKey::kLinks || *kind == HoldKey::kJoints) {
        hold_links(item.substr(digits), *kind == HoldKey::kLinks);
      } else {
        throw unknown();
      }
    } else if (row_named(item) < kChiCount) {
      hold_row(item);
    } else if (digits < item.size() && row_named(letters) < kChiCount) {
      hold_number(item);
    } else if (place_of_name(item) > 0 || digits == 0) {
      hold_links(item, false);
    } else {
      throw error(
          fmt::format("{}: there is no '{}': expected {}. Base parameters are sums: name the rows "
                      "of the file that stand in them",
                      word_, item, kHoldForms));
    }
  }

  /// "2", "1-3" or the name of a joint.
  void hold_links(const std::string& item, bool inertial_only) {
    int first = place_of_name(item), last = first;
    const std::size_t dash = item.find('-');
    if (first == 0 && dash != std::string::npos) {
      first = place_of_name(item.substr(0, dash));
      last = place_of_name(item.substr(dash + 1));
    }
    if (first == 0 || last == 0 || first > last) throw no_link(item);
    for (int link = first; link <= last; ++link) {
      hold(fmt::format("{} {}", inertial_only ? "link" : "joint", link), [&](int j, std::size_t k) {
        return j == link && (!inertial_only || k < kInertialCount);
      });
    }
  }

  void hold_row(const std::string& item) {
    const std::size_t row = row_named(item);
    if (row == kChiCount) throw no_row(item);
    hold(fmt::format("row {}", item), [&](int, std::size_t k) { return k == row; });
  }

  void hold_number(const std::string& item) {
    const std::size_t digits = digits_of(item), row = row_named(item.substr(0, digits));
    if (row == kChiCount) throw no_row(item.substr(0, digits));
    const int link = place_of_name(item.substr(digits));
    if (link == 0) throw no_link(item.substr(digits));
    hold(item, [&](int j, std::size_t k) { return j == link && k == row; });
  }

  /// A link by its number, or by the name of its joint; 0: there is none.
  [[nodiscard]] int place_of_name(const std::string& item) const {
    for (int j = 1; j <= model_.size(); ++j) {
      if (item == std::to_string(j) || item == model_.joint(j).name) return j;
    }
    return 0;
  }

  [[nodiscard]] ModelError no_link(const std::string& item) const {
    std::string names;
    for (int j = 1; j <= model_.size(); ++j) {
      names += (j == 1 ? "" : ", ") + model_.joint(j).name;
    }
    return error(fmt::format("{}: there is no link or joint '{}': expected 1 to {}, or one of {}",
                             word_, item, model_.size(), names));
  }

  [[nodiscard]] ModelError no_row(const std::string& item) const {
    std::string names;
    for (std::size_t k = 0; k < kChiCount; ++k) {
      names += (k == 0 ? "" : " ") + std::string(row_keyword(kRowsOfChi[k]));
    }
    return error(fmt::format("{}: there is no row '{}': expected one of {}", word_, item, names));
  }

  template <typename Named>
  void hold(const std::string& what, const Named& named) {
    bool any = false;
    for (int j = 1; j <= model_.size(); ++j) {
      for (std::size_t k = 0; k < kChiCount; ++k) {
        if (!named(j, k)) continue;
        const Quantity& quantity = model_.joint(j).chi[k];
        // a zero is known without being held
        any = any || (quantity.line != 0 && !quantity.unknown);
        if (!has_number(quantity)) continue;
        const std::size_t place = kChiCount * static_cast<std::size_t>(j - 1) + k;
        held_.places[place] = true;
        if (deviation_.value > 0) {
          held_.deviations[static_cast<Eigen::Index>(place)] =
              deviation_.of(to_double(quantity.value));
        }
      }
    }
    zeros_ = zeros_ || any;
    if (any) return;
    held_.notes.push_back(
        fmt::format("--hold {}: the file has no number there, so that it is estimated", what));
  }

  [[nodiscard]] std::string numbers_of_file() const {
    constexpr std::size_t kMost = 12;
    std::vector<std::string> names;
    for (int j = 1; j <= model_.size(); ++j) {
      for (std::size_t k = 0; k < kChiCount; ++k) {
        if (has_number(model_.joint(j).chi[k])) names.push_back(number_name(k, j));
      }
    }
    if (names.empty()) return "none at all";
    const std::size_t more = names.size() > kMost ? names.size() - kMost : 0;
    names.resize(names.size() - more);
    return fmt::format("{}{}", fmt::join(names, " "),
                       more > 0 ? fmt::format(" and {} more", more) : "");
  }

  const RobotModel& model_;
  std::string word_;
  HoldDeviation deviation_;
  HeldNumbers held_;
  bool zeros_ = false;  ///< what was named is known, be it zero
};

}  // namespace

HeldNumbers held_numbers(const RobotModel& model, const std::vector<std::string>& words) {
  if (words.empty()) return {};
  HoldReader reader(model);
  for (const std::string& word : words) reader.read(word);
  return reader.result();
}

}  // namespace dyngen::runtime
