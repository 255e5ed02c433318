// contct_mutants: builds every mutant of the kernels, and has it judged by the golden set and random calls.
//
// Exit status: 0 when each is killed or, where it is proved equivalent, lives; 1 when one survives that must
// not, or dies that must not; 2 for bad usage, a mutation that does not apply, a mutant that does not
// compile.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "contct/text/output_file.hpp"
#include "mutants/page.hpp"

namespace contct_test {
namespace {

const char* const usage =
    "contct_mutants [--jobs N] [--only ID,ID..] [--calls N] [--definitions FILE] [--page FILE]";

struct options {
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::string> only;
  bounded_fuzz fuzz;
  std::string definitions = CONTCT_MUTANTS;
  std::string page;
};

long whole_number(const std::string& name, const std::string& word) {
  char* end = nullptr;
  const long n = std::strtol(word.c_str(), &end, 10);
  if (word.empty() || *end != '\0' || n < 1 || n > 100'000'000)
    throw std::runtime_error(name + ": found \"" + word + "\"; allowed: a whole number from 1");
  return n;
}

std::vector<std::string> parted_by_commas(const std::string& word) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= word.size();) {
    const std::size_t end = std::min(word.find(',', at), word.size());
    parts.push_back(word.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

options read_options(const std::vector<std::string>& words) {
  options o;
  if (words.size() % 2 != 0) throw std::runtime_error(std::string("usage: ") + usage);
  for (std::size_t i = 0; i < words.size(); i += 2) {
    const std::string& name = words[i];
    const std::string& value = words[i + 1];
    if (name == "--jobs") {
      o.jobs = static_cast<unsigned>(std::min(whole_number(name, value), 256L));
    } else if (name == "--only") {
      o.only = parted_by_commas(value);
    } else if (name == "--calls") {
      o.fuzz.calls = whole_number(name, value);
    } else if (name == "--definitions") {
      o.definitions = value;
    } else if (name == "--page") {
      o.page = value;
    } else {
      throw std::runtime_error("found \"" + name + "\"; usage: " + usage);
    }
  }
  if (!o.page.empty() && !o.only.empty())
    throw std::runtime_error("--page is of all mutants, not of those of --only");
  return o;
}

std::vector<mutant> chosen(const options& o) {
  std::vector<mutant> all = read_mutants(o.definitions);
  if (o.only.empty()) return all;
  std::vector<mutant> some;
  for (const std::string& id : o.only) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const mutant& m) { return m.id == id; });
    if (at == all.end()) throw std::runtime_error("--only: there is no mutant \"" + id + "\"");
    some.push_back(*at);
  }
  return some;
}

/// The counts, what is wrong, and the exit status.
int summary(const std::vector<trial>& trials, double seconds) {
  int golden = 0;
  int random_only = 0;
  int equivalent = 0;
  int errors = 0;
  int objections = 0;
  for (const trial& t : trials) {
    if (!t.error.empty() || !t.objection.empty())
      (void)std::fprintf(stderr, "contct_mutants: %s: %s\n", t.which.id.c_str(), in_words(t).c_str());
    errors += t.error.empty() ? 0 : 1;
    objections += t.objection.empty() ? 0 : 1;
    golden += t.killed() && t.seen.killed_by_golden_set() ? 1 : 0;
    random_only += t.killed() && !t.seen.killed_by_golden_set() ? 1 : 0;
    equivalent += t.error.empty() && t.objection.empty() && t.seen.lives() && !t.which.find.empty() ? 1 : 0;
  }
  (void)std::printf(
      "%d killed by the golden set, %d by random calls alone, %d equivalent, %d wrong, %d errors; %.0f s\n",
      golden, random_only, equivalent, objections, errors, seconds);
  if (errors > 0) return 2;
  return objections > 0 ? 1 : 0;
}

int run(const options& o) {
  const auto started = std::chrono::steady_clock::now();
  const std::vector<trial> trials = try_all(chosen(o), o.fuzz, o.jobs);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  const int status = summary(trials, seconds);
  if (status == 0 && !o.page.empty()) {
    contct::app::output_file out(o.page);
    out.write(page(trials, o.fuzz));
    out.finish();
  }
  return status;
}

}  // namespace
}  // namespace contct_test

int main(int argc, char** argv) {
  try {
    return contct_test::run(contct_test::read_options({argv + 1, argv + argc}));
  } catch (const std::exception& e) {
    (void)std::fprintf(stderr, "contct_mutants: %s\n", e.what());
    return 2;
  }
}
