// Rows of a plate's stiffness by parts are those of the whole, to the bit.
#include "contct/structure/plate_rows.hpp"

#include "catch.hpp"

using namespace contct::structure;

namespace {

plate plate_of(std::vector<double> x, std::vector<double> y) {
  plate p;
  p.x = std::move(x);
  p.y = std::move(y);
  p.D = 7.3;
  p.nu = 0.3;
  return p;
}

}  // namespace

TEST_CASE("the rows of a plate, in however many parts, are those that are assembled at once") {
  int compared = 0;
  for (const plate& p : {plate_of({0, 0.3, 1, 1.1}, {0, 0.7, 1.1, 5, 5.5}), plate_of({0, 1}, {0, 2}),
                         plate_of({0, 0.1, 0.2, 0.30000000000000004, 9}, {-1, 1, 1.5})}) {
    const linear_structure whole = build(p, {}, {});
    std::vector<char> all(static_cast<std::size_t>(p.dofs()), 1);
    for (const int parts : {1, 2, 3, 7}) {
      std::size_t entries = 0;
      for (int part = 0; part < parts; ++part) {
        const int first = p.dofs() * part / parts;
        const auto rows = stiffness_rows(p, first, p.dofs() * (part + 1) / parts - first);
        REQUIRE(rows.first == first);
        for (int row = 0; row < rows.count(); ++row) {
          const auto at = static_cast<std::size_t>(row);
          int before = -1;
          for (std::size_t i = rows.starts[at]; i < rows.starts[at + 1]; ++i) {
            const int column = rows.columns[i];
            CHECK(column > before);
            before = column;
            const int one = whole.row_of(static_cast<std::size_t>(first + row));
            const int other = whole.row_of(static_cast<std::size_t>(column));
            const int low = std::min(one, other);
            const int high = std::max(one, other);
            CHECK(rows.values[i] ==
                  whole.stiffness.band().at(static_cast<std::size_t>(high), static_cast<std::size_t>(low)));
            ++compared;
          }
        }
        entries += rows.values.size();
      }
      CHECK(entries == stiffness_rows(p, 0, p.dofs()).values.size());
      CHECK(entries >= whole.stiffness.entries_in(all).size() + all.size());  // some are 0
    }
  }
  CHECK(compared > 8000);
}

TEST_CASE("a rank without rows has none, and a number that is not finite is refused") {
  const plate p = plate_of({0, 1, 2}, {0, 1});
  CHECK(stiffness_rows(p, 18, 0).count() == 0);
  CHECK_THROWS_AS(stiffness_rows(plate_of({0, 1e-200, 2}, {0, 1}), 0, 18), std::invalid_argument);
}
