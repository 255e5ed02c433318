// Problems of many kinds, judged and counted; and the ceilings that the counts must stay under.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "referee/judge.hpp"

namespace contct::referee {

struct drawn_problem {
  std::string kind;
  structure::problem problem;
};

/// Problem `number` of `seed`: the even ones are the laboratory's, small ones, named by their layouts; the
/// odd ones are of the hard kinds, in turn.
[[nodiscard]] drawn_problem draw(std::uint64_t seed, std::uint64_t number);

/// What one problem came to, one judgement for each way.
struct judged_problem {
  std::string kind;
  std::array<judgement, ways> judgements;
};
[[nodiscard]] judged_problem judge_all_ways(const drawn_problem& p);
/// The same by judge_end.
[[nodiscard]] judged_problem judge_all_ends(const drawn_problem& p);

/// Counts of problems of one kind, or of one way.
struct kind_counts {
  long problems = 0;
  long mechanisms = 0, steps = 0, certified = 0, values = 0;  ///< over all ways
  std::array<long, faults> wrong{};                           ///< likewise

  void add(const judgement& j);
};

/// The worst of a fault.
struct worst_finding {
  std::uint64_t number;
  way how;
  finding what;
};

struct referee_counts {
  std::map<std::string, kind_counts> by_kind;
  std::array<kind_counts, ways> by_way;
  std::array<std::optional<worst_finding>, faults> worst;

  void add(std::uint64_t number, const judged_problem& p);
};

/// Told every judgement, in order of numbers.
using judgement_sink = std::function<void(std::uint64_t number, const judged_problem& p)>;

/// Judge problems 0 to `count` - 1, or those of one kind among them, on `jobs` threads; the counts do not
/// depend on `jobs`. Of each 2 `exact_every` problems two are judged by their exact paths, the others by
/// their ends.
[[nodiscard]] referee_counts judge_many(std::uint64_t count, std::uint64_t seed, int jobs,
                                        const judgement_sink& tell = {}, const std::string& only_kind = {},
                                        std::uint64_t exact_every = 1);

/// The table: a row a kind, then the ways.
[[nodiscard]] std::string table_of(const referee_counts& c);

/// A row of the ceilings' file: the least number of problems and values compared, and the most of each fault.
struct ceiling {
  long problems = 0, values = 0;
  std::array<long, faults> wrong{};
};
using ceilings = std::map<std::string, ceiling>;  // by kind

/// Those of a run of `count` problems of `seed`; none where the file has none. After a line "[COUNT SEED]"
/// come rows "KIND PROBLEMS VALUES" and then a number for each fault, in the order of `fault`; # begins a
/// comment. Throws std::runtime_error, naming the line, for anything else.
[[nodiscard]] ceilings read_ceilings(std::istream& file, std::uint64_t count, std::uint64_t seed);

/// Such a block for what was counted. Another LAPACK rounds otherwise, and a count moves with that: so a
/// ceiling is a quarter above the count, at least 3, and a floor a hundredth below; what is 0 has to stay so.
[[nodiscard]] std::string ceilings_text(const referee_counts& c, std::uint64_t count, std::uint64_t seed);

/// A line for each count above its ceiling and each below its floor, for each kind that one has and the other
/// has not; empty where all is as it should be.
[[nodiscard]] std::vector<std::string> breaches(const referee_counts& c, const ceilings& allowed);

}  // namespace contct::referee
