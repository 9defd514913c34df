#include <gyrostat/diagnosis/likelihood/line_shape.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>

#include <tbb/parallel_for.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/log_bessel.hpp>
#include <gyrostat/diagnosis/likelihood/two_exponentials.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

/// A block is such a share of the time that the line remembers: in short ones the line hardly turns
/// on its way through, in long ones it stands out of the noise.
constexpr std::array blocks_of_memory = {0.35, 0.7, 1.4};
constexpr std::size_t shortest_block = 4;
/// Of a line that remembers for long they are shorter, so that there are as many.
constexpr std::size_t fewest_blocks = 50;

/// Squared envelopes, block after block of each span of the part; `no_value` where not half of a
/// block's samples are there.
std::vector<std::vector<double>> squared_envelopes(const Conditions& conditions, Part part,
                                                   const std::vector<double>& left,
                                                   const Resonance& line, std::size_t block) {
  const double turn = -2.0 * std::numbers::pi * line.centre_hz * conditions.interval_s();
  const double c = std::cos(turn), s = std::sin(turn);
  std::vector<std::vector<double>> all;
  for (const auto& span : conditions.spans(part)) {
    all.emplace_back();
    for (std::size_t at = span.first; at + block <= span.last; at += block) {
      double re = 1.0, im = 0.0, sum_re = 0.0, sum_im = 0.0;
      std::size_t there = 0;
      for (std::size_t i = at; i < at + block; ++i) {
        if (!is_missing(left[i])) {
          sum_re += left[i] * re;
          sum_im += left[i] * im;
          ++there;
        }
        const double turned = re * c - im * s;
        im = re * s + im * c;
        re = turned;
      }
      all.back().push_back(2 * there < block ? no_value
                                             : 4.0 * (sum_re * sum_re + sum_im * sum_im) /
                                                   static_cast<double>(there * there));
    }
  }
  return all;
}

LineShape shape_in_blocks(const Conditions& conditions, const std::vector<double>& left_dps,
                          const Resonance& line, double block_of_memory) {
  LineShape shape;
  const double memory_s = 1.0 / (std::numbers::pi * std::max(line.bandwidth_hz, 1e-9));
  // A wave and its mirror about zero, or about half the rate, turn apart by a whole turn: else
  // the squared envelope of noise is not exponential.
  const double apart_hz = std::min(line.centre_hz, 0.5 * conditions.rate_hz() - line.centre_hz);
  const auto samples_in = [&](double seconds) {
    return static_cast<std::size_t>(std::lround(seconds * conditions.rate_hz()));
  };
  std::size_t samples = 0;
  for (const auto& span : conditions.spans(Part::train)) samples += span.size();
  const std::size_t longest = samples / (fewest_blocks + conditions.spans(Part::train).size());
  const std::size_t block = std::max({shortest_block, samples_in(1.0 / std::max(apart_hz, 1e-9)),
                                      std::min(longest, samples_in(block_of_memory * memory_s))});
  const auto envelopes = squared_envelopes(conditions, Part::train, left_dps, line, block);
  std::vector<double> squares;
  for (const auto& e : envelopes)
    std::copy_if(e.begin(), e.end(), std::back_inserter(squares),
                 [](double q) { return !is_missing(q); });
  if (squares.size() < fewest_blocks) return shape;
  const auto n = static_cast<double>(squares.size());
  const double mean = std::accumulate(squares.begin(), squares.end(), 0.0) / n;
  // Blocks within one memory are alike: together they count as one.
  const double block_memories = static_cast<double>(block) * conditions.interval_s() / memory_s;
  const double independent = std::min(1.0, block_memories);
  const double exponential = -n * (std::log(mean) + 1.0);

  double best = exponential;
  for (double share = 0.05; share < 0.999; share += 0.05) {
    const double steady = share * mean, noise = mean - steady;
    double sum = 0.0;
    for (const double q : squares)
      sum += -std::log(noise) - (q + steady) / noise +
             log_bessel_i0(2.0 * std::sqrt(q * steady) / noise);
    if (sum > best) {
      best = sum;
      shape.amplitude_dps = std::sqrt(steady);
    }
  }
  shape.wandering = independent * (best - exponential);

  const auto two = two_exponentials(squares, {0.2, 3.0 * mean, 0.4 * mean}, 0.9, 80);
  if (two.on > 3.0 * two.off)
    shape.bursts = independent * (two.log_likelihood(squares) - exponential);
  shape.block = block;
  shape.course = OnAndOff::in_any_order(two, independent);
  return shape;
}

}  // namespace

LineShape line_shape(const Conditions& conditions, const std::vector<double>& left_dps,
                     const Resonance& line) {
  std::array<LineShape, blocks_of_memory.size()> shapes;
  tbb::parallel_for(std::size_t{0}, shapes.size(), [&](std::size_t k) {
    shapes[k] = shape_in_blocks(conditions, left_dps, line, blocks_of_memory[k]);
  });
  LineShape best;
  for (const auto& shape : shapes)
    if (std::max(shape.wandering, shape.bursts) > std::max(best.wandering, best.bursts))
      best = shape;
  if (best.bursts == 0.0) return best;
  // A block is weak within a burst as often as its own line is.
  best.course = on_and_off(squared_envelopes(conditions, Part::train, left_dps, line, best.block),
                           best.course);
  best.on_std_dps = std::sqrt(std::max(0.5 * (best.course.on - best.course.off), 0.0));
  const double seconds = static_cast<double>(best.block) * conditions.interval_s();
  best.on_s = seconds / best.course.ends;
  best.off_s = seconds / best.course.begins;
  return best;
}

std::vector<char> samples_in_bursts(const Conditions& conditions,
                                    const std::vector<double>& left_dps, const Resonance& line,
                                    const LineShape& shape) {
  constexpr double may_be_on = 0.1;
  std::vector<char> inside(left_dps.size(), 0);
  for (const Part part : both_parts) {
    const auto envelopes = squared_envelopes(conditions, part, left_dps, line, shape.block);
    const auto& spans = conditions.spans(part);
    for (std::size_t s = 0; s < spans.size(); ++s) {
      const auto chances = shape.course.chance_of_on(envelopes[s]);
      for (std::size_t k = 0; k < chances.size(); ++k) {
        if (chances[k] < may_be_on) continue;
        const std::size_t middle = spans[s].first + k * shape.block;
        const std::size_t from = std::max(spans[s].first + shape.block, middle) - shape.block;
        const std::size_t to = std::min(middle + 2 * shape.block, spans[s].last);
        std::fill(inside.begin() + static_cast<std::ptrdiff_t>(from),
                  inside.begin() + static_cast<std::ptrdiff_t>(to), char{1});
      }
    }
  }
  return inside;
}

}  // namespace gyrostat::gap
