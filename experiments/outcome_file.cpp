#include "experiments/outcome_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <iterator>

#include "core/error.hpp"
#include "experiments/atomic_file.hpp"

namespace gyrostat {

namespace {

/// As RFC 4180 has it; names have no quotes.
std::string quoted(const std::string& name) {
  return name.find(',') == std::string::npos ? name : '"' + name + '"';
}

}  // namespace

void make_result_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw InputError(folder.string(), "cannot be created: " + failure.message());
  if (::access(folder.c_str(), W_OK) != 0)
    throw InputError(folder.string(), "cannot be written to");
}

void require_writable(const std::filesystem::path& path, const std::filesystem::path& input) {
  std::error_code failure;
  if (std::filesystem::equivalent(path, input, failure))
    throw InputError(path.string(), "is what is read from; name another file");
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  if (std::filesystem::is_directory(path, failure) || !std::filesystem::is_directory(folder, failure) ||
      ::access(folder.c_str(), W_OK) != 0)
    throw InputError(path.string(), "cannot be written");
}

void write_outcomes(const std::filesystem::path& path, const Study& study,
                    std::span<const CellResult> results) {
  std::string text = "cell,trial,method";
  for (const auto& id : Metrics::ids()) text += ',' + id;
  for (const auto name : status_names) text += fmt::format(",{}", name);
  text += ",diverged\n";
  auto out = std::back_inserter(text);
  for (std::size_t c = 0; c < results.size(); ++c) {
    const auto& cell = study.cells[c];
    for (std::size_t trial = 0; trial < results[c].trials.size(); ++trial) {
      const auto& record = results[c].trials[trial];
      if (!record) continue;
      for (std::size_t m = 0; m < cell.methods.size(); ++m) {
        const auto& outcome = record->outcomes[m];
        fmt::format_to(out, "{},{},{}", quoted(cell.name), trial, cell.methods[m].id);
        for (const double value : outcome.metrics)
          if (std::isnan(value)) text += ',';
          else fmt::format_to(out, ",{:.17g}", value);
        for (const auto count : outcome.status_counts) fmt::format_to(out, ",{}", count);
        fmt::format_to(out, ",{}\n", outcome.diverged ? 1 : 0);
      }
    }
  }
  write_atomically(path, gzipped(text));
}

}  // namespace gyrostat
