// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

namespace dyngen::test {

/// C or C++ sources compiled and loaded; everything is gone with the object.
class SharedObject {
 public:
  /// @param files  name -> text; each name that ends in .c or .cpp is compiled
  /// @param flags  of the compiler, besides -fPIC and the warnings of emitted code
  /// @throws std::runtime_error  with the compiler's messages if it is not silent
  SharedObject(const std::map<std::string, std::string>& files, const std::string& flags,
               const std::string& compiler = "cc");
  ~SharedObject();
  SharedObject(const SharedObject&) = delete;
  SharedObject& operator=(const SharedObject&) = delete;

  /// @throws std::runtime_error  if there is none of this name
  [[nodiscard]] void* symbol(const std::string& name) const;

 private:
  std::string folder_;
  void* library_ = nullptr;
};

}  // namespace dyngen::test
