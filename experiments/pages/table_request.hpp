#pragma once

#include <map>
#include <string>
#include <vector>

#include <gyrostat/experiments/pages/page.hpp>

namespace gyrostat::tabling {

/// The cells of a study that a page asked for, run once each.
class Results {
 public:
  Results(const std::string& path, const RunCell& run) : study_(read_study(path)), run_(run) {}

  const Study& study() const { return study_; }

  const CellResult& of(const Cell& cell) {
    const auto index = static_cast<std::size_t>(&cell - study_.cells.data());
    if (!done_.contains(index)) done_.emplace(index, run_(study_, cell));
    return done_.at(index);
  }

 private:
  Study study_;
  RunCell run_;
  std::map<std::size_t, CellResult> done_;
};

/// What every kind of table may be asked.
struct Request {
  std::string name, kind, title;
  std::vector<const Cell*> cells;
  std::vector<std::string> methods;  ///< empty: all of each cell
  std::vector<std::size_t> metrics;
  std::vector<std::string> than;
  std::string quantity;
  std::uint32_t trial = 0;
  std::size_t points = 120;
};

/// Reads a table's entry of a page; InputError with the place.
Request read_request(const Study& study, const Json& json, const std::string& place);

/// The method's index in its cell; InputError with the nearest known name.
std::size_t index_of(const Cell& cell, const std::string& method, const std::string& place);

/// Indices of the methods asked for; of all of the cell where none are.
std::vector<std::size_t> methods_of(const Request& request, const Cell& cell);

}  // namespace gyrostat::tabling
