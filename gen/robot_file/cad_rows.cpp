// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/cad_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gen/robot_file/exact_number.h"
#include "gen/robot_file/keywords.h"

namespace dyngen {

namespace {

constexpr std::array<RowKey, 3> kFirstRows = {RowKey::kMX, RowKey::kMY, RowKey::kMZ};
constexpr std::array<RowKey, 3> kCentreRows = {RowKey::kCX, RowKey::kCY, RowKey::kCZ};
constexpr std::array<RowKey, 6> kOriginRows = {RowKey::kXX, RowKey::kXY, RowKey::kXZ,
                                               RowKey::kYY, RowKey::kYZ, RowKey::kZZ};
constexpr std::array<RowKey, 6> kCentralRows = {RowKey::kIXX, RowKey::kIXY, RowKey::kIXZ,
                                                RowKey::kIYY, RowKey::kIYZ, RowKey::kIZZ};
constexpr std::array<RowKey, 3> kTurnRows = {RowKey::kIrX, RowKey::kIrY, RowKey::kIrZ};
/// Row and column of the tensor's elements, in the order of the rows above.
constexpr std::array<std::pair<std::size_t, std::size_t>, 6> kElements = {
    {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};

/// A number, or none where it is unknown.
using CadNumber = std::optional<ExactNumber>;
using CadTensor = std::array<std::array<CadNumber, 3>, 3>;

bool is_exact_zero(const CadNumber& x) { return x && x->is_zero(); }

CadNumber cad_product(const CadNumber& a, const CadNumber& b) {
  if (is_exact_zero(a) || is_exact_zero(b)) return ExactNumber();
  if (!a || !b) return std::nullopt;
  return *a * *b;
}
CadNumber cad_sum(const CadNumber& a, const CadNumber& b) {
  if (!a || !b) return std::nullopt;
  return *a + *b;
}

class CadResolver {
 public:
  CadResolver(RobotFile& file, Diagnostics& diagnostics)
      : file_(file), written_(file.rows), diagnostics_(diagnostics) {}

  void run() {
    const auto links = static_cast<std::size_t>(file_.joint_count);
    if (!any_of_cad() && !any_dash()) return;
    if (wrong_sizes(links)) return;  // which is reported
    if (file_.parameters == ParameterMeaning::kBase && any_of_cad()) {
      diagnostics_.error(first_cad_row().keyword, 3,
                         "base parameters have no centre of mass: they are sums over bodies",
                         "write mX .. ZZ, or take the row 'parameters base' out");
      return;
    }
    for (std::size_t link = 0; link < links; ++link) resolve_link(link);
    for (std::size_t key = 0; key < kRowKeyCount; ++key) {
      if (is_cad_row(static_cast<RowKey>(key))) file_.rows[key] = {};
    }
  }

 private:
  Row& row(RowKey key) { return file_.rows[static_cast<std::size_t>(key)]; }

  bool any_of_cad() {
    for (std::size_t key = 0; key < kRowKeyCount; ++key) {
      if (is_cad_row(static_cast<RowKey>(key)) && file_.rows[key].present) return true;
    }
    return false;
  }
  const Row& first_cad_row() {
    for (std::size_t key = 0; key < kRowKeyCount; ++key) {
      if (is_cad_row(static_cast<RowKey>(key)) && file_.rows[key].present) return file_.rows[key];
    }
    return file_.rows[0];
  }
  static bool is_dash(const FieldValue& value) { return value.unknown && value.text == "-"; }
  bool any_dash() {
    for (std::size_t key = 0; key < kRowKeyCount; ++key) {
      if (!has_other_form(static_cast<RowKey>(key))) continue;
      const std::vector<FieldValue>& values = file_.rows[key].values;
      if (std::any_of(values.begin(), values.end(), is_dash)) return true;
    }
    return false;
  }
  bool wrong_sizes(std::size_t links) {
    for (std::size_t key = 0; key < kRowKeyCount; ++key) {
      const Row& own = file_.rows[key];
      if (own.present && own.values.size() != links && !is_scalar(static_cast<RowKey>(key))) {
        return true;
      }
    }
    return links == 0;
  }

  /// What the row says of a link; null if it is absent.
  const FieldValue* field(RowKey key, std::size_t link) {
    const Row& own = written_[static_cast<std::size_t>(key)];
    return own.present ? &own.values[link] : nullptr;
  }
  /// Null if it is absent or '-'.
  const FieldValue* given(RowKey key, std::size_t link) {
    const FieldValue* own = field(key, link);
    return own == nullptr || is_dash(*own) ? nullptr : own;
  }
  CadNumber known(const FieldValue* value) {
    if (value == nullptr) return ExactNumber();  // an absent row is zero
    if (value->unknown) return std::nullopt;
    return ExactNumber::from_exact(value->value);
  }
  template <std::size_t N>
  const FieldValue* first_given(const std::array<RowKey, N>& keys, std::size_t link) {
    for (const RowKey key : keys) {
      if (const FieldValue* own = given(key, link)) return own;
    }
    return nullptr;
  }
  template <std::size_t N>
  const FieldValue* first_dash(const std::array<RowKey, N>& keys, std::size_t link) {
    for (const RowKey key : keys) {
      const FieldValue* own = field(key, link);
      if (own != nullptr && is_dash(*own)) return own;
    }
    return nullptr;
  }
  void error(const FieldValue& value, const std::string& message, const std::string& hint) {
    diagnostics_.error(value.position, value.length, message, hint);
  }

  /// Whether a link has the CAD form of a group of rows; none if what it has is wrong.
  template <std::size_t N, std::size_t M>
  std::optional<bool> has_cad_form(const std::array<RowKey, N>& cad,
                                   const std::array<RowKey, M>& plain, std::size_t link) {
    const FieldValue* own = first_given(cad, link);
    const FieldValue* other = first_given(plain, link);
    const std::string cad_names = fmt::format("{} ..", row_keyword(cad[0]));
    const std::string plain_names = fmt::format("{} ..", row_keyword(plain[0]));
    if (own != nullptr && other != nullptr) {
      error(*own, fmt::format("link {} has {} and {}", link + 1, cad_names, plain_names),
            "a link has one of both: write - in the rows of the other");
      return std::nullopt;
    }
    const FieldValue* dash = first_dash(cad, link);
    if (dash == nullptr) dash = first_dash(plain, link);
    if (dash != nullptr && own == nullptr && other == nullptr) {
      error(*dash,
            fmt::format("link {} has '-' and no number in {} or {}", link + 1, cad_names,
                        plain_names),
            "expected numbers in one of both");
      return std::nullopt;
    }
    for (const RowKey key : cad) {
      const FieldValue* hole = field(key, link);
      if (own == nullptr || hole == nullptr || !is_dash(*hole)) continue;
      error(*hole,
            fmt::format("'-' in '{}' of link {}, which has others of {}", row_keyword(key),
                        link + 1, cad_names),
            "expected a number, 0 or *");
      return std::nullopt;
    }
    for (const RowKey key : plain) {
      const FieldValue* hole = field(key, link);
      if (other == nullptr || hole == nullptr || !is_dash(*hole)) continue;
      error(*hole,
            fmt::format("'-' in '{}' of link {}, which has others of {}", row_keyword(key),
                        link + 1, plain_names),
            "expected a number, 0 or *");
      return std::nullopt;
    }
    return own != nullptr;
  }

  void put(RowKey key, std::size_t link, const CadNumber& value, const FieldValue& origin,
           const Row& origin_row) {
    Row& own = row(key);
    if (!own.present) {
      own.present = true;
      own.keyword = origin_row.keyword;
      FieldValue zero;
      zero.position = origin.position;
      zero.text = "0";
      own.values.assign(static_cast<std::size_t>(file_.joint_count), zero);
    }
    FieldValue& field = own.values[link];
    field.position = origin.position;
    field.length = origin.length;
    field.unknown = !value.has_value();
    field.value = value ? value->exact() : GiNaC::ex(0);
    field.text =
        !value
            ? "*"
            : fmt::format("{:.6g}", GiNaC::ex_to<GiNaC::numeric>(field.value.evalf()).to_double());
  }

  void resolve_link(std::size_t link) {
    const std::optional<bool> centre = has_cad_form(kCentreRows, kFirstRows, link);
    const std::optional<bool> central = has_cad_form(kCentralRows, kOriginRows, link);
    if (!centre || !central) return;
    for (const RowKey key : kTurnRows) {
      const FieldValue* turn = given(key, link);
      if (turn == nullptr || *central || turn->unknown || turn->value.is_zero()) continue;
      error(*turn, fmt::format("link {} has irX .. and no IXX ..", link + 1),
            "irX irY irZ turn the axes of IXX IXY IXZ IYY IYZ IZZ");
      return;
    }
    try {
      resolve_numbers(link, *centre, *central);
    } catch (const ArithmeticError& wrong) {
      const FieldValue* where = first_given(kCentralRows, link);
      if (where == nullptr) where = first_given(kCentreRows, link);
      error(*where, fmt::format("the numbers of link {}: {}", link + 1, wrong.what()),
            wrong.hint());
    }
  }

  void resolve_numbers(std::size_t link, bool centre, bool central) {
    const FieldValue* mass_field = field(RowKey::kM, link);
    if (centre && mass_field == nullptr) {
      error(*first_given(kCentreRows, link), "a centre of mass needs a mass",
            "write a row m, with * for what is not known");
      return;
    }
    const CadNumber mass = known(mass_field);
    std::array<CadNumber, 3> c, first;
    if (central && !centre && first_given(kFirstRows, link) == nullptr) {
      error(*first_given(kCentralRows, link),
            fmt::format("IXX .. of link {} are about its centre of mass, which is not given",
                        link + 1),
            "write cX cY cZ, 0 where it is the frame's origin");
      return;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (centre) {
        c[k] = known(given(kCentreRows[k], link));
        first[k] = cad_product(mass, c[k]);
      } else {
        first[k] = known(given(kFirstRows[k], link));
      }
    }
    if (centre) {
      for (std::size_t k = 0; k < 3; ++k) {
        const FieldValue* origin = given(kCentreRows[k], link);
        const RowKey from = origin == nullptr ? kCentreRows[0] : kCentreRows[k];
        if (origin == nullptr) origin = first_given(kCentreRows, link);
        put(kFirstRows[k], link, first[k], *origin, row(from));
      }
    }
    if (central) resolve_tensor(link, mass, first);
  }

  /// m (c.c 1 - c c^T) by first moments s = m c, so that it holds for links without mass too.
  static CadNumber of_centre(std::size_t i, std::size_t k, const CadNumber& mass,
                             const std::array<CadNumber, 3>& first) {
    const auto over_mass = [&](const CadNumber& a, const CadNumber& b) -> CadNumber {
      const CadNumber both = cad_product(a, b);
      if (is_exact_zero(both)) return ExactNumber();
      if (!both || !mass) return std::nullopt;
      return *both / *mass;
    };
    if (i != k) {
      const CadNumber own = over_mass(first[i], first[k]);
      return own ? CadNumber(-*own) : std::nullopt;
    }
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    return cad_sum(over_mass(first[a], first[a]), over_mass(first[b], first[b]));
  }

  void resolve_tensor(std::size_t link, const CadNumber& mass,
                      const std::array<CadNumber, 3>& first) {
    CadTensor tensor;
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, k] = kElements[e];
      tensor[i][k] = tensor[k][i] = known(given(kCentralRows[e], link));
    }
    std::array<ExactNumber, 3> angles;
    bool turned = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const FieldValue* angle = given(kTurnRows[k], link);
      if (angle == nullptr || angle->unknown) continue;
      angles[k] = ExactNumber::from_exact(angle->value);
      turned = turned || !angles[k].is_zero();
    }
    if (turned) tensor = turned_tensor(tensor, angles);
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, k] = kElements[e];
      const FieldValue* origin = given(kCentralRows[e], link);
      const RowKey from = origin == nullptr ? kCentralRows[0] : kCentralRows[e];
      if (origin == nullptr) origin = first_given(kCentralRows, link);
      put(kOriginRows[e], link, cad_sum(tensor[i][k], of_centre(i, k, mass, first)), *origin,
          row(from));
    }
  }

  /// R J R^T, one axis after the other: x, y, z.
  static CadTensor turned_tensor(CadTensor tensor, const std::array<ExactNumber, 3>& angles) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (angles[axis].is_zero()) continue;
      const ExactNumber s = sine(angles[axis]), c = cosine(angles[axis]);
      std::array<std::array<CadNumber, 3>, 3> R;
      const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
      for (auto& line : R) line.fill(ExactNumber());
      R[axis][axis] = ExactNumber::from_decimal("1");
      R[a][a] = R[b][b] = c;
      R[a][b] = -s;
      R[b][a] = s;
      CadTensor half, whole;
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          half[i][k] = ExactNumber();
          for (std::size_t n = 0; n < 3; ++n) {
            half[i][k] = cad_sum(half[i][k], cad_product(R[i][n], tensor[n][k]));
          }
        }
      }
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          whole[i][k] = ExactNumber();
          for (std::size_t n = 0; n < 3; ++n) {
            whole[i][k] = cad_sum(whole[i][k], cad_product(half[i][n], R[k][n]));
          }
        }
      }
      for (std::size_t i = 0; i < 3; ++i) {  // the same expression for both
        for (std::size_t k = 0; k < i; ++k) whole[i][k] = whole[k][i];
      }
      tensor = whole;
    }
    return tensor;
  }

  RobotFile& file_;
  const std::array<Row, kRowKeyCount> written_;  // as the file has them
  Diagnostics& diagnostics_;
};

}  // namespace

void resolve_cad_rows(RobotFile& file, Diagnostics& diagnostics) {
  CadResolver(file, diagnostics).run();
}

}  // namespace dyngen
