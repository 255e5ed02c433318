#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "bench/bench.hpp"
#include "contct/read/problem_file.hpp"

namespace bench {
namespace {

/// Returns frac(i * golden ratio): the same numbers spread over (0, 1) on every machine.
double phi(int i) {
  const double x = i * 0.6180339887498949;
  return x - std::floor(x);
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
    ++j;
    const double x = i % 100;
    const double w = 0.01 * x * (100.0 * 100.0 * 100.0 - 200 * x * x + x * x * x) / 24;
    text += fmt::format("[[contact]]\nnode = {}\nsurface = \"below\"\nface = {:.17g}\nstiffness = {:.17g}\n",
                        i + 1, -0.2 * (0.05 + 0.95 * phi(j)) * w, 24e-6 * (0.7 + 0.6 * phi(2 * j)));
  }
  return text + "[[step]]\nuniform = -0.01\n";
}

/// Returns a free plate on a one-sided bed under its weight, and in a second step with an upward force at one
/// node.
std::string mat(int n) {
  const int node = (58 * n / 100) * (n + 1) + 37 * n / 100 + 1;
  const double w = n * n / 256.0;
  return fmt::format(
      "title = \"mat-{0}\"\n[plate]\nsize = [{0}.0, {0}.0]\nelements = [{0}, {0}]\nD = 1.0\nnu = 0.3\n"
      "[[bed]]\nmodulus = 0.00390625\nface = 0.0\n[[step]]\nuniform = -0.00390625\n[[step]]\nuniform = "
      "-0.00390625\n"
      "point = [ {{ node = {1}, w = {2:.17g}, wx = {3:.17g}, wy = {4:.17g} }} ]\n",
      n, node, 0.25 * w, 0.137 * 0.25 * w, 0.311 * 0.25 * w);
}

/// Returns a simply supported plate over a grid of one-sided springs.
std::string grid(int n) {
  std::string text = fmt::format(
      "title = \"grid-{0}\"\n[plate]\nsize = [{0}.0, {0}.0]\nelements = [{0}, {0}]\nD = 1.0\nnu = 0.3\n", n);
  std::string edge;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      if (i == 0 || j == 0 || i == n || j == n)
        edge += fmt::format("{}{}", edge.empty() ? "" : ", ", j * (n + 1) + i + 1);
    }
  }
  text += fmt::format("[[support]]\nnodes = [{}]\nfix = [\"w\"]\n", edge);
  const int st = n < 100 ? 2 : 5;
  const double pi = std::acos(-1.0);
  int k = 0;
  for (int i = st; i < n; i += st) {
    for (int j = st; j < n; j += st) {
      ++k;
      text += fmt::format(
          "[[contact]]\nnode = {}\nsurface = \"below\"\nface = {:.17g}\nstiffness = {:.17g}\n",
          j * (n + 1) + i + 1, -0.5 * (0.05 + 0.95 * phi(k)) * std::sin(pi * i / n) * std::sin(pi * j / n),
          20 * (0.7 + 0.6 * phi(2 * k)) / (n * n));
    }
  }
  return text + fmt::format("[[step]]\nuniform = {:.17g}\n", -1.0 / (0.00406 * std::pow(n, 4)));
}

}  // namespace

std::string text_of(const std::string& name) {
  const std::size_t dash = name.find('-');
  const std::string family = name.substr(0, dash);
  int size = 0;
  if (dash != std::string::npos)
    (void)std::from_chars(name.data() + dash + 1, name.data() + name.size(), size);
  std::string text;
  if (size >= 2 && size <= 20'000 && family == "rail") text = rail(size);
  if (size >= 4 && size <= 1400 && family == "mat") text = mat(size);
  if (size >= 4 && size <= 1400 && family == "grid") text = grid(size);
  if (text.empty())
    throw std::invalid_argument("--problem: found \"" + name +
                                "\"; allowed: rail-S (2 to 20000 spans), mat-N, grid-N (4 to 1400 elements a "
                                "side)");
  return text;
}

contct::problem make_problem(const std::string& name) {
  if (name.ends_with(".toml")) return contct::read_problem(name);

  return contct::parse_problem(text_of(name), name);
}

std::vector<std::string> usual_problems() {
  return {"rail-50", "rail-500", "grid-50", "mat-50", "grid-100", "mat-100"};
}

}  // namespace bench
