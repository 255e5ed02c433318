#include "contct/write/run_csv.hpp"

#include <fmt/format.h>

#include "contct/write/frame_numbers.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace {

std::string event_words(const std::vector<event>& events) {
  std::string words;
  for (const event& e : events)
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", change_name(e.what), e.pair + 1);
  return words;
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

run_csv::run_csv(const problem& p, const lockstep* compared, output_file& increments, output_file* pairs)
    : problem_(p),
      loads_(p),
      compared_(compared),
      increments_(increments),
      pairs_(pairs),
      d_(p.pairs.size()),
      d_star_(p.pairs.size()) {
  increments_.write("step,increment,kind,s,share,force,events,closed,open,at_face,smin,kernels\r\n");
  if (pairs_ != nullptr) pairs_->write("step,increment,pair,node,surface,state,look,w,gap,force\r\n");
}

void run_csv::called(const answered_call& c) {
  for (std::size_t i = 0; i < d_.size(); ++i) {
    const int dof = c.c.dof.dof_of(c.c.id[i]) - 1;
    d_[i] = c.c.dd[dof];
    d_star_[i] = c.c.dtest[dof];
  }
  isep_.assign(c.isep_before.begin(), c.isep_before.end());
  if (pending_) write_pending();
  smin_ = c.c.smin;
  agreement_ = compared_ == nullptr ? "" : compared_->last_call_equal() ? "equal" : "differ";
}

void run_csv::incremented(const increment& i) {
  last_ = {i.step, i.number, i.snaps ? "snap" : "load", i.s, i.fraction, {i.events.begin(), i.events.end()},
           d_,     isep_};
  for (std::size_t p = 0; p < d_.size(); ++p) last_.w[p] += i.s * d_star_[p];
  for (const event& e : i.events) last_.isep[e.pair] = e.what == change::make ? in_contact : separated;
  pending_ = true;
}

void run_csv::step_ended(const step_state& s) {
  if (!pending_ || last_.step != s.step || s.from_fallback) {
    if (pending_) write_pending();
    last_ = {s.step, 0, s.from_fallback ? "rescue" : "end", 0.0, s.fraction, {}, {}, {}};
    agreement_ = "";
  }
  last_.isep.assign(s.isep.begin(), s.isep.end());
  last_.w.clear();
  for (const contact_pair& p : problem_.pairs)
    last_.w.push_back(deflection_of(problem_, s.displacement, p.node));
  write_pending();
}

void run_csv::write_pending() {
  pending_ = false;
  pair_counts n;
  for (std::size_t i = 0; i < last_.w.size(); ++i)
    ++n.of(look_of(problem_.pairs[i], last_.w[i], last_.isep[i] == in_contact));
  const bool called = last_.number > 0;
  const double force = resultant_of(problem_.geometry, loads_.at(last_.step, last_.fraction)).force;
  increments_.write(fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\r\n", last_.step, last_.number,
                                last_.kind, called ? fmt::format("{}", last_.s) : "", last_.fraction, force,
                                csv_field(event_words(last_.events)), n.closed, n.open, n.at_face,
                                called ? fmt::format("{}", smin_) : "", agreement_));
  if (pairs_ != nullptr) write_pairs();
}

void run_csv::write_pairs() {
  for (std::size_t i = 0; i < last_.w.size(); ++i) {
    const contact_pair& p = problem_.pairs[i];
    const pair_reading r = reading_of(p, last_.w[i], last_.isep[i] == in_contact);
    pairs_->write(fmt::format("{},{},{},{},{},{},{},{},{},{}\r\n", last_.step, last_.number, i + 1,
                              csv_field(place_name(problem_.geometry, p.node)), surface_name(p.surface),
                              state_name(last_.isep[i]), look_name(r.look), r.w, r.gap, r.force));
  }
}

void run_csv::finish() {
  increments_.finish();
  if (pairs_ != nullptr) pairs_->finish();
}

}  // namespace contct::write
