// Long beams: nothing quadratic, and little memory beyond the band and its factor.
#include <nlohmann/json.hpp>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

/// A beam of 100,000 nodes on many spans, every node written out, with stops between some supports.
std::string hundred_thousand_nodes() {
  std::string text = "[beam]\nEI = 1.0\nx = [";
  for (int i = 0; i < 100000; ++i) text += std::to_string(i) + ".0, ";
  text += "]\n[[support]]\nfix = [\"w\"]\nnodes = [";
  for (int i = 1; i <= 100000; i += 9) text += std::to_string(i) + ", ";
  text += "]\n";
  for (int i = 5; i < 100000; i += 9000) {
    text +=
        "[[contact]]\nnode = " + std::to_string(i) + "\nsurface = \"below\"\nface = -0.01\nstiffness = 1.0\n";
  }
  return text + "[[step]]\nuniform = -0.001\n[[step]]\nuniform = 0\n";
}

}  // namespace

TEST_CASE("a beam of 100,000 nodes is read, solved and written in under 200 MB") {
  const scratch_folder dir;
  dir.write("long.toml", hundred_thousand_nodes());
  const finished f = contct_program(dir.path(), {"run", "long.toml", "--json", "long.json"});
  INFO(f.out << f.err);
  CHECK(f.exit == 0);
#if !defined(__SANITIZE_ADDRESS__)
  CHECK(f.peak_kib < 200'000);
#endif
  const std::string text = dir.read("long.json");
  const auto result = nlohmann::json::parse(text);
  REQUIRE(result["steps"].size() == 2);
  CHECK(result["steps"][0]["w"].size() == 100000);
  CHECK(result["steps"][0]["elements"].size() == 99999);
  int closed = 0;
  for (const auto& pair : result["steps"][0]["pairs"]) closed += pair["state"] == "contact" ? 1 : 0;
  CHECK(closed == 12);
  // Unloaded, everything is back where it was.
  for (const auto& pair : result["steps"][1]["pairs"]) CHECK(pair["state"] == "separated");
}

TEST_CASE("two hundred thousand beds of one node each are as quick as one bed of them all") {
  // Something done for every node, for every bed, would take minutes.
  const scratch_folder dir;
  std::string text = "[beam]\nlength = 200000\nelements = 200000\nEI = 1\n";
  for (int node = 1; node <= 200001; ++node)
    text += "[[bed]]\nmodulus = 1\nface = 0\nnodes = [" + std::to_string(node) + "]\n";
  dir.write("beds.toml", text + "[[step]]\nuniform = -1\n");
  const finished f = contct_program(dir.path(), {"run", "beds.toml", "--kernels", "cpp"});
  INFO(f.err);
  CHECK(f.exit == 0);
  CHECK_THAT(f.out, Contains("200001 of 200001 in contact"));
}

TEST_CASE("a single span of 5,000 elements has lost its digits, and says so") {
  const scratch_folder dir;
  dir.write("span.toml",
            "[beam]\nlength = 1\nelements = 5000\nEI = 1\n[[support]]\nnodes = [1, 5001]\nfix = [\"w\"]\n"
            "[[step]]\nuniform = -1\n");
  const finished f = contct_program(dir.path(), {"run", "span.toml", "--json", "out.json"});
  CHECK(f.exit == 0);
  CHECK_THAT(f.err, Contains("about 1 digit of the answer can be relied on"));
  CHECK(nlohmann::json::parse(dir.read("out.json"))["steps"][0]["digits"].get<int>() <= 2);
}
