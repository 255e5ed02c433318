#include "contct/lab/fuzz_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "contct/text/input_text.hpp"

namespace contct::lab {
namespace {

using json = nlohmann::ordered_json;
constexpr const char* format = "contct-fuzz-1";

json branches_json(const branch_counts& counts) {
  json out = json::object();
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    const auto which = static_cast<branch>(b);
    out[std::string(branch_names[b]) + "_true"] = counts.of(which, true);
    out[std::string(branch_names[b]) + "_false"] = counts.of(which, false);
  }
  return out;
}

json follower_json(const fuzz_follower& f) {
  return {{"kernel", f.name},
          {"values_compared", f.compared.values},
          {"mismatches", f.compared.mismatches},
          {"rung", name_of(f.highest)},
          {"most_ulps", f.most_ulps},
          {"findings", f.mismatch_reports}};
}

equality_level level_of(const std::string& name) {
  int level = 0;
  while (level + 1 < equality_levels && name != name_of(static_cast<equality_level>(level))) ++level;
  return static_cast<equality_level>(level);
}

fuzz_result read_shard(const std::string& file) {
  const json j = json::parse(read_input(file, "fuzz result"));
  if (j.at("format") != format) throw input_error(file + ": found another format; allowed: " + format);
  fuzz_result r;
  r.request.kernels = j.at("kernels").get<std::vector<std::string>>();
  r.request.seed = j.at("seed");
  r.request.calls = j.at("asked").at("calls");
  r.request.problems = j.at("asked").at("problems");
  r.request.shard = j.at("shard").at("number");
  r.request.shards = j.at("shard").at("of");
  r.calls = j.at("calls");
  r.problems = j.at("problems");
  r.seconds = j.at("seconds");
  r.events.make = j.at("events").at("make");
  r.events.break_ = j.at("events").at("break");
  r.events.stationary = j.at("events").at("stationary");
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    const std::string name(branch_names[b]);
    r.branches.add(static_cast<branch>(b), true, j.at("branches").at(name + "_true"));
    r.branches.add(static_cast<branch>(b), false, j.at("branches").at(name + "_false"));
  }
  for (const json& f : j.at("followers")) {
    r.followers.push_back({f.at("kernel"),
                           {f.at("values_compared"), f.at("mismatches")},
                           level_of(f.at("rung")),
                           f.at("most_ulps"),
                           f.at("findings").get<std::vector<std::string>>()});
  }
  return r;
}

/// A shard, or an input_error that names the file.
fuzz_result shard_from(const std::string& file) {
  try {
    return read_shard(file);
  } catch (const json::exception& e) {
    throw input_error(
        fmt::format("{}: found no fuzz result: {}; allowed: what --json wrote", file, e.what()));
  }
}

bool same_run(const fuzz_request& a, const fuzz_request& b) {
  return a.kernels == b.kernels && a.calls == b.calls && a.problems == b.problems && a.seed == b.seed &&
         a.shards == b.shards;
}

void add(fuzz_result& all, const fuzz_result& shard) {
  all.add(shard);
  all.problems += shard.problems;
  all.seconds += shard.seconds;
  for (std::size_t f = 0; f < all.followers.size(); ++f) {
    fuzz_follower& mine = all.followers[f];
    const fuzz_follower& its = shard.followers[f];
    mine.compared += its.compared;
    mine.highest = std::max(mine.highest, its.highest);
    mine.most_ulps = std::max(mine.most_ulps, its.most_ulps);
    if (mine.mismatch_reports.empty()) mine.mismatch_reports = its.mismatch_reports;
  }
}

}  // namespace

std::string fuzz_json(const fuzz_result& r) {
  const tally t = r.compared();
  json followers = json::array();
  for (const fuzz_follower& f : r.followers) followers.push_back(follower_json(f));
  const json document = {
      {"format", format},
      {"kernels", r.request.kernels},
      {"calls", r.calls},
      {"values_compared", t.values},
      {"mismatches", t.mismatches},
      {"problems", r.problems},
      {"events", {{"make", r.events.make}, {"break", r.events.break_}, {"stationary", r.events.stationary}}},
      {"branches", branches_json(r.branches)},
      {"seconds", r.seconds},
      {"seed", r.request.seed},
      {"asked", {{"calls", r.request.calls}, {"problems", r.request.problems}}},
      {"shard", {{"number", r.request.shard}, {"of", r.request.shards}}},
      {"followers", std::move(followers)}};
  return document.dump(1) + "\n";
}

fuzz_result merged_fuzz(const std::vector<std::string>& files) {
  fuzz_result all;
  for (const std::string& file : files) {
    const fuzz_result shard = shard_from(file);
    if (all.merged_shards.empty()) {
      all = shard;
    } else {
      if (!same_run(all.request, shard.request) || all.followers.size() != shard.followers.size())
        throw input_error(file + ": found another run than in " + files[0] +
                          "; allowed: shards with the same kernels, calls, problems and seed");
      if (std::count(all.merged_shards.begin(), all.merged_shards.end(), shard.request.shard) > 0)
        throw input_error(
            fmt::format("{}: found shard {} once more; allowed: each once", file, shard.request.shard));
      add(all, shard);
    }
    all.merged_shards.push_back(shard.request.shard);
  }
  if (static_cast<int>(all.merged_shards.size()) != all.request.shards)
    throw input_error(fmt::format("found {} of {} shards ({}); allowed: all of them",
                                  all.merged_shards.size(), all.request.shards,
                                  fmt::join(all.merged_shards, ", ")));
  all.request.shard = 1;
  all.request.shards = 1;
  return all;
}

}  // namespace contct::lab
