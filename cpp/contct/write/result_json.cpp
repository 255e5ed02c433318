#include "contct/write/result_json.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "contct/number/decimal.hpp"
#include "contct/results/envelope.hpp"
#include "contct/results/path_states.hpp"
#include "contct/results/quantities.hpp"
#include "contct/results/rule_1989.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

/// The rows of the table of quantities that a problem has: key, words, unit and list.
json quantities_json(const problem& p) {
  json out = json::array();
  for (const quantity_row* row : quantities_of(p))
    out.push_back({{"key", row->key},
                   {"words", row->words},
                   {"unit", unit_name(p, row->in)},
                   {"on", list_of(row->where).name}});
  return out;
}

json extremes_json(const model& m, const std::vector<value_range>& ranges) {
  json out = json::object();
  for (const value_range& r : ranges) out[std::string(r.name)] = range_json(m, r);
  return out;
}

/// The lines of a piece as polynomials in t, the share of the piece's length.
json piece_json(const element_line& line) {
  const auto polynomial = [](const line_polynomial<double>& p) {
    return json(std::vector(p.begin(), p.end()));
  };
  json piece = {{"x", {line.left, line.right}}};
  for (const line_row& row : along_beam) piece[row.key] = polynomial(line.*row.polynomial);
  return piece;
}

/// An element and, unless `m` is null, the coordinates of its nodes.
json element_json(const model* m, std::size_t e) {
  json entry = {{"element", e + 1}};
  if (m == nullptr) return entry;
  for (const int node : nodes_of_element(*m, static_cast<int>(e))) {
    const place at = place_of_node(*m, node);
    entry["x"].push_back(at.x);
    if (std::holds_alternative<plate>(m->kind)) entry["y"].push_back(at.y);
  }
  return entry;
}

/// Adds the numbers of entry `i` of the `count` entries of a list; an element has a list of each.
void put_numbers(json& entry, const std::vector<quantity_column>& all, std::size_t i, std::size_t count) {
  for (const auto& [row, values] : all) {
    const std::size_t places = values.size() / count;
    json& numbers = entry[std::string(key_in_list(*row))];
    if (places == 1)
      numbers = values[i];
    else
      numbers = std::vector(values.begin() + i * places, values.begin() + (i + 1) * places);
  }
}

/// The bounds on the errors of a state, including those of pressures and stresses if there are any.
json errors_json(const std::optional<certificate>& c, const step_results& read) {
  const problem& p = read.what;
  json out = error_json(p, c);
  for (const quantity_row* row : quantities_of(p, on::nodes))
    if (!row->kind) out[row->key] = c && c->proved && c->pressure ? json(*c->pressure) : json(nullptr);
  double largest = 0.0;
  bool has_stress = false;
  for (const value_range& r : read.ranges())
    if (row_named(p, r.name).in == unit::stress) {
      has_stress = true;
      largest = std::max(largest, std::abs(r.largest().value));
    }
  if (!has_stress) return out;
  const std::optional<double> moment = c && c->proved ? c->error[quantity::moment] : std::nullopt;
  const auto bound = moment ? stress_error(p.geometry, *moment, largest) : std::nullopt;
  out["stress"] = bound ? json(*bound) : json(nullptr);
  return out;
}

json lockstep_json(const lockstep& compared) {
  json out = agreement_json(compared.calls(), compared.compared());
  if (!compared.first()) return out;
  const mismatch_report& d = *compared.first();
  out["first"] = {{"call", d.call},         {"kernel", d.follower},     {"field", d.where.field},
                  {"index", d.where.index}, {"leader", d.where.leader}, {"follower", d.where.follower},
                  {"ulps", d.where.ulps}};
  return out;
}

