#include "contct/read/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_set>

#include "contct/number/decimal.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

namespace fs = std::filesystem;

/// "file:12:3", or the file alone if the position is not known.
std::string position(std::string_view file, const toml::source_position& at) {
  return at.line == 0 ? std::string(file) : fmt::format("{}:{}:{}", file, at.line, at.column);
}

/// Refuses more than a thousand dots without a separator, which no valid file has. toml++ reads a dotted key
/// by recursion, and thousands of parts would overflow the stack.
void refuse_endless_keys(std::string_view text, std::string_view file) {
  constexpr int most_dots = 1000;
  for (std::size_t from = 0, end = 0; end < text.size(); from = end + 1) {
    end = std::min(text.find_first_of(",=\n[{", from), text.size());
    if (std::ranges::count(text.substr(from, end - from), '.') > most_dots)
      refuse_line(file, 0, fmt::format("a key of more than {} parts", most_dots),
                  fmt::format("at most {} parts", most_dots));
  }
}

constexpr std::string_view point_not_comma = " (write a decimal point, 4.0 instead of 4,0)";

/// A hint if an array has twice as many whole numbers as `meant`: 4,0 is read as two numbers.
std::string_view comma_hint(const toml::node& node, std::size_t meant) {
  const toml::array* const array = node.as_array();
  const bool twice = array != nullptr && array->size() == 2 * meant && array->is_homogeneous<std::int64_t>();
  return twice ? point_not_comma : "";
}

/// True if a line that is not TOML has a decimal comma: "= 4,0" or "= 10.000,5"; or "0,05" anywhere, because
/// 05 is not a whole number in TOML.
bool has_decimal_comma(std::string_view line) {
  const auto is_digit = [line](std::size_t at) {
    return at < line.size() && line[at] >= '0' && line[at] <= '9';
  };
  const auto without = [](std::string_view text, std::string_view end) {
    return text.substr(0, text.find_last_not_of(end) + 1);
  };
  for (std::size_t at = line.find(','); at != std::string_view::npos; at = line.find(',', at + 1)) {
    const std::string_view before = without(line.substr(0, at), "0123456789");
    if (before.empty() || before.size() == at || !is_digit(at + 1)) continue;
    if (line[at + 1] == '0' && is_digit(at + 2)) return true;
    // There may be dots between thousands.
    if (without(without(before, "0123456789."), " \t+-").ends_with('=')) return true;
  }
  return false;
}

/// Goes forward through a text by lines and columns. Both count from 1, columns in code points, as in toml++.
class text_walk {
 public:
  explicit text_walk(std::string_view text) : rest_(text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
  }

  /// The text from this line and column on, which must not be before those of an earlier call.
  [[nodiscard]] std::string_view at(std::size_t line, std::size_t column) {
    for (; line_ < line; ++line_, column_ = 1) rest_.remove_prefix(rest_.find('\n') + 1);
    for (; column_ < column && !rest_.empty(); ++column_) {
      rest_.remove_prefix(1);
      while (!rest_.empty() && (static_cast<unsigned char>(rest_.front()) & 0xC0U) == 0x80U)
        rest_.remove_prefix(1);
    }
    return rest_;
  }

 private:
  std::string_view rest_;
  std::size_t line_ = 1, column_ = 1;
};

/// Characters of word processors, and the character of TOML in their place.
constexpr std::array<std::string_view, 2> lookalikes[] = {
    {"\u2212\u2010\u2011\u2012\u2013\u2014", "-"},
    {"\u201c\u201d\u201e\u201f\u2018\u2019\u201a\u00ab\u00bb", "\""},
    {"\u00a0\u2002\u2003\u2007\u2009\u200b\u202f\u3000\ufeff", "a blank"}};

