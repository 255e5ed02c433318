#include "contct/read/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "contct/text/input_text.hpp"
#include "contct/text/strings.hpp"

namespace contct::read {
namespace {

/// "file:12:3", or the file alone when the place is not known.
std::string position(std::string_view file, const toml::source_position& at) {
  return at.line == 0 ? std::string(file) : fmt::format("{}:{}:{}", file, at.line, at.column);
}

[[noreturn]] void refuse_at(std::string_view file, const toml::source_position& at, std::string_view name,
                            std::string_view found, std::string_view allowed) {
  throw input_error(fmt::format("{}: {}: found {}; allowed: {}", position(file, at), name, found, allowed));
}

std::string whole_words(int least, int most) {
  return fmt::format("a whole number from {} to {}", least, most);
}

/// toml++ follows a dotted key by recursion, which thousands of parts would overflow. Refuse a run of more
/// than a thousand dots without a separator; no number or name of ours has one.
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

constexpr std::string_view point_not_comma = " (a number takes a decimal point, 4.0 for 4,0)";

/// The words above where an array holds twice as many whole numbers as were `meant`: 4,0 is two of them.
std::string_view comma_hint(const toml::node& node, std::size_t meant) {
  const toml::array* const array = node.as_array();
  const bool twice = array != nullptr && array->size() == 2 * meant && array->is_homogeneous<std::int64_t>();
  return twice ? point_not_comma : "";
}

/// Has a line that is no TOML a decimal comma in it? "= 4,0", or "0,05" anywhere: no whole number begins so.
bool has_decimal_comma(std::string_view line) {
  const auto digits_from = [line](std::size_t at) {
    const std::size_t end = line.find_first_not_of("0123456789", at);
    return (end == std::string_view::npos ? line.size() : end) - std::min(at, line.size());
  };
  for (std::size_t at = line.find(','); at != std::string_view::npos; at = line.find(',', at + 1)) {
    const std::size_t before = line.find_last_not_of("0123456789", at == 0 ? 0 : at - 1);
    if (before == std::string_view::npos || before + 1 >= at || digits_from(at + 1) == 0) continue;
    const std::size_t equals = line.find_last_not_of(" \t+-", before);
    if (equals != std::string_view::npos && line[equals] == '=') return true;
    if (line[at + 1] == '0' && digits_from(at + 1) > 1) return true;
  }
  return false;
}

/// Line `number` of a text, from 1.
std::string_view line_of(std::string_view text, std::size_t number) {
  for (; number > 1 && text.find('\n') != std::string_view::npos; --number)
    text.remove_prefix(text.find('\n') + 1);
  return text.substr(0, text.find('\n'));
}

/// The numbers from 1 to `count` that "a..b" or "all" names; none where the text is something else.
std::pair<int, int> range_in(std::string_view text, int count) {
  if (text == "all") return {1, count};
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos) return {};
  return {number_in<int>(text.substr(0, dots)).value_or(0),
          number_in<int>(text.substr(dots + 2)).value_or(0)};
}

}  // namespace

std::string found_words(const toml::node& node) {
  if (const auto* v = node.as_integer()) return fmt::format("{}", v->get());
  if (const auto* v = node.as_floating_point()) return fmt::format("{}", v->get());
  if (const auto* v = node.as_boolean()) return v->get() ? "true" : "false";
  if (const auto* v = node.as_string()) return in_quotes(v->get());
  if (const auto* v = node.as_array())
    return v->empty() ? "an empty array" : fmt::format("an array of {}", v->size());
  if (node.is_table()) return "a table";
  return "a date or time";
}

std::string indexed(std::string_view key, std::size_t from_zero) {
  return fmt::format("{}[{}]", key, from_zero + 1);
}

toml::table parse_toml(std::string_view text, std::string_view file) {
  refuse_endless_keys(text, file);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& e) {
    const toml::source_position at = e.source().begin;
    constexpr std::size_t longest = 300;  // it quotes the file, line ends included
    throw input_error(fmt::format("{}: not TOML: {}{}", position(file, at),
                                  printable(e.description(), longest),
                                  has_decimal_comma(line_of(text, at.line)) ? point_not_comma : ""));
  }
}

std::string table_reader::full_name(std::string_view name) const {
  if (where_.empty()) return std::string(name);
  return name.empty() ? where_ : fmt::format("{}.{}", where_, name);
}

std::string table_reader::place() const {
  return fmt::format("{}:{}: {}", file_, table_->source().begin.line, where_);
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
  if (node == nullptr)
    refuse_at(file_, table_->source().begin, full_name(key), "nothing: this key is missing", allowed);
  return *node;
}

void table_reader::refuse_beside(std::initializer_list<std::string_view> others, std::string_view beside,
                                 std::string_view allowed) const {
  for (const std::string_view other : others)
    if (has(other)) refuse_key(other, fmt::format("this beside {}", beside), allowed);
}

double table_reader::real_of(const toml::node& node, std::string_view name, const real_range& range) const {
  const auto* const whole = node.as_integer();
  const auto* const real = node.as_floating_point();
  if (whole == nullptr && real == nullptr)
    refuse(node, name, fmt::format("{}{}", found_words(node), comma_hint(node, 1)), range.words);
  const double value = whole != nullptr ? static_cast<double>(whole->get()) : real->get();
  if (!std::isfinite(value) || !range.holds(value)) refuse(node, name, found_words(node), range.words);
  return value;
}

