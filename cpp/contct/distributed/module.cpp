#include "contct/distributed/module.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "contct/text/input_text.hpp"
#include "contct/text/strings.hpp"

namespace contct::distributed {
namespace {

namespace fs = std::filesystem;

constexpr const char* how_to_get_it =
    "It is built with the program where PETSc with MUMPS and MPI are found; on Debian: apt-get install "
    "libpetsc-real-dev, then configure and build again";

template <class Function>
Function* symbol_of(void* module, const char* name, const std::string& file) {
  void* const found = dlsym(module, name);
  if (found == nullptr)
    throw std::runtime_error("engine petsc: " + file + ": found no " + name + "; it is another library");
  return reinterpret_cast<Function*>(found);  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
}

}  // namespace

std::vector<std::string> module_places(const std::string& program, const std::string& installed) {
  std::vector<std::string> places;
  for (const fs::path& folder : {fs::path(program), fs::path(program) / installed})
    places.push_back((folder / module_name).lexically_normal().string());
  return places;
}

ranks& join_ranks(const std::vector<std::string>& places, const std::string& version) {
  std::string file;
  for (const std::string& p : places)
    if (file.empty() && fs::exists(p)) file = p;
  if (file.empty())
    throw std::runtime_error("engine petsc: found no module " + text::joined(places, " or ") + ". " +
                             how_to_get_it);
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    const char* const why = dlerror();  // NOLINT(concurrency-mt-unsafe): no other thread loads anything
    throw std::runtime_error("engine petsc: " + file + " cannot be loaded: " + why + ". " + how_to_get_it);
  }
  const std::string found = symbol_of<module_version>(module, version_symbol, file)();
  if (found != version)
    throw std::runtime_error("engine petsc: " + file + ": found a module of version " + found +
                             "; allowed: that of the program, " + version);
  ranks* const all = symbol_of<module_join>(module, join_symbol, file)();
  set_joined_ranks(all);
  return *all;
}

int rank_by_environment() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"}) {
    const char* const said = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nothing here sets variables
    if (said != nullptr) return text::number_in<int>(said).value_or(0);
  }
  return 0;
}

}  // namespace contct::distributed
