#include "contct/text/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "contct/text/strings.hpp"
#include "contct/text/terminal.hpp"

namespace contct {
namespace {

int why_lost = 0;  // errno of the first print that failed

namespace fs = std::filesystem;

/// Returns the path of the file that is written if `path` is opened. Follows symbolic links, also to a target
/// that does not exist.
fs::path followed(fs::path path) {
  std::error_code ignored;
  if (fs::exists(path, ignored)) return fs::canonical(path);
  constexpr int most_links = 40;
  for (int i = 0; i < most_links && fs::is_symlink(fs::symlink_status(path, ignored)); ++i)
    path = path.parent_path() / fs::read_symlink(path);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code wrong;
  const fs::path resolved = fs::weakly_canonical(folder, wrong);
  return (wrong ? folder : resolved) / path.filename();
}

/// Opens a new file in the folder of `target`, because a rename must stay in one file system. Writes the
/// temporary name to `name`. Returns the descriptor, or -1.
int open_beside(const std::string& target, std::string& name) {
  name = (fs::path(target).parent_path() / ".contct-partial-XXXXXX").string();
  return mkostemp(name.data(), O_CLOEXEC);
}

/// Waits until the written data are on the disk. Returns 0, or errno; also 0 if the file system does not
/// support fsync.
int sync_to_disk(int descriptor) {
  int error = 0;
  do {
    error = fsync(descriptor) == 0 ? 0 : errno;
  } while (error == EINTR);
  return error == EINVAL || error == ENOSYS || error == EROFS ? 0 : error;
}

/// Copies one file to another, and gives the copy the permissions of a new file. Returns 0, or errno.
int copy_all(int from, int to) {
  const mode_t removed = umask(0);
  umask(removed);
  fchmod(to, 0666 & ~removed);
  char block[1 << 16];
  off_t at = 0;
  ssize_t got = 0;
  while ((got = pread(from, block, sizeof block, at)) > 0) {
    for (ssize_t written = 0; written < got;) {
      const ssize_t some = ::write(to, block + written, got - written);
      if (some < 0) return errno;
      written += some;
    }
    at += got;
  }
  return got < 0 ? errno : 0;
}

/// Throws output_error for the file at `path`, or reader_gone for standard output, "-", without a reader.
[[noreturn]] void fail(const std::string& path, int error) {
  const bool standard = path == "-";
  const std::string words = (standard ? "standard output" : path) + ": cannot be written: " +
                            (error != 0 ? std::strerror(error) : "earlier output is lost");
  if (standard && error == EPIPE) throw reader_gone(words);
  throw output_error(words);
}

}  // namespace

/// Opens a file without a name in the target's folder, so that an unwritable folder is refused at once.
output_file::output_file(std::string path) : path_(std::move(path)) {
  if (is_standard_output()) {
    file_ = stdout;
    return;
  }
  std::error_code error;
  const fs::file_type kind = fs::status(path_, error).type();
  if (kind == fs::file_type::none) fail(path_, error.value());
  if (kind == fs::file_type::directory) fail(path_, EISDIR);
  if (kind == fs::file_type::regular || kind == fs::file_type::not_found) {
    target_ = followed(path_).string();
    const signals_wait until_unlinked;
    std::string name;
    const int descriptor = open_beside(target_, name);
    if (descriptor < 0) fail(path_, errno);
    unlink(name.c_str());
    file_ = fdopen(descriptor, "w+b");
  } else {
    file_ = std::fopen(path_.c_str(), "wb");
  }
  if (file_ == nullptr) fail(path_, errno);
}

output_file::~output_file() {
  if (file_ != nullptr && file_ != stdout) (void)std::fclose(file_);
}

void output_file::write(std::string_view text) {
  if (kept_ != nullptr) {
    kept_->append(text);
  } else if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) {
    fail(path_, errno);
  }
}

void output_file::finish() {
  if (kept_ != nullptr) return;
  if (is_standard_output()) return flush_standard_output();
  if (std::fflush(file_) != 0) fail(path_, errno);
  if (!target_.empty()) give_name();
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail(path_, errno);
}

/// Copies the file to a temporary name, then renames the copy to the target. Before the copy replaces another
/// file, it is written to the disk; otherwise a power failure could lose both files.
void output_file::give_name() const {
  const signals_wait until_named;
  std::error_code ignored;
  const bool replaces = fs::exists(target_, ignored);  // before the copy exists, since this may throw
  std::string name;
  const int copy = open_beside(target_, name);
  if (copy < 0) fail(path_, errno);
  int error = copy_all(fileno(file_), copy);
  if (error == 0 && replaces) error = sync_to_disk(copy);
  if (close(copy) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(name.c_str(), target_.c_str()) != 0) error = errno;
  if (error == 0) return;
  unlink(name.c_str());
  fail(path_, error);
}

void print_text(std::string_view raw) {
  const std::string text = isatty(STDOUT_FILENO) != 0 ? shown_in_colour(raw) : terminal_text(raw);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() && why_lost == 0) why_lost = errno;
}

void flush_standard_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  fail("-", errno != 0 ? errno : why_lost);
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  const fs::file_type kind = fs::status(a, error).type();
  if (kind == fs::file_type::regular) return fs::equivalent(a, b, error);
  if (kind != fs::file_type::not_found || fs::exists(b, error)) return false;
  const auto is_link = [&error](const fs::path& p) { return fs::is_symlink(fs::symlink_status(p, error)); };
  // Returns early, because the checks below are slow: a run with --vtu compares thousands of names.
  if (fs::path(a).filename() != fs::path(b).filename() && !is_link(a) && !is_link(b)) return false;
  return followed(a) == followed(b);
}

}  // namespace contct
