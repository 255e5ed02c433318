// The two programs that are compared, and what they are compared by.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "peer/calculix_results.hpp"

namespace contct::app::peer {

/// Where everything is.
struct places {
  std::string contct;     ///< the program
  std::string ccx;        ///< CalculiX
  std::string reference;  ///< the project's folder of that name
  std::string work;       ///< a folder to write in
};

std::string read_text(const std::string& path);
void write_text(const std::string& path, const std::string& text);

/// What `contct run PROBLEM` comes to, both kernels in lockstep. Throws std::runtime_error unless they are
/// equal and every final state is certified.
nlohmann::json run_contct(const places& p, const std::string& problem);

/// Run CalculiX on a deck under the name `job`. Throws where it fails, and where its results lack anything.
void run_deck(const places& p, const std::string& job, const std::string& deck);
std::vector<calculix_table> run_calculix(const places& p, const std::string& job, const std::string& deck);

/// Facts found and the checks that failed; every check prints a line.
class verdicts {
 public:
  void check(bool good, const std::string& words);
  [[nodiscard]] int checks() const { return checks_; }
  [[nodiscard]] int failures() const { return failures_; }

 private:
  int checks_ = 0;
  int failures_ = 0;
};

/// How far CalculiX's answer is from ours.
struct difference {
  double displacement = 0.0;  ///< the largest difference over the largest deflection
  double force = 0.0;         ///< the same of the pairs' forces; 0 where none presses
  bool same_pairs = true;     ///< the same pairs are closed
  int values = 0;             ///< compared
};

void check_structures(const places& p, verdicts& v);
void check_solids(const places& p, verdicts& v);

}  // namespace contct::app::peer
