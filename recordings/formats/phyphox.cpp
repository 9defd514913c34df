#include <gyrostat/recordings/format_type.hpp>
#include <gyrostat/recordings/units.hpp>

namespace gyrostat::formats::phyphox {
namespace {

/// The first column whose name, before its unit, ends in `ending` and begins with `begin`.
std::string column(const FormatHead& head, std::string_view begin, std::string_view ending) {
  if (head.header)
    for (const auto& name : head.header->names) {
      const auto [base, unit] = split_unit(name);
      if (!unit.empty() && base.starts_with(begin) && base.ends_with(ending)) return name;
    }
  return "";
}

RecordingLayout layout(const FormatHead& head) {
  RecordingLayout layout;
  layout.columns["t"] = column(head, "Time", "Time");
  for (const std::string axis : {"x", "y", "z"}) {
    layout.columns["gyro_" + axis] = column(head, "Gyroscope ", " " + axis);
    if (const auto found = column(head, "Acceleration ", " " + axis); !found.empty())
      layout.columns["acc_" + axis] = found;
  }
  return layout;
}

}  // namespace

/// `Gyroscope.csv` or `Raw Data.csv` of a phyphox experiment, in any of its three separators; units
/// stand in the header: "Time (s)","Gyroscope x (rad/s)",… (phyphox.org, file format).
RecordingFormat format() {
  return {.title = "phyphox: the gyroscope's CSV",
          .recognises =
              [](const FormatHead& head) {
                return !column(head, "Time", "Time").empty() &&
                       !column(head, "Gyroscope ", " x").empty() &&
                       !column(head, "Gyroscope ", " y").empty() &&
                       !column(head, "Gyroscope ", " z").empty();
              },
          .layout = layout};
}

}  // namespace gyrostat::formats::phyphox
