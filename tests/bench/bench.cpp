// contct_bench compares the engines in one process on one thread.
#include "bench/bench.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sched.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "contct/kernel/registry.hpp"
#include "contct/linear/cholesky.hpp"
#include "contct/linear/factored_stiffness.hpp"
#include "contct/linear/spring_engine.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/certificate.hpp"
#include "contct/proof/reference_solution.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/text/output_file.hpp"

namespace {

using bench::json;
using bench::now;
using bench::seconds_of;

struct options {
  std::vector<std::string> problems = {"rail-50", "rail-500", "grid-50", "mat-50", "grid-100", "mat-100"};
  std::vector<std::string> engines = contct::engine_names();
  int events = 0, rounds = 3;
  std::string json_file, method;
  bool without_kernels = false, print = false;
};

/// Returns a function of OpenBLAS, or nullptr with another library.
template <class Function>
Function of_openblas(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

/// Pins the thread to one processor, so that ratios of times are meaningful.
void pin() {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(std::max(sched_getcpu(), 0)), &set);
  (void)sched_setaffinity(0, sizeof set, &set);
  if (const auto threads = of_openblas<void (*)(int)>("openblas_set_num_threads")) threads(1);
}

/// Returns the name of the kernels that OpenBLAS chose; other libraries offer no choice.
std::string core_type() {
  const auto name = of_openblas<char* (*)()>("openblas_get_corename");
  return name != nullptr ? name() : "no choice of its own";
}

/// Returns the peak memory of the process since "5" was written to clear_refs.
long peak_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stol(line.substr(6));
  }
  return 0;
}

/// A path: its events and their loads, which are the number of finished steps plus the share of the current
/// step; its last state; and the processor time from the start to the last event.
struct path final : contct::observer {
  void incremented(const contct::increment& i) override {
    for (const contct::event& e : i.events) events.emplace_back(e.pair, i.step - 1 + i.fraction);
    if (!i.events.empty() || events.empty()) seconds = now() - start;
  }
  double start = now(), seconds = 0.0;
  std::vector<std::pair<int, double>> events;
  std::vector<double> displacement;  // [dofs]
  contct::engine_counts counts;
  long peak_kib = 0;
  bool whole = true;  // the path reached its end
  bool certified = false;
  double certificate_seconds = 0.0;  // for refining and proving the last state

  [[nodiscard]] double ms_per_event() const {
    return 1e3 * seconds / static_cast<double>(std::max<std::size_t>(events.size(), 1));
  }
};

/// Follows the path under the corrected rule, with at most `most_events` events a step, or all if 0. If
/// `certify` is set and the path is complete, the last state is certified.
path path_by(const std::string& engine, const contct::problem& p, const contct::linear_structure& s,
             int most_events, bool certify) {
  const std::unique_ptr<contct::kernel> leader = contct::make_kernel("corrected");
  std::ofstream("/proc/self/clear_refs") << "5";
  path r;
  const contct::solved_path followed = contct::follow(p, s, engine, *leader, {&r}, nullptr, most_events);
  r.peak_kib = peak_kib();
  r.counts = followed.end.work;
  r.whole = followed.end.status == contct::path_status::solved;
  if (!followed.steps.empty()) r.displacement = followed.steps.back().displacement;
  if (!certify || !r.whole) return r;
  contct::certifier proof(p, s);
  contct::path_end end = followed.end;
  end.step = followed.steps.back().step;
  r.certificate_seconds = seconds_of([&] {
    const auto settled = proof.settle(end, followed.steps.back());
    r.certified = settled && settled->judged->certified;
  });
  return r;
}

/// Returns the path with the median time, with the certificate of the first.
path median_path(const options& o, const contct::problem& p, const contct::linear_structure& s,
                 const std::string& engine, int events) {
  std::vector<path> runs;
  while (std::ssize(runs) < o.rounds && (runs.empty() || runs.back().seconds <= bench::long_enough))
    runs.push_back(path_by(engine, p, s, events, runs.empty()));
  const auto [certified, seconds] = std::pair(runs[0].certified, runs[0].certificate_seconds);
  std::ranges::sort(runs, {}, &path::seconds);
  path median = runs[runs.size() / 2];
  median.certified = certified;
  median.certificate_seconds = seconds;
  return median;
}

