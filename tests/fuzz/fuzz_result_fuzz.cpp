// The reader of the results of shards, which `contct fuzz --merge` adds up: files with lines ===== between
// them. And the reader of checkpoints.
#include "contct/lab/fuzz.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <memory>

#include "fuzz/fuzz.hpp"
#include "fuzz/read_back.hpp"

namespace {

using namespace contct::fuzz;

/// A file in memory with this text.
class file_in_memory {
 public:
  explicit file_in_memory(std::string_view text) : file_(memfd_create("shard", 0)) {
    require(write(file_, text.data(), text.size()) == std::ssize(text), "memory is written");
  }
  ~file_in_memory() { close(file_); }
  file_in_memory(const file_in_memory&) = delete;
  file_in_memory& operator=(const file_in_memory&) = delete;

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

/// A checkpoint of the run of seeds/fuzz_result/checkpoint.json.
void check_checkpoint(const std::string& path) {
  contct::lab::fuzz_request run;
  run.kernels = {"fortran", "cpp"};
  run.calls = 20000;
  run.problems = 40;
  run.seed = 7;
  contct::lab::fuzz_checkpoint reached;
  if (!is_read([&] { reached = contct::lab::checkpoint_from(path, run); })) return;
  const std::string written = contct::lab::checkpoint_json(reached);
  const file_in_memory again(written);
  require(contct::lab::checkpoint_json(contct::lab::checkpoint_from(again.path(), run)) == written,
          "a checkpoint that is written is read as it was");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t most_shards = 3;
  std::vector<std::unique_ptr<file_in_memory>> files;
  std::vector<std::string> paths;
  for (const std::string_view text : parts_of(text_of(data, size), most_shards))
    paths.push_back(files.emplace_back(std::make_unique<file_in_memory>(text))->path());
  check_checkpoint(paths.front());
  contct::lab::fuzz_result merged;
  if (!is_read([&] { merged = contct::lab::merged_fuzz(paths); })) return 0;
  require(merged.merged_shards.size() == paths.size(), "all shards are in it");
  (void)json_in(contct::lab::fuzz_json(merged), "a merged result");
  (void)merged.compared();
  return 0;
}
