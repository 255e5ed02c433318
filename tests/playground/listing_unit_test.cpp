#include <algorithm>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "catch.hpp"
#include "contct/harness/compare.hpp"
#include "contct/harness/random_calls.hpp"
#include "contct/kernel/registry.hpp"
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

template <class Real>
std::vector<Real> as(const std::vector<double>& numbers) {
  return {numbers.begin(), numbers.end()};
}

/// Compares 1000 random calls with the kernel `name`. The page's unit 26 is written to a file.
template <class Real, class Function>
void check_all(const std::string& name, Function procedure) {
  constexpr std::int64_t calls = 1'000;
  const scratch_folder folder;
  const std::string path = folder.write("unit-26", "");
  REQUIRE(unit_contct_log_open(path.c_str(), static_cast<int>(path.size())) == 0);
  const auto gfortran = make_kernel(name);
  call_source source(1989, sizeof(Real));
  tally answers;
  std::int64_t lines = 0, different = 0;
  for (std::int64_t number = 1; number <= calls; ++number) {
    const call_inputs& in = source.at(number);
    const auto [dd, dtest, cc] = std::tuple{as<Real>(in.dd), as<Real>(in.dtest), as<Real>(in.cc)};
    std::vector<Real> ss(cc.size(), static_cast<Real>(not_an_answer));
    auto smin = static_cast<Real>(not_an_answer);
    std::vector<int> isep = in.isep;
    procedure(dd.data(), dtest.data(), cc.data(), ss.data(), &smin, in.id.data(), isep.data(),
              in.isurf.data(), static_cast<int>(cc.size()), in.dof.indof, in.dof.ndofpn);
    unit_contct_log_flush();
    const std::string text = folder.read("unit-26");
    unit_contct_log_rewind();
    std::filesystem::resize_file(path, 0);
    const call_outputs expected = answer_of(*gfortran, in);
    const call_outputs found{smin, {ss.begin(), ss.end()}, isep, ""};
    (void)compare_answers(expected, found, answers);
    if (text != expected.text && different++ == 0) {
      INFO(number);
      CHECK(text == expected.text);
    }
    lines += std::count(text.begin(), text.end(), '\n');
  }
  unit_contct_log_close();
  CHECK(different == 0);
  CHECK(lines > calls);
  CHECK(answers.values > 20 * calls);
  CHECK(answers.mismatches == 0);
}

}  // namespace

TEST_CASE("the playground's listing answers as gfortran's, and writes the same bytes to unit 26") {
  check_all<double>("fortran", unit_contct_call_r8);
  check_all<float>("fortran-r4", unit_contct_call_r4);
}
