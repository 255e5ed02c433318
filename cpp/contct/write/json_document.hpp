// JSON files that are written value by value, and the values that several of them have.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/structure/model.hpp"
#include "contct/text/output_file.hpp"
#include "contct/write/load_text.hpp"

namespace contct::write {

/// An object written to a file while it grows: only the value at hand is in memory. Members and elements
/// stand on lines of their own, indented by their depth.
class json_document {
 public:
  /// Opens the object. `out` must outlive this one.
  explicit json_document(output_file& out);

  /// A member of the open object.
  void put(std::string_view name, const nlohmann::ordered_json& value);
  /// An element of the open array.
  void add(const nlohmann::ordered_json& value);

  /// An array as a member of the open object; an object as an element of the open array.
  void open_array(std::string_view name);
  void open_object();
  /// End what was opened last.
  void close();
  /// A whole array: entry(i) for each i below `count`.
  template <class Entry>
  void put_list(std::string_view name, std::size_t count, Entry entry) {
    open_array(name);
    for (std::size_t i = 0; i < count; ++i) add(entry(i));
    close();
  }

  /// End the document; the file appears.
  void finish();

 private:
  void begin_line();
  void begin_member(std::string_view name);
  void open(char closing);

  struct level {
    char closing;
    bool empty;
  };
  output_file& out_;
  std::vector<level> levels_;
};

/// A step's certificate as result files have it; null where there is none.
[[nodiscard]] nlohmann::ordered_json certificate_json(const std::optional<certificate>& c);

/// What acts at share `fraction` of step `step` (from 1), as a problem file's `uniform` and `point`, with the
/// resultant: an event's load in absolute terms. A beam's resultant has "force" and "moment", a plate's
/// "force", "moment_wx" and "moment_wy", a matrix's the "sum" of all its loads. The parts are left out where
/// load_path::has_many_parts: they would be written again at every event.
[[nodiscard]] nlohmann::ordered_json load_json(const model& m, const load_path& loads, int step,
                                               double fraction);

/// Add a node (from 0) to `entry`: "node": 3, or "dof": "185.3" where each dof is a node of its own.
void put_place(nlohmann::ordered_json& entry, const model& m, int node);

}  // namespace contct::write
