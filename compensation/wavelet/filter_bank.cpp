#include "compensation/wavelet/filter_bank.h"

#include <fmt/format.h>

#include "compensation/values/nearest_name.h"
#include "compensation/wavelet/filter_bank_table.h"

namespace gyrocal {
namespace {

FilterBank from_low_pass(const NamedFilter& filter) {
  FilterBank bank;
  bank.name = filter.name;
  bank.rec_lo.assign(filter.rec_lo.begin(), filter.rec_lo.end());
  bank.dec_lo.assign(filter.rec_lo.rbegin(), filter.rec_lo.rend());
  bank.rec_hi = bank.dec_lo;
  for (std::size_t k = 1; k < bank.rec_hi.size(); k += 2) bank.rec_hi[k] = -bank.rec_hi[k];
  bank.dec_hi.assign(bank.rec_hi.rbegin(), bank.rec_hi.rend());
  return bank;
}

}  // namespace

const std::vector<FilterBank>& filter_banks() {
  static const std::vector<FilterBank> banks = [] {
    std::vector<FilterBank> all;
    for (const NamedFilter& filter : low_pass_filters()) all.push_back(from_low_pass(filter));
    return all;
  }();
  return banks;
}

Result<const FilterBank*> find_filter_bank(std::string_view name) {
  const std::string_view wanted = name == "db1" ? "haar" : name;
  for (const FilterBank& bank : filter_banks()) {
    if (bank.name == wanted) return &bank;
  }
  std::vector<std::string_view> known;
  for (const FilterBank& bank : filter_banks()) known.emplace_back(bank.name);
  return fail(Errc::unknown_name, fmt::format("unknown wavelet '{}'", name),
              known_names("wavelets", name, known));
}

}  // namespace gyrocal
