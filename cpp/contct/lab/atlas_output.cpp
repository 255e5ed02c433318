#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "contct/lab/atlas.hpp"

namespace contct::lab {
namespace {

using json = nlohmann::ordered_json;

template <class Wanted>
std::vector<atlas_cell> cells_that(const atlas& a, Wanted wanted) {
  std::vector<atlas_cell> cells;
  std::ranges::copy_if(a.cells, std::back_inserter(cells), wanted);
  return cells;
}

/// The cells with EPSMUL as printed, or without any: kernels over the unit of length. In order.
std::vector<atlas_cell> over_unit(const atlas& a, bool held) {
  return cells_that(a, [held](const atlas_cell& c) { return c.held == held && !c.has_other_epsmul(); });
}

/// The cells of the 8-byte listing in one unit, the printed EPSMUL first.
std::vector<atlas_cell> over_epsmul(const atlas& a, bool held, double unit) {
  return cells_that(a, [held, unit](const atlas_cell& c) {
    return c.held == held && c.kernel == "fortran" && c.unit == unit;
  });
}

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
          {"median_error", c.errors.empty() ? json() : json(c.median_error())},
          {"worst_error", c.errors.empty() ? json() : json(c.worst_error())},
          {"false_equilibrium", c.false_equilibrium},
          {"false_mechanism", c.false_mechanism},
          {"never_held", c.never_held},
          {"no_end", c.no_end},
          {"uncertified", c.uncertified},
          {"uncertified_least", uncertified.least},
          {"uncertified_most", uncertified.most}};
}

constexpr const char* meaning =
    R"(wrong     and not reported: at the end of some step a deflection is off, a
          separated pair is beyond its face or a pair in contact is off it, by
          more than 1e-3 of the largest deflection; or there is no equilibrium.
          The interval is Wilson's; the error is that of the deflections: where
          it is small, a pair's status, and with it a force, is wrong. The
          tolerance is the same for both precisions: rounding to 4 bytes costs
          6e-8, and only the kernel rounds so; the rest is 8-byte. A program
          that is single precision throughout does worse than fortran-r4.
mech.     stopped for a mechanism where there is an equilibrium, reported.
no end    stopped for a cycle or the limit of increments, reported.
not cert. all of these, and what is off by more than the rounding of 8 bytes
          (the certificate's 1024 eps / rcond); says little of a 4-byte kernel.
All rows of a block have the same problems, except for the unit: three quarters
beams, a quarter plates, one to five load steps, springs over eight decades;
faces with gaps, at zero, mixed, at equal gaps, near ties, symmetric,
antisymmetric and on both sides, an eighth each. Another mix gives other rates.
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
                     fmt::format("{:.1f}-{:.1f}", 100 * sure.least, 100 * sure.most), error(c.median_error()),
                     error(c.worst_error()), percent(c.false_mechanism), percent(c.no_end),
                     percent(c.uncertified));
}

/// "1e-12", "1".
std::string power_words(double power) {
  return power == 1.0 ? "1" : fmt::format("1e{:.0f}", std::log10(power));
}

std::string tables(const atlas& a, bool held) {
  std::string text = heading(held ? "Structures held by supports, by the unit of length"
                                  : "Free structures, held by their pairs alone, by the unit of length",
                             "unit", "kernel");
  for (const atlas_cell& c : over_unit(a, held)) text += row(power_words(c.unit), c.kernel, c);
  text += heading(held ? "Structures held by supports, fortran with another EPSMUL"
                       : "Free structures, fortran with another EPSMUL",
                  "EPSMUL", "");
  for (const double unit : epsmul_units)
    for (const atlas_cell& c : over_epsmul(a, held, unit))
      text += row(c.has_other_epsmul() ? power_words(c.epsmul) : "2^-8", fmt::format("unit {}", unit), c);
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
  return json_text(document, 1) + "\n";
}

std::string atlas_table(const atlas& a, const terminal& t) {
  std::string text = painted(t, paint::strong, "Where the 1989 code goes wrong") +
                     fmt::format("\n{} random problems a cell, seed {}; EPSMUL as printed is 2^-8 = 3.9e-3\n",
                                 a.request.problems, a.request.seed);
  for (const bool held : {true, false}) text += tables(a, held);
  int never_held = 0;
  for (const atlas_cell& c : a.cells) {
    if (c.kernel == "fortran" && !c.has_other_epsmul() && c.unit == 1.0) never_held += c.never_held;
  }
  return text + "\n" + fmt::format(meaning, never_held, a.request.problems);
}

}  // namespace contct::lab
