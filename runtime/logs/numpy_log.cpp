// SPDX-License-Identifier: MIT
#include "runtime/logs/numpy_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "runtime/logs/array_log.h"
#include "runtime/logs/log_error.h"
#include "runtime/logs/number_conversion.h"
#include "runtime/logs/numpy_header.h"
#include "runtime/logs/time_words.h"
#include "runtime/logs/unpacking.h"
#include "runtime/recordings/notice_log.h"

#ifdef DYNGEN_LOGS_WITH_ZIP
#include <zip.h>
#endif

namespace dyngen::runtime {
namespace {

/// An array in a file or in memory, as rows of columns.
struct NumpyArray {
  NumpyHeader header;
  std::shared_ptr<BinaryReader> reader;
  std::size_t rows = 0, columns = 1;          ///< of elements
  std::size_t row_step = 1, column_step = 1;  ///< elements between neighbours
};

/// Reads one field of all elements in a block.
void read_block(const NumpyArray& array, const NumpyField& field,
                const std::optional<ColumnOrigin>& origin, std::size_t begin,
                Eigen::Ref<Eigen::MatrixXd> block) {
  const auto rows = static_cast<std::size_t>(block.rows());
  const std::size_t bytes = array.header.element_bytes;
  const bool whole_rows = array.column_step == 1 || array.columns == 1;
  const std::size_t pieces = whole_rows ? 1 : array.columns;
  const std::size_t elements = whole_rows ? rows * array.columns : rows;
  const bool time = field.kind == 'M' || field.kind == 'm';
  const StoredNumber stored{time                ? 'i'
                            : field.kind == 'b' ? 'u'
                                                : field.kind,
                            field.size, field.big_endian};
  const std::int64_t taken_off = origin ? origin->count : 0;
  constexpr auto kNotATime = std::numeric_limits<std::int64_t>::min();  // NaT
  std::string piece;
  for (std::size_t p = 0; p < pieces; ++p) {
    const std::size_t first = begin * array.row_step + p * array.column_step;
    array.reader->seek(array.header.data_begin + first * bytes);
    array.reader->read(piece, elements * bytes, "elements of an array");
    for (std::size_t i = 0; i < elements; ++i) {
      const std::size_t row = whole_rows ? i / array.columns : i;
      const std::size_t column = whole_rows ? i % array.columns : p;
      for (std::size_t k = 0; k < field.count; ++k) {
        const char* at = piece.data() + i * bytes + field.offset + k * field.size;
        double value = stored_value(at, stored, taken_off);
        if (time) {
          if (stored_whole(at, stored) == kNotATime)
            value = std::numeric_limits<double>::quiet_NaN();
          value = field.per_second != 0 ? value / static_cast<double>(field.per_second)
                                        : value * static_cast<double>(field.seconds_each);
        }
        block(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column * field.count + k)) =
            value;
      }
    }
  }
}

/// The origin of a field: its first value.
std::optional<ColumnOrigin> origin_of(const NumpyArray& array, const NumpyField& field) {
  if (field.kind == 'f' || field.kind == 'b' || array.rows == 0) return std::nullopt;
  std::string element;
  array.reader->seek(array.header.data_begin);
  array.reader->read(element, array.header.element_bytes, "the first element of an array");
  const StoredNumber stored{field.kind == 'M' || field.kind == 'm' ? 'i' : field.kind, field.size,
                            field.big_endian};
  const char* at = element.data() + field.offset;
  if (field.kind != 'M') return origin_of_first(at, stored);
  const auto first = stored_whole(at, stored);
  if (!first || field.per_second == 0 || *first == std::numeric_limits<std::int64_t>::min()) {
    return std::nullopt;
  }
  return ColumnOrigin{*first, field.per_second};
}

class NumpyCollector {
 public:
  explicit NumpyCollector(std::string file) : file_(std::move(file)) {}

  /// @param name    of the variable; empty: the file is the array
  /// @param reader  of the bytes of a .npy file
  /// @throws std::runtime_error, a sentence
  void add(const std::string& name, std::shared_ptr<BinaryReader> reader);

  void notice(std::string_view message) { notices_.push_back(log_notice(file_, message)); }

  std::unique_ptr<RawLog> take() {
    return make_array_log(std::move(variables_), std::move(notices_), file_);
  }

