#include "fuzz/xml.hpp"

#include <cctype>
#include <stdexcept>

namespace contct::fuzz {
namespace {

/// The character at `at`, which goes behind it.
char32_t next_character(std::string_view text, std::size_t& at) {
  const std::size_t from = at;
  const auto lead = static_cast<unsigned char>(text[at++]);
  if (lead < 0x80) return lead;
  const int more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : 1;
  if (lead < 0xc2 || lead > 0xf4 || at + more > text.size())
    throw std::runtime_error("no UTF-8 at " + std::to_string(from));
  char32_t c = lead & (0x3fU >> more);
  for (int i = 0; i < more; ++i) {
    const auto byte = static_cast<unsigned char>(text[at++]);
    if ((byte & 0xc0U) != 0x80U) throw std::runtime_error("no UTF-8 at " + std::to_string(from));
    c = c << 6U | (byte & 0x3fU);
  }
  constexpr char32_t least[] = {0, 0x80, 0x800, 0x10000};
  if (c < least[more] || c > 0x10ffff || (c >= 0xd800 && c <= 0xdfff))
    throw std::runtime_error("no UTF-8 at " + std::to_string(from));
  return c;
}

class xml_parser {
 public:
  explicit xml_parser(std::string_view text) : text_(text) {}

  xml_element document() {
    if (text_.starts_with("<?xml ")) at_ = text_.find("?>") + 2;
    skip_blanks();
    xml_element root = element();
    skip_blanks();
    if (at_ != text_.size()) fail("text behind the root");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& words) const {
    throw std::runtime_error(words + " at " + std::to_string(at_) + ": " +
                             std::string(text_.substr(at_, 40)));
  }
  [[nodiscard]] bool sees(std::string_view what) const { return text_.substr(at_).starts_with(what); }
  void take(std::string_view what) {
    if (!sees(what)) fail("found no " + std::string(what));
    at_ += what.size();
  }
  void skip_blanks() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
      ++at_;
  }

  std::string name() {
    const std::size_t from = at_;
    const auto is_letter = [](char c) {
      return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    const auto goes_on = [&](char c) {
      return is_letter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' ||
             c == ':';
    };
    if (at_ < text_.size() && is_letter(text_[at_]))
      while (at_ < text_.size() && goes_on(text_[at_])) ++at_;
    if (at_ == from) fail("found no name");
    return std::string(text_.substr(from, at_ - from));
  }

  /// What stands for "&..;", or the next character.
  std::string character() {
    if (text_[at_] != '&') return std::string(1, text_[at_++]);
    constexpr std::pair<std::string_view, char> known[] = {
        {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&#10;", '\n'}};
    for (const auto& [reference, c] : known) {
      if (!sees(reference)) continue;
      at_ += reference.size();
      return std::string(1, c);
    }
    fail("a bare &");
  }

  void attribute(xml_element& e) {
    const std::string its_name = name();
    take("=\"");
    std::string value;
    while (at_ < text_.size() && text_[at_] != '"') {
      if (text_[at_] == '<') fail("a < in an attribute");
      value += character();
    }
    take("\"");
    if (!e.attributes.try_emplace(its_name, value).second) fail(its_name + " twice");
  }

  void content(xml_element& e) {
    while (!sees("</")) {
      if (at_ >= text_.size()) fail(e.name + " is never closed");
      if (text_[at_] == '<') {
        e.children.push_back(element());
      } else if (sees("]]>")) {
        fail("a ]]>");
      } else {
        e.text += character();
      }
    }
    take("</");
    if (name() != e.name) fail(e.name + " is not closed");
    skip_blanks();
    take(">");
  }

  xml_element element() {
    if (++depth_ > 100) fail("elements in elements, too deep");
    take("<");
    xml_element e;
    e.name = name();
    for (skip_blanks(); !sees("/>") && !sees(">"); skip_blanks()) {
      if (text_[at_ - 1] == '"') fail("no blank between attributes");
      attribute(e);
    }
    if (sees("/>")) {
      at_ += 2;
    } else {
      take(">");
      content(e);
    }
    --depth_;
    return e;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

std::vector<const xml_element*> xml_element::all(std::string_view name_wanted) const {
  std::vector<const xml_element*> found;
  for (const xml_element& child : children) {
    if (child.name == name_wanted) found.push_back(&child);
    const auto deeper = child.all(name_wanted);
    found.insert(found.end(), deeper.begin(), deeper.end());
  }
  return found;
}

void check_characters(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t from = at;
    const char32_t c = next_character(text, at);
    const bool control = c < 0x20 && c != '\t' && c != '\n' && c != '\r';
    if (control || c == 0xfffe || c == 0xffff)
      throw std::runtime_error("a character that is not allowed at " + std::to_string(from));
  }
}

xml_element parse_xml(std::string_view text) {
  check_characters(text);
  return xml_parser(text).document();
}

}  // namespace contct::fuzz
