#include "contct/read/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/text/did_you_mean.hpp"

namespace contct {
namespace {

/// "file:12:3", or the file alone when the place is not known.
std::string place(std::string_view file, const toml::source_position& at) {
  return at.line == 0 ? std::string(file) : fmt::format("{}:{}:{}", file, at.line, at.column);
}

[[noreturn]] void refuse_at(std::string_view file, const toml::source_position& at, std::string_view name,
                            std::string_view found, std::string_view allowed) {
  throw input_error(fmt::format("{}: {}: found {}; allowed: {}", place(file, at), name, found, allowed));
}

/// Text from a file made fit for a message: no control characters, and cut, between characters, to a
/// length that people read.
std::string tame(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::size_t end = std::min(text.size(), longest);
  while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  std::string safe;
  for (const char ch : text.substr(0, end))
    safe += static_cast<unsigned char>(ch) < 32 || ch == 127 ? '?' : ch;
  return end < text.size() ? safe + "..." : safe;
}

}  // namespace

std::string found_words(const toml::node& node) {
  if (const auto* v = node.as_integer()) return fmt::format("{}", v->get());
  if (const auto* v = node.as_floating_point()) return fmt::format("{}", v->get());
  if (const auto* v = node.as_boolean()) return v->get() ? "true" : "false";
  if (const auto* v = node.as_string()) return fmt::format("\"{}\"", tame(v->get()));
  if (const auto* v = node.as_array())
    return v->empty() ? "an empty array" : fmt::format("an array of {}", v->size());
  if (node.is_table()) return "a table";
  return "a date or time";
}

std::string indexed(std::string_view key, std::size_t from_zero) {
  return fmt::format("{}[{}]", key, from_zero + 1);
}

namespace {

/// toml++ follows a dotted key by recursion: one of many thousand parts would end the stack. Refuse
/// any run of more than a thousand dots without a separator; no number or name of ours has one.
void refuse_endless_keys(std::string_view text, std::string_view file) {
  constexpr int most_dots = 1000;
  int dots = 0;
  for (const char ch : text) {
    if (ch == '.') {
      if (++dots > most_dots)
        throw input_error(fmt::format("{}: not TOML that we read: a key of over {} parts", file, most_dots));
    } else if (ch == ',' || ch == '=' || ch == '\n' || ch == '[' || ch == '{') {
      dots = 0;
    }
  }
}

}  // namespace

toml::table parse_toml(std::string_view text, std::string_view file) {
  refuse_endless_keys(text, file);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& e) {
    throw input_error(fmt::format("{}: not TOML: {}", place(file, e.source().begin), e.description()));
  }
}

table_reader::table_reader(const toml::table& table, std::string where, std::string_view file)
    : table_(&table), where_(std::move(where)), file_(file) {}

std::string table_reader::full_name(std::string_view name) const {
  if (where_.empty()) return std::string(name);
  return name.empty() ? where_ : fmt::format("{}.{}", where_, name);
}

void table_reader::refuse(const toml::node& node, std::string_view name, std::string_view found,
                          std::string_view allowed) const {
  refuse_at(file_, node.source().begin, full_name(name), found, allowed);
}

void table_reader::refuse(std::string_view found, std::string_view allowed) const {
  refuse_at(file_, table_->source().begin, where_.empty() ? "the file" : where_, found, allowed);
}

const toml::node& table_reader::required(std::string_view key, std::string_view allowed) const {
  const toml::node* node = table_->get(key);
  if (node == nullptr) {
    refuse_at(file_, table_->source().begin, full_name(key), "nothing: this key is missing", allowed);
  }
  return *node;
}

double table_reader::real_of(const toml::node& node, const std::string& name, const real_range& range) const {
  double value = 0.0;
  if (const auto* integer = node.as_integer()) {
    value = static_cast<double>(integer->get());
  } else if (const auto* real = node.as_floating_point()) {
    value = real->get();
  } else {
    refuse(node, name, found_words(node), range.words);
  }
  if (!std::isfinite(value) || !range.holds(value)) refuse(node, name, found_words(node), range.words);
  return value;
}

