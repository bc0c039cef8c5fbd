// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/process/process_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#if DYNGEN_WITH_MPI
#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <chrono>
#include <limits>
#include <thread>
#endif

namespace dyngen::runtime {

#if DYNGEN_WITH_MPI

namespace {

constexpr int kTag = 0;

/// MPI waits by asking again and again. Processes that share a core with one that works sleep
/// between.
template <typename Done>
void wait_until(Done done) {
  for (int pause = 10; !done(); pause = std::min(2 * pause, 2000)) {
    std::this_thread::sleep_for(std::chrono::microseconds(pause));
  }
}

}  // namespace

struct ProcessGroup::Pending {
  std::string bytes;
  MPI_Request request = MPI_REQUEST_NULL;

  void wait() {
    wait_until([&] {
      int done = 0;
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      return done != 0;
    });
  }
};

ProcessGroup::ProcessGroup() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) return;
  pending_ = std::make_unique<Pending>();
  MPI_Init(nullptr, nullptr);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

ProcessGroup::~ProcessGroup() {
  if (pending_) abort(EXIT_FAILURE);
}

void ProcessGroup::send(int to, std::string bytes) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw std::invalid_argument(
        fmt::format("a message of {} bytes to process {}, expected at most "
                    "2 GB",
                    bytes.size(), to));
  }
  pending_->wait();
  pending_->bytes = std::move(bytes);
  MPI_Issend(pending_->bytes.data(), static_cast<int>(pending_->bytes.size()), MPI_BYTE, to, kTag,
             MPI_COMM_WORLD, &pending_->request);
}

std::string ProcessGroup::receive(int from) {
  MPI_Status status;
  wait_until([&] {
    int there = 0;
    MPI_Iprobe(from, kTag, MPI_COMM_WORLD, &there, &status);
    return there != 0;
  });
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  MPI_Recv(bytes.data(), size, MPI_BYTE, from, kTag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return bytes;
}

void ProcessGroup::finish() {
  if (!pending_) return;
  pending_->wait();
  MPI_Request barrier = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &barrier);
  wait_until([&] {
    int done = 0;
    MPI_Test(&barrier, &done, MPI_STATUS_IGNORE);
    return done != 0;
  });
  MPI_Finalize();
  pending_.reset();
}

void ProcessGroup::abort(int code) {
  if (pending_) MPI_Abort(MPI_COMM_WORLD, code);
  std::exit(code);
}

#else

struct ProcessGroup::Pending {};

namespace {

int number_of(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atoi(text);
}

}  // namespace

ProcessGroup::ProcessGroup()
    : rank_(number_of("OMPI_COMM_WORLD_RANK", 0)), size_(number_of("OMPI_COMM_WORLD_SIZE", 1)) {}
ProcessGroup::~ProcessGroup() = default;
void ProcessGroup::send(int to, std::string) {
  throw std::logic_error(fmt::format("there is no process {}", to));
}
std::string ProcessGroup::receive(int from) {
  throw std::logic_error(fmt::format("there is no process {}", from));
}
void ProcessGroup::finish() {}
void ProcessGroup::abort(int code) { std::exit(code); }

#endif

}  // namespace dyngen::runtime
