#include "contct/lab/problem_campaign.hpp"

#include <memory>

#include "contct/compare/lockstep.hpp"
#include "contct/lab/problem_result.hpp"
#include "contct/lab/random_problem.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct::lab {
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

/// Counts what the leader did and what the lockstep before it found, and keeps the calls up to each
/// follower's first mismatch.
class problem_watcher final : public observer {
 public:
  problem_watcher(problem_in_lockstep& p, const lockstep& compared) : p_(p), compared_(compared) {
    p.each.resize(compared.followers().size());
  }

  void called(const answered_call& c) override {
    p_.count(c.c, c.isep_before);
    calls_.push_back(inputs_of(c));
    for (std::size_t f = 0; f < p_.each.size(); ++f) {
      const follower& asked = compared_.followers()[f];
      p_.each[f].compared = asked.compared;
      if (!asked.difference()) continue;
      p_.each[f].note_difference(c.c, asked);
      if (p_.each[f].first) continue;
      p_.each[f].first = asked.first();
      p_.each[f].calls = calls_;
    }
  }

 private:
  problem_in_lockstep& p_;
  const lockstep& compared_;
  call_sequence calls_;
};

}  // namespace

problem_in_lockstep follow_in_lockstep(std::uint64_t seed, std::uint64_t number, const std::string& leader,
                                       const std::vector<std::string>& followers) {
  const random_problem p = make_random_problem(seed, number, quick_problems());
  const linear_structure s = build(p.geometry, p.supports, p.pairs);
  const std::unique_ptr<kernel> leads = make_kernel(leader);
  problem_in_lockstep out;
  lockstep compared = make_lockstep(leads->facts(), followers);
  problem_watcher watches(out, compared);
  (void)follow_steps(p.geometry, s, p.steps, "refactor", *leads, std::vector<observer*>{&compared, &watches});
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

}  // namespace contct::lab
