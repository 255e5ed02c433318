// A parser of XML for reading back what the program wrote: all rules of XML 1.0 that it may break.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace contct::fuzz {

/// An element with what is in it.
struct xml_element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< of its own, without that of the elements in it; references are resolved
  std::vector<xml_element> children;

  /// All elements of that name in it, however deep.
  [[nodiscard]] std::vector<const xml_element*> all(std::string_view name_wanted) const;
};

/// The root of a document. Throws std::runtime_error, with the place, where it is not well-formed: names,
/// tags that close each other, attributes quoted and once each, the five entities and numeric references, and
/// only characters that XML 1.0 allows, in UTF-8.
[[nodiscard]] xml_element parse_xml(std::string_view text);

/// Throws std::runtime_error, with the place, where `text` is no UTF-8 or has a character that XML 1.0 does
/// not allow.
void check_characters(std::string_view text);

}  // namespace contct::fuzz
