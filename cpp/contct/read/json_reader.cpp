#include "contct/read/json_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

namespace contct {
namespace {

using json = nlohmann::json;

/// Puts what nlohmann-json reads into a tree, with the place of each value.
class tree_builder {
 public:
  tree_builder(std::string_view text, std::string_view file, json_tree& tree)
      : text_(text), file_(file), stream_(std::string(text)), tree_(tree) {}

  void build() try {
    [[maybe_unused]] const json whole =
        json::parse(stream_, [this](int, json::parse_event_t event, json& read) {
          take(event, read);
          end_ = static_cast<std::size_t>(stream_.rdbuf()->pubseekoff(0, std::ios::cur, std::ios::in));
          if (read.is_number() && !stream_.eof()) --end_;  // the character that ends it is read, too
          return true;
        });
  } catch (const json::exception& e) {
    const std::string_view words = e.what();
    const std::size_t expected = words.rfind("expected ");
    refuse(expected == std::string_view::npos ? fmt::format("JSON ({})", words.substr(words.find("] ") + 2))
                                              : std::string(words.substr(expected + 9)));
  }

 private:
  void take(json::parse_event_t event, const json& read) {
    constexpr std::size_t deepest = 16;
    constexpr double most_whole = 9007199254740992.0;
    const double number = read.is_number() ? read.get<double>() : 0.0;
    if (event == json::parse_event_t::object_end || event == json::parse_event_t::array_end)
      return open_.pop_back();
    if (event == json::parse_event_t::key) return take_key(read.get<std::string>());
    if (open_.empty() && event != json::parse_event_t::object_start) refuse("an object");
    if (open_.size() > deepest) refuse("values that are at most 16 deep");
    if (open_.empty()) return open_.push_back(&tree_.table);
    if (event == json::parse_event_t::object_start) return open_.push_back(put(toml::table()));
    if (event == json::parse_event_t::array_start) return open_.push_back(put(toml::array()));
    if (read.is_null()) refuse("a text, a number, true, false, an object or an array");
    if (read.is_string()) put(read.get<std::string>());
    if (read.is_boolean()) put(read.get<bool>());
    if (read.is_number_integer() && std::abs(number) <= most_whole)
      put(read.get<std::int64_t>());
    else if (read.is_number())
      put(number);
  }

  void take_key(std::string key) {
    if (open_.back()->as_table()->contains(key))
      refuse("each key once in an object; " + in_quotes(key) + " is there twice");
    key_ = std::move(key);
  }

  template <class Value>
  toml::node* put(Value&& value) {
    const toml::source_position at = here();
    toml::array* const list = open_.back()->as_array();
    if (list != nullptr) list->push_back(std::forward<Value>(value));
    toml::node* const made =
        list != nullptr ? &list->back()
                        : &open_.back()->as_table()->insert(key_, std::forward<Value>(value)).first->second;
    tree_.places[made] = at;
    return made;
  }

  /// Where the text goes on behind what was taken.
  [[nodiscard]] std::size_t next() const {
    return std::min(text_.find_first_not_of(" \t\r\n:,", end_), text_.size());
  }

  [[nodiscard]] toml::source_position here() const {
    const std::string_view before = text_.substr(0, next());
    return {static_cast<toml::source_index>(std::count(before.begin(), before.end(), '\n') + 1),
            static_cast<toml::source_index>(before.size() - (before.rfind('\n') + 1) + 1)};
  }

  [[noreturn]] void refuse(std::string_view allowed) const {
    throw input_error(fmt::format(
        "{}:{}:{}: not JSON that we read: found {}; allowed: {}", file_, here().line, here().column,
        next() == text_.size() ? "the end" : in_quotes(text_.substr(next(), 1)), allowed));
  }

  std::string_view text_, file_;
  std::istringstream stream_;
  json_tree& tree_;
  std::vector<toml::node*> open_;  // the objects and arrays that are not at their end
  std::string key_;
  std::size_t end_ = 0;  // of what was taken
};

}  // namespace

json_tree parse_json(std::string_view text, std::string_view file) {
  json_tree d;
  tree_builder(text, file, d).build();
  return d;
}

}  // namespace contct
