// A namespace a room; each names only the rooms directly below it, since using-directives are transitive.
#pragma once

namespace contct::text {}
namespace contct::numeric {
using namespace text;
}
namespace contct::kernels {
using namespace numeric;
}
namespace contct::trace {
using namespace kernels;
}
namespace contct::outside {
using namespace trace;
}
namespace contct::matrix {
using namespace numeric;
}
namespace contct::structure {
using namespace kernels;
using namespace matrix;
}  // namespace contct::structure
namespace contct::solve {
using namespace structure;
}
namespace contct::compare {
using namespace outside;
}
namespace contct::path {
using namespace compare;
using namespace solve;
}  // namespace contct::path
namespace contct::certify {
using namespace path;
}
namespace contct::exact {
using namespace path;
}
namespace contct::read {
using namespace structure;
}
namespace contct::write {
using namespace certify;
using namespace exact;
}  // namespace contct::write
namespace contct::session {
using namespace write;
}
namespace contct::lab {
using namespace session;
using namespace read;
}  // namespace contct::lab
namespace contct::serve {
using namespace lab;
}
namespace contct::app {
using namespace serve;
}
