#include "contct/write/explain_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "contct/numeric/bits.hpp"
#include "contct/write/explain_words.hpp"
#include "contct/write/result_json.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

json story_json(const std::vector<told>& story) {
  json list = json::array();
  for (const told& t : story) {
    json entry = json::object();
    if (t.line > 0) {
      entry["line"] = t.line;
      entry["statement"] = listing::statement_at(t.line);
    }
    entry["words"] = t.words;
    if (!t.equation.empty()) entry["equation"] = t.equation;
    list.push_back(std::move(entry));
  }
  return list;
}

/// The IFs that were reached, in the listing's order, each with its margin.
json branches_json(const explained_pair& p) {
  json list = json::array();
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    const taken_branch& t = p.taken[b];
    if (!t.reached) continue;
    json entry = {{"if", branch_conditions[b]}, {"outcome", t.outcome}};
    if (static_cast<branch>(b) != branch::was_separated) entry["ulps"] = t.ulps;
    list.push_back(std::move(entry));
  }
  return list;
}

/// A number of both kernels: as both have it, and how far they are apart.
json both_json(const std::vector<std::string>& names, double first, const double* second, int real_bytes) {
  json out = {{names[0], hexfloat(first)}};
  if (second == nullptr) return out;
  out[names[1]] = hexfloat(*second);
  out["ulps"] = real_bytes == 4 ? ulps_between(static_cast<float>(first), static_cast<float>(*second))
                                : ulps_between(first, *second);
  return out;
}

std::string_view state_name(int isep) {
  return isep == in_contact ? "contact" : "separated";
}

json pair_json(const model& m, const explained_increment& i, const explained_pair& p,
               const std::vector<std::string>& names, int real_bytes) {
  const auto at = static_cast<std::size_t>(p.pair);
  json out = {{"pair", p.pair + 1},
              {"node", p.node},  // a dof's label below, where there are no nodes
              {"surface", surface_name(p.surface)},
              {"before", state_name(p.isep_before)},
              {"after", state_name(p.isep_after)},
              {"kind", kind_of_contact(p)},
              {"c", p.c},
              {"d", p.d},
              {"d_star", p.d_star},
              {"gap", p.gap},
              {"s", p.s}};
  if (const auto* a = std::get_if<assembled>(&m.kind)) {
    out.erase("node");
    out["dof"] = a->label_of(p.node - 1);
  }
  if (p.at(branch::check_positive).reached) out["s_chk"] = p.s_chk;
  if (p.at(branch::within_epsmul).reached) out["diff"] = p.diff;
  out["leads"] = p.took_the_lead();
  out["toggled"] = p.toggled();
  out["why"] = name_of(p.why);
  if (p.toggled()) out["distance_from_face"] = p.distance;
  out["branches"] = branches_json(p);
  out["bits"] = both_json(names, p.s, i.other == nullptr ? nullptr : &i.other->ss[at], real_bytes);
  if (i.other != nullptr) out["isep"] = {{names[0], p.isep_after}, {names[1], i.other->isep[at]}};
  std::vector<told> story = scale_factor_story(p);
  if (i.call.winner >= 0) {
    for (told& t : toggle_story(i.call, p)) story.push_back(std::move(t));
  }
  out["story"] = story_json(story);
  return out;
}

json winner_json(const explained_call& c) {
  if (c.winner < 0) return nullptr;
  json out = {{"pair", c.winner + 1}};
  if (c.next >= 0) {
    out["next_pair"] = c.next + 1;
    out["next_s"] = c.pairs[static_cast<std::size_t>(c.next)].s;
    out["ulps_ahead"] = c.ulps_ahead;
  }
  return out;
}

json narrowest_json(const std::optional<decision>& d) {
  if (!d) return nullptr;
  json out = {{"if", branch_conditions[static_cast<std::size_t>(d->what)]},
              {"outcome", d->outcome},
              {"ulps", d->ulps}};
  if (d->pair >= 0) out["pair"] = d->pair + 1;
  return out;
}

}  // namespace

explain_json::explain_json(const problem& p, std::vector<std::string> names, int real_bytes, int pair,
                           output_file& out)
    : problem_(p), loads_(p), names_(std::move(names)), real_bytes_(real_bytes), pair_(pair), out_(out) {
  out_.write(
      fmt::format("{{\n  \"format\": \"contct-explain-1\",\n  \"title\": {},\n  \"kernels\": {},\n"
                  "  \"real_bytes\": {},\n  \"increments\": [",
                  json(p.title).dump(), json(names_).dump(), real_bytes));
}

void explain_json::write(const explained_increment& i) {
  json head = {
      {"step", i.what.step},
      {"increment", i.what.number},
      {"fraction_before", i.fraction_before},
      {"fraction", i.what.fraction},
      {"s", i.what.s},
      {"load", loads_.json_at(i.what.step, i.what.fraction)},
      {"smin", both_json(names_, i.call.smin, i.other == nullptr ? nullptr : &i.other->smin, real_bytes_)},
      {"winner", winner_json(i.call)},
      {"narrowest", narrowest_json(i.call.narrowest)},
      {"left_undone", i.left_undone},
      {"story", story_json(winner_story(i.call))}};
  if (i.apart)
    head["apart"] = {{"field", i.apart->field},
                     {"index", i.apart->index},
                     {names_[0], i.apart->leader},
                     {names_[1], i.apart->follower}};
  std::string text = head.dump();
  text.pop_back();
  out_.write(fmt::format("{}\n    {},\n     \"pairs\": [", first_ ? "" : ",", text));
  first_ = false;
  bool first_pair = true;
  for (const explained_pair& p : i.call.pairs) {
    if (pair_ != 0 && pair_ != p.pair + 1) continue;
    out_.write(fmt::format("{}\n      {}", std::exchange(first_pair, false) ? "" : ",",
                           pair_json(problem_.geometry, i, p, names_, real_bytes_).dump()));
  }
  out_.write("]}");
}

void explain_json::finish(std::string_view status, const explained_path& path) {
  json compared = nullptr;
  if (names_.size() > 1)
    compared = {{"calls", path.calls()},
                {"values_compared", path.compared().values},
                {"mismatches", path.compared().mismatches}};
  out_.write(fmt::format("\n  ],\n  \"lockstep\": {},\n  \"status\": {}\n}}\n", compared.dump(),
                         json(status).dump()));
  out_.finish();
}

}  // namespace contct
