#include "mutants/definitions.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace contct_test {

const std::vector<std::string> mutable_files{"fortran/contct.f", "cpp/contct/kernel/contct.hpp",
                                             "cpp/contct/kernel/log_text.cpp",
                                             "cpp/contct/kernel/built_in.cpp"};

const std::vector<std::string> fault_classes{
    "canary",       "off by one", "index",      "comparison", "literal", "constant",  "stale state",
    "early return", "missing",    "arithmetic", "sign",       "order",   "condition", "text"};

namespace {

bool one_of(const std::vector<std::string>& known, const std::string& word) {
  return std::find(known.begin(), known.end(), word) != known.end();
}

std::string in_a_row(const std::vector<std::string>& known) {
  std::string row;
  for (const std::string& word : known) row += (row.empty() ? "" : ", ") + word;
  return row;
}

[[noreturn]] void refuse(const std::string& where, const std::string& why) {
  throw std::runtime_error(where + ": " + why);
}

/// The text of a key; "" where there is none and it need not be.
std::string text_of(const toml::table& table, const std::string& key, const std::string& where) {
  if (!table.contains(key)) return "";
  const auto value = table[key].value<std::string>();
  if (!value) refuse(where, key + " is no text");
  return *value;
}

mutant read_mutant(const toml::table& table, const std::string& where) {
  const std::vector<std::string> keys{"id", "file", "fault", "find", "replace", "equivalent"};
  for (const auto& [key, value] : table) {
    if (!one_of(keys, std::string(key.str())))
      refuse(where, "unknown key " + std::string(key.str()) + "; allowed: " + in_a_row(keys));
  }
  if (!table.contains("replace")) refuse(where, "replace is missing");
  mutant m;
  m.id = text_of(table, "id", where);
  m.file = text_of(table, "file", where);
  m.fault = text_of(table, "fault", where);
  m.find = text_of(table, "find", where);
  m.replace = text_of(table, "replace", where);
  m.equivalent = text_of(table, "equivalent", where);
  if (table.contains("equivalent") && m.equivalent.empty()) refuse(where, "an empty proof is none");
  return m;
}

void insist(const mutant& m, const std::string& where) {
  if (!one_of(mutable_files, m.file))
    refuse(where, "file: found \"" + m.file + "\"; allowed: " + in_a_row(mutable_files));
  if (m.id.substr(0, 2) != (is_fortran(m) ? "f-" : "c-"))
    refuse(where, "id: found \"" + m.id + "\"; allowed: f-... in FORTRAN, c-... in C++");
  if (!one_of(fault_classes, m.fault))
    refuse(where, "fault: found \"" + m.fault + "\"; allowed: " + in_a_row(fault_classes));
  if (m.find.empty()) refuse(where, "find is missing");
  if (m.find == m.replace) refuse(where, "find and replace are the same: nothing is mutated");
}

}  // namespace

bool is_fortran(const mutant& m) {
  return m.file == mutable_files.front();
}

std::vector<mutant> read_mutants(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const toml::table all = toml::parse_file(file.string());
  const toml::array* const tables = all["mutant"].as_array();
  if (tables == nullptr || all.size() != 1 || !tables->is_array_of_tables())
    refuse(name, "[[mutant]] tables are wanted, and nothing else");
  std::vector<mutant> mutants;
  std::set<std::string> ids;
  for (const toml::node& node : *tables) {
    const toml::table& table = *node.as_table();
    const std::string where =
        name + ", mutant " + std::to_string(mutants.size() + 1) + " " + text_of(table, "id", name);
    mutants.push_back(read_mutant(table, where));
    insist(mutants.back(), where);
    if (!ids.insert(mutants.back().id).second) refuse(where, "a second one of this id");
  }
  return mutants;
}

}  // namespace contct_test