json rule_1989_json(const run_result& r) {
  const rule_1989& beside = *r.beside;
  json wrong = json::array();
  for (const state_difference& d : beside.differences)
    if (d.is_wrong())
      wrong.push_back({{"step", d.step},
                       {"quantity", name_of(d.what).key},
                       {"at", d.at},
                       {"value", d.value},
                       {"right", d.right}});
  json out = {{"engine", beside.engine},
              {"status", status_name(beside.end.status)},
              {"lockstep", lockstep_json(beside.compared)},
              {"same_events", beside.same_events},
              {"wrong_steps", wrong}};
  if (!beside.only.empty()) out["steps"] = beside.only;
  return out;
}

/// The numbers of each entry of a list and, if it is at a node, its x.
json entries_json(const step_results& r, on where) {
  const list_row& list = list_of(where);
  const std::vector<quantity_column> all = columns_of(r, where);
  const std::size_t count = list.count(r.what);
  json out = json::array();
  for (std::size_t i = 0; i < count; ++i) {
    json& entry = out.emplace_back(json{{list.entry, i + 1}});
    put_name(entry, r.what, where, i);
    if (list.node != nullptr) entry["x"] = place_of_node(r.what.geometry, list.node(r.what, i)).x;
    put_numbers(entry, all, i, count);
  }
  return out;
}

json beds_json(const step_results& r) {
  json out = entries_json(r, on::beds);
  const std::vector<bed_reading> beds = beds_in(r);
  for (std::size_t i = 0; i < beds.size(); ++i)  // the largest pressure with its place, and the least one
    out[i].back() = range_json(r.what.geometry, beds[i].pressure);
  return out;
}

/// What is known of the mesh's error at the end of a step of the record, from 0.
json mesh_json(const run_result& r, std::size_t step) {
  if (!r.mesh.empty()) return mesh_error_json(r.mesh[step]);
  json out = {{"kind", has_no_mesh_error(r.what) ? "none" : "unknown"}};
  for (const mesh_change& c : r.refined)
    if (c.order) {
      out["kind"] = "estimated";
      if (c.error) out["error"][std::string(c.kind)] = *c.error;
    }
  return out;
}

/// The combinations, from 0, whose states the page leaves out; empty if the page has room for all. The page
/// keeps governing_steps.
std::set<std::size_t> ends_left_out(const run_result& r) {
  const std::vector<solved_step>& steps = r.record.steps;
  const std::size_t room = std::clamp<std::size_t>(2'000'000 / bytes_of_state(r.what), 4, most_pictures);
  if (!starts_from_zero(r.what) || steps.size() <= room) return {};
  const std::set<int> kept = governing_steps(r, room);
  std::set<std::size_t> out;
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (!kept.contains(steps[i].step)) out.insert(i);
  return out;
}

/// The states within steps to be written: every n-th, so that all have about `most_bytes` or less in total.
std::map<const increment_record*, path_moment> states_within(const run_result& r, std::size_t most_bytes) {
  std::vector<path_moment> within = moments_of(r);
  std::erase_if(within, [](const path_moment& m) { return m.is_end; });
  const std::size_t most = std::min(most_bytes / bytes_of_state(r.what), most_pictures);
  if (most == 0) return {};
  const std::size_t stride = (within.size() + most - 1) / most;
  std::map<const increment_record*, path_moment> chosen;
  for (std::size_t i = 0; i < within.size(); i += stride) chosen.emplace(within[i].increment, within[i]);
  return chosen;
}

class result_writer {
 public:
  result_writer(const run_result& r, output_file& out, result_parts parts)
      : r_(r), parts_(parts), document_(out, head(), "steps") {
    if (parts == result_parts::report) left_out_ = ends_left_out(r);
    if (parts == result_parts::ends || !r.record.keeps_states() || !left_out_.empty()) return;
    within_ = states_within(r, parts == result_parts::report ? most_bytes_of_page : 1'500'000);
    if (!within_.empty()) states_.emplace(r);
  }

