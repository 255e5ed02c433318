#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>

#include "contct/lab/atlas.hpp"
#include "contct/write/pictures.hpp"

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

// The picture.

using svg::element;
using svg::text_markup;

constexpr double page_width = 980, page_height = 800;
constexpr double at_left = 86, at_right = 640;  // of the two columns of panels
constexpr double wide_width = 450, narrow_width = 300, panel_height = 230;
constexpr double first_panel = 184, pitch = panel_height + 74;

constexpr double least_share = 1e-3;  // the scale is logarithmic down to here; below it stands "none"

/// Where a panel stands, and what its x axis spans, in decades.
struct panel {
  double left, top, width, height;
  double from, to;

  [[nodiscard]] double x(double decade) const {
    return left + 14 + (width - 28) * (decade - from) / (to - from);
  }
  [[nodiscard]] double bottom() const { return top + height; }
  [[nodiscard]] double none() const { return bottom() - 16; }
  [[nodiscard]] double y(double share) const {
    constexpr double gap = 34;  // between 0.1 % and none
    const double of_scale = std::log10(std::max(share, least_share) / least_share) / -std::log10(least_share);
    return share <= 0.0 ? none() : none() - gap - (none() - gap - top - 12) * of_scale;
  }
};

enum class marker { disc, triangle, square };

