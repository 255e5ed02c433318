#include "contct/write/run_words.hpp"

#include <fmt/format.h>

#include "contct/matrix/cholesky.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace {

std::string words_of_pairs(const problem& p, const std::vector<int>& pairs) {
  constexpr std::size_t most_named = 8;
  std::string words;
  for (std::size_t i = 0; i < pairs.size() && i < most_named; ++i) {
    const contact_pair& at = p.pairs[static_cast<std::size_t>(pairs[i])];
    words += fmt::format("{}pair {} ({}, {})", i == 0 ? "" : ", ", pairs[i] + 1,
                         place_words(p.geometry, at.node), surface_name(at.surface));
  }
  if (pairs.size() > most_named) words += fmt::format(" and {} more", pairs.size() - most_named);
  return words;
}

std::string mechanism_words(const problem& p, const path_end& end) {
  if (end.pairs.empty())
    return "no equilibrium: the structure is a mechanism: its supports and pairs allow a rigid-body motion "
           "that the load of this step drives and nothing stops. Add a support, or a pair in its way";
  return "no equilibrium: when " + words_of_pairs(p, end.pairs) +
         " separated, the structure became a mechanism";
}

/// Why nothing holds the structure, of which no proof says that there is no equilibrium.
std::string loose_words(const problem& p, const path_end& end) {
  if (!end.pairs.empty())
    return "when " + words_of_pairs(p, end.pairs) + " separated, nothing held the structure";
  return end.by_1989_rule
             ? "the supports and the pairs in contact at the start do not hold the structure, which "
               "the 1989 rule needs"
             : "the supports and the pairs in contact do not hold the structure";
}

/// Whether there is an equilibrium that the path did not reach, and what reaches it.
std::string verdict_words(const path_end& end) {
  if (!end.has_equilibrium)
    return ". Whether there is an equilibrium under the load of this step is not decided";
  if (!*end.has_equilibrium) return ". There is no equilibrium under the load of this step";
  return std::string(". There is an equilibrium under the load of this step") +
         (end.by_1989_rule ? ": --kernels corrected leads to it" : "");
}

}  // namespace

std::string end_words(const problem& p, const path_end& end) {
  const std::string where = fmt::format("step {}, at share {:.9g} of its load: ", end.step, end.fraction);
  switch (end.status) {
    case path_status::solved:
      return "";
    case path_status::mechanism:
      return where + mechanism_words(p, end);
    case path_status::cycle:
      return where + "a cycle at constant load: these pairs change their status again and again: " +
             words_of_pairs(p, end.pairs) + verdict_words(end);
    case path_status::iteration_limit:
      return where + "the limit of increments (--max-increments) is reached" +
             (end.pairs.empty() ? ""
                                : "; these pairs change their status again and again: " +
                                      words_of_pairs(p, end.pairs) + verdict_words(end));
    case path_status::path_ended:
      return where + "the path ended: " + loose_words(p, end) + verdict_words(end);
    default:
      return where +
             "the structure is held, but its stiffness is too ill-conditioned, or its loads too large, for "
             "double precision: no digit of the answer would be right. Use fewer elements in a span, or "
             "stiffness and loads of less extreme size";
  }
}

exit_status status_of(path_status status) {
  constexpr exit_status statuses[] = {exit_status::solved,          exit_status::mechanism,
                                      exit_status::iteration_limit, exit_status::iteration_limit,
                                      exit_status::bad_input,       exit_status::iteration_limit};
  return statuses[static_cast<int>(status)];  // in the order of path_status
}

std::string passage_warning(const problem& p, std::span<const step_record> steps) {
  const load_path loads(p);
  std::optional<passage> worst;
  int step = 0;
  for (const step_record& s : steps) {
    const auto here = deepest_passage(p, loads.at(s.end.step, s.end.fraction), s.end.displacement);
    if (!here || (worst && here->depth <= worst->depth)) continue;
    worst = here;
    step = s.end.step;
  }
  if (!worst) return "";
  const contact_pair& left = p.pairs[worst->first];
  return fmt::format(
      "step {}: between pairs {} and {} the beam passes through the face at {:g} that both have, by {:.2g} "
      "at x = {:.6g}. Where these are separate stops, this is as it should be; where one surface runs "
      "between "
      "them, put pairs closer together (at the nodes of a finer mesh: element_size)",
      step, worst->first + 1, worst->second + 1, left.face, worst->depth, worst->x);
}

std::string digit_warning(std::span<const step_record> steps) {
  int fewest = 5;  // a state with as many needs no warning
  const step_record* worst = nullptr;
  for (const step_record& s : steps) {
    // Refined states, and those of the exact path, keep their digits.
    if (s.end.numbers || s.end.from_exact_path || digits_left(s.rcond) >= fewest) continue;
    fewest = digits_left(s.rcond);
    worst = &s;
  }
  if (worst == nullptr) return "";
  const std::string digits = fewest == 0   ? "no digit"
                             : fewest == 1 ? "about 1 digit"
                                           : fmt::format("about {} digits", fewest);
  return fmt::format(
      "step {}: {} of the answer can be relied on: the stiffness is ill-conditioned (rcond {:.1e}). Use "
      "fewer elements in a span, or more supports",
      worst->end.step, digits, worst->rcond);
}

std::vector<std::string> complaints_of(const run_result& r) {
  std::vector<std::string> lines = certificate_complaints(r.what, r.judged, r.early);
  const std::string remedy = remedy_words(r.kernels, r.file);
  if (!lines.empty() && !remedy.empty()) lines.push_back(remedy);
  return lines;
}

std::vector<std::string> end_messages(const run_result& r) {
  std::vector<std::string> lines = complaints_of(r);
  const std::string why = end_words(r.what, r.end);
  if (!why.empty()) lines.push_back(r.file + ": " + why);
  for (const std::string& w :
       {why.empty() ? digit_warning(r.record.steps) : "", passage_warning(r.what, r.record.steps)})
    if (!w.empty()) lines.push_back("warning: " + w);
  return lines;
}

}  // namespace contct::write
