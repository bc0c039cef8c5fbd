// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

namespace dyngen::runtime {

/// The processes that mpirun started together; without mpirun, this one.
///
/// Messages between two processes arrive whole and in the order they were sent. In a build without
/// MPI none can be sent: each process knows that it is not alone, and no more.
class ProcessGroup {
 public:
  /// Joins the others. Only if mpirun started this process does it pay for that.
  ProcessGroup();
  /// Leaves; finish() should have been called.
  ~ProcessGroup();
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;

  [[nodiscard]] int rank() const {
    return rank_;
  }  ///< 0 .. size() - 1; process 0 prints and writes
  [[nodiscard]] int size() const { return size_; }
  /// Whether mpirun started this process and messages can be sent.
  [[nodiscard]] bool connected() const { return pending_ != nullptr; }

  /// Starts to send. Waits until the message before has been taken: a process is at most one
  /// message ahead of who receives it.
  /// @throws std::invalid_argument  if it is 2 GB or more
  void send(int to, std::string bytes);
  /// Waits for a message.
  std::string receive(int from);

  /// Waits for all others, then leaves. Call it last, when all that was sent was received.
  void finish();
  /// Ends all processes, wherever they are in their work.
  [[noreturn]] void abort(int code);

 private:
  struct Pending;  ///< a message on its way
  int rank_ = 0, size_ = 1;
  std::unique_ptr<Pending> pending_;
};

}  // namespace dyngen::runtime
