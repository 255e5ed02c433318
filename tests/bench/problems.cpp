// Problems and calls of kernels by formula.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bench/bench.hpp"
#include "contct/kernel/contct.h"
#include "contct/kernel/contct.hpp"
#include "contct/number/random.hpp"

namespace bench {
namespace {

/// Returns frac(i * golden ratio): the same numbers spread over (0, 1) on every machine.
double phi(int i) {
  const double x = i * 0.6180339887498949;
  return x - std::floor(x);
}

std::string pair_at(int node, double face, double stiffness) {
  return fmt::format("[[contact]]\nnode = {}\nsurface = \"below\"\nface = {:.17g}\nstiffness = {:.17g}\n",
                     node, face, stiffness);
}

/// Returns a beam of `spans` spans of 100 unit elements under q = -0.01, with a one-sided spring at every
/// ninth node.
std::string rail(int spans) {
  std::string text = fmt::format("title = \"rail-{}\"\n[beam]\nlength = {}\nelements = {}\nEI = 1.0\n", spans,
                                 100 * spans, 100 * spans);
  for (int s = 0; s <= spans; ++s)
    text += fmt::format("[[support]]\nnode = {}\nfix = [\"w\"]\n", 100 * s + 1);
  int j = 0;
  for (int i = 5; i < 100 * spans; i += 9) {
    if (i % 100 == 0) continue;
    const double x = i % 100;
    const double w = 0.01 * x * (100.0 * 100.0 * 100.0 - 200 * x * x + x * x * x) / 24;
    ++j;
    text += pair_at(i + 1, -0.2 * (0.05 + 0.95 * phi(j)) * w, 24e-6 * (0.7 + 0.6 * phi(2 * j)));
  }
  return text + "[[step]]\nuniform = -0.01\n";
}

std::string plate(const char* name, int n) {
  return fmt::format(
      "title = \"{0}-{1}\"\n[plate]\nsize = [{1}.0, {1}.0]\nelements = [{1}, {1}]\nD = 1.0\nnu = 0.3\n", name,
      n);
}

/// Returns a free plate on a one-sided bed under its weight, and in a second step with an upward force at one
/// node.
std::string mat(int n) {
  const int node = (58 * n / 100) * (n + 1) + 37 * n / 100 + 1;
  const double w = 0.25 * n * n / 256.0;
  return plate("mat", n) +
         fmt::format(
             "[[bed]]\nmodulus = 0.00390625\nface = 0.0\n[[step]]\nuniform = -0.00390625\n[[step]]\n"
             "uniform = -0.00390625\npoint = [ {{ node = {}, w = {:.17g}, wx = {:.17g}, wy = {:.17g} }} ]\n",
             node, w, 0.137 * w, 0.311 * w);
}

/// Returns a simply supported plate over a grid of one-sided springs.
std::string grid(int n) {
  std::string edge;
  for (int node = 0; node < (n + 1) * (n + 1); ++node) {
    const auto [j, i] = std::div(node, n + 1);
    if (i == 0 || j == 0 || i == n || j == n) edge += fmt::format("{}{}", edge.empty() ? "" : ", ", node + 1);
  }
  std::string text = plate("grid", n) + fmt::format("[[support]]\nnodes = [{}]\nfix = [\"w\"]\n", edge);
  const int st = n < 100 ? 2 : 5;
  const double pi = std::acos(-1.0);
  int k = 0;
  for (int i = st; i < n; i += st) {
    for (int j = st; j < n; j += st) {
      ++k;
      text += pair_at(j * (n + 1) + i + 1,
                      -0.5 * (0.05 + 0.95 * phi(k)) * std::sin(pi * i / n) * std::sin(pi * j / n),
                      20 * (0.7 + 0.6 * phi(2 * k)) / (n * n));
    }
  }
  return text + fmt::format("[[step]]\nuniform = {:.17g}\n", -1.0 / (0.00406 * std::pow(n, 4)));
}

/// Pairs of every kind without an event: moving away, too far away, without response, and pressed on the
/// face.
struct quiet_pairs {
  explicit quiet_pairs(std::size_t n)
      : dd(2 * n), dtest(2 * n), cc(n), ss(n), id(n), isep(n), isurf(n), events(n) {
    contct::random_numbers random(1989);
    for (std::size_t i = 0; i < n; ++i) {
      id[i] = static_cast<int>(i) + 1;
      isurf[i] = random.chance(0.5) ? contct::face_above : contct::face_below;
      const double gap = 0.5 + 0.5 * random.unit();
      const int kind = random.whole(0, 9);
      const bool closed = kind == 0;
      isep[i] = closed ? contct::in_contact : contct::separated;
      cc[i] = isurf[i] * gap;
      dd[2 * i] = closed ? cc[i] : 0.0;
      dtest[2 * i] = kind == 1 ? 0.0 : isurf[i] * (closed || random.chance(0.5) ? 0.25 : -0.25) * gap;
    }
  }

  std::vector<double> dd, dtest, cc, ss;
  std::vector<int> id, isep, isurf;
  std::vector<contct::event> events;
};

}  // namespace

std::string text_of(const std::string& name) {
  const std::size_t dash = std::min(name.find('-'), name.size());
  const std::string family = name.substr(0, dash);
  int size = 0;
  (void)std::from_chars(name.data() + std::min(dash + 1, name.size()), name.data() + name.size(), size);
  if (size >= 2 && size <= 20'000 && family == "rail") return rail(size);
  if (size >= 4 && size <= 1400 && family == "mat") return mat(size);
  if (size >= 4 && size <= 1400 && family == "grid") return grid(size);
  throw std::invalid_argument("--problem: found \"" + name +
                              "\"; allowed: rail-S (2 to 20000 spans), mat-N, grid-N (4 to 1400 elements a "
                              "side)");
}

json time_kernels(std::size_t pairs, int rounds) {
  quiet_pairs q(pairs);
  double smin = 0.0;
  const auto call_fortran = [&](int nc) {
    contct_call_r8(q.dd.data(), q.dtest.data(), q.cc.data(), q.ss.data(), &smin, q.id.data(), q.isep.data(),
                   q.isurf.data(), nc, 1, 2);
    if (smin != 1.0) throw std::logic_error("a pair that was to be quiet has an event");
  };
  const auto call_cpp = [&] {
    contct::call<double> c{q.dd, q.dtest, q.cc, q.ss, 0.0, q.id, q.isep, q.isurf, {1, 2}};
    if (contct::contct(c, q.events) != 0) throw std::logic_error("a pair that was to be quiet has an event");
  };
  const auto lower_to_us_of = [](double& least, int repeats, const auto& call) {
    const double seconds = seconds_of([&] {
      for (int k = 0; k < repeats; ++k) call();
    });
    least = std::min(least, 1e6 * seconds / repeats);
  };
  const int repeats = static_cast<int>(std::max<std::size_t>(4'000'000 / pairs, 3));
  constexpr double never = std::numeric_limits<double>::infinity();
  double fortran = never, text = never, cpp = never;
  for (int round = 0; round < rounds; ++round) {
    lower_to_us_of(fortran, repeats, [&] { call_fortran(static_cast<int>(pairs)); });
    lower_to_us_of(text, 1000, [&] { call_fortran(0); });
    lower_to_us_of(cpp, repeats, call_cpp);
  }
  fortran -= text;
  return {{"pairs", pairs},
          {"fortran_us", fortran},
          {"text_us", text},
          {"cpp_us", cpp},
          {"ratio", fortran / cpp}};
}

}  // namespace bench
