// A problem read, built and followed, with progress shown at a terminal.
#pragma once

#include <memory>
#include <string>

#include "app/progress.hpp"
#include "contct/path/observer.hpp"
#include "contct/structure/problem.hpp"
#include "contct/structure/structure.hpp"

namespace contct::app {

/// Read a problem and print its warnings. Throws as read_problem does.
[[nodiscard]] problem read_with_progress(const std::string& file, bool quiet);

/// The structure of a problem. Throws as structure_of does.
[[nodiscard]] linear_structure build_with_progress(const problem& p, bool quiet);

/// Shows the step and the increment that a path has reached, by two observers around whoever prints.
class path_progress {
 public:
  path_progress(std::size_t steps, bool quiet);

  /// Erases the line when something may be printed.
  [[nodiscard]] observer* before() { return before_.get(); }
  /// Shows the line again.
  [[nodiscard]] observer* behind() { return behind_.get(); }
  void erase() { shown_.erase(); }

 private:
  progress shown_;
  std::unique_ptr<observer> before_, behind_;
};

}  // namespace contct::app
