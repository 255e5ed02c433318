#include "contct/read/number_list.hpp"

#include <fmt/format.h>

#include <charconv>
#include <numeric>
#include <unordered_set>

namespace contct {
namespace {

std::vector<int> range(int first, int last) {
  std::vector<int> numbers(static_cast<std::size_t>(last - first + 1));
  std::iota(numbers.begin(), numbers.end(), first - 1);
  return numbers;
}

/// "a..b" as numbers from 1; false when the text is something else.
bool parse_range(std::string_view text, int& first, int& last) {
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos) return false;
  const char* const middle = text.data() + dots;
  const char* const end = text.data() + text.size();
  const auto [p, no_first] = std::from_chars(text.data(), middle, first);
  const auto [q, no_last] = std::from_chars(middle + 2, end, last);
  return no_first == std::errc{} && no_last == std::errc{} && p == middle && q == end;
}

}  // namespace

std::vector<int> read_numbers(const table_reader& table, std::string_view key, int count) {
  const std::string allowed =
      fmt::format(R"(a list of whole numbers from 1 to {}, each once, "a..b" or "all")", count);
  const toml::node& node = table.required(key, allowed);
  if (const auto* text = node.as_string()) {
    if (text->get() == "all") return range(1, count);
    int first = 0;
    int last = 0;
    if (parse_range(text->get(), first, last) && 1 <= first && first <= last && last <= count)
      return range(first, last);
    table.refuse(node, key, found_words(node), allowed);
  }
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) table.refuse(node, key, found_words(node), allowed);
  std::vector<int> numbers;
  std::unordered_set<int> seen;  // as long as the list, which may be one of very many short ones
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::node& entry = *array->get(i);
    const int number = table.integer_of(entry, indexed(key, i), 1, count) - 1;
    if (!seen.insert(number).second) {
      table.refuse(entry, indexed(key, i), found_words(entry) + ", a second time", allowed);
    }
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace contct
