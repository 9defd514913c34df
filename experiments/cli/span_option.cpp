#include <gyrostat/experiments/cli/span_option.hpp>

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/core/values.hpp>
#include <gyrostat/experiments/cli/options.hpp>

namespace gyrostat::cli {
namespace {

/// "FROM:TO", s; none where it is no span.
std::optional<std::pair<double, double>> span_of(const std::string& text) {
  const auto colon = text.find(':');
  std::pair<double, double> span{};
  const bool is_read = colon != std::string::npos &&
                       CLI::detail::lexical_cast(text.substr(0, colon), span.first) &&
                       CLI::detail::lexical_cast(text.substr(colon + 1), span.second);
  if (!is_read || !(span.first >= 0.0) || !(span.second > span.first)) return std::nullopt;
  return span;
}

}  // namespace

void SpanOption::add_to(CLI::App* verb) {
  verb->add_option("--from", from_s, "start of the span, s from the first sample")
      ->check(within(0.0, 1e12, "s"));
  verb->add_option("--to", to_s, "end of the span, s from the first sample")
      ->check(within(0.0, 1e12, "s"));
  verb->add_option("--leave-out", left_out,
                   "what does not count, s from the first sample, as 54.8:55.3")
      ->type_name("FROM:TO")
      ->allow_extra_args(false)
      ->check(CLI::Validator(
          [](const std::string& text) {
            return span_of(text) ? std::string{}
                                 : fmt::format(
                                       "'{}' is no span; allowed: FROM:TO, s from the "
                                       "first sample, as 54.8:55.3",
                                       text);
          },
          ""));
}

void SpanOption::leave_out(Series& series, const std::string& file) const {
  for (const auto& text : left_out) {
    const auto [from, to] = *span_of(text);
    const auto out = cut(series, from, to, file + ": --leave-out");
    const auto first = std::ranges::lower_bound(series.t_s, out.t_s.front()) - series.t_s.begin();
    std::fill_n(series.gyro_dps.begin() + first, out.size(), no_value);
  }
}

}  // namespace gyrostat::cli
