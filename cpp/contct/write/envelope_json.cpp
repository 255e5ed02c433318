// The least and largest values over a path or over combinations, with their steps.
#include <map>
#include <nlohmann/json.hpp>

#include "contct/results/envelope.hpp"
#include "contct/results/quantities.hpp"
#include "contct/write/result_json.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

/// Adds to `entry` the step and increment of the value `at`.
template <class Value>
json timed(json entry, const envelope::reached<Value>& at) {
  entry.update({{"step", at.step}, {"increment", at.increment}});
  return entry;
}

/// The least and the largest value at each x, with their steps.
json curves_json(const envelope_curves& all) {
  json out = {{"x", all.x}};
  for (const envelope_curves::curve& c : all.curves) {
    json& entry = out[std::string(c.name)];
    entry["min"] = list_of(c.at, [](const auto& r) { return r.least.value; });
    entry["max"] = list_of(c.at, [](const auto& r) { return r.most.value; });
    entry["min_step"] = list_of(c.at, [](const auto& r) { return r.least.step; });
    entry["max_step"] = list_of(c.at, [](const auto& r) { return r.most.step; });
  }
  return out;
}

/// An entry of a list, with its place or number, and with its name.
json begun_entry(const problem& p, on where, std::size_t i) {
  if (where == on::supports) return support_json(p, i);
  json entry = {{list_of(where).entry, i + 1}};
  if (where != on::pairs || i < contacts_of(p)) put_name(entry, p, where, i);
  return entry;
}

}  // namespace

json envelope_json(const problem& p, const envelope& e, const envelope_curves& along) {
  const auto place = [&p](const envelope::reached<placed_value>& at) {
    return timed(value_json(p.geometry, at.value), at);
  };
  const auto value = [](const envelope::reached<double>& at) { return timed({{"value", at.value}}, at); };
  json out = {{"states", e.states}};
  for (std::size_t i = 0; i < e.names.size(); ++i)
    out[std::string(e.names[i])] = {{"min", place(e.values[i].least)}, {"max", place(e.values[i].most)}};
  const auto range = [&value](const envelope::range<double>& r) -> json {
    return {{"min", value(r.least)}, {"max", value(r.most)}};
  };
  std::map<on, json> lists = {{on::pairs, json::array()}, {on::supports, json::array()}};
  for (const auto& [row, at] : e.lists) {
    json& list = lists[row->where];
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (i == list.size()) list.push_back(begun_entry(p, row->where, i));
      json& entry = list[i];
      if (row->kind == quantity::force) entry.update(timed({{"force_max", at[i].most.value}}, at[i].most));
      if (at[i].most.step == 0 || (row->where == on::pairs && i >= contacts_of(p))) continue;
      if (row->where == on::supports)
        entry.update(range(at[i]));
      else
        entry[key_in_list(*row)] = range(at[i]);
    }
  }
  out.update({{"pairs", lists[on::pairs]}, {"reactions", lists[on::supports]}});
  for (const on where : {on::beds, on::hinges})
    if (lists.contains(where)) out[list_of(where).name] = lists[where];
  if (!e.watched.empty())
    out["watch"] = watched_json(p, e.watched, list_of(e.values_watched, [&place](const auto& r) -> json {
                                  return {{"min", place(r.least)}, {"max", place(r.most)}};
                                }));
  if (!along.x.empty()) out["curves"] = curves_json(along);
  return out;
}

}  // namespace contct
