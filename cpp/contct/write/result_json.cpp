#include "contct/write/result_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "contct/matrix/cholesky.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace {

using json = nlohmann::ordered_json;

/// Numbers from 1.
json numbered(const std::vector<int>& all) {
  return list_of(all, [](int i) { return i + 1; });
}

/// "all", "2..9", or a list; from 1.
json elements_json(const std::vector<int>& elements) {
  if (elements.empty()) return "all";
  if (!is_run(elements)) return numbered(elements);
  return fmt::format("{}..{}", elements.front() + 1, elements.back() + 1);
}

json value_json(const model& m, const placed_value& at) {
  json entry = {{"value", at.value}};
  if (std::holds_alternative<assembled>(m.kind)) {
    put_place(entry, m, at.node);
    entry["x"] = nullptr;  // as far as the structure itself goes
    return entry;
  }
  entry["x"] = at.x;
  if (std::holds_alternative<plate>(m.kind)) entry["y"] = at.y;
  return entry;
}

json extremes_json(const model& m, const std::vector<value_range>& ranges) {
  json out = json::object();
  for (const value_range& r : ranges)
    out[std::string(r.name)] = {{"min", value_json(m, r.least)}, {"max", value_json(m, r.most)}};
  return out;
}

void put_time(json& entry, const envelope::when& reached) {
  entry.update({{"step", reached.step}, {"increment", reached.increment}});
}

json envelope_json(const problem& p, const envelope& e) {
  const model& m = p.geometry;
  const auto bound = [&m](const envelope::bound& b) {
    json entry = value_json(m, b.at);
    put_time(entry, b.reached);
    return entry;
  };
  const auto reached = [](double value, const envelope::when& at) {
    json entry = {{"value", value}};
    put_time(entry, at);
    return entry;
  };
  json out = {{"states", e.states()}};
  for (const envelope::range& r : e.ranges())
    out[std::string(r.name)] = {{"min", bound(r.least)}, {"max", bound(r.most)}};
  out["pairs"] = list_of(e.pairs(), [i = 0](const envelope::peak& peak) mutable {
    json entry = {{"pair", ++i}, {"force_max", peak.force}};
    put_time(entry, peak.reached);
    return entry;
  });
  out["reactions"] = list_of(e.reactions(), [&, i = 0](const envelope::reaction_range& r) mutable {
    json entry = support_json(m, p.supports[i++]);
    entry.update({{"min", reached(r.least, r.least_reached)}, {"max", reached(r.most, r.most_reached)}});
    return entry;
  });
  return out;
}

json element_json(const element_results& results, std::size_t e) {
  json entry = {{"element", e + 1}};
  for (std::size_t i = 0; i < results.names.size(); ++i)
    entry[std::string(results.names[i])] = results.at(e, i);
  return entry;
}

json units_json(const unit_labels& units) {
  if (units.length.empty()) return nullptr;
  return {{"length", units.length}, {"force", units.force}};
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

}  // namespace

json_document::json_document(output_file& out, const json& members, std::string_view name) : out_(out) {
  out_.write("{");
  write_members(members, {}, 2);
  out_.write(fmt::format(",\n  {}: [", json_text(json(name))));
}

void json_document::write_members(const json& members, const std::vector<list>& lists, int indent) {
  std::string_view before;
  for (const auto& [name, value] : members.items()) {
    out_.write(fmt::format("{}\n{:{}}{}: ", std::exchange(before, ","), "", indent, json_text(json(name))));
    const auto l = std::ranges::find(lists, std::string_view(name), &list::name);
    if (l == lists.end()) {
      out_.write(json_text(value));
    } else {
      out_.write("[");
      for (std::size_t i = 0; i < l->count; ++i)
        out_.write(fmt::format("{}\n{:{}}{}", i == 0 ? "" : ",", "", indent + 2, json_text(l->entry(i))));
      out_.write(l->count == 0 ? "]" : fmt::format("\n{:{}}]", "", indent));
    }
  }
}

void json_document::add(const json& members, const std::vector<list>& lists) {
  out_.write(fmt::format("{}\n    {{", std::exchange(before_, ",")));
  write_members(members, lists, 6);
  out_.write("\n    }");
}

