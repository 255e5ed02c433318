// JSON that is written value by value.
#include "contct/write/json_document.hpp"

#include <limits>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "read/bad_inputs.hpp"
#include "support/scratch_folder.hpp"

using namespace contct::app;

namespace {

/// What `write` makes of a document.
template <class Write>
std::string written(Write write) {
  const scratch_folder folder;
  output_file out(folder.at("x.json"));
  json_document document(out);
  write(document);
  document.finish();
  return folder.read("x.json");
}

}  // namespace

TEST_CASE("members and elements stand on lines of their own, indented by their depth") {
  const std::string text = written([](json_document& d) {
    d.put("title", "a \"b\"\n");
    d.open_array("steps");
    d.open_object();
    d.put("s", 0.25);
    d.open_array("none");
    d.close();
    d.close();
    d.add({1, 2});
    d.close();
    d.put("end", nullptr);
  });
  CHECK(text ==
        "{\n  \"title\": \"a \\\"b\\\"\\n\",\n  \"steps\": [\n    {\n      \"s\": 0.25,\n      \"none\": []\n"
        "    },\n    [1,2]\n  ],\n  \"end\": null\n}\n");
}

TEST_CASE("whatever is open when a document ends is closed, and numbers keep their bits") {
  const double third = 1.0 / 3;
  const auto read = nlohmann::json::parse(written([&](json_document& d) {
    d.open_array("a");
    d.open_object();
    d.put("x", third);
    d.put("nan", std::numeric_limits<double>::quiet_NaN());
  }));
  CHECK(read["a"][0]["x"].get<double>() == third);
  CHECK(read["a"][0]["nan"].is_null());
}

TEST_CASE("a document without a member is an empty object") {
  CHECK(written([](json_document&) {}) == "{}\n");
}

TEST_CASE(
    "a certificate that is not unique has no errors of displacement, and a problem only when there is one") {
  CHECK(certificate_json({}).is_null());
  certificate c;
  c.exact = true;
  c.displacement_error = 1e-12;
  const auto good = certificate_json(c);
  CHECK(good["displacement_error"] == 1e-12);
  CHECK_FALSE(good.contains("problem"));
  c.unique = false;
  c.problem = "tension";
  const auto other = certificate_json(c);
  CHECK(other["displacement_error"].is_null());
  CHECK(other["shape_error"].is_null());
  CHECK(other["problem"] == "tension");
}

TEST_CASE("a load is written with its resultant, its nodes and elements from 1") {
  const problem p = parse_problem(
      with("point = [ {", "uniform = [ { value = -2, elements = [2] } ]\npoint = [ {"), "pb.toml");
  const nlohmann::json load = load_json(p.geometry, load_path(p), 1, 0.5);
  CHECK(load["force"] == -31.0);
  CHECK(load["moment"] == -61.5);
  CHECK(load["uniform"] == nlohmann::json::parse(R"([{"value": -1.0, "elements": "2..2"}])"));
  CHECK(load["point"] == nlohmann::json::parse(R"([{"node": 3, "w": -30.0}])"));
}
