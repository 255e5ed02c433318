#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "bench/bench.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/solve/factored_stiffness.hpp"

namespace bench {
namespace {

using clock = cpu_clock;

/// Returns the peak memory of the process since the last call of forget_peak.
long peak_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::stol(line.substr(6));
  }
  return 0;
}

void forget_peak() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

class watch final : public contct::observer {
 public:
  explicit watch(run_of_engine& r) : r_(r) {}

  void incremented(const contct::increment& i) override {
    for (const contct::event& e : i.events) r_.events.push_back({e.pair, i.step - 1 + i.fraction});
    if (!i.events.empty() || r_.events.empty()) last_ = clock::now();
  }
  void step_ended(const contct::step_state& s) override {
    r_.displacement.assign(s.displacement.begin(), s.displacement.end());
    last_step_ = s.step;
    isep_.assign(s.isep.begin(), s.isep.end());
  }

  void start() { last_ = start_ = clock::now(); }
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(last_ - start_).count(); }
  [[nodiscard]] int last_step() const { return last_step_; }
  [[nodiscard]] contct::full_load_state last_state() const { return {r_.displacement, isep_}; }

 private:
  run_of_engine& r_;
  clock::time_point start_, last_;
  std::vector<int> isep_;
  int last_step_ = 0;
};

}  // namespace

run_of_engine run_engine(const contct::problem& p, const contct::linear_structure& s,
                         const std::string& engine, int most_events, bool certify) {
  run_of_engine r;
  const std::unique_ptr<contct::kernel> leader = contct::make_kernel("corrected");
  const contct::load_history loads = contct::loads_of(p, s);
  watch w(r);
  contct::observer* const observers[] = {&w};
  contct::path_limits limits;
  limits.increments_per_step = most_events;
  forget_peak();
  w.start();
  const std::unique_ptr<contct::stiffness_engine> solves = contct::make_engine(engine, s);
  const contct::path_end end =
      contct::follow_path(s, static_cast<int>(p.steps.size()), loads, *solves, *leader, observers, limits);
  r.seconds = w.seconds();
  r.peak_kib = peak_kib();
  r.counts = solves->counts();
  r.whole = end.status == contct::path_status::solved;
  if (!certify || !r.whole) return r;
  const auto seconds_since = [](clock::time_point start) {
    return std::chrono::duration<double>(clock::now() - start).count();
  };
  const clock::time_point start = clock::now();
  contct::certifier judge(p, s);
  const contct::full_load_state reached = w.last_state();
  const contct::full_load_state proved = judge.ends()(w.last_step(), &reached).state.value();
  judge.step_ended({.step = w.last_step(),
                    .fraction = 1.0,
                    .displacement = proved.displacement,
                    .isep = proved.isep,
                    .rcond = 0.0,
                    .numbers = proved.numbers ? &*proved.numbers : nullptr});
  r.certificate_seconds = seconds_since(start);
  r.certified = judge.all_certified();
  return r;
}

final_states time_final_states(const contct::problem& p, const contct::linear_structure& s) {
  final_states f;
  const auto seconds_since = [](clock::time_point start) {
    return std::chrono::duration<double>(clock::now() - start).count();
  };
  const contct::load_history loads = contct::loads_of(p, s);
  const clock::time_point start = clock::now();
  contct::reference_solver finds(s);
  for (int step = 1; step <= std::ssize(p.steps); ++step) {
    std::vector<double> load(s.dofs());
    loads(step, load);
    if (finds.solve(load, loads.work(step)).how != contct::reference_answer::outcome::found)
      throw std::runtime_error("no final states");
  }
  f.seconds = seconds_since(start);
  f.factorisations = finds.factorisations();
  const bool by_cholmod = contct::quickest_factor(s) == contct::factored_by::cholmod;
  const std::optional<contct::stiffness_matrix> entries =
      by_cholmod ? contct::entries_for(s, contct::factored_by::cholmod) : std::nullopt;
  contct::stiffness_factor factor(entries ? *entries : s.stiffness);
  const std::vector<contct::spring_at> springs = contct::springs_of(s, std::vector<char>(s.pairs.size(), 1));
  const clock::time_point again = clock::now();
  if (!factor.factor(springs)) throw std::runtime_error("the stiffness has no factor");
  f.seconds_of_a_factor = seconds_since(again);
  return f;
}

double seconds_of_a_solve(const contct::linear_structure& s) {
  contct::stiffness_factor f(s.stiffness);
  std::vector<char> closed(s.pairs.size());
  for (std::size_t i = 0; i < closed.size(); ++i) closed[i] = s.pairs[i].closed ? 1 : 0;
  if (!f.factor(contct::springs_of(s, closed))) throw std::runtime_error("the stiffness has no factor");
  std::vector<double> x(static_cast<std::size_t>(s.dofs()));
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 15; ++round) {
    std::fill(x.begin(), x.end(), 1.0);
    const auto start = clock::now();
    f.solve(x);
    least = std::min(least, std::chrono::duration<double>(clock::now() - start).count());
  }
  return least;
}

difference difference_of(const run_of_engine& reference, const run_of_engine& other) {
  difference d;
  constexpr double tie = 1e-9;
  const std::size_t n = std::min(reference.events.size(), other.events.size());
  const bool both_whole = reference.whole && other.whole;
  d.same_events = !both_whole || reference.events.size() == other.events.size();
  for (std::size_t i = 0; i < n; ++i) {
    d.load = std::max(d.load, std::abs(reference.events[i].load - other.events[i].load));
    if (reference.events[i].pair == other.events[i].pair) continue;
    // Different pairs are allowed at a tie: the reference then has the other run's pair at the same load.
    bool tied = false;
    for (std::size_t j = i; j-- > 0 && reference.events[i].load - reference.events[j].load <= tie;)
      tied = tied || reference.events[j].pair == other.events[i].pair;
    for (std::size_t j = i; j < n && reference.events[j].load - reference.events[i].load <= tie; ++j)
      tied = tied || reference.events[j].pair == other.events[i].pair;
    d.same_events = d.same_events && tied;
  }
  if (reference.displacement.size() != other.displacement.size() ||
      reference.events.size() != other.events.size())
    return d;
  double size = 0.0;
  for (std::size_t i = 0; i < reference.displacement.size(); ++i) {
    size = std::max(size, std::abs(reference.displacement[i]));
    d.displacement = std::max(d.displacement, std::abs(reference.displacement[i] - other.displacement[i]));
  }
  d.displacement = size > 0.0 ? d.displacement / size : 0.0;
  return d;
}

}  // namespace bench
