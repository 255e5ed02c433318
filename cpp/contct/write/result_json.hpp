// Writes the result of a run as JSON, format "contct-result-2", and parts for other JSON outputs.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contct/results/envelope.hpp"
#include "contct/results/run.hpp"
#include "contct/results/step_results.hpp"
#include "contct/text/output_file.hpp"
#include "contct/write/words.hpp"

namespace contct {

/// A list of entry(element) for each element of `range`. Only its callers must include the JSON library.
template <class Json = nlohmann::ordered_json, class Range, class Entry>
[[nodiscard]] Json list_of(const Range& range, Entry entry) {
  Json list = Json::array();
  for (const auto& element : range) list.push_back(Json(entry(element)));
  return list;
}

/// Writes a JSON object with one long array, of which only one element at a time is in memory. Each member of
/// the object, each member of an element and each entry of a list is on a separate line, indented by depth.
class json_document {
 public:
  using json = nlohmann::ordered_json;

  /// A list, written as the value of the member `name`: entry(i) for each i from 0 to count - 1.
  struct list {
    std::string_view name;
    std::size_t count;
    std::function<json(std::size_t)> entry;
  };

  /// Writes the beginning of the object with `members`, then the beginning of the array `name`. `out` must
  /// outlive this object.
  json_document(output_file& out, const json& members, std::string_view name);

  /// Writes an element of the array: an object with `members`. If a member has the name of one of `lists`,
  /// its value is that list.
  void add(const json& members, const std::vector<list>& lists);

  /// Writes the end of the array, then `members` and the end of the object, and finishes the file.
  void finish(const json& members, const std::vector<list>& lists = {});

 private:
  void write_members(const json& members, const std::vector<list>& lists, int indent);

  output_file& out_;
  std::string_view before_;  // written before the next element
};

/// The numbers in `from_0`, each plus 1.
[[nodiscard]] nlohmann::ordered_json numbered(const std::vector<int>& from_0);

/// The unit labels of a problem; null if it has none.
[[nodiscard]] nlohmann::ordered_json units_json(const unit_labels& units);

/// The proved bounds on the errors at the end of a step, { "w": .., .. }; null for a kind without a proof.
[[nodiscard]] nlohmann::ordered_json error_json(const problem& p, const std::optional<certificate>& c);

/// The certificate of a step in result files; null if there is none.
[[nodiscard]] nlohmann::ordered_json certificate_json(const solved_step& s);

/// A value with its place; the least and the largest value of a quantity.
[[nodiscard]] nlohmann::ordered_json value_json(const model& m, const placed_value& at);
[[nodiscard]] nlohmann::ordered_json range_json(const model& m, const value_range& r);

/// An envelope, with its curves along a beam unless they are empty.
[[nodiscard]] nlohmann::ordered_json envelope_json(const problem& p, const envelope& e);

/// `mesh` of a step of a beam with beds.
[[nodiscard]] nlohmann::ordered_json mesh_error_json(const mesh_error& e);

/// The numbers of compared calls, compared values and mismatches.
[[nodiscard]] nlohmann::ordered_json agreement_json(std::int64_t calls, const tally& compared);

/// A load in absolute terms: its resultant `r` and, unless `parts` is null, `uniform` and `point` as in a
/// problem file. The resultant of a beam has a force and a moment, that of a plate a force, "moment_wx" and
/// "moment_wy", that of a matrix the "sum" of all its loads.
[[nodiscard]] nlohmann::ordered_json load_json(const model& m, const resultant& r, const load* parts);

/// The load at share `fraction` of step `step` (from 1). Without `whole`, a load of many parts
/// (load_path::has_many_parts) has only its resultant.
[[nodiscard]] nlohmann::ordered_json load_json(const problem& p, const load_path& loads, int step,
                                               double fraction, bool whole = false);

/// The number of nodes whose positions are known.
[[nodiscard]] std::size_t count_of_places(const model& m);

/// A node whose position is known, from 0, with name and coordinates.
[[nodiscard]] nlohmann::ordered_json node_json(const model& m, std::size_t node);

/// The structure: positions of nodes, stiffnesses, supports and pairs, each in the order of the numbers.
[[nodiscard]] nlohmann::ordered_json structure_json(const problem& p);

/// A support: its "node", and the name of its "dof".
[[nodiscard]] nlohmann::ordered_json support_json(const problem& p, std::size_t i);

/// Adds the name of an entry of a list, from 0, if it has one.
void put_name(nlohmann::ordered_json& entry, const problem& p, on list, std::size_t i);

/// The entry of a quantity of a watched part in `out`, which then lists all parts.
[[nodiscard]] nlohmann::ordered_json& watched_entry(nlohmann::ordered_json& out, const problem& p,
                                                    std::size_t part, const quantity_row& row);

/// Pair `i` (from 0); an event; a pair in a state. The keys are the same in results and exact paths.
[[nodiscard]] nlohmann::ordered_json pair_json(const problem& p, std::size_t i);
[[nodiscard]] nlohmann::ordered_json event_json(const problem& p, const event& e);
[[nodiscard]] nlohmann::ordered_json pair_state_json(const problem& p, std::size_t i, int isep,
                                                     const nlohmann::ordered_json& gap,
                                                     const nlohmann::ordered_json& force);

/// The reaction of support `i`, from 0.
[[nodiscard]] nlohmann::ordered_json reaction_json(const problem& p, std::size_t i,
                                                   const nlohmann::ordered_json& value);

/// The proof of the error bounds of a run, for independent checkers (--proof): format "contct-proof-2" of
/// reference/proof-format.md.
[[nodiscard]] std::string proof_json(const run_result& r);

/// Writes a whole result, and finishes the file.
void write_result(const run_result& r, output_file& out, result_parts parts = result_parts::ends);

}  // namespace contct
