#include "contct/text/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>

#include "contct/text/strings.hpp"
#include "contct/text/terminal.hpp"

namespace contct::text {
namespace {

int why_lost = 0;  // errno, when something first could not be printed

namespace fs = std::filesystem;

/// The file that writing to `path` makes: symbolic links are followed, also to a target that does not exist.
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

/// How temporary names begin: in the folder of `target`, since a link cannot leave its file system.
std::string temporary_prefix(const std::string& target) {
  return (fs::path(target).parent_path() / ".contct-partial").string();
}

/// Waits until what was written is on the disk; 0, or what went wrong. Some file systems have nothing to wait
/// for.
int sync_to_disk(int descriptor) {
  int error = 0;
  do {
    error = fsync(descriptor) == 0 ? 0 : errno;
  } while (error == EINTR);
  return error == EINVAL || error == ENOSYS || error == EROFS ? 0 : error;
}

/// Copy all of one file to another; 0, or what went wrong.
int copy_all(int from, int to) {
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

}  // namespace

output_file::output_file(std::string path, naming how) : path_(std::move(path)), how_(how) {
  if (is_standard_output()) {
    file_ = stdout;
    return;
  }
  std::error_code error;
  const fs::file_type kind = fs::status(path_, error).type();
  if (kind == fs::file_type::none) fail(error.value());
  if (kind == fs::file_type::directory) fail(EISDIR);
  if (kind == fs::file_type::regular || kind == fs::file_type::not_found) {
    target_ = followed(path_).string();
    open_without_name();
    return;
  }
  file_ = std::fopen(path_.c_str(), "wb");
  if (file_ == nullptr) fail(errno);
}

output_file::~output_file() {
  if (file_ != nullptr && file_ != stdout) (void)std::fclose(file_);
}

/// In the target's own folder, so that a place that cannot be written is refused at once.
void output_file::open_without_name() {
  int descriptor = -1;
#ifdef O_TMPFILE
  const std::string folder = fs::path(target_).parent_path().string();
  if (how_ == naming::link_or_copy) descriptor = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
#endif
  if (descriptor < 0) {
    how_ = naming::copy;
    const signals_wait until_unlinked;
    std::string name = temporary_prefix(target_) + "-XXXXXX";
    descriptor = mkstemp(name.data());
    if (descriptor < 0) fail(errno);
    unlink(name.c_str());
  }
  file_ = fdopen(descriptor, "w+b");
  if (file_ == nullptr) fail(errno);
}

void output_file::write(std::string_view text) {
  if (kept_ != nullptr) {
    kept_->append(text);
    return;
  }
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail(errno);
}

void output_file::flush() {
  if (kept_ != nullptr) return;
  if (is_standard_output()) return flush_standard_output();
  if (std::fflush(file_) != 0) fail(errno);
}

void output_file::finish() {
  flush();
  if (kept_ != nullptr || is_standard_output()) return;
  if (!target_.empty()) give_name();
  std::FILE* const file = std::exchange(file_, nullptr);
  if (std::fclose(file) != 0) fail(errno);
}

/// A file without a name can be linked to a free name only. To replace a file it takes a temporary name
/// first. It is on the disk before it replaces another: otherwise a loss of power could leave neither.
void output_file::give_name() {
  if (link_to(target_)) return;
  if (const int error = sync_to_disk(fileno(file_)); error != 0) fail(error);
  const signals_wait until_named;
  std::string temporary;
  int error = link_beside(temporary) ? 0 : copy_beside(temporary);
  if (error == 0 && std::rename(temporary.c_str(), target_.c_str()) != 0) error = errno;
  if (error == 0) return;
  unlink(temporary.c_str());
  fail(error);
}

bool output_file::link_to(const std::string& name) const {
  const std::string nameless = "/proc/self/fd/" + std::to_string(fileno(file_));
  return how_ == naming::link_or_copy &&
         linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

bool output_file::link_beside(std::string& name) const {
  constexpr int most_tries = 100;
  for (int i = 0; i < most_tries; ++i) {
    name = temporary_prefix(target_) + "-" + std::to_string(getpid()) + "-" + std::to_string(i);
    if (link_to(name)) return true;
    if (errno != EEXIST) break;
  }
  return false;
}

/// Returns 0, or what went wrong.
int output_file::copy_beside(std::string& name) const {
  name = temporary_prefix(target_) + "-XXXXXX";
  const int copy = mkstemp(name.data());
  if (copy < 0) return errno;
  const mode_t removed = umask(0);
  umask(removed);
  fchmod(copy, 0666 & ~removed);  // as any new file
  int error = copy_all(fileno(file_), copy);
  if (error == 0) error = sync_to_disk(copy);
  return close(copy) != 0 && error == 0 ? errno : error;
}

void output_file::fail(int error) const {
  if (is_standard_output() && error == EPIPE)
    throw reader_gone("standard output: cannot be written: nobody reads");
  throw output_error((is_standard_output() ? std::string("standard output") : path_) +
                     ": cannot be written: " + std::strerror(error));
}

void print_text(std::string_view raw) {
  const std::string text = isatty(STDOUT_FILENO) != 0 ? shown_in_colour(raw) : terminal_text(raw);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() && why_lost == 0) why_lost = errno;
}

void flush_standard_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  const int error = errno != 0 ? errno : why_lost;
  const std::string words = std::string("standard output: cannot be written: ") +
                            (error != 0 ? std::strerror(error) : "what was printed before is lost");
  if (error == EPIPE) throw reader_gone(words);
  throw output_error(words);
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  const fs::file_type kind = fs::status(a, error).type();
  if (kind == fs::file_type::regular) return fs::equivalent(a, b, error);
  if (kind != fs::file_type::not_found || fs::exists(b, error)) return false;
  const auto is_link = [&error](const fs::path& p) { return fs::is_symlink(fs::symlink_status(p, error)); };
  // What follows costs more: a run with --vtu asks it of thousands of names.
  if (fs::path(a).filename() != fs::path(b).filename() && !is_link(a) && !is_link(b)) return false;
  return followed(a) == followed(b);
}

}  // namespace contct::text