  void write() {
    for (std::size_t step = 0; step < r_.record.steps.size(); ++step) add_step(step);
    const model& m = r_.what.geometry;
    document_.finish(foot(),
                     {{"nodes", count_of_places(m), [&m](auto i) { return node_json(m, i); }},
                      {"free_run", r_.free_runs.size(), [this](auto i) { return free_run(r_.free_runs[i]); }},
                      {"calls", r_.record_of_calls().calls.size(),
                       [this](auto i) { return call(r_.record_of_calls().calls[i]); }}});
  }

 private:
  [[nodiscard]] json head() const {
    json members = {
        {"format", "contct-result-2"}, {"title", r_.what.title}, {"units", units_json(r_.what.units)},
        {"kernels", r_.kernels},       {"engine", r_.engine},    {"quantities", quantities_json(r_.what)}};
    for (const auto& [key, text] : {std::pair("project", &problem::project),
                                    {"author", &problem::author},
                                    {"revision", &problem::revision}})
      if (!(r_.what.*text).empty()) members[key] = r_.what.*text;
    if (parts_ == result_parts::ends) return members;
    members.update(
        {{"file", r_.file}, {"date", r_.date}, {"words", words()}, {"structure", structure_json(r_.what)}});
    const model& m = r_.what.geometry;
    for (const load& c : r_.what.cases)
      members["cases"].push_back({{"name", c.name}, {"load", load_json(m, resultant_of(m, c), &c)}});
    return members;
  }

  /// The words that a terminal prints at the end of the run.
  [[nodiscard]] json words() const {
    return {{"end", joined(words_of_ends(r_.what, r_.end), ". ")},
            {"comparison", r_.comparison},
            {"certificate", certificate_summary(r_, r_.status() == "solved")},
            {"complaints", complaints_of(r_)},
            {"rule_1989", rule_1989_words(r_)},
            {"refined", refinement_words(r_)},
            {"program", r_.facts}};
  }

  [[nodiscard]] json load_in(int step, double fraction, bool whole = false) const {
    constexpr int width = 60;
    json out = load_json(r_.what, loads_, step, fraction, whole);
    if (parts_ != result_parts::ends) out["words"] = loads_.words_at(step, fraction, width);
    return out;
  }

  /// The pair with the largest contact force, and for each dof of a node (or direction of a matrix's dofs)
  /// the largest reaction.
  [[nodiscard]] json largest_json(const step_results& read) const {
    const problem& p = r_.what;
    json out = {{"reactions", json::array()}};
    const auto size = [](const pair_reading& r) { return std::abs(r.force); };
    if (const auto most = std::ranges::max_element(read.pairs, {}, size); most != read.pairs.end()) {
      const auto i = static_cast<std::size_t>(most - read.pairs.begin());
      out["pair"] = pair_state_json(p, i, read.state.isep[i], most->gap, most->force);
      out["pair"]["face"] = most->face;
    }
    const auto* const a = std::get_if<assembled>(&p.geometry.kind);
    const bool placed = a != nullptr && a->places.known();
    std::map<int, std::size_t> largest;  // supports, from 0
    for (std::size_t i = 0; i < p.supports.size(); ++i) {
      const support& at = p.supports[i];
      std::size_t& most =
          largest.try_emplace(placed ? a->places.dofs[at.node].direction : at.dof, i).first->second;
      if (std::abs(read.reactions[i]) > std::abs(read.reactions[most])) most = i;
    }
    for (const auto& [kind, i] : largest) out["reactions"].push_back(reaction_json(p, i, read.reactions[i]));
    return out;
  }

