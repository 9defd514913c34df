#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/effect.hpp>

namespace gyrostat::gap {

/// What makes a line of the gyro, as the channels beside it tell.
enum class LineSource {
  mechanical,  ///< an accelerometer shows it: the sensor is shaken
  electronic,  ///< what is there beside the gyro does not show it
  undecided    ///< it may be in the accelerometer, or there is none and other axes show it
};
std::string_view name_of(LineSource source);

/// One line of the set, and the channel that is most coherent with the gyro at its frequency.
struct LineWitness {
  std::string effect;
  double frequency_hz = 0.0;
  LineSource source = LineSource::undecided;
  std::string channel;
  double coherence = 0.0;  ///< magnitude squared
  bool has_accelerometer = false;
  double p_value = 1.0;  ///< of so much by chance, in any of the channels and frequencies looked at
};

/// The sources of those of `effects` that are lines: by the coherence of the gyro with the
/// accelerometer and the other axes within the line's width. What fewer than eight segments tell
/// is left out, and so are all where there is no channel beside the gyro. p below 0.001 is
/// coherence, and from 0.05 on it is none.
std::vector<LineWitness> line_sources(const Series& recording, const std::vector<Effect>& effects);

/// "In acc_y_mps2, too: vibration at 12 Hz (coherence 0.93); mechanical, the sensor is shaken.";
/// empty where there are none.
std::string in_words(const std::vector<LineWitness>& lines);

}  // namespace gyrostat::gap
