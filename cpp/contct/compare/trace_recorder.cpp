#include "contct/compare/trace_recorder.hpp"

#include <utility>

namespace contct {

trace_recorder::trace_recorder(const trace_header& h, sink to) : to_(std::move(to)) {
  append_header(h, text_);
  to_(text_);
}

void trace_recorder::called(const answered_call& c) {
  text_.clear();
  append_inputs(++calls_, "", c.c, c.isep_before, text_);
  append_answer(c.c.smin, c.c.ss, c.c.isep, c.text, text_);
  to_(text_);
}

}  // namespace contct
