// Writes the golden set to a folder. usage: contct_golden reference/traces
#include <cstdio>
#include <exception>

#include "contct/text/output_file.hpp"
#include "golden/cases.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    (void)std::fputs("usage: contct_golden FOLDER\n", stderr);
    return 2;
  }
  try {
    for (const golden::golden_trace& t : golden::all_traces()) {
      contct::output_file out(std::string(argv[1]) + "/" + t.name + ".trace");
      out.write(golden::recorded(t));
      out.finish();
    }
  } catch (const std::exception& e) {
    (void)std::fprintf(stderr, "contct_golden: %s\n", e.what());
    return 2;
  }
  return 0;
}