/// The differences between two paths in their common events: whether the events differ, apart from their
/// order at ties; the largest difference of an event's load; and the largest difference of D after equally
/// many events, relative to the largest D.
struct difference {
  bool same_events = true;
  double load = 0.0;
  double displacement = 0.0;
};

difference difference_of(const path& reference, const path& other) {
  difference d;
  constexpr double tie = 1e-9;
  const auto common = std::min(reference.events.size(), other.events.size());
  const bool as_many = reference.events.size() == other.events.size();
  d.same_events = as_many || !reference.whole || !other.whole;
  for (std::size_t i = 0; i < common; ++i) {
    const int pair = other.events[i].first;
    const double load = other.events[i].second;
    const double expected = reference.events[i].second;
    d.load = std::max(d.load, std::abs(expected - load));
    const auto is_tied = [&](const auto& e) {
      return e.first == pair && std::abs(e.second - expected) <= tie;
    };
    d.same_events &= reference.events[i].first == pair ||
                     std::ranges::any_of(std::span(reference.events).first(common), is_tied);
  }
  if (!as_many || reference.displacement.size() != other.displacement.size()) return d;
  double size = 0.0;
  for (std::size_t i = 0; i < reference.displacement.size(); ++i) {
    size = std::max(size, std::abs(reference.displacement[i]));
    d.displacement = std::max(d.displacement, std::abs(reference.displacement[i] - other.displacement[i]));
  }
  d.displacement = size > 0.0 ? d.displacement / size : 0.0;
  return d;
}

/// Returns the seconds of one dpbtrs with the factor of the initial structure, the cost of a plain solve.
double seconds_of_a_solve(const contct::linear_structure& s) {
  contct::stiffness_factor f(s.stiffness);
  std::vector<char> closed(s.pairs.size());
  for (std::size_t i = 0; i < closed.size(); ++i) closed[i] = s.pairs[i].closed ? 1 : 0;
  if (!f.factor(contct::springs_of(s, closed))) throw std::runtime_error("the stiffness has no factor");
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 15; ++round) {
    std::vector<double> x(static_cast<std::size_t>(s.dofs()), 1.0);
    least = std::min(least, seconds_of([&] { f.solve(x); }));
  }
  return least;
}

/// Prints a row, with 4 digits of its numbers, and adds it.
void add(json& rows, json row) {
  for (const auto& [key, value] : row.items()) {
    const std::string words =
        value.is_number_float() ? fmt::format("{:.4g}", value.get<double>()) : value.dump();
    fmt::print("{} {}  ", key, words);
  }
  fmt::print("\n");
  (void)std::fflush(stdout);
  rows.push_back(std::move(row));
}

/// Times the engines. The engine refactor takes an hour on the large plates, so only their first events are
/// timed.
void time_engines(const options& o, const std::string& name, const contct::problem& p,
                  const contct::linear_structure& s, json& rows) {
  const double solve_ms = 1e3 * seconds_of_a_solve(s);
  std::optional<path> reference;
  for (const std::string& engine : o.engines) {
    if (engine == "condensed" && !contct::can_be_condensed(s)) continue;
    const bool is_slow = engine == "refactor" && (name == "mat-100" || name == "grid-100");
    const path r = median_path(o, p, s, engine, is_slow && o.events == 0 ? 60 : o.events);
    if (engine == "refactor") reference = r;
    const double ms = r.ms_per_event();
    const difference d = reference ? difference_of(*reference, r) : difference{};
    add(rows, {{"problem", name},
               {"engine", engine},
               {"dofs", s.dofs()},
               {"pairs", s.pairs.size()},
               {"events", r.events.size()},
               {"whole", r.whole},
               {"ms_per_event", ms},
               {"ratio_to_refactor", reference ? json(reference->ms_per_event() / ms) : json()},
               {"ratio_to_dpbtrs", ms / solve_ms},
               {"same_events", d.same_events},
               {"max_load_fraction_diff", d.load},
               {"max_d_diff", d.displacement},
               {"certified", r.whole ? json(r.certified) : json()},
               {"certificate_ms", r.whole ? json(1e3 * r.certificate_seconds) : json()},
               {"peak_mib", static_cast<double>(r.peak_kib) / 1024},
               {"factors", r.counts.factors},
               {"solves", r.counts.solves},
               {"updates", r.counts.updates},
               {"checks", r.counts.checks}});
  }
}

