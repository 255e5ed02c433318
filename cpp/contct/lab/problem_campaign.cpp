#include "contct/lab/problem_campaign.hpp"

#include <memory>
#include <utility>

#include "contct/compare/follower.hpp"
#include "contct/lab/problem_result.hpp"
#include "contct/lab/random_problem.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct {
namespace {

/// Problems small enough that thousands of them are quick.
random_problem_kind quick_problems() {
  random_problem_kind kind;
  kind.most_elements = 16;
  kind.most_lines = 4;
  return kind;
}

call_inputs<double> inputs_of(const answered_call& c) {
  call_inputs<double> in;
  in.dd.assign(c.c.dd.begin(), c.c.dd.end());
  in.dtest.assign(c.c.dtest.begin(), c.c.dtest.end());
  in.cc.assign(c.c.cc.begin(), c.c.cc.end());
  in.id.assign(c.c.id.begin(), c.c.id.end());
  in.isep.assign(c.isep_before.begin(), c.isep_before.end());
  in.isurf.assign(c.c.isurf.begin(), c.c.isurf.end());
  in.dof = c.c.dof;
  return in;
}

/// Puts every call to the followers, counts what the leader decided, and keeps a follower's calls up to its
/// first divergence.
class problem_watcher final : public observer {
 public:
  problem_watcher(problem_in_lockstep& p, kernel_facts leader, const std::vector<std::string>& followers)
      : p_(p), leader_(std::move(leader)), p_each_(p.each) {
    for (const std::string& name : followers) kernels_.push_back(make_kernel(name));
    p.each.resize(followers.size());
  }

  void called(const answered_call& c) override {
    ++p_.calls;
    p_.branches.count(c.c, c.isep_before);
    count_toggles(c.c, c.isep_before, p_.events);
    all_calls_.push_back(inputs_of(c));
    for (std::size_t f = 0; f < kernels_.size(); ++f) ask(*kernels_[f], c, p_each_[f]);
  }

 private:
  void ask(kernel& follower, const answered_call& c, followed_problem& its) {
    const auto text = leader_.has_text ? std::optional(c.text) : std::nullopt;
    const auto found = put_to(follower, c.c, c.isep_before, text, text_equality_of(leader_, follower.facts()),
                              answered_, its.compared);
    if (!found) return;
    its.near.take_in(c.c, answered_, *found);
    if (its.first) return;
    its.first = mismatch_report{p_.calls, leader_.name, follower.facts().name, *found,
                                decisions_of(c.c, c.isep_before, leader_.real_bytes)};
    its.calls_up_to_it = all_calls_;
  }

  problem_in_lockstep& p_;
  kernel_facts leader_;
  std::vector<followed_problem>& p_each_;
  std::vector<std::unique_ptr<kernel>> kernels_;
  call_sequence all_calls_;
  call_outputs answered_;
};

}  // namespace

problem_in_lockstep follow_in_lockstep(std::uint64_t seed, std::uint64_t number, const std::string& leader,
                                       const std::vector<std::string>& followers) {
  const random_problem p = make_random_problem(seed, number, quick_problems());
  const linear_structure s = build(p.geometry, p.supports, p.pairs);
  const std::unique_ptr<kernel> leads = make_kernel(leader);
  problem_in_lockstep out;
  problem_watcher watches(out, leads->facts(), followers);
  (void)follow_steps(p.geometry, s, p.steps, "refactor", *leads, std::vector<observer*>{&watches});
  return out;
}

bool certified_as_leader(std::uint64_t seed, std::uint64_t number, const std::string& leader,
                         const std::string& follower) {
  const random_problem p = make_random_problem(seed, number, quick_problems());
  const verdict leads = try_problem(p, *make_kernel(leader)).came_to;
  if (leads != verdict::certified && leads != verdict::no_equilibrium) return true;
  try {
    return try_problem(p, *make_kernel(follower)).came_to == leads;
  } catch (const kernel_failure&) {
    return false;
  }
}

}  // namespace contct
