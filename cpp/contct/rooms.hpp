// A namespace a room: each sees the rooms below it, and none above. Whoever uses the library names the rooms.
#pragma once

namespace contct::numeric {}
namespace contct::text {}
namespace contct::kernels {}
namespace contct::trace {}
namespace contct::outside {}
namespace contct::matrix {}
namespace contct::structure {}
namespace contct::solve {}
namespace contct::path {}
namespace contct::compare {}
namespace contct::certify {}
namespace contct::read {}
namespace contct::write {}
namespace contct::lab {}
namespace contct::app {}

namespace contct::kernels {
using namespace text;
using namespace numeric;
}  // namespace contct::kernels
namespace contct::trace {
using namespace text;
using namespace numeric;
using namespace kernels;
}  // namespace contct::trace
namespace contct::outside {
using namespace text;
using namespace numeric;
using namespace kernels;
using namespace trace;
}  // namespace contct::outside
namespace contct::matrix {
using namespace text;
using namespace numeric;
}  // namespace contct::matrix
namespace contct::structure {
using namespace kernels;
using namespace text;
using namespace numeric;
using namespace matrix;
}  // namespace contct::structure
namespace contct::solve {
using namespace text;
using namespace numeric;
using namespace matrix;
using namespace structure;
}  // namespace contct::solve
namespace contct::path {
using namespace text;
using namespace numeric;
using namespace kernels;
using namespace trace;
using namespace outside;
using namespace matrix;
using namespace structure;
using namespace solve;
}  // namespace contct::path
namespace contct::compare {
using namespace text;
using namespace numeric;
using namespace kernels;
using namespace trace;
using namespace outside;
using namespace matrix;
using namespace structure;
using namespace solve;
using namespace path;
}  // namespace contct::compare
namespace contct::certify {
using namespace text;
using namespace numeric;
using namespace kernels;
using namespace trace;
using namespace outside;
using namespace matrix;
using namespace structure;
using namespace solve;
using namespace path;
}  // namespace contct::certify
namespace contct::read {
using namespace text;
using namespace numeric;
using namespace kernels;
using namespace matrix;
using namespace structure;
}  // namespace contct::read
namespace contct::write {
using namespace text;
using namespace numeric;
using namespace kernels;
using namespace trace;
using namespace outside;
using namespace matrix;
using namespace structure;
using namespace solve;
using namespace path;
using namespace compare;
using namespace certify;
}  // namespace contct::write
namespace contct::lab {
using namespace text;
using namespace numeric;
using namespace kernels;
using namespace trace;
using namespace outside;
using namespace matrix;
using namespace structure;
using namespace solve;
using namespace path;
using namespace compare;
using namespace certify;
using namespace write;
using namespace read;
}  // namespace contct::lab
namespace contct::app {
using namespace text;
using namespace numeric;
using namespace kernels;
using namespace trace;
using namespace outside;
using namespace matrix;
using namespace structure;
using namespace solve;
using namespace path;
using namespace compare;
using namespace certify;
using namespace write;
using namespace read;
using namespace lab;
}  // namespace contct::app
