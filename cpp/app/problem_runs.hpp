// Functions that commands share: they check --engine, read the problem, find reference/ and show progress.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "app/outputs.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/path.hpp"
#include "contct/structure/problem.hpp"
#include "contct/write/words.hpp"

namespace contct {

/// The names that --engine accepts: "auto", the engines of this process, and "petsc".
[[nodiscard]] std::vector<std::string> engine_choices();

/// Throws std::invalid_argument if --engine does not accept the name.
void refuse_engine_option(const std::string& name);

/// Reads a problem and prints its warnings. Throws as read_problem does, and as refuse_shared_outputs does if
/// an output would replace the problem or a file that it names.
[[nodiscard]] problem read_with_warnings(const problem_options& options,
                                         const std::vector<output_option>& outputs);

/// The places of the file or folder `name` in `folders`, which are relative to the program's own folder.
[[nodiscard]] std::vector<std::string> beside_program(std::string_view name,
                                                      std::initializer_list<const char*> folders);

/// Returns the folder `asked`. If `asked` is empty, returns the reference/ that is installed with the
/// program, found relative to the program, or else the reference/ of the source tree. Throws input_error if
/// there is neither folder.
[[nodiscard]] std::filesystem::path find_reference(const std::string& asked);

/// Replays the golden set with `k`. Returns known_faults of the answers; empty if reference/ is not found.
[[nodiscard]] std::vector<std::string> golden_faults(kernel& k);

/// Observes a path and shows the step and the increment that it has reached. Code that prints during the
/// path must erase `line` first.
class path_progress final : public observer {
 public:
  path_progress(std::size_t steps, bool quiet) : line(quiet), steps_(steps) {}

  void called(const answered_call& c) override;
  void incremented(const increment& i) override;
  void reached(int step, int number, double fraction);

  progress line;

 private:
  std::size_t steps_;
  int step_ = 1, number_ = 0;
};

}  // namespace contct
