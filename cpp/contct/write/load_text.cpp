#include "contct/write/load_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace contct {
namespace {

using json = nlohmann::ordered_json;
constexpr std::size_t most_parts = 32;
const load nothing;

/// Elements that follow one another, each once.
bool is_run(const std::vector<int>& elements) {
  return elements.back() - elements.front() + 1 == static_cast<int>(elements.size()) &&
         std::is_sorted(elements.begin(), elements.end());
}

/// How much there is to write: a list of scattered elements counts by its length.
std::size_t parts_of(const load& l) {
  std::size_t parts = l.points.size();
  for (const distributed_load& d : l.distributed)
    parts += d.elements.empty() || is_run(d.elements) ? 1 : d.elements.size();
  return parts;
}

json elements_json(const std::vector<int>& elements) {
  if (elements.empty()) return "all";
  if (is_run(elements)) return fmt::format("{}..{}", elements.front() + 1, elements.back() + 1);
  json list = json::array();
  for (const int e : elements) list.push_back(e + 1);
  return list;
}

}  // namespace

load_path::load_path(const problem& p) : problem_(p), totals_{resultant_of(p.geometry, nothing)}, parts_(1) {
  for (const load& l : p.steps) {
    totals_.push_back(resultant_of(p.geometry, l));
    parts_.push_back(parts_of(l));
  }
}

const load& load_path::before(int step) const {
  return step > 1 ? after(step - 1) : nothing;
}

load load_path::at(int step, double fraction) const {
  return mix(before(step), after(step), fraction);
}

resultant load_path::resultant_at(int step, double fraction) const {
  const resultant& a = totals_[static_cast<std::size_t>(step - 1)];
  const resultant& b = totals_[static_cast<std::size_t>(step)];
  resultant r{a.force + fraction * (b.force - a.force), a.moments};
  for (std::size_t i = 0; i < r.moments.size(); ++i) r.moments[i] += fraction * (b.moments[i] - a.moments[i]);
  return r;
}

bool load_path::has_many_parts(int step) const {
  const auto at = static_cast<std::size_t>(step);
  return std::max(parts_[at - 1], parts_[at]) > most_parts;
}

nlohmann::ordered_json load_path::json_at(int step, double fraction) const {
  const resultant r = resultant_at(step, fraction);
  const auto names = dof_names(problem_.geometry);
  json out = {{of_matrix() ? "sum" : "force", r.force}};
  for (std::size_t i = 0; i < r.moments.size(); ++i)
    out[r.moments.size() == 1 ? "moment" : fmt::format("moment_{}", names[i + 1])] = r.moments[i];
  if (has_many_parts(step)) return out;
  const load l = at(step, fraction);
  for (const distributed_load& d : l.distributed) {
    json part;
    if (d.polynomial.size() == 1) {
      part["value"] = d.polynomial[0];
    } else {
      part["polynomial"] = d.polynomial;
    }
    part["elements"] = elements_json(d.elements);
    out["uniform"].push_back(std::move(part));
  }
  for (const point_load& p : l.points) {
    json point;
    if (of_matrix()) {
      point["dof"] = std::get<assembled>(problem_.geometry.kind).label_of(p.node);
    } else {
      point["node"] = p.node + 1;
    }
    point[names[static_cast<std::size_t>(p.dof)]] = p.value;
    out["point"].push_back(std::move(point));
  }
  return out;
}

load_path::words load_path::words_for(const load& l, const resultant& r) const {
  if (l.points.size() == 1 && l.distributed.empty()) {
    const point_load& p = l.points[0];
    const char* const name = dof_names(problem_.geometry)[static_cast<std::size_t>(p.dof)];
    return {of_matrix() ? "" : fmt::format("{} ", name), p.value,
            " at " + place_words(problem_.geometry, p.node)};
  }
  if (l.points.empty() && l.distributed.size() == 1 && l.distributed[0].polynomial.size() == 1) {
    return {"uniform ", l.distributed[0].polynomial[0], ""};
  }
  return {of_matrix() ? "sum " : "force ", r.force, ""};
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

}  // namespace contct
