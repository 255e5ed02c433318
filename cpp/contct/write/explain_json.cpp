#include <nlohmann/json.hpp>

#include "contct/number/bits.hpp"
#include "contct/write/explain.hpp"
#include "contct/write/words.hpp"

namespace contct {

namespace {

using json = nlohmann::ordered_json;

json story_json(const std::vector<sentence>& story) {
  return list_of(story, [](const sentence& t) {
    json entry;
    if (t.at.number > 0) entry = {{"line", t.at.number}, {"statement", t.at.statement}};
    entry["words"] = t.words;
    if (!t.equation.empty()) entry["equation"] = t.equation;
    return entry;
  });
}

/// The IFs of the listing that the call reached for this pair, in order, each with its margin in ULP.
json branches_json(const explained_pair& p) {
  json list = json::array();
  for (const std::optional<decision>& d : p.taken) {
    if (!d) continue;
    json& entry =
        list.emplace_back(json{{"if", branch_conditions[index_of(d->what)]}, {"outcome", d->outcome}});
    if (d->what != branch::was_separated) entry["ulps"] = d->ulps;
  }
  return list;
}

/// A number of the kernels, with the difference in ULP; `second` is null without a second answer.
json both_json(const explained_kernels& of, double first, const double* second) {
  json out = {{of.names[0], hexfloat(first)}};
  if (second == nullptr) return out;
  out[of.names[1]] = hexfloat(*second);
  out["ulps"] = ulps_apart(first, *second, of.real_bytes);
  return out;
}

json explained_json(const explained_kernels& of, const explained_increment& i, const explained_pair& p) {
  json out = pair_json(of.what, p.pair);
  out.update({{"before", state_name(p.isep_before)},
              {"after", state_name(p.isep_after)},
              {"kind", kind_name(p)},
              {"c", p.c},
              {"d", p.d},
              {"d_star", p.d_star},
              {"gap", p.gap},
              {"s", p.s}});
  if (p.reached(branch::check_positive)) out["s_chk"] = p.s_chk;
  if (p.reached(branch::within_epsmul)) out["diff"] = p.diff;
  out.update({{"leads", p.took_the_lead()}, {"toggled", p.toggled()}, {"why", name_of(p.why)}});
  if (p.toggled()) out["distance_from_face"] = p.distance;
  out["branches"] = branches_json(p);
  out["bits"] = both_json(of, p.s, i.other == nullptr ? nullptr : &i.other->ss[p.pair]);
  if (i.other != nullptr) out["isep"] = {{of.names[0], p.isep_after}, {of.names[1], i.other->isep[p.pair]}};
  std::vector<sentence> story = scale_factor_story(p);
  if (i.call.winner >= 0) std::ranges::move(toggle_story(i.call, p), std::back_inserter(story));
  out["story"] = story_json(story);
  return out;
}

json winner_json(const explained_call& c) {
  if (c.winner < 0) return nullptr;
  json out = {{"pair", c.winner + 1}};
  if (c.next >= 0)
    out.update({{"next_pair", c.next + 1}, {"next_s", c.pairs[c.next].s}, {"ulps_ahead", c.ulps_ahead}});
  return out;
}

json narrowest_json(const std::optional<decision>& d) {
  if (!d) return nullptr;
  json out = {{"if", branch_conditions[index_of(d->what)]}, {"outcome", d->outcome}, {"ulps", d->ulps}};
  if (d->pair >= 0) out["pair"] = d->pair + 1;
  return out;
}

}  // namespace

explain_json::explain_json(explained_kernels of, output_file& out)
    : of_(std::move(of)),
      document_(out,
                {{"format", "contct-explain-1"},
                 {"title", of_.what.title},
                 {"kernels", of_.names},
                 {"real_bytes", of_.real_bytes}},
                "increments") {}

void explain_json::write(const explained_increment& i) {
  json out = {{"step", i.what.step},
              {"increment", i.what.number},
              {"fraction_before", i.fraction_before},
              {"fraction", i.what.fraction},
              {"s", i.what.s},
              {"load", load_json(of_.what, of_.loads, i.what.step, i.what.fraction)},
              {"smin", both_json(of_, i.call.smin, i.other == nullptr ? nullptr : &i.other->smin)},
              {"winner", winner_json(i.call)},
              {"narrowest", narrowest_json(i.call.narrowest)},
              {"left_undone", i.left_undone},
              {"story", story_json(winner_story(i.call))}};
  if (i.apart)
    out["apart"] = {{"field", i.apart->field},
                    {"index", i.apart->index},
                    {of_.names[0], i.apart->leader},
                    {of_.names[1], i.apart->follower}};
  out["pairs"] = nullptr;
  const bool all = of_.pair == 0;
  document_.add(out, {{"pairs", all ? i.call.pairs.size() : 1, [&](std::size_t k) {
                         return explained_json(of_, i, i.call.pairs[all ? k : of_.pair - 1]);
                       }}});
}

void explain_json::finish(std::string_view status, const explained_path& path) {
  json compared = nullptr;
  if (of_.names.size() > 1) compared = agreement_json(path.calls(), path.compared());
  document_.finish({{"lockstep", compared}, {"status", status}});
}

}  // namespace contct