 private:
  bool lay_out(const std::string& name, NumpyArray& array);
  void add_field(const std::string& name, const std::shared_ptr<NumpyArray>& array,
                 const NumpyField& field);

  std::string file_;
  std::vector<ArrayVariable> variables_;
  std::vector<std::string> notices_;
};

/// Which way samples lie. @return false if the array has more than two sides
bool NumpyCollector::lay_out(const std::string& name, NumpyArray& array) {
  std::vector<std::size_t> shape = array.header.shape;
  while (shape.size() > 2 && shape.back() == 1) shape.pop_back();
  if (shape.size() > 2) {
    notice(
        fmt::format("{} is left out (an array of {} dimensions)", in_quotes(name), shape.size()));
    return false;
  }
  shape.resize(2, 1);
  if (array.header.shape.empty()) shape = {1, 1};
  const bool fortran = array.header.fortran_order;
  const std::size_t first_step = fortran ? 1 : shape[1], second_step = fortran ? shape[0] : 1;
  if (samples_are_second(shape[0], shape[1])) {
    array.rows = shape[1];
    array.columns = shape[0];
    array.row_step = second_step;
    array.column_step = first_step;
    if (shape[0] > 1) {
      notice(fmt::format("{}has {} x {} elements; samples are taken along the second side",
                         name.empty() ? std::string("the array ") : in_quotes(name) + " ", shape[0],
                         shape[1]));
    }
  } else {
    array.rows = shape[0];
    array.columns = shape[1];
    array.row_step = first_step;
    array.column_step = second_step;
  }
  constexpr std::size_t kMostArrayColumns = 20'000;
  if (array.columns > kMostArrayColumns) {
    notice(fmt::format("{} is left out ({} columns)", in_quotes(name), array.columns));
    return false;
  }
  return true;
}

void NumpyCollector::add_field(const std::string& name, const std::shared_ptr<NumpyArray>& array,
                               const NumpyField& field) {
  ArrayVariable variable;
  variable.rows = array->rows;
  variable.columns = array->columns * field.count;
  const bool structured = !field.name.empty();
  variable.table = structured ? name : "";
  variable.name = structured ? field.name : name;
  if (variable.name.empty()) {
    for (std::size_t k = 1; k <= variable.columns; ++k) {
      variable.column_names.push_back(std::to_string(k));
    }
  }
  variable.origin = origin_of(*array, field);
  if (field.kind == 'M' || field.kind == 'm') variable.unit = "s";
  const auto origin = variable.origin;
  variable.read = [array, field, origin](std::size_t begin, Eigen::Ref<Eigen::MatrixXd> block) {
    read_block(*array, field, origin, begin, block);
  };
  variables_.push_back(std::move(variable));
}

void NumpyCollector::add(const std::string& name, std::shared_ptr<BinaryReader> reader) {
  auto array = std::make_shared<NumpyArray>();
  array->reader = std::move(reader);
  std::string begin;
  array->reader->seek(0);
  array->reader->read(begin, kNumpyPreamble, "the header of an array");
  const std::size_t data_begin = numpy_data_begin(begin);
  array->reader->seek(0);
  array->reader->read(begin, data_begin, "the header of an array");
  array->header = read_numpy_header(begin);
  std::size_t elements = 1;
  for (const std::size_t size : array->header.shape) elements *= size;
  const std::uint64_t there = array->reader->size() - data_begin;
  if (array->header.element_bytes != 0 && elements > there / array->header.element_bytes) {
    array->reader->fail(data_begin,
                        fmt::format("found {} bytes of data, expected {} elements of {} "
                                    "bytes: the file is truncated",
                                    there, elements, array->header.element_bytes));
  }
  for (const std::string& text : array->header.left_out) {
    notice(fmt::format("{}{} is left out (no real numbers)", name, text));
  }
  if (array->header.fields.empty() || !lay_out(name, *array)) return;
  for (const NumpyField& field : array->header.fields) add_field(name, array, field);
}

}  // namespace

std::unique_ptr<RawLog> open_npy(const LogBytes& bytes) {
  NumpyCollector collector(bytes.name);
  try {
    collector.add({}, std::make_shared<BinaryReader>(bytes));
  } catch (const LogError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw log_error(bytes.name, error.what());
  }
  return collector.take();
}

