#include "contct/kernel/registry.hpp"
#include "contct/kernel/trace.hpp"
#include "golden/cases.hpp"

namespace golden {

std::string recorded(const golden_trace& t) {
  const std::unique_ptr<contct::kernel> k = contct::make_kernel(t.real_bytes == 4 ? "fortran-r4" : "fortran");
  contct::trace_header h = contct::header_for(k->facts(), CONTCT_LISTING_SHA256);
  h.about = t.about;
  std::string text;
  contct::append_header(h, text);
  std::int64_t number = 0;
  contct::call_outputs out;
  for (const golden_call& c : t.calls) {
    contct::call<double> asked = out.prepare(c.in);
    k->answer(asked);
    contct::append_inputs(++number, c.note, c.in, text);
    contct::append_answer(asked.smin, out.ss, out.isep, k->take_text(), text);
  }
  return text;
}

}  // namespace golden
