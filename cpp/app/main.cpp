#include "app/program.hpp"

int main(int argc, char** argv) {
  return contct::run_contct(argc, argv);
}
