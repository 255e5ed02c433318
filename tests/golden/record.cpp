#include "contct/outside/registry.hpp"
#include "contct/trace/trace.hpp"
#include "golden/cases.hpp"

namespace golden {

std::string recorded(const golden_trace& t) {
  const std::unique_ptr<contct::app::kernel> k =
      contct::app::make_kernel(t.real_bytes == 4 ? "fortran-r4" : "fortran");
  contct::app::trace_header h = contct::app::header_for(k->facts(), CONTCT_LISTING_SHA256);
  h.about = t.about;
  std::string text;
  contct::app::append_header(h, text);
  std::int64_t number = 0;
  contct::app::call_outputs out;
  for (const golden_call& c : t.calls) {
    contct::app::call<double> asked = out.prepare(c.in);
    k->answer(asked);
    contct::app::append_inputs(++number, c.note, c.in, text);
    contct::app::append_answer(asked.smin, out.ss, out.isep, k->take_text(), text);
  }
  return text;
}

}  // namespace golden
