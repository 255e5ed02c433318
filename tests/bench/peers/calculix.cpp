// CalculiX, by its own program, ccx.
//     solid    FOLDER SIZE: a block of bricks over springs, its matrix, and the problem
//     newton   its own nonlinear run of FOLDER/ccx.inp
// Time and memory are those of the whole program, which reads its input too.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "bench/peers/certified_state.hpp"
#include "bench/peers/exchange.hpp"
#include "peer/block.hpp"
#include "peer/calculix_results.hpp"

namespace {

using bench::peers::answer;
namespace peer = contct::app::peer;

/// Run ccx on FOLDER/JOB.inp. Throws std::runtime_error where it fails.
rusage run_ccx(const std::string& folder, const std::string& job) {
  const pid_t child = fork();
  if (child == 0) {
    const std::string log = job + ".log";
    if (chdir(folder.c_str()) == 0 && std::freopen(log.c_str(), "w", stdout) != nullptr)
      (void)execlp("ccx", "ccx", job.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  rusage used{};
  if (child < 0 || wait4(child, &status, 0, &used) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(fmt::format("ccx failed on {}/{}.inp; see {}.log", folder, job, job));
  return used;
}

/// Bricks of side 1, clamped at x = 0, over springs under every node of the lower face; a load at the free
/// end.
peer::block block_of(int n) {
  const auto phi = [](int i) { return i * 0.6180339887498949 - std::floor(i * 0.6180339887498949); };
  const int length = 4 * n;
  peer::block b{"solid", length, n, n, double(length), double(n), double(n), {}, 0, {-40.0 * n}};
  int number = 0;
  for (int i = 1; i <= length; ++i) {
    for (int j = 0; j <= n; ++j) {
      ++number;
      const double along = static_cast<double>(i) / length;
      b.supports.push_back({b.at(i, j, 0), -0.5 * (0.05 + 0.95 * phi(number)) * along * along,
                            20 * (0.7 + 0.6 * phi(2 * number))});
    }
  }
  b.loaded = b.at(length, n / 2, n);
  return b;
}

void write(const std::string& path, const std::string& text) {
  std::ofstream out(path);
  if (!(out << text).flush()) throw std::runtime_error(path + " cannot be written");
}

void make_solid(const std::string& folder, int n) {
  const peer::block b = block_of(n);
  write(folder + "/solid.inp", peer::matrix_deck_of(b));
  (void)run_ccx(folder, "solid");
  write(folder + "/problem.toml", peer::problem_of(b));
  write(folder + "/ccx.inp", peer::peer_deck_of(b, b.loads.front()));
  write(folder + "/ccx.txt", fmt::format("{} {} ALL {} {}\n", peer::block_scale, peer::block_force_scale,
                                         b.nodes(), b.nodes() + 1));
}

/// How FOLDER/ccx.inp was scaled, and what is where in the results.
struct deck_facts {
  explicit deck_facts(const std::string& folder) {
    std::ifstream in(folder + "/ccx.txt");
    if (!(in >> displacement_scale >> force_scale >> set >> nodes >> first_ground))
      throw std::runtime_error(folder + "/ccx.txt cannot be read");
  }
  double displacement_scale = 1.0, force_scale = 1.0;
  std::string set;
  int nodes = 0, first_ground = 0;
};

answer solve(const std::string& method, const std::string& folder) {
  if (method != "newton") throw std::invalid_argument("found method " + method + "; allowed: solid, newton");
  const deck_facts deck(folder);
  const bench::peers::contact_problem p = bench::peers::read_problem(folder);
  const bench::peers::certified_state rows = bench::peers::read_state(folder);
  (void)std::filesystem::remove(folder + "/ccx.dat");
  const rusage used = run_ccx(folder, "ccx");
  answer a;
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  a.seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
  a.peak_kib = used.ru_maxrss;
  const auto tables = contct::app::read_calculix_dat(folder + "/ccx.dat");
  const auto u = contct::app::values_at_end(tables, "displacements", deck.set, 1, deck.nodes, "ccx.dat");
  const auto held = contct::app::values_at_end(tables, "forces", "GROUND", deck.first_ground,
                                               static_cast<int>(p.springs.size()), "ccx.dat");
  for (const bench::peers::place& at : rows.places) {
    const bool printed = at.node > 0 && at.node <= deck.nodes && at.direction <= 3;
    a.u.push_back(printed ? u[at.node - 1][at.direction - 1] / deck.displacement_scale
                          : std::numeric_limits<double>::quiet_NaN());
  }
  for (std::size_t i = 0; i < held.size(); ++i)
    a.forces.push_back(-p.springs[i].side * held[i][2] / deck.force_scale);
  a.found = true;
  return a;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 || std::string(argv[1]) != "solid") return bench::peers::solve_as_asked(argc, argv, solve);
  try {
    make_solid(argv[2], std::stoi(argv[3]));
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}: {}\n", argv[0], e.what());
    return 1;
  }
}
