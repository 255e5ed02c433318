#include "contct/exact/exact_follower.hpp"

#include <memory>
#include <stdexcept>

#include "contct/exact/exact_residual.hpp"
#include "contct/exact/path.hpp"

namespace contct::exact {
namespace {

path::followed_step step_of(const exact_path& followed, std::size_t number) {
  const exact_step_end& end = followed.steps[number];
  path::followed_step s{path_status::solved, {}, numeric::rounded(end.fraction), {}, end.closed};
  if (number + 1 == followed.steps.size()) s.status = followed.status;
  bool snaps = false;
  for (const exact_increment& i : end.increments) {
    s.increments.push_back({numeric::rounded(i.fraction), i.events, snaps, i.at});
    snaps = i.snaps;
  }
  for (const rational& u : end.displacement) s.displacement.push_back(numeric::rounded(u));
  return s;
}

exact_path follow(const problem& p) {
  std::optional<exact_problem> exactly = small_exact_problem_of(p);
  if (!exactly) return {};
  exactly->longest = most_bits_beside_doubles;
  try {
    return follow_true_path(*exactly);
  } catch (const std::runtime_error&) {  // numbers are too long, or statuses cannot be decided
    return {};
  }
}

}  // namespace

path::exact_follower exact_follower_of(const problem& p) {
  return [&p, followed = std::shared_ptr<const exact_path>()](int step) mutable {
    std::optional<path::followed_step> found;
    if (!followed) followed = std::make_shared<const exact_path>(follow(p));
    const auto number = static_cast<std::size_t>(step) - 1;
    if (number >= followed->steps.size()) return found;
    found = step_of(*followed, number);
    if (found->status != path_status::solved && found->status != path_status::mechanism) found.reset();
    return found;
  };
}

}  // namespace contct::exact
