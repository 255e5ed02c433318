// Tests that the answers of the C interface equal the program's output.
#include "contct/serve/serve.h"

#include <atomic>
#include <climits>
#include <sstream>
#include <thread>

#include "catch.hpp"
#include "contct/text/input_text.hpp"
#include "support/json_parts.hpp"

namespace {

using contct::check_like;
using nlohmann::json;

std::string problem_text(const std::string& name) {
  return contct::read_input(CONTCT_REFERENCE "/problems/" + name + ".toml");
}
const std::string text_of_pb7 = problem_text("pb07-three-gap-supports");

/// Returns the JSON of a text that a function returned, and frees the text.
json taken(char* text) {
  REQUIRE(text != nullptr);
  json answer = json::parse(text);
  contct_free(text);
  CHECK(answer.at("format") == "contct-answer-1");
  return answer;
}

/// Calls a function of the interface for a problem.
json ask(char* (*function)(const char*, const char*), const std::string& problem,
         const json& options = json::object()) {
  return taken(function(problem.c_str(), options.dump().c_str()));
}

/// Checks that the options are refused with these words.
void refused(char* (*function)(const char*, const char*), const std::string& options,
             const std::string& words) {
  const json answer = taken(function(text_of_pb7.c_str(), options.c_str()));
  CAPTURE(options.substr(0, 80));
  CHECK(answer.at("exit") == 2);
  const std::string message = answer.at("error").at("message");
  CHECK_THAT(message, Contains(words));
  CHECK(message.size() < 1000);  // the message quotes only a part of the text
}

std::vector<json> displacements(const json& result) {
  std::vector<json> all;
  for (const json& step : result.at("steps")) all.push_back(step.at("displacement"));
  return all;
}

/// A correct kernel, which calls the C++ kernel.
void right_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                  const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof) {
  contct_free(contct_call("cpp", dd, dtest, cc, ss, smin, id, isep, isurf, nc, indof, ndofpn, ndof));
}

/// A kernel with an error of 1e-9 in calls with three pairs.
void late_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                 const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof) {
  right_kernel(dd, dtest, cc, ss, smin, id, isep, isurf, nc, indof, ndofpn, ndof);
  if (nc == 3) ss[2] += 1e-9;
}

}  // namespace

TEST_CASE("contct_run returns the result, and on request the report page, unit 26, a trace and a proof") {
  const json plain = ask(contct_run, text_of_pb7);
  check_like(plain, R"({"exit": 0, "error": null, "messages": [], "page": "absent",
      "result": {"certified": true, "kernels": ["corrected", "fortran", "cpp"],
      "rule_1989": {"wrong_steps": []}, "lockstep": {"mismatches": 0, "values_compared": ">= 64"}}})");
  const json full =
      ask(contct_run, text_of_pb7,
          {{"page", true}, {"log", true}, {"trace", true}, {"proof", true}, {"envelope", true}});
  CHECK(displacements(full.at("result")) == displacements(plain.at("result")));
  check_like(full, R"({"result": {"envelope": {}}, "page": "~<!DOCTYPE html>", "log": "~MAKING CONTACT"})");
  CHECK(json::parse(full.at("proof").get<std::string>()).at("steps").size() == 4);
  check_like(ask(contct_replay, full.at("trace"), {{"kernel", "cpp"}}), R"({"exit": 0, "result": {"calls": 8,
      "mismatches": 0}})");
}

TEST_CASE("contct_run returns an error as data with file, line and column") {
  std::string text = text_of_pb7;
  check_like(
      ask(contct_run, text.replace(text.find("surface"), 7, "surfase"), {{"file", "beam.toml"}}),
      R"({"exit": 2, "result": null, "error": {"file": "beam.toml", "line": 24, "column": 1, "message": "~did you mean"}})");
}

