// SPDX-License-Identifier: MIT
#pragma once

#include <exception>

namespace dyngen::runtime {

/// What went wrong beside the answer, to be said when that stands.
class LateError {
 public:
  template <typename Work>
  void during(const Work& work) {
    try {
      work();
    } catch (...) {
      if (!first_) first_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (first_) std::rethrow_exception(first_);
  }

 private:
  std::exception_ptr first_;
};

}  // namespace dyngen::runtime