int table_reader::integer_of(const toml::node& node, std::string_view name, int least, int most) const {
  const auto* value = node.as_integer();
  if (value == nullptr || value->get() < least || value->get() > most)
    refuse(node, name, found_words(node), whole_words(least, most));
  return static_cast<int>(value->get());
}

std::string_view table_reader::text_of(const toml::node& node, std::string_view name,
                                       std::string_view allowed) const {
  const auto* value = node.as_string();
  if (value == nullptr) refuse(node, name, found_words(node), allowed);
  return value->get();
}

int table_reader::integer(std::string_view key, int least, int most) const {
  return integer_of(required(key, whole_words(least, most)), key, least, most);
}

std::size_t table_reader::choice(std::string_view key,
                                 std::initializer_list<std::string_view> choices) const {
  std::string allowed;
  for (const std::string_view c : choices)
    allowed += fmt::format("{}\"{}\"", allowed.empty() ? "" : " or ", c);
  const toml::node& node = required(key, allowed);
  const std::string_view value = text_of(node, key, allowed);
  const auto* const at = std::find(choices.begin(), choices.end(), value);
  if (at == choices.end()) {
    const std::vector<std::string> known(choices.begin(), choices.end());
    refuse(node, key, found_words(node) + did_you_mean(value, known), allowed);
  }
  return at - choices.begin();
}

const toml::array& table_reader::array(std::string_view key, std::string_view allowed, std::size_t least,
                                       std::size_t most) const {
  const toml::array* const array = required(key, allowed).as_array();
  if (array == nullptr || array->size() < least || array->size() > most) refuse_key(key, allowed);
  return *array;
}

std::vector<double> table_reader::reals(std::string_view key, const real_range& range,
                                        std::size_t least) const {
  const std::string allowed = fmt::format("an array of at least {} numbers, each {}", least, range.words);
  std::vector<double> values;
  for (const toml::node& entry : array(key, allowed, least)) {
    // The name is made for a message alone: these arrays can be long.
    const auto* const real = entry.as_floating_point();
    const bool good = real != nullptr && std::isfinite(real->get()) && range.holds(real->get());
    values.push_back(good ? real->get() : real_of(entry, indexed(key, values.size()), range));
  }
  return values;
}

std::vector<const toml::node*> table_reader::each_of(std::string_view key, std::string_view allowed) const {
  if (!required(key, allowed).is_array()) return {&required(key, allowed)};
  std::vector<const toml::node*> entries;
  for (const toml::node& entry : array(key, allowed, 1)) entries.push_back(&entry);
  return entries;
}

std::vector<double> table_reader::reals_for(std::string_view key, const real_range& range, std::size_t count,
                                            std::string_view things) const {
  const toml::node& node = required(key, range.words);
  if (!node.is_array() || (count == 1 && !comma_hint(node, 1).empty())) return {real(key, range)};
  std::vector<double> values = reals(key, range, 1);
  if (values.size() != count)
    refuse_key(key, fmt::format("{}{}", found_words(node), comma_hint(node, count)),
               count == 1 ? "one number" : fmt::format("one number, or {}: one for each {}", count, things));
  return values;
}

std::vector<int> table_reader::numbers(std::string_view key, int count) const {
  const std::string allowed =
      fmt::format(R"(a list of whole numbers from 1 to {}, each once, "a..b" or "all")", count);
  std::vector<int> list;
  if (const auto* text = required(key, allowed).as_string()) {
    const auto [first, last] = range_in(text->get(), count);
    if (first < 1 || first > last || last > count) refuse_key(key, allowed);
    for (int number = first; number <= last; ++number) list.push_back(number - 1);
    return list;
  }
  std::unordered_set<int> seen;  // not one mark for each of `count`: a file may hold thousands of short lists
  for (const toml::node& entry : array(key, allowed, 1)) {
    const std::string name = indexed(key, list.size());
    list.push_back(integer_of(entry, name, 1, count) - 1);
    if (!seen.insert(list.back()).second)
      refuse(entry, name, found_words(entry) + ", a second time", allowed);
  }
  return list;
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
  const bool single = where_.empty() && node.is_table();
  const std::string allowed =
      single ? fmt::format("at least one table, each under [[{}]] in double brackets", key)
             : "an array of at least one table";
  std::vector<table_reader> readers;
  for (const toml::node& entry : array(key, allowed, 1)) {
    const std::string name = indexed(key, readers.size());
    const toml::table* const table = entry.as_table();
    if (table == nullptr) refuse(entry, name, found_words(entry), "a table");
    readers.emplace_back(*table, full_name(name), file_);
  }
  return readers;
}

void table_reader::allow_only(const std::vector<std::string_view>& keys) const {
  for (const auto& [key, node] : *table_) {
    if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
    const std::vector<std::string> known(keys.begin(), keys.end());
    refuse_at(file_, key.source().begin, full_name(printable(key.str())),
              "an unknown key" + did_you_mean(key.str(), known), fmt::format("{}", fmt::join(keys, ", ")));
  }
}

}  // namespace contct::read
