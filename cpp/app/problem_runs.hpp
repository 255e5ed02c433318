// Shared by the commands that follow a path: progress at a terminal, and the end of the path in words.
#pragma once

#include <string>

#include "app/outputs.hpp"
#include "contct/model/problem.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/path.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/words.hpp"

namespace contct {

/// The names that --engine takes: auto, those of this process, and "petsc".
[[nodiscard]] std::vector<std::string> engine_choices();

/// Throws std::invalid_argument for what --engine does not take.
void refuse_engine_option(const std::string& name);

/// Read a problem and print its warnings. Throws as read_problem does, and as refuse_shared_outputs where one
/// of `outputs` would replace the problem or a file that it names.
[[nodiscard]] problem read_with_warnings(const problem_options& options,
                                         const std::vector<output_option>& outputs);

/// Observes a path and shows the step and the increment that it has reached. Whoever prints meanwhile erases
/// the line first.
class path_progress final : public observer {
 public:
  path_progress(std::size_t steps, bool quiet);

  void called(const answered_call& c) override;
  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

  progress line;

 private:
  std::size_t steps_;
  int step_ = 1, number_ = 0;
};

}  // namespace contct
