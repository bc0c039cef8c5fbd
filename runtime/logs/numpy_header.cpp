// SPDX-License-Identifier: MIT
#include "runtime/logs/numpy_header.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "runtime/logs/log_error.h"
#include "runtime/logs/time_words.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kDeepestValue = 16;
constexpr std::size_t kMostHeaderBytes = 1 << 20;
constexpr std::size_t kMostElementBytes = 1 << 24;

/// A value of Python as far as headers have it.
struct PythonValue {
  enum class Kind { kText, kNumber, kTruth, kSequence, kPairs } kind = Kind::kText;
  std::string text;
  std::size_t number = 0;
  bool truth = false;
  std::vector<PythonValue> items;  ///< of pairs: key, value, key, value, ...
};

class PythonReader {
 public:
  explicit PythonReader(std::string_view text) : text_(text) {}

  PythonValue read(std::size_t depth = 0) {
    if (depth > kDeepestValue) fail("values nested less deeply");
    skip_blanks();
    switch (next()) {
      case '\'':
      case '"':
        return read_text();
      case '(':
        return read_items(')', PythonValue::Kind::kSequence, depth);
      case '[':
        return read_items(']', PythonValue::Kind::kSequence, depth);
      case '{':
        return read_items('}', PythonValue::Kind::kPairs, depth);
      default:
        return read_word();
    }
  }

 private:
  [[nodiscard]] char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_blanks() {
    while (next() == ' ' || next() == '\n' || next() == '\t') ++at_;
  }
  [[noreturn]] void fail(std::string_view expected) const {
    throw std::runtime_error(fmt::format("found {} in the header of an array, expected {}",
                                         in_quotes(text_.substr(std::min(at_, text_.size()))),
                                         expected));
  }

