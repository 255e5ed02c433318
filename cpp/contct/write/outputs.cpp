#include "contct/write/outputs.hpp"

#include <string>

#include "contct/write/pictures.hpp"
#include "contct/write/result_json.hpp"

namespace contct {

void write_outputs(const run& r) {
  const run_outputs& to = r.to;
  if (to.result != nullptr) write_result(r.result, *to.result, to.parts);
  for (output_file* const file : {to.log, to.trace})
    if (file != nullptr) file->finish();
  if (to.table != nullptr) write_csv(r.result, r.wanted.watched, *to.table, to.pairs);
  const auto write_all = [](output_file& file, const std::string& text) {
    file.write(text);
    file.finish();
  };
  if (to.proof != nullptr) write_all(*to.proof, proof_json(r.result.what, r.result.judged));
  if (to.page != nullptr) write_all(*to.page, run_page(r.result));
}

}  // namespace contct
