#include <gyrostat/recordings/binary/imu_log.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/words.hpp>
#include <gyrostat/recordings/text.hpp>

namespace gyrostat {

void ImuLog::add(std::string_view topic, const ImuSample& sample) {
  auto found = topics_.find(topic);
  if (found == topics_.end()) found = topics_.emplace(std::string(topic), Topic{}).first;
  auto& [t_ns, values, left_out] = found->second;
  if (!t_ns.empty() && sample.t_ns <= t_ns.back()) {
    ++left_out;
    return;
  }
  t_ns.push_back(sample.t_ns);
  for (std::size_t k = 0; k < 3; ++k) {
    values[k].push_back(sample.gyro_rad_s[k]);
    values[3 + k].push_back(sample.acc_mps2[k]);
  }
  values[6].push_back(sample.temperature_C);
}

ColumnTable ImuLog::table(const std::string& wanted, const std::string& place,
                          std::string_view searched) && {
  if (topics_.empty())
    throw InputError(place, fmt::format("holds no gyro{}; required: {}",
                                        cut_off_ ? ", and it is cut off" : "", searched));
  std::vector<std::string> names;
  auto chosen = topics_.begin();
  for (auto at = topics_.begin(); at != topics_.end(); ++at) {
    names.push_back(printable(at->first));
    if (at->second.t_ns.size() > chosen->second.t_ns.size()) chosen = at;
  }
  if (!wanted.empty()) chosen = topics_.find(wanted);
  if (chosen == topics_.end())
    throw InputError(place, fmt::format("{}; allowed: {}", unknown_name("topic", wanted, names),
                                        fmt::join(names, ", ")));
  ColumnTable table;
  auto& [t_ns, values, left_out] = chosen->second;
  std::vector<double> t_s(t_ns.size());
  // Unsigned, so that no pair of times overflows.
  const auto since = [&](std::int64_t t) {
    return static_cast<double>(static_cast<std::uint64_t>(t) -
                               static_cast<std::uint64_t>(t_ns.front())) *
           1e-9;
  };
  std::ranges::transform(t_ns, t_s.begin(), since);
  table.add("t_s", std::move(t_s));
  constexpr std::array<std::string_view, 7> columns = {"gyro_x", "gyro_y", "gyro_z", "acc_x",
                                                       "acc_y",  "acc_z",  "temp"};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (std::ranges::all_of(values[k], [](double v) { return std::isnan(v); })) continue;
    const std::string channel(columns[k]);
    table.layout.columns[channel] = channel;
    table.layout.units[channel] = k < 3 ? "rad/s" : k < 6 ? "m/s2" : "C";
    table.add(channel, std::move(values[k]));
  }
  const auto chosen_name = printable(chosen->first);
  std::erase(names, chosen_name);
  table.notes.push_back(fmt::format(
      "topic {}{}", chosen_name,
      names.empty() ? "" : fmt::format(" (--topic has also {})", fmt::join(names, ", "))));
  if (left_out > 0)
    table.notes.push_back(
        fmt::format("{} not after the one before left out", counted(left_out, "sample")));
  if (cut_off_) table.notes.push_back("the log is cut off: its last record is left out");
  return table;
}

}  // namespace gyrostat