TEST_CASE("contct_run refuses unknown, mistyped or too deeply nested options, and names the option") {
  // Recursion would overflow the stack on the last text.
  for (const auto& [options, words] :
       {std::pair<std::string, std::string>(R"({"kernel": "cpp"})", "found the key \"kernel\""),
        {R"({"kernels": "cpp"})", "kernels: found \"cpp\""},
        {R"({"kernels": ["cpp", "cpp"]})", "named twice"},
        {R"({"kernels": ["none"]})", "no kernel is named"},
        {R"({"engine": "fast"})", "engine: found \"fast\""},
        {R"({"page": 1})", "page: found 1"},
        {R"({"max_increments": -1})", "max_increments: found -1"},
        {R"({"final_only": true, "trace": true})", "final_only"},
        {"[]", "allowed: an object"},
        {"{", "found text that is not JSON"},
        {"{\"engine\": \"" + std::string(5000, 'x'), "found text that is not JSON"},
        {"{\"engine\": " + std::string(200'000, '[') + std::string(200'000, ']') + "}",
         "more than 16 deep; allowed: at most 16"}})
    refused(contct_run, options, words);
  refused(contct_exact, R"({"rule": "1988"})", "1988");
  refused(contct_explain, R"({"kernels": ["corrected"]})", "corrected");
  CHECK(taken(contct_run(nullptr, nullptr)).at("exit") == 2);
}

TEST_CASE("contct_certify certifies a right state of another program, but none with an error of 1e-4") {
  std::vector<json> states =
      displacements(ask(contct_run, text_of_pb7, {{"kernels", {"corrected"}}}).at("result"));
  check_like(ask(contct_certify, text_of_pb7, {{"displacement", states}}), R"({"exit": 0,
      "result": {"certified": true, "engine": "given", "steps": {"0": {"error": {"w": "< 1e-12"}}}}})");
  for (const char* pair : {"9", "1e300", "-1e300", "0", "1.5"}) {  // some are not integers
    const json given = {{"displacement", states},
                        {"closed", {{json::parse(pair)}, json::array(), json::array(), json::array()}}};
    refused(contct_certify, given.dump(), "allowed: pairs from 1 to 3");
  }
  refused(contct_certify, R"({"displacement": [[0, 1]]})", "found 2 numbers");
  json& w = states[2][16];
  const double change = 1e-4 * w.get<double>();
  w = w.get<double>() + change;
  const json wrong = ask(contct_certify, text_of_pb7, {{"displacement", states}});
  check_like(wrong, R"({"exit": 3, "result": {"certified": false}})");
  const json& bound = wrong.at("result").at("steps")[2].at("error").at("w");
  CHECK((bound.is_null() || bound.get<double>() >= std::abs(change)));
}

TEST_CASE("contct_check returns the place of every number in a text, and the keys of each pair") {
  const std::string text =
      "title = \"\u00e4\"  # two bytes\n[beam]\nlength = 4.0\nelements = 4\nEI = 1e3\n[[support]]\n"
      "nodes = [1, 5]\nfix = \"w\"\n[[contact]]\nnodes = [2, 3]\nsurface = \"below\"\nface = [-0.1, -0.2]\n"
      "stiffness = 5\n[[step]]\npoint = [{ node = 3, w = -1 }]\n";
  const json checked = ask(contct_check, text, {{"places", true}});
  check_like(checked, R"({"error": null, "result": {"kind": "beam", "pairs": 2, "x": {"4": 4},
      "pair_list": {"1": {"face_key": "contact[1].face[2]", "stiffness_key": "contact[1].stiffness"}}}})");
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  CHECK(checked.at("result").at("numbers").size() == 12);
  for (const json& n : checked.at("result").at("numbers")) {
    const std::string& line = lines.at(n.at("line").get<std::size_t>() - 1);
    CAPTURE(n.dump());
    CHECK(std::stod(line.substr(n.at("column").get<std::size_t>() - 1, n.at("length"))) ==
          n.at("value").get<double>());
  }
  CHECK_FALSE(taken(contct_check(text.c_str(), nullptr)).at("result").contains("numbers"));
}

