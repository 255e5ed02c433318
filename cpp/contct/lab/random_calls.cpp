#include "contct/lab/random_calls.hpp"

#include <limits>

namespace contct {
namespace {

constexpr int most_pairs = 64;
constexpr int last_node = 1100;  // beyond 999, I3 of the log overflows
constexpr double powers_of_ten[] = {1e-15, 1e-12, 1e-10, 1e-9, 1e-6, 1e-3, 1.0, 1e2, 1e5};

}  // namespace

template <class Real>
Real random_calls<Real>::number(double zero_share, double grid_share) {
  if (random_.chance(zero_share)) return random_.chance(0.5) ? Real(0) : -Real(0);
  if (random_.chance(grid_share)) return static_cast<Real>(random_.whole(-16, 16)) / Real(8);
  const double scale = random_.chance(0.7) ? 1.0 : powers_of_ten[random_.whole(0, 8)];
  return static_cast<Real>((2 * random_.unit() - 1) * scale);
}

template <class Real>
void random_calls<Real>::place_pair(std::size_t i, int first_node, int nodes) {
  in_.id[i] = random_.whole(first_node, first_node + nodes - 1);
  in_.isep[i] = random_.chance(0.5) ? separated : in_contact;
  in_.isurf[i] = random_.chance(0.5) ? face_above : face_below;
  const auto dof = static_cast<std::size_t>(in_.dof.dof_of(in_.id[i]) - 1);
  in_.dd[dof] = number(0.3, 0.5);
  in_.dtest[dof] = number(0.1, 0.5);
  // Some pairs stand at their face, some within EPSGAP of it.
  in_.cc[i] =
      random_.chance(0.3)
          ? in_.dd[dof] + static_cast<Real>(random_.chance(0.5) ? 0.0 : 2e-10 * (random_.unit() - 0.5))
          : number(0.2, 0.5);
}

template <class Real>
const call_inputs<Real>& random_calls<Real>::next() {
  in_.dof = {random_.whole(1, 3), random_.whole(1, 3)};
  const auto dofs = static_cast<std::size_t>(3 * last_node + 3);
  if (in_.dd.size() != dofs) {
    in_.dd.assign(dofs, std::numeric_limits<Real>::quiet_NaN());
    in_.dtest.assign(dofs, std::numeric_limits<Real>::quiet_NaN());
  }
  const auto pairs = static_cast<std::size_t>(random_.whole(1, random_.chance(0.5) ? 4 : most_pairs));
  in_.cc.resize(pairs);
  in_.id.resize(pairs);
  in_.isep.resize(pairs);
  in_.isurf.resize(pairs);
  const int nodes = random_.whole(1, 80);
  const int first_node = random_.chance(0.05) ? last_node - nodes : random_.whole(1, 20);
  for (std::size_t i = 0; i < pairs; ++i) place_pair(i, first_node, nodes);
  return in_;
}

template <class Real>
const call_inputs<Real>& random_calls<Real>::at(std::uint64_t number) {
  for (std::size_t i = 0; i < in_.pairs(); ++i) {
    in_.dd[in_.dof_of_pair(i)] = std::numeric_limits<Real>::quiet_NaN();
    in_.dtest[in_.dof_of_pair(i)] = std::numeric_limits<Real>::quiet_NaN();
  }
  random_ = random_numbers(random_numbers(seed_ ^ (number * 0xd1342543de82ef95)).bits());
  return next();
}

template class random_calls<float>;
template class random_calls<double>;

}  // namespace contct
