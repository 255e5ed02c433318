#include <nlohmann/json.hpp>

#include "contct/write/result_json.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

/// The number counted from 1; null if it is negative.
json number_of(int from_0) {
  return from_0 < 0 ? json(nullptr) : json(from_0 + 1);
}

void put_kind(json& out, const beam& b) {
  out["kind"] = "beam";
  for (const auto& [key, values, required] : element_keys)
    if (!(b.*values).empty()) out[key] = b.*values;
  if (!b.hinges.empty()) {
    out["hinges"] = numbered(b.hinges);
    out["hinge_stiffness"] = b.hinge_stiffness;
  }
  for (std::size_t e = 0; e < b.sections.size(); ++e) {
    const beam_section& s = b.sections[e];
    if (e > 0 && s == b.sections[e - 1]) continue;
    json& entry = out["sections"].emplace_back();
    entry = {{"element", e + 1}};
    for (const section_key& key : section_keys)
      if (s.*key.value > 0.0) entry[std::string(key.name)] = s.*key.value;
  }
}

void put_kind(json& out, const plate& p) {
  out["kind"] = "plate";
  out.update({{"columns", p.columns()}, {"D", p.D}, {"nu", p.nu}});
  if (p.E != 0) out.update({{"E", p.E}, {"thickness", p.thickness}});
}

/// Adds the dofs of a matrix, with their labels and, if positions are known, with node and direction.
void put_kind(json& out, const assembled& a) {
  out["kind"] = "matrix";
  out.update({{"matrix", a.name}, {"matrix_entries", a.stiffness.stored}, {"matrix_sha256", a.sha256}});
  if (!a.labels_from.empty()) out["labels_from"] = a.labels_from;
  const placed_nodes& places = a.places;
  if (places.known()) out["places_from"] = places.from;
  json& all = out["dofs"] = json::array();
  for (int dof = 0; dof < a.dofs(); ++dof) {
    json& entry = all.emplace_back(json{{"dof", a.label_of(dof)}});
    if (places.known())
      entry.update({{"at", number_of(places.dofs[dof].node)}, {"direction", places.dofs[dof].direction}});
  }
  out["edges"] = list_of(places.edges, [](const mesh_edge& e) -> json {
    return {e.from + 1, e.to + 1, e.elements};
  });
  out["notes"] = places.notes;
}

}  // namespace

std::size_t count_of_places(const model& m) {
  const auto* a = std::get_if<assembled>(&m.kind);
  return a != nullptr ? a->places.nodes.size() : nodes(m);
}

json node_json(const model& m, std::size_t node) {
  if (const auto* a = std::get_if<assembled>(&m.kind)) {
    const placed_node& n = a->places.nodes[node];
    return {{"node", n.name}, {"x", n.at[0]}, {"y", n.at[1]}, {"z", n.at[2]}};
  }
  const place at = place_of_node(m, static_cast<int>(node));
  json entry = {{"node", node + 1}, {"x", at.x}};
  if (std::holds_alternative<plate>(m.kind)) entry["y"] = at.y;
  return entry;
}

json structure_json(const problem& p) {
  json out = json::object();
  std::visit([&out](const auto& kind) { put_kind(out, kind); }, p.geometry.kind);
  json& all = out["nodes"] = json::array();
  for (std::size_t node = 0; node < count_of_places(p.geometry); ++node)
    all.push_back(node_json(p.geometry, node));
  out["supports"] = list_of(p.supports, [&p, i = 0](const support& s) mutable {
    json entry = support_json(p, i++);
    entry["spring"] = s.fixed ? json(nullptr) : json(s.spring);
    return entry;
  });
  out["pairs"] = list_of(p.pairs, [&p, i = 0](const contact_pair& at) mutable {
    json entry = pair_json(p, i++);
    entry.update({{"face", at.face},
                  {"stiffness", at.stiffness},
                  {"state", state_name(at.closed ? in_contact : separated)}});
    return entry;
  });
  for (const bed& b : p.beds)
    for (std::size_t i = 0; i < b.share.size(); ++i) out["pairs"][b.first_pair + i]["bed"] = b.share[i];
  return out;
}

}  // namespace contct
