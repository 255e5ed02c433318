#include "app/serve_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>
#include <stdexcept>

#include "contct/read/problem_file.hpp"
#include "contct/text/input_text.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

/// `text` as JSON, even if it is not valid UTF-8.
std::string as_json(const std::string& text) {
  return json_text(json(text));
}

/// The error as JSON, with the file, line and (if given) column that begin its message: "pb.toml:12:3: ..".
std::string error_json(std::string_view message) {
  json error = {{"message", message}, {"file", nullptr}, {"line", nullptr}, {"column", nullptr}};
  const auto number_at = [message](std::size_t from) {  // the number before a colon; 0 if there is none
    const std::size_t end = message.find_first_not_of("0123456789", from);
    if (end == std::string_view::npos || message[end] != ':') return 0;
    return number_in<int>(message.substr(from, end - from)).value_or(0);
  };
  for (std::size_t colon = message.find(':'); colon != std::string_view::npos;
       colon = message.find(':', colon + 1)) {
    const int line = number_at(colon + 1);
    if (line == 0) continue;
    error["file"] = message.substr(0, colon);
    error["line"] = line;
    if (const int column = number_at(message.find(':', colon + 1) + 1); column > 0) error["column"] = column;
    break;
  }
  return json_text(error);
}

/// The answer as text. The result is not parsed again, because parsing would take longer than the path.
std::string text_of(const served_answer& a, const std::optional<std::string>& error) {
  const auto exit = error ? exit_status::bad_input : a.exit;
  std::string text =
      fmt::format(R"({{"format": "contct-answer-1", "exit": {}, "messages": [)", static_cast<int>(exit));
  for (std::size_t i = 0; i < a.messages.size(); ++i)
    text.append(i == 0 ? "" : ", ").append(as_json(a.messages[i]));
  text.append("], \"error\": ").append(error ? error_json(*error) : "null");
  text.append(", \"result\": ").append(error || a.result.empty() ? "null" : a.result);
  if (!error)
    for (const auto& [key, value] : a.texts)
      text.append(", ").append(as_json(key)).append(": ").append(as_json(value));
  return text + "}";
}

/// Refuses deep nesting: messages quote refused values by recursion, which could overflow the stack.
void refuse_deep(int depth) {
  constexpr int deepest = 16;
  if (depth > deepest)
    throw std::invalid_argument(
        fmt::format("options: found values nested more than {0} deep; allowed: at most {0}", deepest));
}

}  // namespace

request::request(const char* text, std::initializer_list<std::string_view> known) {
  if (text == nullptr) return;
  try {
    options_ = nlohmann::json::parse(text, [](int depth, auto /*event*/, const auto& /*value*/) {
      refuse_deep(depth);
      return true;
    });
  } catch (const nlohmann::json::exception& e) {
    constexpr std::size_t longest = 300;  // the message quotes the text of the options
    throw std::invalid_argument(fmt::format("options: found text that is not JSON: {}; allowed: an object",
                                            printable(e.what(), longest)));
  }
  if (!options_.is_object())
    throw std::invalid_argument(fmt::format("options: found {}; allowed: an object", options_.type_name()));
  for (const auto& [name, value] : options_.items())
    if (std::ranges::find(known, std::string_view(name)) == known.end())
      throw std::invalid_argument(
          fmt::format("options: found the key \"{}\"; allowed: {}", name, fmt::join(known, ", ")));
}

template <class Value, class Fits>
Value request::get(std::string_view name, Value otherwise, std::string_view allowed, Fits fits) const {
  const auto at = options_.find(std::string(name));
  if (at == options_.end()) return otherwise;
  if (fits(*at)) return at->template get<Value>();
  throw std::invalid_argument(
      fmt::format("options: {}: found {}; allowed: {}", name, json_text(*at), allowed));
}

bool request::flag(std::string_view name) const {
  return get(name, false, "true or false", [](const auto& value) { return value.is_boolean(); });
}

std::string request::text(std::string_view name, std::string_view otherwise) const {
  return get(name, std::string(otherwise), "text", [](const auto& value) { return value.is_string(); });
}

std::vector<std::string> request::texts(std::string_view name, std::vector<std::string> otherwise) const {
  return get(name, std::move(otherwise), "a list of one or more texts", [](const auto& value) {
    return value.is_array() && !value.empty() &&
           std::all_of(value.begin(), value.end(), [](const auto& entry) { return entry.is_string(); });
  });
}

int request::whole(std::string_view name, int otherwise, int least, int most) const {
  const auto within = [&](const auto& value) {
    const auto number =
        value.is_number_integer() ? value.template get<std::int64_t>() : std::int64_t{least} - 1;
    return number >= least && number <= most;
  };
  return get(name, otherwise, fmt::format("a whole number from {} to {}", least, most), within);
}

std::vector<std::vector<double>> request::lists(std::string_view name) const {
  const auto is_number = [](const auto& entry) {
    return entry.is_number() && std::isfinite(entry.template get<double>());
  };
  const auto is_list = [&](const auto& entry) {
    return entry.is_array() && std::all_of(entry.begin(), entry.end(), is_number);
  };
  return get(name, std::vector<std::vector<double>>{}, "a list of lists of finite numbers",
             [&](const auto& value) {
               return value.is_array() && std::all_of(value.begin(), value.end(), is_list);
             });
}

std::string request::file() const {
  const std::string folder = text("folder", "");
  const std::string name = text("file", "problem");
  return folder.empty() || name.starts_with('/') ? name : folder + "/" + name;
}

problem request::problem_in(const char* text, served_answer& a) const {
  if (text == nullptr)
    throw std::invalid_argument("problem: found null; allowed: the text of a problem file");
  problem p = parse_problem(text, file(), flag("allow_outside") ? reach::anywhere : reach::own_folder);
  for (const std::string& w : p.warnings) a.messages.push_back("warning: " + w);
  return p;
}

std::recursive_mutex& turn() {
  static std::recursive_mutex mutex;
  return mutex;
}

char* answered(const std::function<void(served_answer&)>& find) noexcept {
  try {
    served_answer a;
    std::optional<std::string> error;
    try {
      find(a);
    } catch (const std::bad_alloc&) {
      error = "not enough memory for this problem";
    } catch (const std::exception& e) {
      error = e.what();
    }
    const std::string text = text_of(a, error);
    auto* const copy = static_cast<char*>(std::malloc(text.size() + 1));  // NOLINT: freed by contct_free
    if (copy != nullptr) std::memcpy(copy, text.c_str(), text.size() + 1);
    return copy;
  } catch (...) {
    return nullptr;
  }
}

}  // namespace contct
