// Fuzzes the options of the C interface. An input is a line with the function's name, and then its options in
// JSON.
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "contct/serve/serve.h"
#include "fuzz/fuzz.hpp"
#include "read/good_problem.hpp"

namespace {

using namespace contct::fuzz;

/// Returns the answer of a function for a problem of six dofs.
std::string answer_to(std::string_view function, const std::string& options) {
  using asked = char* (*)(const char*, const char*);
  constexpr std::array<std::pair<std::string_view, asked>, 5> functions = {{{"run", contct_run},
                                                                            {"check", contct_check},
                                                                            {"exact", contct_exact},
                                                                            {"explain", contct_explain},
                                                                            {"certify", contct_certify}}};
  for (const auto& [name, ask] : functions) {
    if (name != function) continue;
    char* const text = ask(contct::good_problem, options.c_str());
    require(text != nullptr, "there is an answer");
    std::string answer(text);  // NOLINT(clang-analyzer-cplusplus.StringChecker): see the line above
    contct_free(text);
    return answer;
  }
  return "";
}

/// Returns true if the options could name a command or a library as a kernel, which the fuzzer must not run.
bool names_a_command(std::string_view options) {
  return options.find('\\') != std::string_view::npos || options.find("pipe") != std::string_view::npos ||
         options.find("plugin") != std::string_view::npos;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = text_of(data, size);
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string options(text.substr(std::min(end + 1, text.size())));
  if (names_a_command(options)) return 0;
  const std::string answer = answer_to(text.substr(0, end), options);
  if (answer.empty()) return 0;
  const auto read = nlohmann::json::parse(answer, nullptr, false);
  require(!read.is_discarded(), "an answer is JSON in UTF-8", answer);
  const int exit = read["exit"].get<int>();
  require(exit >= 0 && exit <= 5, "an answer has an exit status", answer);
  require(read["error"].is_null() == (exit != 2), "an error goes with exit 2", answer);
  require(exit == 2 || read["result"].is_object(), "an answer has a result", answer);
  return 0;
}