  PythonValue read_text() {
    const char quote = next();
    PythonValue value;
    for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_) {
      if (text_[at_] == '\\') ++at_;
      if (at_ < text_.size()) value.text += text_[at_];
    }
    if (at_ >= text_.size()) fail("the end of a text");
    ++at_;
    return value;
  }

  PythonValue read_items(char close, PythonValue::Kind kind, std::size_t depth) {
    PythonValue value;
    value.kind = kind;
    ++at_;
    for (;;) {
      skip_blanks();
      if (next() == close) break;
      value.items.push_back(read(depth + 1));
      skip_blanks();
      const bool key = kind == PythonValue::Kind::kPairs && value.items.size() % 2 == 1;
      if (key) {
        if (next() != ':') fail("':'");
        ++at_;
      } else if (next() == ',') {
        ++at_;
      } else if (next() != close) {
        fail("',' or the end of a list");
      }
    }
    ++at_;
    return value;
  }

  PythonValue read_word() {
    PythonValue value;
    if (text_.substr(at_).starts_with("True") || text_.substr(at_).starts_with("False")) {
      value.kind = PythonValue::Kind::kTruth;
      value.truth = next() == 'T';
      at_ += value.truth ? 4 : 5;
      return value;
    }
    value.kind = PythonValue::Kind::kNumber;
    const char* begin = text_.data() + at_;
    const auto [stop, error] = std::from_chars(begin, text_.data() + text_.size(), value.number);
    if (error != std::errc()) fail("a whole number, a text, True or False");
    at_ += static_cast<std::size_t>(stop - begin);
    if (next() == 'L') ++at_;  // of Python 2
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

std::size_t product(const std::vector<std::size_t>& sizes, std::size_t most) {
  std::size_t all = 1;
  for (const std::size_t size : sizes) {
    if (size != 0 && all > most / size) {
      throw std::runtime_error(fmt::format("found an array of more than {} elements", most));
    }
    all *= size;
  }
  return all;
}

std::vector<std::size_t> sizes_of(const PythonValue& value) {
  std::vector<std::size_t> sizes;
  if (value.kind == PythonValue::Kind::kNumber) return {value.number};
  if (value.kind != PythonValue::Kind::kSequence) {
    throw std::runtime_error("found a header without the shape of its array");
  }
  for (const PythonValue& item : value.items) {
    if (item.kind != PythonValue::Kind::kNumber) {
      throw std::runtime_error("found a shape that is no list of whole numbers");
    }
    sizes.push_back(item.number);
  }
  return sizes;
}

class TypeReader {
 public:
  explicit TypeReader(NumpyHeader& header) : header_(&header) {}

  /// Adds the fields of a type at an offset. @return  its bytes
  std::size_t add(const PythonValue& type, const std::string& name, std::size_t offset,
                  std::size_t count) {
    if (type.kind == PythonValue::Kind::kText) return add_plain(type.text, name, offset, count);
    if (type.kind != PythonValue::Kind::kSequence) {
      throw std::runtime_error("found a type of elements that is neither a text nor a list");
    }
    if (count != 1) {
      throw std::runtime_error(
          fmt::format("found {}, an array of structures, expected numbers", in_quotes(name)));
    }
    std::size_t bytes = 0;
    for (const PythonValue& member : type.items) {
      if (member.kind != PythonValue::Kind::kSequence || member.items.size() < 2) {
        throw std::runtime_error("found a member of a structure without name and type");
      }
      // ("title", "name") may stand for a name
      const PythonValue& named = member.items[0];
      const std::string own = named.kind == PythonValue::Kind::kSequence && named.items.size() == 2
                                  ? named.items[1].text
                                  : named.text;
      const std::size_t elements =
          member.items.size() > 2 ? product(sizes_of(member.items[2]), kMostElementBytes) : 1;
      bytes +=
          add(member.items[1], name.empty() ? own : name + "." + own, offset + bytes, elements);
      if (bytes > kMostElementBytes) throw std::runtime_error("found elements of more than 16 MB");
    }
    return bytes;
  }

 private:
  std::size_t add_plain(std::string_view word, const std::string& name, std::size_t offset,
                        std::size_t count) {
    NumpyField field;
    field.name = name;
    field.offset = offset;
    field.count = count;
    std::string_view rest = word;
    if (rest.starts_with('>')) field.big_endian = true;
    if (!rest.empty() && std::string_view("<>|=").find(rest.front()) != std::string_view::npos) {
      rest.remove_prefix(1);
    }
    if (rest.empty()) throw std::runtime_error("found an empty type of elements");
    field.kind = rest.front();
    const auto [stop, error] =
        std::from_chars(rest.data() + 1, rest.data() + rest.size(), field.size);
    if (field.kind == 'O') {
      throw std::runtime_error(fmt::format(
          "{}Python objects (type {}, pickled), expected numbers; save it as an array of "
          "floats",
          name.empty() ? std::string("found ") : fmt::format("found in {} ", in_quotes(name)),
          in_quotes(word)));
    }
    if (error != std::errc() || field.size == 0 || field.size > kMostElementBytes) {
      throw std::runtime_error(
          fmt::format("found the type {}, expected one of numpy", in_quotes(word)));
    }
    const std::string_view unit(stop, static_cast<std::size_t>(rest.data() + rest.size() - stop));
    const std::size_t bytes = (field.kind == 'U' ? 4 : 1) * field.size;
    if (bytes > kMostElementBytes / count) {
      throw std::runtime_error("found elements of more than 16 MB");
    }
    if (is_number(field, unit)) {
      header_->fields.push_back(field);
    } else {
      header_->left_out.push_back(fmt::format("{} (type {})", name, word));
    }
    return bytes * count;
  }

  static bool is_number(NumpyField& field, std::string_view unit) {
    const auto one_of = [&](std::initializer_list<std::size_t> sizes) {
      for (const std::size_t size : sizes) {
        if (size == field.size) return true;
      }
      return false;
    };
    switch (field.kind) {
      case 'f':
        return one_of({2, 4, 8});
      case 'i':
      case 'u':
        return one_of({1, 2, 4, 8});
      case 'b':
        return field.size == 1;
      case 'M':
      case 'm':
        return field.size == 8 && set_time_unit(field, unit);
      default:
        return false;
    }
  }

  /// "[ns]", "[ms]", "[s]", ...
  static bool set_time_unit(NumpyField& field, std::string_view unit) {
    constexpr std::array<std::pair<std::string_view, std::int64_t>, 4> kParts = {
        {{"[s]", 1}, {"[ms]", 1'000}, {"[us]", 1'000'000}, {"[ns]", kNanosecondsPerSecond}}};
    constexpr std::array<std::pair<std::string_view, std::int64_t>, 3> kLong = {
        {{"[m]", 60}, {"[h]", 3600}, {"[D]", 86'400}}};
    for (const auto& [word, per_second] : kParts) {
      if (unit == word) field.per_second = per_second;
    }
    for (const auto& [word, seconds] : kLong) {
      if (unit == word) field.seconds_each = seconds;
    }
    return field.per_second != 0 || field.seconds_each != 1;
  }

  NumpyHeader* header_;
};

}  // namespace

std::size_t numpy_data_begin(std::string_view preamble) {
  constexpr std::size_t kMagic = 6;
  if (preamble.size() < kNumpyPreamble || !preamble.starts_with("\x93NUMPY")) {
    throw std::runtime_error("found no array of numpy");
  }
  const auto byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(preamble[i]));
  };
  const std::size_t version = byte(kMagic);
  if (version < 1 || version > 3) {
    throw std::runtime_error(
        fmt::format("found version {} of the format, expected 1 to 3", version));
  }
  std::size_t length = byte(8) | byte(9) << 8;
  std::size_t begin = 10;
  if (version > 1) {
    length |= byte(10) << 16 | byte(11) << 24;
    begin = 12;
  }
  if (length > kMostHeaderBytes) {
    throw std::runtime_error(
        fmt::format("found a header of {} bytes, expected {} at most", length, kMostHeaderBytes));
  }
  return begin + length;
}

NumpyHeader read_numpy_header(std::string_view begin) {
  NumpyHeader header;
  header.data_begin = numpy_data_begin(begin);
  const std::size_t text_begin = begin[6] == 1 ? 10 : 12;
  const PythonValue described =
      PythonReader(begin.substr(text_begin, header.data_begin - text_begin)).read();
  const PythonValue *type = nullptr, *order = nullptr, *shape = nullptr;
  if (described.kind == PythonValue::Kind::kPairs) {
    for (std::size_t i = 0; i + 1 < described.items.size(); i += 2) {
      const std::string& key = described.items[i].text;
      if (key == "descr") type = &described.items[i + 1];
      if (key == "fortran_order") order = &described.items[i + 1];
      if (key == "shape") shape = &described.items[i + 1];
    }
  }
  if (type == nullptr || order == nullptr || shape == nullptr) {
    throw std::runtime_error("found a header without descr, fortran_order or shape");
  }
  header.element_bytes = TypeReader(header).add(*type, {}, 0, 1);
  header.fortran_order = order->truth;
  header.shape = sizes_of(*shape);
  constexpr std::size_t kMostElements = std::size_t{1} << 46;
  product(header.shape, kMostElements);
  return header;
}

}  // namespace dyngen::runtime
