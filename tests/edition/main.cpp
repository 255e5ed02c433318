// contct_edition: makes the pages of the parallel edition from its map and the sources, or says what is
// wrong.
#include <cstdio>
#include <exception>
#include <string>

#include "contct/text/output_file.hpp"
#include "edition/edition.hpp"

namespace {

using namespace contct_test;

struct request {
  std::string map = CONTCT_EDITION_MAP;
  std::string page, html;
};

/// False where an argument is none of ours.
bool read_arguments(int argc, char** argv, request& r) {
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    if (name == "--map") {
      r.map = argv[i + 1];
    } else if (name == "--page") {
      r.page = argv[i + 1];
    } else if (name == "--html") {
      r.html = argv[i + 1];
    } else {
      return false;
    }
  }
  return argc % 2 == 1;
}

void write(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  contct::app::output_file out(path);
  out.write(text);
  out.finish();
}

int make_pages(const request& r) {
  const edition e = read_edition(r.map);
  const sources s(CONTCT_ROOT);
  const std::vector<std::string> faults = faults_of(e, s);
  for (const std::string& fault : faults) (void)std::fprintf(stderr, "contct_edition: %s\n", fault.c_str());
  if (!faults.empty()) return 1;
  write(r.page, markdown_page(e, s));
  write(r.html, html_page(e, s));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    request r;
    if (read_arguments(argc, argv, r)) return make_pages(r);
    (void)std::fputs("usage: contct_edition [--map FILE] [--page FILE] [--html FILE]\n", stderr);
  } catch (const std::exception& e) {
    (void)std::fprintf(stderr, "contct_edition: %s\n", e.what());
  }
  return 2;
}
