#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/results/pictures/picture.hpp>
#include <gyrostat/results/store.hpp>

namespace gyrostat {

struct ReportOptions {
  std::vector<std::string>
      cells;  ///< to be shown in full; empty: at most six, one of those made from one
  std::optional<std::uint32_t> replay;  ///< trials simulated again for pictures over time; 0: none
  int threads = 0;                      ///< 0: as many as the machine has
  /// Told of what is being done, and which share of all is.
  std::function<void(const std::string& phase, const std::string& detail, double share)> progress{};
};

/// A study's result as one page of HTML that needs nothing else: a function of the folder and the
/// options. The folder holds the store and, for times per step, the run's log.
std::string report_page(const Study& study, const Store& store, const std::filesystem::path& folder,
                        const ReportOptions& options);

/// The pictures of a cell that the page shows in full.
struct CellPictures {
  std::string cell;
  std::vector<Picture> pictures;
};

/// Those pictures without the page.
std::vector<CellPictures> report_pictures(const Study& study, const Store& store,
                                          const std::filesystem::path& folder,
                                          const ReportOptions& options);

}  // namespace gyrostat
