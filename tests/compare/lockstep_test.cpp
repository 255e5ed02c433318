#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/path_observers.hpp"
#include "support/beams.hpp"

using namespace contct;

namespace {

using call_of_double = call<double>;

/// The C++ kernel with a fault that `fault` puts into its answers.
class faulty_kernel final : public kernel {
 public:
  explicit faulty_kernel(std::function<void(call<double>&, std::string&)> fault) : fault_(std::move(fault)) {}
  [[nodiscard]] const kernel_facts& facts() const override { return facts_; }
  void answer(call<double>& c) override {
    inner_->answer(c);
    text_ = inner_->take_text();
    fault_(c, text_);
  }
  std::string take_text() override { return text_; }

 private:
  kernel_facts facts_{"faulty", 8, contact_rule::listing, "", "", "", true};
  std::unique_ptr<kernel> inner_ = make_kernel("cpp");
  std::function<void(call<double>&, std::string&)> fault_;
  std::string text_;
};

/// Follows PB1 with FORTRAN as the leader of these followers.
template <class... Followers>
lockstep_on_path in_lockstep_with(Followers... followers) {
  const auto leader = make_kernel("fortran");
  std::vector<std::unique_ptr<kernel>> all;
  (all.push_back(std::move(followers)), ...);
  lockstep_on_path compared(leader->facts(), std::move(all));
  cantilever_over_a_stop().run(*leader, {&compared});
  return compared;
}

std::unique_ptr<kernel> faulty(std::function<void(call<double>&, std::string&)> fault) {
  return std::make_unique<faulty_kernel>(std::move(fault));
}

lockstep_on_path with_fault(std::function<void(call<double>&, std::string&)> fault) {
  return in_lockstep_with(faulty(std::move(fault)));
}

}  // namespace

TEST_CASE(
    "in lockstep, FORTRAN and C++ follow a cantilever over a stop (PB1) without a mismatch, in 24 values") {
  const lockstep_on_path compared = in_lockstep_with(make_kernel("cpp"));
  CHECK(compared.calls() == 6);
  CHECK(compared.compared().values == 6L * 4);  // SMIN, SS, ISEP and text
  CHECK(compared.compared().mismatches == 0);
  CHECK_FALSE(compared.first());
  CHECK(compared.last_call_equal());
}

TEST_CASE(
    "for each follower, the differences of SMIN and of the worst s in the last call are counted in ULPs") {
  const lockstep_on_path good = in_lockstep_with(make_kernel("cpp"));
  REQUIRE(good.last_answers().size() == 1);
  CHECK(good.last_answers()[0].values == 4);
  CHECK(good.last_answers()[0].mismatches == 0);
  CHECK(good.last_answers()[0].smin_ulps == 0);
  CHECK(good.last_answers()[0].ss_ulps == 0);
  const lockstep_on_path off = with_fault([](call<double>& c, std::string&) {
    c.smin = std::nextafter(c.smin, 2.0);
    c.ss[0] = std::nextafter(std::nextafter(c.ss[0], 2.0), 2.0);
  });
  REQUIRE(off.last_answers().size() == 1);
  CHECK(off.last_answers()[0].mismatches == 2);
  CHECK(off.last_answers()[0].smin_ulps == 1);
  CHECK(off.last_answers()[0].ss_ulps == 2);
}

TEST_CASE("lockstep detects a fault of one ULP in SMIN in the call in which the fault occurs") {
  int call_number = 0;
  const lockstep_on_path compared = with_fault([&](call<double>& c, std::string&) {
    if (++call_number == 2) c.smin = std::nextafter(c.smin, 1.0);
  });
  REQUIRE(compared.first());
  CHECK(compared.compared().mismatches == 1);
  CHECK(compared.first()->call == 2);
  CHECK(compared.first()->where.field == "SMIN");
  CHECK(compared.first()->where.ulps == 1);
  CHECK(compared.first()->follower == "faulty");
}

TEST_CASE("in lockstep, the last call counts as equal only if the answer of every follower is equal") {
  const auto fault = [](call<double>& c, std::string&) { c.smin = std::nextafter(c.smin, 2.0); };
  CHECK_FALSE(with_fault(fault).last_call_equal());
  CHECK_FALSE(with_fault([](call<double>&, std::string& text) { text += "?"; }).last_call_equal());
  // One faulty follower makes the call unequal, whether it is first or last.
  for (const int place : {0, 1}) {
    const lockstep_on_path compared = place == 0 ? in_lockstep_with(faulty(fault), make_kernel("cpp"))
                                                 : in_lockstep_with(make_kernel("cpp"), faulty(fault));
    CHECK_FALSE(compared.last_call_equal());
    CHECK(compared.last_answers()[place].mismatches == 1);
    CHECK(compared.last_answers()[1 - place].mismatches == 0);
    CHECK(compared.followers()[1 - place].compared.mismatches == 0);
    CHECK(compared.compared().values == 2L * 6 * 4);
  }
}

TEST_CASE("if a follower gives no answer, the call has one mismatch and no difference in ULPs") {
  const lockstep_on_path compared =
      with_fault([](call<double>&, std::string&) { throw kernel_failure("it ended with status 3"); });
  CHECK(compared.compared().values == 6);
  CHECK(compared.compared().mismatches == 6);
  CHECK(compared.first()->where.field == "answer");
  CHECK(compared.last_answers()[0].failed);
  CHECK(compared.last_answers()[0].smin_ulps == 0);
}

TEST_CASE("lockstep detects a fault in SS, a fault in ISEP, and a fault in the text of unit 26") {
  CHECK(with_fault([](call<double>& c, std::string&) { c.ss[0] = -c.ss[0]; }).first()->where.field == "SS");
  CHECK(with_fault([](call<double>& c, std::string&) { c.isep[0] = -c.isep[0]; }).first()->where.field ==
        "ISEP");
  CHECK(with_fault([](call<double>&, std::string& text) { text[3] = '?'; }).first()->where.field == "text");
}

TEST_CASE("in lockstep, the path follows the answers of the leading kernel, whatever the followers answer") {
  // Every call has the leader's inputs, so that one fault gives one mismatch.
  int call_number = 0;
  const lockstep_on_path compared = with_fault([&](call<double>& c, std::string&) {
    if (++call_number == 1) c.isep[0] = in_contact;
  });
  CHECK(compared.compared().mismatches == 1);
  CHECK(compared.last_call_equal());
}

TEST_CASE("lockstep reports the mismatch of the earliest call, in any order of the followers") {
  const auto wrong_from = [](int call, double by) {
    return faulty([call, by, n = 0](call_of_double& c, std::string&) mutable {
      if (++n >= call) c.smin += by;
    });
  };
  for (const bool early_first : {true, false}) {
    const lockstep_on_path compared = early_first ? in_lockstep_with(wrong_from(2, 0.25), wrong_from(4, 0.5))
                                                  : in_lockstep_with(wrong_from(4, 0.5), wrong_from(2, 0.25));
    REQUIRE(compared.first());
    CHECK(compared.first()->call == 2);
  }
}
