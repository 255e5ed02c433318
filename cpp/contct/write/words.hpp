// The words for statuses, events, certificates and the end of a run, the same on the terminal, on the page
// and in every file.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/model/problem.hpp"
#include "contct/path/path.hpp"
#include "contct/path/path_observers.hpp"
#include "contct/session/exit_status.hpp"
#include "contct/session/step_results.hpp"

namespace contct {

constexpr std::string_view surface_name(int surface) {
  return surface == face_above ? "above" : "below";
}

constexpr std::string_view change_name(change c) {
  return c == change::make ? "make" : "break";
}

constexpr std::string_view state_name(int isep) {
  return isep == in_contact ? "contact" : "separated";
}

/// "make 1, break 3".
[[nodiscard]] std::string event_names(std::span<const event> events);

/// "pair 3 (node 4, below)", of pair 2 from 0.
[[nodiscard]] std::string pair_words(const problem& p, std::size_t pair);

/// As --csv has it.
constexpr std::string_view look_name(pair_state look) {
  constexpr std::string_view names[] = {"open", "closed", "at its face"};
  return names[static_cast<std::size_t>(look)];
}

/// Why a path ended where it did.
constexpr std::string_view end_reason(path_status status) {
  constexpr std::string_view reasons[] = {"all load applied", "mechanism",    "cycle",
                                          "iteration limit",  "not factored", "path ended"};
  return reasons[static_cast<std::size_t>(status)];
}

/// A share in at most nine columns, with as many digits as fit. What is less than 1 is never shown as 1,
/// which means the whole load: "1-3e-09".
[[nodiscard]] std::string share_words(double x);

/// "7 digits" of every number of a state, as proved; "10+ digits" where there are more, which depend on the
/// LAPACK in use.
[[nodiscard]] std::string digits_words(const certificate& c);

/// "step 3", or "combination \"ULS 1\"" of one that starts from zero; from 1.
[[nodiscard]] std::string step_words(const problem& p, int step);

/// One line for a whole run, in parts: that it is certified and how closely, or the first step that is not.
/// A path that is not `solved` is not certified as a whole: the steps that are, are named.
[[nodiscard]] std::vector<std::string> certificate_summary(const run_result& r, bool solved);

/// For every step that is not certified a line that says what is wrong, how far off, and which
/// increment toggled which pair away from its face before.
[[nodiscard]] std::vector<std::string> certificate_complaints(const run_result& r);

/// Why a path did not reach its end: step, share of the step, and the pairs that had to do with
/// it. Empty for a path that did.
/// `is_answer`: nothing else leads to an equilibrium that it did not reach.
[[nodiscard]] std::string end_words(const problem& p, const path_end& end, bool is_answer = true);

/// Of a run of both rules: whether the 1989 rule comes to the states of the answer, and what is wrong with
/// those that differ, a line each. Empty for other runs.
[[nodiscard]] std::vector<std::string> rule_1989_words(const run_result& r);

/// The same for every step that was not solved, a line each; of very many the first ones.
[[nodiscard]] std::vector<std::string> end_lines(const problem& p, const path_end& end);

/// A warning where too few digits of the end of a step are left to rely on; empty otherwise.
[[nodiscard]] std::string digit_warning(std::span<const step_record> steps);

/// A warning where, at the end of a step, a beam passes through a face between pairs, and its remedy; empty
/// where it does not.
[[nodiscard]] std::string passage_warning(const problem& p, std::span<const step_record> steps);

/// A warning where a plate's largest stress or moment is where a point load or a [[contact]] pair acts; empty
/// where it is not.
[[nodiscard]] std::string concentration_warning(const problem& p, std::span<const step_record> steps);

/// Of the problem, without file and line, and of the states that the run came to.
[[nodiscard]] std::vector<std::string> warnings_of(const run_result& r);

/// What half the element size changes, in parts; empty where it was not asked for, or not solved.
[[nodiscard]] std::vector<std::string> refinement_words(const run_result& r);

/// What is wrong with the ends of steps, and where the 1989 rule leads the command that follows the
/// problem by the corrected one.
[[nodiscard]] std::vector<std::string> complaints_of(const run_result& r);

/// The same, why the path ended, and warnings but for the problem's.
[[nodiscard]] std::vector<std::string> end_messages(const run_result& r);

}  // namespace contct