void json_document::finish(const json& members, const std::vector<list>& lists) {
  out_.write(before_.empty() ? "]," : "\n  ],");
  write_members(members, lists, 2);
  out_.write("\n}\n");
  out_.finish();
}

json certificate_json(const std::optional<certificate>& c) {
  if (!c) return nullptr;
  json out = {{"exact", c->certified},         {"displacement_error", c->displacement_error},
              {"equilibrium", c->equilibrium}, {"penetration", c->penetration},
              {"tension", c->tension},         {"rcond", c->rcond},
              {"tolerance", certified_share},  {"shape_error", c->shape_error},
              {"unique", c->unique},           {"independent", c->independent},
              {"digits", digits_of(*c)}};
  if (!c->unique) out["displacement_error"] = out["shape_error"] = nullptr;
  if (!c->problem.empty()) out["problem"] = c->problem;
  return out;
}

json error_json(const problem& p, const std::optional<certificate>& c) {
  const bool of_beam = std::holds_alternative<beam>(p.geometry.kind);
  const bool of_matrix = std::holds_alternative<assembled>(p.geometry.kind);
  json out = json::object();
  const auto put = [&](quantity q, bool is_there) {
    const std::optional<double> bound = c && c->proved ? c->error[q] : std::nullopt;
    if (is_there) out[quantity_names[static_cast<std::size_t>(q)]] = bound ? json(*bound) : json(nullptr);
  };
  put(quantity::w, true);
  put(quantity::slope, !of_matrix);
  put(quantity::force, !p.pairs.empty());
  put(quantity::gap, !p.pairs.empty());
  put(quantity::reaction, !p.supports.empty());
  put(quantity::moment, !of_matrix);
  put(quantity::shear, of_beam);
  return out;
}

json agreement_json(std::int64_t calls, const tally& compared) {
  return {{"calls", calls}, {"values_compared", compared.values}, {"mismatches", compared.mismatches}};
}

json load_json(const model& m, const load_path& loads, int step, double fraction) {
  const resultant r = loads.resultant_at(step, fraction);
  const auto names = dof_names(m);
  json out = {{std::holds_alternative<assembled>(m.kind) ? "sum" : "force", r.force}};
  for (std::size_t i = 0; i < r.moments.size(); ++i)
    out[r.moments.size() == 1 ? "moment" : fmt::format("moment_{}", names[i + 1])] = r.moments[i];
  if (loads.has_many_parts(step)) return out;
  const load l = loads.at(step, fraction);
  for (const distributed_load& d : l.distributed) {
    const bool constant = d.polynomial.size() == 1;
    out["uniform"].push_back(
        {{constant ? "value" : "polynomial", constant ? json(d.polynomial[0]) : json(d.polynomial)},
         {"elements", elements_json(d.elements)}});
  }
  for (const point_load& p : l.points) {
    json& point = out["point"].emplace_back();
    put_place(point, m, p.node);
    point[names[p.dof]] = p.value;
  }
  for (const prescribed_displacement& g : l.settlements) {
    json& settled = out["settlement"].emplace_back();
    put_place(settled, m, g.node);
    settled[names[g.dof]] = g.value;
  }
  return out;
}

void put_place(json& entry, const model& m, int node) {
  if (const auto* a = std::get_if<assembled>(&m.kind)) {
    entry["dof"] = a->label_of(node);
  } else {
    entry["node"] = node + 1;
  }
}

json event_json(const problem& p, const event& e) {
  const contact_pair& at = p.pairs[e.pair];
  json entry = {{"pair", e.pair + 1}};
  put_place(entry, p.geometry, at.node);
  entry.update({{"surface", surface_name(at.surface)}, {"change", change_name(e.what)}});
  return entry;
}

json pair_state_json(const problem& p, std::size_t i, int isep, const json& gap, const json& force) {
  json entry = {{"pair", i + 1}};
  put_place(entry, p.geometry, p.pairs[i].node);
  entry.update({{"surface", surface_name(p.pairs[i].surface)},
                {"state", state_name(isep)},
                {"gap", gap},
                {"force", force}});
  return entry;
}

