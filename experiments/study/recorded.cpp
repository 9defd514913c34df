#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/recorded.hpp>

#include <filesystem>

#include <fmt/format.h>

namespace gyrostat {

namespace fs = std::filesystem;

RecordingSource::RecordingSource(JsonObject& object, const std::string& folder)
    : path((fs::path(folder) / object.required_text("file")).lexically_normal().string()),
      axis(object.text("axis", "")),
      layout{object.texts("columns"), object.texts("units"), object.place()} {}

Recording RecordingSource::read() const {
  auto recording = read_recording(path, axis, layout);
  require_uniform(recording.series, path, recording.first_row);
  return recording;
}

const FittedSpan& FittedRecordings::of(const RecordingSource& source, double from_s, double to_s,
                                       FitMethod method, const std::string& place) {
  const auto key = fmt::format("{}|{}|{}|{}|{}|{}|{}", source.path, source.axis,
                               Json(source.layout.columns).dump(), Json(source.layout.units).dump(),
                               from_s, to_s, static_cast<int>(method));
  if (key == key_) return last_;
  const auto recording = source.read();
  const auto span = std::make_shared<const Series>(cut(recording.series, from_s, to_s, place));
  last_ = {span, calibrate(*span, method)};
  key_ = key;
  return last_;
}

}  // namespace gyrostat
