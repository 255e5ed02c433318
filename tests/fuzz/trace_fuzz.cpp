// Fuzzes the reader of traces. A trace that is written must be read as the same trace.
#include "contct/kernel/trace.hpp"
#include "fuzz/fuzz.hpp"

namespace {

using namespace contct::fuzz;
using namespace contct;

struct read_trace {
  trace_header header;
  std::vector<recorded_call> calls;
};

read_trace read_whole(std::string_view text) {
  constexpr std::size_t most_dofs = 100'000;  // in all calls together, for speed
  trace_reader reader(text, "f.trace");
  read_trace all{reader.read_header(), {}};
  recorded_call c;
  std::size_t dofs = 0;
  while (reader.next(c) && (dofs += c.in.dd.size()) < most_dofs) all.calls.push_back(c);
  return all;
}

std::string written(const read_trace& t) {
  std::string text;
  append_header(t.header, text);
  for (const recorded_call& c : t.calls) {
    append_inputs(c.number, c.note, c.in, text);
    append_answer(c.out.smin, c.out.ss, c.out.isep, c.out.text, text);
  }
  return text;
}

void check(const read_trace& t) {
  for (const recorded_call& c : t.calls) {
    for (std::size_t i = 0; i < c.in.pairs(); ++i)
      require(c.in.dof_of_pair(i) < c.in.dd.size(), "a pair is at a dof");
    require(c.out.ss.size() == c.in.pairs() && c.out.isep.size() == c.in.pairs(), "an answer has all pairs");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read_trace first;
  if (!is_read([&] { first = read_whole(text_of(data, size)); })) return 0;
  check(first);
  const std::string text = written(first);
  require(is_read([&] { require(written(read_whole(text)) == text, "a trace is written as it was read"); }),
          "a trace that was written is read", text);
  return 0;
}
