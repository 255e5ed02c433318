#include <algorithm>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "catch.hpp"
#include "contct/compare/compare.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/lab/random_calls.hpp"
#include "support/one_pair.hpp"
#include "support/scratch_folder.hpp"

// Functions of cpp/playground/listing_unit.c with f2c's translation of the listing; see CMakeLists.txt.
extern "C" {
void unit_contct_call_r8(const double* dd, const double* dtest, const double* cc, double* ss, double* smin,
                         const int* id, int* isep, const int* isurf, int nc, int indof, int ndofpn);
void unit_contct_call_r4(const float* dd, const float* dtest, const float* cc, float* ss, float* smin,
                         const int* id, int* isep, const int* isurf, int nc, int indof, int ndofpn);
int unit_contct_log_open(const char* path, int length);
void unit_contct_log_flush(void);
void unit_contct_log_rewind(void);
void unit_contct_log_close(void);
}

using namespace contct;

namespace {

constexpr std::int64_t calls = 4'000;

/// The page's unit 26, written to a file.
class unit_26 {
 public:
  unit_26() : path_(folder_.write("unit-26", "")) {
    REQUIRE(unit_contct_log_open(path_.c_str(), static_cast<int>(path_.size())) == 0);
  }
  ~unit_26() { unit_contct_log_close(); }
  unit_26(const unit_26&) = delete;
  unit_26& operator=(const unit_26&) = delete;

  std::string take() {
    unit_contct_log_flush();
    std::string text = folder_.read("unit-26");
    unit_contct_log_rewind();
    std::filesystem::resize_file(path_, 0);
    return text;
  }

 private:
  scratch_folder folder_;
  std::string path_;
};

template <class Real>
std::vector<Real> as(const std::vector<double>& numbers) {
  return {numbers.begin(), numbers.end()};
}

template <class Real, class Function>
call_outputs ask_page(Function procedure, const call_inputs<double>& in, unit_26& unit) {
  const auto [dd, dtest, cc] = std::tuple{as<Real>(in.dd), as<Real>(in.dtest), as<Real>(in.cc)};
  std::vector<Real> ss(cc.size(), static_cast<Real>(not_an_answer));
  auto smin = static_cast<Real>(not_an_answer);
  call_outputs a{0.0, {}, in.isep, {}};
  procedure(dd.data(), dtest.data(), cc.data(), ss.data(), &smin, in.id.data(), a.isep.data(),
            in.isurf.data(), static_cast<int>(cc.size()), in.dof.indof, in.dof.ndofpn);
  a.smin = smin;
  a.ss.assign(ss.begin(), ss.end());
  a.text = unit.take();
  return a;
}

template <class Real, class Function>
void check_all(const std::string& name, Function procedure) {
  const auto gfortran = make_kernel(name);
  call_source source(1989, sizeof(Real));
  unit_26 unit;
  tally answers;
  std::int64_t lines = 0, different = 0;
  for (std::int64_t number = 1; number <= calls; ++number) {
    const call_inputs<double>& in = source.at(number);
    const call_outputs a = ask_page<Real>(procedure, in, unit);
    const call_outputs b = answer_of(*gfortran, in);
    (void)compare_answers<double>({b.smin, b.ss, b.isep}, {a.smin, a.ss, a.isep}, answers);
    if (a.text != b.text && different++ == 0) {
      INFO(number);
      CHECK(a.text == b.text);
    }
    lines += std::count(a.text.begin(), a.text.end(), '\n');
  }
  CHECK(different == 0);
  CHECK(lines > calls);
  CHECK(answers.values > 20 * calls);
  CHECK(answers.mismatches == 0);
}

}  // namespace

TEST_CASE(
    "the playground's listing in 8-byte REAL answers as gfortran's, and writes the same bytes to unit 26") {
  check_all<double>("fortran", unit_contct_call_r8);
}

TEST_CASE(
    "the playground's listing in 4-byte REAL answers as gfortran's, and writes the same bytes to unit 26") {
  check_all<float>("fortran-r4", unit_contct_call_r4);
}