/// The description of an error by toml++ in the form of other messages. `here` is the text from its place on.
std::string syntax_words(std::string_view description, std::string_view here) {
  const auto byte = [here](std::size_t i) {
    return i < here.size() ? static_cast<unsigned char>(here[i]) : 0U;
  };
  const bool long_character = byte(0) >= 0xe0;
  const std::string_view first = here.substr(0, long_character ? 3 : 2);
  const unsigned low = (byte(0) & 0x1fU) << 6U | (byte(1) & 0x3fU);
  for (const auto& [characters, allowed] : lookalikes)
    if (byte(0) >= 0xc0 && characters.find(first) != std::string_view::npos)
      return fmt::format("found {} (U+{:04X}); allowed: {}", in_quotes(first),
                         long_character ? low << 6U | (byte(2) & 0x3fU) : low, allowed);
  description.remove_prefix(std::min(description.size(), std::string_view("Error while parsing ").size()));
  const std::size_t colon = std::min(description.find(": "), description.size());
  const std::string_view part = description.substr(0, colon);
  const std::string_view why = description.substr(std::min(colon + 2, description.size()));
  const std::size_t saw = why.find(", saw ");
  const bool at_end = std::string_view("\r\n#").find(here.substr(0, 1)) != std::string_view::npos;
  if (part == "string" && at_end)
    return "found text without a quotation mark at its end; allowed: text in quotes on one line";
  if (part == "inline table" && at_end && !here.empty())
    return "found a line end or a comment in { .. }; allowed: all of { .. } on one line, or a table with a "
           "header";
  if (why.ends_with("(dangling comma)"))
    return "found a comma before }; allowed: no comma after the last key of { .. }";
  if (why.starts_with("expected ") && saw != std::string_view::npos)
    return fmt::format("found {} in {}; allowed: {}", why.substr(saw + 6), part, why.substr(9, saw - 9));
  if (why.starts_with("cannot redefine existing "))
    return fmt::format("found {} a second time; allowed: each key and table once", why.substr(25));
  if (why == "encountered end-of-file")
    return fmt::format("found the end of the file; allowed: the rest of this {}", part);
  if (part == "value")
    return fmt::format("found {}; allowed: a number, text in quotes, true, false, [ .. ] or {{ .. }}",
                       in_quotes(here.substr(0, here.find_first_of(" \t\r\n,]}#"))));
  return fmt::format("found {}: {}; allowed: TOML 1.0", part, why);
}

/// A hint that quotes may be missing, as in "title = Crane". `column`: where parsing failed, from 1.
std::string_view quotes_hint(std::string_view line, std::size_t column, std::string_view description) {
  if (description.find("expected '='") != std::string_view::npos)
    return line.find('=', column) == std::string_view::npos ? "" : " (write a name with blanks in quotes)";
  const std::size_t equals = line.rfind('=', column);
  const std::size_t first =
      equals == std::string_view::npos ? equals : line.find_first_not_of(" \t[", equals + 1);
  const bool is_text =
      first != std::string_view::npos && ((line[first] | 0x20) >= 'a' && (line[first] | 0x20) <= 'z');
  return is_text ? " (write text in quotes)" : "";
}

std::pair<int, int> position_of(const written_number& n) {
  return {n.line, n.column};
}

}  // namespace

std::string indexed(std::string_view key, std::size_t from_zero) {
  return fmt::format("{}[{}]", key, from_zero + 1);
}

std::string joined_key(std::string_view table, std::string_view key) {
  return fmt::format("{}{}{}", table, table.empty() ? "" : ".", key);
}

toml::table parse_toml(std::string_view text, std::string_view file) {
  refuse_endless_keys(text, file);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& e) {
    const toml::source_position at = e.source().begin;
    constexpr std::size_t longest = 300;  // the description quotes the file, including line ends
    text_walk walk(text);
    const std::string_view rest = walk.at(at.line, 1);
    const std::string_view line = rest.substr(0, rest.find('\n'));
    throw input_error(fmt::format(
        "{}: not TOML: {}{}", position(file, at),
        printable(syntax_words(e.description(), walk.at(at.line, at.column)), longest),
        has_decimal_comma(line) ? point_not_comma : quotes_hint(line, at.column, e.description())));
  }
}

written_number* toml_value::written() const {
  if (numbers_ == nullptr) return nullptr;
  const std::pair at(static_cast<int>(at_.line), static_cast<int>(at_.column));
  const auto found = std::ranges::lower_bound(*numbers_, at, {}, &position_of);
  return found == numbers_->end() || position_of(*found) != at ? nullptr : &*found;
}

std::string toml_value::found() const {
  if (node_ == nullptr) return "nothing: this key is missing";
  if (const auto* v = node_->as_integer()) return fmt::format("{}", v->get());
  if (const auto* v = node_->as_floating_point()) {
    const std::string text = fmt::format("{}", v->get());  // 4.0 must not look like a whole number
    return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
  }
  if (const auto* v = node_->as_boolean()) return v->get() ? "true" : "false";
  if (const auto* v = node_->as_string()) return in_quotes(v->get());
  if (const auto* v = node_->as_array())
    return v->empty() ? "an empty array" : fmt::format("an array of {}", v->size());
  return node_->is_table() ? "a table" : "a date or time";
}

std::string toml_value::where() const {
  return fmt::format("{}:{}: {}", file_, at_.line, name_);
}

void toml_value::refuse(std::string_view found, std::string_view allowed) const {
  throw input_error(fmt::format("{}: {}: found {}; allowed: {}", position(file_, at_),
                                name_.empty() ? "the file" : name_, found, allowed));
}

const toml::node& toml_value::required(std::string_view allowed) const {
  if (node_ == nullptr) refuse(allowed);
  return *node_;
}

