// SPDX-License-Identifier: MIT
#include "runtime/logs/matlab_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "runtime/logs/array_log.h"
#include "runtime/logs/child_process.h"
#include "runtime/logs/log_error.h"
#include "runtime/logs/matlab_elements.h"
#include "runtime/logs/number_conversion.h"

#ifdef DYNGEN_LOGS_WITH_MATIO
#include <matio.h>
#endif

namespace dyngen::runtime {

#ifdef DYNGEN_LOGS_WITH_MATIO

namespace {

constexpr std::size_t kDeepestStruct = 32;
constexpr std::size_t kMostStructElements = 100;  ///< of an array of structs: a table each
constexpr std::size_t kMostMatlabColumns = 20'000;
constexpr std::size_t kRowsAtOnce = 1 << 12;

/// A variable and all that it holds.
using MatlabVariable = std::shared_ptr<matvar_t>;

std::optional<StoredNumber> stored_number_of(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return StoredNumber{'f', 8, false};
    case MAT_C_SINGLE:
      return StoredNumber{'f', 4, false};
    case MAT_C_INT8:
      return StoredNumber{'i', 1, false};
    case MAT_C_UINT8:
      return StoredNumber{'u', 1, false};
    case MAT_C_INT16:
      return StoredNumber{'i', 2, false};
    case MAT_C_UINT16:
      return StoredNumber{'u', 2, false};
    case MAT_C_INT32:
      return StoredNumber{'i', 4, false};
    case MAT_C_UINT32:
      return StoredNumber{'u', 4, false};
    case MAT_C_INT64:
      return StoredNumber{'i', 8, false};
    case MAT_C_UINT64:
      return StoredNumber{'u', 8, false};
    default:
      return std::nullopt;
  }
}

/// Why a variable that is no number is left out.
std::string words_of_class(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_CHAR:
      return "text";
    case MAT_C_CELL:
      return "a cell array";
    case MAT_C_SPARSE:
      return "a sparse matrix";
    case MAT_C_FUNCTION:
      return "a function";
    case MAT_C_OBJECT:
    case MAT_C_OPAQUE:
      return "an object, such as a timeseries or table; save its time and data as arrays";
    case MAT_C_EMPTY:
      return "empty";
    default:
      return "of an unknown class";
  }
}

class MatlabCollector {
 public:
  explicit MatlabCollector(std::string file) : file_(std::move(file)) {}

  void add(const MatlabVariable& variable) {
    const std::string_view called = variable->name != nullptr ? variable->name : "";
    if (called.empty() || called.starts_with("__")) return;  // what objects are made of
    const std::string name = variable->name;
    if (variable->class_type == MAT_C_STRUCT) {
      add_struct(variable, *variable, name, {}, 0);
    } else {
      add_array(variable, *variable, {}, name);
    }
  }

  std::unique_ptr<RawLog> take() {
    for (const auto& [why, names] : left_out_)
      notice(fmt::format("{} is left out ({})", few_names(names), why));
    if (!turned_.empty()) {
      notice(fmt::format("samples are taken along the second side of {}, which is longer",
                         few_names(turned_)));
    }
    return make_array_log(std::move(variables_), std::move(notices_), file_);
  }

 private:
  void notice(std::string_view message) { notices_.push_back(log_notice(file_, message)); }
  void add_struct(const MatlabVariable& owner, const matvar_t& variable, const std::string& table,
                  const std::string& path, std::size_t depth);
  void add_field(const MatlabVariable& owner, const matvar_t& field, const std::string& table,
                 const std::string& path, std::size_t depth);
  void add_array(const MatlabVariable& owner, const matvar_t& variable, const std::string& table,
                 const std::string& name);

  std::string file_;
  std::vector<ArrayVariable> variables_;
  std::vector<std::string> notices_;
  std::map<std::string, std::vector<std::string>> left_out_;  ///< why -> names
  std::vector<std::string> turned_;
};

void MatlabCollector::add_field(const MatlabVariable& owner, const matvar_t& field,
                                const std::string& table, const std::string& path,
                                std::size_t depth) {
  if (field.class_type == MAT_C_STRUCT) {
    add_struct(owner, field, table, path, depth + 1);
  } else {
    add_array(owner, field, table, path);
  }
}

