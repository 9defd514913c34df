#pragma once

#include <string>
#include <vector>

#include <gyrostat/experiments/plugins/plugins.hpp>

namespace gyrostat {

/// Whether a plug-in keeps one law of the contract.
struct KeptLaw {
  std::string plugin;  ///< the filter or effect
  std::string law;
  std::string broken_by{};  ///< what was seen; empty where the law holds
};

/// Tries every law on every filter and effect of the plug-in: that nothing but numbers comes out,
/// that the same bits come out again, and that no trial, block or instance reaches another. An
/// effect is also tried with the parameters at which it changes nothing.
std::vector<KeptLaw> check_contract(const LoadedPlugin& plugin);

}  // namespace gyrostat
