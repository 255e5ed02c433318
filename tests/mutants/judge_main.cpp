// contct_mutant_judge fortran|cpp TRACES CALLS SEED: how the kernel of one language answers.
//
// A mutant is this program, linked with a mutated kernel in front of the libraries. All golden traces of
// the folder TRACES are put to that kernel, then CALLS random calls in each precision, which the kernel
// of the other language answers as well. A line tells what begins, a line what differs first in it; each is
// flushed, so that it is known where a mutant crashed or hung. Always runs to the end: who has to die is not
// decided here.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "contct/compare/compare.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/lab/random_calls.hpp"
#include "contct/text/input_text.hpp"

namespace contct_test {
namespace {

const int not_the_mutants_fault = 9;

void say(const std::string& line) {
  (void)std::printf("judge %s\n", line.c_str());
  (void)std::fflush(stdout);
}

void say_difference(std::int64_t call, const contct::mismatch& where) {
  std::string field = where.field;
  if (where.field == "text") field += " line " + std::to_string(where.index);
  if (where.field != "text" && where.index > 0) field += "(" + std::to_string(where.index) + ")";
  say("differs " + std::to_string(call) + " " + field);
}

std::string in_precision(const std::string& language, int real_bytes) {
  return language + (real_bytes == 4 ? "-r4" : "");
}

void put_trace(const std::filesystem::path& file, const std::string& language) {
  say("at trace " + file.stem().string());
  const std::string text = contct::read_input(file.string(), "trace", 2048);
  contct::trace_reader calls(text, file.string());
  const contct::trace_header h = calls.read_header();
  const auto k = contct::make_kernel(in_precision(language, h.real_bytes));
  const contct::replay_report report = contct::replay(h, calls, *k);
  if (report.first) say_difference(report.first->call, report.first->where);
}

int put_traces(const std::filesystem::path& folder, const std::string& language) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".trace") files.push_back(entry.path());
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.stem() < b.stem(); });
  for (const auto& file : files) put_trace(file, language);
  return static_cast<int>(files.size());
}

/// Random and adversarial calls in turn, answered by the kernel of the other language too.
void put_random_calls(const std::string& language, int real_bytes, std::uint64_t count, std::uint64_t seed) {
  say("at random " + std::to_string(real_bytes));
  const auto leader = contct::make_kernel(in_precision(language == "cpp" ? "fortran" : "cpp", real_bytes));
  const auto mutant = contct::make_kernel(in_precision(language, real_bytes));
  contct::call_source source(seed, real_bytes);
  contct::call_outputs led;
  contct::follower asked(leader->facts(), *mutant);
  for (std::uint64_t n = 1; n <= count; ++n) {
    const contct::call_inputs<double>& in = source.at(n);
    contct::call<double> c = led.prepare(in);
    leader->answer(c);
    const std::string text = leader->take_text();
    const auto& found = asked.ask({c, in.isep, text, static_cast<std::int64_t>(n)});
    if (found) return say_difference(static_cast<std::int64_t>(n), *found);
  }
}

int judge(const std::string& language, const std::filesystem::path& folder, std::uint64_t calls,
          std::uint64_t seed) {
  if (put_traces(folder, language) == 0) throw contct::input_error("no traces in " + folder.string());
  put_random_calls(language, 8, calls, seed);
  put_random_calls(language, 4, calls, seed);
  say("end");
  return 0;
}

}  // namespace
}  // namespace contct_test

int main(int argc, char** argv) {
  const std::string language = argc == 5 ? argv[1] : "";
  if (language != "fortran" && language != "cpp") {
    (void)std::fputs("usage: contct_mutant_judge fortran|cpp TRACES CALLS SEED\n", stderr);
    return contct_test::not_the_mutants_fault;
  }
  try {
    return contct_test::judge(language, argv[2], std::strtoull(argv[3], nullptr, 10),
                              std::strtoull(argv[4], nullptr, 10));
  } catch (const contct::input_error& e) {  // anything else is the mutant's doing
    (void)std::fprintf(stderr, "contct_mutant_judge: %s\n", e.what());
    return contct_test::not_the_mutants_fault;
  } catch (const std::filesystem::filesystem_error& e) {
    (void)std::fprintf(stderr, "contct_mutant_judge: %s\n", e.what());
    return contct_test::not_the_mutants_fault;
  }
}
