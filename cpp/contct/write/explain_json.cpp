#include "contct/write/explain_json.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "contct/numeric/bits.hpp"
#include "contct/write/explain_words.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace {

using json = nlohmann::ordered_json;

json story_json(const std::vector<sentence>& story) {
  json list = json::array();
  for (const sentence& t : story) {
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
  out["ulps"] = ulps_apart(first, *second, real_bytes);
  return out;
}

json pair_json(const model& m, const explained_increment& i, const explained_pair& p,
               const std::vector<std::string>& names, int real_bytes) {
  json out = {{"pair", p.pair + 1}};
  put_place(out, m, p.node - 1);
  out.update({{"surface", surface_name(p.surface)},
              {"before", state_name(p.isep_before)},
              {"after", state_name(p.isep_after)},
              {"kind", kind_of_contact(p)},
              {"c", p.c},
              {"d", p.d},
              {"d_star", p.d_star},
              {"gap", p.gap},
              {"s", p.s}});
  if (p.at(branch::check_positive).reached) out["s_chk"] = p.s_chk;
  if (p.at(branch::within_epsmul).reached) out["diff"] = p.diff;
  out["leads"] = p.took_the_lead();
  out["toggled"] = p.toggled();
  out["why"] = name_of(p.why);
  if (p.toggled()) out["distance_from_face"] = p.distance;
  out["branches"] = branches_json(p);
  out["bits"] = both_json(names, p.s, i.other == nullptr ? nullptr : &i.other->ss[p.pair], real_bytes);
  if (i.other != nullptr) out["isep"] = {{names[0], p.isep_after}, {names[1], i.other->isep[p.pair]}};
  std::vector<sentence> story = scale_factor_story(p);
  if (i.call.winner >= 0) {
    for (sentence& t : toggle_story(i.call, p)) story.push_back(std::move(t));
  }
  out["story"] = story_json(story);
  return out;
}

json winner_json(const explained_call& c) {
  if (c.winner < 0) return nullptr;
  json out = {{"pair", c.winner + 1}};
  if (c.next >= 0) {
    out["next_pair"] = c.next + 1;
    out["next_s"] = c.pairs[c.next].s;
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
    : problem_(p), loads_(p), names_(std::move(names)), real_bytes_(real_bytes), pair_(pair), document_(out) {
  document_.put("format", "contct-explain-1");
  document_.put("title", p.title);
  document_.put("kernels", names_);
  document_.put("real_bytes", real_bytes);
  document_.open_array("increments");
}

void explain_json::write(const explained_increment& i) {
  document_.open_object();
  document_.put("step", i.what.step);
  document_.put("increment", i.what.number);
  document_.put("fraction_before", i.fraction_before);
  document_.put("fraction", i.what.fraction);
  document_.put("s", i.what.s);
  document_.put("load", load_json(problem_.geometry, loads_, i.what.step, i.what.fraction));
  document_.put("smin",
                both_json(names_, i.call.smin, i.other == nullptr ? nullptr : &i.other->smin, real_bytes_));
  document_.put("winner", winner_json(i.call));
  document_.put("narrowest", narrowest_json(i.call.narrowest));
  document_.put("left_undone", i.left_undone);
  document_.put("story", story_json(winner_story(i.call)));
  if (i.apart)
    document_.put("apart", {{"field", i.apart->field},
                            {"index", i.apart->index},
                            {names_[0], i.apart->leader},
                            {names_[1], i.apart->follower}});
  document_.open_array("pairs");
  for (const explained_pair& p : i.call.pairs) {
    if (pair_ == 0 || pair_ == p.pair + 1)
      document_.add(pair_json(problem_.geometry, i, p, names_, real_bytes_));
  }
  document_.close();
  document_.close();
}

void explain_json::finish(std::string_view status, const explained_path& path) {
  json compared = nullptr;
  if (names_.size() > 1)
    compared = {{"calls", path.calls()},
                {"values_compared", path.compared().values},
                {"mismatches", path.compared().mismatches}};
  document_.close();  // the increments
  document_.put("lockstep", compared);
  document_.put("status", status);
  document_.finish();
}

}  // namespace contct::write
