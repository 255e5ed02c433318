#include "contct/lab/reproduce.hpp"

#include "contct/compare/follower.hpp"
#include "contct/outside/registry.hpp"

namespace contct {

std::optional<found_case> reproduce(kernel& leader, const std::string& follower, const call_sequence& calls,
                                    const std::string& field) {
  const std::unique_ptr<kernel> fresh = make_kernel(follower);
  found_case c;
  c.real_bytes = leader.facts().real_bytes;
  c.calls = calls;
  std::optional<mismatch> last;
  call_outputs its;
  tally ignored;
  (void)leader.take_text();
  for (const call_inputs<double>& in : calls) {
    call_outputs& out = c.leader.emplace_back();
    call<double> asked = out.prepare(in);
    leader.answer(asked);
    out.smin = asked.smin;
    out.text = leader.take_text();
    const auto text = leader.facts().has_text ? std::optional<std::string_view>(out.text) : std::nullopt;
    last =
        put_to(*fresh, asked, in.isep, text, text_equality_of(leader.facts(), fresh->facts()), its, ignored);
    c.what.decisions = decisions_of(asked, in.isep, c.real_bytes);
  }
  if (!last || (!field.empty() && last->field != field)) return {};
  c.what.call = static_cast<std::int64_t>(calls.size());
  c.what.leader = leader.facts().name;
  c.what.follower = follower;
  c.what.where = *last;
  return c;
}

std::optional<found_case> shrunk_case(kernel& leader, const std::string& follower, const call_sequence& calls,
                                      const std::string& field, int most_tries) {
  const still_diverges diverges = [&](const call_sequence& candidate) {
    return reproduce(leader, follower, candidate, field).has_value();
  };
  if (!diverges(calls)) return {};
  return reproduce(leader, follower, shrink(calls, diverges, most_tries), field);
}

}  // namespace contct