#ifdef DYNGEN_LOGS_WITH_ZIP

namespace {

/// A zip archive from a file or from memory.
class ZipArchive {
 public:
  explicit ZipArchive(const LogBytes& bytes) : bytes_(bytes) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = bytes.memory ? zip_source_buffer_create(bytes.memory->data(),
                                                                   bytes.memory->size(), 0, &error)
                                        : zip_source_file_create(bytes.path.c_str(), 0, -1, &error);
    if (source != nullptr) {
      archive_ = zip_open_from_source(source, ZIP_RDONLY, &error);
      if (archive_ == nullptr) zip_source_free(source);
    }
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    if (archive_ == nullptr) {
      throw log_error(bytes.name, fmt::format("found a damaged zip archive ({})", why));
    }
  }
  ~ZipArchive() { zip_discard(archive_); }
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  [[nodiscard]] std::uint64_t members() const {
    return static_cast<std::uint64_t>(std::max<zip_int64_t>(zip_get_num_entries(archive_, 0), 0));
  }
  [[nodiscard]] std::string member_name(std::uint64_t index) const {
    const char* name = zip_get_name(archive_, index, ZIP_FL_ENC_RAW);
    return name == nullptr ? std::string() : name;
  }

  /// All bytes of a member; their check is verified. @throws std::runtime_error, a sentence
  [[nodiscard]] std::string member(std::uint64_t index, std::size_t most) const {
    const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(
        zip_fopen_index(archive_, index, 0), zip_fclose);
    if (!file)
      throw std::runtime_error(fmt::format("found damaged data ({})", zip_strerror(archive_)));
    std::string all, piece(1 << 18, '\0');
    for (;;) {
      const zip_int64_t got = zip_fread(file.get(), piece.data(), piece.size());
      if (got < 0) {
        throw std::runtime_error(
            fmt::format("found damaged data ({})", zip_file_strerror(file.get())));
      }
      if (got == 0) return all;
      all.append(piece, 0, static_cast<std::size_t>(got));
      if (all.size() > most) {
        throw std::runtime_error(fmt::format(
            "found more than {} bytes in all arrays, expected as many at most", kMostUnpacked));
      }
    }
  }

 private:
  LogBytes bytes_;  ///< memory that the archive reads
  zip_t* archive_ = nullptr;
};

}  // namespace

std::unique_ptr<RawLog> open_npz(const LogBytes& bytes) {
  const ZipArchive archive(bytes);
  NumpyCollector collector(bytes.name);
  constexpr std::uint64_t kMostMembers = 10'000;
  std::size_t arrays = 0, memory_left = kMostUnpacked;
  for (std::uint64_t i = 0; i < std::min(archive.members(), kMostMembers); ++i) {
    const std::string file = archive.member_name(i);
    if (!file.ends_with(".npy")) {
      collector.notice(fmt::format("{} is left out (no array of numpy)", in_quotes(file)));
      continue;
    }
    const std::string name = file.substr(0, file.size() - 4);
    ++arrays;
    const LogBytes member{{}, nullptr, fmt::format("{}: {}", bytes.name, file)};
    try {
      LogBytes unpacked_member = member;
      unpacked_member.memory = std::make_shared<const std::string>(archive.member(i, memory_left));
      memory_left -= unpacked_member.memory->size();
      collector.add(name, std::make_shared<BinaryReader>(unpacked_member));
    } catch (const LogError&) {
      throw;
    } catch (const std::runtime_error& error) {
      const std::string_view what = error.what();
      if (what.find("Python objects") == what.npos) throw log_error(member.name, what);
      collector.notice(fmt::format("{} is left out: {}", in_quotes(file), what));
    }
  }
  if (arrays == 0) {
    throw log_error(bytes.name,
                    "found a zip archive without arrays of numpy (.npy), expected .npz; "
                    "unpack other archives first");
  }
  return collector.take();
}

#else

std::unique_ptr<RawLog> open_npz(const LogBytes& bytes) {
  throw absent_package(bytes.name, "files of several NumPy arrays (.npz)", "libzip-dev");
}

#endif

}  // namespace dyngen::runtime
