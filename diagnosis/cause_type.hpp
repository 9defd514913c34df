#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/core/registry.hpp>
#include <gyrostat/generators/effect.hpp>

namespace gyrostat::gap {

struct Beside;
class Conditions;
struct Evidence;
struct NoiseLaw;

/// What an effect adds to a recording, seen over replicas of one scenario.
enum class Signature {
  none,      ///< every replica has its own: a fit to simulated readings moves the parameters
  repeated,  ///< the same in every replica: least squares on the recording finds the parameters
  slow,      ///< repeated, and a curve that a random walk imitates
};

/// An effect that the diagnosis may name as a cause, without its C++ type: one of the catalogue.
struct CauseType {
  static constexpr std::string_view kind = "cause";

  std::string_view id;  ///< the effect's
  Signature signature;
  /// The parameters that the recording decides; the others would move nothing that the baseline
  /// does not, or are found at the start and kept.
  std::vector<std::string_view> free_parameters;
  /// How many of them, the first, are amplitudes of a slow signature.
  std::size_t amplitudes;
  /// How many parameters more its form has cost, which no fit moves: starts have each its own.
  /// nullptr: none.
  std::size_t (*chosen_parameters)(const Effect& effect);
  /// The part of a sensor whose doing it is, where all axes have that alike, as "output filter";
  /// empty where each axis has its own.
  std::string_view part;
  std::vector<std::string_view> alike;  ///< parameters that then are one for all axes
  Effect (*effect)();                   ///< with its default parameters
  /// First parameters from what a set leaves of the recording, one or several; none where it shows
  /// nothing alike, nullptr where `guesses` finds them.
  std::vector<Effect> (*starts)(const Evidence& evidence);
  /// First parameters beside what a set already has, for a fit by likelihood; nullptr where
  /// `starts` on what the set leaves finds them.
  std::vector<Effect> (*guesses)(const Beside& beside);
  /// The same effect as others would tell it, with which something beside it may be needless;
  /// nullptr where there is one way alone.
  std::vector<Effect> (*told_otherwise)(const Effect& effect, const Conditions& conditions);
  /// What the effect adds to the law of the noise; nullptr where it has none.
  void (*enter)(const Effect& effect, NoiseLaw& law);
  /// Why the recording cannot show the effect, with how much more it would need; empty where it
  /// can.
  std::string (*why_not_assessable)(const Conditions& conditions);
  /// Whether the parameters are what the effect's name says: slow errors last for more than a few
  /// samples, a disturbance of the compass does not turn it round.
  bool (*is_what_it_is_called)(const Effect& effect, const Conditions& conditions);

  bool is_deterministic() const { return signature != Signature::none; }

  static void describe_all(std::deque<CauseType>& to);
};

/// The catalogue. An effect that it lacks is simulated, and is never named.
inline Registry<CauseType>& cause_types() { return Registry<CauseType>::all(); }

}  // namespace gyrostat::gap
