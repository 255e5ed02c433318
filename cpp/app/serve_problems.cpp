// contct_run, contct_check, contct_exact, contct_explain and contct_certify: functions that take a problem.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "app/serve_answer.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/linear/engine.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/certificate.hpp"
#include "contct/proof/exact_means.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/results/run.hpp"
#include "contct/serve/serve.h"
#include "contct/write/explain.hpp"
#include "contct/write/outputs.hpp"
#include "contct/write/result_json.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

/// Throws std::invalid_argument unless `name` is empty, "auto" or the name of an engine.
void refuse_unknown_engine(const std::string& name) {
  const std::vector<std::string> names = engine_names();
  if (name.empty() || name == "auto" || std::ranges::find(names, name) != names.end()) return;
  throw std::invalid_argument(
      fmt::format("options: engine: found \"{}\"; allowed: auto, {}", name, fmt::join(names, ", ")));
}

/// The options that request further outputs, and the member of run_outputs for each.
constexpr std::pair<const char*, output_file * run_outputs::*> further_outputs[] = {
    {"page", &run_outputs::page},
    {"log", &run_outputs::log},
    {"trace", &run_outputs::trace},
    {"proof", &run_outputs::proof}};

run_request read_run_request(const request& r) {
  // Members are set one by one, because g++ 12 destroys members of an aggregate twice if a later one throws.
  run_request wanted;
  wanted.file = r.file();
  wanted.kernels = r.texts("kernels", {});
  wanted.both_rules = wanted.kernels.empty() && !r.flag("final_only");
  wanted.engine = r.text("engine", "");
  wanted.envelope = r.flag("envelope");
  wanted.max_increments = r.whole("max_increments", 0, 0, most_increments);
  wanted.pictures = r.flag("states");
  refuse_unknown_engine(wanted.engine);
  for (const std::string& name : wanted.kernels) {
    if (std::ranges::count(wanted.kernels, name) > 1)
      throw std::invalid_argument(fmt::format("options: kernels: \"{}\" is named twice", name));
    (void)facts_of_kernel(name);
  }
  if (!r.flag("final_only")) return wanted;
  wanted.kernels.clear();
  if (r.flag("log") || r.flag("trace"))
    throw std::invalid_argument(
        "options: found log or trace with final_only; allowed: log and trace without final_only");
  if (r.flag("page") || wanted.pictures || wanted.envelope)
    throw std::invalid_argument(
        "options: found page, states or envelope with final_only; allowed: page, states and envelope without "
        "final_only");
  return wanted;
}

/// Adds every number of the problem file with its place, and the pairs with the keys of their numbers.
void put_places(json& out, const problem& p, const char* text, const std::string& file) {
  const toml::table document = parse_toml(text, file);
  out["numbers"] = list_of(numbers_in(document, text), [](const written_number& n) -> json {
    return {{"key", n.key},   {"value", n.value},   {"whole", n.is_whole},
            {"line", n.line}, {"column", n.column}, {"length", n.literal.size()}};
  });
  out["pair_list"] = list_of(p.pairs, [&p, i = std::size_t{0}](const contact_pair& at) mutable {
    json pair = pair_json(p, i);
    pair.update({{"face", at.face}, {"stiffness", at.stiffness}});
    if (i < p.keys.size())
      pair.update({{"face_key", p.keys[i].face}, {"stiffness_key", p.keys[i].stiffness}});
    ++i;
    return pair;
  });
}

/// The statuses [pairs] if the request has none: a pair at its face, or beyond it, is in contact.
std::vector<int> statuses_at(const problem& p, const load& l, std::span<const double> displacement) {
  std::vector<int> isep(p.pairs.size(), separated);
  const std::vector<pair_in<double>> pairs = pairs_under(p, l);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (depth_of(pairs[i], pairs[i].seen_in(displacement)) >= 0) isep[i] = in_contact;
  return isep;
}

std::vector<int> statuses_in(const problem& p, const std::vector<double>& closed) {
  std::vector<int> isep(p.pairs.size(), separated);
  for (const double number : closed) {
    // Compared before the conversion, because a double may exceed every integer.
    if (!(number >= 1 && number <= static_cast<double>(p.pairs.size())) || std::floor(number) != number)
      throw std::invalid_argument(
          fmt::format("options: closed: found {}; allowed: pairs from 1 to {}", number, p.pairs.size()));
    isep[static_cast<std::size_t>(number) - 1] = in_contact;
  }
  return isep;
}

/// The states of a request to contct_certify, each at the end of a step.
std::vector<solved_step> read_states(const request& r, const problem& p) {
  const std::vector<std::vector<double>> displacement = r.lists("displacement");
  const std::vector<std::vector<double>> closed = r.lists("closed");
  const std::size_t count = displacement.size();
  if (count == 0 || count > p.steps.size())
    throw std::invalid_argument(
        fmt::format("options: displacement: found {} states; allowed: 1 to {}, one for each of the "
                    "first steps",
                    count, p.steps.size()));
  if (r.has("closed") && closed.size() != count)
    throw std::invalid_argument(fmt::format(
        "options: closed: found {} lists; allowed: {}, one for each state", closed.size(), count));
  std::vector<solved_step> states;
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<double>& u = displacement[i];
    if (std::ssize(u) != dofs(p.geometry))
      throw std::invalid_argument(
          fmt::format("options: displacement: found {} numbers; allowed: {}, one for each dof", u.size(),
                      dofs(p.geometry)));
    states.push_back({{.step = static_cast<int>(i) + 1,
                       .fraction = 1.0,
                       .displacement = u,
                       .isep = closed.empty() ? statuses_at(p, p.steps[i], u) : statuses_in(p, closed[i])}});
  }
  return states;
}

}  // namespace
}  // namespace contct

