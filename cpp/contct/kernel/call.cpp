#include "contct/kernel/call.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace contct {
namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& found, const std::string& allowed) {
  throw std::invalid_argument("call: " + where + ": found " + found + "; allowed: " + allowed);
}

void refuse_dof(const call<double>& c, std::size_t pair) {
  const auto dofs = static_cast<std::int64_t>(std::min(c.dd.size(), c.dtest.size()));
  const std::int64_t before = std::int64_t{c.id[pair]} - 1;
  const std::int64_t product = before * c.dof.ndofpn;
  const std::int64_t dof = product + c.dof.indof;
  if (dof >= 1 && dof <= dofs && std::in_range<int>(before) && std::in_range<int>(product)) return;
  refuse("pair " + std::to_string(pair + 1),
         "ID " + std::to_string(c.id[pair]) + ", which is dof " + std::to_string(dof) + " with INDOF " +
             std::to_string(c.dof.indof) + " and NDOFPN " + std::to_string(c.dof.ndofpn),
         "a dof from 1 to " + std::to_string(dofs) + ", computed within 32 bits");
}

}  // namespace

void refuse_beyond_limits(const call<double>& c, std::span<const int> isep) {
  constexpr std::int64_t most_pairs = 2'147'483'646;  // the counter of a DO loop ends at NC + 1
  const auto pairs = static_cast<std::int64_t>(c.cc.size());
  if (pairs > most_pairs) refuse("NC", std::to_string(pairs), "0 to " + std::to_string(most_pairs));
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    refuse_dof(c, i);
    const std::int64_t product = std::int64_t{isep[i]} * c.isurf[i];
    if (!std::in_range<int>(product))
      refuse("pair " + std::to_string(i + 1),
             "ISEP " + std::to_string(isep[i]) + " and ISURF " + std::to_string(c.isurf[i]) +
                 ", whose product is " + std::to_string(product),
             "a product within 32 bits, -2147483648 to 2147483647");
  }
}

}  // namespace contct
