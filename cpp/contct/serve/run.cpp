// contct_run: the path of a problem with its certificate, and what its options ask for.
#include "contct/session/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/serve/answer.hpp"
#include "contct/serve/serve.h"
#include "contct/write/outputs.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

struct served_request : run_request {
  reach allowed = reach::own_folder;
  bool page = false, log = false, trace = false, proof = false, states = false;
};

served_request read_run_request(const char* options) {
  const request r(options, {"file", "folder", "allow_outside", "kernels", "engine", "final_only", "envelope",
                            "max_increments", "page", "log", "trace", "proof", "states"});
  // One by one: g++ 12 destroys the members of an aggregate twice where a later one throws.
  served_request wanted;
  wanted.file = r.file();
  wanted.kernels = r.texts("kernels", {"fortran", "cpp"});
  wanted.engine = r.text("engine", "");
  wanted.envelope = r.flag("envelope");
  wanted.max_increments = r.whole("max_increments", 0, 0, most_increments);
  wanted.allowed = r.allowed();
  wanted.page = r.flag("page");
  wanted.log = r.flag("log");
  wanted.trace = r.flag("trace");
  wanted.proof = r.flag("proof");
  wanted.states = r.flag("states");
  refuse_unknown_engine(wanted.engine);
  for (const std::string& name : wanted.kernels) {
    if (std::ranges::count(wanted.kernels, name) > 1)
      throw std::invalid_argument(fmt::format("options: kernels: \"{}\" is named twice", name));
    (void)facts_of_kernel(name);
  }
  if (r.flag("final_only")) wanted.kernels.clear();
  if (wanted.kernels.empty() && (wanted.log || wanted.trace))
    throw std::invalid_argument(
        "options: found final_only with log or trace; allowed: a path, which calls kernels");
  wanted.pictures = wanted.states;
  return wanted;
}

/// A file that is kept as a text of the answer.
struct kept_text {
  std::string text = {};
  output_file file{&text};
};

/// What is wrong with the run, as messages.
void tell(const run& run, std::vector<std::string>& messages) {
  const auto add = [&messages](const std::vector<std::string>& lines) {
    messages.insert(messages.end(), lines.begin(), lines.end());
  };
  if (run.result.compared && run.result.compared->first()) add(words_of(*run.result.compared->first()));
  add(end_messages(run.result));
}

void serve_run(const served_request& wanted, const problem& p, served_answer& a) {
  const linear_structure structure = structure_of(p);
  run run(p, structure, static_cast<const run_request&>(wanted));
  if (wanted.kernels.empty() && (wanted.page || wanted.states || wanted.envelope))
    throw std::invalid_argument(
        "options: found final_only with page, states or envelope; allowed: these with a path");
  kept_text result;
  kept_text log;
  kept_text trace;
  kept_text proof;
  kept_text page;
  const auto asked = [](bool flag, kept_text& to) { return flag ? &to.file : nullptr; };
  run.go({&result.file, wanted.states ? result_parts::states : result_parts::ends, asked(wanted.log, log),
          asked(wanted.trace, trace), asked(wanted.proof, proof), asked(wanted.page, page)});
  if (status_of(run.result.end.status) == exit_status::bad_input)
    throw std::invalid_argument(wanted.file + ": " + end_words(p, run.result.end));
  write_outputs(run);
  a.exit = run.exit();
  a.result = std::move(result.text);
  tell(run, a.messages);
  if (wanted.page) a.texts.emplace_back("page", std::move(page.text));
  if (wanted.log) a.texts.emplace_back("log", std::move(log.text));
  if (wanted.trace) a.texts.emplace_back("trace", std::move(trace.text));
  if (wanted.proof) a.texts.emplace_back("proof", std::move(proof.text));
}

}  // namespace
}  // namespace contct

using contct::answered;
using contct::served_answer;

char* contct_run(const char* text, const char* options) {
  return answered([&](served_answer& a) {
    const auto wanted = contct::read_run_request(options);
    const auto p = contct::read_problem_text(text, wanted.file, wanted.allowed, a);
    const std::scoped_lock mine(contct::turn());
    contct::serve_run(wanted, p, a);
  });
}
