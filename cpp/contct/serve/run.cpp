// contct_run: the path of a problem with its certificate, and what its options ask for.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "contct/certify/certificate.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/exact/exact_follower.hpp"
#include "contct/exact/exact_residual.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/matrix/lapack_identity.hpp"
#include "contct/numeric/probe.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/serve/answer.hpp"
#include "contct/serve/serve.h"
#include "contct/serve/states.hpp"
#include "contct/write/pictures.hpp"
#include "contct/write/proof_json.hpp"
#include "contct/write/result_json.hpp"
#include "contct/write/run_words.hpp"
#include "contct/write/words.hpp"

namespace contct::serve {
namespace {

struct run_request {
  std::string file;
  reach allowed;
  std::vector<std::string> kernels;  // the leader first; none: only the ends of the steps
  std::string engine;
  int max_increments;
  bool envelope, page, log, trace, proof, states;

  [[nodiscard]] bool wants_frames() const { return page || states || envelope; }
};

run_request read_run_request(const char* options) {
  const request r(options, {"file", "folder", "allow_outside", "kernels", "engine", "final_only", "envelope",
                            "max_increments", "page", "log", "trace", "proof", "states"});
  constexpr int most_increments = 1'000'000'000;
  run_request wanted{r.file(),
                     r.allowed(),
                     r.texts("kernels", {"fortran", "cpp"}),
                     r.text("engine", ""),
                     r.whole("max_increments", 0, 0, most_increments),
                     r.flag("envelope"),
                     r.flag("page"),
                     r.flag("log"),
                     r.flag("trace"),
                     r.flag("proof"),
                     r.flag("states")};
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
  return wanted;
}

std::vector<std::string> facts() {
  return {"contct " CONTCT_VERSION, "listing sha256 " CONTCT_LISTING_SHA256,
          "floating point: " + describe(probe_floating_point())};
}

struct log_keeper final : observer {
  explicit log_keeper(std::string& text) : out(text) {}
  void called(const answered_call& c) override { out += c.text; }
  std::string& out;
};

/// A problem with what watches its path.
class served_run {
 public:
  served_run(const run_request& wanted, const problem& p, answer& a)
      : wanted_(wanted),
        p_(p),
        a_(a),
        judged_(p, structure_, exact::exact_residual_of(p), exact::semidefinite_test_of(p)) {
    if (wanted.proof) judged_.keep_proofs();
  }

  void go() {
    if (wanted_.kernels.empty()) return finish(find_ends(), nullptr);
    const std::unique_ptr<kernel> leader = make_kernel(wanted_.kernels.front());
    lockstep compared = make_lockstep(leader->facts(), std::span(wanted_.kernels).subspan(1));
    lockstep* const watched = wanted_.kernels.size() > 1 ? &compared : nullptr;
    engine_ = engine_for(leader->facts(), wanted_.engine, structure_);
    std::vector<observer*> all = observers(watched);
    if (wanted_.wants_frames()) watch_states(all, watched, leader->facts());
    log_keeper log(log_);
    if (wanted_.log) all.push_back(&log);
    std::optional<trace_recorder> trace;
    if (wanted_.trace) {
      trace_header h = header_for(leader->facts(), CONTCT_LISTING_SHA256, lapack_identity());
      h.about = {"every call of " + on_one_line(std::filesystem::path(wanted_.file).filename().string())};
      if (!p_.title.empty()) h.about.push_back(on_one_line(p_.title));
      all.push_back(&trace.emplace(h, [this](std::string_view text) { trace_ += text; }));
    }
    const path_end end =
        follow(p_, structure_, engine_, *leader, all,
               {wanted_.max_increments, judged_.fallback(), judged_.refiner(), exact::exact_follower_of(p_)});
    finish(end, watched);
  }

 private:
  /// In the order in which they must observe.
  std::vector<observer*> observers(lockstep* compared) {
    std::vector<observer*> all = {compared, &judged_,
                                  &early_,  &json_.emplace(p_, wanted_.kernels, engine_, judged_, result_),
                                  &digits_, &passages_};
    std::erase(all, nullptr);
    return all;
  }