  /// The lists of a state; `read` must outlive the lists. Elements have coordinates only if `is_end`. For
  /// pictures, every element of a beam has its pieces.
  [[nodiscard]] std::vector<json_document::list> lists(const step_results& read, bool is_end = false) const {
    const problem& p = r_.what;
    const bool for_pictures = parts_ != result_parts::ends;
    const std::size_t elements = read.elements.elements();
    return {{"pairs", p.pairs.size(),
             [&, all = columns_of(read, on::pairs)](auto i) {
               json entry = pair_json(p, i);
               entry["state"] = state_name(read.state.isep[i]);
               put_numbers(entry, all, i, p.pairs.size());
               return entry;
             }},
            {"reactions", p.supports.size(), [&](auto i) { return reaction_json(p, i, read.reactions[i]); }},
            {"elements", elements,
             [=, lines = read.lines(), m = is_end ? &p.geometry : nullptr,
              all = columns_of(read, on::element_ends)](auto i) {
               json entry = element_json(m, i);
               put_numbers(entry, all, i, elements);
               const int e = static_cast<int>(i);
               if (lines && (for_pictures || lines->is_broken(e)))
                 entry["pieces"] = list_of(lines->pieces(e), piece_json);
               return entry;
             }}};
  }

  void add_step(std::size_t number) {
    const solved_step& s = r_.record.steps[number];
    const model& m = r_.what.geometry;
    const step_results at_end(r_.what, s);
    json members = {{"step", s.step}, {"name", r_.what.steps[s.step - 1].name}, {"fraction", s.fraction}};
    if (r_.what.steps[s.step - 1].from_zero) members["start"] = "zero";
    for (const load_term& t : r_.what.steps[s.step - 1].terms) {
      if (t.at)
        members["train"] = {{"name", t.name}, {"at", *t.at}, {"factor", t.factor}};
      else
        members["terms"][t.name] = t.factor;
    }
    const bool whole = !left_out_.contains(number);
    members["increments"] = whole ? json(nullptr) : json::array();
    if (whole) {
      for (const quantity_row* row : quantities_of(r_.what, on::nodes))
        members[row->key] = row->values(at_end);
      members.update({{"displacement", s.displacement},
                      {"pairs", nullptr},
                      {"reactions", nullptr},
                      {"elements", nullptr}});
    }
    members.update({{"extremes", extremes_json(m, at_end.ranges())},
                    {"extremes_at", places_of_extremes(m)},
                    {"beds", beds_json(at_end)}});
    if (const json hinges = entries_json(at_end, on::hinges); !hinges.empty()) members["hinges"] = hinges;
    for (const watched_range& w : watched_in(at_end))
      watched_entry(members["watch"], r_.what, w.part, *w.row) = range_json(m, {w.row->key, w.least, w.most});
    if (!std::holds_alternative<assembled>(m.kind))
      put_numbers(members["balance"], columns_of(at_end, on::structure), 0, 1);
    if (parts_ != result_parts::ends)
      members.update({{"load", load_in(s.step, s.fraction, true)}, {"largest", largest_json(at_end)}});
    if (s.from != origin::path) members["ended_by"] = s.from == origin::reference ? "reference" : "exact";
    members.update({{"rcond", s.rcond},
                    {"digits", s.judged ? json(digits_of(*s.judged)) : json(nullptr)},
                    {"error", errors_json(s.judged, at_end)},
                    {"certificate", certificate_json(s)},
                    {"mesh", mesh_json(r_, number)}});
    std::vector<json_document::list> all;
    if (whole) all = lists(at_end, true);
    if (whole)
      all.push_back(
          {"increments", s.increments.size(), [&](auto i) { return increment_of(s.increments[i]); }});
    document_.add(members, all);
  }

  [[nodiscard]] json increment_of(const increment_record& i) {
    json entry = {{"increment", i.number},
                  {"s", i.s},
                  {"fraction", i.fraction},
                  {"load", load_in(i.step, i.fraction)},
                  {"events", list_of(i.events, [this](const event& e) { return event_json(r_.what, e); })}};
    if (i.snaps) entry["snap"] = true;
    if (const auto found = within_.find(&i); found != within_.end())
      put_state(entry, states_->at(found->second));
    return entry;
  }

