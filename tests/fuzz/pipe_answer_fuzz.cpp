// What a kernel behind a pipe answers.
#include "contct/kernel/trace.hpp"
#include "fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace contct::fuzz;
  using namespace contct;
  for (const std::size_t pairs : {0U, 1U, 2U, 5U}) {
    call_outputs out;
    out.ss.resize(pairs);
    out.isep.resize(pairs);
    (void)is_read([&] { trace_reader(text_of(data, size), "its answer").read_answer(out); });
    require(out.ss.size() == pairs && out.isep.size() == pairs, "an answer has as many pairs as were asked");
  }
  return 0;
}
