#include "contct/compare/replay.hpp"

#include "contct/compare/follower.hpp"

namespace contct {
namespace {

/// The text of a recorded call. A kernel that has any writes some in every call; one from outside, or
/// the corrected one, never does.
std::optional<std::string_view> recorded_text(const recorded_call& c) {
  if (c.out.text.empty()) return std::nullopt;
  return c.out.text;
}

/// How the trace's text is compared with a kernel's. A trace of f2c's may be replayed where there is no f2c,
/// so its name alone says that the zeros before its points are missing.
text_equality text_equality_of(const trace_header& h, const kernel& k) {
  return h.kernel == "f2c" || k.facts().text_by_meaning ? text_equality::meaning : text_equality::bytes;
}

}  // namespace

bool comparable(const trace_header& h, const kernel_facts& k) {
  return h.real_bytes == k.real_bytes && h.rule == k.rule;
}

replay_report replay(const trace_header& h, trace_reader& calls, kernel& k,
                     const std::function<void(std::int64_t)>& told) {
  replay_report report;
  recorded_call c;
  call_outputs answered;
  const text_equality equality = text_equality_of(h, k);
  while (calls.next(c)) {
    ++report.calls;
    const call<double> recorded{c.in.dd, c.in.dtest, c.in.cc,    c.out.ss, c.out.smin,
                                c.in.id, c.out.isep, c.in.isurf, c.in.dof};
    report.branches.count(recorded, c.in.isep);
    if (told) told(report.calls);
    const auto found = put_to(k, recorded, c.in.isep, recorded_text(c), equality, answered, report.compared);
    if (!found || report.first) continue;
    report.first = mismatch_report{c.number, "the trace", k.facts().name, *found,
                                   decisions_of(recorded, c.in.isep, h.real_bytes)};
  }
  return report;
}

}  // namespace contct
