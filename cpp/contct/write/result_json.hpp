// The result of a run as JSON, format "contct-result-1", and what other JSON files share with it.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contct/session/run.hpp"
#include "contct/session/step_results.hpp"
#include "contct/text/output_file.hpp"
#include "contct/write/words.hpp"

namespace contct {

/// A list with what `entry` gives for each element. The JSON library is only needed where this is called.
template <class Json = nlohmann::ordered_json, class Range, class Entry>
[[nodiscard]] Json list_of(const Range& range, Entry entry) {
  Json list = Json::array();
  for (const auto& element : range) list.push_back(Json(entry(element)));
  return list;
}

/// An object with one array that grows: only the value at hand is in memory. The members of the object and of
/// the array's elements stand on lines of their own, indented by their depth, and so do the elements of
/// lists.
class json_document {
 public:
  using json = nlohmann::ordered_json;

  /// A list that is written in place of the member of its name: entry(i) for each i below `count`.
  struct list {
    std::string_view name;
    std::size_t count;
    std::function<json(std::size_t)> entry;
  };

  /// Opens the object with these members, then the array `name`. `out` must outlive this one.
  json_document(output_file& out, const json& members, std::string_view name);

  /// An element of the array: an object.
  void add(const json& members, const std::vector<list>& lists);

  /// End the array, and the document with these members behind it; the file appears.
  void finish(const json& members, const std::vector<list>& lists = {});

 private:
  void write_members(const json& members, const std::vector<list>& lists, int indent);

  output_file& out_;
  std::string_view before_;  // the next element
};

/// Numbers from 1.
[[nodiscard]] nlohmann::ordered_json numbered(const std::vector<int>& from_0);

/// The labels that a problem gives; null where it gives none.
[[nodiscard]] nlohmann::ordered_json units_json(const unit_labels& units);

/// { "w", .. }: the proved bounds on the errors of a step's numbers; null where nothing is proved.
[[nodiscard]] nlohmann::ordered_json error_json(const problem& p, const std::optional<certificate>& c);

/// A step's certificate as result files have it; null where there is none.
[[nodiscard]] nlohmann::ordered_json certificate_json(const std::optional<certificate>& c);

/// How many calls, and values in them, were compared, and how many of these differ.
[[nodiscard]] nlohmann::ordered_json agreement_json(std::int64_t calls, const tally& compared);

/// What acts at share `fraction` of step `step` (from 1), as a problem file's `uniform` and `point`, with the
/// resultant: an event's load in absolute terms. A beam's resultant has "force" and "moment", a plate's
/// "force", "moment_wx" and "moment_wy", a matrix's the "sum" of all its loads. The parts are left out where
/// load_path::has_many_parts: they would be written again at every event; `whole`: they are not.
[[nodiscard]] nlohmann::ordered_json load_json(const model& m, const load_path& loads, int step,
                                               double fraction, bool whole = false);

/// How many nodes have a known place, and such a node, from 0: its number (or name) and coordinates.
[[nodiscard]] std::size_t placed_nodes_of(const model& m);
[[nodiscard]] nlohmann::ordered_json node_json(const model& m, std::size_t node);

/// The structure as a run has it, in the order of its numbers: places of nodes, stiffnesses, supports, pairs.
[[nodiscard]] nlohmann::ordered_json structure_json(const problem& p);

/// What a support holds: its place, and its "dof".
[[nodiscard]] nlohmann::ordered_json support_json(const model& m, const support& at);

/// Pair `i`, from 0: its number, place and surface. An event, and a pair in a state: results and exact paths
/// have the same keys.
[[nodiscard]] nlohmann::ordered_json pair_json(const problem& p, std::size_t i);
[[nodiscard]] nlohmann::ordered_json event_json(const problem& p, const event& e);
[[nodiscard]] nlohmann::ordered_json pair_state_json(const problem& p, std::size_t i, int isep,
                                                     const nlohmann::ordered_json& gap,
                                                     const nlohmann::ordered_json& force);

/// The reaction of support `i`, from 0.
[[nodiscard]] nlohmann::ordered_json reaction_json(const problem& p, std::size_t i,
                                                   const nlohmann::ordered_json& value);

/// Add a node (from 0) to `entry`: "node": 3, or "dof": "185.3" where each dof is a node of its own.
void put_place(nlohmann::ordered_json& entry, const model& m, int node, int other = -1);

/// The proof of a run's bounds, for whoever checks it without this program (--proof): format
/// "contct-proof-2", of reference/proof-format.md. `judged` has kept its proofs of `p`.
[[nodiscard]] std::string proof_json(const problem& p, const certifier& judged);

/// Writes a whole result; the file appears.
void write_result(const run_result& r, output_file& out, result_parts parts = result_parts::ends);

}  // namespace contct
