// Strict reading of TOML: every key is known, every value in range, or the file is refused.
#pragma once

#include <toml++/toml.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/text/input_text.hpp"

namespace contct::read {

/// A range of numbers in words and as a test.
struct real_range {
  double least = 0.0;
  bool may_equal_least = true;
  const char* words = "";
  double most = 1.7976931348623157e308;
  [[nodiscard]] bool holds(double x) const {
    return (x > least || (may_equal_least && x == least)) && x <= most;
  }
};

inline constexpr real_range any_real{-1.7976931348623157e308, true, "a finite number"};
inline constexpr real_range positive_real{0.0, false, "a finite number greater than 0"};

/// A value in words: "-5", "\"abc\"", "a table", "an array of 3".
[[nodiscard]] std::string found_words(const toml::node& node);

/// "key[3]", with the index from 1.
[[nodiscard]] std::string indexed(std::string_view key, std::size_t from_zero);

/// One table of a TOML file. `where` names the table for people: "contact[2]", "beam", or "" for the file
/// itself. Every refusal is an input_error with file, line and column. The table and
/// the file's name must outlive this object.
class table_reader {
 public:
  table_reader(const toml::table& table, std::string where, std::string_view file)
      : table_(&table), where_(std::move(where)), file_(file) {}

  [[nodiscard]] bool has(std::string_view key) const { return table_->contains(key); }

  /// The node behind `key`; refuses the table when there is none.
  [[nodiscard]] const toml::node& required(std::string_view key, std::string_view allowed) const;

  [[nodiscard]] double real(std::string_view key, const real_range& range) const {
    return real_of(required(key, range.words), key, range);
  }
  [[nodiscard]] int integer(std::string_view key, int least, int most) const;
  [[nodiscard]] std::string text(std::string_view key) const {
    return std::string(text_of(required(key, "text"), key, "text"));
  }
  /// One of `choices`; returns its index.
  [[nodiscard]] std::size_t choice(std::string_view key,
                                   std::initializer_list<std::string_view> choices) const;
  /// An array of at least `least` entries, and at most `most`, of any type.
  [[nodiscard]] const toml::array& array(std::string_view key, std::string_view allowed, std::size_t least,
                                         std::size_t most = -1) const;
  /// An array of numbers in `range`, at least `least` of them.
  [[nodiscard]] std::vector<double> reals(std::string_view key, const real_range& range,
                                          std::size_t least) const;
  /// The values behind a key that takes one or a list: an array's entries, at least one, or the value itself.
  [[nodiscard]] std::vector<const toml::node*> each_of(std::string_view key, std::string_view allowed) const;
  /// The name of the i-th of these, from 0: "x[2]", or "x" where the value stands alone.
  [[nodiscard]] std::string name_of(std::string_view key, std::size_t i) const {
    return required(key, "").is_array() ? indexed(key, i) : std::string(key);
  }
  /// One number for all of `count` things, or an array with one for each of these `things`.
  [[nodiscard]] std::vector<double> reals_for(std::string_view key, const real_range& range,
                                              std::size_t count, std::string_view things) const;
  /// Which nodes or elements: [1, 3, 5], "2..20" or "all". Numbers from 1 to `count` in the file, each once;
  /// from 0 in the answer, in the order given.
  [[nodiscard]] std::vector<int> numbers(std::string_view key, int count) const;
  /// A table under `key`.
  [[nodiscard]] table_reader table(std::string_view key) const;
  /// An array of tables under `key`, at least one; refuses anything else.
  [[nodiscard]] std::vector<table_reader> tables(std::string_view key) const;
  /// The same, or none where the key is missing.
  [[nodiscard]] std::vector<table_reader> optional_tables(std::string_view key) const {
    return has(key) ? tables(key) : std::vector<table_reader>{};
  }

  /// A node under `key` as a number, a whole number or text. `name` is the key, with an index if any.
  [[nodiscard]] double real_of(const toml::node& node, std::string_view name, const real_range& range) const;
  [[nodiscard]] int integer_of(const toml::node& node, std::string_view name, int least, int most) const;
  [[nodiscard]] std::string_view text_of(const toml::node& node, std::string_view name,
                                         std::string_view allowed) const;

  /// Refuse every key but these.
  void allow_only(const std::vector<std::string_view>& keys) const;

  /// Refuse the file at `node`, whose `name` is the key, with an index if any.
  [[noreturn]] void refuse(const toml::node& node, std::string_view name, std::string_view found,
                           std::string_view allowed) const;
  /// Refuse the file at a key that is there; without `found`, for its value.
  [[noreturn]] void refuse_key(std::string_view key, std::string_view found, std::string_view allowed) const {
    refuse(required(key, allowed), key, found, allowed);
  }
  [[noreturn]] void refuse_key(std::string_view key, std::string_view allowed) const {
    refuse_key(key, found_words(required(key, allowed)), allowed);
  }
  /// Refuse the table itself.
  [[noreturn]] void refuse(std::string_view found, std::string_view allowed) const;
  /// Refuse `others` beside the key or keys in `beside`.
  void refuse_beside(std::initializer_list<std::string_view> others, std::string_view beside,
                     std::string_view allowed) const;

  /// A key with its table, as messages have it: "contact[2].face".
  [[nodiscard]] std::string full_name(std::string_view name) const;

  /// Where this table is, for messages: "pb.toml:12: contact[2]".
  [[nodiscard]] std::string place() const;

 private:
  const toml::table* table_;
  std::string where_;
  std::string_view file_;
};

/// Parse a whole document. Throws input_error with line and column.
[[nodiscard]] toml::table parse_toml(std::string_view text, std::string_view file);

}  // namespace contct::read
