#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/diagnosis/compare/trace_study.hpp>

namespace gyrostat::gap {

/// What the traces of a side show of an effect.
struct Found {
  std::vector<Effect> effects;  ///< of the trace that shows it best; none: the side has it not
  std::vector<double> errors;   ///< standard errors of the first one's fields; NaN: not known
  double log_odds = 0.0;        ///< of all traces
};

/// One side of a comparison: its traces, each with the set that it shows.
struct StudiedSide {
  std::string name;  ///< of the first trace
  std::vector<std::unique_ptr<TraceStudy>> traces;

  /// An effect is there where at least half of the traces show it.
  Found found(std::string_view effect) const;
  /// The effects that are there, in the catalogue's order.
  std::vector<std::string> names() const;
  /// Root mean square over the traces.
  double mean_of(double (TraceStudy::*noise)() const) const;
  double resolution_dps() const;
};

}  // namespace gyrostat::gap
