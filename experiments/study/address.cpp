#include <gyrostat/experiments/study/address.hpp>

#include <charconv>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>

namespace gyrostat {
namespace {

constexpr const char* form = "an address is study:cell:trial:filter";

std::uint32_t trial_number(const std::string& text, const Cell& cell, const std::string& address) {
  std::uint64_t trial = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), trial);
  if (failure != std::errc() || end != text.data() + text.size())
    throw InputError(address, fmt::format("'{}' is no trial number; {}", text, form));
  if (trial >= cell.trials)
    throw InputError(address,
                     fmt::format("trial {} is out of range; allowed: 0 to {}, the trials of cell "
                                 "'{}'",
                                 trial, cell.trials - 1, cell.name));
  return static_cast<std::uint32_t>(trial);
}

std::size_t method_named(const std::string& name, const Cell& cell, const std::string& address) {
  std::vector<std::string> ids;
  for (const auto& method : cell.methods) {
    if (method.id == name) return ids.size();
    ids.push_back(method.id);
  }
  throw InputError(address, unknown_name("filter of cell '" + cell.name + "':", name, ids));
}

}  // namespace

std::string address_text(const std::string& study, const std::string& cell, std::uint32_t trial,
                         const std::string& method) {
  return fmt::format("{}:{}:{}:{}", study, cell, trial, method);
}

std::string study_of_address(const std::string& address) {
  const auto colon = address.find(':');
  if (colon == std::string::npos || colon == 0) throw InputError(address, form);
  return address.substr(0, colon);
}

TrialAddress parse_address(const std::string& address, const Study& study) {
  const auto rest = address.substr(study_of_address(address).size() + 1);
  const auto last = rest.rfind(':');
  const auto middle =
      last == std::string::npos || last == 0 ? std::string::npos : rest.rfind(':', last - 1);
  if (middle == std::string::npos) throw InputError(address, form);
  const auto& cell = cell_named(study, rest.substr(0, middle), address);
  const auto trial = trial_number(rest.substr(middle + 1, last - middle - 1), cell, address);
  return {static_cast<std::size_t>(&cell - study.cells.data()),
          method_named(rest.substr(last + 1), cell, address), trial};
}

}  // namespace gyrostat
