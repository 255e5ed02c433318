// A problem from its text to its numbers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/results/quantities.hpp"
#include "contct/results/run.hpp"

namespace contct {

/// A problem, solved by the corrected rule and compared with the 1989 rule, as by `contct run`.
class solved_problem {
 public:
  /// `text`: a problem file. `name`: for messages; its folder has the files that the text names. Throws
  /// input_error for a text that is refused, and std::invalid_argument as structure_of does.
  explicit solved_problem(std::string_view text, const std::string& name = "problem")
      : what(parse_problem(text, name, reach::own_folder)),
        structure(structure_of(what)),
        solved(what, structure, {.file = name, .both_rules = true}) {
    solved.go({});
    solved.find_mesh_errors();
  }
  solved_problem(const solved_problem&) = delete;
  solved_problem& operator=(const solved_problem&) = delete;
  ~solved_problem() = default;

  /// True if the whole load is applied in every step, and every final state is certified.
  [[nodiscard]] bool certified() const {
    return solved.result.end.status == path_status::solved && solved.result.all_certified();
  }

  /// The numbers at the end of a step, from 1, that the path reached. `key`: a quantity of result-file.md,
  /// such as "w" or "force"; in the order of nodes, pairs and so on. Throws std::logic_error for another key,
  /// and std::out_of_range for another step.
  [[nodiscard]] std::vector<double> values(std::string_view key, std::size_t step) const {
    return row_named(what, key).values(step_results(what, solved.result.record.steps.at(step - 1)));
  }

  const problem what;
  const linear_structure structure;
  run solved;
};

}  // namespace contct
