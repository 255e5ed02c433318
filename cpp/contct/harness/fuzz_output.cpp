#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "contct/harness/fuzz.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

json json_of(const fuzz_follower& f) {
  return {{"kernel", f.name},
          {"values_compared", f.compared.values},
          {"mismatches", f.compared.mismatches},
          {"rung", std::string(name_of(f.highest))},
          {"most_ulps", f.near.most_ulps},
          {"findings", f.mismatch_reports}};
}

}  // namespace

std::string fuzz_json(const fuzz_result& r) {
  json branches;
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    for (const bool outcome : {true, false})
      branches[fmt::format("{}_{}", branch_names[b], outcome)] =
          r.branches.of(static_cast<branch>(b), outcome);
  }
  json followers = json::array();
  for (const fuzz_follower& f : r.followers) followers.push_back(json_of(f));
  const json document = {
      {"format", "contct-fuzz-1"},
      {"kernels", r.request.kernels},
      {"calls", r.calls},
      {"values_compared", r.compared().values},
      {"mismatches", r.compared().mismatches},
      {"problems", r.problems},
      {"events", {{"make", r.events.make}, {"break", r.events.break_}, {"stationary", r.events.stationary}}},
      {"branches", branches},
      {"seconds", r.seconds},
      {"seed", r.request.seed},
      {"asked", {{"calls", r.request.calls}, {"problems", r.request.problems}}},
      {"shard", {{"number", r.request.shard}, {"of", r.request.shards}}},
      {"followers", followers}};
  return json_text(document, 1) + "\n";
}

std::string trace_of(found_case c, trace_header h) {
  for (const std::string& line : words_of(c.what)) h.about.push_back(line);
  std::string text;
  append_header(h, text);
  for (recorded_call& r : c.calls) append_call(r.answered(), "", text);
  return text;
}

}  // namespace contct
