#include "contct/read/number_literals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "contct/read/toml_reader.hpp"
#include "contct/text/decimal.hpp"
#include "contct/text/input_text.hpp"

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

  /// The literal that begins there.
  [[nodiscard]] std::string_view number_at(const toml::source_position& p) const {
    constexpr std::string_view of_numbers = "0123456789+-._eExXoObBabcdfABCDF";
    if (p.line == 0 || p.line > starts_.size()) return {};
    std::string_view rest = text_.substr(starts_[p.line - 1]);
    for (toml::source_index column = 1; column < p.column && !rest.empty(); ++column) {
      rest.remove_prefix(1);
      while (!rest.empty() && (static_cast<unsigned char>(rest.front()) & 0xC0U) == 0x80U)
        rest.remove_prefix(1);
    }
    return rest.substr(0, rest.find_first_not_of(of_numbers));
  }

 private:
  std::string_view text_;
  std::vector<std::size_t> starts_;  // of lines
};

/// Call visit(node, value) for every finite number in the document.
template <class Visit>
void for_each_number(const toml::node& node, const Visit& visit) {
  if (const toml::table* const table = node.as_table()) {
    for (const auto& entry : *table) for_each_number(entry.second, visit);
  } else if (const toml::array* const array = node.as_array()) {
    for (const toml::node& entry : *array) for_each_number(entry, visit);
  } else if (const auto* const whole = node.as_integer()) {
    visit(node, static_cast<double>(whole->get()));
  } else if (const auto* const real = node.as_floating_point()) {
    if (std::isfinite(real->get())) visit(node, real->get());
  }
}

class literal_reader {
 public:
  literal_reader(std::string_view text, std::string_view file) : text_(text), file_(file) {}

  std::vector<written_number> read(const toml::table& document) {
    for_each_number(document, [this](const toml::node& node, double value) { keep(node, value); });
    if (kept_.empty()) return {};
    for_each_number(document, [this](const toml::node& node, double value) { refuse_mixed(node, value); });
    std::vector<written_number> numbers;
    for (const auto& [value, node] : kept_) numbers.push_back({value, literal_of(*node)});
    return numbers;
  }

 private:
  /// Whole numbers may be hexadecimal; they are exact as toml++ has them.
  [[nodiscard]] std::string literal_of(const toml::node& node) const {
    if (const auto* const whole = node.as_integer()) return fmt::format("{}", whole->get());
    return std::string(text_.number_at(node.source().begin));
  }

  [[nodiscard]] std::string place_of(const toml::node& node) const {
    return fmt::format("{}:{}:{}", file_, node.source().begin.line, node.source().begin.column);
  }

  [[noreturn]] void refuse(const toml::node& node, std::string_view found, std::string_view allowed) const {
    throw input_error(
        fmt::format("{}: found {}; allowed in exact arithmetic: {}", place_of(node), found, allowed));
  }

  void keep(const toml::node& node, double value) {
    constexpr std::size_t shown = 40;
    const std::string literal = literal_of(node);
    const std::optional<decimal> written = decimal_in(literal);
    if (!written) refuse(node, in_quotes(literal.substr(0, shown)), "a decimal number");
    if (is_shortest(literal, value)) return;
    if (value == 0)
      refuse(node, literal + ", which reads as 0",
             "0, or a number that double precision does not take for 0");
    kept_.try_emplace(value, &node);
  }

  void refuse_mixed(const toml::node& node, double value) const {
    const auto found = kept_.find(value);
    if (found == kept_.end() || decimal_in(literal_of(node)) == decimal_in(literal_of(*found->second)))
      return;
    refuse(node,
           fmt::format("{}, which reads as the same double as {} at {}", literal_of(node),
                       literal_of(*found->second), place_of(*found->second)),
           "numbers that are equal, or that doubles tell apart");
  }

  document_text text_;
  std::string_view file_;
  std::map<double, const toml::node*> kept_;  // the first of each value
};

/// The same, with each number's key.
template <class Visit>
void for_each_key(const toml::node& node, const std::string& key, const Visit& visit) {
  if (const toml::table* const table = node.as_table()) {
    for (const auto& entry : *table)
      for_each_key(entry.second, (key.empty() ? "" : key + ".") + std::string(entry.first.str()), visit);
  } else if (const toml::array* const array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i) for_each_key((*array)[i], indexed(key, i), visit);
  } else if (node.is_number()) {
    visit(node, key);
  }
}

}  // namespace

std::vector<placed_number> placed_numbers(const toml::table& document, std::string_view text) {
  const document_text in(text);
  std::vector<placed_number> numbers;
  for_each_key(document, "", [&](const toml::node& node, const std::string& key) {
    const toml::source_position& at = node.source().begin;
    const double value =
        node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
    const auto length = static_cast<int>(in.number_at(at).size());
    if (std::isfinite(value) && length > 0)
      numbers.push_back(
          {key, value, node.is_integer(), static_cast<int>(at.line), static_cast<int>(at.column), length});
  });
  std::ranges::sort(numbers, {}, [](const placed_number& n) { return std::pair(n.line, n.column); });
  return numbers;
}

std::vector<written_number> written_numbers(const toml::table& document, std::string_view text,
                                            std::string_view file) {
  return literal_reader(text, file).read(document);
}

}  // namespace contct::read
