#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_failing_signal(const PictureSources& from) {
  const auto& v = from.view;
  if (!v.failure) return {};
  const auto& failure = *v.failure;
  Picture picture{.id = v.id + "-failing-signal",
                  .title = "How it fails: the most likely failing signal",
                  .x = {"time", "s"},
                  .y = {failure.error, failure.unit}};
  std::vector<std::string> typical;
  for (const auto& signal : failure.signals) {
    const auto& method = v.cell.methods[signal.method].id;
    auto failing = v.colours.mark(Mark::Kind::line, method);
    failing.strong = true;
    failing.x = failure.t_s;
    failing.y = signal.failing_error;
    picture.marks.push_back(std::move(failing));
    auto beside = v.colours.mark(Mark::Kind::line, method);
    beside.dashed = true;
    beside.x = failure.t_s;
    beside.y = signal.typical_error;
    picture.marks.push_back(std::move(beside));
    typical.push_back(fmt::format("{} of {}", signal.typical, method));
  }
  picture.note = fmt::format(
      "Thick: the deviates that failing trials have in common, scaled onto the threshold; what "
      "they have "
      "not in common is left out, so it is smoother than any trial. Dashed: a typical trial, that "
      "with "
      "the median of the metric ({}). gyrostat replay {}:{}:failure:METHOD --steps has its "
      "samples.",
      fmt::join(typical, ", "), v.study.name(), v.cell.name);
  return picture;
}

}  // namespace gyrostat
