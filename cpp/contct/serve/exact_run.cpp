#include "contct/serve/exact_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/exact/definite.hpp"
#include "contct/exact/exact_means.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/text/memory.hpp"
#include "contct/write/words.hpp"

namespace contct::serve {
namespace {

void refuse_too_many_dofs(const problem& p, const std::string& file) {
  if (dofs(p.geometry) > most_exact_dofs)
    throw std::invalid_argument(
        fmt::format("{}: found {} dofs; allowed: at most {} in exact arithmetic, whose numbers grow with "
                    "them. Use fewer elements",
                    file, dofs(p.geometry), most_exact_dofs));
}

/// What numbers may grow to, in bits, in the memory that K, its factor modulo a prime and the vectors of a
/// path leave.
std::size_t longest_numbers(const exact_problem& p, const std::string& file) {
  // A rational is two numbers of 16 bytes and their bits; a node of a map has 40 more and its place.
  constexpr std::int64_t bytes_of_rational = 32;
  constexpr std::int64_t bytes_of_entry = 48 + bytes_of_rational + 32;
  constexpr std::int64_t bits_of_double = 68;  // its shortest decimal has 17 digits at most
  std::int64_t entries = 0;
  for (const auto& row : p.stiffness) entries += std::ssize(row);
  const std::int64_t n = std::ssize(p.fixed);
  const std::int64_t band = subdiagonals(p);
  const std::int64_t vectors =
      12 + 3 * std::ssize(p.steps);  // displacements, loads, responses and their digits
  const std::int64_t bytes = entries * bytes_of_entry + n * (band + 1) * 8;
  const std::int64_t bits = 4 * ((memory_limit() - bytes) / (vectors * n) - bytes_of_rational);
  if (bits < bits_of_double)
    throw std::invalid_argument(fmt::format(
        "{}: exact arithmetic: found {} dofs by a half bandwidth of {}, {} entries and {} vectors, which "
        "take {}; allowed: {} (CONTCT_MEMORY_MIB in the environment sets another limit). Use fewer "
        "elements",
        file, n, band, entries, vectors,
        bytes_words(bytes + vectors * n * (bytes_of_rational + bits_of_double / 4)),
        bytes_words(memory_limit())));
  return std::min(static_cast<std::size_t>(bits), lifted_solver::most_bits);
}

/// A matrix from elsewhere may be none of a structure, which the path's equations do not show. Those of beams
/// and plates are sums of elements, each of which is semidefinite.
void refuse_indefinite(const assembled& a, const exact_problem& p) {
  for (std::size_t dof = 0; dof < p.dofs(); ++dof)
    if (p.fixed[dof] == 0 && p.stiffness[dof].at(static_cast<int>(dof)) == 0)
      throw std::invalid_argument(
          fmt::format("{}: dof {}: found no stiffness and no support; allowed: a positive entry on the "
                      "diagonal, or a support",
                      a.name, a.label_of(static_cast<int>(dof))));
  const std::optional<negative_work> shown = [&] {
    try {
      return find_negative_work(p.stiffness, p.fixed, p.place, memory_limit());
    } catch (const std::runtime_error& e) {
      throw std::invalid_argument(fmt::format("{}: {}", a.name, e.what()));
    }
  }();
  if (!shown) return;
  const auto largest = std::ranges::max_element(
      shown->motion, [](const rational& x, const rational& y) { return abs(x) < abs(y); });
  const rational size = abs(*largest);
  throw std::invalid_argument(fmt::format(
      "{}: not positive semidefinite: found work {}, in exact arithmetic, on a displacement whose largest "
      "component, 1, is at dof {}; allowed: 0 or more on every displacement that the supports allow. Rounded "
      "entries can cause this, as in the matrix of a body without supports",
      a.name, short_words(shown->work / (size * size), 6),
      a.label_of(static_cast<int>(largest - shown->motion.begin()))));
}

/// Has the load of this step, or of one before it, no equilibrium?
bool true_path_ends_by(std::size_t step, const exact_problem& p) {
  const exact_path path = follow_true_path(p);
  return path.status == path_status::mechanism && path.steps.size() <= step;
}

}  // namespace

exact_problem exactly_read(const problem& p, const std::string& file) {
  refuse_too_many_dofs(p, file);
  exact_problem e = [&] {
    try {
      return exact_problem_of(p);
    } catch (const std::invalid_argument& wrong) {
      throw std::invalid_argument(fmt::format("{}: {}", file, wrong.what()));
    }
  }();
  e.longest = longest_numbers(e, file);
  if (const auto* const a = std::get_if<assembled>(&p.geometry.kind)) refuse_indefinite(*a, e);
  return e;
}

exact_path follow_exactly(const exact_problem& p, const std::string& rule, const std::string& file,
                          const exact_progress& tell) {
  try {
    if (rule != "1989") return follow_true_path(p, tell);
    exact_path path = follow_1989_path(p, tell);
    if (path.status == path_status::mechanism && !true_path_ends_by(path.steps.size(), p))
      path.status = path_status::path_ended;
    return path;
  } catch (const too_long& e) {
    throw std::invalid_argument(
        fmt::format("{}: exact numbers became too long: found {}; allowed: at most {} bits. Use numbers of "
                    "fewer digits, or fewer elements",
                    file, e.what(), p.longest));
  } catch (const std::runtime_error& e) {
    throw std::invalid_argument(fmt::format("{}: {}", file, e.what()));
  }
}

/// The path that `contct run` takes with this kernel, and the numbers that it hands out, beside the exact
/// ones.
kernel_digits digits_of_kernel(const std::string& name, const problem& p, const linear_structure& s,
                               const exact_path& exactly, observer* shown) {
  constexpr double rounding[] = {1e-9, 1e-4};  // of an event's share, in 8 and in 4 bytes
  const std::unique_ptr<kernel> leader = make_kernel(name);
  digit_counter counter(p, exactly);
  std::vector<observer*> all = {&counter, shown};
  std::erase(all, nullptr);
  certifier judged(p, s, exact_means_of(p));
  const path_end end = follow(p, s, engine_for(leader->facts(), "", s), *leader, all, {0, judged.ends()});
  return counter.result(name, end.status, rounding[leader->facts().real_bytes == 4 ? 1 : 0]);
}

}  // namespace contct::serve
