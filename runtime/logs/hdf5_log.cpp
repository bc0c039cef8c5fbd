// SPDX-License-Identifier: MIT
#include "runtime/logs/hdf5_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/logs/array_log.h"
#include "runtime/logs/child_process.h"
#include "runtime/logs/log_error.h"

#ifdef DYNGEN_LOGS_WITH_HDF5
#include <hdf5.h>
#endif

namespace dyngen::runtime {

#ifdef DYNGEN_LOGS_WITH_HDF5

namespace {

constexpr std::size_t kMostHdf5Columns = 20'000;
constexpr std::size_t kMostHdf5Objects = 100'000;
constexpr Eigen::Index kRowsOfHdf5AtOnce = 1 << 12;
/// Data that is packed may be this many times longer than in the file; deflate reaches 1032.
constexpr double kMostPacking = 1100;
constexpr double kAlwaysFits = 1e9;  ///< bytes for which that is not asked

/// An identifier of the library, given back at the end.
class Hdf5Id {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Id(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Id() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Id(const Hdf5Id&) = delete;
  Hdf5Id& operator=(const Hdf5Id&) = delete;
  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] bool good() const { return id_ >= 0; }

 private:
  hid_t id_;
  Close close_;
};

bool is_hdf5_number(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  const std::size_t size = H5Tget_size(type);
  if (kind == H5T_FLOAT) return size <= sizeof(double);
  return (kind == H5T_INTEGER || kind == H5T_ENUM) && size <= 8;
}

/// What is read of a dataset, one member or all.
struct Hdf5Part {
  std::string member;            ///< of a compound type; empty: the elements are numbers
  bool whole = false;            ///< whole numbers of 64 bits
  std::vector<hsize_t> sides{};  ///< of a member that is an array; empty: it is one number
};

/// The sides of a type that is an array; empty: it is none.
std::vector<hsize_t> sides_of(hid_t type) {
  if (H5Tget_class(type) != H5T_ARRAY) return {};
  const int rank = H5Tget_array_ndims(type);
  std::vector<hsize_t> sides(rank > 0 ? static_cast<std::size_t>(rank) : 0);
  if (rank <= 0 || H5Tget_array_dims2(type, sides.data()) < 0) return {};
  return sides;
}

/// How many numbers an array has; more than kMostHdf5Columns where there are too many.
hsize_t product_of(const std::vector<hsize_t>& sides) {
  hsize_t product = 1;
  for (const hsize_t side : sides) {
    if (side > kMostHdf5Columns) return kMostHdf5Columns + 1;
    product = std::min<hsize_t>(product * side, kMostHdf5Columns + 1);
  }
  return product;
}

/// A dataset that stays open.
struct Hdf5Dataset {
  std::shared_ptr<Hdf5Id> file;
  std::unique_ptr<Hdf5Id> dataset;
  std::string path, log;
  int rank = 1;
  bool turned = false;  ///< samples are along the second side
};

/// The type under which a part is read to memory.
Hdf5Id memory_type(const Hdf5Part& part) {
  const hid_t number = part.whole ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE;
  if (part.member.empty()) return {H5Tcopy(number), H5Tclose};
  const Hdf5Id member(
      part.sides.empty()
          ? H5Tcopy(number)
          : H5Tarray_create2(number, static_cast<unsigned>(part.sides.size()), part.sides.data()),
      H5Tclose);
  const hid_t compound = H5Tcreate(H5T_COMPOUND, H5Tget_size(member.get()));
  H5Tinsert(compound, part.member.c_str(), 0, member.get());
  return {compound, H5Tclose};
}

/// Reads elements [begin, begin + rows) x columns into `out`, as they lie in the file.
void read_elements(const Hdf5Dataset& data, const Hdf5Part& part, std::size_t begin,
                   std::size_t rows, std::size_t columns, void* out) {
  std::array<hsize_t, 2> start{}, count{1, 1};
  const std::size_t along = data.turned ? 1 : 0;
  start[along] = begin;
  count[along] = rows;
  if (data.rank == 2) count[1 - along] = columns;
  const Hdf5Id space(H5Dget_space(data.dataset->get()), H5Sclose);
  const Hdf5Id memory(H5Screate_simple(data.rank, count.data(), nullptr), H5Sclose);
  const Hdf5Id type = memory_type(part);
  const bool read =
      space.good() && memory.good() && type.good() &&
      H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                          nullptr) >= 0 &&
      H5Dread(data.dataset->get(), type.get(), memory.get(), space.get(), H5P_DEFAULT, out) >= 0;
  if (!read) {
    throw log_error_at(data.log, "row", begin + 1,
                       fmt::format("dataset '{}' cannot be read on: it is damaged, or packed by a "
                                   "filter that is not installed",
                                   data.path));
  }
}

void read_hdf5_block(const Hdf5Dataset& data, const Hdf5Part& part, std::int64_t taken_off,
                     std::size_t begin, Eigen::Ref<Eigen::MatrixXd> block) {
  const auto rows = static_cast<std::size_t>(block.rows());
  const auto columns = static_cast<std::size_t>(block.cols());
  std::vector<double> numbers(part.whole ? 0 : rows * columns);
  std::vector<std::int64_t> wholes(part.whole ? rows * columns : 0);
  read_elements(
      data, part, begin, rows, columns,
      part.whole ? static_cast<void*>(wholes.data()) : static_cast<void*>(numbers.data()));
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t place = data.turned ? column * rows + row : row * columns + column;
      double value = 0;
      if (part.whole) {
        std::int64_t difference = 0;
        value = __builtin_sub_overflow(wholes[place], taken_off, &difference)
                    ? static_cast<double>(wholes[place]) - static_cast<double>(taken_off)
                    : static_cast<double>(difference);
      } else {
        value = numbers[place];
      }
      block(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = value;
    }
  }
}