double toml_value::real(const real_range& range) const {
  const toml::node& node = required(range.words);
  const auto* const whole = node.as_integer();
  const auto* const real = node.as_floating_point();
  if (whole == nullptr && real == nullptr) refuse(found().append(comma_hint(node, 1)), range.words);
  const double value = whole != nullptr ? static_cast<double>(whole->get()) : real->get();
  if (!std::isfinite(value) || !range.holds(value)) refuse(range.words);
  return value;
}

int toml_value::integer(int least, int most) const {
  const std::string allowed = fmt::format("a whole number from {} to {}", least, most);
  const auto* value = required(allowed).as_integer();
  if (value == nullptr || value->get() < least || value->get() > most) refuse(allowed);
  return static_cast<int>(value->get());
}

std::string toml_value::text(std::string_view allowed) const {
  const auto* value = required(allowed).as_string();
  if (value == nullptr) refuse(allowed);
  return value->get();
}

std::size_t toml_value::choice(std::initializer_list<std::string_view> choices) const {
  const std::vector<std::string> known(choices.begin(), choices.end());
  const std::string allowed = fmt::format("\"{}\"", fmt::join(known, "\" or \""));
  const std::string value = text(allowed);
  const auto at = std::ranges::find(known, value);
  if (at == known.end()) refuse(found() + did_you_mean(value, known), allowed);
  return at - known.begin();
}

const toml::array& toml_value::array(std::string_view allowed, std::size_t least, std::size_t most) const {
  const toml::array* const array = required(allowed).as_array();
  if (array == nullptr || array->size() < least || array->size() > most) refuse(allowed);
  return *array;
}

std::vector<toml_value> toml_value::entries(std::string_view allowed, std::size_t least,
                                            std::size_t most) const {
  std::vector<toml_value> all;
  for (const toml::node& entry : array(allowed, least, most)) all.push_back(entry_at(entry, all.size()));
  return all;
}

std::vector<toml_value> toml_value::each(std::string_view allowed) const {
  return required(allowed).is_array() ? entries(allowed, 1) : std::vector{*this};
}

std::vector<double> toml_value::reals(const real_range& range, std::size_t least) const {
  const std::string allowed = fmt::format("an array of at least {} numbers, each {}", least, range.words);
  std::vector<double> values;
  for (const toml::node& entry : array(allowed, least)) {
    // The name of an entry is made only for a message, because arrays of numbers can be long.
    const auto* const real = entry.as_floating_point();
    const bool good = real != nullptr && std::isfinite(real->get()) && range.holds(real->get());
    values.push_back(good ? real->get() : entry_at(entry, values.size()).real(range));
  }
  return values;
}

std::vector<double> toml_value::reals_for(const real_range& range, std::size_t count,
                                          std::string_view things) const {
  const toml::node& node = required(range.words);
  const bool is_one = !node.is_array() || (count == 1 && !comma_hint(node, 1).empty());
  std::vector<double> values = is_one ? std::vector<double>(count, real(range)) : reals(range, 1);
  if (values.size() != count)
    refuse(
        found().append(comma_hint(node, count)),
        count == 1 ? "one number" : fmt::format("one number, or {} numbers, one for each {}", count, things));
  return values;
}

std::vector<int> toml_value::numbers(int count) const {
  const std::string allowed =
      fmt::format(R"(a list of whole numbers from 1 to {}, each once, "a..b" or "all")", count);
  std::vector<int> list;
  if (const auto* text = required(allowed).as_string()) {
    const std::string_view range = text->get();
    const std::size_t dots = std::min(range.find(".."), range.size());
    const bool all = range == "all";
    const int first = all ? 1 : number_in<int>(range.substr(0, dots)).value_or(0);
    const int last = all ? count : number_in<int>(range.substr(std::min(dots + 2, range.size()))).value_or(0);
    if (first < 1 || first > last || last > count) refuse(allowed);
    list.resize(last - first + 1);
    std::iota(list.begin(), list.end(), first - 1);
    return list;
  }
  std::unordered_set<int> seen;  // not `count` flags: there may be thousands of short lists
  for (const toml_value& entry : entries(allowed, 1)) {
    list.push_back(entry.integer(1, count) - 1);
    if (!seen.insert(list.back()).second) entry.refuse(entry.found() + ", a second time", allowed);
  }
  return list;
}

toml_value toml_value::table() const {
  if (required("a table").is_table()) return *this;
  refuse(is_top_level() && node_->is_array_of_tables()
             ? fmt::format("a table, [{}] in single brackets", name_)
             : "a table");
}

std::vector<toml_value> toml_value::tables() const {
  if (required("at least one table").is_table() && is_top_level())
    refuse(fmt::format("at least one table, each under [[{}]] in double brackets", name_));
  if (is_table()) refuse("an array of at least one table: [ { .. } ], with brackets around the braces");
  std::vector<toml_value> all = entries("an array of at least one table", 1);
  for (const toml_value& t : all)
    if (!t.is_table()) t.refuse("a table");
  return all;
}

