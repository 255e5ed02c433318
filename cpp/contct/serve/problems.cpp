// contct_check, contct_exact and contct_explain: what else can be asked of a problem.
#include <fmt/format.h>

#include <stdexcept>

#include "contct/certify/certificate.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/read/written_numbers.hpp"
#include "contct/serve/answer.hpp"
#include "contct/serve/exact_run.hpp"
#include "contct/serve/listing_kernels.hpp"
#include "contct/serve/serve.h"
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
  const std::string rule = r.text("rule", "corrected");
  if (rule != "corrected" && rule != "1989")
    throw std::invalid_argument(fmt::format("options: rule: found \"{}\"; allowed: corrected, 1989", rule));
  const std::vector<std::string> names = r.texts("kernels", {});
  for (const std::string& name : names) (void)facts_of_kernel(name);
  const problem p = read_problem_text(text, r.file(), r.allowed(), a);
  const exact_problem exactly = exactly_read(p, r.file());
  const exact_path path = follow_exactly(exactly, rule, r.file());
  std::vector<kernel_digits> kernels;
  if (!names.empty()) {
    const std::scoped_lock mine(turn());
    const linear_structure s = structure_of(p);
    for (const std::string& name : names) kernels.push_back(digits_of_kernel(name, p, s, path));
  }
  output_file out(&a.result);
  write_exact_json({p, exactly, path, kernels}, out);
  a.exit = status_of(path.status);
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
  const std::unique_ptr<kernel> leader = make_kernel(names.front());
  output_file out(&a.result);
  explain_json written({p, names, leader->facts().real_bytes, 0}, out);
  explained_path told(leader->facts(), second_kernel(names), wanted,
                      [&](const auto& i) { written.write(i); });
  const linear_structure s = structure_of(p);
  const path_end end = follow(p, s, engine_for(leader->facts(), engine, s), *leader, {&told});
  if (end.status == path_status::not_factored || told.explained() == 0)
    throw std::invalid_argument(
        end.status == path_status::solved
            ? fmt::format("{}: no increment is explained: the path has no such one", r.file())
            : r.file() + ": " + end_words(p, end));
  const bool equal = told.compared().mismatches == 0;
  written.finish(status_name(end.status, equal), told);
  if (end.status != path_status::solved) a.messages.push_back(r.file() + ": " + end_words(p, end));
  a.exit = status_of(end.status, equal);
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
