// Loads the module through which the program joins an MPI job: contct_petsc.so, made where PETSc and MPI are
// found.
#pragma once

#include <string>
#include <vector>

#include "contct/distributed/ranks.hpp"

namespace contct::distributed {

/// The file name of the module.
inline constexpr const char* module_name = "contct_petsc.so";

/// What a module exports, with C linkage: the version of the sources that it was made from, which must be
/// the program's, since the two share C++ classes; and what joins MPI, once a process.
using module_version = const char*();
using module_join = ranks*();
inline constexpr const char* version_symbol = "contct_petsc_version";
inline constexpr const char* join_symbol = "contct_petsc_join";

/// The places of the module beside a program in the folder `program`: there, and where `installed`, relative
/// to it, leads.
[[nodiscard]] std::vector<std::string> module_places(const std::string& program,
                                                     const std::string& installed);

/// Join the job that this process belongs to, or one of a single rank where it belongs to none, through the
/// first of `places` that exists. Throws std::runtime_error, saying what is missing and how to get it, where
/// there is none, where what it needs cannot be loaded, and where it was made for another version.
ranks& join_ranks(const std::vector<std::string>& places, const std::string& version);

/// The number that mpirun, or a scheduler, gave this process, known before MPI is joined: 0 where there is
/// none. Only for who speaks when joining fails.
[[nodiscard]] int rank_by_environment();

}  // namespace contct::distributed
