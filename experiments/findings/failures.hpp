#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/run/failure_second_opinion.hpp>
#include <gyrostat/experiments/run/failure_signal.hpp>

namespace gyrostat {

/// Why there is nothing to tell.
inline constexpr const char* no_failure_asked_for =
    "no cell of it asks for a failure; \"failure\": {\"metric\": …, \"above\": …} in a cell does";

/// How likely a method fails as its cell asks for.
struct FailureFinding {
  std::string method;
  PlainFailures plain;
  std::optional<FailureSearch> search;  ///< where plain trials do not tell it
  std::optional<RareProbability> rare;  ///< once every run of the search has reached the threshold
  std::optional<double> rarer_than;     ///< where the search has ended and not every run did
};

/// The store of a study's searches in a run's folder; nothing where there is none, or one of other
/// rules.
std::optional<Store> failure_store(const Study& study, const std::filesystem::path& folder);

/// What a run's folder tells of the failure of a cell, number `index` of `study`; one finding a
/// method of its rule. `plain` is the run's store.
std::vector<FailureFinding> failure_findings(const Study& study, const Store& plain,
                                             std::uint32_t index,
                                             const std::filesystem::path& folder);
std::vector<FailureFinding> failure_findings(const Study& study, const Store& plain,
                                             std::uint32_t index,
                                             const std::optional<Store>& searches);

/// One row a method, with a sentence for each as notes.
Table failure_table(const Cell& cell, const std::vector<FailureFinding>& findings);

/// The levels of the searches: thresholds, shares and acceptance, means over the runs.
Table failure_levels(const Cell& cell, const std::vector<FailureFinding>& findings);

/// The place of a method of a cell in failure_study(study).
std::uint32_t failure_index(const Study& study, std::uint32_t index, std::size_t method);

/// How a method of a cell fails, from a run's folder; nothing where the search has not ended at
/// its threshold or failing trials have nothing in common.
std::optional<FailureSignal> found_signal(const Study& study, std::uint32_t index,
                                          std::size_t method, const PreparedCell& prepared,
                                          const std::filesystem::path& folder);

/// The same, and what importance sampling along it says of the probability.
struct FailureHow {
  FailureSignal signal;
  std::optional<SecondOpinion> second;
};
std::optional<FailureHow> how_it_fails(const Study& study, std::uint32_t index, std::size_t method,
                                       const PreparedCell& prepared,
                                       const std::filesystem::path& folder);

/// What drives it: the share of each noise in the design point. Notes compare the probability with
/// that of a flat edge at the design point's distance, and with importance sampling's: they are the
/// same where the failure is a half-space, or two of them, and the last where it is one mode.
Table driver_table(const Study& study, const Cell& cell, const FailureFinding& finding,
                   const FailureHow& how);

}  // namespace gyrostat
