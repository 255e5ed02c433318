#include "contct/compare/branches.hpp"

#include <algorithm>

namespace contct::compare {

template <class Real>
void branch_counts::count(const call<Real>& c, std::span<const int> isep_before) {
  for_each_decision(c, isep_before,
                    [this](branch b, std::size_t, bool outcome, Real, Real) { add(b, outcome, 1); });
}

template void branch_counts::count(const call<float>&, std::span<const int>);
template void branch_counts::count(const call<double>&, std::span<const int>);

void branch_counts::add(const branch_counts& other) {
  for (std::size_t b = 0; b < counts_.size(); ++b) {
    for (std::size_t outcome = 0; outcome < 2; ++outcome) counts_[b][outcome] += other.counts_[b][outcome];
  }
}

std::int64_t branch_counts::rarest() const {
  std::int64_t least = counts_[0][0];
  for (const auto& both : counts_) least = std::min({least, both[0], both[1]});
  return least;
}

}  // namespace contct::compare
