// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/in_parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace dyngen::runtime {

std::size_t working_threads() { return std::clamp(std::thread::hardware_concurrency(), 1u, 4u); }

void in_parallel(std::size_t count, std::size_t threads,
                 const std::function<void(std::size_t piece, std::size_t thread)>& work,
                 const std::function<void(double begun)>& progress) {
  std::atomic<std::size_t> next{0};
  std::mutex guard;
  std::exception_ptr failure;
  const auto loop = [&](std::size_t thread) {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i, thread);
      } catch (...) {
        const std::lock_guard lock(guard);
        if (!failure) failure = std::current_exception();
        next = count;
      }
      if (thread == 0 && progress) progress(static_cast<double>(i) / static_cast<double>(count));
    }
  };
  std::vector<std::thread> others;
  for (std::size_t t = 1; t < threads; ++t) others.emplace_back(loop, t);
  loop(0);
  for (std::thread& thread : others) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace dyngen::runtime
