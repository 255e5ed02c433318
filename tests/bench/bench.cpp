// contct_bench compares the engines in one process on one thread.
#include "bench/bench.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sched.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "contct/matrix/cholesky.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/solve/spring_engine.hpp"
#include "contct/text/output_file.hpp"

namespace {

using json = nlohmann::ordered_json;

struct options {
  std::vector<std::string> problems;  // the usual problems if empty
  std::vector<std::string> engines = contct::engine_names();
  int events = 0;
  int rounds = 3;
  std::string json_file;
  std::string method;  // of CHOLMOD alone; empty: all
  bool without_kernels = false;
  bool print = false;
};

/// Pins the thread to one processor, so that ratios of times are meaningful.
void pin() {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(std::max(sched_getcpu(), 0)), &set);
  (void)sched_setaffinity(0, sizeof set, &set);
  using setter = void (*)(int);
  if (const auto threads = reinterpret_cast<setter>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
    threads(1);
}

/// Returns the name of the kernels that OpenBLAS chose; other libraries offer no choice.
std::string core_type() {
  using getter = char* (*)();
  const auto name = reinterpret_cast<getter>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  return name != nullptr ? name() : "no choice of its own";
}

/// Returns the run with the median time, with the certificate of the first run.
bench::run_of_engine measured(const options& o, const contct::problem& p, const contct::linear_structure& s,
                              const std::string& engine, int events) {
  std::vector<bench::run_of_engine> runs;
  for (int round = 0; round < o.rounds; ++round) {
    runs.push_back(bench::run_engine(p, s, engine, events, round == 0));
    constexpr double long_enough = 20.0;  // seconds; a longer run is not repeated
    if (runs.back().seconds > long_enough) break;
  }
  const bench::run_of_engine first = runs.front();
  std::sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  bench::run_of_engine median = runs[runs.size() / 2];
  median.certified = first.certified;
  median.certificate_seconds = first.certificate_seconds;
  return median;
}

double ms_per_event(const bench::run_of_engine& r) {
  return 1e3 * r.seconds / static_cast<double>(std::max<std::size_t>(r.events.size(), 1));
}

/// Returns the number of events to time, or 0 for all events. The engine refactor takes an hour on the large
/// plates, so only their first events are timed.
int events_of_refactor(const options& o, const std::string& problem) {
  constexpr int enough = 60;
  return o.events == 0 && (problem == "mat-100" || problem == "grid-100") ? enough : o.events;
}

/// Times one call of the C++ kernel and of FORTRAN; a ratio above 1 means that C++ is faster.
json bench_kernels(int rounds) {
  json rows = json::array();
  for (const std::size_t pairs : std::to_array<std::size_t>({10, 100, 1000, 10'000, 100'000, 1'000'000})) {
    const bench::seconds_of_a_call t = bench::time_kernels(pairs, 5 * rounds);
    fmt::print(
        "kernels alone, {:>7} pairs: FORTRAN {:>10.3f} us a call (and {:.2f} us for its line of text), C++ "
        "{:>10.3f} us, x{:.2f}\n",
        pairs, 1e6 * t.fortran, 1e6 * t.text, 1e6 * t.cpp, t.fortran / t.cpp);
    rows.push_back({{"pairs", pairs},
                    {"fortran_us", 1e6 * t.fortran},
                    {"text_us", 1e6 * t.text},
                    {"cpp_us", 1e6 * t.cpp},
                    {"ratio", t.fortran / t.cpp}});
  }
  return rows;
}

void bench_problem(const options& o, const std::string& name, json& rows) {
  const contct::problem p = bench::make_problem(name);
  const contct::linear_structure s = contct::structure_of(p);
  const double solve_ms = 1e3 * bench::seconds_of_a_solve(s);
  std::optional<bench::run_of_engine> reference;
  fmt::print("{}: {} dofs, half bandwidth {}, {} pairs; one dpbtrs {:.3f} ms\n", name, s.dofs(),
             s.stiffness.band().subdiagonals(), s.pairs.size(), solve_ms);
  for (const std::string& engine : o.engines) {
    if (engine == "condensed" && !contct::can_be_condensed(s)) continue;
    const bench::run_of_engine r =
        measured(o, p, s, engine, engine == "refactor" ? events_of_refactor(o, name) : o.events);
    if (engine == "refactor") reference = r;
    const double ms = ms_per_event(r);
    const bench::difference d = reference ? bench::difference_of(*reference, r) : bench::difference{};
    const double ratio = reference ? ms_per_event(*reference) / ms : 0.0;
    fmt::print(
        "  {:<10} {:>5} events {:>9.4f} ms/event  x{:<7.4g} {:>6.2f} dpbtrs  {:>5} MiB  events {}  load "
        "{:.0e}  D {:.0e}  {}\n"
        "             {} factors, {} solves, {} updates, {} checks\n",
        engine, r.events.size(), ms, ratio, ms / solve_ms, r.peak_kib / 1024,
        d.same_events ? "same" : "DIFFERENT", d.load, d.displacement,
        r.certified ? "certified"
        : r.whole   ? "NOT certified"
                    : "not whole",
        r.counts.factors, r.counts.solves, r.counts.updates, r.counts.checks);
    if (r.certificate_seconds > 0.0)
      fmt::print("             certificate of the end {:.3f} ms; x{:.2f} of the path\n",
                 1e3 * r.certificate_seconds, r.certificate_seconds / r.seconds);
    (void)std::fflush(stdout);
    rows.push_back({{"problem", name},
                    {"engine", engine},
                    {"dofs", s.dofs()},
                    {"pairs", s.pairs.size()},
                    {"events", r.events.size()},
                    {"whole", r.whole},
                    {"ms_per_event", ms},
                    {"ratio_to_refactor", reference ? json(ratio) : json()},
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

/// Times the final states without a path, and compares this time with that of the factorisations.
json bench_final_states(const std::string& name) {
  const contct::problem p = bench::make_problem(name);
  const contct::linear_structure s = contct::structure_of(p);
  const bench::final_states f = bench::time_final_states(p, s);
  const double ratio = f.seconds / f.factorisations / f.seconds_of_a_factor;
  fmt::print("  final states {:.1f} ms: {} factorisations of {:.2f} ms each, x{:.2f} of these alone\n",
             1e3 * f.seconds, f.factorisations, 1e3 * f.seconds_of_a_factor, ratio);
  return {{"problem", name},
          {"ms", 1e3 * f.seconds},
          {"factorisations", f.factorisations},
          {"ms_of_a_factor", 1e3 * f.seconds_of_a_factor},
          {"ratio", ratio}};
}

/// Times CHOLMOD without this project's engines, if it is found.
void bench_peers(const options& o, const std::string& name, json& rows) {
  const contct::problem p = bench::make_problem(name);
  for (const bench::peer_answer& a : bench::time_cholmod(p, contct::structure_of(p), o.rounds, o.method)) {
    fmt::print("  CHOLMOD alone, {}: {:.1f} ms, {} steps, {:.1f} MiB, {:.1f} digits, {} wrong statuses\n",
               a.method, 1e3 * a.seconds, a.steps, a.mib, a.digits, a.wrong_statuses);
    rows.push_back({{"problem", name},
                    {"method", a.method},
                    {"ms", 1e3 * a.seconds},
                    {"mib", a.mib},
                    {"steps", a.steps},
                    {"digits", a.digits},
                    {"wrong_statuses", a.wrong_statuses},
                    {"values", a.values}});
  }
}

int run(options o) {
  if (o.problems.empty()) o.problems = bench::usual_problems();
  if (o.print) {
    for (const std::string& name : o.problems) fmt::print("{}", bench::text_of(name));
    return 0;
  }
  std::optional<contct::output_file> out;
  if (!o.json_file.empty()) out.emplace(o.json_file);
  pin();
  fmt::print("{}; core type: {}; one thread, its processor time\n", contct::lapack_identity(), core_type());
  json kernels = o.without_kernels ? json::array() : bench_kernels(o.rounds);
  json rows = json::array();
  json ends = json::array();
  json peers = json::array();
  for (const std::string& name : o.problems) {
    bench_problem(o, name, rows);
    ends.push_back(bench_final_states(name));
    bench_peers(o, name, peers);
  }
  if (out) {
    const json document = {{"blas", contct::lapack_identity()}, {"core", core_type()},
                           {"kernels", std::move(kernels)},     {"rows", rows},
                           {"final_states", std::move(ends)},   {"peers", std::move(peers)}};
    out->write(document.dump(1) + "\n");
    out->finish();
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  options o;
  CLI::App program("The engines side by side on problems by formula.", "contct_bench");
  program
      .add_option("--problem", o.problems,
                  "Problems: rail-S, mat-N, grid-N or files; without it, the usual ones")
      ->delimiter(',');
  program.add_option("--engine", o.engines, "Engines; refactor is what the others are measured by")
      ->delimiter(',')
      ->capture_default_str();
  program.add_option("--method", o.method, "Of CHOLMOD alone, only this method");
  program.add_option("--events", o.events, "Stop every step after this many events; 0: never")
      ->check(CLI::Range(0, 1'000'000'000));
  program
      .add_option("--rounds", o.rounds,
                  "Runs of which the median counts; of the kernels alone, five times as many, of which the "
                  "least counts")
      ->check(CLI::Range(1, 99))
      ->capture_default_str();
  program.add_flag("--without-kernels", o.without_kernels,
                   "Engines only; the kernels alone take some seconds");
  program.add_flag("--print", o.print, "Print the problem files instead of running them");
  program.add_option("--json", o.json_file, "Write the rows to this file (- is standard output)");
  CLI11_PARSE(program, argc, argv);
  try {
    return run(o);
  } catch (const std::exception& e) {
    (void)std::fputs((std::string("contct_bench: ") + e.what() + "\n").c_str(), stderr);
    return 2;
  }
}