  void watch_states(std::vector<observer*>& all, const lockstep* compared, const kernel_facts& leader) {
    frame_limits limits;
    limits.refined = wanted_.page || wanted_.envelope;
    all.push_back(&frames_.emplace(structure_, loads_of(p_, structure_), leader.rule != "listing", limits));
    all.push_back(&record_.emplace(compared));
    if (!wanted_.envelope) return;
    extremes_.emplace(p_);
    frames_->show_each_to([this](const frame& f) { extremes_->take(f); });
  }

  path_end find_ends() {
    engine_ = "reference";
    std::vector<observer*> all = observers(nullptr);
    if (wanted_.wants_frames())
      throw std::invalid_argument(
          "options: found final_only with page, states or envelope; allowed: these with a path");
    return find_final_states(structure_, static_cast<int>(p_.steps.size()), loads_of(p_, structure_), all,
                             &judged_, exact::exact_follower_of(p_));
  }

  void finish(const path_end& end, const lockstep* compared) {
    const bool equal = compared == nullptr || compared->compared().mismatches == 0;
    const bool solved = end.status == path_status::solved;
    const std::string words = end_words(p_, end);
    if (status_of(end.status) == exit_status::bad_input)
      throw std::invalid_argument(wanted_.file + ": " + words);
    const std::string status(equal ? status_name(end.status) : "kernels-disagree");
    const envelope* const extremes = extremes_ ? &*extremes_ : nullptr;
    json_->finish(status, end, compared, extremes);
    a_.result = std::move(text_);
    a_.exit = !equal ? exit_status::kernels_differ : status_of(end.status);
    if (!equal && compared->first()) tell(words_of(*compared->first()));
    tell(certificate_complaints(p_, judged_, early_));
    if (!solved) a_.messages.push_back(wanted_.file + ": " + words);
    for (const std::string& w : {solved ? digits_.warning() : "", passages_.warning()})
      if (!w.empty()) a_.messages.push_back("warning: " + w);
    if (wanted_.page || wanted_.states) draw({status, words, compared, equal, extremes});
    if (wanted_.log) a_.texts.emplace_back("log", std::move(log_));
    if (wanted_.trace) a_.texts.emplace_back("trace", std::move(trace_));
    if (wanted_.proof) a_.texts.emplace_back("proof", proof_json(p_, judged_));
  }

  struct outcome {
    std::string status, words;
    const lockstep* compared;
    bool equal;
    const envelope* extremes;
  };

  void draw(const outcome& o) {
    const std::string comparison = o.compared == nullptr ? "" : counts_of(*o.compared);
    const finished_run r{p_,
                         *frames_,
                         *record_,
                         judged_,
                         early_,
                         wanted_.file,
                         wanted_.kernels,
                         engine_,
                         o.status,
                         o.words,
                         o.compared != nullptr,
                         o.equal,
                         comparison,
                         facts(),
                         "",
                         o.extremes};
    if (wanted_.page) a_.texts.emplace_back("page", run_page(r));
    if (wanted_.states) a_.texts.emplace_back("states", states_json(r));
  }

  void tell(const std::vector<std::string>& lines) {
    a_.messages.insert(a_.messages.end(), lines.begin(), lines.end());
  }

  const run_request& wanted_;
  const problem& p_;
  answer& a_;
  linear_structure structure_ = structure_of(p_);
  certifier judged_;
  early_toggles early_;
  digit_watch digits_;
  passage_watch passages_{p_};
  std::string engine_, text_, log_, trace_;
  output_file result_{&text_};
  std::optional<result_json> json_;
  std::optional<frame_keeper> frames_;  // these three for pictures and the envelope
  std::optional<run_record> record_;
  std::optional<envelope> extremes_;
};

}  // namespace
}  // namespace contct::serve

using contct::serve::answer;
using contct::serve::answered;

char* contct_run(const char* text, const char* options) {
  return answered([&](answer& a) {
    const auto wanted = contct::serve::read_run_request(options);
    const auto p = contct::serve::read_problem_text(text, wanted.file, wanted.allowed, a);
    const std::scoped_lock mine(contct::serve::turn());
    contct::serve::served_run(wanted, p, a).go();
  });
}
