// contct_check, contct_exact and contct_explain: what else can be asked of a problem.
#include <fmt/format.h>

#include <mutex>
#include <stdexcept>

#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/read/written_numbers.hpp"
#include "contct/serve/answer.hpp"
#include "contct/serve/serve.h"
#include "contct/session/exact_run.hpp"
#include "contct/session/explained_run.hpp"
#include "contct/write/exact_output.hpp"
#include "contct/write/explain.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

/// Every number of the file with its place, every node, and what the pairs' numbers are called there.
void put_places(json& out, const problem& p, const char* text, const std::string& file) {
  const toml::table document = parse_toml(text, file);
  json& numbers = out["numbers"] = json::array();
  for (const written_number& n : numbers_in(document, text))
    numbers.push_back({{"key", n.key},
                       {"value", n.value},
                       {"whole", n.is_whole},
                       {"line", n.line},
                       {"column", n.column},
                       {"length", n.length}});
  json& pairs = out["pair_list"] = json::array();
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const contact_pair& at = p.pairs[i];
    json pair = {{"pair", i + 1},
                 {"node", at.node + 1},
                 {"surface", surface_name(at.surface)},
                 {"face", at.face},
                 {"stiffness", at.stiffness}};
    if (i < p.keys.size())
      pair.update({{"face_key", p.keys[i].face}, {"stiffness_key", p.keys[i].stiffness}});
    pairs.push_back(std::move(pair));
  }
  if (std::holds_alternative<assembled>(p.geometry.kind)) return;
  json& spots = out["node_list"] = json::array();
  for (int node = 0; node < nodes(p.geometry); ++node) {
    const place at = place_of_node(p.geometry, node);
    spots.push_back({at.x, at.y});
  }
}

void check(const char* text, const char* options, served_answer& a) {
  const request r(options, {"file", "folder", "allow_outside", "places"});
  const problem p = read_problem_text(text, r.file(), r.allowed(), a);
  json out = {{"title", p.title},
              {"kind", std::holds_alternative<beam>(p.geometry.kind)    ? "beam"
                       : std::holds_alternative<plate>(p.geometry.kind) ? "plate"
                                                                        : "matrix"},
              {"nodes", nodes(p.geometry)},
              {"dofs", dofs(p.geometry)},
              {"elements", elements(p.geometry)},
              {"pairs", p.pairs.size()},
              {"steps", json::array()},
              {"units", nullptr}};
  for (const load& step : p.steps) out["steps"].push_back(step.name);
  if (!p.units.length.empty()) out["units"] = {{"length", p.units.length}, {"force", p.units.force}};
  if (r.flag("places")) put_places(out, p, text, r.file());
  a.result = json_text(out);
}

void follow_exact_path(const char* text, const char* options, served_answer& a) {
  const request r(options, {"file", "folder", "allow_outside", "rule", "kernels"});
  const exact_request wanted{r.file(), r.text("rule", "corrected"), r.texts("kernels", {})};
  if (wanted.rule != "corrected" && wanted.rule != "1989")
    throw std::invalid_argument(
        fmt::format("options: rule: found \"{}\"; allowed: corrected, 1989", wanted.rule));
  for (const std::string& name : wanted.kernels) (void)facts_of_kernel(name);
  const problem p = read_problem_text(text, r.file(), r.allowed(), a);
  std::unique_lock mine(turn(), std::defer_lock);
  if (!wanted.kernels.empty()) mine.lock();
  const exact_run run = run_exactly(p, wanted);
  output_file out(&a.result);
  write_exact_json({p, run.exactly, run.path, run.kernels}, out);
  a.exit = status_of(run.path.status);
}

void explain_path(const char* text, const char* options, served_answer& a) {
  const request r(options, {"file", "folder", "allow_outside", "kernels", "engine", "step", "increment"});
  const std::vector<std::string> names = r.texts("kernels", {"fortran", "cpp"});
  const std::string engine = r.text("engine", "refactor");
  refuse_unknown_engine(engine);
  refuse_other_rules(names);
  const problem p = read_problem_text(text, r.file(), r.allowed(), a);
  const increments_wanted wanted{r.whole("step", 0, 1, static_cast<int>(p.steps.size())),
                                 r.whole("increment", 0, 1, most_increments)};
  const std::scoped_lock mine(turn());
  output_file out(&a.result);
  explain_json written({p, names, facts_of_kernel(names.front()).real_bytes, 0}, out);
  explained_run run(names, wanted, [&](const auto& i) { written.write(i); });
  const linear_structure s = structure_of(p);
  const path_end end = run.follow(p, s, engine);
  if (end.status == path_status::not_factored || run.told.explained() == 0)
    throw std::invalid_argument(
        end.status == path_status::solved
            ? fmt::format("{}: no increment is explained: the path has no such one", r.file())
            : r.file() + ": " + end_words(p, end));
  written.finish(status_name(end.status, run.equal()), run.told);
  if (end.status != path_status::solved) a.messages.push_back(r.file() + ": " + end_words(p, end));
  a.exit = status_of(end.status, run.equal());
}

}  // namespace
}  // namespace contct

using contct::answered;
using contct::served_answer;

char* contct_check(const char* text, const char* options) {
  return answered([&](served_answer& a) { contct::check(text, options, a); });
}

char* contct_exact(const char* text, const char* options) {
  return answered([&](served_answer& a) { contct::follow_exact_path(text, options, a); });
}

char* contct_explain(const char* text, const char* options) {
  return answered([&](served_answer& a) { contct::explain_path(text, options, a); });
}
