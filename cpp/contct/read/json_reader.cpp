#include "contct/read/json_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace contct {
namespace {

class json_parser {
 public:
  json_parser(std::string_view text, std::string_view file, toml_places& places)
      : text_(text), file_(file), places_(places) {}

  toml::table document() {
    if (next() != '{') refuse("an object");
    toml::table whole = object();
    if (next() != '\0') refuse("the end of the text after the object");
    return whole;
  }

 private:
  /// Skips blanks and returns the next character, which stays unread; 0 at the end of the text.
  char next() {
    at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool take(char ch) {
    const bool there = next() == ch;
    if (there) ++at_;
    return there;
  }

  [[nodiscard]] toml::source_position here() const {
    const std::string_view before = text_.substr(0, at_);
    return {static_cast<toml::source_index>(std::count(before.begin(), before.end(), '\n') + 1),
            static_cast<toml::source_index>(before.size() - (before.rfind('\n') + 1) + 1)};
  }

  [[noreturn]] void refuse(std::string_view allowed) const {
    throw input_error(
        fmt::format("{}:{}:{}: JSON cannot be read: found {}; allowed: {}", file_, here().line, here().column,
                    at_ == text_.size() ? "the end" : in_quotes(text_.substr(at_, 1)), allowed));
  }

  /// Reads a text, a number, true or false.
  nlohmann::json token() {
    std::size_t end = text_.find_first_of(" \t\r\n,:{}[]\"", at_);
    if (next() == '"') {
      for (end = at_ + 1; end < text_.size() && text_[end] != '"'; ++end)
        if (text_[end] == '\\') ++end;
      ++end;
    }
    nlohmann::json read = nlohmann::json::parse(text_.substr(at_, end - at_), nullptr, false);
    if (read.is_discarded() || read.is_null()) refuse("a text, a number, true, false, an object or an array");
    at_ = end;
    return read;
  }

  /// Reads a value of any kind. `put` stores the value and returns its node.
  template <class Put>
  void value(const Put& put) {
    constexpr int deepest = 16;
    const char begins = next();
    const toml::source_position at = here();
    if (++depth_ > deepest) refuse("values nested at most 16 deep");
    const toml::node* made = nullptr;
    if (begins == '{') {
      made = put(object());
    } else if (begins == '[') {
      made = put(array());
    } else {
      const nlohmann::json read = token();
      if (read.is_string()) made = put(read.get<std::string>());
      if (read.is_boolean()) made = put(read.get<bool>());
      constexpr double most_whole = 9007199254740992.0;
      const double number = read.is_number() ? read.get<double>() : 0.0;
      if (read.is_number_integer() && std::abs(number) <= most_whole)
        made = put(read.get<std::int64_t>());
      else if (read.is_number())
        made = put(number);
    }
    --depth_;
    places_[made] = at;
  }

  toml::table object() {
    toml::table t;
    for (++at_; !take('}');) {
      if (!t.empty() && !take(',')) refuse(R"("," or "}")");
      if (next() != '"') refuse("a key in quotation marks");
      const std::size_t begins = at_;
      const auto key = token().get<std::string>();
      if (t.contains(key)) {
        at_ = begins;
        refuse("each key once in an object; " + in_quotes(key) + " occurs twice");
      }
      if (!take(':')) refuse("\":\"");
      value([&](auto&& read) { return &t.insert(key, std::forward<decltype(read)>(read)).first->second; });
    }
    return t;
  }

  toml::array array() {
    toml::array a;
    for (++at_; !take(']');) {
      if (!a.empty() && !take(',')) refuse(R"("," or "]")");
      value([&](auto&& read) {
        a.push_back(std::forward<decltype(read)>(read));
        return &a.back();
      });
    }
    return a;
  }

  std::string_view text_, file_;
  toml_places& places_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

json_tree parse_json(std::string_view text, std::string_view file) {
  json_tree d;
  d.table = json_parser(text, file, d.places).document();
  return d;
}

}  // namespace contct