int table_reader::integer_of(const toml::node& node, const std::string& name, int least, int most) const {
  const auto* value = node.as_integer();
  if (value == nullptr || value->get() < least || value->get() > most) {
    refuse(node, name, found_words(node), fmt::format("a whole number from {} to {}", least, most));
  }
  return static_cast<int>(value->get());
}

std::string_view table_reader::text_of(const toml::node& node, const std::string& name,
                                       std::string_view allowed) const {
  const auto* value = node.as_string();
  if (value == nullptr) refuse(node, name, found_words(node), allowed);
  return value->get();
}

double table_reader::real(std::string_view key, const real_range& range) const {
  return real_of(required(key, range.words), std::string(key), range);
}

int table_reader::integer(std::string_view key, int least, int most) const {
  const std::string allowed = fmt::format("a whole number from {} to {}", least, most);
  return integer_of(required(key, allowed), std::string(key), least, most);
}

std::string table_reader::text(std::string_view key) const {
  return std::string(text_of(required(key, "text"), std::string(key), "text"));
}

std::size_t table_reader::choice(std::string_view key,
                                 std::initializer_list<std::string_view> choices) const {
  std::string allowed;
  for (const std::string_view c : choices)
    allowed += fmt::format("{}\"{}\"", allowed.empty() ? "" : " or ", c);
  const toml::node& node = required(key, allowed);
  const std::string_view value = text_of(node, std::string(key), allowed);
  const auto* const at = std::find(choices.begin(), choices.end(), value);
  if (at == choices.end()) {
    const std::vector<std::string> known(choices.begin(), choices.end());
    refuse(node, key, found_words(node) + did_you_mean(value, known), allowed);
  }
  return static_cast<std::size_t>(at - choices.begin());
}

std::vector<double> table_reader::reals(std::string_view key, const real_range& range,
                                        std::size_t least) const {
  const std::string allowed = fmt::format("an array of at least {} numbers, each {}", least, range.words);
  const toml::node& node = required(key, allowed);
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() < least) refuse(node, key, found_words(node), allowed);
  std::vector<double> values;
  values.reserve(array->size());
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::node& entry = *array->get(i);
    // The name is only made for a message: these arrays can be long.
    if (const auto* real = entry.as_floating_point();
        real != nullptr && std::isfinite(real->get()) && range.holds(real->get())) {
      values.push_back(real->get());
    } else {
      values.push_back(real_of(entry, indexed(key, i), range));
    }
  }
  return values;
}

table_reader table_reader::table(std::string_view key) const {
  const toml::node& node = required(key, "a table");
  const toml::table* table = node.as_table();
  if (table == nullptr) {
    const bool doubled = where_.empty() && node.is_array_of_tables();
    refuse(node, key, found_words(node),
           doubled ? fmt::format("a table, [{}] in single brackets", key) : "a table");
  }
  return {*table, full_name(key), file_};
}

std::vector<table_reader> table_reader::tables(std::string_view key) const {
  const toml::node& node = required(key, "at least one table");
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) {
    const bool single = where_.empty() && node.is_table();
    refuse(node, key, found_words(node),
           single ? fmt::format("at least one table, each under [[{}]] in double brackets", key)
                  : "an array of at least one table");
  }
  std::vector<table_reader> readers;
  readers.reserve(array->size());
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::table* table = array->get(i)->as_table();
    if (table == nullptr) refuse(*array->get(i), indexed(key, i), found_words(*array->get(i)), "a table");
    readers.emplace_back(*table, full_name(indexed(key, i)), file_);
  }
  return readers;
}

void table_reader::allow_only(const std::vector<std::string_view>& keys) const {
  for (const auto& [key, node] : *table_) {
    if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
    const std::vector<std::string> known(keys.begin(), keys.end());
    refuse_at(file_, key.source().begin, full_name(tame(key.str())),
              "an unknown key" + did_you_mean(key.str(), known), fmt::format("{}", fmt::join(keys, ", ")));
  }
}

}  // namespace contct
