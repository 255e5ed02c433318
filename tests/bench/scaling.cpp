// contct_scaling PROBLEM ENGINE [INCREMENTS]: what an event costs on one process or, under mpirun and with
// the engine petsc, on several: time, and the memory of each rank. Writes one line of JSON.
// reference/scaling.md has measurements.
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/problems.hpp"
#include "contct/distributed/module.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"

namespace {

using clock = std::chrono::steady_clock;
using json = nlohmann::ordered_json;
namespace app = contct::app;
namespace distributed = contct::distributed;

/// When the first event came, the last, and how many.
struct event_clock final : app::observer {
  void incremented(const app::increment& i) override {
    if (i.events.empty()) return;
    events += i.events.size();
    last = clock::now();
    if (!first) first = last;
  }

  std::size_t events = 0;
  std::optional<clock::time_point> first;
  clock::time_point last;
};

double seconds_between(clock::time_point from, clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// The largest memory of each rank so far, in MiB.
json peaks() {
  std::vector<long> kib;
  if (distributed::ranks* const all = distributed::joined_ranks()) {
    kib = all->peak_kib();
  } else {
    rusage used{};
    (void)getrusage(RUSAGE_SELF, &used);
    kib.push_back(used.ru_maxrss);
  }
  json mib = json::array();
  for (const long k : kib) mib.push_back(k / 1024);
  return mib;
}

json measured(const std::string& name, const std::string& engine, int most_increments) {
  const app::problem p = bench::make_problem(name, distributed::joined_ranks());
  const app::linear_structure s = app::structure_of(p, distributed::joined_ranks());
  const auto leader = app::make_kernel("corrected");
  event_clock watch;
  app::observer* const observers[] = {&watch};
  app::path_limits limits;
  limits.increments_per_step = most_increments;
  json row = {{"problem", name}, {"engine", engine}, {"dofs", s.dofs()}, {"pairs", s.pairs.size()}};
  row["mib_of_structure"] = peaks();
  const clock::time_point start = clock::now();
  const auto solves = app::make_engine(engine, s);
  (void)app::follow_path(s, static_cast<int>(p.steps.size()), app::loads_of(p, s), *solves, *leader,
                         observers, limits);
  if (watch.events < 2)
    throw std::runtime_error("found fewer than two events, between which nothing is measured");
  row["events"] = watch.events;
  row["seconds_to_first_event"] = seconds_between(start, *watch.first);
  row["ms_per_event"] =
      1e3 * seconds_between(*watch.first, watch.last) / static_cast<double>(watch.events - 1);
  row["factors"] = solves->counts().factors;
  row["solves"] = solves->counts().solves;
  row["peak_mib"] = peaks();
  if (s.stiffness.is_remote()) {
    const auto again = s.stiffness.others().make_factor();
    row["factor_mib"] = static_cast<double>(again->bytes()) / 0x1p20;
    row["factor_gflop"] = 1e-9 * again->flops();
  }
  return row;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2 || arguments.size() > 3)
    throw std::invalid_argument("usage: contct_scaling PROBLEM ENGINE [INCREMENTS]");
  const bool petsc = arguments[1] == "petsc";
  if (petsc && distributed::join_ranks({CONTCT_PETSC_MODULE}, CONTCT_VERSION).own() != 0) {
    distributed::ranks& all = *distributed::joined_ranks();
    distributed::set_joined_ranks(nullptr);
    all.serve();
    return 0;
  }
  const json row = measured(arguments[0], arguments[1], arguments.size() == 3 ? std::stoi(arguments[2]) : 0);
  fmt::print("{}\n", row.dump());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  int status = 2;
  try {
    status = run({argv + 1, argv + argc});
  } catch (const std::exception& e) {
    fmt::print(stderr, "contct_scaling: {}\n", e.what());
  }
  (void)std::fflush(stdout);
  if (distributed::ranks* const all = distributed::joined_ranks()) all->leave();
  return status;
}