using namespace contct;

char* contct_run(const char* text, const char* options) {
  return answered([&](served_answer& a) {
    const request r(options,
                    {"file", "folder", "allow_outside", "kernels", "engine", "final_only", "envelope",
                     "max_increments", "page", "log", "trace", "proof", "states", "refine"});
    const run_request wanted = read_run_request(r);
    output_file result(&a.result);
    run_outputs to{&result, wanted.pictures ? result_parts::states : result_parts::ends};
    std::deque<output_file> files;
    for (const auto& [name, file] : further_outputs)
      if (r.flag(name)) to.*file = &files.emplace_back(&a.texts.emplace_back(name, "").second);
    const problem p = r.problem_in(text, a);
    const std::scoped_lock mine(turn());
    const linear_structure structure = structure_of(p);
    run run(p, structure, wanted);
    run.go(to);
    run.find_mesh_errors();
    if (status_of(run.result.end.status) == exit_status::bad_input)
      throw std::invalid_argument(wanted.file + ": " + end_words(p, run.result.end));
    if (r.flag("refine")) run.refine();
    write_outputs(run);
    a.exit = run.exit();
    if (const lockstep* const calls = run.result.compared_calls(); calls != nullptr && calls->first())
      a.tell(words_of(*calls->first()));
    a.tell(end_messages(run.result));
  });
}

char* contct_check(const char* text, const char* options) {
  return answered([&](served_answer& a) {
    const request r(options, {"file", "folder", "allow_outside", "places"});
    const problem p = r.problem_in(text, a);
    json out = {{"title", p.title},
                {"kind", std::holds_alternative<beam>(p.geometry.kind)    ? "beam"
                         : std::holds_alternative<plate>(p.geometry.kind) ? "plate"
                                                                          : "matrix"},
                {"nodes", nodes(p.geometry)},
                {"dofs", dofs(p.geometry)},
                {"elements", elements(p.geometry)},
                {"pairs", p.pairs.size()},
                {"steps", json::array()},
                {"units", units_json(p.units)}};
    for (const load& step : p.steps) out["steps"].push_back(step.name);
    for (int node = 0; node < nodes(p.geometry) && !std::holds_alternative<assembled>(p.geometry.kind);
         ++node) {
      const place at = place_of_node(p.geometry, node);
      out["x"].push_back(at.x);
      if (std::holds_alternative<plate>(p.geometry.kind)) out["y"].push_back(at.y);
    }
    if (r.flag("places")) put_places(out, p, text, r.file());
    a.result = json_text(out);
  });
}

char* contct_exact(const char* text, const char* options) {
  return answered([&](served_answer& a) {
    const request r(options, {"file", "folder", "allow_outside", "rule", "kernels"});
    const std::string rule = r.text("rule", "corrected");
    const std::vector<std::string> kernels = r.texts("kernels", {});
    if (rule != "corrected" && rule != "1989")
      throw std::invalid_argument(fmt::format("options: rule: found \"{}\"; allowed: corrected, 1989", rule));
    for (const std::string& name : kernels) (void)facts_of_kernel(name);
    const problem p = r.problem_in(text, a);
    std::unique_lock mine(turn(), std::defer_lock);
    if (!kernels.empty()) mine.lock();
    const exact_run run = run_exactly(p, r.file(), rule, kernels);
    output_file out(&a.result);
    write_exact_json(run, out);
    a.exit = status_of(run.path.status());
  });
}

char* contct_explain(const char* text, const char* options) {
  return answered([&](served_answer& a) {
    const request r(options, {"file", "folder", "allow_outside", "kernels", "engine", "step", "increment"});
    const std::vector<std::string> names = r.texts("kernels", {"fortran", "cpp"});
    const std::string engine = r.text("engine", "refactor");
    refuse_unknown_engine(engine);
    refuse_other_rules(names);
    const problem p = r.problem_in(text, a);
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
              ? fmt::format("{}: found no increment to explain: the path has no increment of this number",
                            r.file())
              : r.file() + ": " + end_words(p, end));
    written.finish(status_name(end.status, run.equal()), run.told);
    for (const std::string& line : words_of_ends(p, end)) a.messages.push_back(r.file() + ": " + line);
    a.exit = status_of(end.status, run.equal());
  });
}

char* contct_certify(const char* text, const char* options) {
  return answered([&](served_answer& a) {
    const request asked(options, {"file", "folder", "allow_outside", "displacement", "closed"});
    const problem p = asked.problem_in(text, a);
    const linear_structure s = structure_of(p);
    std::vector<solved_step> states = read_states(asked, p);
    run_result r(p, s);
    certifier proof(p, s, exact_means_of(p));
    r.engine = "given";
    for (solved_step& given : states) {
      const std::unique_ptr<stiffness_engine> factored = make_engine("refactor", s);
      for (std::size_t pair = 0; pair < p.pairs.size(); ++pair)
        if (given.closed(pair) != p.pairs[pair].closed)
          factored->switch_spring(static_cast<int>(pair), given.closed(pair));
      r.end.step = given.step;
      given.rcond = factored->reciprocal_condition();
      given.judged = proof.certificate_of(given);
      proof.complete(given);
    }
    r.record.take(std::move(states));
    output_file out(&a.result);
    write_result(r, out);
    a.tell(certificate_complaints(r));
    a.exit = r.all_certified() ? exit_status::solved : exit_status::uncertified;
  });
}
