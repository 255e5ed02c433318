#include "contct/results/run.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <span>
#include <stdexcept>
#include <utility>

#include "contct/kernel/registry.hpp"
#include "contct/linear/cholesky.hpp"
#include "contct/number/probe.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/exact_means.hpp"
#include "contct/results/path_states.hpp"
#include "contct/results/rule_1989.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

trace_header header_of_trace(const run_result& r, const kernel_facts& leader) {
  trace_header h = header_for(leader, CONTCT_LISTING_SHA256, lapack_identity());
  h.about = {"every call of " + (r.file == "-"
                                     ? "a problem from standard input"
                                     : on_one_line(std::filesystem::path(r.file).filename().string()))};
  if (!r.what.title.empty()) h.about.push_back(on_one_line(r.what.title));
  return h;
}

run_request with_kernels(run_request r) {
  if (r.both_rules) r.kernels = {"corrected"};
  return r;
}

}  // namespace

std::string_view run_result::status() const {
  return status_name(end.status, equal);
}

const lockstep_on_path* run_result::compared_calls() const {
  if (beside) return &beside->compared;
  return compared ? &*compared : nullptr;
}

const run_recorder& run_result::record_of_calls() const {
  return beside ? beside->record : record;
}

std::string title_of(const problem& p, const std::string& file) {
  const bool named = p.title.find_first_not_of(" \t\r\n") != std::string::npos;
  if (named) return on_one_line(p.title);
  return file == "-" ? "A problem from standard input" : std::filesystem::path(file).filename().string();
}

run::run(const problem& p, const linear_structure& s, run_request request)
    : wanted(with_kernels(std::move(request))), result(p, s) {
  result.file = wanted.file;
  result.kernels = wanted.kernels;
  result.engine = "reference";
  result.facts = {"contct " CONTCT_VERSION, "listing sha256 " CONTCT_LISTING_SHA256,
                  "floating point: " + describe(probe_floating_point())};
  result.date = wanted.date;
  if (wanted.kernels.empty()) return;
  leader_ = make_kernel(wanted.kernels.front());
  leader_facts_ = leader_->facts();
  if (wanted.both_rules)
    result.kernels.insert(result.kernels.end(), kernels_of_1989.begin(), kernels_of_1989.end());
  if (!wanted.free_run && wanted.kernels.size() > 1)
    result.compared.emplace(leader_facts_, std::span(wanted.kernels).subspan(1));
  result.engine = engine_for(leader_facts_, wanted.engine, s);
}

void run::go(const run_outputs& outputs, const std::vector<observer*>& shown) {
  to = outputs;
  result.envelope = wanted.envelope || (to.page != nullptr && starts_from_zero(result.what));
  const bool drawn = to.page != nullptr;
  lockstep_on_path* const compared = result.compared ? &*result.compared : nullptr;
  result.record = run_recorder(
      compared, {.calls = drawn && !wanted.both_rules,
                 .states = leader_ && ((drawn && bytes_of_state(result.what) <= most_bytes_of_page) ||
                                       wanted.pictures || to.increments != nullptr ||
                                       (wanted.envelope && !starts_from_zero(result.what)))});
  certifier proof(result.what, result.structure, exact_means_of(result.what), to.proof != nullptr);
  std::vector<observer*> all;
  if (compared != nullptr) all.push_back(compared);
  all.push_back(&result.early);
  all.insert(all.end(), shown.begin(), shown.end());
  all.push_back(&result.record);
  result.take(leader_ ? follow_leader(all, proof) : proof.find_final_states());
  leader_.reset();  // only one FORTRAN kernel at a time can use unit 26
  const bool has_answer = result.end.status != path_status::not_factored;
  if (wanted.both_rules && has_answer) follow_beside(shown);
  if (const lockstep_on_path* const calls = result.compared_calls()) {
    result.equal = calls->compared().mismatches == 0;
    result.comparison = counts_of(*calls);
  }
}

/// Adds the observers that write unit 26 and the trace of kernel `of`.
void run::add_files_of_calls(const kernel_facts& of, std::vector<observer*>& all) {
  if (to.log != nullptr) all.push_back(&log_.emplace(*to.log));
  if (to.trace != nullptr)
    all.push_back(&trace_.emplace(header_of_trace(result, of),
                                  [this](std::string_view text) { to.trace->write(text); }));
}

