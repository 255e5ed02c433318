// Words for statuses, events, certificates and the end of a run, which are the same in every output.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/path/path.hpp"
#include "contct/proof/certificate.hpp"
#include "contct/results/exit_status.hpp"
#include "contct/results/path_observers.hpp"
#include "contct/results/step_results.hpp"
#include "contct/structure/problem.hpp"

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

/// Returns the events as "make 1, break 3".
[[nodiscard]] std::string event_names(std::span<const event> events);

/// Returns "pair 3 (node 4, below)" for pair 2, counted from 0.
[[nodiscard]] std::string pair_words(const problem& p, std::size_t pair);

/// The state of a pair as --csv writes it.
constexpr std::string_view look_name(pair_state look) {
  constexpr std::string_view names[] = {"open", "closed", "at its face"};
  return names[static_cast<std::size_t>(look)];
}

constexpr std::string_view end_reason(path_status status) {
  constexpr std::string_view reasons[] = {"all load applied", "mechanism",    "cycle",
                                          "iteration limit",  "not factored", "path ended"};
  return reasons[static_cast<std::size_t>(status)];
}

/// A share in at most nine characters, with as many digits as fit. A share below 1 is never rounded to 1, the
/// whole load, but written as "1-3e-09".
[[nodiscard]] std::string share_words(double x);

/// Returns the number of digits that are proved for every number of a state: "7 digits". From 10 digits on
/// "10+ digits", because further digits depend on the LAPACK in use.
[[nodiscard]] std::string digits_words(const certificate& c);

/// Returns "step 3", or "combination \"ULS 1\"" if steps start from zero. `step` counts from 1.
[[nodiscard]] std::string step_words(const problem& p, int step);

/// One line for a whole run, in parts: that it is certified, with how many digits, or the first step that is
/// not certified. A run that is not `solved` is not certified; its certified steps are named.
[[nodiscard]] std::vector<std::string> certificate_summary(const run_result& r, bool solved);

/// One line for every step (the first ones of many combinations) that is not certified: the error, the pair
/// that pulls most, and the increment so far in which a pair made or broke contact farthest from its face.
[[nodiscard]] std::vector<std::string> certificate_complaints(const run_result& r);

/// The reason why a path ended early: step, share of the step, and the pairs involved; empty if the path is
/// solved. `is_answer`: the path is the answer of the run, so that the text recommends the corrected rule if
/// the 1989 rule missed an equilibrium.
[[nodiscard]] std::string end_words(const problem& p, const path_end& end, bool is_answer = true);

/// For a run of both rules: lines that tell how the 1989 path ended early, which of its states are wrong (the
/// first ones, a line each), or that its states agree with the answer. Empty for other runs.
[[nodiscard]] std::vector<std::string> rule_1989_words(const run_result& r);

/// Keeps the first 12 lines, because there may be hundreds of combinations.
[[nodiscard]] std::vector<std::string> first_of(std::vector<std::string> lines);

/// The end_words of every step that was not solved, a line each; of many lines only the first ones.
[[nodiscard]] std::vector<std::string> words_of_ends(const problem& p, const path_end& end);

/// A warning if the state at the end of a step has fewer than 5 reliable digits; otherwise empty.
[[nodiscard]] std::string digit_warning(std::span<const solved_step> steps);

/// A warning, with a remedy, if a beam passes through a face between two pairs; otherwise empty.
[[nodiscard]] std::string passage_warning(const problem& p, std::span<const solved_step> steps);

/// A warning if a deflection or slope is too large for the theory of small displacements; otherwise empty.
[[nodiscard]] std::string size_warning(const problem& p, std::span<const solved_step> steps);

/// A warning if the largest stress or moment of a plate is at a point load or a [[contact]] pair; otherwise
/// empty.
[[nodiscard]] std::string concentration_warning(const problem& p, std::span<const solved_step> steps);

/// Returns "node 3 below" for pair `pair`, which counts from 0.
[[nodiscard]] std::string face_words(const problem& p, std::size_t pair);

/// The range of the moment (mx, my or mxy of a plate) with the largest magnitude; null without moments.
[[nodiscard]] const value_range* bending(const problem& p, const std::vector<value_range>& ranges);
/// The largest deflection, moment, contact force and reaction with their places, one line each, of at most
/// `width` columns if `width` is 60 or more. `all`: also shears, moved faces, and the other extremes.
[[nodiscard]] std::vector<std::string> largest_lines(const step_results& r, int width, bool all);
/// The extremes of the parts that the problem watches, a line for each.
[[nodiscard]] std::vector<std::string> watch_lines(const step_results& r);
/// The sums of loads, reactions and contact forces, and the results of each bed and hinge.
[[nodiscard]] std::vector<std::string> sum_lines(const step_results& r);

/// The warnings about the states of the run.
[[nodiscard]] std::vector<std::string> state_warnings(const run_result& r);

/// The warnings of the problem, without file and line, and those of the states of the run.
[[nodiscard]] std::vector<std::string> warnings_of(const run_result& r);

/// The changes in r.refined in words, one part for each kind of number.
[[nodiscard]] std::vector<std::string> refinement_words(const run_result& r);

/// certificate_complaints, with advice: a lower stiffness of a pair, or the command for the corrected rule.
[[nodiscard]] std::vector<std::string> complaints_of(const run_result& r);

/// The lines of complaints_of, the reason why the path ended early, and the warnings about the states.
[[nodiscard]] std::vector<std::string> end_messages(const run_result& r);

/// Tables of the numbers of all pairs, supports, nodes and ends of elements, for --detail.
[[nodiscard]] std::string detail_tables(const step_results& r);

}  // namespace contct
