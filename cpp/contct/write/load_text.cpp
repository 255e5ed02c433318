#include "contct/write/load_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace contct::write {
namespace {

constexpr std::size_t most_parts = 32;

/// How much there is to write: a list of scattered elements counts by its length.
std::size_t parts_of(const load& l) {
  std::size_t parts = l.points.size();
  for (const distributed_load& d : l.distributed)
    parts += d.elements.empty() || is_run(d.elements) ? 1 : d.elements.size();
  return parts;
}

}  // namespace

bool is_run(const std::vector<int>& elements) {
  return elements.back() - elements.front() + 1 == static_cast<int>(elements.size()) &&
         std::is_sorted(elements.begin(), elements.end());
}

load_path::load_path(const problem& p) : problem_(p), totals_{resultant_of(p.geometry, {})}, parts_(1) {
  for (const load& l : p.steps) {
    totals_.push_back(resultant_of(p.geometry, l));
    parts_.push_back(parts_of(l));
  }
}

load load_path::at(int step, double fraction) const {
  if (step == 0) return {};
  return mix(step > 1 ? problem_.steps[step - 2] : load{}, problem_.steps[step - 1], fraction);
}

resultant load_path::resultant_at(int step, double fraction) const {
  const resultant& a = totals_[step - 1];
  const resultant& b = totals_[step];
  resultant r{a.force + fraction * (b.force - a.force), a.moments};
  for (std::size_t i = 0; i < r.moments.size(); ++i) r.moments[i] += fraction * (b.moments[i] - a.moments[i]);
  return r;
}

bool load_path::has_many_parts(int step) const {
  return std::max(parts_[step - 1], parts_[step]) > most_parts;
}

load_path::words load_path::words_for(const load& l, const resultant& r) const {
  const bool of_matrix = std::holds_alternative<assembled>(problem_.geometry.kind);
  if (l.points.size() == 1 && l.distributed.empty()) {
    const point_load& p = l.points[0];
    return {of_matrix ? "" : fmt::format("{} ", dof_names(problem_.geometry)[p.dof]), p.value,
            " at " + place_words(problem_.geometry, p.node)};
  }
  if (l.points.empty() && l.distributed.size() == 1 && l.distributed[0].polynomial.size() == 1)
    return {"uniform ", l.distributed[0].polynomial[0], ""};
  return {of_matrix ? "sum " : "force ", r.force, ""};
}

std::string load_path::words_at(int step, double fraction, int width) const {
  const load l = has_many_parts(step) ? load{} : at(step, fraction);
  const words w = words_for(l, resultant_at(step, fraction));
  const auto fits = [width](const std::string& text) { return static_cast<int>(text.size()) <= width; };
  for (int digits = 6; digits >= 3; --digits) {
    std::string text = fmt::format("{}{:.{}g}{}", w.before, w.value, digits, w.after);
    if (fits(text)) return text;
  }
  std::string number = fmt::format("{:.3g}", w.value);
  return fits(number) ? number : "";
}

}  // namespace contct::write
