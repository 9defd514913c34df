#pragma once

#include <memory>
#include <string>

#include <gyrostat/analysis/calibration.hpp>
#include <gyrostat/experiments/study/json.hpp>
#include <gyrostat/recordings/recording.hpp>

namespace gyrostat {

/// A recording that a study names, relative to its `folder`.
struct RecordingSource {
  std::string path, axis;
  RecordingLayout layout;

  /// From the keys "file", "axis", "columns", "units", "preset", "topic", "rate_hz" and
  /// "resample_hz" of `object`.
  RecordingSource(JsonObject& object, const std::string& folder);
  /// On an even clock; InputError where it has none.
  Recording read() const;
};

/// A span of a recording and the fit to it.
struct FittedSpan {
  std::shared_ptr<const Series> span;
  Calibration fit;
};

/// Fits to recordings while a study is read. The last one is kept, since all points of a design are
/// around the same recording.
class FittedRecordings {
 public:
  /// Throws InputError at `place` where the span holds nothing.
  const FittedSpan& of(const RecordingSource& source, double from_s, double to_s, FitMethod method,
                       const std::string& place);

 private:
  std::string key_;
  FittedSpan last_;
};

}  // namespace gyrostat
