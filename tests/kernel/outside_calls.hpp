// Calls to external kernels, and checks of the files and processes that the kernels leave.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/kernel/child_kernel.hpp"
#include "support/one_pair.hpp"
#include "support/scratch_folder.hpp"

namespace contct {

inline constexpr double behaves = 0, crashes = 1, exits_0 = 3, exits_3 = 4, hangs = 5, talks = 6;

inline outside_limits short_patience() {
  outside_limits limits;
  limits.patience = std::chrono::milliseconds(500);
  return limits;
}

/// Returns a call whose first face selects a fault of misbehaves.c.
inline small_call<double> call_for(double fault) {
  return small_call<double>(
      {{0.5, 2.0, fault, separated, face_above}, {0.0, 1.0, 4.0, in_contact, face_below}});
}

/// Returns the reported failure of a kernel, or an empty text if the kernel correctly answers without an
/// event.
inline std::string put(kernel& k, double fault) {
  small_call<double> c = call_for(fault);
  call<double> arguments = c.arguments();
  try {
    k.answer(arguments);
  } catch (const kernel_failure& failure) {
    return failure.what();
  }
  const bool right = arguments.smin == 1 && c.ss == std::vector<double>{1, 1} &&
                     c.isep == std::vector<int>{separated, in_contact};
  return right ? "" : "another answer";
}

inline long open_descriptors() {
  long count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

/// Checks that a kernel leaves no open file and no child process.
class leftovers {
 public:
  void check() const {
    CHECK(open_descriptors() == descriptors_);
    errno = 0;
    CHECK(waitpid(-1, nullptr, WNOHANG) == -1);  // no child process exists
    CHECK(errno == ECHILD);
  }

 private:
  long descriptors_ = open_descriptors();
};

}  // namespace contct
