// Is a text well-formed XML? As much of the rules as the program needs.
#pragma once

#include <cctype>
#include <set>
#include <string>
#include <vector>

namespace contct {

/// Why not, in words; empty when it is. Elements, attributes and the five entities; no comments,
/// CDATA or document types.
inline std::string why_not_well_formed(const std::string& text) {
  std::vector<std::string> open;
  bool had_root = false;
  std::size_t at = 0;
  const auto is_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == ':';
  };
  const auto name = [&] {
    const std::size_t from = at;
    while (at < text.size() && is_name(text[at])) ++at;
    return text.substr(from, at - from);
  };
  const auto skip_blanks = [&] {
    while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at])) != 0) ++at;
  };
  const auto entity = [&] {
    for (const char* known : {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"})
      if (text.compare(at, std::string(known).size(), known) == 0) return true;
    return false;
  };
  if (text.rfind("<?xml ", 0) == 0) at = text.find("?>") + 2;
  while (at < text.size()) {
    if (text[at] == '&' && !entity()) return "a bare & at " + std::to_string(at);
    if (text[at] != '<') {
      if (open.empty() && std::isspace(static_cast<unsigned char>(text[at])) == 0)
        return "text outside the root";
      ++at;
      continue;
    }
    if (text.compare(at, 2, "</") == 0) {
      at += 2;
      const std::string closed = name();
      if (open.empty() || open.back() != closed || at >= text.size() || text[at] != '>')
        return "</" + closed + "> closes nothing";
      open.pop_back();
      ++at;
      continue;
    }
    ++at;
    const std::string element = name();
    if (element.empty()) return "a bare < at " + std::to_string(at - 1);
    if (open.empty() && had_root) return "a second root, " + element;
    had_root = true;
    std::set<std::string> seen;
    for (skip_blanks(); at < text.size() && is_name(text[at]); skip_blanks()) {
      const std::string attribute = name();
      if (!seen.insert(attribute).second) return attribute + " is there twice in " + element;
      if (text.compare(at, 2, "=\"") != 0) return attribute + " of " + element + " has no quoted value";
      const std::size_t end = text.find('"', at + 2);
      if (end == std::string::npos) return attribute + " has no end";
      if (text.substr(at + 2, end - at - 2).find('<') != std::string::npos) return "a < in " + attribute;
      at = end + 1;
    }
    if (text.compare(at, 2, "/>") == 0) {
      at += 2;
    } else if (at < text.size() && text[at] == '>') {
      open.push_back(element);
      ++at;
    } else {
      return "the tag of " + element + " has no end";
    }
  }
  if (!open.empty()) return open.back() + " is never closed";
  return had_root ? "" : "no element at all";
}

}  // namespace contct
