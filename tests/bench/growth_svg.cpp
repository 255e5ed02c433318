#include "bench/growth_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bench {
namespace {

constexpr double panel_width = 300.0;
constexpr double panel_height = 300.0;
constexpr double left = 62.0;
constexpr double top = 48.0;
constexpr double pitch = panel_width + 190.0;

/// Whole decades around what is shown.
struct decades {
  int first = 0, last = 1;
  static decades around(const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    decades d{static_cast<int>(std::floor(std::log10(*least))),
              static_cast<int>(std::ceil(std::log10(*most)))};
    if (d.first == d.last) ++d.last;
    return d;
  }
  [[nodiscard]] double share(double value) const { return (std::log10(value) - first) / (last - first); }
};

struct axes {
  double x0 = 0.0;
  decades x, y;
  [[nodiscard]] double at_x(double dofs) const { return x0 + panel_width * x.share(dofs); }
  [[nodiscard]] double at_y(double ms) const { return top + panel_height * (1.0 - y.share(ms)); }
};

std::string power(int exponent) {
  return fmt::format("10<tspan dy=\"-5\" font-size=\"9\">{}</tspan>", exponent);
}

/// What the problems of a family are, for who sees the picture alone.
std::string words_of(const std::string& family) {
  if (family == "rail") return "rail: a beam over one-sided springs";
  if (family == "grid") return "grid: a plate over one-sided springs";
  if (family == "mat") return "mat: a free plate on a one-sided bed";
  return family;
}

std::string frame(const axes& a, const std::string& family) {
  std::string svg = fmt::format(
      "<text x=\"{:.0f}\" y=\"{:.0f}\" font-weight=\"bold\">{}</text>\n"
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#888\"/>\n",
      a.x0, top - 14, words_of(family), a.x0, top, panel_width, panel_height);
  for (int d = a.x.first; d <= a.x.last; ++d) {
    const double x = a.at_x(std::pow(10.0, d));
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"#ddd\"/>\n"
        "<text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">{4}</text>\n",
        x, top, top + panel_height, top + panel_height + 20, power(d));
  }
  for (int d = a.y.first; d <= a.y.last; ++d) {
    const double y = a.at_y(std::pow(10.0, d));
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{2:.1f}\" y2=\"{1:.1f}\" stroke=\"#ddd\"/>\n"
        "<text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
        a.x0, y, a.x0 + panel_width, a.x0 - 8, y + 4, power(d));
  }
  const double y = top + panel_height / 2;
  return svg + fmt::format(
                   "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">degrees of freedom</text>\n"
                   "<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"middle\">"
                   "milliseconds an event</text>\n",
                   a.x0 + panel_width / 2, top + panel_height + 40, a.x0 - 44, y);
}

/// What has not been used yet of `names`, in order of appearance.
template <class Name>
std::vector<std::string> distinct(const std::vector<growth_point>& points, Name name) {
  std::vector<std::string> names;
  for (const growth_point& p : points)
    if (std::find(names.begin(), names.end(), name(p)) == names.end()) names.push_back(name(p));
  return names;
}

std::string line_of(const axes& a, const std::vector<growth_point>& line, const std::string& colour,
                    double& label_floor) {
  std::string path;
  std::string marks;
  for (const growth_point& p : line) {
    path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "" : " ", a.at_x(p.dofs), a.at_y(p.ms_per_event));
    marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", a.at_x(p.dofs),
                         a.at_y(p.ms_per_event), colour);
  }
  const double y = std::max(a.at_y(line.back().ms_per_event) + 4, label_floor);
  label_floor = y + 15;
  const double slope = slope_of(line);
  const std::string words =
      std::isnan(slope) ? line.front().engine : fmt::format("{}, slope {:.2f}", line.front().engine, slope);
  return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n{}", path,
                     colour, marks) +
         fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n", a.x0 + panel_width + 6, y,
                     colour, words);
}

std::string panel(const std::vector<growth_point>& points, const std::string& family, double x0) {
  std::vector<double> dofs;
  std::vector<double> ms;
  for (const growth_point& p : points) {
    dofs.push_back(p.dofs);
    ms.push_back(p.ms_per_event);
  }
  const axes a{x0, decades::around(dofs), decades::around(ms)};
  std::string svg = frame(a, family);
  std::vector<std::vector<growth_point>> lines;
  for (const std::string& engine : distinct(points, [](const growth_point& p) { return p.engine; })) {
    std::vector<growth_point>& line = lines.emplace_back();
    for (const growth_point& p : points)
      if (p.engine == engine) line.push_back(p);
    std::sort(line.begin(), line.end(), [](const auto& p, const auto& q) { return p.dofs < q.dofs; });
  }
  // The dearest first: labels go down the picture and must not overlap.
  std::sort(lines.begin(), lines.end(),
            [](const auto& p, const auto& q) { return p.back().ms_per_event > q.back().ms_per_event; });
  double label_floor = top;
  for (const std::vector<growth_point>& line : lines) {
    const std::string& engine = line.front().engine;
    const std::string colour = engine == "refactor"    ? "#555555"
                               : engine == "updated"   ? "#0072b2"
                               : engine == "condensed" ? "#009e73"
                               : engine == "dissected" ? "#aa4499"
                                                       : "#d55e00";
    svg += line_of(a, line, colour, label_floor);
  }
  return svg;
}

}  // namespace

double slope_of(const std::vector<growth_point>& of_one_line) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const growth_point& p : of_one_line) {
    const double lx = std::log(p.dofs);
    const double ly = std::log(p.ms_per_event);
    n += 1, x += lx, y += ly, xx += lx * lx, xy += lx * ly;
  }
  const double spread = n * xx - x * x;
  return n < 2 || !(spread > 0) ? std::numeric_limits<double>::quiet_NaN() : (n * xy - x * y) / spread;
}

std::string growth_svg(const std::vector<growth_point>& points, const std::string& caption) {
  const std::vector<std::string> families = distinct(points, [](const growth_point& p) { return p.family; });
  const double width = left + pitch * static_cast<double>(families.size()) + 10;
  const double height = top + panel_height + 76;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\" role=\"img\">\n"
      "<title>Milliseconds an event against the size of the structure</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      "<text x=\"{2:.0f}\" y=\"{3:.0f}\">{4}; slope: the power of the size with which time grows</text>\n",
      width, height, left, height - 10, caption);
  double x0 = left;
  for (const std::string& family : families) {
    std::vector<growth_point> of_family;
    for (const growth_point& p : points)
      if (p.family == family) of_family.push_back(p);
    svg += panel(of_family, family, x0);
    x0 += pitch;
  }
  return svg + "</svg>\n";
}

}  // namespace bench
