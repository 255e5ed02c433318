// Strict reading of TOML: every key is known, every value in range, or the file is refused; also the files
// that it names, and its numbers as written.
#pragma once

#include <toml++/toml.h>

#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/text/input_text.hpp"

namespace contct {

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

/// "key[3]", with the index from 1.
[[nodiscard]] std::string indexed(std::string_view key, std::size_t from_zero);

/// The positions of nodes in a tree that toml++ did not parse.
using toml_places = std::map<const toml::node*, toml::source_position>;

/// A value of a TOML file, which knows its name for people: "contact[2].face", or "" for the file itself. A
/// key that is not there is a value too, which is refused where it is read. Every refusal is an input_error
/// with file, line and column. The document and the file's name must outlive this object.
class toml_value {
 public:
  toml_value(const toml::table& document, std::string_view file)
      : node_(&document), at_(document.source().begin), file_(file) {}
  /// The same of a tree that toml++ did not parse; `places` must outlive this object, too.
  toml_value(const toml::table& document, std::string_view file, const toml_places& places)
      : node_(&document), file_(file), places_(&places) {}

  /// A number, a whole number, text, or one of `choices`, of which this is the index.
  [[nodiscard]] double real(const real_range& range) const;
  [[nodiscard]] int integer(int least, int most) const;
  [[nodiscard]] std::string text(std::string_view allowed = "text") const;
  [[nodiscard]] std::size_t choice(std::initializer_list<std::string_view> choices) const;

  /// The entries of an array that has at least `least` of any type, and at most `most`.
  [[nodiscard]] std::vector<toml_value> entries(std::string_view allowed, std::size_t least,
                                                std::size_t most = -1) const;
  /// The entries of a value that may be a list: an array's entries, at least one, or the value itself.
  [[nodiscard]] std::vector<toml_value> each(std::string_view allowed) const;
  /// An array of numbers in `range`, at least `least` of them.
  [[nodiscard]] std::vector<double> reals(const real_range& range, std::size_t least) const;
  /// One number for all of `count` things, or an array with one for each of these `things`.
  [[nodiscard]] std::vector<double> reals_for(const real_range& range, std::size_t count,
                                              std::string_view things) const;
  /// Which nodes or elements: [1, 3, 5], "2..20" or "all". Numbers from 1 to `count` in the file, each once;
  /// from 0 in the answer, in the order given.
  [[nodiscard]] std::vector<int> numbers(int count) const;

  [[nodiscard]] toml_value table() const;
  /// The tables of an array, at least one.
  [[nodiscard]] std::vector<toml_value> tables() const;
  /// The same, or none if the key is missing.
  [[nodiscard]] std::vector<toml_value> optional_tables() const {
    return node_ == nullptr ? std::vector<toml_value>{} : tables();
  }

  /// For a table: does it have the key, and which value?
  [[nodiscard]] bool has(std::string_view key) const { return node_->as_table()->contains(key); }
  [[nodiscard]] toml_value operator[](std::string_view key) const;
  /// Refuse every key but these, and `others` together with the key or keys in `beside`.
  void allow_only(const std::vector<std::string_view>& keys) const;
  void refuse_beside(std::initializer_list<std::string_view> others, std::string_view beside,
                     std::string_view allowed) const;

  /// The node; a missing one is refused.
  [[nodiscard]] const toml::node& required(std::string_view allowed) const;
  [[nodiscard]] bool is_table() const { return node_ != nullptr && node_->is_table(); }
  [[nodiscard]] bool is_array() const { return node_ != nullptr && node_->is_array(); }

  /// The name of the i-th entry, from 0; or the value's own if it applies to all entries.
  [[nodiscard]] std::string name_of(std::size_t i) const { return is_array() ? indexed(name_, i) : name_; }
  /// The position of this value, for messages: "pb.toml:12: contact[2]".
  [[nodiscard]] std::string where() const;

  /// The value in words: "-5", "\"abc\"", "a table", "an array of 3".
  [[nodiscard]] std::string found() const;
  [[noreturn]] void refuse(std::string_view found, std::string_view allowed) const;
  [[noreturn]] void refuse(std::string_view allowed) const { refuse(found(), allowed); }

 private:
  /// A value inside this one; a missing one is where this one is.
  [[nodiscard]] toml_value inner(const toml::node* node, std::string name) const {
    toml_value v = *this;
    v.node_ = node;
    v.name_ = std::move(name);
    if (node != nullptr) v.at_ = places_ == nullptr ? node->source().begin : places_->at(node);
    return v;
  }

  [[nodiscard]] const toml::array& array(std::string_view allowed, std::size_t least,
                                         std::size_t most = -1) const;
  [[nodiscard]] toml_value entry_at(const toml::node& entry, std::size_t i) const {
    return inner(&entry, indexed(name_, i));
  }
  [[nodiscard]] bool is_top_level() const { return name_.find_first_of(".[") == std::string::npos; }
  [[nodiscard]] std::string name_of_key(std::string_view key) const {
    return std::string(name_).append(name_.empty() ? "" : ".").append(key);
  }

  const toml::node* node_;      // null: missing
  toml::source_position at_{};  // of the table in which it is missing
  std::string name_;
  std::string_view file_;
  const toml_places* places_ = nullptr;
};

/// Parse a whole document. Throws input_error with line and column.
[[nodiscard]] toml::table parse_toml(std::string_view text, std::string_view file);

/// Which files a problem file may name. A problem from a stranger must not read what its user can.
enum class reach { own_folder, anywhere };

/// Finds files relative to the folder of the problem file.
class named_files {
 public:
  /// `problem_file`: its path; without a folder in it, that is where the process runs.
  named_files(std::string_view problem_file, reach allowed);

  /// The path of the file that is named, with `ending` appended. Refuses one that is not below the folder,
  /// symbolic links followed, unless all are allowed.
  [[nodiscard]] std::string path_of(const toml_value& named, std::string_view ending = "") const;

  /// All that path_of has returned, to this object and its copies.
  [[nodiscard]] const std::vector<std::string>& all() const { return *all_; }

 private:
  [[nodiscard]] bool is_below(const std::string& path) const;

  std::string folder_;
  reach allowed_;
  std::shared_ptr<std::vector<std::string>> all_ = std::make_shared<std::vector<std::string>>();
};

/// A number in a file, and its position.
struct written_number {
  std::string key;  ///< "step[1].point[2].w"
  double value = 0;
  bool is_whole = false;
  int line = 0, column = 0, length = 0;  ///< from 1, in code points
  std::string_view literal = {};         ///< as written
  bool is_shortest = true;               ///< is the literal the shortest decimal of its double?
};

/// All finite numbers of a document, in the order of the file. `text` is the document's.
[[nodiscard]] std::vector<written_number> numbers_in(const toml::table& document, std::string_view text);

/// A warning for each number of the document, `text` in the file `file`, that is not the shortest decimal of
/// its double, in the order of the file; for many, the first ten and their number.
[[nodiscard]] std::vector<std::string> rounding_warnings(const toml::table& document, std::string_view text,
                                                         std::string_view file);

}  // namespace contct