  void put_state(json& entry, const structure_state& s) const {
    if (s.displacement.empty()) return;
    const step_results within(r_.what, s);
    entry["displacement"] = s.displacement;
    for (const quantity_row* row : quantities_of(r_.what, on::nodes))
      if (!row->kind) entry[row->key] = row->values(within);  // the others are displacements
    for (const json_document::list& l : lists(within)) {
      json& list = entry[std::string(l.name)] = json::array();
      for (std::size_t i = 0; i < l.count; ++i) list.push_back(l.entry(i));
    }
    entry["extremes"] = extremes_json(r_.what.geometry, within.ranges());
  }

  [[nodiscard]] json foot() const {
    const path_end& end = r_.end;
    const auto end_json = [](const path_end& e) -> json {
      return {{"reason", end_reason(e.status)},
              {"step", e.step},
              {"fraction", e.fraction},
              {"pairs", numbered(e.pairs)}};
    };
    json members = {{"end", end_json(end)},
                    {"engine_work",
                     {{"factors", end.work.factors},
                      {"solves", end.work.solves},
                      {"updates", end.work.updates},
                      {"checks", end.work.checks}}}};
    if (!end.others.empty()) members["end"]["others"] = list_of(end.others, end_json);
    if (count_of_places(r_.what.geometry) > 0) members["nodes"] = nullptr;
    if (!r_.free_runs.empty()) members["free_run"] = nullptr;
    const lockstep_on_path* const calls = r_.compared_calls();
    members["lockstep"] = calls != nullptr ? lockstep_json(*calls) : json(nullptr);
    if (r_.beside) members["rule_1989"] = rule_1989_json(r_);
    members["status"] = r_.status();
    for (const mesh_change& c : r_.refined) {
      json& entry = members["refined"][std::string(c.kind)] = {{"change", c.change}, {"of", c.of}};
      if (c.order) entry.update({{"order", *c.order}, {"error", c.error ? json(*c.error) : json(nullptr)}});
    }
    if (r_.envelope) members["envelope"] = envelope_json(r_.what, envelope_of(r_, true));
    members["certified"] = end.status == path_status::solved && r_.all_certified();
    members["warnings"] = warnings_of(r_);
    if (parts_ != result_parts::report) return members;
    members.update({{"calls", nullptr},
                    {"calls_made", r_.record_of_calls().all_calls},
                    {"log", r_.record_of_calls().log},
                    {"log_bytes", r_.record_of_calls().all_log}});
    return members;
  }

  [[nodiscard]] static json free_run(const compared_path& of) {
    const free_run_difference& d = of.difference;
    return {{"kernel", of.kernel},
            {"same_end", d.same_end},
            {"same_events", d.same_events},
            {"first_difference", d.first_difference},
            {"fraction", d.fraction},
            {"displacement", d.displacement},
            {"bound", d.bound},
            {"within_bound", d.within_bound()},
            {"certified", of.certified}};
  }

  [[nodiscard]] static json call(const call_record& c) {
    return {{"step", c.step},
            {"increment", c.number},
            {"smin", c.smin},
            {"s", c.ss},
            {"followers", list_of(c.followers, [](const follower_answer& a) -> json {
               return {{"values", a.values},
                       {"mismatches", a.mismatches},
                       {"smin_ulps", a.smin_ulps},
                       {"s_ulps", a.ss_ulps},
                       {"failed", a.failed}};
             })}};
  }

  const run_result& r_;
  result_parts parts_;
  load_path loads_{r_.what};
  std::set<std::size_t> left_out_;  // steps, from 0, whose states the page leaves out
  std::map<const increment_record*, path_moment> within_;
  std::optional<path_states> states_;  // empty unless states were recorded
  json_document document_;
};

}  // namespace

void write_result(const run_result& r, output_file& out, result_parts parts) {
  result_writer(r, out, parts).write();
}

}  // namespace contct