TEST_CASE("contct_exact, contct_explain and contct_about return what the commands of the program print") {
  check_like(ask(contct_exact, text_of_pb7, {{"kernels", {"cpp"}}}),
             R"({"result": {"format": "contct-exact-1",
      "kernels": [{"same_events": true}]}})");
  check_like(ask(contct_explain, text_of_pb7, {{"step", 1}}), R"({"result": {"format": "contct-explain-1",
      "increments": "> 0"}})");
  check_like(taken(contct_about()), R"({"result": {"kernels": ">= 5"}})");
  CHECK(contct_serve_version() == CONTCT_SERVE_VERSION);
}

TEST_CASE("contct_call returns the text of unit 26, and refuses a call with a dof that does not exist") {
  const double dd[] = {0.0, 0.0}, dtest[] = {-2.0, 0.0}, cc[] = {-1.0};
  const int isurf[] = {-1};
  int isep[] = {1};
  double ss[] = {0.0}, smin = 7.0;
  const auto called = [&](const char* name, int id, int indof, int ndofpn) {
    isep[0] = 1;
    return taken(contct_call(name, dd, dtest, cc, ss, &smin, &id, isep, isurf, 1, indof, ndofpn, 2));
  };
  CHECK(called("cpp", 2, 1, 2).at("exit") == 2);
  // (2 - 1) * 2147483647 + 2147483647 exceeds INTEGER. (0 - 1) * -2147483648 exceeds it too, although the dof
  // would be 1.
  CHECK(called("cpp", 2, INT_MAX, INT_MAX).at("exit") == 2);
  CHECK(called("cpp", 0, -INT_MAX, INT_MIN).at("exit") == 2);
  CHECK(smin == 7.0);
  for (const std::string name : {"fortran", "cpp", "fortran-r4", "corrected"}) {
    const json answer = called(name.c_str(), 1, 1, 2);
    CAPTURE(name);
    CHECK(answer.at("exit") == 0);
    CHECK(smin == 0.5);
    CHECK(isep[0] == -1);
    CHECK((answer.at("result").at("text").dump().find("MAKING CONTACT") != std::string::npos) ==
          (name != "corrected"));
  }
}

TEST_CASE("contct_judge compares the kernel of a caller with the listing, and reports mismatches") {
  check_like(taken(contct_judge(right_kernel, R"({"leader": "fortran", "calls": 3000, "problems": 4})")),
             R"({"exit": 0, "result": {"mismatches": 0, "values_compared": "> 10000"}})");
  check_like(taken(contct_judge(late_kernel, R"({"calls": 3000, "problems": 4, "name": "late"})")),
             R"({"exit": 1, "result": {"mismatches": "> 0", "followers": [{"kernel": "late"}]}})");
  CHECK(taken(contct_judge(nullptr, nullptr)).at("exit") == 2);
  CHECK(taken(contct_judge(right_kernel, R"({"name": "cpp"})")).at("exit") == 2);
}

TEST_CASE("several threads may call contct_run at once, and get the answers to their own problems") {
  std::vector<std::string> problems;
  std::vector<json> expected;
  for (const char* name :
       {"pb01-cantilever-tip-stop", "pb07-three-gap-supports", "pb10-cantilever-gapped-spring"}) {
    problems.push_back(problem_text(name));
    expected.push_back(ask(contct_run, problems.back()).at("result"));
  }
  std::atomic<int> right = 0;
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < 6; ++i) {
        const std::size_t which = (t + i) % problems.size();
        char* const text = (i % 2 == 0 ? contct_run : contct_exact)(problems[which].c_str(), nullptr);
        const json answer = json::parse(text);
        contct_free(text);
        if (i % 2 == 0 ? answer.at("result") == expected[which]
                       : answer.at("exit") == 0 && answer.at("result").at("status") == "solved")
          ++right;
      }
    });
  for (std::thread& t : threads) t.join();
  CHECK(right == 48);
}
