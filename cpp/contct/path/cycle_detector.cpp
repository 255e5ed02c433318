#include "contct/path/cycle_detector.hpp"

#include <algorithm>

namespace contct::path {
namespace {
constexpr std::size_t remembered_increments = 200;
}

void cycle_detector::reset() {
  saved_.clear();
  recent_.clear();
  std::fill(toggles_.begin(), toggles_.end(), 0);
}

bool cycle_detector::repeats(bool moved, std::span<const int> status, std::span<const event> events) {
  remember(events);
  if (moved) {
    saved_.clear();
    return false;
  }
  if (!saved_.empty() && std::equal(status.begin(), status.end(), saved_.begin())) return true;
  if (saved_.empty() || ++steps_since_saved_ == next_save_) {
    next_save_ = saved_.empty() ? 1 : 2 * next_save_;
    steps_since_saved_ = 0;
    saved_.assign(status.begin(), status.end());
  }
  return false;
}

void cycle_detector::remember(std::span<const event> events) {
  for (const event& e : events) ++toggles_[e.pair];
  recent_.emplace_back(events.begin(), events.end());
  if (recent_.size() <= remembered_increments) return;
  for (const event& e : recent_.front()) --toggles_[e.pair];
  recent_.pop_front();
}

std::vector<int> cycle_detector::restless_pairs() const {
  std::vector<int> pairs;
  for (std::size_t i = 0; i < toggles_.size(); ++i) {
    if (toggles_[i] > 1) pairs.push_back(static_cast<int>(i));
  }
  return pairs;
}

}  // namespace contct::path
