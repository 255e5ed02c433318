#include "contct/compare/replay.hpp"

namespace contct::compare {

bool comparable(const trace_header& h, const kernel_facts& k) {
  return h.real_bytes == k.real_bytes && h.rule == k.rule;
}

replay_report replay(const trace_header& h, trace_reader& calls, kernel& k,
                     const std::function<void(std::int64_t)>& progress) {
  replay_report report;
  recorded_call c;
  // A trace of f2c's may be replayed where there is no f2c, so its name alone says that the zeros before its
  // decimal points are missing.
  follower asked({"the trace", h.real_bytes, h.rule, "", "", "", true, h.kernel == "f2c"}, k);
  while (calls.next(c)) {
    ++report.calls;
    const call<double> recorded{c.in.dd, c.in.dtest, c.in.cc,    c.out.ss, c.out.smin,
                                c.in.id, c.out.isep, c.in.isurf, c.in.dof};
    report.branches.count(recorded, c.in.isep);
    if (progress) progress(report.calls);
    // A kernel with text writes some in every call: where the trace has none, its kernel had none.
    std::optional<std::string_view> text;
    if (!c.out.text.empty()) text = c.out.text;
    (void)asked.ask(c.number, recorded, c.in.isep, text);
  }
  report.compared = asked.compared;
  report.first = asked.first();
  return report;
}

}  // namespace contct::compare
