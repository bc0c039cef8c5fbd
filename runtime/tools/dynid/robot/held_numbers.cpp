// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/held_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "gen/diagnostic/diagnostic.h"

namespace dyngen::runtime {
namespace {

/// The row of the file in which a parameter stands, in the order of chi.h.
constexpr std::array<RowKey, kChiCount> kRowsOfChi = {
    RowKey::kXX, RowKey::kXY, RowKey::kXZ, RowKey::kYY, RowKey::kYZ, RowKey::kZZ, RowKey::kMX,
    RowKey::kMY, RowKey::kMZ, RowKey::kM,  RowKey::kIA, RowKey::kFv, RowKey::kFs, RowKey::kOff};

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

class HoldReader {
 public:
  explicit HoldReader(const RobotModel& model)
      : model_(model), places_(kChiCount * static_cast<std::size_t>(model.size()), false) {}

  void read(const std::string& word) {
    const std::size_t equals = word.find('=');
    const std::string key = lower_letters(word.substr(0, equals));
    if (key == "all" && equals == std::string::npos) {
      hold(word, [](int, std::size_t) { return true; });
      return;
    }
    if (equals == std::string::npos || equals + 1 == word.size()) throw unknown(word);
    for (const std::string& item : items(word.substr(equals + 1))) {
      const std::string whole = key + "=" + item;
      if (key == "links") {
        const int link = link_of(whole, item);
        hold(whole, [&](int j, std::size_t k) { return j == link && k < kInertialCount; });
      } else if (key == "joints") {
        const int joint = link_of(whole, item);
        hold(whole, [&](int j, std::size_t k) { return j == joint && k >= kInertialCount; });
      } else if (key == "rows") {
        const std::size_t row = row_of(whole, item);
        hold(whole, [&](int, std::size_t k) { return k == row; });
      } else if (key == "numbers") {
        const std::size_t digits = item.find_last_not_of("0123456789") + 1;
        const std::size_t row = row_of(whole, item.substr(0, digits));
        const int link = link_of(whole, item.substr(digits));
        hold(whole, [&](int j, std::size_t k) { return j == link && k == row; });
      } else {
        throw unknown(word);
      }
    }
  }

  [[nodiscard]] HeldNumbers result() const {
    HeldNumbers held{places_, {}};
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (places_[i]) {
        held.names.push_back(number_name(i % kChiCount, static_cast<int>(i / kChiCount) + 1));
      }
    }
    return held;
  }

 private:
  static std::vector<std::string> items(const std::string& list) {
    std::vector<std::string> result;
    for (std::size_t from = 0; from <= list.size();) {
      const std::size_t comma = std::min(list.find(',', from), list.size());
      result.push_back(list.substr(from, comma - from));
      from = comma + 1;
    }
    return result;
  }

  [[nodiscard]] ModelError error(const std::string& text) const {
    return ModelError(fmt::format("{}: error: --hold {}\n", model_.file_name, text));
  }
  [[nodiscard]] ModelError unknown(const std::string& word) const {
    return error(fmt::format("{}: expected {}", word, kHoldForms));
  }

  /// A link by its number, or by the name of its joint.
  [[nodiscard]] int link_of(const std::string& word, const std::string& item) const {
    std::string names;
    for (int j = 1; j <= model_.size(); ++j) {
      const std::string& name = model_.joint(j).name;
      if (item == std::to_string(j) || item == name) return j;
      names += (j == 1 ? "" : ", ") + name;
    }
    throw error(fmt::format("{}: there is no link '{}': expected 1 to {}, or one of {}", word, item,
                            model_.size(), names));
  }

  [[nodiscard]] std::size_t row_of(const std::string& word, const std::string& item) const {
    std::string names;
    for (std::size_t k = 0; k < kChiCount; ++k) {
      const std::string name(row_keyword(kRowsOfChi[k]));
      if (lower_letters(item) == lower_letters(name)) return k;
      names += (k == 0 ? "" : " ") + name;
    }
    throw error(fmt::format("{}: there is no row '{}': expected one of {}", word, item, names));
  }

  template <typename Named>
  void hold(const std::string& word, const Named& named) {
    bool any = false;
    for (int j = 1; j <= model_.size(); ++j) {
      for (std::size_t k = 0; k < kChiCount; ++k) {
        if (!named(j, k)) continue;
        const Quantity& quantity = model_.joint(j).chi[k];
        // a zero is known without being held
        any = any || (quantity.line != 0 && !quantity.unknown);
        if (has_number(quantity)) places_[kChiCount * static_cast<std::size_t>(j - 1) + k] = true;
      }
    }
    if (any) return;
    throw error(
        fmt::format("{}: the file has no number there to hold: '*' and absent rows are "
                    "estimated. It has {}",
                    word, numbers_of_file()));
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
  std::vector<bool> places_;
};

}  // namespace

HeldNumbers held_numbers(const RobotModel& model, const std::vector<std::string>& words) {
  if (words.empty()) return {};
  HoldReader reader(model);
  for (const std::string& word : words) reader.read(word);
  return reader.result();
}

}  // namespace dyngen::runtime
