// Labels of dofs: what is read, what is refused where, and how they are found.
#include "contct/read/dof_labels.hpp"

#include "catch.hpp"
#include "read/refusals.hpp"

using namespace contct::app;

namespace {

std::string of_labels(const std::string& text) {
  return verdict([&] { (void)parse_labels(text, "K.dof"); });
}

}  // namespace

TEST_CASE("labels are read, one a line, without blank lines and the blanks around them") {
  CHECK(parse_labels("5.1\n5.2 \r\n\n185.3\n", "job.dof") == std::vector<std::string>{"5.1", "5.2", "185.3"});
}

TEST_CASE("every mistake in a list of labels is refused with its line, what was found and what is allowed") {
  check_refusals(
      {
          {"", "K.dof", "no label", "one label a line"},
          {"\n \n", "K.dof", "no label", "one label a line"},
          {"5.1\n5.2\n5.1\n", "K.dof:3", "label \"5.1\" again, which line 1 has", "each label once"},
          {"5.1\n5 2\n", "K.dof:2", "\"5 2\"", "one label a line"},
          {std::string(101, 'n') + "\n", "K.dof:1", "\"nnn", "at most 100 bytes"},
      },
      of_labels);
}

TEST_CASE("labels are found by their text, or by their number where there are none") {
  assembled a;
  a.stiffness.order = 12;
  const dof_index by_number(a);
  CHECK(by_number.find("12") == 11);
  for (const char* no : {"0", "13", "-1", "1.0", "01", "+1", " 1", "", "99999999999999", "x"}) {
    INFO(no);
    CHECK_FALSE(by_number.find(no).has_value());
  }
  a.labels = {"5.1", "5.10"};
  const dof_index by_label(a);
  CHECK(by_label.find("5.10") == 1);
  CHECK_FALSE(by_label.find("1").has_value());
  CHECK_THAT(by_label.allowed(), Catch::Matchers::Contains("\"5.1\""));
}
