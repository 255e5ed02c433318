// contct_judge: sends the calls and problems of contct fuzz to a function of the caller.
#include <stdexcept>

#include "app/serve_answer.hpp"
#include "contct/kernel/child_kernel.hpp"
#include "contct/results/random_problem.hpp"
#include "contct/serve/serve.h"

using namespace contct;

char* contct_judge(contct_kernel_function* kernel, const char* options) {
  return answered([&](served_answer& a) {
    const request r(options, {"leader", "name", "calls", "problems", "seed"});
    if (kernel == nullptr) throw std::invalid_argument("kernel: found null; allowed: a function");
    constexpr int most_calls = 2'000'000'000;
    constexpr int most_problems = 10'000'000;
    constexpr int usual_calls = 20'000;
    fuzz_request wanted;
    wanted.kernels = {r.text("leader", "fortran"), r.text("name", "function")};
    wanted.calls = r.whole("calls", usual_calls, 1, most_calls);
    wanted.problems = r.whole("problems", 40, 0, most_problems);
    wanted.seed = static_cast<std::uint64_t>(r.whole("seed", 1989, 0, most_calls));
    const std::scoped_lock mine(turn());
    refuse_name_of_function(wanted.kernels[1]);
    const small_problems problems(wanted.seed);
    const fuzz_run run = run_fuzz(wanted, &problems, nullptr, [&](std::string_view name) {
      return name == wanted.kernels[1] ? make_function_kernel(wanted.kernels[1], kernel) : make_kernel(name);
    });
    const std::string missed = floors_missed(run.result);
    for (const fuzz_follower& f : run.result.followers) a.tell(f.mismatch_reports);
    if (!missed.empty()) a.messages.push_back(missed);
    a.result = fuzz_json(run.result);
    a.exit = run.result.compared().mismatches > 0 ? exit_status::kernels_differ
             : missed.empty()                     ? exit_status::solved
                                                  : exit_status::bad_input;
  });
}
