#include "contct/lab/verification_table.hpp"

#include <fmt/format.h>

#include "contct/kernel/call.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/text/input_text.hpp"

namespace contct::lab {
namespace {

constexpr real_range not_negative{0.0, true, "a finite number, at least 0"};
constexpr int any_number = 1'000'000'000;

expected_number read_check(const table_reader& t) {
  t.allow_only({"step", "quantity", "node", "pair", "element", "end", "corner", "dof", "change", "from",
                "along", "value", "kind", "tolerance", "because", "source", "faithful", "reason"});
  expected_number e;
  e.step = t.integer("step", 1, any_number);
  e.quantity = t.text("quantity");
  if (t.has("node")) e.node = t.integer("node", 1, any_number);
  if (t.has("pair")) e.pair = t.integer("pair", 1, any_number);
  if (t.has("element")) e.element = t.integer("element", 1, any_number);
  if (t.has("end")) e.place = static_cast<int>(t.choice("end", {"left", "right"})) + 1;
  if (t.has("corner")) e.place = t.integer("corner", 1, 4);
  if (t.has("dof")) e.dof = t.text("dof");
  if (t.has("change")) e.change = t.choice("change", {"make", "break"}) == 0 ? "make" : "break";
  if (t.has("from")) e.from = t.real("from", any_real);
  if (t.has("along")) e.along = t.choice("along", {"edge", "diagonal"}) == 0 ? "edge" : "diagonal";
  if (e.quantity == "state") {
    e.value = t.choice("value", {"contact", "separated"}) == 0 ? in_contact : separated;
  } else {
    e.value = t.real("value", any_real);
    e.tolerance = t.real("tolerance", not_negative);
    e.because = t.text("because");
  }
  constexpr const char* kinds[] = {"published", "closed form", "recomputed"};
  e.kind = kinds[t.choice("kind", {"published", "closed form", "recomputed"})];
  e.source = t.text("source");
  if (t.has("faithful")) {
    e.faithful = t.real("faithful", any_real);
    e.reason = t.text("reason");
  }
  return e;
}

}  // namespace

std::vector<verification_case> read_verification(const std::string& path) {
  const toml::table document = parse_toml(read_input(path), path);
  const table_reader top(document, "", path);
  top.allow_only({"case"});
  std::vector<verification_case> cases;
  for (const table_reader& t : top.tables("case")) {
    t.allow_only({"file", "check"});
    verification_case c{t.text("file"), {}};
    for (const table_reader& check : t.tables("check")) c.checks.push_back(read_check(check));
    cases.push_back(std::move(c));
  }
  return cases;
}

std::string quantity_words(const expected_number& e) {
  if (e.quantity == "event") return fmt::format("pair {} {}s", e.pair, e.change);
  if (e.quantity == "events") return "toggles";
  if (e.quantity == "contacts") return "pairs in contact";
  if (e.quantity == "zero") return e.along.empty() ? "w = 0 at x" : fmt::format("w = 0 along {}", e.along);
  if (e.quantity == "reaction") return fmt::format("reaction {}, node {}", e.dof, e.node);
  if (e.pair > 0) return fmt::format("{}, pair {}", e.quantity, e.pair);
  if (e.element > 0) return fmt::format("{}, element {}.{}", e.quantity, e.element, e.place);
  return fmt::format("{}, node {}", e.quantity, e.node);
}

}  // namespace contct::lab
