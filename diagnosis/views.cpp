#include <gyrostat/diagnosis/views.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t stretches = 4, stretch = std::size_t{1} << 19;
constexpr std::size_t most_means = std::size_t{1} << 20;

/// How many samples of the stretch from there on tell something: those that are there, but for the
/// longest run of one value, in which a gyro hangs.
std::size_t telling_in(const Series& recording, std::size_t first) {
  std::size_t present = 0, run = 0, longest_run = 0;
  double last = no_value;
  for (const double value : std::span(recording.gyro_dps.data() + first, stretch)) {
    if (is_missing(value)) continue;
    ++present;
    run = value == last ? run + 1 : 1;
    longest_run = std::max(longest_run, run);
    last = value;
  }
  return present - longest_run;
}

/// The place nearest to the middle of [first, last) where a stretch is nearly whole, else where
/// most of one is.
std::size_t stretch_in(const Series& recording, std::size_t first, std::size_t last) {
  constexpr double nearly = 0.9;
  const std::size_t middle = first + (last - first - stretch) / 2;
  std::size_t best = middle, most = 0;
  for (std::size_t away = 0; away <= middle - first; away += stretch / 4)
    for (const std::size_t at : {middle - away, middle + away}) {
      const std::size_t telling = telling_in(recording, at);
      if (static_cast<double>(telling) >= nearly * static_cast<double>(stretch)) return at;
      if (telling > most) most = telling, best = at;
    }
  return best;
}

/// Of the samples of a mean: Hann's. A fast line between two means is lost (white noise counts half
/// as much again), and values on a grid have means that lie on none.
std::vector<double> weights_of(std::size_t count) {
  std::vector<double> weights(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    weights[i] = std::pow(std::sin(std::numbers::pi * at), 2);
  }
  return weights;
}

/// The weighted mean of what is there, by how far each value is `off` the first of them.
template <class Off>
double mean_of_present(const double* values, const std::vector<double>& weights, const Off& off) {
  double sum = 0.0, weight = 0.0, about = no_value;
  std::size_t present = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (is_missing(values[i])) continue;
    if (is_missing(about)) about = values[i];
    sum += weights[i] * off(values[i], about);
    weight += weights[i];
    ++present;
  }
  return 2 * present < weights.size() ? no_value : about + sum / weight;
}

}  // namespace

bool never_changes(std::span<const double> gyro_dps) {
  const auto present = [](double value) { return !is_missing(value); };
  const auto first = std::find_if(gyro_dps.begin(), gyro_dps.end(), present);
  return std::all_of(first, gyro_dps.end(),
                     [&](double value) { return is_missing(value) || value == *first; });
}

std::vector<View> views_of(const Series& recording) {
  const std::size_t samples = recording.size();
  if (samples <= most_samples_at_once) return {{0, samples}};
  std::vector<View> views;
  for (std::size_t k = 0; k < stretches; ++k)
    views.push_back(
        {stretch_in(recording, k * samples / stretches, (k + 1) * samples / stretches), stretch});
  views.push_back({0, samples, (samples + most_means - 1) / most_means});
  return views;
}

std::string in_words(const std::vector<View>& views, std::size_t samples) {
  std::size_t seen = 0, of = 0, mean_of = 1;
  for (const auto& view : views)
    if (view.mean_of > 1)
      mean_of = view.mean_of;
    else
      seen += view.count, ++of;
  const auto words = fmt::format(
      "of {} samples, {} stretches spread over them ({:.2g} %) are looked at sample by sample",
      samples, of, 100.0 * static_cast<double>(seen) / static_cast<double>(samples));
  if (mean_of == 1) return words;
  return fmt::format("{}, for what is fast, and all in means of {}, for what is slow", words,
                     mean_of);
}

Series looked_at(const Series& recording, const View& view) {
  if (view.mean_of == 1) return recording.slice(view.first, view.count);
  Series means;
  const std::size_t count = view.count / view.mean_of;
  const auto weights = weights_of(view.mean_of);
  const auto apart = [](double value, double about) { return value - about; };
  const auto turned = [](double value, double about) { return wrap_degrees(value - about); };
  for (const auto& channel : channels) {
    const auto& from = recording.*channel.values;
    auto& to = means.*channel.values;
    if (from.empty()) continue;
    to.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const double* block = from.data() + view.first + k * view.mean_of;
      if (channel.values == &Series::mag_valid)
        to[k] = *std::min_element(block, block + view.mean_of);
      else if (channel.values == &Series::heading_deg)
        to[k] = wrap_degrees(mean_of_present(block, weights, turned));
      else
        to[k] = mean_of_present(block, weights, apart);
    }
  }
  return means;
}

}  // namespace gyrostat::gap
