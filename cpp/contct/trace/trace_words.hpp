// One line of a trace, word by word.
#pragma once

#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace contct {

/// Cuts words off the front of a line. Every method fails by returning nothing, and stays failed.
class trace_words {
 public:
  explicit trace_words(std::string_view line) : rest_(line) {}

  /// The next word must be `word`.
  trace_words& key(std::string_view word) {
    if (next() != word) failed_ = true;
    return *this;
  }

  /// The next word must be a whole number from `least` to `most`.
  trace_words& whole(std::int64_t& value, std::int64_t least, std::int64_t most) {
    const std::string_view word = next();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || value < least || value > most)
      failed_ = true;
    return *this;
  }
  trace_words& whole(int& value, int least, int most) {
    std::int64_t wide = 0;
    whole(wide, least, most);
    if (!failed_) value = static_cast<int>(wide);
    return *this;
  }

  /// The next word must be a number: hexfloat, as in -0x1.8p+1, or decimal; inf; nan.
  trace_words& real(double& value) {
    const std::optional<double> read = real_of(next());
    if (read) value = *read;
    if (!read) failed_ = true;
    return *this;
  }

  /// Was everything as asked, and is nothing left?
  [[nodiscard]] bool done() const { return !failed_ && rest_.empty(); }

 private:
  /// Words stand one blank apart.
  std::string_view next() {
    const std::size_t end = rest_.find(' ');
    const std::string_view word = rest_.substr(0, end);
    if (word.empty()) failed_ = true;
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    return word;
  }

  static bool is_hex_digit(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
  }

  static std::optional<double> real_of(std::string_view word) {
    const bool negative = !word.empty() && word.front() == '-';
    if (negative) word.remove_prefix(1);
    const bool hex = word.substr(0, 2) == "0x";
    if (hex) word.remove_prefix(2);
    // from_chars takes a sign of its own, and inf behind 0x.
    if (word.empty() || word.front() == '-' || (hex && !is_hex_digit(word.front()))) return {};
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value,
                                              hex ? std::chars_format::hex : std::chars_format::general);
    if (error != std::errc{} || end != word.data() + word.size()) return {};
    return negative ? -value : value;
  }

  std::string_view rest_;
  bool failed_ = false;
};

}  // namespace contct
