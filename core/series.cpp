#include <gyrostat/core/series.hpp>

#include <algorithm>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/fields.hpp>

namespace gyrostat {

double Series::rate_hz() const {
  return duration_s() > 0 ? static_cast<double>(t_s.size() - 1) / duration_s() : 0.0;
}

Series Series::slice(std::size_t first, std::size_t count) const {
  Series part;
  for (const auto& channel : channels) {
    const auto& whole = this->*channel.values;
    if (whole.empty()) continue;
    const auto begin = whole.begin() + static_cast<std::ptrdiff_t>(std::min(first, whole.size()));
    const auto length = std::min(count, static_cast<std::size_t>(whole.end() - begin));
    (part.*channel.values).assign(begin, begin + static_cast<std::ptrdiff_t>(length));
  }
  return part;
}

Series cut(const Series& series, double from_s, double to_s, std::string_view place) {
  const auto index_at = [&](double after_s) {
    return static_cast<std::size_t>(
        std::lower_bound(series.t_s.begin(), series.t_s.end(), series.t_s.front() + after_s) -
        series.t_s.begin());
  };
  const std::size_t first = index_at(from_s), last = index_at(to_s);
  if (last <= first)
    throw InputError(
        place, "no samples " +
                   (from_s >= series.duration_s() ? "from " + short_number(from_s) + " s on"
                                                  : "between " + short_number(from_s) + " s and " +
                                                        short_number(to_s) + " s") +
                   "; the recording lasts " + short_number(series.duration_s()) + " s");
  return series.slice(first, last - first);
}

void Series::clear() {
  for (const auto& channel : channels) (this->*channel.values).clear();
}

}  // namespace gyrostat
