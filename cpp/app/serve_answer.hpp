// Parses the options of the functions of serve.h, and writes their answers, which are JSON objects too.
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

#include "contct/results/exit_status.hpp"
#include "contct/structure/problem.hpp"

namespace contct {

/// The answer to a request. The functions of serve.h fill it in step by step.
struct served_answer {
  exit_status exit = exit_status::solved;
  std::vector<std::string> messages;
  std::string result;                                     ///< JSON as text; empty: null
  std::deque<std::pair<std::string, std::string>> texts;  ///< further requested texts, with their keys

  void tell(const std::vector<std::string>& lines) {
    messages.insert(messages.end(), lines.begin(), lines.end());
  }
};

/// The options of a request. Refusals are std::invalid_argument: "options: kernels: found 3; allowed: ..".
class request {
 public:
  /// `text` may be null. Refuses a text that is not a JSON object, and option names that are not in `known`.
  request(const char* text, std::initializer_list<std::string_view> known);

  [[nodiscard]] bool flag(std::string_view name) const;
  [[nodiscard]] std::string text(std::string_view name, std::string_view otherwise) const;
  [[nodiscard]] std::vector<std::string> texts(std::string_view name,
                                               std::vector<std::string> otherwise) const;
  [[nodiscard]] int whole(std::string_view name, int otherwise, int least, int most) const;
  /// Lists of finite numbers; empty if the option is missing.
  [[nodiscard]] std::vector<std::vector<double>> lists(std::string_view name) const;
  [[nodiscard]] bool has(std::string_view name) const { return options_.contains(name); }

  /// The path of the problem in messages: the option "file", in the folder of the option "folder".
  [[nodiscard]] std::string file() const;

  /// Reads the problem in `text`. The options give its name and the files that it may read; its warnings
  /// become messages. Throws as parse_problem does.
  [[nodiscard]] problem problem_in(const char* text, served_answer& a) const;

 private:
  /// The value of an option as a Value, or `otherwise` if it is missing. Refuses a value that `fits` rejects;
  /// `allowed` describes allowed values.
  template <class Value, class Fits>
  [[nodiscard]] Value get(std::string_view name, Value otherwise, std::string_view allowed, Fits fits) const;

  nlohmann::json options_ = nlohmann::json::object();
};

/// The lock for all uses of kernels, because unit 26 belongs to the whole process. The lock is recursive: a
/// call from inside a kernel of the caller is refused and does not hang.
[[nodiscard]] std::recursive_mutex& turn();

/// Returns the answer that `find` fills in, or the error that it throws, as text from malloc; null without
/// memory.
[[nodiscard]] char* answered(const std::function<void(served_answer&)>& find) noexcept;

}  // namespace contct