/// Times the final states of all steps, without a path and a certificate, and compares this time with that of
/// the factorisations by the library that the reference solution uses.
json time_final_states(const std::string& name, const contct::problem& p, const contct::linear_structure& s) {
  const contct::load_history loads(p, s);
  contct::reference_solver finds(s);
  const double seconds = seconds_of([&] {
    for (int step = 1; step <= std::ssize(p.steps); ++step)
      if (finds.solve(loads.total(step), loads.work(step)).status != contct::path_status::solved)
        throw std::runtime_error("no final states");
  });
  contct::stiffness_factor factor(s.stiffness, contct::quickest_factor(s));
  const std::vector<contct::spring_at> springs = contct::springs_of(s, std::vector<char>(s.pairs.size(), 1));
  const double of_a_factor = seconds_of([&] {
    if (!factor.factor(springs)) throw std::runtime_error("the stiffness has no factor");
  });
  return {{"problem", name},
          {"ms", 1e3 * seconds},
          {"factorisations", finds.factorisations()},
          {"ms_of_a_factor", 1e3 * of_a_factor},
          {"ratio", seconds / finds.factorisations() / of_a_factor}};
}

void run(const options& o) {
  if (o.print) {
    for (const std::string& name : o.problems) fmt::print("{}", bench::text_of(name));
    return;
  }
  std::optional<contct::output_file> out;
  if (!o.json_file.empty()) out.emplace(o.json_file);
  pin();
  fmt::print("{}; core type: {}; one thread, its processor time\n", contct::lapack_identity(), core_type());
  json kernels = json::array(), rows = json::array(), ends = json::array(), peers = json::array();
  for (const std::size_t pairs : std::to_array<std::size_t>({10, 100, 1000, 10'000, 100'000, 1'000'000}))
    if (!o.without_kernels) add(kernels, bench::time_kernels(pairs, 5 * o.rounds));
  for (const std::string& name : o.problems) {
    const contct::problem p = name.ends_with(".toml") ? contct::read_problem(name)
                                                      : contct::parse_problem(bench::text_of(name), name);
    const contct::linear_structure s = contct::structure_of(p);
    time_engines(o, name, p, s, rows);
    add(ends, time_final_states(name, p, s));
    for (json& peer : bench::time_cholmod(p, s, o.rounds, o.method)) {
      json row = {{"problem", name}};
      row.update(peer);
      add(peers, std::move(row));
    }
  }
  if (!out) return;
  const json document = {{"blas", contct::lapack_identity()},
                         {"core", core_type()},
                         {"kernels", kernels},
                         {"rows", rows},
                         {"final_states", ends},
                         {"peers", peers}};
  out->write(document.dump(1) + "\n");
  out->finish();
}

}  // namespace

int main(int argc, char** argv) {
  options o;
  CLI::App program("The engines side by side on problems by formula.", "contct_bench");
  program.add_option("--problem", o.problems, "Problems: rail-S, mat-N, grid-N or files")->delimiter(',');
  program.add_option("--engine", o.engines, "Engines, compared with refactor")
      ->delimiter(',')
      ->capture_default_str();
  program.add_option("--method", o.method, "Of CHOLMOD alone, only this method");
  program.add_option("--events", o.events, "Stop every step after this many events; 0: never")
      ->check(CLI::Range(0, 1'000'000'000));
  program
      .add_option(
          "--rounds", o.rounds,
          "Runs of which the median counts; five times as many of the kernels, of which the least counts")
      ->check(CLI::Range(1, 99))
      ->capture_default_str();
  program.add_flag("--without-kernels", o.without_kernels, "Engines only");
  program.add_flag("--print", o.print, "Print the problem files instead of running them");
  program.add_option("--json", o.json_file, "Write the rows to this file (- is standard output)");
  CLI11_PARSE(program, argc, argv);
  try {
    run(o);
    return 0;
  } catch (const std::exception& e) {
    (void)std::fputs((std::string("contct_bench: ") + e.what() + "\n").c_str(), stderr);
    return 2;
  }
}