toml_value toml_value::operator[](std::string_view key) const {
  return inner(node_->as_table()->get(key), name_of_key(key));
}

void toml_value::refuse_beside(std::initializer_list<std::string_view> others, std::string_view beside,
                               std::string_view allowed) const {
  for (const std::string_view other : others)
    if (has(other)) (*this)[other].refuse(fmt::format("this key together with {}", beside), allowed);
}

void toml_value::allow_only(const std::vector<std::string_view>& keys) const {
  for (const auto& [key, node] : *node_->as_table()) {
    if (std::ranges::find(keys, key.str()) != keys.end()) continue;
    const std::vector<std::string> known(keys.begin(), keys.end());
    toml_value unknown = inner(nullptr, name_of_key(printable(key.str())));
    unknown.at_ = key.source().begin;
    unknown.refuse("an unknown key" + did_you_mean(key.str(), known), joined(known, ", "));
  }
}

named_files::named_files(std::string_view problem_file, reach allowed)
    : folder_(fs::path(problem_file).parent_path()), allowed_(allowed) {}

std::string named_files::path_of(const toml_value& named, std::string_view ending) const {
  const std::string name = named.text().append(ending);
  if (name.find('\0') != std::string::npos)  // system functions would end the name there
    named.refuse(in_quotes(name), "a file name without the character \\u0000");
  const std::string path = (folder_ / name).string();
  std::error_code wrong;
  const fs::path here = fs::current_path(wrong);
  const fs::path way = wrong ? fs::path() : fs::relative(here / path, here / folder_, wrong);
  const bool is_below = !wrong && !way.empty() && *way.begin() != "..";
  if (allowed_ == reach::own_folder && !is_below)
    named.refuse(
        in_quotes(name) + ", which is not below the folder of the problem file",
        "a file below this folder; with --allow-outside (\"allow_outside\" in the library) any file");
  // The file "-" gets the path "./-", because the path "-" means standard input.
  return all_.emplace_back(path == "-" ? "./-" : path);
}

namespace {

/// Appends every finite number under `node`, whose key is `key`.
void append_numbers(const toml::node& node, const std::string& key, std::vector<written_number>& numbers) {
  if (const toml::table* const table = node.as_table())
    for (const auto& [name, entry] : *table) append_numbers(entry, joined_key(key, name.str()), numbers);
  std::size_t count = 0;
  if (const toml::array* const array = node.as_array())
    for (const toml::node& entry : *array) append_numbers(entry, indexed(key, count++), numbers);
  const auto* const whole = node.as_integer();
  const auto* const real = node.as_floating_point();
  if (whole == nullptr && (real == nullptr || !std::isfinite(real->get()))) return;
  const double value = whole != nullptr ? static_cast<double>(whole->get()) : real->get();
  // A whole number may be hexadecimal, so it is compared as a decimal, not as its literal.
  const std::string decimal = whole != nullptr ? std::to_string(whole->get()) : "";
  const toml::source_position& at = node.source().begin;
  numbers.push_back({key, value, whole != nullptr, static_cast<int>(at.line), static_cast<int>(at.column),
                     stands_for(decimal, value)});
}

}  // namespace

std::vector<written_number> numbers_in(const toml::table& document, std::string_view text) {
  std::vector<written_number> numbers;
  append_numbers(document, "", numbers);
  std::ranges::sort(numbers, {}, position_of);
  constexpr std::string_view of_numbers = "0123456789+-._eExXoObBabcdfABCDF";
  text_walk walk(text);
  for (written_number& n : numbers) {
    const std::string_view here = walk.at(n.line, n.column);
    n.literal = here.substr(0, here.find_first_not_of(of_numbers));
    if (!n.is_whole) n.stands_for_value = stands_for(n.literal, n.value);
  }
  return numbers;
}

std::vector<std::string> rounding_warnings(const std::vector<written_number>& numbers,
                                           std::string_view file) {
  constexpr std::size_t most = 10;
  std::vector<std::string> warnings;
  std::size_t count = 0;
  for (const written_number& n : numbers) {
    if ((n.stands_for_value && n.taken_as.empty()) || count++ >= most) continue;
    const std::string words =
        n.stands_for_value ? "found " + printable(n.literal) : rounding_words(printable(n.literal), n.value);
    warnings.push_back(fmt::format("{}:{}:{}: {}: {}{}", file, n.line, n.column, n.key, words, n.taken_as));
  }
  if (count > most)
    warnings.back() += fmt::format(" (the first {} of {} such numbers are shown)", most, count);
  return warnings;
}

}  // namespace contct
