#include "contct/lab/atlas_output.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace contct::lab {
namespace {

using json = nlohmann::ordered_json;

/// A cell without EPSMUL, or without errors, has null there.
json cell_json(const atlas_cell& c) {
  const confidence wrong = wilson(c.wrong, c.problems);
  const confidence uncertified = wilson(c.uncertified, c.problems);
  return {{"structures", c.held ? "held" : "free"},
          {"kernel", c.kernel},
          {"epsmul", c.epsmul == 0.0 ? json() : json(c.epsmul)},
          {"unit", c.unit},
          {"problems", c.problems},
          {"wrong", c.wrong},
          {"wrong_least", wrong.least},
          {"wrong_most", wrong.most},
          {"median_error", c.errors.empty() ? json() : json(median_error(c))},
          {"worst_error", c.errors.empty() ? json() : json(worst_error(c))},
          {"false_equilibrium", c.false_equilibrium},
          {"false_mechanism", c.false_mechanism},
          {"never_held", c.never_held},
          {"no_end", c.no_end},
          {"uncertified", c.uncertified},
          {"uncertified_least", uncertified.least},
          {"uncertified_most", uncertified.most}};
}

constexpr const char* meaning =
    R"(wrong     without a word: at the end of some step a deflection is off, an open
          pair is beyond its face or a closed one stands off it, by more than
          1e-3 of the largest deflection; or there is no equilibrium at all. The
          interval is Wilson's; the error is that of the deflections: where it
          is small, a pair's status, and with it a force, is what is wrong.
          One yardstick for both precisions: rounding to 4 bytes costs 6e-8, and
          only the kernel rounds so, all else being 8-byte. A program that is
          single precision throughout does worse than fortran-r4.
mech.     stopped for a mechanism where there is an equilibrium, and said so.
no end    stopped for a cycle or increments without end, and said so.
not cert. all of these, and what is off by more than the rounding of 8 bytes
          (the certificate's 1024 eps / rcond); says little of a 4-byte kernel.
Every row of a block has the same problems, but for the unit: three quarters
beams, a quarter plates, one to five load steps, springs over eight decades;
faces with gaps, at zero, mixed, at equal gaps, near ties, symmetric,
antisymmetric and on both sides, an eighth each. Another mix has other shares.
Nothing holds {} of the {} free structures of unit 1 at the start: fortran can
only stop there.
)";

/// unit or EPSMUL, kernel or unit, tried, wrong with its interval, median and worst error; mechanism, no end,
/// not certified
constexpr const char* row_format = "{:<6} {:<10} {:>5} {:>5} {:>10} {:>7} {:>7}  {:>5} {:>6} {:>6}\n";

std::string heading(std::string_view what, std::string_view first, std::string_view second) {
  return fmt::format("\n{}\n{:<6} {:<10} {:>5} {:>5} {:>10} {:>15}  {:>5} {:>6} {:>6}\n", what, "", "", "",
                     "wrong", "95 %", "error of wrong", "mech.", "no end", "not") +
         fmt::format(row_format, first, second, "tried", "%", "interval", "median", "worst", "%", "%",
                     "cert.%");
}

std::string row(const std::string& first, const std::string& second, const atlas_cell& c) {
  const confidence sure = wilson(c.wrong, c.problems);
  const auto error = [&c](double e) { return c.errors.empty() ? "-" : fmt::format("{:.1e}", e); };
  const auto percent = [&c](int part) {
    return fmt::format("{:.1f}", c.problems == 0 ? 0.0 : 100.0 * part / c.problems);
  };
  return fmt::format(row_format, first, second, c.problems, percent(c.wrong),
                     fmt::format("{:.1f}-{:.1f}", 100 * sure.least, 100 * sure.most), error(median_error(c)),
                     error(worst_error(c)), percent(c.false_mechanism), percent(c.no_end),
                     percent(c.uncertified));
}

/// "1e-12", "1".
std::string power_words(double power) {
  return power == 1.0 ? "1" : fmt::format("1e{:.0f}", std::log10(power));
}

std::string table_over_unit(const atlas& a, bool held) {
  std::string text = heading(held ? "Structures held by supports, by the unit of length"
                                  : "Free structures, held by their pairs alone, by the unit of length",
                             "unit", "kernel");
  for (const atlas_cell& c : over_unit(a, held)) text += row(power_words(c.unit), c.kernel, c);
  return text;
}

std::string table_over_epsmul(const atlas& a, bool held) {
  std::string text = heading(held ? "Structures held by supports, fortran with another EPSMUL"
                                  : "Free structures, fortran with another EPSMUL",
                             "EPSMUL", "");
  for (const double unit : epsmul_units) {
    for (const atlas_cell& c : over_epsmul(a, held, unit)) {
      text += row(has_other_epsmul(c) ? power_words(c.epsmul) : "2^-8", fmt::format("unit {}", unit), c);
    }
  }
  return text;
}

}  // namespace

std::string atlas_csv(const atlas& a) {
  std::string text;
  for (const atlas_cell& c : a.cells) {
    const json cell = cell_json(c);
    std::string names;
    std::string values;
    for (const auto& [name, value] : cell.items()) {
      names += (names.empty() ? "" : ",") + name;
      values += values.empty() ? "" : ",";
      values += value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump();
    }
    if (text.empty()) text = names + "\n";
    text += values + "\n";
  }
  return text;
}

std::string atlas_json(const atlas& a) {
  json cells = json::array();
  for (const atlas_cell& c : a.cells) cells.push_back(cell_json(c));
  const json document = {{"format", "contct-atlas-1"},
                         {"problems", a.request.problems},
                         {"seed", a.request.seed},
                         {"wrong_beyond", wrong_beyond},
                         {"cells", std::move(cells)}};
  return document.dump(1) + "\n";
}

std::string atlas_table(const atlas& a, const terminal& t) {
  std::string text = painted(t, paint::strong, "Where the 1989 code goes wrong") +
                     fmt::format("\n{} random problems a cell, seed {}; EPSMUL as printed is 2^-8 = 3.9e-3\n",
                                 a.request.problems, a.request.seed);
  for (const bool held : {true, false}) text += table_over_unit(a, held) + table_over_epsmul(a, held);
  int never_held = 0;
  for (const atlas_cell& c : a.cells) {
    if (c.kernel == "fortran" && !has_other_epsmul(c) && c.unit == 1.0) never_held += c.never_held;
  }
  return text + "\n" + fmt::format(meaning, never_held, a.request.problems);
}

}  // namespace contct::lab
