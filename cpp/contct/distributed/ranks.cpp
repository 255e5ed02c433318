#include "contct/distributed/ranks.hpp"

namespace contct::distributed {
namespace {

ranks* joined = nullptr;  // one job a process: MPI has no more

}  // namespace

ranks* joined_ranks() {
  return joined;
}

void set_joined_ranks(ranks* all) {
  joined = all;
}

}  // namespace contct::distributed
