#include "listing/errata.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <string_view>

namespace contct_test {
namespace {

/// A table of the file, and where it stands, for messages.
struct place {
  const toml::table& table;
  std::string where;

  [[noreturn]] void refuse(std::string_view key, const std::string& why) const {
    throw std::runtime_error(where + ", " + std::string(key) + ": " + why);
  }

  [[nodiscard]] std::string text(std::string_view key) const {
    const auto value = table[key].value<std::string>();
    if (!value || value->empty()) refuse(key, "a text is wanted");
    return *value;
  }

  [[nodiscard]] std::string text_if_any(std::string_view key) const {
    return table.contains(key) ? text(key) : "";
  }

  [[nodiscard]] std::vector<std::string> texts(std::string_view key) const {
    std::vector<std::string> all;
    const toml::array* const array = table[key].as_array();
    if (array == nullptr) refuse(key, "an array of texts is wanted");
    for (const toml::node& node : *array) {
      const auto value = node.value<std::string>();
      if (!value || value->empty()) refuse(key, "an array of texts is wanted");
      all.push_back(*value);
    }
    return all;
  }

  [[nodiscard]] const toml::array& tables(std::string_view key) const {
    const toml::array* const array = table[key].as_array();
    if (array == nullptr || array->empty() || !array->is_array_of_tables()) refuse(key, "tables are wanted");
    return *array;
  }

  /// A misspelt key must not pass for a missing one.
  void allow(std::initializer_list<std::string_view> known) const {
    for (const auto& [key, value] : table) {
      if (std::find(known.begin(), known.end(), key.str()) == known.end()) refuse(key.str(), "unknown key");
    }
  }
};

undo read_undo(const place& at) {
  at.allow({"name", "replace", "compile", "expect", "call", "field"});
  undo u{at.text("name"),
         {},
         at.table.contains("compile") ? at.texts("compile") : std::vector<std::string>{},
         at.text("expect"),
         at.text_if_any("call"),
         at.text_if_any("field")};
  for (const toml::node& node : at.tables("replace")) {
    const place line{*node.as_table(), at.where + ", replace"};
    line.allow({"from", "to"});
    u.replace.push_back({line.text("from"), line.text("to")});
  }
  return u;
}

erratum read_erratum(const place& at) {
  at.allow({"number", "title", "ocr", "compiled", "class", "confidence", "evidence", "undo"});
  const auto number = at.table["number"].value<long>();
  if (!number) at.refuse("number", "an integer is wanted");
  erratum e{*number,          at.text("title"),      at.texts("ocr"),     at.texts("compiled"),
            at.text("class"), at.text("confidence"), at.text("evidence"), {}};
  for (const toml::node& node : at.tables("undo")) {
    const std::string where = at.where + ", undo " + std::to_string(e.undos.size() + 1);
    e.undos.push_back(read_undo({*node.as_table(), where}));
  }
  return e;
}

}  // namespace

std::vector<erratum> read_errata(const std::filesystem::path& file) {
  const toml::table all = toml::parse_file(file.string());
  const place top{all, file.filename().string()};
  top.allow({"erratum"});
  std::vector<erratum> errata;
  for (const toml::node& node : top.tables("erratum")) {
    const std::string where = top.where + ", erratum " + std::to_string(errata.size() + 1);
    errata.push_back(read_erratum({*node.as_table(), where}));
  }
  return errata;
}

}  // namespace contct_test
