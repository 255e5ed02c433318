#include "contct/write/json_document.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "contct/matrix/cholesky.hpp"

namespace contct::write {
namespace {

using json = nlohmann::ordered_json;

/// "all", "2..9", or a list; from 1.
json elements_json(const std::vector<int>& elements) {
  if (elements.empty()) return "all";
  if (is_run(elements)) return fmt::format("{}..{}", elements.front() + 1, elements.back() + 1);
  json list = json::array();
  for (const int e : elements) list.push_back(e + 1);
  return list;
}

}  // namespace

json_document::json_document(output_file& out) : out_(out) {
  open('}');
}

void json_document::open(char closing) {
  out_.write(closing == '}' ? "{" : "[");
  levels_.push_back({closing, true});
}

void json_document::begin_line() {
  level& here = levels_.back();
  out_.write(fmt::format("{}\n{:{}}", here.empty ? "" : ",", "", 2 * levels_.size()));
  here.empty = false;
}

void json_document::begin_member(std::string_view name) {
  begin_line();
  out_.write(json(name).dump() + ": ");
}

void json_document::put(std::string_view name, const json& value) {
  begin_member(name);
  out_.write(value.dump());
}

void json_document::add(const json& value) {
  begin_line();
  out_.write(value.dump());
}

void json_document::open_array(std::string_view name) {
  begin_member(name);
  open(']');
}

void json_document::open_object() {
  begin_line();
  open('}');
}

void json_document::close() {
  const level ended = levels_.back();
  levels_.pop_back();
  if (!ended.empty) out_.write(fmt::format("\n{:{}}", "", 2 * levels_.size()));
  out_.write({&ended.closing, 1});
}

void json_document::finish() {
  while (!levels_.empty()) close();
  out_.write("\n");
  out_.finish();
}

json certificate_json(const std::optional<certificate>& c) {
  if (!c) return nullptr;
  json out = {{"exact", c->exact},
              {"displacement_error", c->displacement_error},
              {"equilibrium", c->equilibrium},
              {"penetration", c->penetration},
              {"tension", c->tension},
              {"rcond", c->rcond},
              {"tolerance", c->tolerance},
              {"shape_error", c->shape_error},
              {"unique", c->unique},
              {"independent", c->independent},
              {"digits", digits_left(c->rcond)}};
  if (!c->unique) out["displacement_error"] = out["shape_error"] = nullptr;
  if (!c->problem.empty()) out["problem"] = c->problem;
  return out;
}

json load_json(const model& m, const load_path& loads, int step, double fraction) {
  const resultant r = loads.resultant_at(step, fraction);
  const auto names = dof_names(m);
  json out = {{std::holds_alternative<assembled>(m.kind) ? "sum" : "force", r.force}};
  for (std::size_t i = 0; i < r.moments.size(); ++i)
    out[r.moments.size() == 1 ? "moment" : fmt::format("moment_{}", names[i + 1])] = r.moments[i];
  if (loads.has_many_parts(step)) return out;
  const load l = loads.at(step, fraction);
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
    put_place(point, m, p.node);
    point[names[p.dof]] = p.value;
    out["point"].push_back(std::move(point));
  }
  return out;
}

void put_place(json& entry, const model& m, int node) {
  if (const auto* a = std::get_if<assembled>(&m.kind)) {
    entry["dof"] = a->label_of(node);
  } else {
    entry["node"] = node + 1;
  }
}

}  // namespace contct::write
