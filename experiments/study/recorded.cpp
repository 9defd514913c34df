#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/recorded.hpp>

#include <filesystem>

#include <fmt/format.h>

namespace gyrostat {

namespace fs = std::filesystem;

RecordingSource::RecordingSource(JsonObject& object, const std::string& folder)
    : path((fs::path(folder) / object.required_text("file")).lexically_normal().string()),
      axis(object.text("axis", "")),
      layout{.columns = object.texts("columns"),
             .units = object.texts("units"),
             .place = object.place(),
             .preset = object.text("preset", ""),
             .topic = object.text("topic", ""),
             .rate_hz = object.number("rate_hz", 0.0, ranges::non_negative, "Hz"),
             .resample_hz = object.number("resample_hz", 0.0, ranges::non_negative, "Hz")} {}

Recording RecordingSource::read() const {
  auto recording = read_recording(path, axis, layout);
  make_even(recording, path, layout);
  return recording;
}

const FittedSpan& FittedRecordings::of(const RecordingSource& source, double from_s, double to_s,
                                       FitMethod method, const std::string& place) {
  const auto& layout = source.layout;
  const auto key = fmt::format("{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}", source.path, source.axis,
                               Json(layout.columns).dump(), Json(layout.units).dump(),
                               layout.preset, layout.topic, layout.rate_hz, layout.resample_hz,
                               from_s, to_s, static_cast<int>(method));
  if (key == key_) return last_;
  const auto recording = source.read();
  const auto span = std::make_shared<const Series>(cut(recording.series, from_s, to_s, place));
  last_ = {span, calibrate(*span, method)};
  key_ = key;
  return last_;
}

}  // namespace gyrostat
