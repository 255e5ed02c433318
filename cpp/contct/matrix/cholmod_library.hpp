// CHOLMOD's working space and its view of our matrices. Only for sources that are built where the library is.
#pragma once

#include <cholmod.h>

#include <new>

#include "contct/matrix/sparse_columns.hpp"

namespace contct {

/// The library's working space; it says nothing by itself.
class cholmod_library {
 public:
  cholmod_library() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.quick_return_if_not_posdef = 1;
  }
  ~cholmod_library() { cholmod_finish(&common_); }
  cholmod_library(const cholmod_library&) = delete;
  cholmod_library& operator=(const cholmod_library&) = delete;
  cholmod_library(cholmod_library&&) = delete;
  cholmod_library& operator=(cholmod_library&&) = delete;

  operator cholmod_common*() { return &common_; }
  cholmod_common* operator->() { return &common_; }
  /// Of the last order that was found.
  [[nodiscard]] double flops() const { return common_.fl; }

 private:
  cholmod_common common_{};
};

/// `a` as the library sees it; nothing is copied. It must not be freed.
[[nodiscard]] inline cholmod_sparse seen_by_cholmod(sparse_columns& a) {
  cholmod_sparse k{};
  k.nrow = k.ncol = static_cast<std::size_t>(a.order());
  k.nzmax = a.values.size();
  k.p = a.starts.data();
  k.i = a.rows.data();
  k.x = a.values.data();
  k.stype = -1;  // the lower triangle
  k.itype = CHOLMOD_INT;
  k.xtype = CHOLMOD_REAL;
  k.dtype = CHOLMOD_DOUBLE;
  k.sorted = 1;
  k.packed = 1;
  return k;
}

/// What the library has made; std::bad_alloc where it has not.
template <class T>
[[nodiscard]] T* made_by_cholmod(T* made) {
  if (made == nullptr) throw std::bad_alloc();
  return made;
}

}  // namespace contct
