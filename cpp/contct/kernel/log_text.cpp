#include "contct/kernel/log_text.hpp"

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace contct {
namespace {

/// Appends `digits`, right-justified in a field of `width`, or asterisks if the field is too narrow.
void append_field(std::string_view digits, std::size_t width, std::string& text) {
  if (digits.size() > width) {
    text.append(width, '*');
  } else {
    text.append(width - digits.size(), ' ').append(digits);
  }
}

void append_i3(int value, std::string& text) {
  char digits[16];
  const char* const end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  append_field({digits, static_cast<std::size_t>(end - digits)}, 3, text);
}

/// Appends a positive number in the format Ew.d: 0.ddddE+ee, or 0.dddd-eee if the exponent has three digits.
template <class Real>
void append_e(Real value, int significant, std::size_t width, std::string& text) {
  // Gives d.ddde+ee, in which a locale may change the point. std::to_chars would add 110 kB of tables to the
  // static program.
  char scientific[48];
  (void)std::snprintf(scientific, sizeof scientific, "%.*e", significant - 1, static_cast<double>(value));
  const std::string_view all(scientific);
  const std::size_t mark = all.find('e');
  std::string digits(all.substr(0, mark));
  std::erase_if(digits, [](char ch) { return ch < '0' || ch > '9'; });
  // All digits are after the point here.
  const auto exponent = static_cast<int>(std::strtol(scientific + mark + 1, nullptr, 10)) + 1;
  char field[48];
  const int length = std::snprintf(field, sizeof field, std::abs(exponent) < 100 ? "0.%sE%+03d" : "0.%s%+04d",
                                   digits.c_str(), exponent);
  append_field({field, static_cast<std::size_t>(length)}, width, text);
}

}  // namespace

template <class Real>
void append_log_text(const call<Real>& c, std::span<const event> events, std::string& text) {
  if (c.smin == Real(1)) {
    text += "  NO EVENTS. RETURNING. SCALE FACTOR = ";
    append_e(c.smin, 3, 10, text);
    text += '\n';
    return;
  }
  for (const event& e : events) {
    const std::size_t i = e.pair;
    text += e.what == change::make ? "  ******* MAKING CONTACT ********\n"
                                   : "  ****** BREAKING CONTACT *******\n";
    text += "   CONTACT PAIR: ";
    append_i3(e.pair + 1, text);
    text += " NODE: ";
    append_i3(c.id[i], text);
    text += " SURFACE: ";
    append_i3(c.isurf[i], text);
    text += " SCALE FACTOR = ";
    append_e(c.smin, 4, 11, text);
    text += '\n';
  }
}

template void append_log_text(const call<float>&, std::span<const event>, std::string&);
template void append_log_text(const call<double>&, std::span<const event>, std::string&);

}  // namespace contct
