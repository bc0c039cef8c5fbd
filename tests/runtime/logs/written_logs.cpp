// SPDX-License-Identifier: MIT
#include "tests/runtime/logs/written_logs.h"

#include <cstdlib>
#include <filesystem>

#include "tests/support/temporary_path.h"

namespace dyngen::test {

WrittenLogs::WrittenLogs() : folder_(temporary_path("written_logs")) {
  const std::string python = DYNGEN_PYTHON_WITH_NUMPY;
  if (python.empty()) {
    absent_ = "nothing writes logs here (python3-numpy)";
    return;
  }
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
  const std::string command =
      python + " -B " DYNGEN_SOURCE_DIR "/tests/runtime/logs/write_logs.py '" + folder_ + "'";
  if (std::system(command.c_str()) != 0) absent_ = "FAILED: " + command;
}

WrittenLogs::~WrittenLogs() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

bool WrittenLogs::has(const std::string& name) const { return std::filesystem::exists(path(name)); }

std::string absent_package_of(const std::string& name) {
  const auto unless = [](bool there, const char* package) {
    return there ? std::string() : std::string(package);
  };
  if (name.ends_with(".db3")) return unless(DYNGEN_WITH_SQLITE, "libsqlite3-dev");
  if (name.ends_with(".mat")) return unless(DYNGEN_WITH_MATIO, "libmatio-dev");
  if (name.ends_with(".h5")) return unless(DYNGEN_WITH_HDF5, "libhdf5-dev");
  if (name.ends_with(".npz")) return unless(DYNGEN_WITH_ZIP, "libzip-dev");
  if (name.starts_with("lz4")) return unless(DYNGEN_WITH_LZ4, "liblz4-dev");
  if (name.starts_with("zstd")) return unless(DYNGEN_WITH_ZSTD, "libzstd-dev");
  if (name.starts_with("bz2")) return unless(DYNGEN_WITH_BZIP2, "libbz2-dev");
  return {};
}

}  // namespace dyngen::test
