// What a kernel behind a pipe answers; now and then from a real one.
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <numeric>

#include "contct/outside/child_kernel.hpp"
#include "contct/trace/trace.hpp"
#include "fuzz/fuzz.hpp"

namespace {

using namespace contct::fuzz;
using namespace contct::outside;

/// The same answer from the text and by way of a process: read, or refused, by both.
void check_real_pipe(std::string_view text, bool is_sound) {
  static const int answer = memfd_create("answer", 0);
  require(ftruncate(answer, 0) == 0 && pwrite(answer, text.data(), text.size(), 0) == std::ssize(text),
          "memory");
  const std::string command = "cat /proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(answer);
  const std::unique_ptr<kernel> pipe = make_pipe(command);
  call_inputs<double> in;
  in.dd = {0.0, 1.0};
  in.dtest = {1.0, 1.0};
  in.cc = {0.5, 2.0};
  in.id = {1, 2};
  in.isep = {1, 1};
  in.isurf = {1, 1};
  in.dof = {1, 1};
  call_outputs out;
  call<double> asked = out.prepare(in);
  try {
    pipe->answer(asked);
    require(is_sound, "a process's answer is refused like its text", text);
    (void)pipe->take_text();
    pipe->answer(asked);  // by now the process has ended, or has said more
  } catch (const kernel_failure&) {
    // a real one may be refused for what stands behind its answer
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = text_of(data, size);
  for (const std::size_t pairs : {0U, 1U, 2U, 5U}) {
    call_outputs out;
    out.ss.resize(pairs);
    out.isep.resize(pairs);
    const bool is_sound = is_read([&] {
      trace_reader reader(text, "its answer");
      reader.read_answer(out);
    });
    require(out.ss.size() == pairs && out.isep.size() == pairs, "an answer has as many pairs as were asked");
    const std::size_t one_of = is_sound ? 16 : 251;
    if (pairs == 2 && std::accumulate(data, data + size, std::size_t{0}) % one_of == 0)
      check_real_pipe(text, is_sound);
  }
  return 0;
}