void MatlabCollector::add_struct(const MatlabVariable& owner, const matvar_t& variable,
                                 const std::string& table, const std::string& path,
                                 std::size_t depth) {
  if (depth > kDeepestStruct) {
    throw log_error(file_, fmt::format("found structs nested more than {} deep", kDeepestStruct));
  }
  std::size_t elements = 1;
  for (int i = 0; i < variable.rank; ++i) elements *= variable.dims[i];
  // matio does not change it; its interface is older than const.
  const std::size_t fields = Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&variable));
  char* const* names = Mat_VarGetStructFieldnames(&variable);
  if (variable.data == nullptr || names == nullptr) return;
  const auto* values = static_cast<matvar_t* const*>(variable.data);
  if (elements > kMostStructElements) {
    left_out_[fmt::format("an array of more than {} structs", kMostStructElements)].push_back(
        table + (path.empty() ? "" : ".") + path);
    return;
  }
  for (std::size_t e = 0; e < elements; ++e) {
    const std::string place = elements > 1 ? fmt::format("({})", e + 1) : std::string();
    for (std::size_t f = 0; f < fields; ++f) {
      const matvar_t* field = values[e * fields + f];
      if (field == nullptr || names[f] == nullptr) continue;
      // of an array of structs, each element is a table of its own
      const std::string own_table = path.empty() ? table + place : table;
      const std::string own_path =
          path.empty() ? std::string(names[f]) : fmt::format("{}{}.{}", path, place, names[f]);
      add_field(owner, *field, own_table, own_path, depth);
    }
  }
}

void MatlabCollector::add_array(const MatlabVariable& owner, const matvar_t& variable,
                                const std::string& table, const std::string& name) {
  const std::string whole = table.empty() ? name : table + "." + name;
  const std::optional<StoredNumber> stored = stored_number_of(variable);
  if (!stored) {
    left_out_[words_of_class(variable)].push_back(whole);
    return;
  }
  std::size_t rank = static_cast<std::size_t>(std::max(variable.rank, 0));
  while (rank > 2 && variable.dims[rank - 1] == 1) --rank;
  if (variable.isComplex != 0 || rank != 2) {
    left_out_[variable.isComplex != 0 ? "complex numbers" : "more than two dimensions"].push_back(
        whole);
    return;
  }
  const std::size_t first = variable.dims[0], second = variable.dims[1];
  if (first == 0 || second == 0 || variable.data == nullptr) {
    left_out_["empty"].push_back(whole);
    return;
  }
  if (variable.nbytes / stored->size / first < second) {
    throw log_error(file_,
                    fmt::format("found fewer bytes than {} needs: the file is damaged", whole));
  }
  ArrayVariable array;
  array.table = table;
  array.name = name;
  const bool turned = samples_are_second(first, second);
  array.rows = turned ? second : first;
  array.columns = turned ? first : second;
  if (array.columns > kMostMatlabColumns) {
    left_out_["too many columns"].push_back(whole);
    return;
  }
  if (turned && first > 1) turned_.push_back(whole);
  const char* data = static_cast<const char*>(variable.data);
  array.origin = origin_of_first(data, *stored);
  const std::int64_t taken_off = array.origin ? array.origin->count : 0;
  // columns lie one after another
  const std::size_t row_step = turned ? first : 1, column_step = turned ? 1 : first;
  array.read = [owner, data, number = *stored, taken_off, row_step, column_step](
                   std::size_t begin, Eigen::Ref<Eigen::MatrixXd> block) {
    for (Eigen::Index column = 0; column < block.cols(); ++column) {
      for (Eigen::Index row = 0; row < block.rows(); ++row) {
        const std::size_t place = (begin + static_cast<std::size_t>(row)) * row_step +
                                  static_cast<std::size_t>(column) * column_step;
        block(row, column) = stored_value(data + place * number.size, number, taken_off);
      }
    }
  };
  variables_.push_back(std::move(array));
}

/// Reads all variables.
/// @param expected  variables that there are at least
std::unique_ptr<RawLog> read_matlab(const std::string& path, const std::string& name,
                                    std::size_t expected) {
  const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(Mat_Open(path.c_str(), MAT_ACC_RDONLY),
                                                          Mat_Close);
  if (!file) throw log_error(name, "found no MATLAB file that can be read: it is damaged");
  MatlabCollector collector(name);
  std::size_t count = 0;
  while (matvar_t* next = Mat_VarReadNext(file.get())) {
    ++count;
    collector.add(MatlabVariable(next, Mat_VarFree));
  }
  if (count < expected) {
    throw log_error(name, fmt::format("found {} variables of {} that can be read: the next one is "
                                      "damaged",
                                      count, expected));
  }
  if (count == 0) throw log_error(name, "found no variables, expected one or more");
  return collector.take();
}

}  // namespace

std::unique_ptr<RawLog> open_matlab(const LogBytes& bytes) {
  const ReadablePath readable(bytes);
  const std::size_t expected = check_matlab_elements(bytes);
  try_in_child(bytes.name, BinaryReader(bytes).size(), [&] {
    const std::unique_ptr<RawLog> log = read_matlab(readable.path(), bytes.name, expected);
    for (LogRows rows; log->next(rows, kRowsAtOnce);) {
    }
  });
  return read_matlab(readable.path(), bytes.name, expected);
}

#else

std::unique_ptr<RawLog> open_matlab(const LogBytes& bytes) {
  throw absent_package(bytes.name, "MATLAB files", "libmatio-dev");
}

#endif

}  // namespace dyngen::runtime
