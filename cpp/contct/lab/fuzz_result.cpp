#include "contct/lab/fuzz_result.hpp"

#include <algorithm>

namespace contct {

std::string_view name_of(equality_level r) {
  constexpr std::string_view names[] = {"bits", "ulps", "events", "certificate", "none"};
  return names[static_cast<int>(r)];
}

tally fuzz_result::compared() const {
  tally all;
  for (const fuzz_follower& f : followers) {
    all.values += f.compared.values;
    all.mismatches += f.compared.mismatches;
  }
  return all;
}

std::string floors_missed(const fuzz_result& r) {
  if (r.calls == 0 || r.compared().values == 0) return "nothing was compared";
  constexpr std::int64_t enough_calls = 1000;
  if (r.calls < enough_calls) return "";
  const std::int64_t floor = std::max<std::int64_t>(1, r.calls / 10'000);
  std::string missed;
  const auto need = [&](std::string_view what, std::int64_t count) {
    if (count >= floor) return;
    missed += missed.empty() ? "" : ", ";
    missed.append(what).append(": ").append(std::to_string(count));
  };
  need("make", r.events.make);
  need("break", r.events.break_);
  need("stationary", r.events.stationary);
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    for (const bool outcome : {false, true}) {
      need(std::string(branch_names[b]) + (outcome ? " true" : " false"),
           r.branches.of(static_cast<branch>(b), outcome));
    }
  }
  if (missed.empty()) return "";
  return "too little was compared: found " + missed + "; allowed: at least " + std::to_string(floor) +
         " each";
}

}  // namespace contct
