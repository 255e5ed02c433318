// Strict reading of TOML: refuses unknown keys and values out of range. Also finds the files that a problem
// file names, and lists the numbers of a document as they are written.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/text/input_text.hpp"

namespace contct {

/// A range of numbers, with its description for messages.
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

/// "key[3]", with the index from 1; "table.key", or "key" if `table` is empty.
[[nodiscard]] std::string indexed(std::string_view key, std::size_t from_zero);
[[nodiscard]] std::string joined_key(std::string_view table, std::string_view key);

/// A number in a file, and its position.
struct written_number {
  std::string key;  ///< "step[1].point[2].w"
  double value = 0;
  bool is_whole = false;
  int line = 0, column = 0;       ///< from 1; column in code points
  bool stands_for_value = true;   ///< see stands_for
  std::string_view literal = {};  ///< as written
  std::string taken_as = {};      ///< the place that the number means; empty: the number itself
};

/// A value of a TOML file, and its name: "contact[2].face", or "" for the file itself. For a missing key
/// there is a toml_value too; reading it is refused. Every refusal is an input_error with file, line and
/// column. The document and the name of the file must outlive this object.
class toml_value {
 public:
  /// `numbers`: the document's numbers_in, or null; they must outlive this object, too.
  toml_value(const toml::table& document, std::string_view file,
             std::vector<written_number>* numbers = nullptr)
      : node_(&document), at_(document.source().begin), file_(file), numbers_(numbers) {}

  /// The value as a number, a whole number, text, or an index in `choices`. Refuses any other value.
  [[nodiscard]] double real(const real_range& range) const;
  [[nodiscard]] int integer(int least, int most) const;
  /// This number as it is written; null if the numbers of the document are not known.
  [[nodiscard]] written_number* written() const;
  [[nodiscard]] std::string text(std::string_view allowed = "text") const;
  [[nodiscard]] std::size_t choice(std::initializer_list<std::string_view> choices) const;

  /// The entries, of any type, of an array with `least` to `most` entries.
  [[nodiscard]] std::vector<toml_value> entries(std::string_view allowed, std::size_t least,
                                                std::size_t most = -1) const;
  /// The entries of an array, at least one; if the value is not an array, the value itself.
  [[nodiscard]] std::vector<toml_value> each(std::string_view allowed) const;
  /// An array of numbers in `range`, at least `least` of them.
  [[nodiscard]] std::vector<double> reals(const real_range& range, std::size_t least) const;
  /// [count] one number for all `things`, or an array of `count` numbers, one for each thing.
  [[nodiscard]] std::vector<double> reals_for(const real_range& range, std::size_t count,
                                              std::string_view things) const;
  /// Numbers of nodes or elements: [1, 3, 5], "2..20" or "all". In the file, the numbers are from 1 to
  /// `count`, each at most once; the result has them from 0, in the same order.
  [[nodiscard]] std::vector<int> numbers(int count) const;

  [[nodiscard]] toml_value table() const;
  /// The tables of an array, at least one.
  [[nodiscard]] std::vector<toml_value> tables() const;
  /// As `tables`, but empty if the key is missing.
  [[nodiscard]] std::vector<toml_value> optional_tables() const {
    return node_ == nullptr ? std::vector<toml_value>{} : tables();
  }

  /// has: true if this table has the key. []: the value of the key, which may be missing.
  [[nodiscard]] bool has(std::string_view key) const { return node_->as_table()->contains(key); }
  [[nodiscard]] toml_value operator[](std::string_view key) const;
  /// allow_only refuses keys not in `keys`. refuse_beside refuses `others` in a table that also has `beside`.
  void allow_only(const std::vector<std::string_view>& keys) const;
  void refuse_beside(std::initializer_list<std::string_view> others, std::string_view beside,
                     std::string_view allowed) const;

  /// The node of toml++. Refuses a missing value.
  [[nodiscard]] const toml::node& required(std::string_view allowed) const;
  [[nodiscard]] bool is_there() const { return node_ != nullptr; }
  [[nodiscard]] bool is_table() const { return node_ != nullptr && node_->is_table(); }
  [[nodiscard]] bool is_array() const { return node_ != nullptr && node_->is_array(); }

  /// The name of entry i, from 0, of this array; if this value is no array, the name of the value.
  [[nodiscard]] std::string name_of(std::size_t i) const { return is_array() ? indexed(name_, i) : name_; }
  /// The position of this value, for messages: "pb.toml:12: contact[2]".
  [[nodiscard]] std::string where() const;

  /// The value in words: "-5", "\"abc\"", "a table", "an array of 3".
  [[nodiscard]] std::string found() const;
  [[noreturn]] void refuse(std::string_view found, std::string_view allowed) const;
  [[noreturn]] void refuse(std::string_view allowed) const { refuse(found(), allowed); }

 private:
  /// A value inside this value. A missing inner value (null) gets the position of this value.
  [[nodiscard]] toml_value inner(const toml::node* node, std::string name) const {
    toml_value v = *this;
    v.node_ = node;
    v.name_ = std::move(name);
    if (node != nullptr) v.at_ = node->source().begin;
    return v;
  }

  [[nodiscard]] const toml::array& array(std::string_view allowed, std::size_t least,
                                         std::size_t most = -1) const;
  [[nodiscard]] toml_value entry_at(const toml::node& entry, std::size_t i) const {
    return inner(&entry, indexed(name_, i));
  }
  [[nodiscard]] bool is_top_level() const { return name_.find_first_of(".[") == std::string::npos; }
  [[nodiscard]] std::string name_of_key(std::string_view key) const { return joined_key(name_, key); }

  const toml::node* node_;      // null: missing
  toml::source_position at_{};  // if the value is missing: position of its table
  std::string name_;
  std::string_view file_;
  std::vector<written_number>* numbers_ = nullptr;
};

/// Parses a document. Throws input_error with line and column.
[[nodiscard]] toml::table parse_toml(std::string_view text, std::string_view file);

/// Where the files may be that a problem file names. own_folder: in the folder of the problem file or below,
/// so that a problem file from a stranger cannot read other files of the user.
enum class reach { own_folder, anywhere };

/// Finds files relative to the folder of the problem file.
class named_files {
 public:
  /// `problem_file`: the path of the problem file. A path without a folder means the working directory.
  named_files(std::string_view problem_file, reach allowed);

  /// The path of the named file, with `ending` appended. Unless all files are allowed, refuses a file that is
  /// not below the folder once symbolic links are followed.
  [[nodiscard]] std::string path_of(const toml_value& named, std::string_view ending = "") const;

  /// All paths that path_of has returned.
  [[nodiscard]] const std::vector<std::string>& all() const { return all_; }

 private:
  std::filesystem::path folder_;
  reach allowed_;
  mutable std::vector<std::string> all_;
};

/// All finite numbers of a document, in the order of the file. `text`: the text of the document.
[[nodiscard]] std::vector<written_number> numbers_in(const toml::table& document, std::string_view text);

/// A warning for each number that does not stand for its double, or is taken as another place, in the order
/// of the file; if there are many, only the first ten and the count.
[[nodiscard]] std::vector<std::string> rounding_warnings(const std::vector<written_number>& numbers,
                                                         std::string_view file);

}  // namespace contct
