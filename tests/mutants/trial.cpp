#include "mutants/trial.hpp"

#include <atomic>
#include <cstdio>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

#include "listing/child.hpp"
#include "mutants/build.hpp"

namespace contct_test {
namespace {

/// A file that nobody mutated.
bool is_original(const mutant& m) {
  return m.find.empty();
}

/// The files of `mutants`, each as it is: whatever kills these kills for the wrong reason.
std::vector<trial> originals_of(const std::vector<mutant>& mutants) {
  std::set<std::string> files;
  for (const mutant& m : mutants) files.insert(m.file);
  std::vector<trial> all;
  all.reserve(files.size());
  for (const std::string& file : files)
    all.push_back({{"(" + file + ")", file, "", "", "", "nothing is changed"}, {}, "", ""});
  return all;
}

void try_one(trial& t, const bounded_fuzz& fuzz) {
  try {
    const std::string source = is_original(t.which)
                                   ? file_text(std::filesystem::path(CONTCT_ROOT) / t.which.file)
                                   : mutated_source(t.which);
    t.seen = judged(t.which, source, fuzz);
    t.objection = objection(t.which, t.seen);
  } catch (const std::exception& e) {
    t.error = e.what();
  }
}

void say(const trial& t) {
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  (void)std::printf("%s: %s\n", t.which.id.c_str(), in_words(t).c_str());
  (void)std::fflush(stdout);
}

}  // namespace

std::string objection(const mutant& m, const verdict& seen) {
  if (seen.lives() && m.equivalent.empty())
    return "survives: neither the golden set nor the random calls notice it";
  if (!seen.lives() && is_original(m))
    return "is as committed, but does not answer " + seen.kills.front().where + ", " +
           seen.kills.front().what;
  if (!seen.lives() && !m.equivalent.empty())
    return "is said to be equivalent, but " + seen.kills.front().where + ", " + seen.kills.front().what +
           " tells it from the original";
  return "";
}

std::string in_words(const trial& t) {
  if (!t.error.empty()) return "error: " + t.error;
  if (!t.objection.empty()) return t.objection;
  if (t.seen.lives()) return is_original(t.which) ? "lives, as it must" : "lives, as proved";
  return "killed by " + t.seen.kills.front().where + ", " + t.seen.kills.front().what;
}

std::vector<trial> try_all(const std::vector<mutant>& mutants, const bounded_fuzz& fuzz, unsigned jobs) {
  std::vector<trial> trials = originals_of(mutants);
  for (const mutant& m : mutants) trials.push_back({m, {}, "", ""});
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < trials.size(); i = next++) {
      try_one(trials[i], fuzz);
      say(trials[i]);
    }
  };
  {
    std::vector<std::jthread> workers;
    for (unsigned j = 0; j < jobs; ++j) workers.emplace_back(work);
  }
  return trials;
}

}  // namespace contct_test
