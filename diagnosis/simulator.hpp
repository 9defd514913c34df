#pragma once

#include <array>
#include <list>
#include <map>
#include <mutex>
#include <span>

#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/diagnosis/gap/instrument.hpp>
#include <gyrostat/diagnosis/gyro_response.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

/// Readings of a recording or a replica, a part each.
using Readings = std::array<Eigen::VectorXd, 2>;
/// Readings x replicas, a part each.
using ReplicaReadings = std::array<Eigen::MatrixXd, 2>;

/// A scenario's readings under the conditions of one recording, written with as many decimals.
class Simulator {
 public:
  Simulator(const Series& recording, std::uint64_t seed, Interrupt interrupt = {},
            Split split = Split::in_parts);
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  const Conditions& conditions() const { return conditions_; }
  const GyroResponse& response() const { return response_; }
  /// What all work under these conditions asks now and then.
  const Interrupt& interrupt() const { return interrupt_; }
  const Instrument& instrument(Part part) const { return instruments_[index_of(part)]; }
  /// Step of the recording's decimals, dps; 0 where none shows, or where it is so coarse that it
  /// is the sensor's own.
  double resolution_dps() const { return resolution_dps_; }

  /// Keeps the readings of replicas [first, first + count) of `scenario`. Where a later scenario
  /// shares its gyro or its heading with it, that half is taken from here: it would be the same.
  void remember(const Scenario& scenario, std::uint32_t first, std::size_t count);
  /// More replicas of the same scenario.
  void remember_more(std::uint32_t first, std::size_t count);

  Series replica(const Scenario& scenario, std::uint32_t number) const;
  Readings readings(const Series& series, std::span<const Part> of = both_parts) const;
  /// Of replicas [first, first + count), in parallel; the same for any number of threads. A part
  /// that is not asked for has no columns. What was read of both parts is kept: it costs nothing to
  /// ask for it again.
  ReplicaReadings ensemble(const Scenario& scenario, std::uint32_t first, std::size_t count,
                           std::span<const Part> of = both_parts) const;
  Eigen::VectorXd mean_train(const Scenario& scenario, std::uint32_t first,
                             std::size_t count) const;

 private:
  Readings replica_readings(const Scenario& scenario, std::uint32_t number,
                            std::span<const Part> of) const;
  static Scenario simulable(Scenario scenario);
  void to_resolution(Series& series) const;

  Interrupt interrupt_;
  Conditions conditions_;
  GyroResponse response_;
  std::array<Instrument, 2> instruments_;
  std::uint64_t seed_;
  double resolution_dps_;
  Scenario remembered_;
  std::map<std::uint32_t, Readings> memory_;
  /// What was read of the replicas of a scenario.
  struct Kept {
    Scenario scenario;
    std::map<std::uint32_t, Readings> readings;
  };
  std::map<std::uint32_t, Readings>& kept_of(const Scenario& scenario) const;
  mutable std::mutex mutex_;
  mutable std::list<Kept> kept_;
};

}  // namespace gyrostat::gap
