#include "contct/distributed/ranks.hpp"

#include "catch.hpp"

using namespace contct::distributed;

TEST_CASE("a process has joined no ranks until it says so") {
  struct : ranks {
    [[nodiscard]] int own() const override { return 0; }
    [[nodiscard]] int count() const override { return 1; }
    [[nodiscard]] std::vector<long> peak_kib() override { return {0}; }
    void serve() override {}
    [[nodiscard]] std::unique_ptr<contct::matrix::sparse_factor> distribute(
        const contct::matrix::sparse_columns& /*a*/) override {
      return nullptr;
    }
    [[nodiscard]] std::unique_ptr<contct::matrix::remote_matrix> stiffness_of(
        const contct::structure::plate& /*p*/) override {
      return nullptr;
    }
    [[nodiscard]] std::unique_ptr<contct::matrix::remote_matrix> read_stiffness(const std::string& /*path*/,
                                                                                const std::string& /*name*/,
                                                                                int /*rows*/) override {
      return nullptr;
    }
    void leave() noexcept override {}
  } alone;
  CHECK(joined_ranks() == nullptr);
  set_joined_ranks(&alone);
  CHECK(joined_ranks() == &alone);
  set_joined_ranks(nullptr);
  CHECK(joined_ranks() == nullptr);
}
