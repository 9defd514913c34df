#include <gyrostat/experiments/study/scenario_reading.hpp>

#include <filesystem>

#include <gyrostat/experiments/study/fleet_reading.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/generators/environment/acceleration/recorded.hpp>
#include <gyrostat/generators/environment/motion/recorded.hpp>
#include <gyrostat/generators/environment/temperature/quiet_room.hpp>
#include <gyrostat/generators/environment/temperature/recorded.hpp>

namespace gyrostat {
namespace {

/// A plug-in chosen by the text under `chooser`, its parameters under the other keys.
template <class Chosen>
Chosen read_plugin(JsonObject object, const std::string& chooser) {
  using Type = std::remove_cvref_t<decltype(std::declval<Chosen>().type())>;
  const auto id = object.required_text(chooser);
  Chosen chosen(Registry<Type>::all().named(id, object.place_of(chooser)));
  object.fields(chosen);
  object.finish();
  return chosen;
}

Compass read_compass(JsonObject object) {
  Compass compass;
  object.fields(compass);
  for (const auto& entry : object.list("disturbances"))
    object.attempt([&] {
      JsonObject disturbance = object.at(*entry.first, entry.second);
      disturbance.fields(compass.disturbances.emplace_back());
      disturbance.finish();
    });
  object.finish();
  return compass;
}

/// Sets random error, thermal drift, rate and temperature from a fit to a recording.
void read_recorded(JsonObject object, const std::string& folder, FittedRecordings& fits,
                   Scenario& scenario) {
  const RecordingSource source(object, folder);
  const double from_s = object.number("from_s", 0.0, ranges::non_negative, "s");
  const double to_s = object.number("to_s", 1e12, ranges::positive, "s");
  const auto method = object.named("fit", "likelihood", fit_method_named);
  object.finish();

  const auto& [span, fit] = fits.of(source, from_s, to_s, method, object.place());
  if (!fit.random_error.converged)
    throw InputError(object.place(), "the fit to the recording " + fit.random_error.message);
  scenario.random_error = fit.random_error.parameters;
  scenario.sampling.rate_hz = span->rate_hz();
  scenario.thermal_drift = {};
  if (fit.thermal) {
    scenario.thermal_drift = fit.thermal->parameters;
    scenario.temperature = temperature::Recorded{span};
  } else {
    scenario.thermal_drift.c_dps = fit.mean_dps;
    scenario.temperature = temperature::QuietRoom{.start_C = 25.0, .end_C = 25.0};
  }
}

/// Sets sampling, temperature, rates and acceleration to those of a recording, as far as it has
/// them.
void read_conditions(JsonObject object, const std::string& folder, Scenario& scenario) {
  const RecordingSource source(object, folder);
  const double from_s = object.number("from_s", 0.0, ranges::non_negative, "s");
  const double to_s = object.number("to_s", 1e12, ranges::positive, "s");
  object.finish();
  const auto series = cut(source.read().series, from_s, to_s, object.place());
  const auto held = std::make_shared<Series>();
  hold_influences(series, *held);
  scenario.sampling = {.duration_s = static_cast<double>(series.size()) / series.rate_hz(),
                       .rate_hz = series.rate_hz()};
  if (!held->temperature_C.empty()) scenario.temperature = temperature::Recorded{held};
  if (!series.rate_ref_dps.empty()) scenario.motion = motion::Recorded{held};
  if (!held->cross_rate_1_dps.empty())
    scenario.cross_motion_1 = motion::Recorded{held, &Series::cross_rate_1_dps};
  if (!held->cross_rate_2_dps.empty())
    scenario.cross_motion_2 = motion::Recorded{held, &Series::cross_rate_2_dps};
  if (!held->acc_x_mps2.empty() && !held->acc_y_mps2.empty() && !held->acc_z_mps2.empty())
    scenario.acceleration = acceleration::Recorded{held};
}

/// A profile other than "recorded", which the scenario already has where there is such a recording,
/// unless that could not be read.
template <class Chosen>
void read_profile(JsonObject& object, bool recordings_read, std::optional<Chosen>& profile) {
  if (object.text("profile", "") != "recorded")
    profile = read_plugin<Chosen>(object, "profile");
  else if (recordings_read && (!profile || profile->id() != "recorded"))
    throw InputError(object.place(),
                     "'recorded' needs a recording that has it, under \"conditions_from\" (or, "
                     "for a temperature, \"from_recording\") in this scenario");
}

/// Which parameters the object under `key` gives.
void note_stated(JsonObject& object, const std::string& key, std::span<const FieldInfo> fields,
                 std::set<std::string>& stated) {
  if (auto child = object.child(key))
    for (const auto& field : fields)
      if (child->has(std::string(field.name))) stated.emplace(field.name);
}

/// The nominal unit of the fleet that the object names.
std::shared_ptr<Fleet> read_nominal(JsonObject object, const std::string& folder,
                                    FittedRecordings& fits, Scenario& scenario) {
  const auto file = object.required_text("file");
  object.finish();
  auto fleet = read_fleet((std::filesystem::path(folder) / file).lexically_normal().string(), fits);
  scenario = fleet->nominal();
  return fleet;
}

}  // namespace

Scenario read_scenario(JsonObject object, const std::string& folder, FittedRecordings& fits,
                       std::shared_ptr<const Fleet>* fleet) {
  Scenario scenario;
  std::shared_ptr<Fleet> drawn_from;
  object.with_child("from_fleet", [&](JsonObject& named) {
    if (fleet == nullptr)
      throw InputError(named.place(), "sensors are drawn in the trials of a study alone");
    if (object.has("from_recording"))
      throw InputError(named.place(), "stands beside \"from_recording\"; give one of them");
    drawn_from = read_nominal(named, folder, fits, scenario);
  });
  const bool recording_read = object.with_child("from_recording", [&](JsonObject& recorded) {
    read_recorded(recorded, folder, fits, scenario);
  });
  const bool conditions_read = object.with_child("conditions_from", [&](JsonObject& recorded) {
    read_conditions(recorded, folder, scenario);
  });
  object.fields(scenario.sampling);
  const auto nested = [&](const std::string& key, auto& parameters) {
    object.with_child(key, [&](JsonObject& child) {
      child.fields(parameters);
      child.finish();
    });
  };
  nested("random_error", scenario.random_error);
  const bool fitted = (recording_read && object.has("from_recording")) || drawn_from;
  if (fitted && scenario.random_error.measurement_noise_std_dps == 0.0)
    throw InputError(
        object.place(),
        fmt::format("R is 0, as where the fit to a recording cannot tell R, and then every filter "
                    "is exact; allowed: \"random_error\": {{\"measurement_noise_std_dps\": ...}} "
                    "above 0 beside \"{}\"",
                    drawn_from ? "from_fleet" : "from_recording"));
  nested("thermal_drift", scenario.thermal_drift);
  const auto followed = [&](const std::string& key, auto profile) {
    object.with_child(key, [&](JsonObject& child) {
      read_profile(child, recording_read && conditions_read, profile);
    });
    return profile;
  };
  scenario.temperature = *followed("temperature", std::optional(scenario.temperature));
  scenario.motion = *followed("motion", std::optional(scenario.motion));
  scenario.cross_motion_1 = followed("cross_motion_1", scenario.cross_motion_1);
  scenario.cross_motion_2 = followed("cross_motion_2", scenario.cross_motion_2);
  scenario.acceleration = followed("acceleration", scenario.acceleration);
  object.with_child("compass",
                    [&](JsonObject& compass) { scenario.compass = read_compass(compass); });
  if (object.has("effects")) scenario.effects.clear();
  for (const auto& entry : object.list("effects"))
    object.attempt([&] {
      scenario.effects.push_back(
          read_plugin<Effect>(object.at(*entry.first, entry.second), "effect"));
    });
  object.finish();
  if (drawn_from) {
    std::set<std::string> stated;
    if (object.has("effects")) stated.emplace("effects");
    object.attempt([&] {
      note_stated(object, "random_error", field_infos_of<Arima111<double>>, stated);
      note_stated(object, "thermal_drift", field_infos_of<ThermalDrift<double>>, stated);
      drawn_from->settle(stated, scenario, object.place_of("from_fleet"));
    });
    *fleet = drawn_from;
  }
  return scenario;
}

}  // namespace gyrostat
