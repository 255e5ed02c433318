// A kernel of the caller's: a function of this process, in place of a library.
#pragma once

#include <string>

#include "contct/kernel/kernel.hpp"
#include "contct/outside/plugin.h"

namespace contct::outside {

using kernel_procedure = decltype(contct_kernel);

/// While this object lives, make_kernel and facts_of_kernel know `procedure` by `name`, on this thread. One
/// at a time; it must outlive the kernels that are made of it.
class own_kernel {
 public:
  /// Throws std::invalid_argument where another kernel has that name, or one of these lives already.
  own_kernel(std::string name, kernel_procedure* procedure);
  ~own_kernel();
  own_kernel(const own_kernel&) = delete;
  own_kernel& operator=(const own_kernel&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Its inputs are the caller's own, and must come back as they were: otherwise the answer is a
  /// kernel_failure.
  [[nodiscard]] std::unique_ptr<kernel> make() const;

  /// The one that lives on this thread; null where there is none.
  [[nodiscard]] static const own_kernel* here();

 private:
  std::string name_;
  kernel_procedure* procedure_;
};

/// What is known of it: the listing's rule, 8-byte REAL, and no text of its own.
[[nodiscard]] inline kernel_facts facts_of(const own_kernel& k) {
  return {k.name(), 8, "listing", "a function", "", "", false};
}

}  // namespace contct::outside
