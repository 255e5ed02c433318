#include "contct/read/written_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "contct/number/decimal.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

/// Goes forward through a text by lines and columns as toml++ counts them: from 1, columns in code points.
class text_walk {
 public:
  explicit text_walk(std::string_view text) : rest_(text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
  }

  /// The literal that begins there.
  [[nodiscard]] std::string_view number_at(int line, int column) {
    constexpr std::string_view of_numbers = "0123456789+-._eExXoObBabcdfABCDF";
    for (; line_ < line; ++line_, column_ = 1) rest_.remove_prefix(rest_.find('\n') + 1);
    for (; column_ < column && !rest_.empty(); ++column_) {
      rest_.remove_prefix(1);
      while (!rest_.empty() && (static_cast<unsigned char>(rest_.front()) & 0xC0U) == 0x80U)
        rest_.remove_prefix(1);
    }
    return rest_.substr(0, rest_.find_first_not_of(of_numbers));
  }

 private:
  std::string_view rest_;
  int line_ = 1, column_ = 1;
};

/// Append every finite number under `node`, which has this key. Whole numbers may be hexadecimal.
void append_numbers(const toml::node& node, const std::string& key, std::vector<written_number>& numbers) {
  const auto append = [&](double value, bool is_meant) {
    const toml::source_position& at = node.source().begin;
    numbers.push_back({key, value, node.is_integer(), static_cast<int>(at.line), static_cast<int>(at.column),
                       0, "", is_meant});
  };
  if (const toml::table* const table = node.as_table()) {
    for (const auto& [name, entry] : *table)
      append_numbers(entry, key.empty() ? std::string(name.str()) : fmt::format("{}.{}", key, name.str()),
                     numbers);
  } else if (const toml::array* const array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i) append_numbers(*array->get(i), indexed(key, i), numbers);
  } else if (const auto* const whole = node.as_integer()) {
    const auto value = static_cast<double>(whole->get());
    append(value, is_shortest(std::to_string(whole->get()), value));
  } else if (const auto* const real = node.as_floating_point()) {
    if (std::isfinite(real->get())) append(real->get(), true);
  }
}

}  // namespace

std::vector<written_number> numbers_in(const toml::table& document, std::string_view text) {
  std::vector<written_number> numbers;
  append_numbers(document, "", numbers);
  std::ranges::sort(numbers, {}, [](const written_number& n) { return std::pair(n.line, n.column); });
  text_walk walk(text);
  for (written_number& n : numbers) {
    n.literal = walk.number_at(n.line, n.column);
    n.length = static_cast<int>(n.literal.size());
    if (!n.is_whole) n.is_shortest = is_shortest(n.literal, n.value);
  }
  return numbers;
}

std::vector<std::string> rounding_warnings(const toml::table& document, std::string_view text,
                                           std::string_view file) {
  constexpr std::size_t most = 10;
  std::vector<std::string> warnings;
  std::size_t count = 0;
  for (const written_number& n : numbers_in(document, text))
    if (!n.is_shortest && count++ < most)
      warnings.push_back(
          fmt::format("{}:{}:{}: {}: {}", file, n.line, n.column, n.key, rounding_words(n.literal, n.value)));
  if (count > most)
    warnings.back() += fmt::format(" (the first {} of {} such numbers are shown)", most, count);
  return warnings;
}

}  // namespace contct
