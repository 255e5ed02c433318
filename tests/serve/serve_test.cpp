// Tests that the answers of the C interface equal the program's output.
#include "contct/serve/serve.h"

#include <fmt/format.h>

#include <atomic>
#include <climits>
#include <nlohmann/json.hpp>
#include <thread>

#include "catch.hpp"
#include "contct/text/input_text.hpp"

namespace {

using Catch::Matchers::Contains;
using nlohmann::json;

std::string problem_text(const std::string& name) {
  return contct::read_input(std::string(CONTCT_REFERENCE) + "/problems/" + name + ".toml");
}

/// Returns the JSON of a text that a function returned, and frees the text.
json taken(char* text) {
  REQUIRE(text != nullptr);
  json answer = json::parse(text);
  contct_free(text);
  CHECK(answer.at("format") == "contct-answer-1");
  return answer;
}

json run(const std::string& problem, const json& options = json::object()) {
  return taken(contct_run(problem.c_str(), options.dump().c_str()));
}

std::string error_of(const json& answer) {
  CHECK(answer.at("exit") == 2);
  return answer.at("error").at("message");
}

json certified(const std::string& problem, const json& options) {
  return taken(contct_certify(problem.c_str(), options.dump().c_str()));
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
  const json plain = run(problem_text("pb07-three-gap-supports"));
  CHECK(plain.at("exit") == 0);
  CHECK(plain.at("error").is_null());
  CHECK(plain.at("messages").empty());
  CHECK(plain.at("result").at("certified") == true);
  CHECK(plain.at("result").at("kernels") == json({"corrected", "fortran", "cpp"}));
  CHECK(plain.at("result").at("rule_1989").at("wrong_steps").empty());
  CHECK(plain.at("result").at("lockstep").at("mismatches") == 0);
  CHECK(plain.at("result").at("lockstep").at("values_compared") >= 64);
  CHECK_FALSE(plain.contains("page"));

  const json full =
      run(problem_text("pb07-three-gap-supports"),
          {{"page", true}, {"log", true}, {"trace", true}, {"proof", true}, {"envelope", true}});
  CHECK(displacements(full.at("result")) == displacements(plain.at("result")));
  CHECK(full.at("result").contains("envelope"));
  CHECK(full.at("page").get<std::string>().starts_with("<!DOCTYPE html>"));
  CHECK(full.at("log").get<std::string>().find("MAKING CONTACT") != std::string::npos);
  CHECK(json::parse(full.at("proof").get<std::string>()).at("steps").size() == 4);

  const json replayed =
      taken(contct_replay(full.at("trace").get<std::string>().c_str(), R"({"kernel": "cpp"})"));
  CHECK(replayed.at("exit") == 0);
  CHECK(replayed.at("result").at("calls") == 8);
  CHECK(replayed.at("result").at("mismatches") == 0);
}

TEST_CASE("contct_run returns an error as data with file, line and column") {
  std::string text = problem_text("pb07-three-gap-supports");
  text.replace(text.find("surface"), 7, "surfase");
  const json wrong = run(text, {{"file", "beam.toml"}});
  CHECK(wrong.at("result").is_null());
  CHECK(wrong.at("error").at("file") == "beam.toml");
  CHECK(wrong.at("error").at("line") == 24);
  CHECK(wrong.at("error").at("column") == 1);
  CHECK_THAT(error_of(wrong), Contains("did you mean \"surface\"?"));
}

TEST_CASE(
    "contct_run refuses unknown, mistyped or too deeply nested options, and the message names the option") {
  const std::pair<const char*, const char*> wrong[] = {
      {R"({"kernel": "cpp"})", "found the key \"kernel\""},
      {R"({"kernels": "cpp"})", "kernels: found \"cpp\""},
      {R"({"kernels": ["cpp", "cpp"]})", "named twice"},
      {R"({"kernels": ["none"]})", "no kernel is named"},
      {R"({"engine": "fast"})", "engine: found \"fast\""},
      {R"({"page": 1})", "page: found 1"},
      {R"({"max_increments": -1})", "max_increments: found -1"},
      {R"({"final_only": true, "trace": true})", "final_only"},
      {"[]", "allowed: an object"},
      {"{", "found text that is not JSON"},
  };
  const std::string problem = problem_text("pb07-three-gap-supports");
  for (const auto& [options, words] : wrong) {
    CAPTURE(options);
    CHECK_THAT(error_of(taken(contct_run(problem.c_str(), options))), Contains(words));
  }
  CHECK(taken(contct_run(nullptr, nullptr)).at("exit") == 2);
  const std::string cut = "{\"engine\": \"" + std::string(5000, 'x');
  // The message quotes only a part of the text.
  CHECK(error_of(taken(contct_run(problem.c_str(), cut.c_str()))).size() < 1000);
  // Recursion would overflow the stack on these texts.
  const std::string deep = "{\"engine\": " + std::string(200'000, '[') + std::string(200'000, ']') + "}";
  CHECK_THAT(error_of(taken(contct_run(problem.c_str(), deep.c_str()))),
             Contains("more than 16 deep; allowed: at most 16"));
}

TEST_CASE(
    "contct_certify certifies a correct state of another program, but not a state with an error of 1e-4") {
  const std::string text = problem_text("pb07-three-gap-supports");
  std::vector<json> states = displacements(run(text, {{"kernels", {"corrected"}}}).at("result"));
  const json right = certified(text, {{"displacement", states}});
  CHECK(right.at("exit") == 0);
  CHECK(right.at("result").at("certified") == true);
  CHECK(right.at("result").at("engine") == "given");
  CHECK(right.at("result").at("steps")[0].at("error").at("w").get<double>() < 1e-12);

  json& w = states[2][16];
  const double change = 1e-4 * w.get<double>();
  w = w.get<double>() + change;
  const json wrong = certified(text, {{"displacement", states}});
  CHECK(wrong.at("exit") == 3);
  CHECK(wrong.at("result").at("certified") == false);
  const json& bound = wrong.at("result").at("steps")[2].at("error").at("w");
  CHECK((bound.is_null() || bound.get<double>() >= std::abs(change)));

  CHECK_THAT(error_of(certified(text, json::parse(R"({"displacement": [[0, 1]]})"))),
             Contains("found 2 numbers"));
  for (const char* pair : {"9", "1e300", "-1e300", "0", "1.5"}) {  // some are not integers
    const json closed = json::parse(fmt::format("[[{}], [], [], []]", pair));
    CHECK_THAT(error_of(certified(text, {{"displacement", states}, {"closed", closed}})),
               Contains("closed: found ") && Contains("allowed: pairs from 1 to 3"));
  }
}

TEST_CASE(
    "contct_check returns the place of every number in a problem's text, and the keys of each pair's "
    "numbers") {
  const std::string text =
      "title = \"\u00e4\"  # two bytes\n[beam]\nlength = 4.0\nelements = 4\nEI = 1e3\n"
      "[[support]]\nnodes = [1, 5]\nfix = \"w\"\n"
      "[[contact]]\nnodes = [2, 3]\nsurface = \"below\"\nface = [-0.1, -0.2]\nstiffness = 5\n"
      "[[step]]\npoint = [{ node = 3, w = -1 }]\n";
  const json checked = taken(contct_check(text.c_str(), R"({"places": true})"));
  REQUIRE(checked.at("error").is_null());
  const json& result = checked.at("result");
  std::vector<std::string> lines;
  for (std::size_t from = 0, to = 0; from < text.size(); from = to + 1) {
    to = text.find('\n', from);
    lines.push_back(text.substr(from, to - from));
  }
  CHECK(result.at("numbers").size() == 12);
  for (const json& n : result.at("numbers")) {
    const std::string& line = lines.at(n.at("line").get<std::size_t>() - 1);
    const std::string literal = line.substr(n.at("column").get<std::size_t>() - 1, n.at("length"));
    CAPTURE(n.dump());
    CHECK(std::stod(literal) == n.at("value").get<double>());
  }
  CHECK(result.at("pair_list")[1].at("face_key") == "contact[1].face[2]");
  CHECK(result.at("pair_list")[1].at("stiffness_key") == "contact[1].stiffness");
  CHECK(result.at("x")[4] == 4.0);
  CHECK_FALSE(taken(contct_check(text.c_str(), nullptr)).at("result").contains("numbers"));
}

TEST_CASE(
    "contct_check, contct_exact, contct_explain and contct_about return what the commands of the program "
    "print") {
  const std::string text = problem_text("pb07-three-gap-supports");
  const json checked = taken(contct_check(text.c_str(), "{}"));
  CHECK(checked.at("result").at("kind") == "beam");
  CHECK(checked.at("result").at("pairs") == 3);

  const json exactly = taken(contct_exact(text.c_str(), R"({"kernels": ["cpp"]})"));
  CHECK(exactly.at("result").at("format") == "contct-exact-1");
  CHECK(exactly.at("result").at("kernels")[0].at("same_events") == true);
  CHECK(taken(contct_exact(text.c_str(), R"({"rule": "1988"})")).at("exit") == 2);

  const json explained = taken(contct_explain(text.c_str(), R"({"step": 1})"));
  CHECK(explained.at("result").at("format") == "contct-explain-1");
  CHECK_FALSE(explained.at("result").at("increments").empty());
  CHECK(taken(contct_explain(text.c_str(), R"({"kernels": ["corrected"]})")).at("exit") == 2);

  const json about = taken(contct_about());
  CHECK(contct_serve_version() == CONTCT_SERVE_VERSION);
  CHECK(about.at("result").at("kernels").size() >= 5);
}

TEST_CASE("contct_call returns the text of unit 26, and refuses a call with a dof that does not exist") {
  const double dd[] = {0.0, 0.0}, dtest[] = {-2.0, 0.0}, cc[] = {-1.0};
  const int id[] = {1}, isurf[] = {-1};
  for (const char* name : {"fortran", "cpp", "fortran-r4", "corrected"}) {
    int isep[] = {1};
    double ss[] = {0.0}, smin = 0.0;
    const json answer = taken(contct_call(name, dd, dtest, cc, ss, &smin, id, isep, isurf, 1, 1, 2, 2));
    CAPTURE(name);
    CHECK(answer.at("exit") == 0);
    CHECK(smin == 0.5);
    CHECK(isep[0] == -1);
    CHECK((answer.at("result").at("text").get<std::string>().find("MAKING CONTACT") != std::string::npos) ==
          (std::string(name) != "corrected"));
  }
  int isep[] = {1};
  double ss[] = {0.0}, smin = 7.0;
  const int beyond[] = {2};
  CHECK(taken(contct_call("cpp", dd, dtest, cc, ss, &smin, beyond, isep, isurf, 1, 1, 2, 2)).at("exit") == 2);
  // (2 - 1) * 2147483647 + 2147483647 exceeds INTEGER. (0 - 1) * -2147483648 exceeds it too, although the dof
  // would be 1.
  CHECK(taken(contct_call("cpp", dd, dtest, cc, ss, &smin, beyond, isep, isurf, 1, INT_MAX, INT_MAX, 2))
            .at("exit") == 2);
  const int before_all[] = {0};
  CHECK(taken(contct_call("cpp", dd, dtest, cc, ss, &smin, before_all, isep, isurf, 1, -INT_MAX, INT_MIN, 2))
            .at("exit") == 2);
  CHECK(smin == 7.0);
}

TEST_CASE("contct_judge compares the kernel of a caller with the listing, and reports mismatches") {
  const json right =
      taken(contct_judge(right_kernel, R"({"leader": "fortran", "calls": 3000, "problems": 4})"));
  CHECK(right.at("exit") == 0);
  CHECK(right.at("result").at("mismatches") == 0);
  CHECK(right.at("result").at("values_compared") > 10000);
  const json wrong = taken(contct_judge(late_kernel, R"({"calls": 3000, "problems": 4, "name": "late"})"));
  CHECK(wrong.at("exit") == 1);
  CHECK(wrong.at("result").at("mismatches") > 0);
  CHECK(wrong.at("result").at("followers")[0].at("kernel") == "late");
  CHECK(taken(contct_judge(nullptr, nullptr)).at("exit") == 2);
  CHECK(taken(contct_judge(right_kernel, R"({"name": "cpp"})")).at("exit") == 2);
}

TEST_CASE(
    "several threads may call contct_run at once, and each thread gets the answers to its own problems") {
  const std::string names[] = {"pb01-cantilever-tip-stop", "pb07-three-gap-supports",
                               "pb10-cantilever-gapped-spring"};
  std::vector<std::string> texts;
  std::vector<json> expected;
  for (const std::string& name : names) {
    texts.push_back(problem_text(name));
    expected.push_back(run(texts.back()).at("result"));
  }
  std::atomic<int> right = 0;
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < 6; ++i) {
        const std::size_t which = (t + i) % texts.size();
        char* const text = i % 2 == 0 ? contct_run(texts[which].c_str(), nullptr)
                                      : contct_exact(texts[which].c_str(), nullptr);
        const json answer = json::parse(text);
        contct_free(text);
        const bool is_right = i % 2 == 0
                                  ? answer.at("result") == expected[which]
                                  : answer.at("exit") == 0 && answer.at("result").at("status") == "solved";
        if (is_right) ++right;
      }
    });
  for (std::thread& t : threads) t.join();
  CHECK(right == 48);
}
