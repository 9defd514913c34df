#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/experiments/findings/models/covering.hpp>
#include <gyrostat/experiments/findings/models/sensor_model.hpp>

namespace gyrostat {

/// What a format's file is written from.
struct ModelSheet {
  const SensorModel& model;
  double N, B, K;      ///< rad/s/√Hz, rad/s, rad/s·√Hz; N enlarged where that was asked for
  double averaging_s;  ///< for numbers that need an averaging time
  std::vector<std::string> remarks;  ///< to stand above the numbers, a line each
};

/// How another simulator or filter wants a gyro's noise.
struct ModelFormat {
  std::string_view id;
  std::string_view title;
  std::string_view file;  ///< as it is customarily called
  /// Effects of the catalogue that it has, beside white noise.
  std::vector<std::string_view> holds;
  bool holds_walk = true;
  std::string (*write)(const ModelSheet& sheet) = nullptr;
};

/// Every format, one from each file of formats/, in the order of their names.
///
/// A file <id>.cpp defines `ModelFormat model_format_<id>()`.
const std::vector<ModelFormat>& model_formats();
void append_model_formats(std::vector<ModelFormat>& to);

/// The format of that name; InputError at `place` with the nearest otherwise.
const ModelFormat& model_format_named(const std::string& name, const std::string& place);

struct ModelOptions {
  double averaging_s = 1.0;
  bool inflate = false;  ///< N as large as covers what the format leaves out
};

/// The model as a file of that format.
std::string write_model(const SensorModel& model, const ModelFormat& format,
                        const ModelOptions& options);

/// The share of a diagnosis' gap that a format leaves open which lacks these effects of the set, in
/// words: exact where the gap was measured without just these, a bound otherwise; empty for a model
/// that is from no diagnosis.
std::string left_open(const SensorModel& model, const std::vector<std::string>& left_out);

/// For files of formats/. Lines of a comment: each of `lines`, folded to a width of 96, behind
/// `mark`.
std::string commented(std::span<const std::string> lines, std::string_view mark);
constexpr double radians = 0.017453292519943295;  ///< in a degree

}  // namespace gyrostat
