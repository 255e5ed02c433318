#include "contct/session/run.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <span>
#include <utility>

#include "contct/exact/exact_means.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/numeric/probe.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/pictures.hpp"
#include "contct/write/result_json.hpp"
#include "contct/write/words.hpp"

namespace contct::session {
namespace {

trace_header header_of_trace(const run& r, const kernel_facts& leader) {
  trace_header h = header_for(leader, CONTCT_LISTING_SHA256, lapack_identity());
  const std::string& file = r.wanted.file;
  h.about = {"every call of " + (file == "-" ? "a problem from standard input"
                                             : on_one_line(std::filesystem::path(file).filename().string()))};
  if (!r.what.title.empty()) h.about.push_back(on_one_line(r.what.title));
  return h;
}

}  // namespace

run::run(const problem& p, const linear_structure& s, run_request request)
    : what(p), structure(s), wanted(std::move(request)), judged(p, s, exact::exact_means_of(p)) {
  if (wanted.kernels.empty()) return;
  leader_ = make_kernel(wanted.kernels.front());
  leader_facts_ = leader_->facts();
  if (!wanted.free_run && wanted.kernels.size() > 1)
    compared_.emplace(leader_facts_, std::span(wanted.kernels).subspan(1));
  engine = engine_for(leader_facts_, wanted.engine, s);
}

void run::go(const run_outputs& to, const std::vector<observer*>& shown) {
  to_ = to;
  record_ = run_recorder(compared(), to.page != nullptr);
  if (to.proof != nullptr) judged.keep_proofs();
  std::vector<observer*> all;
  if (compared_) all.push_back(&*compared_);
  all.insert(all.end(), {&judged, &early});
  all.insert(all.end(), shown.begin(), shown.end());
  if (to.log != nullptr) all.push_back(&log_.emplace(*to.log));
  all.push_back(&record_);
  end = leader_ ? follow_leader(all) : judged.find_final_states(all);
  if (compared_) compares = {compared_->compared().mismatches == 0, counts_of(*compared_)};
  if (own_path_) own_path_->end = end;
  leader_.reset();  // one FORTRAN kernel at a time has unit 26
}

path_end run::follow_leader(std::vector<observer*>& all) {
  if (to_.trace != nullptr)
    all.push_back(&trace_.emplace(header_of_trace(*this, leader_facts_),
                                  [this](std::string_view text) { to_.trace->write(text); }));
  if (wanted.pictures || wanted.envelope || to_.page != nullptr || to_.table != nullptr) keep_states(all);
  if (wanted.free_run) all.push_back(&own_path_.emplace());
  return follow_with(engine, *leader_, all, judged);
}

void run::keep_states(std::vector<observer*>& all) {
  const bool forces_by_law = leader_facts_.rule != contact_rule::listing;
  all.push_back(&frames_.emplace(structure, loads_of(what, structure), forces_by_law, wanted.kept));
  if (wanted.envelope) {
    extremes_.emplace(what);
    frames_->show_each_to([this](const frame& f) { extremes_->take(f); });
  }
  if (to_.table == nullptr) return;
  frames_->solve_each();
  all.push_back(&tables_.emplace(what, compared(), *frames_, wanted.watched, *to_.table, to_.pairs));
}

path_end run::follow_with(const std::string& engine_name, kernel& leader, const std::vector<observer*>& all,
                          certifier& judge) const {
  return follow(what, structure, engine_name, leader, all, {wanted.max_increments, judge.ends()});
}

run::other_path run::follow_alone(const std::string& name) {
  path_record own;
  certifier judge(what, structure, exact::exact_means_of(what));
  const kernel_facts facts = facts_of_kernel(name);
  own.end =
      follow_with(engine_for(facts, wanted.engine, structure), *make_kernel(name), {&judge, &own}, judge);
  const free_run_difference d =
      compare_paths(*own_path_, own, free_run_bound(leader_facts_, facts), structure.dofs_per_node);
  other_path other{d, judge.all_certified(),
                   fmt::format("shares of the step within {:.2g}, D within {:.2g} (bound {:.0e})", d.fraction,
                               d.displacement, d.bound)};
  free_runs_.push_back({name, d, other.certified});
  compares.equal = compares.equal && d.within_bound();
  compares.words += (compares.words.empty() ? "" : "; ") + name + ": " + other.words;
  return other;
}

void run::finish() {
  const run_result r = result();
  if (to_.result != nullptr) write_result(r, *to_.result, to_.parts);
  for (output_file* const file : {to_.log, to_.trace})
    if (file != nullptr) file->finish();
  if (tables_) tables_->finish();
  const auto write_all = [](output_file& file, const std::string& text) {
    file.write(text);
    file.finish();
  };
  if (to_.proof != nullptr) write_all(*to_.proof, proof_json(what, judged));
  if (to_.page != nullptr) write_all(*to_.page, run_page(r));
}

run_result run::result() const {
  return {.what = what,
          .record = record_,
          .judged = judged,
          .early = early,
          .end = end,
          .file = wanted.file,
          .kernels = wanted.kernels,
          .engine = engine,
          .compared = compared(),
          .free_runs = free_runs_,
          .equal = compares.equal,
          .comparison = compares.words,
          .facts = {"contct " CONTCT_VERSION, "listing sha256 " CONTCT_LISTING_SHA256,
                    "floating point: " + describe(probe_floating_point())},
          .date = wanted.date,
          .all_increments = extremes(),
          .frames = frames_ ? std::span<const frame>(frames_->frames()) : std::span<const frame>()};
}

std::string run::status() const {
  return std::string(compares.equal ? status_name(end.status) : "kernels-disagree");
}

exit_status run::exit() const {
  return compares.equal ? status_of(end.status) : exit_status::kernels_differ;
}

}  // namespace contct::session
