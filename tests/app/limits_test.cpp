// Limits for problems from strangers: time, memory, and which files they may name. Exit status 5 or 2, one
// message, and no part of a file.
#include "app/limits.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"
#include "read/good_problem.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
namespace fs = std::filesystem;

namespace {

using words = std::vector<std::string>;

/// A beam on a bed of so many elements: minutes of work, and hundreds of MiB where they are many.
std::string endless(int elements, int steps = 200) {
  std::string text = "[beam]\nlength = 100.0\nelements = " + std::to_string(elements) +
                     "\nEI = 1.0e4\n[[bed]]\nmodulus = 1.0e3\nface = 0.0\n";
  for (int step = 0; step < steps; ++step)
    text += "[[step]]\npoint = [ { node = " + std::to_string(elements / 2) +
            ", w = " + std::to_string(step % 2 * -90 - 5) + ".0 } ]\n";
  return text;
}

const words every_output = {"--json",  "o.json", "--html",     "o.html",  "--csv",   "o.csv",   "--vtu",
                            "o.vtu",   "--log",  "o.log",      "--trace", "o.trace", "--proof", "o.proof",
                            "--junit", "o.xml",  "--markdown", "o.md",    "--quiet"};

words with_outputs(words arguments) {
  arguments.insert(arguments.end(), every_output.begin(), every_output.end());
  return arguments;
}

/// Exit status 5, and one line.
void check_stopped(const finished& f, const std::string& message) {
  INFO(f.out << f.err);
  CHECK(f.exit == 5);
  CHECK(f.err == message);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool memory_can_be_limited = false;  // the sanitizers reserve terabytes
#else
constexpr bool memory_can_be_limited = true;
#endif

}  // namespace

TEST_CASE(
    "the limit of --max-seconds ends every command that reads a problem: exit 5, one message, no file") {
  const scratch_folder dir;
  dir.write("long.toml", endless(400));
  int ended = 0;
  for (const words& w :
       {with_outputs({"run", "long.toml"}), words{"run", "long.toml", "--final-only", "--json", "o.json"},
        words{"explain", "long.toml", "--quiet", "--json", "o.json"},
        words{"exact", "long.toml", "--quiet", "--json", "o.json"}}) {
    words limited = w;
    limited.insert(limited.end(), {"--max-seconds", "0.2"});
    const auto begun = std::chrono::steady_clock::now();
    check_stopped(contct_program(dir.path(), limited),
                  "contct: --max-seconds 0.2: the time is over; the command is stopped\n");
    CHECK(std::chrono::steady_clock::now() - begun < std::chrono::seconds(60));
    CHECK(dir.files() == words{"long.toml"});
    ++ended;
  }
  CHECK(ended == 4);
}

TEST_CASE("a limit of time that is not reached changes nothing, and one that is none is refused") {
  const scratch_folder dir;
  dir.write("p.toml", good_problem);
  const words run = {"run", "p.toml", "--json", "-"};
  words limited = run;
  limited.insert(limited.end(), {"--max-seconds", "1000", "--max-memory", "4096"});
  const finished free = contct_program(dir.path(), run);
  if (memory_can_be_limited) CHECK(contct_program(dir.path(), limited).out == free.out);
  CHECK(free.exit == 0);
  for (const words& bad : {words{"--max-seconds", "0"},
                           {"--max-seconds", "-1"},
                           {"--max-seconds", "soon"},
                           {"--max-memory", "0"},
                           {"--max-memory", "1.5"},
                           {"--max-memory", "-3"}}) {
    words w = run;
    w.insert(w.end(), bad.begin(), bad.end());
    const finished f = contct_program(dir.path(), w);
    INFO(bad[1]);
    CHECK(f.exit == 2);
    CHECK_THAT(f.err, Contains(bad[0]));
  }
}

TEST_CASE("a limit of time keeps what stood under an output's name before") {
  const scratch_folder dir;
  dir.write("long.toml", endless(400));
  dir.write("o.json", "before");
  CHECK(
      contct_program(dir.path(), {"run", "long.toml", "--quiet", "--json", "o.json", "--max-seconds", "0.1"})
          .exit == 5);
  CHECK(dir.read("o.json") == "before");
  CHECK(dir.files() == words{"long.toml", "o.json"});
}

TEST_CASE("the limit of --max-memory ends every command that reads a problem: exit 5, one message, no file") {
  if (!memory_can_be_limited) return;
  const scratch_folder dir;
  dir.write("exact.toml", endless(20'000, 1));
  dir.write("large.toml", endless(200'000, 1));
  int ended = 0;
  for (const words& w :
       {with_outputs({"run", "large.toml"}), words{"run", "large.toml", "--final-only", "--json", "o.json"},
        words{"check", "large.toml", "--quiet"},
        words{"explain", "large.toml", "--quiet", "--json", "o.json"},
        words{"exact", "exact.toml", "--quiet", "--json", "o.json"},
        words{"export", "large.toml", "--calculix", "o.inp"}}) {
    words limited = w;
    limited.insert(limited.end(), {"--max-memory", "24"});
    check_stopped(contct_program(dir.path(), limited),
                  "contct: --max-memory 24: more memory is needed; the command is stopped\n");
    CHECK(dir.files() == words{"exact.toml", "large.toml"});
    ++ended;
  }
  CHECK(ended == 6);
}

TEST_CASE("at every limit of memory a run is whole, or ends with exit 5 and one message") {
  if (!memory_can_be_limited) return;
  const scratch_folder dir;
  dir.write("p.toml", endless(200, 1));
  int ended = 0;
  int solved = 0;
  for (int mib = 1; mib <= 100; mib += mib < 12 ? 1 : 11) {
    const finished f =
        contct_program(dir.path(), with_outputs({"run", "p.toml", "--max-memory", std::to_string(mib)}));
    INFO(mib << " MiB: " << f.exit << "\n" << f.err);
    CHECK((f.exit == 0 || f.exit == 5));
    CHECK(std::ranges::count(f.err, '\n') == (f.exit == 0 ? 0 : 1));
    ++(f.exit == 0 ? solved : ended);
    for (const auto& name : dir.files()) CHECK(name.rfind(".contct", 0) != 0);
  }
  CHECK(solved >= 1);
  CHECK(ended >= 1);
}

TEST_CASE("a problem names files below its folder, and others under --allow-outside, in every command") {
  const scratch_folder dir;
  fs::create_directory(dir.path() / "own");
  dir.write("K.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 1 -1\n2 2 2\n");
  dir.write("f.mtx", "%%MatrixMarket matrix array real general\n2 1\n0\n1\n");
  const std::string rest =
      "[[contact]]\ndof = \"2\"\nsurface = \"above\"\nface = 0.5\nstiffness = 10\n[[step]]\n";
  dir.write("own/K.toml",
            "[matrix]\nstiffness = \"../K.mtx\"\n" + rest + "point = [ { dof = \"2\", value = 1 } ]\n");
  fs::copy(dir.path() / "K.mtx", dir.path() / "own/K.mtx");
  dir.write("own/f.toml", "[matrix]\nstiffness = \"K.mtx\"\n" + rest + "load = \"../f.mtx\"\n");
  int allowed = 0;
  for (const char* file : {"own/K.toml", "own/f.toml"}) {
    for (const words& w :
         {words{"run", file}, words{"check", file}, words{"explain", file}, words{"exact", file}}) {
      const finished refused = contct_program(dir.path(), w);
      INFO(w[0] << " " << file << "\n" << refused.err);
      CHECK(refused.exit == 2);
      CHECK_THAT(refused.err,
                 StartsWith("contct: " + std::string(file) + ":") && Contains("--allow-outside"));
      words with_permission = w;
      with_permission.emplace_back("--allow-outside");
      CHECK(contct_program(dir.path(), with_permission).exit == 0);
      ++allowed;
    }
  }
  CHECK(allowed == 8);
}

TEST_CASE("no message quotes a file that is none of the problem's") {
  const scratch_folder dir;
  const std::string secret = "secretroot:x:0:0:root:/root:/bin/sh";
  dir.write("passwd", secret + "\n" + secret + "2 secretfield\n");
  dir.write("K.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 1 -1\n2 2 2\n");
  dir.write("K.dof", "a.x\nb.x\n");
  dir.write("job.dof", "a.x\nb.x\n");
  dir.write("job.sti", secret + "\n");
  const std::string matrix = "[matrix]\nstiffness = \"K.mtx\"\n";
  const std::string rest =
      "[[contact]]\ndof = \"b.x\"\nsurface = \"above\"\nface = 0.5\nstiffness = 10\n[[step]]\n";
  const std::string point = rest + "point = [ { dof = \"b.x\", value = 1 } ]\n";
  int refused = 0;
  for (const std::string& text :
       {"[matrix]\nstiffness = \"passwd\"\n" + point, matrix + "dofs = \"passwd\"\n" + point,
        matrix + "dofs = \"K.dof\"\ncoordinates = \"passwd\"\n" + point,
        matrix + "dofs = \"K.dof\"\n" + rest + "load = \"passwd\"\n",
        "[calculix]\njob = \"job\"\n" + point}) {
    dir.write("p.toml", text);
    const finished f = contct_program(dir.path(), {"run", "p.toml"});
    INFO(text << f.err);
    CHECK(f.exit == 2);
    CHECK_THAT(f.err, !Contains("secret"));
    ++refused;
  }
  CHECK(refused == 5);
}
