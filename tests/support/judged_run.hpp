// A path with proved and judged final states, and everything that was reported about them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/exact/exact_means.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct {

struct judged_run final : observer {
  judged_run(problem given, const std::string& kernel, bool with_exact_path = true)
      : what(std::move(given)),
        structure(structure_of(what)),
        judged(what, structure, with_exact_path ? exact_means_of(what) : nullptr) {
    const auto leader = make_kernel(kernel);
    end = follow(what, structure, "refactor", *leader, {&judged, this}, {0, judged.ends()});
  }

  void step_ended(const step_state& s) override {
    numbers.push_back(reported_state_at(what, s).numbers);
    displacements.emplace_back(s.displacement.begin(), s.displacement.end());
    statuses.emplace_back(s.isep.begin(), s.isep.end());
    exactly.push_back(s.from_exact_path ? 1 : 0);
    reference.push_back(s.from_reference ? 1 : 0);
  }

  /// From 1.
  [[nodiscard]] const certificate& of_step(std::size_t step) const {
    return judged.steps().at(step - 1).value();
  }

  problem what;
  linear_structure structure;
  certifier judged;
  path_end end;
  // One entry for each step that ended:
  std::vector<end_numbers> numbers;
  std::vector<std::vector<double>> displacements;
  std::vector<std::vector<int>> statuses;
  std::vector<char> exactly, reference;  // 1 if the state is from the exact path; from the reference solution
};

}  // namespace contct
