// Arguments and results of the functions of serve.h: options as a JSON object, an answer as another.
#pragma once

#include <deque>
#include <functional>
#include <initializer_list>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/model/problem.hpp"
#include "contct/session/exit_status.hpp"

namespace contct {

/// The answer to one request, while it is found.
struct served_answer {
  exit_status exit = exit_status::solved;
  std::vector<std::string> messages;
  std::string result;                                     ///< JSON as text; empty: null
  std::deque<std::pair<std::string, std::string>> texts;  ///< what else was asked for, by its key

  void tell(const std::vector<std::string>& lines) {
    messages.insert(messages.end(), lines.begin(), lines.end());
  }
};

/// The options of one request. All refusals are std::invalid_argument: "options: kernels: found 3; allowed:
/// ..".
class request {
 public:
  /// `text` may be null. Refuses other text than a JSON object, and names that are not in `known`.
  request(const char* text, std::initializer_list<std::string_view> known);

  [[nodiscard]] bool flag(std::string_view name) const;
  [[nodiscard]] std::string text(std::string_view name, std::string_view otherwise) const;
  [[nodiscard]] std::vector<std::string> texts(std::string_view name,
                                               std::vector<std::string> otherwise) const;
  [[nodiscard]] int whole(std::string_view name, int otherwise, int least, int most) const;
  /// Lists of finite numbers; none if the option is missing.
  [[nodiscard]] std::vector<std::vector<double>> lists(std::string_view name) const;
  [[nodiscard]] bool has(std::string_view name) const { return options_.contains(name); }

  /// The problem's name for messages: "file" in "folder".
  [[nodiscard]] std::string file() const;

  /// The problem in a text, with its name and the files that it may name from the options; its warnings
  /// become messages. Throws as parse_problem does.
  [[nodiscard]] problem problem_in(const char* text, served_answer& a) const;

 private:
  /// An option's value as a Value, or `otherwise`; refused where it is not `allowed`.
  template <class Value, class Fits>
  [[nodiscard]] Value get(std::string_view name, Value otherwise, std::string_view allowed, Fits fits) const;

  nlohmann::json options_ = nlohmann::json::object();
};

/// Whoever has kernels made waits for this: unit 26 belongs to the whole process. Recursive, so that a kernel
/// of the caller's which asks for another one is refused and does not hang.
[[nodiscard]] std::recursive_mutex& turn();

/// What a C function returns: the answer that `find` fills in, or the error that it throws, as text on the C
/// heap; null without memory for it.
[[nodiscard]] char* answered(const std::function<void(served_answer&)>& find) noexcept;

}  // namespace contct