/// How a line of points looks. Colours are of M. Okabe and K. Ito's set, which all eyes can tell apart.
struct look {
  const char* name;
  const char* colour;
  marker shape;
  const char* paint;  // of the mark
  const char* dashes;
};
constexpr look as_8_bytes = {"fortran: the listing, REAL of 8 bytes", "#0072B2", marker::disc,
                             R"(fill="#0072B2")", "none"};
constexpr look as_printed = {"fortran-r4: as printed, REAL of 4 bytes", "#D55E00", marker::triangle,
                             R"(fill="#D55E00" stroke="#ffffff")", "7 4"};
constexpr look as_corrected = {"corrected: the corrected rule", "#007F5F", marker::square,
                               R"(fill="#007F5F")", "none"};
constexpr look in_unit_1 = {"unit of length 1", "#0072B2", marker::disc, R"(fill="#0072B2")", "none"};
constexpr look in_unit_100 = {"unit of length 100", "#56A0D0", marker::disc,
                              R"(fill="#ffffff" stroke="#56A0D0" stroke-width="2")", "2 3"};

std::string line_between(double x1, double y1, double x2, double y2, std::string_view style) {
  return element("line",
                 fmt::format(R"(x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" {})", x1, y1, x2, y2, style));
}

std::string stroke_of(const look& l) {
  return fmt::format(R"(stroke="{}" stroke-width="2" stroke-dasharray="{}")", l.colour, l.dashes);
}

/// `more` are further attributes.
std::string mark(const look& l, double x, double y, std::string_view more = {},
                 std::string_view content = {}) {
  const std::string attributes = fmt::format("{}{}", l.paint, more);
  if (l.shape == marker::disc) return svg::circle(x, y, 4.5, attributes, content);
  if (l.shape == marker::square) return svg::rectangle(x - 4.5, y - 4.5, 9, 9, attributes, content);
  return element("path", fmt::format(R"(d="M{:.1f} {:.1f} l7 12 h-14 z" {})", x, y - 8, attributes), content);
}

/// "fortran, unit 1e-12, held: 92.5 % wrong (88.9 to 95.0 %) of 300".
std::string words_of(const atlas_cell& c) {
  const confidence sure = wilson(c.wrong, c.problems);
  return fmt::format("{}{}, unit {:.0e}, {}: {:.1f} % wrong ({:.1f} to {:.1f} %) of {}", c.kernel,
                     c.has_other_epsmul() ? fmt::format(" with EPSMUL {:.0e}", c.epsmul) : "", c.unit,
                     c.held ? "held" : "free", 100.0 * c.wrong / c.problems, 100 * sure.least,
                     100 * sure.most, c.problems);
}

/// A band, a line and a point for each cell; `decade` is where a cell stands.
template <class Decade>
std::string curve(const panel& p, std::span<const atlas_cell> cells, const look& l, Decade decade) {
  std::string upper;
  std::string lower;
  std::string line;
  std::string points;
  for (const atlas_cell& c : cells) {
    const confidence sure = wilson(c.wrong, c.problems);
    const double x = p.x(decade(c));
    const double y = p.y(static_cast<double>(c.wrong) / c.problems);
    upper += fmt::format("{:.1f},{:.1f} ", x, p.y(sure.most));
    lower.insert(0, fmt::format("{:.1f},{:.1f} ", x, p.y(sure.least)));
    line += fmt::format("{:.1f},{:.1f} ", x, y);
    points += mark(l, x, y, R"( class="point")", svg::title(words_of(c)));
  }
  return element("polygon",
                 fmt::format(R"(points="{}{}" fill="{}" fill-opacity="0.15")", upper, lower, l.colour)) +
         element("polyline", fmt::format(R"(points="{}" fill="none" {})", line, stroke_of(l))) + points;
}

/// 10 to the power, with a raised exponent.
std::string power_of_ten(int decade) {
  if (decade == 0) return "1";
  return fmt::format(R"(10<tspan dy="-5" font-size="10">{}{}</tspan>)", decade < 0 ? "\u2212" : "",
                     std::abs(decade));
}

/// A panel's frame and axes, with a tick every so many decades.
std::string frame(const panel& p, int every) {
  std::string text = svg::rectangle(p.left, p.top, p.width, p.height, R"(fill="#ffffff" stroke="#888888")");
  constexpr std::pair<double, const char*> shares[] = {
      {1.0, "100 %"}, {0.1, "10 %"}, {0.01, "1 %"}, {0.001, "\u2264 0.1 %"}, {0.0, "none"}};
  for (const auto& [share, words] : shares) {
    text += line_between(p.left, p.y(share), p.left + p.width, p.y(share), R"(stroke="#dddddd")");
    text += text_markup(p.left - 8, p.y(share) + 4, R"(text-anchor="end")", words);
  }
  for (int decade = static_cast<int>(std::ceil(p.from)); decade <= p.to; decade += every) {
    text += line_between(p.x(decade), p.bottom(), p.x(decade), p.bottom() + 5, R"(stroke="#888888")");
    text += text_markup(p.x(decade), p.bottom() + 20, R"(text-anchor="middle")", power_of_ten(decade));
  }
  return text;
}

std::string unit_panel(const panel& p, const atlas& a, bool held) {
  std::string text = frame(p, 4);
  const auto decade = [](const atlas_cell& c) { return std::log10(c.unit); };
  const std::pair<const char*, look> lines[] = {
      {"corrected", as_corrected}, {"fortran-r4", as_printed}, {"fortran", as_8_bytes}};
  for (const auto& line : lines) {
    std::vector<atlas_cell> cells = over_unit(a, held);
    std::erase_if(cells, [&line](const atlas_cell& c) { return c.kernel != line.first; });
    if (!cells.empty()) text += curve(p, cells, line.second, decade);
  }
  return text;
}

std::string epsmul_panel(const panel& p, const atlas& a, bool held) {
  const double printed = std::log10(printed_epsmul);
  std::string text = frame(p, 2);
  text += line_between(p.x(printed), p.top, p.x(printed), p.bottom() + 30,
                       R"(stroke="#888888" stroke-dasharray="3 3")");
  text += text_markup(p.x(printed) + 14, p.bottom() + 42, R"(text-anchor="end")",
                      "as printed: 2<tspan dy=\"-5\" font-size=\"10\">\u22128</tspan>");
  const auto decade = [](const atlas_cell& c) { return std::log10(c.epsmul); };
  text += curve(p, over_epsmul(a, held, epsmul_units[1]), in_unit_100, decade);
  return text + curve(p, over_epsmul(a, held, epsmul_units[0]), in_unit_1, decade);
}

std::string legend(double y, std::initializer_list<std::pair<double, look>> entries) {
  std::string text;
  for (const auto& [x, l] : entries)
    text += line_between(x, y, x + 34, y, stroke_of(l)) + mark(l, x + 17, y) +
            text_markup(x + 42, y + 4, "", l.name);
  return text;
}

std::string svg_heading(const atlas& a) {
  return text_markup(at_left, 36, R"(font-weight="bold" font-size="22")", "Where the 1989 code goes wrong") +
         text_markup(at_left, 60, "",
                     "Random problems answered wrong and not reported: off by more than 0.1 % of the largest "
                     "deflection.") +
         text_markup(at_left, 79, "",
                     fmt::format("{} problems a point, the same ones along each line (seed {}); bands: 95 % "
                                 "confidence.",
                                 a.request.problems, a.request.seed)) +
         legend(108, {{at_left, as_8_bytes}, {at_left + 310, as_printed}, {at_left + 630, as_corrected}});
}

/// Two rows of panels, held structures above free ones; by unit at the left, by EPSMUL at the right.
std::string panels(const atlas& a) {
  constexpr std::string_view strong = R"(font-weight="bold" font-size="15")";
  std::string text = text_markup(at_left, 148, strong, "By the unit of length") +
                     text_markup(at_right, 148, strong, "By EPSMUL, in 8 bytes") +
                     legend(first_panel - 14, {{at_right, in_unit_1}, {at_right + 155, in_unit_100}});
  double top = first_panel;
  for (const bool held : {true, false}) {
    text += text_markup(at_left, top - 10, "",
                        held ? "Structures held by supports" : "Free structures, held by contact alone");
    text += unit_panel({at_left, top, wide_width, panel_height, -12, 12}, a, held);
    text +=
        epsmul_panel({at_right, top, narrow_width, panel_height, -12, std::log10(printed_epsmul)}, a, held);
    top += pitch;
  }
  return text;
}

/// Below the left column.
std::string captions() {
  constexpr double below = first_panel + 2 * pitch;
  constexpr std::string_view middle = R"(text-anchor="middle")";
  return text_markup(at_left + wide_width / 2, below - 24, middle,
                     "size of the structure in the unit it is put in; EPSGAP stays 10<tspan dy=\"-5\" "
                     "font-size=\"10\">\u221210</tspan>") +
         text_markup(at_left + wide_width / 2, below - 4, middle,
                     "Paths that stop for a mechanism or a cycle report it, and are not counted as wrong.");
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

std::string atlas_svg(const atlas& a) {
  const std::string size = fmt::format(R"(width="{}" height="{}")", page_width, page_height);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
         element("svg",
                 fmt::format(R"(xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}" {} )"
                             R"(font-family="Helvetica, Arial, sans-serif" font-size="13" fill="#222222")",
                             page_width, page_height, size),
                 "\n" + svg::title("Where the 1989 code goes wrong") + "\n" +
                     element("rect", size + R"( fill="#ffffff")") + svg_heading(a) + panels(a) + captions());
}

}  // namespace contct::lab
