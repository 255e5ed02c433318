#include "contct/harness/told_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "contct/text/strings.hpp"

namespace contct {
namespace {

namespace l = listing;

/// The numbers of a line of text, and the line with a 0 for each character of a number except the point.
struct text_line {
  explicit text_line(const std::string& words) {
    for (const char* at = words.c_str(); *at != '\0';) {
      char* end = nullptr;
      const double number = std::strtod(at, &end);
      if (end != at) numbers.push_back(number);
      for (const char* past = std::max<const char*>(end, at + 1); at != past; ++at)
        form += end > at && *at != '.' ? '0' : *at;
    }
  }
  std::vector<double> numbers = {};
  std::string form = {};
};

/// The statements that write a line of text, and the words by which the line is recognised.
struct text_writer {
  std::string_view mark;
  const listing_line &write, &format;
};

const text_writer& writer_of(std::string_view line) {
  static constexpr text_writer writers[] = {{"NO EVENTS", l::write_20, l::format_20},
                                            {"MAKING", l::write_40, l::format_40},
                                            {"BREAKING", l::write_50, l::format_50},
                                            {"", l::write_60, l::format_60}};
  return *std::ranges::find_if(writers,
                               [line](const auto& w) { return line.find(w.mark) != std::string_view::npos; });
}

/// The statement that is at fault if the line `got` was written instead of `right`: the FORMAT if only the
/// form of the numbers differs; line 53 if the node is `last_node`; otherwise the WRITE.
const listing_line& written_by(std::string_view right, std::string_view got, int last_node) {
  const text_writer& writer = writer_of(right);
  const text_line expected{std::string(right)};
  text_line found{std::string(got)};
  const auto same = [](double a, double b) {
    constexpr double rounding = 6e-4;  // relative; rounding to four digits changes a number by 5e-4
    return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
  };
  if (!expected.numbers.empty() && !found.numbers.empty()) {
    const double power = std::log10(found.numbers.back() / expected.numbers.back());
    // If the last numbers of both lines differ by a power of ten, this is a fault of the form.
    if (same(power, std::round(power))) found.numbers.back() = expected.numbers.back();
  }
  if (!writer.mark.empty() && &writer != &writer_of(got)) return writer.write;
  if (expected.form != found.form || std::ranges::equal(expected.numbers, found.numbers, same))
    return writer.format;
  const bool node_again = expected.numbers.size() > 1 && expected.numbers[0] == found.numbers[0] &&
                          expected.numbers[1] != found.numbers[1] && found.numbers[1] == last_node;
  return node_again ? l::node_again : writer.write;
}

}  // namespace

std::vector<std::optional<change>> told_by(std::string_view text, std::size_t pairs) {
  std::vector<std::optional<change>> told(pairs);
  change what = change::make;
  while (!text.empty()) {
    const std::string line(take_line(text));
    if (line.find("MAKING") != std::string::npos) what = change::make;
    if (line.find("BREAKING") != std::string::npos) what = change::break_;
    const std::size_t pair = line.find("PAIR:");
    const auto number = pair == std::string::npos ? 0 : std::strtol(line.c_str() + pair + 5, nullptr, 10);
    if (number > 0 && static_cast<std::size_t>(number) <= pairs) told[number - 1] = what;
  }
  return told;
}

const listing_line& fault_of_text(std::string_view right, std::string_view got, int last_node) {
  const bool as_many = std::ranges::count(right, '\n') == std::ranges::count(got, '\n');
  std::string_view expected = take_line(right);
  std::string_view found = take_line(got);
  for (; expected == found && !right.empty(); found = take_line(got)) expected = take_line(right);
  return as_many ? written_by(expected, found, last_node) : writer_of(expected).write;
}

}  // namespace contct
