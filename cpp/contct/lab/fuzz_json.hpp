// A fuzz run as JSON, format "contct-fuzz-1", and the results of shards added up.
#pragma once

#include <string>
#include <vector>

#include "contct/lab/fuzz.hpp"

namespace contct::lab {

[[nodiscard]] std::string fuzz_json(const fuzz_result& r);

/// Read the results of all shards of one run and add them up. Throws input_error when one is no such file,
/// when they are not of one run, or when a shard is missing or given twice.
[[nodiscard]] fuzz_result merged_fuzz(const std::vector<std::string>& files);

}  // namespace contct::lab