/// The text of an attribute; empty if there is none.
std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Hdf5Id attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.good()) return {};
  const Hdf5Id type(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Id space(H5Aget_space(attribute.get()), H5Sclose);
  if (!type.good() || H5Tget_class(type.get()) != H5T_STRING) return {};
  if (H5Sget_simple_extent_npoints(space.get()) != 1) return {};
  constexpr std::size_t kLongestUnit = 256;
  if (H5Tis_variable_str(type.get()) > 0) {
    const Hdf5Id wanted(H5Tcopy(type.get()), H5Tclose);
    char* text = nullptr;
    if (H5Aread(attribute.get(), wanted.get(), &text) < 0 || text == nullptr) return {};
    std::string kept = std::string(text).substr(0, kLongestUnit);
    H5free_memory(text);
    return kept;
  }
  const std::size_t size = H5Tget_size(type.get());
  if (size > kLongestUnit) return {};
  std::string text(size, '\0');
  if (H5Aread(attribute.get(), type.get(), text.data()) < 0) return {};
  text.resize(std::min(text.find('\0'), text.size()));
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

class Hdf5Collector {
 public:
  Hdf5Collector(std::shared_ptr<Hdf5Id> file, std::string name)
      : file_(std::move(file)), name_(std::move(name)) {}

  void find_datasets();
  std::unique_ptr<RawLog> take();

 private:
  static herr_t visit(hid_t, const char* path, const H5O_info_t* info, void* self);
  void add(const std::string& path);
  void add_part(const std::shared_ptr<Hdf5Dataset>& data, const Hdf5Part& part, hsize_t rows,
                hsize_t columns);
  void add_compound(const std::shared_ptr<Hdf5Dataset>& data, hid_t type, hsize_t rows);
  void leave_out(const std::string& why, const std::string& path) {
    left_out_[why].push_back(path);
  }

  std::shared_ptr<Hdf5Id> file_;
  std::string name_;
  std::vector<std::string> paths_;
  std::vector<ArrayVariable> variables_;
  std::vector<std::string> notices_, turned_;
  std::map<std::string, std::vector<std::string>> left_out_;
};

herr_t Hdf5Collector::visit(hid_t, const char* path, const H5O_info_t* info, void* self) {
  auto* collector = static_cast<Hdf5Collector*>(self);
  if (info->type == H5O_TYPE_DATASET) collector->paths_.emplace_back(path);
  return collector->paths_.size() > kMostHdf5Objects ? -1 : 0;
}

void Hdf5Collector::find_datasets() {
  if (H5Ovisit(file_->get(), H5_INDEX_NAME, H5_ITER_INC, visit, this) < 0) {
    throw log_error(name_, "found groups that cannot be gone through: the file is damaged");
  }
  for (const std::string& path : paths_) add(path);
}

void Hdf5Collector::add_part(const std::shared_ptr<Hdf5Dataset>& data, const Hdf5Part& part,
                             hsize_t rows, hsize_t columns) {
  ArrayVariable variable;
  const std::size_t slash = data->path.find('/');
  const bool in_group = slash != std::string::npos;
  variable.table = !part.member.empty() ? data->path : in_group ? data->path.substr(0, slash) : "";
  variable.name = !part.member.empty() ? part.member : data->path.substr(in_group ? slash + 1 : 0);
  variable.rows = static_cast<std::size_t>(rows);
  variable.columns = static_cast<std::size_t>(columns);
  for (const char* attribute : {"units", "unit", "Units", "Unit"}) {
    if (variable.unit.empty() && part.member.empty()) {
      variable.unit = text_attribute(data->dataset->get(), attribute);
    }
  }
  if (part.whole) {
    std::int64_t first = 0;
    std::vector<std::int64_t> row(variable.columns);
    read_elements(*data, part, 0, 1, variable.columns, row.data());
    first = row.front();
    if (std::abs(static_cast<double>(first)) > std::ldexp(1.0, 53)) {
      variable.origin = ColumnOrigin{first, 1};
    }
  }
  const std::int64_t taken_off = variable.origin ? variable.origin->count : 0;
  variable.read = [data, part, taken_off](std::size_t begin, Eigen::Ref<Eigen::MatrixXd> block) {
    read_hdf5_block(*data, part, taken_off, begin, block);
  };
  variables_.push_back(std::move(variable));
}

void Hdf5Collector::add_compound(const std::shared_ptr<Hdf5Dataset>& data, hid_t type,
                                 hsize_t rows) {
  const int members = H5Tget_nmembers(type);
  for (unsigned i = 0; members > 0 && i < static_cast<unsigned>(members); ++i) {
    char* raw = H5Tget_member_name(type, i);
    if (raw == nullptr) continue;
    const std::string member = raw;
    H5free_memory(raw);
    const Hdf5Id own(H5Tget_member_type(type, i), H5Tclose);
    const std::vector<hsize_t> sides = own.good() ? sides_of(own.get()) : std::vector<hsize_t>();
    // of an array the type of its elements
    const Hdf5Id member_type(!own.good()     ? -1
                             : sides.empty() ? H5Tcopy(own.get())
                                             : H5Tget_super(own.get()),
                             H5Tclose);
    const hsize_t columns = product_of(sides);
    if (columns == 0 || columns > kMostHdf5Columns) {
      leave_out("too many columns", data->path + "." + member);
      continue;
    }
    if (!member_type.good() || !is_hdf5_number(member_type.get()) ||
        H5Tget_class(member_type.get()) == H5T_ENUM) {
      leave_out("no numbers", data->path + "." + member);
      continue;
    }
    const bool whole =
        H5Tget_class(member_type.get()) == H5T_INTEGER && H5Tget_size(member_type.get()) == 8;
    add_part(data, {member, whole, sides}, rows, columns);
  }
}

void Hdf5Collector::add(const std::string& path) {
  auto data = std::make_shared<Hdf5Dataset>();
  data->file = file_;
  data->path = path;
  data->log = name_;
  data->dataset =
      std::make_unique<Hdf5Id>(H5Dopen2(file_->get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Id type(data->dataset->good() ? H5Dget_type(data->dataset->get()) : -1, H5Tclose);
  const Hdf5Id space(data->dataset->good() ? H5Dget_space(data->dataset->get()) : -1, H5Sclose);
  if (!type.good() || !space.good()) {
    throw log_error(name_, fmt::format("dataset '{}' cannot be opened: the file is damaged", path));
  }
  const bool compound = H5Tget_class(type.get()) == H5T_COMPOUND;
  if (!compound && !is_hdf5_number(type.get())) return leave_out("no numbers", path);
  data->rank = H5Sget_simple_extent_ndims(space.get());
  if (data->rank < 0 || data->rank > 2 || (compound && data->rank != 1)) {
    return leave_out(fmt::format("{} dimensions", data->rank), path);
  }
  if (data->rank == 0) return leave_out("a single number", path);
  std::array<hsize_t, 2> sides{1, 1};
  H5Sget_simple_extent_dims(space.get(), sides.data(), nullptr);
  if (sides[0] == 0 || sides[1] == 0) return leave_out("empty", path);
  const double bytes = static_cast<double>(sides[0]) * static_cast<double>(sides[1]) *
                       static_cast<double>(H5Tget_size(type.get()));
  const auto stored = static_cast<double>(H5Dget_storage_size(data->dataset->get()));
  if (stored == 0) return leave_out("never written", path);
  if (bytes > kAlwaysFits && bytes > kMostPacking * stored) {
    throw log_error(name_,
                    fmt::format("dataset '{}' has {:.3g} bytes, expected {:.0f} times the {:.0f} "
                                "bytes that it takes in the file at most",
                                path, bytes, kMostPacking, stored));
  }
  if (compound) return add_compound(data, type.get(), sides[0]);
  data->turned = data->rank == 2 && samples_are_second(sides[0], sides[1]);
  if (data->turned) std::swap(sides[0], sides[1]);
  if (sides[1] > kMostHdf5Columns) return leave_out("too many columns", path);
  if (data->turned && sides[1] > 1) turned_.push_back(path);
  const bool whole = H5Tget_class(type.get()) == H5T_INTEGER && H5Tget_size(type.get()) == 8;
  add_part(data, {{}, whole, {}}, sides[0], sides[1]);
}

std::unique_ptr<RawLog> Hdf5Collector::take() {
  for (const auto& [why, paths] : left_out_) {
    notices_.push_back(
        log_notice(name_, fmt::format("{} is left out ({})", few_names(paths), why)));
  }
  if (!turned_.empty()) {
    notices_.push_back(
        log_notice(name_, fmt::format("samples are taken along the second side of {}, which is "
                                      "longer",
                                      few_names(turned_))));
  }
  return make_array_log(std::move(variables_), std::move(notices_), name_);
}

/// The file stays readable as long as the log lives.
class Hdf5Log final : public RawLog {
 public:
  Hdf5Log(std::shared_ptr<ReadablePath> path, std::unique_ptr<RawLog> log)
      : path_(std::move(path)), log_(std::move(log)) {}
  [[nodiscard]] const std::vector<LogTable>& tables() const override { return log_->tables(); }
  bool next(LogRows& rows, std::size_t at_most) override { return log_->next(rows, at_most); }
  [[nodiscard]] std::string place_word() const override { return log_->place_word(); }
  [[nodiscard]] std::vector<std::string> notices() const override { return log_->notices(); }
  [[nodiscard]] std::optional<ColumnOrigin> origin(std::size_t table,
                                                   std::size_t column) const override {
    return log_->origin(table, column);
  }
  [[nodiscard]] double fraction_read() const override { return log_->fraction_read(); }

 private:
  std::shared_ptr<ReadablePath> path_;
  std::unique_ptr<RawLog> log_;
};

std::unique_ptr<RawLog> read_hdf5(const std::shared_ptr<ReadablePath>& path,
                                  const std::string& name) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  auto file = std::make_shared<Hdf5Id>(H5Fopen(path->path().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                                       H5Fclose);
  if (!file->good()) {
    throw log_error(name, "found an HDF5 file that cannot be opened: it is truncated or damaged");
  }
  Hdf5Collector collector(file, name);
  collector.find_datasets();
  return std::make_unique<Hdf5Log>(path, collector.take());
}

}  // namespace

std::unique_ptr<RawLog> open_hdf5(const LogBytes& bytes) {
  const auto path = std::make_shared<ReadablePath>(bytes);
  try_in_child(bytes.name, BinaryReader(bytes).size(), [&] {
    const std::unique_ptr<RawLog> log = read_hdf5(path, bytes.name);
    for (LogRows rows; log->next(rows, kRowsOfHdf5AtOnce);) {
    }
  });
  return read_hdf5(path, bytes.name);
}

#else

std::unique_ptr<RawLog> open_hdf5(const LogBytes& bytes) {
  throw absent_package(bytes.name, "HDF5 files", "libhdf5-dev");
}

#endif

}  // namespace dyngen::runtime