json support_json(const model& m, const support& at) {
  json entry;
  put_place(entry, m, at.node);
  if (!entry.contains("dof")) entry["dof"] = dof_names(m)[at.dof];
  return entry;
}

namespace {

/// What a state has, in the order of steps' keys.
class state_writer {
 public:
  explicit state_writer(const problem& p) : p_(p), m_(p.geometry), loads_(p) {}

  [[nodiscard]] json load_in(int step, double fraction, bool in_words) const {
    json out = load_json(m_, loads_, step, fraction);
    if (in_words) out["words"] = loads_.words_at(step, fraction, load_words_width);
    return out;
  }

  [[nodiscard]] step_results read(const frame& f) const {
    step_results r = results_of(p_, loads_.at(f.step, f.fraction), f, deflecting_);
    for (std::size_t i = 0; i < f.pair_forces.size() && !f.numbers; ++i) r.pairs[i].force = f.pair_forces[i];
    return r;
  }

  [[nodiscard]] json extremes(const step_results& r) const { return extremes_json(m_, r.ranges); }

  /// `r` and `f` must outlive these lists.
  [[nodiscard]] std::vector<json_document::list> lists(const step_results& r, const frame& f) const {
    return {{"pairs", p_.pairs.size(),
             [&](auto i) { return pair_state_json(p_, i, f.isep[i], r.pairs[i].gap, r.pairs[i].force); }},
            {"reactions", r.reactions.size(),
             [&](auto i) {
               json entry = support_json(m_, p_.supports[i]);
               entry["value"] = r.reactions[i];
               return entry;
             }},
            {"elements", r.elements.elements(), [&](auto i) { return element_json(r.elements, i); }}};
  }

 private:
  static constexpr int load_words_width = 60;

  const problem& p_;
  const model& m_;
  load_path loads_;
  std::vector<int> deflecting_ = deflecting_nodes(p_);
};

/// Of the states within steps, those that are written: evenly chosen, so that all together take not too many
/// bytes.
std::map<std::pair<int, int>, const frame*> states_within(const run_result& r, std::size_t most_bytes) {
  constexpr std::size_t fewest = 4;
  const problem& p = r.what;
  const std::size_t of_element =
      std::holds_alternative<plate>(p.geometry.kind) ? 300 : 120;  // about, as text
  const std::size_t bytes = std::size_t{20} * dofs(p.geometry) + 100 * p.pairs.size() +
                            55 * p.supports.size() + of_element * elements(p.geometry);
  std::vector<const frame*> within;
  for (const frame& f : r.frames)
    if (f.number > 0 && !f.step_end) within.push_back(&f);
  const std::size_t most = std::max(fewest, most_bytes / std::max<std::size_t>(bytes, 1));
  const std::size_t stride = (within.size() + most - 1) / most;
  std::map<std::pair<int, int>, const frame*> chosen;
  for (std::size_t i = 0; i < within.size(); i += stride)
    chosen[{within[i]->step, within[i]->number}] = within[i];
  return chosen;
}

class result_writer {
 public:
  result_writer(const run_result& r, output_file& out, result_parts parts)
      : r_(r), parts_(parts), document_(out, head(), "steps") {
    if (parts != result_parts::ends)
      within_ = states_within(r, parts == result_parts::report ? 6'000'000 : 1'500'000);
  }

  void write() {
    for (std::size_t step = 0; step < r_.record.steps.size(); ++step) add_step(step);
    document_.finish(
        foot(), {{"free_run", r_.free_runs.size(), [this](auto i) { return free_run(r_.free_runs[i]); }},
                 {"calls", r_.record.calls.size(), [this](auto i) { return call(r_.record.calls[i]); }}});
  }

 private:
  [[nodiscard]] json head() const {
    json members = {{"format", "contct-result-1"},
                    {"title", r_.what.title},
                    {"units", units_json(r_.what.units)},
                    {"kernels", r_.kernels},
                    {"engine", r_.engine}};
    if (parts_ == result_parts::ends) return members;
    members.update(
        {{"file", r_.file}, {"date", r_.date}, {"words", words()}, {"structure", structure_json(r_.what)}});
    return members;
  }

