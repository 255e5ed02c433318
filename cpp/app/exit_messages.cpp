#include "app/exit_messages.hpp"

#include <fmt/format.h>

#include "contct/matrix/cholesky.hpp"
#include "contct/write/words.hpp"

namespace contct::app {
namespace {

std::string pair_words(const problem& p, const std::vector<int>& pairs) {
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

}  // namespace

std::string end_words(const problem& p, const path_end& end) {
  const std::string where = fmt::format("step {}, at share {:.9g} of its load: ", end.step, end.fraction);
  switch (end.status) {
    case path_status::solved:
      return "";
    case path_status::mechanism:
      if (end.pairs.empty()) {
        return where +
               "no equilibrium: supports and closed pairs do not hold the structure, which is free to move "
               "as a rigid body. A structure held only by pairs must start with enough of them in contact; "
               "--kernels "
               "corrected follows one that first falls onto its faces";
      }
      return where + "no equilibrium: the opening of " + pair_words(p, end.pairs) +
             " left the structure free to move as a rigid body" +
             (end.fraction < 1e-9 ? ". At a standstill the 1989 rule may pass by an equilibrium that exists"
                                  : "");
    case path_status::cycle:
      return where + "a cycle at a standstill: these pairs keep toggling: " + pair_words(p, end.pairs);
    case path_status::iteration_limit:
      return where + "the limit of increments (--max-increments) is reached; these pairs keep toggling: " +
             (end.pairs.empty() ? "none" : pair_words(p, end.pairs));
    case path_status::not_factored:
      return where +
             "the structure is held, but its stiffness is too ill-conditioned, or its loads too large, for "
             "double precision: no digit of the answer would be right. Use fewer elements in a span, or "
             "stiffness and loads of less extreme size";
  }
  return "";
}

exit_status status_of(path_status status) {
  switch (status) {
    case path_status::solved:
      return exit_status::solved;
    case path_status::mechanism:
      return exit_status::mechanism;
    case path_status::not_factored:
      return exit_status::bad_input;
    default:
      return exit_status::iteration_limit;
  }
}

void digit_watch::step_ended(const step_state& s) {
  if (digits_left(s.rcond) >= fewest_) return;
  fewest_ = digits_left(s.rcond);
  step_ = s.step;
  rcond_ = s.rcond;
}

std::string digit_watch::warning() const {
  constexpr int enough = 5;
  if (fewest_ >= enough) return "";
  return fmt::format(
      "step {}: {} of the answer can be relied on: the stiffness is ill-conditioned (rcond {:.1e}). Fewer "
      "elements in a "
      "span, or more supports, would help",
      step_,
      fewest_ == 0   ? "no digit"
      : fewest_ == 1 ? "about 1 digit"
                     : fmt::format("about {} digits", fewest_),
      rcond_);
}

}  // namespace contct::app
