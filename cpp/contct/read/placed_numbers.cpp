#include "contct/read/placed_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "contct/read/toml_reader.hpp"
#include "contct/text/decimal.hpp"
#include "contct/text/strings.hpp"

namespace contct::read {
namespace {

/// The text of a file by line and column as toml++ counts them: from 1, columns in code points.
class document_text {
 public:
  explicit document_text(std::string_view text) : text_(text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
    starts_.push_back(0);
    for (std::size_t at = text_.find('\n'); at != std::string_view::npos; at = text_.find('\n', at + 1))
      starts_.push_back(at + 1);
  }

  /// The literal that begins there. Linear in the distance from the one before, if that is in the same line:
  /// a line may hold a hundred thousand numbers.
  [[nodiscard]] std::string_view number_at(const toml::source_position& p) {
    constexpr std::string_view of_numbers = "0123456789+-._eExXoObBabcdfABCDF";
    if (p.line == 0 || p.line > starts_.size()) return {};
    if (p.line != here_.line) {
      here_ = {p.line, 1};
      at_ = starts_[p.line - 1];
    }
    for (; here_.column < p.column && at_ < text_.size(); ++here_.column) {
      ++at_;
      while (at_ < text_.size() && is_inside_code_point(at_)) ++at_;
    }
    for (; here_.column > p.column; --here_.column) {
      --at_;
      while (is_inside_code_point(at_)) --at_;
    }
    const std::string_view rest = text_.substr(at_);
    return rest.substr(0, rest.find_first_not_of(of_numbers));
  }

 private:
  [[nodiscard]] bool is_inside_code_point(std::size_t at) const {
    return (static_cast<unsigned char>(text_[at]) & 0xC0U) == 0x80U;
  }

  std::string_view text_;
  std::vector<std::size_t> starts_;  // of lines
  toml::source_position here_{};
  std::size_t at_ = 0;  // of `here_`
};

/// The key of a number, put together only where it is asked for.
struct key_chain {
  const key_chain* above;
  std::string_view name;  ///< empty: an entry of an array
  std::size_t index;      ///< of that entry, from 0

  [[nodiscard]] std::string words() const {
    if (above == nullptr) return "";
    const std::string before = above->words();
    if (name.empty()) return indexed(before, index);
    return before.empty() ? std::string(name) : fmt::format("{}.{}", before, name);
  }
};

/// Call visit(node, value, key) for every finite number in the document.
template <class Visit>
void for_each_number(const toml::node& node, const key_chain& key, const Visit& visit) {
  if (const toml::table* const table = node.as_table()) {
    for (const auto& entry : *table) for_each_number(entry.second, {&key, entry.first.str(), 0}, visit);
  } else if (const toml::array* const array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i) for_each_number((*array)[i], {&key, "", i}, visit);
  } else if (const auto* const whole = node.as_integer()) {
    visit(node, static_cast<double>(whole->get()), key);
  } else if (const auto* const real = node.as_floating_point()) {
    if (std::isfinite(real->get())) visit(node, real->get(), key);
  }
}

/// Is the number, which is written so, the shortest decimal of its double? Whole numbers may be hexadecimal.
bool is_meant(const toml::node& node, std::string_view literal, double value) {
  const auto* const whole = node.as_integer();
  return is_shortest(whole != nullptr ? std::to_string(whole->get()) : literal, value);
}

}  // namespace

std::vector<placed_number> placed_numbers(const toml::table& document, std::string_view text) {
  document_text in(text);
  std::vector<placed_number> numbers;
  for_each_number(document, {}, [&](const toml::node& node, double value, const key_chain& key) {
    const toml::source_position& at = node.source().begin;
    const std::string_view literal = in.number_at(at);
    if (!literal.empty())
      numbers.push_back({key.words(), value, node.is_integer(), static_cast<int>(at.line),
                         static_cast<int>(at.column), static_cast<int>(literal.size()), literal,
                         is_meant(node, literal, value)});
  });
  std::ranges::sort(numbers, {}, [](const placed_number& n) { return std::pair(n.line, n.column); });
  return numbers;
}

std::vector<std::string> rounding_warnings(const toml::table& document, std::string_view text,
                                           std::string_view file) {
  constexpr std::size_t most = 10;
  std::vector<std::string> warnings;
  std::size_t count = 0;
  for (const placed_number& n : placed_numbers(document, text))
    if (!n.is_shortest && count++ < most)
      warnings.push_back(
          fmt::format("{}:{}:{}: {}: {}", file, n.line, n.column, n.key, rounding_words(n.literal, n.value)));
  if (count > most)
    warnings.back() += fmt::format(" (the first {} of {} such numbers are shown)", most, count);
  return warnings;
}

}  // namespace contct::read
