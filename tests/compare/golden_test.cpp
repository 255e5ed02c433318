// Tests the golden set of reference/traces: its answers are those of the 1989 code in this build, it reaches
// every outcome of every IF, and the C++ kernel gives the same answers.
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "catch.hpp"
#include "contct/compare/compare.hpp"
#include "contct/kernel/registry.hpp"
#include "golden/cases.hpp"

using namespace contct;

namespace {

const std::filesystem::path folder = CONTCT_TRACES;

std::string read(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::filesystem::path> committed() {
  std::vector<std::filesystem::path> all;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) all.push_back(entry.path());
  return all;
}

/// Returns the trace without the lines about the machine that recorded it.
std::string without_origin(const std::string& trace) {
  std::istringstream in(trace);
  std::string out;
  for (std::string line; std::getline(in, line);) {
    bool origin = false;
    for (const char* key : {"compiler ", "flags ", "floating-point "})
      origin = origin || line.rfind(key, 0) == 0;
    if (!origin) out += line + "\n";
  }
  return out;
}

}  // namespace

TEST_CASE("the 1989 code gives the answers of the committed traces, line by line") {
  int calls = 0;
  for (const golden::golden_trace& t : golden::all_traces()) {
    INFO(t.name);
    CHECK(without_origin(read(folder / (t.name + ".trace"))) == without_origin(golden::recorded(t)));
    calls += static_cast<int>(t.calls.size());
  }
  CHECK(calls > 300);
}

TEST_CASE("every committed trace states a purpose, and the folder of traces has no other files") {
  std::set<std::string> made;
  for (const golden::golden_trace& t : golden::all_traces()) made.insert(t.name + ".trace");
  for (const auto& path : committed()) {
    INFO(path);
    CHECK(path.extension() == ".trace");
    const std::string name = path.filename().string();
    CHECK((made.count(name) == 1 || name.rfind("path-", 0) == 0));
    const std::string text = read(path);
    trace_reader reader(text, name);
    CHECK_FALSE(reader.read_header().about.empty());
  }
}

TEST_CASE(
    "the C++ kernel gives all answers of the committed traces to the bit, with every outcome of every IF") {
  std::map<int, branch_counts> reached;
  std::int64_t values = 0;
  for (const auto& path : committed()) {
    const std::string text = read(path);
    trace_reader reader(text, path.filename().string());
    const trace_header h = reader.read_header();
    const auto twin = make_kernel(h.real_bytes == 4 ? "cpp-r4" : "cpp");
    const replay_report r = replay(h, reader, *twin);
    INFO(path);
    CHECK(r.compared.mismatches == 0);
    values += r.compared.values;
    reached[h.real_bytes].add(r.branches);
  }
  CHECK(values > 5000);
  CHECK(reached.at(8).rarest() >= 5);
  CHECK(reached.at(4).rarest() >= 5);
}
