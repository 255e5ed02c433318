// The least and largest values over a path or over combinations, with their steps.
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
  json pairs = json::array();
  json reactions = json::array();
  json beds = json::array();
  if (e.states > 0) {
    reactions =
        list_of(p.supports, [&p, i = 0](const support& /*at*/) mutable { return support_json(p, i++); });
    for (std::size_t i = 0; i < p.beds.size(); ++i) {
      beds.push_back({{"bed", i + 1}});
      put_name(beds.back(), p, on::beds, i);
    }
  }
  for (const auto& [row, at] : e.lists)
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (row->where == on::pairs)
        pairs.push_back(timed({{"pair", i + 1}, {"force_max", at[i].most.value}}, at[i].most));
      if (row->where == on::beds) beds[i][key_in_list(*row)] = range(at[i]);
      if (row->where == on::supports && at[i].most.step > 0) reactions[i].update(range(at[i]));
    }
  out.update({{"pairs", pairs}, {"reactions", reactions}});
  if (!beds.empty()) out["beds"] = beds;
  if (!e.watched.empty())
    out["watch"] = watched_json(p, e.watched, list_of(e.values_watched, [&place](const auto& r) -> json {
                                  return {{"min", place(r.least)}, {"max", place(r.most)}};
                                }));
  if (!along.x.empty()) out["curves"] = curves_json(along);
  return out;
}

}  // namespace contct
