#include <nlohmann/json.hpp>

#include "contct/write/result_json.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

/// Numbers from 1; null where there is none.
json number_of(int from_0) {
  return from_0 < 0 ? json(nullptr) : json(from_0 + 1);
}

void put_kind(json& out, const beam& b) {
  out["kind"] = "beam";
  out["nodes"] = list_of(b.x, [node = 0](double x) mutable -> json { return {{"node", ++node}, {"x", x}}; });
  out["EI"] = b.EI;
}

void put_kind(json& out, const plate& p) {
  out["kind"] = "plate";
  json& all = out["nodes"] = json::array();
  for (int node = 0; node < p.nodes(); ++node)
    all.push_back({{"node", node + 1}, {"x", p.x[node % p.columns()]}, {"y", p.y[node / p.columns()]}});
  out.update({{"columns", p.columns()}, {"D", p.D}, {"nu", p.nu}});
}

/// Of a matrix whose dofs have no places the labels alone.
void put_kind(json& out, const assembled& a) {
  out["kind"] = "matrix";
  out["matrix"] = a.name;
  const placed_nodes& places = a.places;
  out["nodes"] = list_of(places.nodes, [](const placed_node& n) -> json {
    return {{"node", n.name}, {"x", n.at[0]}, {"y", n.at[1]}, {"z", n.at[2]}};
  });
  json& all = out["dofs"] = json::array();
  for (int dof = 0; dof < a.dofs(); ++dof) {
    json& entry = all.emplace_back(json{{"dof", a.label_of(dof)}});
    if (places.known())
      entry.update({{"at", number_of(places.dofs[dof].node)}, {"direction", places.dofs[dof].direction}});
  }
  out["edges"] = list_of(places.edges, [](const mesh_edge& e) -> json {
    return {e.from + 1, e.to + 1, e.elements};
  });
  out["notes"] = places.said;
}

/// What a pair has of a bed: a tributary length or area; 0 where it is of none.
std::vector<double> tributary_shares(const problem& p) {
  std::vector<double> of_pair(p.pairs.size());
  for (const bed& b : p.beds)
    for (std::size_t i = 0; i < b.share.size(); ++i) of_pair[b.first_pair + i] = b.share[i];
  return of_pair;
}

}  // namespace

json structure_json(const problem& p) {
  json out = json::object();
  std::visit([&out](const auto& kind) { put_kind(out, kind); }, p.geometry.kind);
  out["supports"] = list_of(p.supports, [&p](const support& s) {
    json entry = support_json(p.geometry, s);
    entry["spring"] = s.fixed ? json(nullptr) : json(s.spring);
    return entry;
  });
  out["pairs"] = list_of(p.pairs, [&p, i = 0](const contact_pair& at) mutable {
    json entry = {{"pair", ++i}};
    put_place(entry, p.geometry, at.node);
    entry.update({{"surface", surface_name(at.surface)},
                  {"face", at.face},
                  {"stiffness", at.stiffness},
                  {"state", state_name(at.closed ? in_contact : separated)}});
    return entry;
  });
  const std::vector<double> shares = tributary_shares(p);
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (shares[i] > 0.0) out["pairs"][i]["bed"] = shares[i];
  return out;
}

}  // namespace contct
