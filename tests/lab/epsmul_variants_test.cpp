// The copies of the listing with another EPSMUL: they differ from it in that alone.
#include "contct/lab/epsmul_variants.hpp"

#include <algorithm>
#include <cstring>

#include "catch.hpp"
#include "contct/numeric/random.hpp"
#include "contct/outside/registry.hpp"

using namespace contct::app;

namespace {

/// The answer to one call with a pair at each node: s, s_min and the statuses after it.
struct answer {
  std::vector<double> ss;
  double smin = 0.0;
  std::vector<int> isep;

  bool operator==(const answer& other) const {
    return isep == other.isep && std::memcmp(&smin, &other.smin, sizeof smin) == 0 &&
           std::equal(ss.begin(), ss.end(), other.ss.begin(),
                      [](const double& a, const double& b) { return std::memcmp(&a, &b, sizeof a) == 0; });
  }
};

/// One call of pairs below that are separated or in contact, D = 0, one dof a node.
answer ask(kernel& k, const std::vector<double>& d_star, const std::vector<double>& c,
           const std::vector<int>& isep) {
  const std::vector<double> d(c.size(), 0.0);
  const std::vector<int> below(c.size(), face_below);
  std::vector<int> id(c.size());
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = static_cast<int>(i) + 1;
  answer a{std::vector<double>(c.size()), 0.0, isep};
  call<double> asked{d, d_star, c, a.ss, 0.0, id, a.isep, below, {}};
  k.answer(asked);
  a.smin = asked.smin;
  return a;
}

/// Two separated pairs whose scale factors are 0.5 and 0.5 (1 + apart): how many make contact?
long made(kernel& k, double apart) {
  const answer a = ask(k, {-1.0, -1.0}, {-0.5, -0.5 * (1 + apart)}, {separated, separated});
  return std::count(a.isep.begin(), a.isep.end(), in_contact);
}

}  // namespace

TEST_CASE("EPSMUL of the variants falls from below the printed one to 1e-12") {
  const std::vector<double> values = epsmul_of_variants();
  REQUIRE(values.size() == 7);
  CHECK(values.front() == 1e-3);
  CHECK(values.back() == 1e-12);
  CHECK(std::is_sorted(values.rbegin(), values.rend()));
  CHECK(printed_epsmul == 1.0 / 256);
}

TEST_CASE("without near ties every variant answers as the listing does, to the bit") {
  const auto listing = make_kernel("fortran");
  random_numbers random(11);
  int events = 0;
  for (int round = 0; round < 500; ++round) {
    std::vector<double> d_star, c;
    std::vector<int> isep;
    for (int pair = 0; pair < 6; ++pair) {
      // Scale factors are at least 1/40 apart: s = 0.1 + 0.15 (pair + 0..0.8), one pair at its face now and
      // then.
      const double s = 0.1 + 0.15 * (pair + 0.8 * random.unit());
      d_star.push_back(random.unit() < 0.5 ? -1.0 - random.unit() : 1.0 + random.unit());
      c.push_back(random.chance(0.05) ? 0.0 : s * d_star.back());
      isep.push_back(random.chance(0.5) ? separated : in_contact);
    }
    const answer expected = ask(*listing, d_star, c, isep);
    events += expected.isep != isep ? 1 : 0;
    for (std::size_t variant = 0; variant < epsmul_of_variants().size(); ++variant) {
      INFO("round " << round << ", EPSMUL " << epsmul_of_variants()[variant]);
      CHECK(ask(*make_epsmul_variant(variant), d_star, c, isep) == expected);
    }
  }
  CHECK(events > 400);
}

TEST_CASE("a tie within 2^-8 and outside 1e-3 parts the listing from its variants") {
  constexpr double apart = 2e-3;
  CHECK(made(*make_kernel("fortran"), apart) == 2);
  for (std::size_t variant = 0; variant < epsmul_of_variants().size(); ++variant)
    CHECK(made(*make_epsmul_variant(variant), apart) == 1);
}

TEST_CASE("each variant takes along what is within its own EPSMUL, and no more") {
  const std::vector<double> values = epsmul_of_variants();
  for (std::size_t variant = 0; variant < values.size(); ++variant) {
    INFO("EPSMUL " << values[variant]);
    const auto k = make_epsmul_variant(variant);
    CHECK(made(*k, 0.9 * values[variant]) == 2);
    CHECK(made(*k, 1.1 * values[variant]) == 1);
  }
  CHECK(made(*make_kernel("fortran"), 0.9 * printed_epsmul) == 2);
  CHECK(made(*make_kernel("fortran"), 1.1 * printed_epsmul) == 1);
}

TEST_CASE("no variant is a kernel that can be chosen") {
  for (const std::string& name : kernel_names()) CHECK(name.find("EPSMUL") == std::string::npos);
  CHECK_THROWS_AS(make_kernel(make_epsmul_variant(0)->facts().name), std::invalid_argument);
  CHECK(make_epsmul_variant(4)->facts().name == "fortran with EPSMUL 1e-09");
}