  /// What a terminal says when the run is over.
  [[nodiscard]] json words() const {
    return {{"end", end_words(r_.what, r_.end)},
            {"comparison", r_.comparison},
            {"certificate", certificate_summary(r_.judged, r_.status() == "solved")},
            {"complaints", complaints_of(r_)},
            {"program", r_.facts}};
  }

  void add_step(std::size_t number) {
    const step_record& s = r_.record.steps[number];
    const model& m = r_.what.geometry;
    const step_results read = state_.read(s.end);
    std::vector<double> w(nodes(m));
    for (int node = 0; node < nodes(m); ++node) w[node] = deflection_of(r_.what, s.end.displacement, node);
    json members = {{"step", s.end.step},
                    {"name", r_.what.steps[s.end.step - 1].name},
                    {"fraction", s.end.fraction},
                    {"increments", nullptr},
                    {"w", w},
                    {"displacement", s.end.displacement},
                    {"pairs", nullptr},
                    {"reactions", nullptr},
                    {"elements", nullptr},
                    {"extremes", state_.extremes(read)},
                    {"extremes_at", ranges_are_at(m)}};
    if (parts_ != result_parts::ends) members["load"] = state_.load_in(s.end.step, s.end.fraction, true);
    if (s.end.from_fallback) members["ended_by"] = "oracle";
    if (s.end.from_exact_path) members["ended_by"] = "exact";
    const std::optional<certificate>& judged = r_.judged.steps()[number];
    members.update({{"rcond", s.rcond},
                    {"digits", judged ? json(digits_of(*judged)) : json(nullptr)},
                    {"error", error_json(r_.what, judged)},
                    {"certificate", certificate_json(judged)}});
    std::vector<json_document::list> lists = state_.lists(read, s.end);
    lists.push_back(
        {"increments", s.increments.size(), [&](auto i) { return increment_of(s.increments[i]); }});
    document_.add(members, lists);
  }

  [[nodiscard]] json increment_of(const increment_record& i) const {
    json entry = {{"increment", i.number},
                  {"s", i.s},
                  {"fraction", i.fraction},
                  {"load", state_.load_in(i.step, i.fraction, parts_ != result_parts::ends)},
                  {"events", list_of(i.events, [this](const event& e) { return event_json(r_.what, e); })}};
    if (i.snaps) entry["snap"] = true;
    if (const auto found = within_.find({i.step, i.number}); found != within_.end())
      put_state(entry, *found->second);
    return entry;
  }

  void put_state(json& entry, const frame& f) const {
    const step_results read = state_.read(f);
    entry["displacement"] = f.displacement;
    for (const json_document::list& l : state_.lists(read, f)) {
      json& list = entry[std::string(l.name)] = json::array();
      for (std::size_t i = 0; i < l.count; ++i) list.push_back(l.entry(i));
    }
    entry["extremes"] = state_.extremes(read);
  }

  [[nodiscard]] json foot() const {
    const path_end& end = r_.end;
    json members = {{"end",
                     {{"reason", end_reason(end.status)},
                      {"step", end.step},
                      {"fraction", end.fraction},
                      {"pairs", numbered(end.pairs)}}},
                    {"engine_work",
                     {{"factors", end.work.factors},
                      {"solves", end.work.solves},
                      {"updates", end.work.updates},
                      {"checks", end.work.checks}}}};
    if (!r_.free_runs.empty()) members["free_run"] = nullptr;
    members["lockstep"] = r_.compared == nullptr ? json(nullptr) : lockstep_json(*r_.compared);
    members["status"] = r_.status();
    if (r_.all_increments != nullptr) members["envelope"] = envelope_json(r_.what, *r_.all_increments);
    members["certified"] = end.status == path_status::solved && r_.judged.all_certified();
    if (parts_ != result_parts::report) return members;
    members.update({{"calls", nullptr},
                    {"calls_made", r_.record.all_calls},
                    {"log", r_.record.log},
                    {"log_bytes", r_.record.all_log}});
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
  state_writer state_{r_.what};
  std::map<std::pair<int, int>, const frame*> within_;
  json_document document_;
};

}  // namespace

void write_result(const run_result& r, output_file& out, result_parts parts) {
  result_writer(r, out, parts).write();
}

}  // namespace contct::write