void run::follow_beside(std::vector<observer*> shown) {
  add_files_of_calls(facts_of_kernel(kernels_of_1989.front()), shown);
  result.beside = follow_rule_1989(result, wanted, to.log != nullptr || to.trace != nullptr,
                                   {.calls = to.page != nullptr}, shown);
}

solved_path run::follow_leader(std::vector<observer*>& all, certifier& proof) {
  if (!wanted.both_rules) add_files_of_calls(leader_facts_, all);
  return follow(result.what, result.structure, result.engine, *leader_, all, &proof, wanted.max_increments);
}

void run::refine(int halvings) {
  const problem finer = refined(result.what);
  const linear_structure of_finer = structure_of(finer);
  run ends(finer, of_finer, {.file = wanted.file, .kernels = {}});
  ends.go({});
  const bool solved =
      result.end.status == path_status::solved && ends.result.end.status == path_status::solved;
  if (!solved) return;
  result.refined = changes_between(result, ends.result);
  if (halvings < 2 || !std::holds_alternative<plate>(finer.geometry.kind)) return;
  ends.refine(halvings - 1);
  estimate_errors(result.refined, ends.result.refined);
}

void run::find_mesh_errors() {
  if (!std::holds_alternative<beam>(result.what.geometry.kind) || result.what.beds.empty()) return;
  const auto mesh = std::make_shared<const fine_mesh>(finely_divided(result.what));
  for (const solved_step& s : result.record.steps) {
    result.mesh.push_back(mesh_error_of(result.what, mesh, s));
    if (to.proof == nullptr) result.mesh.back().line.reset();  // a line takes much memory
  }
}

const compared_path& run::follow_alone(const std::string& name) {
  const recorded_path own =
      path_of(name, result.what, result.structure, wanted.engine, nullptr, wanted.max_increments);
  const free_run_difference d = compare_paths(
      result, own, free_run_bound(leader_facts_, facts_of_kernel(name)), result.structure.dofs_per_node);
  result.free_runs.push_back({name, d, own.all_certified(),
                              fmt::format("shares of the step within {:.2g}, D within {:.2g} (bound {:.0e})",
                                          d.fraction, d.displacement, d.bound)});
  const compared_path& other = result.free_runs.back();
  result.equal = result.equal && d.within_bound();
  result.comparison += (result.comparison.empty() ? "" : "; ") + name + ": " + other.distances;
  return other;
}

exit_status run::exit() const {
  return status_of(result.end.status, result.equal);
}

void refuse_other_rules(const std::vector<std::string>& kernels) {
  for (const std::string& name : kernels) {
    if (facts_of_kernel(name).rule != contact_rule::listing)
      throw std::invalid_argument(
          fmt::format("--kernels: \"{}\" has the corrected rule, which is not in the listing; allowed: "
                      "kernels with the 1989 rule. To compare the two rules: contct run --free-run "
                      "--kernels {},fortran",
                      name, name));
  }
  if (kernels[0].find(':') != std::string::npos)
    throw std::invalid_argument(
        fmt::format("--kernels: \"{}\" is an external kernel and cannot lead; allowed: a built-in kernel "
                    "first, such as --kernels fortran,{}",
                    kernels[0], kernels[0]));
  if (kernels.size() > 2)
    throw std::invalid_argument(
        fmt::format("--kernels: found {} kernels; allowed: one or two; the first one leads", kernels.size()));
  if (kernels.size() == 2 && kernels[0] == kernels[1])
    throw std::invalid_argument("--kernels: \"" + kernels[0] + "\" is named twice");
}

explained_run::explained_run(const std::vector<std::string>& kernels, increments_wanted wanted,
                             explained_path::sink to)
    : leader(make_kernel(kernels[0])),
      told(leader->facts(), std::span(kernels).subspan(1), wanted, std::move(to)) {}

path_end explained_run::follow(const problem& p, const linear_structure& s, const std::string& engine,
                               observer* shown) {
  std::vector<observer*> watching = {&told, shown};
  std::erase(watching, nullptr);
  return contct::follow(p, s, engine_for(leader->facts(), engine, s), *leader, watching).end;
}

}  // namespace contct
